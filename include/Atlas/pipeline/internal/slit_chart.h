// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_SLIT_CHART_H
#define ATLAS_PIPELINE_INTERNAL_SLIT_CHART_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/internal/extract_triangles.h>
#include <Atlas/validation/internal/Chart_ways.h>

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace Atlas::internal {

/// Moves marked corners of a flat chart by a part of the way to the middle of the triangles around them.
inline void draw_in(Chart& flat, const std::vector<std::uint8_t>& is_marked)
{
  constexpr double part = 0.1;
  std::vector<Vector_2> sum(flat.number_of_vertices(), Vector_2(0, 0));
  std::vector<double> number(flat.number_of_vertices(), 0);
  for (std::size_t t = 0; t < flat.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      if (const Index v = flat.triangles[t][i]; is_marked[3 * t + i]) {
        sum[v] += (flat.uv[flat.triangles[t][(i + 1) % 3]] - flat.uv[v]) +
                  (flat.uv[flat.triangles[t][(i + 2) % 3]] - flat.uv[v]);
        number[v] += 1;
      }
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] > 0)
      flat.uv[v] += part / number[v] * sum[v];
}

/// A flat chart that is slit open along a way. It lies as before, but for the sides of the slit: they are a
/// little apart, so that an optimiser can keep them so.
/// \param graph  of the chart
/// \param way    between the border and a vertex inside
inline Chart slit_chart(const Chart& flat, const Chart_ways& graph, const std::vector<Index>& way)
{
  std::vector<Index> opposite = graph.opposite();
  for (const Index h : way)
    opposite[h] = opposite[graph.opposite()[h]] = no_index;
  std::vector<Index> all(flat.number_of_triangles()), local(all.size());
  std::iota(all.begin(), all.end(), Index(0));
  Chart slit = extract_triangles(
      opposite, all, local, [&](Index h) { return opposite[h] != no_index; },
      [&](Index h) -> const Point_3& { return flat.points[graph.tail(h)]; });
  slit.source = flat.source;
  slit.uv.resize(slit.number_of_vertices());
  std::vector<Index> copy(flat.number_of_vertices(), no_index);
  std::vector<std::uint8_t> has_two(flat.number_of_vertices(), 0), is_marked(opposite.size());
  for (Index h = 0; h < opposite.size(); ++h) {
    const Index v = graph.tail(h), w = slit.triangles[h / 3][h % 3];
    slit.uv[w] = flat.uv[v];
    has_two[v] |= copy[v] != no_index && copy[v] != w;
    copy[v] = w;
  }
  for (Index h = 0; h < opposite.size(); ++h)
    is_marked[h] = has_two[graph.tail(h)];
  draw_in(slit, is_marked);
  return slit;
}

} // namespace Atlas::internal

#endif
