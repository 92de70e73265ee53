// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_READ_TEXTURES_IMPL_H
#define ATLAS_IO_INTERNAL_READ_TEXTURES_IMPL_H

#include <Atlas/IO/internal/Mtl_reader.h>
#include <Atlas/IO/internal/add_alpha.h>
#include <Atlas/IO/internal/extension.h>
#include <Atlas/IO/internal/find_file.h>
#include <Atlas/IO/internal/gltf_texture.h>
#include <Atlas/IO/internal/load_gltf.h>
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/image/Image.h>
#include <Atlas/image/pages.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <tiny_gltf.h>
#include <utility>
#include <vector>

namespace Atlas {

namespace internal {

/// The tile of UDIM that the middle of a face is in; 0 outside of the tiles.
inline Index tile_of(const Polygon_soup& soup, const std::vector<Point_2>& uv, std::size_t f)
{
  Polygon_soup face;
  for (std::size_t c = soup.first[f]; c < soup.first[f + 1]; ++c) {
    face.vertices.push_back(soup.vertices[c]);
    face.uv.push_back(uv[c]);
  }
  face.close_face();
  separate_udim(face);
  return face.face_page[0];
}

/// The picture that a file means by a name; an empty one, and a warning, if there is none that can be read.
inline Image read_picture(const std::filesystem::path& folder, const std::string& name,
                          std::vector<std::string>& warnings)
{
  const auto path = find_file(folder, name);
  if (!path) {
    warnings.push_back("there is no picture " + internal::quoted(name));
    return Image();
  }
  try {
    return read_image(*path);
  } catch (const IO_error& error) {
    warnings.emplace_back(error.what());
    return Image();
  }
}

/// Reads a library; one that cannot be read is told of.
inline void read_library(const std::filesystem::path& path, Mtl_reader& reader)
{
  try {
    reader.read(path);
  } catch (const IO_error& error) {
    reader.warnings.emplace_back(error.what());
  }
}

/// \brief The libraries that an OBJ file names: one a statement, with blanks in its name, or several.
///
/// If none of them is there, as after the files have been renamed together, the one that is called as the OBJ
/// file takes their place.
inline Mtl_reader read_libraries(const std::filesystem::path& mesh,
                                 const std::vector<std::string>& statements)
{
  const std::filesystem::path folder = mesh.parent_path();
  Mtl_reader reader;
  bool is_any_there = statements.empty();
  for (const std::string& statement : statements) {
    std::string_view rest = statement;
    while (!rest.empty() && rest.front() != '#') { // the longest name that there is
      std::string_view name = rest;
      auto path = find_file(folder, std::string(name));
      while (!path && name.find_last_of(" \t") != std::string_view::npos) {
        name = name.substr(0, name.find_last_of(" \t"));
        path = find_file(folder, std::string(name));
      }
      is_any_there = is_any_there || path;
      if (path)
        read_library(*path, reader);
      else
        reader.warnings.push_back("there is no material library " + internal::quoted(name));
      rest.remove_prefix(name.size());
      rest.remove_prefix(std::min(rest.size(), rest.find_first_not_of(" \t")));
    }
  }
  const auto of_same_name = mesh.filename().replace_extension(".mtl").string();
  if (const auto path = find_file(folder, of_same_name); path && !is_any_there) {
    reader.warnings.push_back("the material library " + internal::quoted(of_same_name) + " takes its place");
    read_library(*path, reader);
  }
  return reader;
}

inline Source_texture texture_of(const Mtl_material& material, Index tile,
                                 const std::filesystem::path& folder, std::vector<std::string>& warnings)
{
  const auto name_of_tile = [&](std::string name) {
    if (const std::size_t place = name.find("<UDIM>"); place != std::string::npos)
      name.replace(place, 6, std::to_string(udim_tile(tile)));
    return name;
  };
  Source_texture texture;
  if (material.is_clamped)
    texture.wrap_u = texture.wrap_v = Texture_wrap::clamp;
  texture.transform = {material.scale[0], 0, material.offset[0], 0, material.scale[1], material.offset[1]};
  if (!material.picture.empty())
    texture.image = read_picture(folder, name_of_tile(material.picture), warnings);
  if (texture.image.pixels.empty())
    texture.factor = material.diffuse;
  if (!material.alpha_picture.empty()) {
    const Image alpha = read_picture(folder, name_of_tile(material.alpha_picture), warnings);
    if (texture.image.pixels.empty() && !alpha.pixels.empty())
      texture.image = Image(1, 1); // white, of which the factor makes the colour
    add_alpha(texture.image, alpha);
  }
  texture.opacity = material.opacity;
  return texture;
}

/// What the libraries say of each material that the mesh names, or `nullptr`, which is told of if there are
/// any libraries.
inline std::vector<const Mtl_material*> materials_of_names(const Polygon_soup& soup, const Mtl_reader& reader,
                                                           std::vector<std::string>& warnings)
{
  std::vector<const Mtl_material*> result;
  for (const std::string& name : soup.material_names) {
    result.push_back(reader.find(name));
    if (!result.back() && !reader.materials.empty())
      warnings.push_back("no material library has the material " + internal::quoted(name));
  }
  return result;
}

inline Source_textures read_mtl_textures(const std::filesystem::path& mesh, const Polygon_soup& soup,
                                         const std::vector<Point_2>& uv)
{
  Source_textures result;
  const Mtl_reader reader = read_libraries(mesh, soup.material_libraries);
  result.warnings = reader.warnings;
  result.face_texture.assign(soup.number_of_faces(), no_index);
  std::map<std::pair<const Mtl_material*, Index>, Index> number; // of a material and tile
  const Mtl_material* const only = reader.materials.size() == 1 ? &reader.materials.begin()->second : nullptr;
  const std::vector<const Mtl_material*> named = materials_of_names(soup, reader, result.warnings);
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    const bool is_named = !soup.face_material.empty() && soup.face_material[f] != no_index;
    const Mtl_material* const material = is_named ? named[soup.face_material[f]] : only;
    if (!material)
      continue;
    const bool has_tiles = material->picture.find("<UDIM>") != std::string::npos && !uv.empty();
    const Index tile = has_tiles ? tile_of(soup, uv, f) : 0;
    const auto [it, is_new] =
        number.try_emplace({material, tile}, static_cast<Index>(result.textures.size()));
    result.face_texture[f] = it->second;
    if (is_new)
      result.textures.push_back(texture_of(*material, tile, mesh.parent_path(), result.warnings));
  }
  return result;
}

inline Source_textures read_ply_textures(const std::filesystem::path& mesh, const Polygon_soup& soup)
{
  Source_textures result;
  for (const std::string& name : soup.page_textures) {
    result.textures.emplace_back();
    result.textures.back().image = read_picture(mesh.parent_path(), name, result.warnings);
  }
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    const Index page = soup.page(f);
    const bool is_there = page < result.textures.size() && !result.textures[page].image.pixels.empty();
    result.face_texture.push_back(is_there ? page : no_index);
  }
  return result;
}

