// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_BAKE_TEXTURE_H
#define ATLAS_BAKE_BAKE_TEXTURE_H

#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Kernel.h>
#include <Atlas/image/Image.h>
#include <Atlas/soup/Polygon_soup.h>

#include <array>
#include <cstddef>
#include <functional>

namespace Atlas {

/// \brief The place on the surface that a texel shows.
struct Bake_sample
{
  std::size_t texel;             ///< of the page, row by row from the top
  Index face;                    ///< of the soup
  Index triangle;                ///< of the surface that `build_surface()` makes of the soup
  std::array<Index, 3> corners;  ///< of the soup: those of the triangle the texel is in
  std::array<double, 3> weights; ///< barycentric coordinates, in [0, 1], sum 1

  /// The mean of a value that is given per corner.
  template <typename Value, typename ValueOfCorner>
  Value mean(ValueOfCorner value) const
  {
    Value sum{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < sum.size(); ++k)
        sum[k] +=
            static_cast<typename Value::value_type>(weights[i] * value(corners[i])[static_cast<int>(k)]);
    return sum;
  }
};

/// What a texel shows, given its place on the surface.
using Bake_shader = std::function<Color(const Bake_sample&)>;

/// \brief Makes a texture: every texel whose centre lies in a chart shows what `shader` says of its place on
/// the surface; all others show the nearest of these, so that no gutter is too narrow for interpolation or
/// smaller versions.
///
/// \param soup    with coordinates in [0, 1]^2
/// \param size    of the page, in texels
/// \param shader  called from several threads if `execution` has them
/// \param page    which one: only faces on it are seen
/// \throw Invalid_argument the soup has faces, but not a coordinate per corner
///
/// O(texels + height x triangles that are taller than a texel).
Image bake_texture(const Polygon_soup& soup, Image_size size, const Bake_shader& shader, Index page = 0,
                   const Execution& execution = Execution());

/// \brief How far faces that lie on the same texels, as stacked charts do, differ in what they show: the
/// share of the texels with several faces where two colours differ by more than 16 of 255 in a component. 0
/// if no texel has several faces. The time of `bake_texture()`, for each face on a texel.
double differing_share(const Polygon_soup& soup, Image_size size, const Bake_shader& shader, Index page = 0);

/// A colour of components in [0, 1].
Color color_of(const std::array<double, 3>& components);

/// What `bake_vertex_colors()` shows. The soup must outlive it.
Bake_shader vertex_color_shader(const Polygon_soup& soup);

/// \brief The colours of the vertices as a texture, or where these are white or missing, those of the faces.
/// \throw Invalid_argument the soup has neither a colour per vertex nor one per face
Image bake_vertex_colors(const Polygon_soup& soup, Image_size size, Index page = 0);

/// \brief Colours given by a function of the position in space as a texture.
Image bake_procedural(const Polygon_soup& soup, Image_size size,
                      const std::function<Color(const Point_3&)>& color_at, Index page = 0);

/// \brief The colour of a direction in a map of normals: a unit vector's coordinates from [-1, 1] to
/// [0, 255].
Color color_of_normal(const Vector_3& n);

/// A normal, of any length, given a place on the surface.
using Bake_normal = std::function<Vector_3(const Bake_sample&)>;

/// \brief The normals of the surface, in the coordinates of the model: those of the soup where it has them,
/// else normals that are smooth except at edges sharper than 45 degrees; in between they are interpolated.
/// The soup must outlive it.
Bake_normal shading_normal(const Polygon_soup& soup);

/// \brief Normals in the frames of a surface ("tangent space"), as materials want them: x along the direction
/// of u, y along that of v, z along `shading_normal()`. Bakers and renderers that follow MikkTSpace
/// (Mikkelsen 2008) agree on the frames, if they show the soup with these normals and as these triangles.
///
/// \param soup    with coordinates; one without normals is to get them first, `add_normals()`
/// \param normal  in the coordinates of the model
/// \throw Invalid_argument the soup has not a coordinate per corner
///
/// Linear in triangles, then constant for a place.
Bake_normal in_tangent_space(const Polygon_soup& soup, Bake_normal normal);

/// \brief Gives a soup without normals those of `shading_normal()`. Others stay as they are. Linear.
void add_normals(Polygon_soup& soup);

/// \brief The normals of the surface as a texture, in the coordinates of the model ("object space", which
/// needs no tangents): `shading_normal()` as colours. Linear in texels and triangles.
/// \param page which one
Image bake_normals(const Polygon_soup& soup, Image_size size, Index page = 0,
                   const Execution& execution = Execution());

/// \brief Copies the textures that a model came with to its new coordinates.
///
/// \param soup    with the new coordinates in `uv`, the old ones in `old_uv`
/// \param source  the old textures, as `read_textures()` gives them
/// \param page    which one of the new pages
/// \param missing the colour of faces without an old texture
///
/// Colours are interpolated between pixels; where the old texture is finer than the new one, a smaller
/// version of it is taken, so that nothing is skipped. Alpha goes along. Faces without old coordinates get
/// the colour of their material. Factors, and the colours of vertices where they count, multiply linear
/// light. \throw Invalid_argument `old_uv` has entries, but not one per corner, or `source` has not an entry
/// per face
Image transfer_texture(const Polygon_soup& soup, Image_size size, const Source_textures& source,
                       Index page = 0, const Execution& execution = Execution(),
                       const Color& missing = {128, 128, 128});

/// What `transfer_texture()` shows, without alpha. Its arguments must outlive it.
Bake_shader texture_shader(const Polygon_soup& soup, Image_size size, const Source_textures& source,
                           const Color& missing = {128, 128, 128});

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/bake/internal/bake_normals_impl.h>
#include <Atlas/bake/internal/bake_texture_impl.h>
#include <Atlas/bake/internal/transfer_texture_impl.h>
#endif

#endif
