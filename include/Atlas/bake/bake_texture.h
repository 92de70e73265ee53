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
#include <vector>

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

/// What the colours of a texture stand for.
enum class Texel_meaning {
  colors,         ///< what they are: colours, shades, normals in the coordinates of the model
  tangent_normals ///< `in_tangent_space()`: the two sides of a seam see one normal as two colours
};

/// A texture is looked at in so many sizes: as it is, halved, and halved again (mip levels 0, 1 and 2).
inline constexpr std::size_t seam_levels = 3;

/// \brief How much the two sides of seams differ in what a renderer shows of a texture.
struct Seam_difference
{
  std::size_t seams = 0;                     ///< edges whose two sides lie apart on the page
  std::array<double, seam_levels> largest{}; ///< per mip level, in a component from 0 to 255; all along the
                                             ///< seams, not at samples alone
};

/// \brief Measures what the two sides of seams show: bilinear interpolation of texels that are means of
/// four of the size above. In alpha too, where a page has it.
///
/// \param pages    the pictures of all pages of the soup, of one size
/// \param meaning  of normals in tangent space those in the coordinates of the model are compared, and edges
/// at which the soup's own normals differ are left out
/// \throw Invalid_argument the soup has not a coordinate per corner, or a page no picture, or sizes differ
///
/// Linear in texels and in texels along seams.
Seam_difference seam_difference(const Polygon_soup& soup, const std::vector<Image>& pages,
                                Texel_meaning meaning = Texel_meaning::colors);

/// \brief Changes the texels near seams, by least squares as little as it takes, so that both sides of every
/// seam show the same: to 1 of 255 at all three sizes, unless what crosses the seams has detail of a few
/// texels, or the gutters are too narrow for the smallest size (`mip_levels` 2 keeps them wide enough).
///
/// Texels between charts change too. Detail along seams is blurred by a few texels.
/// \return what is left: `seam_difference()` of the changed pages. The same for any number of threads.
/// \throw Invalid_argument as `seam_difference()`
///
/// Some thousand passes over the texels along seams, most of which are skipped; ends early if the execution
/// is cancelled.
Seam_difference make_seamless(const Polygon_soup& soup, std::vector<Image>& pages,
                              Texel_meaning meaning = Texel_meaning::colors,
                              const Execution& execution = Execution());

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/bake/internal/bake_normals_impl.h>
#include <Atlas/bake/internal/bake_texture_impl.h>
#include <Atlas/bake/internal/make_seamless_impl.h>
#include <Atlas/bake/internal/transfer_texture_impl.h>
#endif

#endif