/// Decodes a picture of a glTF file; one that cannot be decoded stays empty.
inline bool load_or_skip_picture(tinygltf::Image* image, int number, std::string*, std::string*, int width,
                                 int height, const unsigned char* bytes, int size, void* options)
{
  std::string error, warning;
  if (!tinygltf::LoadImageData(image, number, &error, &warning, width, height, bytes, size, options))
    image->image.clear();
  return true;
}

inline Source_textures read_gltf_textures(const std::filesystem::path& mesh, const Polygon_soup& soup)
{
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(&load_or_skip_picture, nullptr);
  const tinygltf::Model model = load_gltf(mesh, loader);
  Source_textures result;
  for (const tinygltf::Material& material : model.materials)
    result.textures.push_back(texture_of(model, material, result.warnings));
  result.face_texture = soup.face_material;
  result.face_texture.resize(soup.number_of_faces(), no_index);
  for (Index& t : result.face_texture)
    t = t < result.textures.size() ? t : no_index;
  return result;
}

} // namespace internal

ATLAS_INLINE Source_textures read_textures(const std::filesystem::path& mesh, const Polygon_soup& soup)
{
  const std::string extension = internal::lower_case_extension(mesh);
  if (extension == ".obj")
    return internal::read_mtl_textures(mesh, soup, soup.old_uv.empty() ? soup.uv : soup.old_uv);
  if (extension == ".ply")
    return internal::read_ply_textures(mesh, soup);
  if (extension == ".gltf" || extension == ".glb")
    return internal::read_gltf_textures(mesh, soup);
  return {{}, std::vector<Index>(soup.number_of_faces(), no_index), {}};
}

} // namespace Atlas

#endif
