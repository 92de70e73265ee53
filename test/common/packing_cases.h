// SPDX-License-Identifier: MIT
// Random sets of charts and random pages, for the property tests of packers.
#ifndef ATLAS_PACKING_CASES_H
#define ATLAS_PACKING_CASES_H

#include "test_charts.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace Atlas::test {

/// Random numbers that are the same on every platform.
class Dice
{
public:
  explicit Dice(unsigned seed) : random_(seed) {}

  std::mt19937& generator() { return random_; }
  Index below(Index n) { return static_cast<Index>(random_() % n); }
  bool one_in(Index n) { return below(n) == 0; }
  double between(double low, double high)
  {
    return low + (high - low) * (static_cast<double>(random_()) * 0x1p-32);
  }
  template <typename T>
  T one_of(std::initializer_list<T> values)
  {
    return values.begin()[below(static_cast<Index>(values.size()))];
  }

private:
  std::mt19937 random_;
};

/// The chart of the cells marked in a picture, `columns` wide; neighbours share their corners.
inline Chart polyomino_chart(const std::string& picture, Index columns, double width, double height)
{
  std::map<std::pair<Index, Index>, Index> corners;
  std::vector<Point_2> uv;
  const auto corner = [&](Index i, Index j) {
    const auto [it, is_new] = corners.try_emplace({i, j}, static_cast<Index>(uv.size()));
    if (is_new)
      uv.emplace_back(i * width, j * height);
    return it->second;
  };
  std::vector<std::array<Index, 3>> triangles;
  for (Index k = 0; k < picture.size(); ++k)
    if (const Index i = k % columns, j = k / columns; picture[k] != '.') {
      const Index a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1), d = corner(i, j + 1);
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  return flat_chart(std::move(uv), std::move(triangles));
}

/// A disc that is open along a slit from its centre to its border.
inline Chart slit_disc_chart(Index n)
{
  Chart chart = star_chart(n, [](double) { return 1.0; });
  chart.uv.push_back(chart.uv[1]);
  chart.points.push_back(chart.points[1]);
  chart.triangles.back()[2] = static_cast<Index>(chart.uv.size() - 1);
  return chart;
}

enum class Shape {
  triangle,
  needle,
  sliver,
  point,
  disc,
  blob,
  ring,
  spiral,
  l_shape,
  u_shape,
  comb,
  frame,
  square_spiral,
  slit,
  folded
};
inline constexpr Index number_of_shapes = 15;

