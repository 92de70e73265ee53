// SPDX-License-Identifier: MIT
// What the program works on.
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/core/errors.h>
#include <Atlas/soup/orient_faces.h>

#include "texture_atlas.h"
#include <algorithm>
#include <utility>

namespace {

/// Refuses wishes that the meshes cannot fulfil.
void check_wishes(const Options& options, const std::vector<Atlas::Polygon_soup>& soups)
{
  const auto check = [&](bool is_wanted, auto has, const char* what) {
    if (is_wanted && std::none_of(soups.begin(), soups.end(), has))
      throw Atlas::IO_error(options.name() + ": " + what);
  };
  check(
      options.has(Bake::colors), [](const auto& soup) { return !soup.colors.empty(); },
      "the vertices have no colours to bake");
  check(
      options.keeps_uv || options.has(Bake::texture), [](const auto& soup) { return !soup.uv.empty(); },
      "there are no texture coordinates in this file");
}

/// The textures of all meshes that have coordinates, face by face.
Atlas::Source_textures read_all_textures(const Options& options,
                                         const std::vector<Atlas::Polygon_soup>& soups)
{
  Atlas::Source_textures all;
  for (std::size_t i = 0; i < soups.size(); ++i) {
    Atlas::Source_textures own;
    if (!soups[i].uv.empty())
      own = Atlas::read_textures(options.meshes[i], soups[i]);
    own.face_texture.resize(soups[i].number_of_faces(), Atlas::no_index);
    const auto before = static_cast<Atlas::Index>(all.textures.size());
    for (const Atlas::Index texture : own.face_texture)
      all.face_texture.push_back(texture == Atlas::no_index ? texture : texture + before);
    std::move(own.textures.begin(), own.textures.end(), std::back_inserter(all.textures));
  }
  return all;
}

} // namespace

Input read_meshes(const Options& options)
{
  std::vector<Atlas::Polygon_soup> soups;
  std::vector<Atlas::Surface> surfaces;
  for (const std::string& file : options.meshes) {
    soups.push_back(Atlas::read_polygon_soup(file));
    if (options.turns_faces)
      Atlas::orient_faces(soups.back());
    surfaces.push_back(Atlas::build_surface(soups.back().points, soups.back().first, soups.back().vertices));
  }
  check_wishes(options, soups);
  Atlas::Source_textures source;
  if (options.has(Bake::texture))
    source = read_all_textures(options, soups);
  Atlas::Surface surface =
      surfaces.size() == 1 ? std::move(surfaces.front()) : Atlas::join_surfaces(surfaces);
  return {Atlas::Joined_soups(std::move(soups)), std::move(surface), std::move(source)};
}
