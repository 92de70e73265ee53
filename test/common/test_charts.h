// SPDX-License-Identifier: MIT
// Flat charts made by formula, for the tests of packing.
#ifndef ATLAS_TEST_CHARTS_H
#define ATLAS_TEST_CHARTS_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Packing.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

namespace Atlas::test {

/// A chart that lies in the plane already.
inline Chart flat_chart(std::vector<Point_2> uv, std::vector<std::array<Index, 3>> triangles)
{
  Chart chart;
  for (const Point_2& p : uv)
    chart.points.emplace_back(p.x(), p.y(), 0);
  chart.uv = std::move(uv);
  chart.triangles = std::move(triangles);
  for (Index t = 0; t < chart.triangles.size(); ++t)
    chart.source.push_back(t);
  return chart;
}

/// A fan about the origin of a border given in polar coordinates, r(t) > 0 for t in [0, 1).
inline Chart star_chart(Index n, const std::function<double(double)>& r)
{
  std::vector<Point_2> uv{Point_2(0, 0)};
  std::vector<std::array<Index, 3>> triangles;
  for (Index i = 0; i < n; ++i) {
    const double t = double(i) / n;
    uv.emplace_back(r(t) * std::cos(2 * M_PI * t), r(t) * std::sin(2 * M_PI * t));
    triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
  }
  return flat_chart(std::move(uv), std::move(triangles));
}

/// A band between the curves a(t) and b(t), t in [0, 1], b on the left of a; `closed` glues its ends.
inline Chart band_chart(Index n, const std::function<Point_2(double)>& a,
                        const std::function<Point_2(double)>& b, bool closed = false)
{
  std::vector<Point_2> uv;
  std::vector<std::array<Index, 3>> triangles;
  for (Index i = 0; i < (closed ? n : n + 1); ++i) {
    uv.push_back(a(double(i) / n));
    uv.push_back(b(double(i) / n));
  }
  const Index m = static_cast<Index>(uv.size());
  for (Index i = 0; i < n; ++i) {
    const Index p = 2 * i, q = (2 * i + 2) % m;
    triangles.push_back({p, q, p + 1});
    triangles.push_back({q, q + 1, p + 1});
  }
  return flat_chart(std::move(uv), std::move(triangles));
}

inline Chart rectangle_chart(double width, double height)
{
  return band_chart(
      1, [=](double t) { return Point_2(t * width, 0); },
      [=](double t) { return Point_2(t * width, height); });
}

inline Chart ring_chart(double inner, double outer, Index n = 32)
{
  const auto circle = [](double r) {
    return [r](double t) { return Point_2(r * std::cos(2 * M_PI * t), r * std::sin(2 * M_PI * t)); };
  };
  return band_chart(n, circle(outer), circle(inner), true);
}

inline Chart spiral_chart(double turns, double width, Index n = 64)
{
  const auto spiral = [=](double offset) {
    return [=](double t) {
      const double r = 2 * width + 2.5 * width * turns * t + offset, angle = 2 * M_PI * turns * t;
      return Point_2(r * std::cos(angle), r * std::sin(angle));
    };
  };
  return band_chart(n, spiral(width), spiral(0));
}

/// A round piece with a wavy border, of about the given radius.
inline Chart blob_chart(std::mt19937& random, double radius, Index n = 40)
{
  std::vector<double> phase, amplitude;
  for (int k = 0; k < 5; ++k) {
    phase.push_back(static_cast<double>(random() % 6283) / 1000);
    amplitude.push_back(static_cast<double>(random() % 1000) / 1000 * 0.35 / (1 + k));
  }
  return star_chart(n, [=](double t) {
    double r = 1;
    for (int k = 0; k < 5; ++k)
      r += amplitude[k] * std::sin(2 * M_PI * (k + 2) * t + phase[k]);
    return radius * std::max(r, 0.15);
  });
}

/// The families of chart sets that packers are tested on.
enum class Chart_family { blobs, needles, rings, spirals, one_huge_many_tiny, degenerate, mixed };
inline constexpr Chart_family all_chart_families[] = {Chart_family::blobs,
                                                      Chart_family::needles,
                                                      Chart_family::rings,
                                                      Chart_family::spirals,
                                                      Chart_family::one_huge_many_tiny,
                                                      Chart_family::degenerate,
                                                      Chart_family::mixed};

inline Chart random_chart(Chart_family family, std::mt19937& random, std::size_t i)
{
  const double size = 0.1 + static_cast<double>(random() % 1000) / 1000;
  switch (family) {
  case Chart_family::blobs:
    return blob_chart(random, size);
  case Chart_family::needles:
    return rectangle_chart(size * 4, 1e-3 * static_cast<double>(random() % 50));
  case Chart_family::rings:
    return ring_chart(size * 0.8, size);
  case Chart_family::spirals:
    return spiral_chart(1 + static_cast<double>(random() % 3), 0.1 * size);
  case Chart_family::one_huge_many_tiny:
    return blob_chart(random, i == 0 ? 10 : 0.2 * size, i == 0 ? 200 : 12);
  case Chart_family::degenerate:
    return i % 3 == 0   ? flat_chart({{0, 0}, {0, 0}, {0, 0}}, {{0, 1, 2}})
           : i % 3 == 1 ? flat_chart({{0, 0}, {size, size}, {2 * size, 2 * size}}, {{0, 1, 2}})
                        : rectangle_chart(size, size);
  case Chart_family::mixed:
    break;
  }
  return random_chart(all_chart_families[random() % 6], random, i + 1);
}

inline std::vector<Chart> random_charts(Chart_family family, unsigned seed, std::size_t n)
{
  std::mt19937 random(seed);
  std::vector<Chart> charts;
  for (std::size_t i = 0; i < n; ++i)
    charts.push_back(random_chart(family, random, i));
  return charts;
}

/// Sum of the areas of the charts on the page, as a fraction of the page.
inline double efficiency(const std::vector<Chart>& charts, const Packing& packing, const Page_options& page)
{
  double area = 0;
  for (const Chart& chart : charts)
    for (const auto& [a, b, c] : chart.triangles)
      area += std::abs(CGAL::to_double(CGAL::area(chart.uv[a], chart.uv[b], chart.uv[c])));
  return area * packing.density * packing.density / (double(page.width) * page.height);
}

} // namespace Atlas::test

#endif
