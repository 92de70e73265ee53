// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_ANY_POLICIES_IMPL_H
#define ATLAS_CORE_INTERNAL_ANY_POLICIES_IMPL_H

#include <Atlas/core/Any_policies.h>
#include <Atlas/core/errors.h>

#include <boost/core/demangle.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace Atlas {

namespace internal {

ATLAS_INLINE std::string name_of_type(const std::type_info& type)
{
  return boost::core::demangle(type.name());
}

/// What a chart is worth whose coordinates a policy of that role says it has filled. `triangles` is how many
/// there were before.
inline Chart_status checked_coordinates(const Chart& chart, std::size_t triangles, Chart_status status,
                                        const char* role, const std::string& type)
{
  if (chart.triangles.size() != triangles)
    throw Policy_error(role, type, "changed the triangles of a chart");
  if (status != Chart_status::valid)
    return status;
  if (chart.uv.size() != chart.points.size())
    throw Policy_error(role, type,
                       "returned " + std::to_string(chart.uv.size()) + " coordinates for a chart of " +
                           std::to_string(chart.points.size()) + " vertices");
  const bool is_finite = std::all_of(chart.uv.begin(), chart.uv.end(), [](const Point_2& p) {
    return std::isfinite(p.x()) && std::isfinite(p.y());
  });
  return is_finite ? status : Chart_status::solver_failed;
}

} // namespace internal

ATLAS_INLINE Segmentation Any_segmentation::segment(const Surface& surface, const Execution& execution) const
{
  Segmentation result = policy().segment(surface, execution);
  if (execution.is_cancelled())
    return result;
  const auto fail = [&](const std::string& fault) { throw Policy_error("segmentation", type_name(), fault); };
  if (result.chart.size() != surface.number_of_triangles())
    fail("returned charts for " + std::to_string(result.chart.size()) + " of " +
         std::to_string(surface.number_of_triangles()) + " triangles");
  if (result.cut.empty())
    result.cut.assign(surface.opposite.size(), 0);
  if (result.cut.size() != surface.opposite.size())
    fail("returned cuts for " + std::to_string(result.cut.size()) + " of " +
         std::to_string(surface.opposite.size()) + " halfedges");
  for (std::size_t t = 0; t < result.chart.size(); ++t)
    if (result.chart[t] >= result.number_of_charts)
      fail("put triangle " + std::to_string(t) + " into chart " + std::to_string(result.chart[t]) + " of " +
           std::to_string(result.number_of_charts));
  return result;
}

ATLAS_INLINE std::optional<Distortion_bound> Any_segmentation::bound() const
{
  return policy().bound();
}

ATLAS_INLINE Chart_status Any_parameterizer::parameterize(Chart& chart, const Execution& execution) const
{
  Flattening_record record;
  return parameterize(chart, execution, record);
}

ATLAS_INLINE Chart_status Any_parameterizer::parameterize(Chart& chart, const Execution& execution,
                                                          Flattening_record& record) const
{
  const std::size_t triangles = chart.triangles.size();
  const Chart_status status = policy().parameterize(chart, execution, record);
  return internal::checked_coordinates(chart, triangles, status, "parameterizer", type_name());
}

ATLAS_INLINE Chart_status Any_optimizer::optimize(Chart& chart, const Execution& execution) const
{
  const std::size_t triangles = chart.triangles.size();
  const Chart_status status = policy().optimize(chart, execution);
  return internal::checked_coordinates(chart, triangles, status, "optimizer", type_name());
}

ATLAS_INLINE Chart_verdict Any_validator::validate(const Chart& chart, const Execution& execution) const
{
  Chart_verdict verdict = policy().validate(chart, execution);
  for (const Index t : verdict.culprits)
    if (t >= chart.number_of_triangles())
      throw Policy_error("validator", type_name(),
                         "blamed triangle " + std::to_string(t) + " of a chart of " +
                             std::to_string(chart.number_of_triangles()) + " triangles");
  return verdict;
}

ATLAS_INLINE std::vector<Index> Any_splitter::split(const Chart& chart, const Chart_verdict& verdict) const
{
  std::vector<Index> parts = policy().split(chart, verdict);
  const std::size_t n = chart.number_of_triangles();
  if (parts.size() != n)
    throw Policy_error("splitter", type_name(),
                       "returned parts for " + std::to_string(parts.size()) + " of " + std::to_string(n) +
                           " triangles");
  for (const Index part : parts)
    if (part >= n)
      throw Policy_error("splitter", type_name(),
                         "returned part " + std::to_string(part) + " for a chart of " + std::to_string(n) +
                             " triangles");
  return parts;
}

ATLAS_INLINE Packing Any_packer::pack(std::span<const Chart> charts, const Page_options& page,
                                      const Execution& execution) const
{
  Packing packing = policy().pack(charts, page, execution);
  if (execution.is_cancelled() || packing.number_of_pages == 0)
    return packing;
  const auto fail = [&](const std::string& fault) { throw Policy_error("packer", type_name(), fault); };
  if (packing.placements.size() != charts.size())
    fail("returned " + std::to_string(packing.placements.size()) + " placements for " +
         std::to_string(charts.size()) + " charts");
  if (!packing.layers.empty() && packing.layers.size() != charts.size())
    fail("returned " + std::to_string(packing.layers.size()) + " layers for " +
         std::to_string(charts.size()) + " charts");
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const Placement& p = packing.placements[i];
    if (!std::isfinite(p.a) || !std::isfinite(p.b) || !std::isfinite(p.x) || !std::isfinite(p.y))
      fail("placed chart " + std::to_string(i) + " where coordinates are not finite");
    if (p.page >= packing.number_of_pages)
      fail("placed chart " + std::to_string(i) + " on page " + std::to_string(p.page) + " of " +
           std::to_string(packing.number_of_pages));
  }
  return packing;
}

} // namespace Atlas

#endif
