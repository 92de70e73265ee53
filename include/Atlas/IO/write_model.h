// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_WRITE_MODEL_H
#define ATLAS_IO_WRITE_MODEL_H

#include <Atlas/image/pages.h>
#include <Atlas/soup/Polygon_soup.h>

#include <filesystem>
#include <string>
#include <vector>

namespace Atlas {

/// The name of the material of faces that have none.
inline constexpr const char* default_material_name = "atlas";

/// \brief The text of an OBJ file: the same vertices, faces and corners in the same order, with texture
/// coordinates, normals, colours, groups and materials where the soup has them.
///
/// Every number is written with as many digits as it takes to read exactly the same double. Equal coordinates
/// are written once. \param material_library the name of the MTL file, beside the OBJ file; empty: none
/// \param style how several pages are told apart
std::string obj_text(const Polygon_soup& soup, const std::string& material_library,
                     Page_style style = Page_style::udim);

/// \brief The text of an MTL file in which every material of the soup, and the default one, shows the
/// texture. \param texture file name of the picture, as seen from the folder of the MTL file
///
/// Of several pages each has a picture, called `page_file_name()`. With `Page_style::udim` one material names
/// all of them, with `<UDIM>` in place of the tile's number; with `Page_style::materials` each material is
/// there once per page. \param has_alpha whether the picture tells opacity as well
std::string mtl_text(const Polygon_soup& soup, const std::string& texture,
                     Page_style style = Page_style::udim, bool has_alpha = false);

/// \brief Writes an OBJ file, and beside it an MTL file of the same stem that names the texture.
/// Either both files appear whole, or none. \param style how several pages are told apart \throw IO_error
void write_obj(const std::filesystem::path& path, const Polygon_soup& soup, const std::string& texture,
               Page_style style = Page_style::udim);

/// \brief Writes an OBJ file without material. \throw IO_error
void write_obj(const std::filesystem::path& path, const Polygon_soup& soup);

/// Where a glTF file has its textures.
enum class Gltf_textures {
  inside, ///< in the file
  files   ///< in files of their own, named from the folder of the model
};

/// \brief The bytes of a binary glTF 2.0 file (GLB), with the texture inside unless asked otherwise.
///
/// Polygons are triangulated, faces without a shape are left out, vertices are split where corners differ.
/// Positions are rounded to floats; the coordinates of an atlas are floats already, and turning v upside
/// down, as glTF wants it, rounds nothing. Normals, colours and materials are kept;
/// textures with alpha blend.
///
/// glTF has no tiles: of several pages each gets its own texture, materials ("name.1002", by the number of
/// its UDIM tile) and primitives. \param page_textures per page the bytes of a PNG file, or its name; empty:
/// no texture. One for all pages if there is only one
std::string glb_bytes(const Polygon_soup& soup, const std::vector<std::string>& page_textures,
                      Gltf_textures where = Gltf_textures::inside);

/// The same with one texture for all pages. \param texture_png the bytes of a PNG file; empty: no texture
std::string glb_bytes(const Polygon_soup& soup, const std::string& texture_png);

/// \brief Writes a binary glTF file, whole or not at all. See `glb_bytes()`.
/// \throw IO_error
void write_glb(const std::filesystem::path& path, const Polygon_soup& soup, const std::string& texture_png);

/// \brief Writes a binary glTF file with a texture per page, whole or not at all. \throw IO_error
void write_glb(const std::filesystem::path& path, const Polygon_soup& soup,
               const std::vector<std::string>& page_pngs);

/// What changes in a glTF document besides its coordinates.
struct Gltf_changes
{
  int uv_set = 0;             ///< the number of the new set of coordinates; sets from there on move up by one
  std::string base_color_png; ///< the bytes of a picture that shows the base colours by the new coordinates;
                              ///< empty: materials stay as they are
  bool has_base_factors = false; ///< whether the factors of materials are in it
};

/// \brief The bytes of a binary glTF file: the document that a soup was read from, with the soup's
/// coordinates.
///
/// Nodes, names, transforms, skins, morph targets, animations, cameras, extras, extensions, materials and all
/// other sets of coordinates stay as they are. Vertices are split where the corners of faces differ, at the
/// end of their lists, with all their attributes. A mesh that several nodes show becomes one for each whose
/// coordinates differ. With a new picture the colours of vertices go, which would multiply it. Pictures are
/// inside.
///
/// \param original  the file, text or binary
/// \param soup      what `read_polygon_soup()` has made of it, with one page
/// \throw IO_error the file cannot be read, or Invalid_argument: it has other faces
std::string glb_bytes(const std::filesystem::path& original, const Polygon_soup& soup,
                      const Gltf_changes& changes = {});

/// Where a PLY file keeps texture coordinates.
enum class Ply_texcoord_style {
  wedge, ///< at the corners of faces, as MeshLab does: vertices stay as they are; faces tell their page, and
         ///< pages their picture
  vertex ///< at the vertices, which are split where the corners of faces differ; pages are UDIM tiles
};

/// \brief The bytes of a binary PLY file. Faces keep their order and corners; positions are doubles,
/// coordinates floats. \param texture the name of the picture, which MeshLab looks for beside the file;
/// empty: none. Of several pages each has a picture, called `page_file_name()` \param pages how many there
/// are, if there are more than faces are on
std::string ply_bytes(const Polygon_soup& soup, const std::string& texture,
                      Ply_texcoord_style style = Ply_texcoord_style::wedge, Index pages = 1);

/// \brief Writes a binary PLY file, whole or not at all. See `ply_bytes()`.
/// \throw IO_error
void write_ply(const std::filesystem::path& path, const Polygon_soup& soup, const std::string& texture,
               Ply_texcoord_style style = Ply_texcoord_style::wedge);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/IO/internal/rewrite_gltf_impl.h>
#include <Atlas/IO/internal/write_gltf_impl.h>
#include <Atlas/IO/internal/write_obj_impl.h>
#include <Atlas/IO/internal/write_ply_impl.h>
#endif

#endif
