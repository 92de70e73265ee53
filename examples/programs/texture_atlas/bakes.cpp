// SPDX-License-Identifier: MIT
#include "bakes.h"

#include <Atlas/bake/internal/bake_texels.h>
#include <Atlas/bake/internal/texel_shader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace {

const char* suffix_of(Bake what)
{
  switch (what) {
  case Bake::colors:
    return "_color.png";
  case Bake::texture:
    return "_texture.png";
  case Bake::normals:
    return "_normal.png";
  case Bake::tangent_normals:
    return "_tangent_normal.png";
  case Bake::occlusion:
    return "_occlusion.png";
  case Bake::displacement:
    return "_displacement.png";
  }
  return "";
}

Atlas::Bake_shader color_of(Atlas::Bake_normal normal)
{
  return [normal = std::move(normal)](const Atlas::Bake_sample& sample) {
    return Atlas::color_of_normal(normal(sample));
  };
}

/// What a texel shows of a mesh, given its place on it.
Atlas::Bake_shader shader_of(Bake what, const Atlas::Polygon_soup& mesh, Atlas::Image_size size,
                             const Atlas::Source_textures& source)
{
  switch (what) {
  case Bake::colors:
    return Atlas::vertex_color_shader(mesh);
  case Bake::texture:
    return Atlas::texture_shader(mesh, size, source);
  case Bake::normals:
  case Bake::tangent_normals:
    return color_of(Atlas::shading_normal(mesh));
  case Bake::occlusion:
    return Atlas::occlusion_shader(mesh);
  case Bake::displacement:
    break; // see `Baker::bake_displacement()`
  }
  return {};
}

/// Where a place on a mesh is in space.
Atlas::Point_3 point_of(const Atlas::Polygon_soup& mesh, const Atlas::Bake_sample& sample)
{
  const auto p = sample.mean<std::array<double, 3>>(
      [&](Atlas::Index corner) -> const Atlas::Point_3& { return mesh.points[mesh.vertices[corner]]; });
  return Atlas::Point_3(p[0], p[1], p[2]);
}

/// How far the place of a sample on another mesh is along the normal.
auto height_of(const Atlas::Polygon_soup& model, const Atlas::Polygon_soup& detail,
               const Atlas::Bake_place& place)
{
  return [&, normal = Atlas::shading_normal(model)](const Atlas::Bake_sample& sample) {
    const Atlas::Vector_3 n = normal(sample);
    const double length = std::sqrt(n.squared_length());
    return length > 0 ? (point_of(detail, place(sample)) - point_of(model, sample)) * n / length : 0;
  };
}

} // namespace

Baker::Baker(const Options& options, const Input& input, Atlas::Image_size size)
    : input_(input), size_(size), is_seamless_(options.is_seamless)
{
  if (!options.detail.empty() && !options.bakes.empty())
    place_ = Atlas::place_on(input.models.whole(), input.detail, options.cage);
}

Atlas::Bake_shader Baker::shader(Bake what) const
{
  const Atlas::Polygon_soup &model = input_.models.whole(), &shown = place_ ? input_.detail : model;
  const auto at_place = [&](auto shader) -> decltype(shader) {
    if (!place_)
      return shader;
    return [place = place_, shader](const Atlas::Bake_sample& sample) { return shader(place(sample)); };
  };
  if (what == Bake::tangent_normals)
    return color_of(Atlas::in_tangent_space(model, at_place(Atlas::shading_normal(shown))));
  return at_place(shader_of(what, shown, size_, input_.source));
}

Textures Baker::operator()(Bake what, const Atlas::Execution& execution) const
{
  Textures result{{}, suffix_of(what), {}, {}};
  if (what == Bake::displacement)
    bake_displacement(result, execution);
  else
    for (Atlas::Index page = 0; page < input_.models.whole().number_of_pages(); ++page)
      result.pages.push_back(image(what, page, execution));
  if (is_seamless_ && !execution.is_cancelled()) {
    const Atlas::Texel_meaning meaning =
        what == Bake::tangent_normals ? Atlas::Texel_meaning::tangent_normals : Atlas::Texel_meaning::colors;
    Atlas::Polygon_soup model = input_.models.whole();
    if (meaning == Atlas::Texel_meaning::colors)
      model.points = input_.surface.points; // neighbours are those that have been welded
    const Atlas::Seam_difference before = Atlas::seam_difference(model, result.pages, meaning);
    result.seams = {before, Atlas::make_seamless(model, result.pages, meaning, execution)};
  }
  return result;
}

Atlas::Image Baker::image(Bake what, Atlas::Index page, const Atlas::Execution& execution) const
{
  const Atlas::Polygon_soup& model = input_.models.whole();
  if (what == Bake::texture && !place_) // with alpha
    return Atlas::transfer_texture(model, size_, input_.source, page, execution);
  if (what == Bake::texture) { // of another mesh; grey is what `texture_shader()` shows where nothing is
    const Atlas::internal::Texel_shader shader =
        Atlas::internal::texel_shader(input_.detail, size_, input_.source, {128, 128, 128});
    return Atlas::internal::bake_texels(
        model, size_, [&](const Atlas::Bake_sample& sample) { return shader(place_(sample)); }, page,
        execution);
  }
  return Atlas::bake_texture(model, size_, shader(what), page, execution);
}

/// Heights are measured first, for the largest is white.
void Baker::bake_displacement(Textures& result, const Atlas::Execution& execution) const
{
  const Atlas::Polygon_soup& model = input_.models.whole();
  const auto height = height_of(model, input_.detail, place_);
  std::vector<std::vector<double>> heights;
  double largest = 0;
  for (Atlas::Index page = 0; page < model.number_of_pages(); ++page) {
    std::vector<double>& here = heights.emplace_back(size_.width * size_.height, 0);
    const auto measure = [&](const Atlas::Bake_sample& sample) { // each texel once
      here[sample.texel] = height(sample);
      return Atlas::Color{};
    };
    (void)Atlas::bake_texture(model, size_, measure, page, execution);
    for (const double h : here)
      largest = std::max(largest, std::abs(h));
  }
  for (Atlas::Index page = 0; page < model.number_of_pages(); ++page) {
    const auto shade = [&](const Atlas::Bake_sample& sample) {
      const double share = largest > 0 ? heights[page][sample.texel] / largest : 0;
      const auto grey = static_cast<std::uint8_t>(std::lround(127.5 + 127.5 * share));
      return Atlas::Color{grey, grey, grey};
    };
    result.pages.push_back(Atlas::bake_texture(model, size_, shade, page, execution));
  }
  result.displacement = largest;
}
