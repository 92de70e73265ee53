// SPDX-License-Identifier: MIT
#ifndef ATLAS_REPORT_INTERNAL_REPORT_MODEL_H
#define ATLAS_REPORT_INTERNAL_REPORT_MODEL_H

#include <Atlas/core/Kernel.h>
#include <Atlas/pipeline/Atlas_report.h>
#include <Atlas/soup/Polygon_soup.h>
#include <Atlas/soup/internal/Triangle_list.h>
#include <Atlas/soup/internal/face_distortion.h>
#include <Atlas/soup/internal/index_uv.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief The model as the page of a report shows it: vertices that are the same on the model and on the page
/// are one, so that the edges of a single triangle are the seams and the border.
struct Report_model
{
  std::vector<float> positions;       ///< 3 per vertex, in the unit ball
  std::vector<float> uv;              ///< 2 per vertex
  std::vector<float> charts;          ///< per vertex: its chart, or -1
  std::vector<std::uint32_t> indices; ///< 3 per triangle
  std::vector<Index> face;            ///< per triangle
  std::vector<std::uint32_t> seams;   ///< 2 per edge of a single triangle
  double density = 1;                 ///< area on the page over area in the unit ball, of all

  Report_model(const Polygon_soup& soup, const std::vector<Index>& face_chart)
  {
    Triangle_list triangles(soup);
    Row_table<3> table(soup.points.size());
    for (std::size_t c = 0; c < triangles.positions.size() / 3; ++c)
      add_corner(triangles, table, c, face_chart);
    face = std::move(triangles.face);
    find_seams();
    measure_density();
  }

  /// The normal of a triangle, as long as twice its area.
  std::array<double, 3> normal(std::size_t t) const
  {
    const auto p = [&](std::size_t i, std::size_t k) {
      return double(positions[3 * indices[3 * t + i] + k]);
    };
    std::array<double, 3> n{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
      n[k] = (p(1, a) - p(0, a)) * (p(2, b) - p(0, b)) - (p(1, b) - p(0, b)) * (p(2, a) - p(0, a));
    }
    return n;
  }

private:
  void add_corner(const Triangle_list& triangles, Row_table<3>& table, std::size_t c,
                  const std::vector<Index>& face_chart)
  {
    const auto word = [](const std::vector<float>& from, std::size_t i) {
      return std::uint64_t(std::bit_cast<std::uint32_t>(from[i]));
    };
    const std::vector<float>&p = triangles.positions, &t = triangles.uv;
    const Index v = table({word(p, 3 * c) << 32 | word(p, 3 * c + 1), word(p, 3 * c + 2),
                           word(t, 2 * c) << 32 | word(t, 2 * c + 1)});
    indices.push_back(v);
    if (v < positions.size() / 3)
      return;
    const Index f = triangles.face[c / 3];
    const bool has_chart = f < face_chart.size() && face_chart[f] != no_index;
    positions.insert(positions.end(), &p[3 * c], &p[3 * c] + 3);
    uv.insert(uv.end(), &t[2 * c], &t[2 * c] + 2);
    charts.push_back(has_chart ? static_cast<float>(face_chart[f]) : -1.f);
  }

  void find_seams()
  {
    std::vector<std::uint64_t> edges;
    edges.reserve(indices.size());
    for (std::size_t h = 0; h < indices.size(); ++h) {
      const std::uint64_t a = indices[h], b = indices[h % 3 == 2 ? h - 2 : h + 1];
      edges.push_back(std::min(a, b) << 32 | std::max(a, b));
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const bool is_single =
          (i == 0 || edges[i - 1] != edges[i]) && (i + 1 == edges.size() || edges[i + 1] != edges[i]);
      if (is_single) {
        seams.push_back(static_cast<std::uint32_t>(edges[i] >> 32));
        seams.push_back(static_cast<std::uint32_t>(edges[i]));
      }
    }
  }

  void measure_density()
  {
    double on_page = 0, in_space = 0;
    for (std::size_t t = 0; t < indices.size() / 3; ++t) {
      const auto q = [&](std::size_t i, std::size_t k) { return double(uv[2 * indices[3 * t + i] + k]); };
      const std::array<double, 3> n = normal(t);
      on_page +=
          std::abs((q(1, 0) - q(0, 0)) * (q(2, 1) - q(0, 1)) - (q(1, 1) - q(0, 1)) * (q(2, 0) - q(0, 0)));
      in_space += std::hypot(n[0], n[1], n[2]);
    }
    if (on_page > 0 && in_space > 0)
      density = on_page / in_space;
  }
};

/// \brief Where a chart is stretched most, for a view of it: the place, the direction to look from, and the
/// radius of the chart about that place.
struct Worst_spot
{
  Index chart = no_index;
  std::array<double, 3> center{}, normal{};
  double radius = 0;
};

/// The worst spots of the charts that are stretched most, worst first. O(n log n).
inline std::vector<Worst_spot> worst_spots(const Report_model& model, const Polygon_soup& soup,
                                           const Atlas_report& report, std::size_t at_most)
{
  std::vector<Worst_spot> spots(report.charts.size());
  if (soup.uv.empty())
    return {};
  const std::vector<double> stretch = face_stretch(measure_distortion(soup), soup.number_of_faces());
  std::vector<double> worst(spots.size(), -1);
  const auto chart = [&](std::size_t t) { return model.charts[model.indices[3 * t]]; };
  const auto point = [&](std::size_t h, std::size_t k) {
    return double(model.positions[3 * model.indices[h] + k]);
  };
  for (std::size_t t = 0; t < model.face.size(); ++t) {
    if (chart(t) < 0)
      continue;
    const auto c = static_cast<std::size_t>(chart(t));
    if (c >= spots.size() || !(stretch[model.face[t]] > worst[c]))
      continue;
    worst[c] = stretch[model.face[t]];
    spots[c].chart = static_cast<Index>(c);
    const std::array<double, 3> n = model.normal(t);
    const double length = std::max(std::hypot(n[0], n[1], n[2]), 1e-300);
    for (std::size_t k = 0; k < 3; ++k) {
      spots[c].normal[k] = n[k] / length;
      spots[c].center[k] = (point(3 * t, k) + point(3 * t + 1, k) + point(3 * t + 2, k)) / 3;
    }
  }
  for (std::size_t h = 0; h < model.indices.size(); ++h)
    if (const float c = chart(h / 3); c >= 0 && static_cast<std::size_t>(c) < spots.size()) {
      Worst_spot& spot = spots[static_cast<std::size_t>(c)];
      spot.radius =
          std::max(spot.radius, std::hypot(point(h, 0) - spot.center[0], point(h, 1) - spot.center[1],
                                           point(h, 2) - spot.center[2]));
    }
  std::erase_if(spots, [](const Worst_spot& s) { return s.chart == no_index; });
  std::stable_sort(spots.begin(), spots.end(),
                   [&](const Worst_spot& a, const Worst_spot& b) { return worst[a.chart] > worst[b.chart]; });
  spots.resize(std::min(spots.size(), at_most));
  return spots;
}

} // namespace Atlas::internal

#endif
