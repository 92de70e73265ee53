// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_STENCIL_VALIDATOR_H
#define ATLAS_VALIDATION_STENCIL_VALIDATOR_H

#include <Atlas/core/concepts.h>
#include <Atlas/validation/Exact_validator.h>
#include <Atlas/validation/overlaps.h>

#include <cstddef>
#include <span>
#include <vector>

namespace Atlas {

/// The texels a side at which a chart is drawn, unless said otherwise.
inline constexpr Index default_stencil_resolution = 1024;

/// What the stencil buffer says about triangles in the plane.
struct Stencil_overlaps
{
  std::size_t covered_texels = 0;    ///< whose centre lies in a triangle
  std::size_t overlapped_texels = 0; ///< in more than one
  Overlaps overlaps;                 ///< pairs of triangles that share a texel
};

/// \brief The overlap test of Levy et al. 2002, section 3.3: the plane is drawn in stencil mode, texels that
/// are drawn more than once are overlapped.
///
/// Part of the component `Atlas::Rendering`: OpenGL by way of Mesa's offscreen renderer. It sees
/// what covers the centre of a texel, so overlaps smaller than a texel escape it, and corners are moved to a
/// grid of a fraction of a texel. It is a second opinion, made by other means, on what `find_overlaps()`
/// proves.
///
/// \param resolution  texels a side; the larger side of the bounding box of the triangles fills it
/// \param tile        side of the largest piece that is drawn at once; 0: as large as the renderer allows
/// \param max_layers  sheets on one texel that are told apart
/// \throw Invalid_argument  the resolution is 0
/// \throw std::runtime_error  no context can be made
Stencil_overlaps find_stencil_overlaps(std::span<const Triangle_uv> triangles, Index resolution,
                                       Index tile = 0, unsigned max_layers = 16);

/// \brief Accepts charts that show no overlap in a stencil buffer, and keep areas well enough: section 3.3 of
/// Levy et al. 2002 to the letter.
///
/// Flips are not looked for by themselves; a flipped triangle with neighbours is drawn over them. For a
/// proof, use `Exact_validator`.
///
/// Models `ChartValidator` and `ChartSplitter`. Part of the component `Atlas::Rendering`.
class Stencil_validator
{
public:
  /// \param resolution      texels a side at which the chart is drawn, at least 1
  /// \param max_area_ratio  see `Exact_validator`
  /// \param tile            see `find_stencil_overlaps()`
  /// \throw Invalid_argument  the resolution is 0
  explicit Stencil_validator(Index resolution = default_stencil_resolution,
                             double max_area_ratio = default_max_area_ratio, Index tile = 0);

  /// \throw std::runtime_error  no context can be made
  Chart_verdict validate(const Chart& chart, const Execution& execution) const;

  /// Cuts along the edges on the border of the overlapped zone, or grows two parts from the extreme
  /// triangles; see `Culprit_splitter`.
  std::vector<Index> split(const Chart& chart, const Chart_verdict& verdict) const;

private:
  Stencil_overlaps overlaps(const Chart& chart) const;

  Index resolution_;
  double max_area_ratio_;
  Index tile_;
};

static_assert(ChartValidator<Stencil_validator> && ChartSplitter<Stencil_validator>);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/validation/internal/rendering/Stencil_validator_impl.h>
#endif

#endif
