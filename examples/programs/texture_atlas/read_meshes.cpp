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
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace {

/// Refuses wishes that the meshes, or what is baked, cannot fulfil.
void check_wishes(const Options& options, const std::vector<Atlas::Polygon_soup>& soups,
                  const std::vector<Atlas::Polygon_soup>& baked)
{
  const auto has_colors = [](const auto& soup) { return !soup.colors.empty() || !soup.face_colors.empty(); };
  if (options.has(Bake::colors) && std::none_of(baked.begin(), baked.end(), has_colors))
    throw Atlas::IO_error((options.detail.empty() ? options.name() : options.detail) +
                          ": neither vertices nor faces have colours to bake");
  const auto has_uv = [](const auto& soup) { return !soup.uv.empty(); };
  if ((options.keeps_uv || options.merges_uv || !options.only.empty()) &&
      std::none_of(soups.begin(), soups.end(), has_uv))
    throw Atlas::IO_error(options.name() + ": there are no texture coordinates in this file");
}

/// What a reader has to say of a file.
void print_warnings(const Options& options, const std::string& file, const std::vector<std::string>& warnings)
{
  for (const std::string& warning : warnings)
    if (!options.is_quiet)
      std::fprintf(stderr, "texture_atlas: %s: %s\n", file.c_str(),
                   Atlas::internal::printable(warning).c_str());
}

/// The textures of all meshes, face by face. \throw Atlas::IO_error if there are none, and none are named
Atlas::Source_textures read_all_textures(const Options& options, const std::vector<std::string>& files,
                                         const std::vector<Atlas::Polygon_soup>& soups)
{
  Atlas::Source_textures all;
  bool is_any_missing = false;
  for (std::size_t i = 0; i < soups.size(); ++i) {
    Atlas::Source_textures own = Atlas::read_textures(files[i], soups[i]);
    print_warnings(options, files[i], own.warnings);
    is_any_missing = is_any_missing || !own.warnings.empty();
    own.face_texture.resize(soups[i].number_of_faces(), Atlas::no_index);
    const auto before = static_cast<Atlas::Index>(all.textures.size());
    for (const Atlas::Index texture : own.face_texture)
      all.face_texture.push_back(texture == Atlas::no_index ? texture : texture + before);
    std::move(own.textures.begin(), own.textures.end(), std::back_inserter(all.textures));
  }
  if (!is_any_missing && std::all_of(all.face_texture.begin(), all.face_texture.end(),
                                     [](Atlas::Index texture) { return texture == Atlas::no_index; }))
    throw Atlas::IO_error(files.front() + ": there is no texture and no colour of a material to bake");
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

/// The mesh that bakes are made from.
Atlas::Polygon_soup read_detail(const Options& options)
{
  Atlas::Polygon_soup soup = Atlas::read_polygon_soup(options.detail);
  print_warnings(options, options.detail, soup.warnings);
  if (options.turns_faces)
    Atlas::orient_faces(soup);
  const Atlas::Surface surface = Atlas::build_surface(soup.points, soup.first, soup.vertices);
  const auto has_area = [&](const auto& triangle) {
    return !CGAL::collinear(surface.points[triangle[0]], surface.points[triangle[1]],
                            surface.points[triangle[2]]);
  };
  if (std::none_of(surface.triangles.begin(), surface.triangles.end(), has_area))
    throw Atlas::IO_error(options.detail + ": no face has an area");
  if (soup.uv.empty())
    soup.uv.assign(soup.number_of_corners(), Atlas::Point_2(NAN, NAN));
  soup.old_uv = soup.uv;
  return soup;
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
  std::vector<Atlas::Polygon_soup> detail;
  if (!options.detail.empty())
    detail.push_back(read_detail(options));
  check_wishes(options, soups, detail.empty() ? soups : detail);
  Atlas::Source_textures source;
  if (options.has(Bake::texture))
    source = detail.empty() ? read_all_textures(options, options.meshes, soups)
                            : read_all_textures(options, {options.detail}, detail);
  Atlas::Surface surface =
      surfaces.size() == 1 ? std::move(surfaces.front()) : Atlas::join_surfaces(surfaces);
  return {Atlas::Joined_soups(std::move(soups)), std::move(surface), std::move(source),
          detail.empty() ? Atlas::Polygon_soup() : std::move(detail.front())};
}
