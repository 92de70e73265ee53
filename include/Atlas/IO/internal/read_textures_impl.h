// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_READ_TEXTURES_IMPL_H
#define ATLAS_IO_INTERNAL_READ_TEXTURES_IMPL_H

#include <Atlas/IO/internal/Mtl_reader.h>
#include <Atlas/IO/internal/extension.h>
#include <Atlas/IO/internal/gltf_texture.h>
#include <Atlas/IO/internal/load_gltf.h>
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/image/Image.h>
#include <Atlas/image/pages.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
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

inline Source_textures read_mtl_textures(const std::filesystem::path& mesh, const Polygon_soup& soup,
                                         const std::vector<Point_2>& uv)
{
  Mtl_reader reader;
  for (const std::string& library : soup.material_libraries)
    reader.read(mesh.parent_path() / library);
  Source_textures result;
  result.face_texture.assign(soup.number_of_faces(), no_index);
  std::map<std::pair<Index, Index>, Index> number; // of a material and tile
  for (std::size_t f = 0; f < soup.number_of_faces() && !soup.face_material.empty(); ++f) {
    if (soup.face_material[f] == no_index)
      continue;
    const auto found = reader.materials.find(soup.material_names[soup.face_material[f]]);
    if (found == reader.materials.end())
      continue;
    const Mtl_material& material = found->second;
    const std::size_t place = material.picture.find("<UDIM>");
    const Index tile = place == std::string::npos || uv.empty() ? 0 : tile_of(soup, uv, f);
    const auto [it, is_new] =
        number.try_emplace({soup.face_material[f], tile}, static_cast<Index>(result.textures.size()));
    result.face_texture[f] = it->second;
    if (!is_new)
      continue;
    Source_texture texture;
    texture.factor = material.picture.empty() ? material.diffuse : texture.factor;
    if (material.is_clamped)
      texture.wrap_u = texture.wrap_v = Texture_wrap::clamp;
    std::string picture = material.picture;
    if (place != std::string::npos)
      picture.replace(place, 6, std::to_string(udim_tile(tile)));
    if (!picture.empty())
      texture.image = read_image(mesh.parent_path() / picture);
    result.textures.push_back(std::move(texture));
  }
  return result;
}

inline Source_textures read_ply_textures(const std::filesystem::path& mesh, const Polygon_soup& soup)
{
  Source_textures result;
  for (const std::string& name : soup.page_textures) {
    result.textures.emplace_back();
    result.textures.back().image = read_image(mesh.parent_path() / name);
  }
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    result.face_texture.push_back(soup.page(f) < result.textures.size() ? soup.page(f) : no_index);
  return result;
}

inline Source_textures read_gltf_textures(const std::filesystem::path& mesh, const Polygon_soup& soup)
{
  tinygltf::TinyGLTF loader;
  const tinygltf::Model model = load_gltf(mesh, loader);
  Source_textures result;
  for (const tinygltf::Material& material : model.materials)
    result.textures.push_back(texture_of(model, material, mesh.string()));
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
  return {{}, std::vector<Index>(soup.number_of_faces(), no_index)};
}

} // namespace Atlas

#endif
