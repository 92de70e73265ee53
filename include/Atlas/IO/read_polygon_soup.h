// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_READ_POLYGON_SOUP_H
#define ATLAS_IO_READ_POLYGON_SOUP_H

#include <Atlas/core/Kernel.h>
#include <Atlas/image/Image.h>
#include <Atlas/soup/Polygon_soup.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace Atlas {

/// \brief Reads a mesh file; its extension tells the format, in any case.
///
/// - .obj: polygons with relative indices, comments, continued lines, all line ends; `v` with w or colours
/// (of
///   [0, 1] or [0, 255]) and those of ZBrush (`#MRGB`), `vt`, `vn`, `usemtl`, `mtllib`, `o` and `g` (one
///   group name a face, the latest); vertices may come after the faces that name them; unknown statements are
///   skipped
/// - .off, .coff: `OFF`, and with normals, colours or coordinates at the vertices `NOFF`, `COFF`, `STOFF` and
///   their combinations; colours of faces
/// - .ply: text or binary of either byte order, with positions, normals, colours of vertices and faces,
/// triangle
///   strips, and coordinates at the vertices, at the wedges of faces as MeshLab writes them, or at the
///   halfedges as CGAL does; MeshLab's numbers of textures are pages
/// - .stl: text or binary, with colours of facets as Magics or VisCAM; corners at exactly the same position
///   become one vertex; where the count of a binary file is wrong, its size counts
/// - .gltf, .glb: version 2.0: all triangles of the default scene, transformed by their nodes; compressed by
///   Draco or meshopt where Atlas has been built with libdraco and libmeshoptimizer
///
/// Text may be UTF-8, UTF-16 or UTF-32. What is passed over is in `Polygon_soup::warnings`.
///
/// \throw IO_error with one line that names the file, the line or byte and what is wrong: a statement cannot
/// be understood, there is no face, the format is unknown or, in glTF, compressed in a way that this build
/// cannot read
Polygon_soup read_polygon_soup(const std::filesystem::path& path);

/// What is outside of the unit square.
enum class Texture_wrap { repeat, clamp, mirror };

/// \brief How a material of a file colours faces.
struct Source_texture
{
  Image image;                           ///< its first row belongs to v = 1; empty: the colour alone
  std::array<double, 3> factor{1, 1, 1}; ///< multiplies the light of the picture; in [0, 1], as sRGB
  double opacity = 1;                    ///< multiplies its alpha
  bool multiplies_colors = false;        ///< whether the colours of the vertices do so too, as in glTF
  /// Along u.
  Texture_wrap wrap_u = Texture_wrap::repeat, wrap_v = Texture_wrap::repeat; ///< along v
  std::array<double, 6> transform{1, 0, 0, 0, 1, 0}; ///< (u, v) -> (t0 u + t1 v + t2, t3 u + t4 v + t5)

  /// Where the picture is looked at for these coordinates.
  Point_2 transformed(const Point_2& p) const
  {
    const auto& t = transform;
    return Point_2(t[0] * p.x() + t[1] * p.y() + t[2], t[3] * p.x() + t[4] * p.y() + t[5]);
  }
};

/// \brief The textures of a model, by its own coordinates.
struct Source_textures
{
  std::vector<Source_texture> textures; ///< in any order; `face_texture` refers to them
  std::vector<Index> face_texture;      ///< per face of the model: its texture, or `no_index`
  std::vector<std::string> warnings; ///< what is named but cannot be found or read, and what is shown instead
};

/// \brief Reads the textures that a mesh file names: `map_Kd`, `Kd`, `d` and `map_d` of the MTL files beside
/// an OBJ file (with `<UDIM>` in the name, and `-s`, `-o`, `-clamp`), `TextureFile` of a PLY file, the base
/// colours of glTF.
///
/// \param mesh  the file
/// \param soup  what has been read from it; its `old_uv`, or `uv` if there are none, tell the tiles of UDIM
///
/// Files are looked for beside the mesh, in any case and with slashes of either kind; of paths of another
/// machine the last parts count. A library that is named like the mesh takes the place of those that are not
/// there. Names of materials may differ in case. Faces whose material is not described get `no_index`; an OBJ
/// file that names no material for a face means that of its library, if it has one only. A picture that
/// cannot be read is a warning, and the plain colour counts. Other formats have no textures at all.
/// \throw IO_error the mesh itself cannot be read
Source_textures read_textures(const std::filesystem::path& mesh, const Polygon_soup& soup);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/IO/internal/read_polygon_soup_impl.h>
#include <Atlas/IO/internal/read_textures_impl.h>
#endif

#endif
