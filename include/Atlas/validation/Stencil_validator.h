// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_STENCIL_VALIDATOR_H
#define ATLAS_VALIDATION_STENCIL_VALIDATOR_H

#include <Atlas/core/concepts.h>
#include <Atlas/core/errors.h>
#include <Atlas/planar/internal/box_tree.h>
#include <Atlas/validation/Exact_validator.h>
#include <Atlas/validation/internal/OSMesa_stencil.h>
#include <Atlas/validation/internal/chart_densities.h>
#include <Atlas/validation/internal/chart_faults.h>
#include <Atlas/validation/internal/split_chart.h>
#include <Atlas/validation/overlaps.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
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
/// Uses OpenGL by way of Mesa's offscreen renderer: programs have to link OSMesa (`OSMesa::OSMesa`). It sees
/// what covers the centre of a texel, so overlaps smaller than a texel escape it, and corners are moved to a
/// grid of a fraction of a texel. It is a second opinion, made by other means, on what `find_overlaps()`
/// proves.
///
/// \param resolution  texels a side; the larger side of the bounding box of the triangles fills it
/// \param tile        side of the largest piece that is drawn at once; 0: as large as the renderer allows
/// \param max_layers  sheets on one texel that are told apart
/// \throw std::runtime_error  no context can be made
inline Stencil_overlaps find_stencil_overlaps(std::span<const Triangle_uv> triangles, Index resolution,
                                              Index tile = 0, unsigned max_layers = 16);

/// \brief Accepts charts that show no overlap in a stencil buffer, and keep areas well enough: section 3.3 of
/// Levy et al. 2002 to the letter.
///
/// Flips are not looked for by themselves; a flipped triangle with neighbours is drawn over them. For a
/// proof, use `Exact_validator`.
///
/// Models `ChartValidator` and `ChartSplitter`. A header of its own, because it needs OSMesa.
class Stencil_validator
{
public:
  /// \param resolution      texels a side at which the chart is drawn, at least 1
  /// \param max_area_ratio  see `Exact_validator`
  /// \param tile            see `find_stencil_overlaps()`
  explicit Stencil_validator(Index resolution = default_stencil_resolution,
                             double max_area_ratio = default_max_area_ratio, Index tile = 0)
      : resolution_(resolution), max_area_ratio_(max_area_ratio), tile_(tile)
  {
    internal::require(resolution > 0, "resolution", "must be at least 1 texel");
  }

  /// \throw std::runtime_error  no context can be made
  Chart_verdict validate(const Chart& chart, const Execution& execution) const
  {
    if (!internal::has_coordinates(chart))
      return {Chart_status::solver_failed, {}};
    const Stencil_overlaps found = overlaps(chart);
    if (execution.is_cancelled())
      return {Chart_status::cancelled, {}};
    if (found.overlapped_texels > 0)
      return {Chart_status::overlapping, triangles_of(found.overlaps)};
    return internal::Chart_densities(chart, 0).check(max_area_ratio_);
  }

  /// Cuts along the edges on the border of the overlapped zone, or grows two parts from the extreme
  /// triangles; see `Culprit_splitter`.
  std::vector<Index> split(const Chart& chart, const Chart_verdict& verdict) const
  {
    const internal::Chart_graph graph(chart);
    auto [parts, components] = graph.components([](Index) { return true; });
    if (components > 1)
      return parts;
    if (internal::has_coordinates(chart) && verdict.status == Chart_status::overlapping)
      parts = internal::split_overlap(chart, graph, overlaps(chart).overlaps);
    else if (internal::has_coordinates(chart) && verdict.status == Chart_status::area_ratio_exceeded)
      parts = internal::Chart_densities(chart, 0).split(graph);
    if (!internal::is_split(parts))
      parts = internal::halve(graph);
    return internal::renumber(std::move(parts));
  }

private:
  Stencil_overlaps overlaps(const Chart& chart) const
  {
    return find_stencil_overlaps(internal::triangles_uv(chart), resolution_, tile_);
  }

  Index resolution_;
  double max_area_ratio_;
  Index tile_;
};

static_assert(ChartValidator<Stencil_validator> && ChartSplitter<Stencil_validator>);

