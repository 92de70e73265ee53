// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_MIRROR_DOUBLING_PARAMETERIZER_H
#define ATLAS_SEGMENTATION_INTERNAL_MIRROR_DOUBLING_PARAMETERIZER_H

#include <Atlas/core/Any_policies.h>
#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/measure/distortion.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// The piece of a chart's border along which it is glued to its image at the plane x = 0: the longest run of
/// border halfedges 3t + i there, in order. Nothing if it is short for the chart, or if all of the border is
/// there, so that there would be no disc. O(n log n).
inline std::vector<Index> run_on_mirror_plane(const Chart& chart)
{
  constexpr double least_share = 0.25; // of the square root of the chart's area
  const auto tail = [&](Index h) -> const Point_3& { return chart.points[chart.triangles[h / 3][h % 3]]; };
  const auto is_on_plane = [&](Index h) { return tail(h).x() == 0 && tail(next_halfedge(h)).x() == 0; };
  if (std::none_of(chart.points.begin(), chart.points.end(), [](const Point_3& p) { return p.x() == 0; }))
    return {};
  const std::vector<std::vector<Index>> loops = border_loops(opposite_halfedges(chart.triangles));
  if (loops.size() != 1)
    return {};
  const std::vector<Index>& loop = loops.front();
  const std::size_t n = loop.size();
  const auto first = std::find_if_not(loop.begin(), loop.end(), is_on_plane);
  if (first == loop.end())
    return {};
  std::vector<Index> run, best;
  double length = 0, longest = least_share * std::sqrt(area_3d(chart));
  const auto start = static_cast<std::size_t>(first - loop.begin());
  for (std::size_t i = 1; i <= n; ++i) {
    const Index h = loop[(start + i) % n];
    if (is_on_plane(h)) {
      run.push_back(h);
      length += std::sqrt(CGAL::squared_distance(tail(h), tail(next_halfedge(h))));
      continue;
    }
    if (length > longest) {
      longest = length;
      best = run;
    }
    run.clear();
    length = 0;
  }
  return best;
}

/// The chart glued to its image along a run on the plane x = 0. Its own vertices and triangles come first.
inline Chart doubled(const Chart& chart, const std::vector<Index>& run)
{
  Chart result;
  result.points = chart.points;
  result.triangles = chart.triangles;
  result.source = chart.source;
  std::vector<Index> image(chart.points.size(), no_index);
  for (const Index h : run)
    for (const Index v : {chart.triangles[h / 3][h % 3], chart.triangles[h / 3][next_halfedge(h) % 3]})
      image[v] = v;
  for (Index v = 0; v < image.size(); ++v)
    if (image[v] == no_index) {
      image[v] = static_cast<Index>(result.points.size());
      const Point_3& p = chart.points[v];
      result.points.emplace_back(-p.x(), p.y(), p.z());
    }
  for (const auto& [a, b, c] : chart.triangles)
    result.triangles.push_back({image[b], image[a], image[c]});
  result.source.insert(result.source.end(), chart.source.begin(), chart.source.end());
  return result;
}

/// \brief Flattens charts that reach the plane x = 0 together with their images, and keeps their half of
/// that.
struct Doubling_parameterizer
{
  Any_parameterizer parameterizer;
  Any_optimizer optimizer;

  Chart_status parameterize(Chart& chart, const Execution& execution) const
  {
    const std::vector<Index> run = run_on_mirror_plane(chart);
    if (run.empty())
      return flatten(chart, execution);
    Chart whole = doubled(chart, run);
    const Chart_status status = flatten(whole, execution);
    whole.uv.resize(std::min(whole.uv.size(), chart.points.size()));
    chart.uv = std::move(whole.uv);
    return status;
  }

private:
  Chart_status flatten(Chart& chart, const Execution& execution) const
  {
    const Chart_status status = parameterizer.parameterize(chart, execution);
    return status == Chart_status::valid ? optimizer.optimize(chart, execution) : status;
  }
};

/// Leaves charts as they are.
struct No_further_optimizer
{
  Chart_status optimize(Chart&, const Execution&) const { return Chart_status::valid; }
};

} // namespace Atlas::internal

#endif