/// A chart that measures about 1.
inline Chart unit_chart(Shape shape, Dice& dice)
{
  const double a = dice.between(0.1, 1), b = dice.between(0.1, 1);
  switch (shape) {
  case Shape::triangle:
    return flat_chart({{0, 0}, {1, 0}, {1.5 * b, a}}, {{0, 1, 2}});
  case Shape::needle:
    return rectangle_chart(1, std::pow(10, dice.between(-5, -1)));
  case Shape::sliver: // no thickness at all
    return flat_chart({{0, 0}, {a, a}, {2 * a, 2 * a}}, {{0, 1, 2}});
  case Shape::point:
    return flat_chart({{a, b}, {a, b}, {a, b}}, {{0, 1, 2}});
  case Shape::disc:
    return star_chart(3 + dice.below(30), [](double) { return 0.5; });
  case Shape::blob:
    return blob_chart(dice.generator(), 0.5, 8 + dice.below(24));
  case Shape::ring:
    return ring_chart(0.5 * dice.between(0.2, 0.99), 0.5, 6 + dice.below(20));
  case Shape::spiral:
    return spiral_chart(1 + dice.below(3), 0.08, 24);
  case Shape::l_shape:
    return polyomino_chart("x..x..xxx", 3, a / 3, b / 3);
  case Shape::u_shape:
    return polyomino_chart("xxxx..x..xxx", 3, a / 3, b / 4);
  case Shape::comb:
    return polyomino_chart("xxxxxxxx.x.x.xx.x.x.x", 7, a / 7, b / 3);
  case Shape::frame:
    return polyomino_chart("xxxxxx.x.xxxxxxx...xxxxxx", 5, a / 5, b / 5);
  case Shape::square_spiral:
    return polyomino_chart("xxxxxx....x.xxxx...xxxxxx", 5, a / 5, b / 5);
  case Shape::slit:
    return slit_disc_chart(8 + dice.below(8));
  case Shape::folded: // the last triangle lies over the others
    return flat_chart({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.9, 0.4}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
  }
  return {};
}

/// The chart after x -> s R x + t, and after a reflection if it is mirrored.
inline Chart moved(const Chart& chart, double s, double angle, double x, double y, bool is_mirrored = false)
{
  const Placement motion{s * std::cos(angle), s * std::sin(angle), x, y, 0, is_mirrored};
  Chart result = chart;
  for (Point_2& p : result.uv)
    p = motion(p);
  if (is_mirrored)
    for (auto& triangle : result.triangles)
      std::swap(triangle[1], triangle[2]);
  return result;
}

struct Packing_case
{
  std::vector<Chart> charts;
  Page_options page;
};

/// Turned and moved by up to `far`.
inline Chart randomly_moved(const Chart& chart, double size, double far, Dice& dice, bool is_mirrored = false)
{
  const double angle = dice.between(0, 7), x = dice.between(-far, far), y = dice.between(-far, far);
  return moved(chart, size, angle, x, y, is_mirrored);
}

inline std::vector<Chart> random_shapes(Dice& dice, Index n)
{
  const bool is_one_kind = dice.one_in(3), has_giant = dice.one_in(5);
  const double decades = dice.one_of({0.0, 0.3, 1.0, 6.0});
  const Index kind = dice.below(number_of_shapes);
  std::vector<Chart> charts;
  for (Index i = 0; i < n; ++i) {
    const Shape shape = static_cast<Shape>(is_one_kind ? kind : dice.below(number_of_shapes));
    const double size = has_giant ? (i == 0 ? 1 : std::pow(10, dice.between(-3, -2)))
                                  : std::pow(10, dice.between(-decades, 0));
    const double far = size * dice.one_of({1.0, 100.0});
    const Chart unit = unit_chart(shape, dice);
    Chart chart = randomly_moved(unit, size, far, dice);
    if (dice.one_in(10)) // drawn clockwise
      for (auto& triangle : chart.triangles)
        std::swap(triangle[1], triangle[2]);
    charts.push_back(std::move(chart));
  }
  return charts;
}

inline Page_options random_page(Dice& dice)
{
  Page_options page;
  page.width = dice.one_in(2) ? 32u << dice.below(4) : 32 + dice.below(250);
  page.height = dice.one_in(2) ? page.width : dice.one_in(2) ? 32u << dice.below(4) : 32 + dice.below(250);
  page.gutter = dice.one_of({0.0, 0.5, 1.0, 2.0, 3.0, 5.5, 8.0, 16.0});
  page.block = dice.one_of({1u, 1u, 4u});
  page.mip_levels = dice.one_in(4) ? dice.below(5) : 0;
  page.rotation = dice.one_of(
      {Chart_rotation::aligned, Chart_rotation::any, Chart_rotation::quarter_turns, Chart_rotation::none});
  while (page.effective_gutter() > 0.2 * std::min(page.width, page.height)) {
    page.gutter /= 2;
    page.mip_levels /= 2;
    page.block = 1;
  }
  return page;
}

/// Some charts are replaced by moved copies of charts before them.
inline void add_copies(Packing_case& c, Dice& dice)
{
  for (Index i = 1; i < c.charts.size(); ++i)
    if (dice.one_in(2)) {
      const bool is_mirrored = c.page.stacking == Chart_stacking::copies_and_mirrored && dice.one_in(2);
      c.charts[i] = randomly_moved(c.charts[dice.below(i)], 1, 1, dice, is_mirrored);
    }
}

/// The charts of a group get places beside each other.
inline void add_groups(Packing_case& c, Dice& dice)
{
  c.page.groups.assign(c.charts.size(), no_index);
  double right[2] = {0, 0};
  for (Index i = 0; i < c.charts.size(); ++i)
    if (const Index group = dice.below(3); group < 2) {
      double low = HUGE_VAL, high = -HUGE_VAL;
      for (const Point_2& p : c.charts[i].uv) {
        low = std::min(low, p.x());
        high = std::max(high, p.x());
      }
      c.charts[i] = moved(c.charts[i], 1, 0, right[group] - low, 0);
      right[group] += 1.1 * (high - low);
      c.page.groups[i] = 40 + group;
    }
}

/// The same for the same seed: one page or several, and in every other case one of the further controls.
inline Packing_case random_packing_case(unsigned seed)
{
  Dice dice(seed);
  Packing_case c;
  const Index n = dice.one_in(12) ? 0 : dice.one_in(8) ? 10 + dice.below(15) : 1 + dice.below(7);
  c.charts = random_shapes(dice, n);
  c.page = random_page(dice);
  c.page.pages = dice.one_in(3) ? 1 + dice.below(4) : 1;
  switch (dice.below(6)) {
  case 0:
    for (Index i = 0; i < n; ++i)
      c.page.weights.push_back(dice.one_of({1.0, 0.25, 2.0, 1.7}));
    break;
  case 1:
    add_groups(c, dice);
    break;
  case 2:
    c.page.stacking = dice.one_of({Chart_stacking::copies, Chart_stacking::copies_and_mirrored});
    add_copies(c, dice);
    break;
  default:
    break;
  }
  return c;
}

} // namespace Atlas::test

#endif
