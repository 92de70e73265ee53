// SPDX-License-Identifier: MIT
#include "bakes.h"

#include <Atlas/bake/internal/bake_texels.h>
#include <Atlas/bake/internal/texel_shader.h>

#include <optional>
#include <utility>
#include <vector>

namespace {

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
    break; // see `Baker::heights()`
  }
  return {};
}

} // namespace

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

Baker::Baker(const Options& options, const Input& input, Atlas::Image_size size)
    : input_(input), size_(size), is_seamless_(options.is_seamless)
{
  if (!options.detail.empty() && !options.bakes.empty())
    place_ = Atlas::place_on(input.models.whole(), input.detail, options.cage);
}

const Atlas::Polygon_soup& Baker::shown() const
{
  return place_ ? input_.detail : input_.models.whole();
}

template <typename Shader>
Shader Baker::at_place(Shader shader) const
{
  if (!place_)
    return shader;
  return [place = place_, shader](const Atlas::Bake_sample& sample) { return shader(place(sample)); };
}

Atlas::internal::Texel_shader Baker::texels() const
{
  constexpr Atlas::Color missing{128, 128, 128}; // as `texture_shader()` shows where nothing is
  return at_place(Atlas::internal::texel_shader(shown(), size_, input_.source, missing));
}

Atlas::Bake_shader Baker::shader(Bake what) const
{
  if (what == Bake::tangent_normals)
    return color_of(Atlas::in_tangent_space(input_.models.whole(), at_place(Atlas::shading_normal(shown()))));
  return at_place(shader_of(what, shown(), size_, input_.source));
}

Atlas::Bake_shader Baker::opacity() const
{
  return [shader = texels()](const Atlas::Bake_sample& sample) {
    const std::uint8_t alpha = shader(sample).alpha;
    return Atlas::Color{alpha, alpha, alpha};
  };
}

Textures Baker::operator()(Bake what, const Atlas::Execution& execution) const
{
  Textures result{{}, suffix_of(what), {}};
  for (Atlas::Index page = 0; page < input_.models.whole().number_of_pages(); ++page)
    result.pages.push_back(image(what, page, execution));
  if (is_seamless_ && !execution.is_cancelled()) {
    const Atlas::Texel_meaning meaning =
        what == Bake::tangent_normals ? Atlas::Texel_meaning::tangent_normals : Atlas::Texel_meaning::colors;
    const Atlas::Polygon_soup model =
        meaning == Atlas::Texel_meaning::colors ? welded_model() : input_.models.whole();
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
  if (what == Bake::texture) // of another mesh
    return Atlas::internal::bake_texels(model, size_, texels(), page, execution);
  return Atlas::bake_texture(model, size_, shader(what), page, execution);
}

Atlas::internal::Height_maps Baker::heights(std::optional<Atlas::internal::Seams_closed>& seams,
                                            const Atlas::Execution& execution) const
{
  Atlas::internal::Height_maps result =
      Atlas::internal::bake_heights(input_.models.whole(), input_.detail, place_, size_, execution);
  if (is_seamless_ && !execution.is_cancelled())
    seams = close_seams(welded_model(), result, size_, execution);
  return result;
}

/// The model whose neighbours are those that have been welded.
Atlas::Polygon_soup Baker::welded_model() const
{
  Atlas::Polygon_soup model = input_.models.whole();
  model.points = input_.surface.points;
  return model;
}
