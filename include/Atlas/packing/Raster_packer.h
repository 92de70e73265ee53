// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_RASTER_PACKER_H
#define ATLAS_PACKING_RASTER_PACKER_H

#include <Atlas/concepts.h>
#include <Atlas/packing/internal/Packing_search.h>
#include <Atlas/packing/internal/horizon_layout.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace Atlas {

/// How hard a packer tries. The times are for 50 charts on two cores.
enum class Packing_effort {
  fast,   ///< about 0.3 s
  normal, ///< about 1 s
  best    ///< about 10 s
};

/// \brief The default packer: built on a raster with many rotations, then refined continuously.
///
/// 1. Charts are placed one by one on a bitmap where they touch most of what is there, in any of several
///    rotations, also in holes and concavities; several orders are tried, in parallel.
/// 2. All charts grow together, and push and turn each other apart by their distance fields.
/// 3. With more effort, charts are taken out again and put elsewhere, at a slightly larger scale.
///
/// Every layout that is kept passes an exact test: no two charts nearer than the gutter, none nearer than
/// half of it to the border, with what rounding to single precision may cost. The result is never below that
/// of `Horizon_packer`, which is also what is left when a page is too small for its charts.
///
/// Deterministic: the effort is counted in operations, not in seconds, and does not depend on the number of
/// threads.
///
/// Models `ChartPacker`.
class Raster_packer
{
public:
  explicit Raster_packer(Packing_effort effort = Packing_effort::fast) : effort_(effort) {}

  Packing pack(std::span<const Chart> charts, const Page_options& page, const Execution& execution) const
  {
    const internal::Outlines outlines = internal::outlines_of(charts, execution);
    const auto fallback =
        internal::horizon_layout(outlines, page, internal::Horizon_source::outline, execution);
    Packing packing = internal::packing_of(outlines, fallback);
    if (!fallback || outlines.area <= 0)
      return packing;
    internal::Packing_problem problem = make_problem(outlines, page, *fallback, execution);
    const internal::Shape_layout layout = search(problem, execution);
    if (layout.scale <= fallback->scale || execution.is_cancelled())
      return packing;
    std::size_t k = 0;
    for (std::size_t i = 0; i < outlines.size(); ++i) {
      if (outlines.charts[i].is_empty())
        continue;
      packing.placements[i] = outlines.placement(
          i, layout.scale, internal::rotated(layout.turns[k], problem.shapes[k].frame), layout.positions[k]);
      ++k;
    }
    packing.density = layout.scale * outlines.unit;
    return packing;
  }

private:
  static constexpr unsigned number_of_searches = 4;

  static internal::Packing_problem make_problem(const internal::Outlines& outlines, const Page_options& page,
                                                const internal::Layout& fallback, const Execution& execution)
  {
    internal::Packing_problem problem;
    for (const internal::Outline& outline : outlines.charts)
      if (!outline.is_empty())
        problem.outlines.push_back(&outline);
    problem.width = page.width;
    problem.height = page.height;
    problem.gutter = 2 * fallback.margin;
    problem.turns = internal::rotations(16);
    const double side = std::sqrt(problem.width * problem.height);
    problem.tolerance = 0.05;
    const double scale = std::sqrt(0.75 * problem.width * problem.height / outlines.area);
    internal::Shape_resolution resolution;
    resolution.tolerance = problem.tolerance / scale;
    resolution.spacing = 4.0 / 1024 * side / scale;
    resolution.cell = side / 512 / scale;
    resolution.gutter = (problem.gutter + 4 * problem.tolerance) / scale;
    resolution.cells_per_chart = problem.outlines.size() > 2000 ? 12 : 20;
    problem.shapes.resize(problem.outlines.size());
    execution.for_each(problem.shapes.size(), [&](std::size_t i) {
      problem.shapes[i] = internal::packing_shape(*problem.outlines[i], resolution, true);
    });
    problem.masks.emplace(problem.shapes, internal::rotations(8), problem.scale_of_share(0.8),
                          problem.pixel(), problem.grown(), execution);
    return problem;
  }

  internal::Shape_layout search(const internal::Packing_problem& problem, const Execution& execution) const
  {
    std::vector<internal::Packing_search> searches;
    for (unsigned k = 0; k < number_of_searches; ++k)
      searches.emplace_back(problem, k);
    execution.for_each(searches.size(), [&](std::size_t k) { searches[k].start(); });
    const std::uint64_t round = 100'000'000;
    const unsigned rounds = effort_ == Packing_effort::fast ? 0 : effort_ == Packing_effort::normal ? 4 : 40;
    for (unsigned r = 0; r < rounds && execution.proceed(double(r) / rounds); ++r)
      execution.for_each(searches.size(),
                         [&](std::size_t k) { searches[k].run(searches[k].work() + round); });
    internal::Shape_layout best;
    for (const auto& s : searches)
      if (s.best().scale > best.scale)
        best = s.best();
    return best;
  }

  Packing_effort effort_;
};

static_assert(ChartPacker<Raster_packer>);

} // namespace Atlas

#endif
