// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_PACKING_H
#define ATLAS_CORE_PACKING_H

#include <Atlas/core/Kernel.h>
#include <Atlas/core/internal/library.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace Atlas {

/// The default side of a page, in texels.
inline constexpr Index default_texture_size = 1024;
/// The default distance between charts, in texels.
inline constexpr double default_gutter = 2;

/// By how much snapping to texels may stretch a chart along an axis, as a share of its size.
inline constexpr double max_snap_stretch = 0.02;
/// How much farther apart charts are packed that snap to texels: each of two may move by half a diagonal.
inline constexpr double snap_allowance = 1.4142135623730951;

/// In which directions charts may be turned.
enum class Chart_rotation {
  aligned,       ///< charts whose border has a dominant direction turn it parallel to an axis of the page, by
                 ///< any of the four ways; all others as they like
  free,          ///< as they like, whatever their borders are
  any,           ///< as `aligned`, but all as they like where that makes the page fuller by at least 2 %
  quarter_turns, ///< by multiples of 90 degrees
  none
};

/// Which charts may lie on top of each other: copies of one another, up to rounding.
enum class Chart_stacking {
  none,
  copies,             ///< charts that differ by a motion of the plane
  copies_and_mirrored ///< also charts that differ by a reflection
};

/// \brief Where a chart goes: x -> D s R x + t, after a reflection (x, y) -> (x, -y) if it is mirrored, from
/// the chart's plane to texels of its page, origin bottom left. D stretches along the axes of the page, by
/// next to nothing.
struct Placement
{
  /// Rotation and scale are the complex number a + ib: its real part.
  double a = 1, b = 0; ///< its imaginary part
  /// The translation to the right, in texels.
  double x = 0, y = 0;      ///< the translation upwards, in texels
  Index page = 0;           ///< counting from 0
  bool is_mirrored = false; ///< only charts stacked on one that they are a mirror image of
  /// Along x, only of charts that snap to texels.
  double stretch_x = 1, stretch_y = 1; ///< the same along y

  /// Where a point of the chart goes.
  Point_2 operator()(const Point_2& p) const
  {
    const double px = p.x(), py = is_mirrored ? -p.y() : p.y();
    return Point_2(stretch_x * (a * px - b * py) + x, stretch_y * (b * px + a * py) + y);
  }
};

/// \brief What pages have to be like, and what charts may do on them.
///
/// Lists with an entry per chart may be empty, which stands for the default for all charts.
struct Page_options
{
  Index width = default_texture_size;  ///< texels
  Index height = default_texture_size; ///< texels
  double gutter =
      default_gutter; ///< least distance between two charts in texels; half of it to the page border

  Index mip_levels = 0; ///< down to this level of a mip-map there is a texel between charts: 2^n on the page
  Index block = 1;      ///< no two charts share a block of that many texels squared (4 for most compression)

  Index pages = 1;    ///< number of pages that may be filled, when no density is given
  double density = 0; ///< texels per unit of the charts, on as many pages as that takes; 0: the largest that
                      ///< fits `pages`

  Chart_rotation rotation = Chart_rotation::aligned; ///< how charts may turn
  /// What is up in space, of any length. Each chart is turned so that it is up on the page too, where the
  /// chart has such a direction: not if it faces up or down, or goes around. Zero: no such wish.
  std::array<double, 3> up = {0, 0, 0};
  /// Whether straight borders that are parallel to an axis are put onto borders of texels. A chart that has
  /// such borders on two opposite sides has both of them there, if it need not be stretched by more than
  /// `max_snap_stretch`; else it is moved until the longest one is. Points move by half a texel at most along
  /// each axis, and charts are packed that much farther apart.
  bool snaps = false;
  Chart_stacking stacking = Chart_stacking::none; ///< which charts may share a place
  std::vector<double> weights = {}; ///< per chart: its density is that of the packing times this
  std::vector<Index> groups = {}; ///< per chart: charts of a group keep their mutual places and move as one;
                                  ///< `no_index`: alone
  /// Per chart of a group: where it is in the plane in which the group keeps together. That plane is scaled
  /// so that the charts of a group keep their areas in all. Empty: the charts' own plane, as it is.
  std::vector<Placement> places_in_group = {};
  /// Per chart: where it stays, in size too, whatever its weight or group; the others are packed around it.
  /// Locked charts are not checked against each other. Where they leave no room on the only page, there is no
  /// packing.
  std::vector<std::optional<Placement>> locked = {};
  /// Whether `generate_atlas()` may choose another ratio of the sides, with about the same number of texels:
  /// the enclosing rectangle of least area (section 4 of the LSCM paper). The report tells the sides. Takes
  /// 17 packings. Packers themselves keep to `width` and `height`.
  bool has_free_aspect = false;

  /// The distance that is kept between charts, with mip levels and blocks: two points of one block are nearer
  /// than its diagonal. With what charts that snap to texels may come nearer.
  double effective_gutter() const
  {
    const double texels_at_level = mip_levels > 0 ? std::ldexp(1.0, static_cast<int>(mip_levels)) : 0;
    const double diagonal = block > 1 ? std::sqrt(2.0) * block : 0;
    return std::max({gutter, texels_at_level, diagonal}) + (snaps ? snap_allowance : 0);
  }
};

/// The largest side of a page, in texels.
inline constexpr Index max_page_side = 65536;
/// The most levels of a mip-map that charts are kept apart for.
inline constexpr Index max_mip_levels = 16;
/// The largest block of texels that charts are kept apart for.
inline constexpr Index max_block = 4096;
/// As many pages as there are UDIM tiles, from 1001 to 9999.
inline constexpr Index max_pages = 8999;

/// \brief Refuses what cannot be, but for the lengths of lists.
///
/// \throws Invalid_argument that names the member of `Page_options` unless: `width` and `height` are in [1,
/// 65536]; the gutter is finite, not negative and, with mip levels and blocks, less than half of the smaller
/// side; `mip_levels` is at most 16, `block` 4096, `pages` in [1, 8999]; `density` is finite and not
/// negative; `up` is finite; weights are positive and finite; and places are finite, those of locked charts
/// on pages with a number.
void check(const Page_options& page);

/// \brief Refuses what cannot be for so many charts: also lists that are neither empty nor of that length.
///
/// \throws Invalid_argument that names the member of `Page_options`
void check(const Page_options& page, std::size_t number_of_charts);

/// \brief The result of a packer. All charts share one density, but for their weights; only their places
/// differ.
struct Packing
{
  std::vector<Placement> placements; ///< per chart
  Index number_of_pages = 0;         ///< how many have charts on them
  double density = 0;                ///< texels per unit of the charts' coordinates
  double gutter = 0; ///< what was kept: less than asked for only where a page has no room for so many charts
  std::vector<Index> layers = {}; ///< per chart: how many charts that it is a copy of lie below it, at the
                                  ///< same place; empty: none are stacked
};

/// The number of a page in the UDIM scheme: ten tiles a row, from 1001 on.
inline Index udim_tile(Index page)
{
  return 1001 + page % 10 + 10 * (page / 10);
}

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/core/internal/Packing_impl.h>
#endif

#endif