namespace internal {

/// The triangles in texels, drawn tile by tile.
class Stencil_painter
{
public:
  /// \param stencil  of the size of a tile
  Stencil_painter(std::span<const Triangle_uv> triangles, Index resolution, unsigned max_layers,
                  OSMesa_stencil& stencil)
      : tile_(stencil.size()), max_layers_(max_layers), stencil_(stencil)
  {
    Box_2 box;
    for (const Triangle_uv& t : triangles)
      for (const Point_2& p : t)
        box.add(p.x(), p.y());
    const double side = std::max(box.x1 - box.x0, box.y1 - box.y0);
    if (!(side > 0))
      return;
    for (Index t = 0; t < triangles.size(); ++t) {
      Stencil_triangle drawn{{}, t};
      for (int i = 0; i < 3; ++i)
        drawn.corners[i] = Point_2((triangles[t][i].x() - box.x0) / side * resolution,
                                   (triangles[t][i].y() - box.y0) / side * resolution);
      triangles_.push_back(drawn);
    }
    columns_ = (resolution + tile_ - 1) / tile_;
  }

  Stencil_overlaps run()
  {
    std::vector<std::vector<Index>> lists = triangles_of_tiles();
    for (std::size_t i = 0; i < lists.size(); ++i)
      paint(static_cast<double>(i % columns_) * tile_, static_cast<double>(i / columns_) * tile_, lists[i]);
    remove_duplicates();
    return std::move(result_);
  }

private:
  /// Per tile the triangles whose boxes touch it.
  std::vector<std::vector<Index>> triangles_of_tiles() const
  {
    std::vector<std::vector<Index>> lists(std::size_t(columns_) * columns_);
    const auto tile = [&](double x) {
      return static_cast<Index>(std::clamp(x / tile_, 0.0, double(columns_) - 1));
    };
    for (const Stencil_triangle& t : triangles_) {
      Box_2 box;
      for (const Point_2& p : t.corners)
        box.add(p.x(), p.y());
      for (Index y = tile(box.y0); y <= tile(box.y1); ++y)
        for (Index x = tile(box.x0); x <= tile(box.x1); ++x)
          lists[std::size_t(y) * columns_ + x].push_back(t.id);
    }
    return lists;
  }

  void paint(double x, double y, const std::vector<Index>& list)
  {
    std::vector<Stencil_triangle> shifted;
    for (const Index t : list) {
      shifted.push_back(triangles_[t]);
      for (Point_2& p : shifted.back().corners)
        p = Point_2(p.x() - x, p.y() - y);
    }
    stencil_.load(shifted);
    const std::vector<std::uint8_t> counts = stencil_.counts();
    unsigned layers = 0;
    for (const std::uint8_t count : counts) {
      result_.covered_texels += count > 0;
      result_.overlapped_texels += count > 1;
      layers = std::max<unsigned>(layers, count);
    }
    if (layers < 2)
      return;
    if (layers > max_layers_)
      result_.overlaps.is_complete = false;
    std::vector<std::vector<Index>> ids;
    for (unsigned layer = 0; layer < std::min(layers, max_layers_); ++layer)
      ids.push_back(stencil_.ids(layer));
    collect_pairs(counts, ids);
  }

  /// All pairs of triangles that are drawn on the same texel.
  void collect_pairs(const std::vector<std::uint8_t>& counts, const std::vector<std::vector<Index>>& ids)
  {
    auto& pairs = result_.overlaps.pairs;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      for (std::size_t k = 1; k < std::min<std::size_t>(counts[i], ids.size()); ++k)
        for (std::size_t j = 0; j < k; ++j) {
          const std::pair<Index, Index> pair = std::minmax(ids[j][i], ids[k][i]);
          if (pairs.empty() || pairs.back() != pair)
            pairs.push_back(pair);
        }
      if (pairs.size() > max_unsorted_) {
        remove_duplicates();
        max_unsorted_ = std::max(max_unsorted_, 2 * pairs.size());
      }
    }
  }

  void remove_duplicates()
  {
    auto& pairs = result_.overlaps.pairs;
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  }

  Index tile_, columns_ = 0;
  unsigned max_layers_;
  OSMesa_stencil& stencil_;
  std::vector<Stencil_triangle> triangles_;
  Stencil_overlaps result_;
  std::size_t max_unsorted_ = 1 << 20; ///< pairs, before those that occur again are thrown out
};

} // namespace internal

inline Stencil_overlaps find_stencil_overlaps(std::span<const Triangle_uv> triangles, Index resolution,
                                              Index tile, unsigned max_layers)
{
  internal::OSMesa_stencil stencil(
      std::min({resolution, tile == 0 ? no_index : tile, internal::OSMesa_stencil::largest_size()}));
  return internal::Stencil_painter(triangles, resolution, max_layers, stencil).run();
}

} // namespace Atlas

#endif
