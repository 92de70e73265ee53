// SPDX-License-Identifier: MIT
// What the program works on.
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/core/errors.h>
#include <Atlas/image/internal/text_bytes.h>
#include <Atlas/soup/internal/weld_points.h>
#include <Atlas/soup/orient_faces.h>

#include "texture_atlas.h"
#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace {

/// Refuses wishes that the meshes cannot fulfil.
void check_wishes(const Options& options, const std::vector<Atlas::Polygon_soup>& soups)
{
  const auto check = [&](bool is_wanted, auto has, const char* what) {
    if (is_wanted && std::none_of(soups.begin(), soups.end(), has))
      throw Atlas::IO_error(options.name() + ": " + what);
  };
  check(
      options.has(Bake::colors),
      [](const auto& soup) { return !soup.colors.empty() || !soup.face_colors.empty(); },
      "neither vertices nor faces have colours to bake");
  check(
      options.keeps_uv, [](const auto& soup) { return !soup.uv.empty(); },
      "there are no texture coordinates in this file");
}

/// What a reader has to say of a file.
void print_warnings(const Options& options, const std::string& file, const std::vector<std::string>& warnings)
{
  for (const std::string& warning : warnings)
    if (!options.is_quiet)
      std::fprintf(stderr, "texture_atlas: %s: %s\n", file.c_str(),
                   Atlas::internal::printable(warning).c_str());
}

/// The textures of all meshes, face by face. \throw Atlas::IO_error if there are none
Atlas::Source_textures read_all_textures(const Options& options,
                                         const std::vector<Atlas::Polygon_soup>& soups)
{
  Atlas::Source_textures all;
  for (std::size_t i = 0; i < soups.size(); ++i) {
    Atlas::Source_textures own = Atlas::read_textures(options.meshes[i], soups[i]);
    print_warnings(options, options.meshes[i], own.warnings);
    own.face_texture.resize(soups[i].number_of_faces(), Atlas::no_index);
    const auto before = static_cast<Atlas::Index>(all.textures.size());
    for (const Atlas::Index texture : own.face_texture)
      all.face_texture.push_back(texture == Atlas::no_index ? texture : texture + before);
    std::move(own.textures.begin(), own.textures.end(), std::back_inserter(all.textures));
  }
  if (std::all_of(all.face_texture.begin(), all.face_texture.end(),
                  [](Atlas::Index texture) { return texture == Atlas::no_index; }))
    throw Atlas::IO_error(options.name() + ": there is no texture and no colour of a material to bake");
  return all;
}

/// The surface of a mesh, whose faces are turned if so wanted; its vertices stay where they are.
Atlas::Surface surface_of(const Options& options, Atlas::Polygon_soup& soup)
{
  std::vector<Atlas::Point_3> points = soup.points;
  if (options.weld > 0)
    Atlas::internal::weld_points(points, options.weld);
  std::swap(points, soup.points);
  if (options.turns_faces)
    Atlas::orient_faces(soup);
  std::swap(points, soup.points);
  return Atlas::build_surface(std::move(points), soup.first, soup.vertices);
}

} // namespace

Input read_meshes(const Options& options)
{
  std::vector<Atlas::Polygon_soup> soups;
  std::vector<Atlas::Surface> surfaces;
  for (const std::string& file : options.meshes) {
    soups.push_back(Atlas::read_polygon_soup(file));
    print_warnings(options, file, soups.back().warnings);
    surfaces.push_back(surface_of(options, soups.back()));
  }
  check_wishes(options, soups);
  Atlas::Source_textures source;
  if (options.has(Bake::texture))
    source = read_all_textures(options, soups);
  Atlas::Surface surface =
      surfaces.size() == 1 ? std::move(surfaces.front()) : Atlas::join_surfaces(surfaces);
  return {Atlas::Joined_soups(std::move(soups)), std::move(surface), std::move(source)};
}
