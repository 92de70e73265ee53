// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_INTERNAL_RENDERING_STENCIL_VALIDATOR_IMPL_H
#define ATLAS_VALIDATION_INTERNAL_RENDERING_STENCIL_VALIDATOR_IMPL_H

#include <Atlas/core/errors.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/validation/Stencil_validator.h>
#include <Atlas/validation/internal/chart_densities.h>
#include <Atlas/validation/internal/chart_faults.h>
#include <Atlas/validation/internal/rendering/Stencil_painter.h>
#include <Atlas/validation/internal/split_chart.h>

#include <algorithm>
#include <utility>

namespace Atlas {

ATLAS_INLINE Stencil_validator::Stencil_validator(Index resolution, double max_area_ratio, Index tile)
    : resolution_(resolution), max_area_ratio_(max_area_ratio), tile_(tile)
{
  internal::require(resolution > 0, "resolution", "must be at least 1 texel");
}

ATLAS_INLINE Chart_verdict Stencil_validator::validate(const Chart& chart, const Execution& execution) const
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

ATLAS_INLINE std::vector<Index> Stencil_validator::split(const Chart& chart,
                                                         const Chart_verdict& verdict) const
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

ATLAS_INLINE Stencil_overlaps Stencil_validator::overlaps(const Chart& chart) const
{
  return find_stencil_overlaps(internal::triangles_uv(chart), resolution_, tile_);
}

ATLAS_INLINE Stencil_overlaps find_stencil_overlaps(std::span<const Triangle_uv> triangles, Index resolution,
                                                    Index tile, unsigned max_layers)
{
  internal::require(resolution > 0, "resolution", "must be at least 1 texel");
  internal::OSMesa_stencil& stencil = internal::OSMesa_stencil::of_this_thread(
      std::min({resolution, tile == 0 ? no_index : tile, internal::OSMesa_stencil::largest_size()}));
  const internal::OSMesa_stencil::Use use(stencil);
  return internal::Stencil_painter(triangles, resolution, max_layers, stencil).run();
}

} // namespace Atlas

#endif
