// SPDX-License-Identifier: MIT
// What a packing has to be, checked triangle by triangle without any help of the packers: on the coordinates
// as they are stored, in rational arithmetic wherever double precision leaves a doubt.
#ifndef ATLAS_PACKING_CHECKS_H
#define ATLAS_PACKING_CHECKS_H

#include <CGAL/Exact_rational.h>

#include "packing_cases.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

namespace Atlas::test {

/// A triangle on the page, in texels: products of a float and a small integer, which doubles hold exactly.
struct Stored_triangle
{
  std::array<Point_2, 3> corners;
  std::array<double, 2> low, high;
};

using Stored_chart = std::vector<Stored_triangle>;

/// A point of the page after it has been divided by the size of the page and rounded to a float.
inline Point_2 as_stored(const Point_2& texel, const Page_options& page)
{
  const double u = static_cast<float>(texel.x() / page.width),
               v = static_cast<float>(texel.y() / page.height);
  return Point_2(u * page.width, v * page.height);
}

inline Stored_chart stored_chart(const Chart& chart, const Placement& placement, const Page_options& page)
{
  Stored_chart result;
  for (const auto& triangle : chart.triangles) {
    Stored_triangle t;
    for (int i = 0; i < 3; ++i)
      t.corners[i] = as_stored(placement(chart.uv[triangle[i]]), page);
    for (int k = 0; k < 2; ++k) {
      t.low[k] = std::min({t.corners[0][k], t.corners[1][k], t.corners[2][k]});
      t.high[k] = std::max({t.corners[0][k], t.corners[1][k], t.corners[2][k]});
    }
    result.push_back(t);
  }
  return result;
}

template <typename Number>
Number squared_distance_of(const Point_2& p, const Point_2& a, const Point_2& b)
{
  const Number ax(a.x()), ay(a.y()), dx = Number(b.x()) - ax, dy = Number(b.y()) - ay;
  const Number px = Number(p.x()) - ax, py = Number(p.y()) - ay, l = dx * dx + dy * dy;
  Number t = l > 0 ? Number((px * dx + py * dy) / l) : Number(0);
  if (t < 0)
    t = 0;
  if (t > 1)
    t = 1;
  const Number ex = px - t * dx, ey = py - t * dy;
  return ex * ex + ey * ey;
}

/// Whether triangles, also such without an area, have a point in common: some line along an edge of one
/// separates them strictly, or a line across the edge of a degenerate one does; else they meet.
inline bool have_common_point(const Stored_triangle& s, const Stored_triangle& t)
{
  const auto on_edge = [](const Point_2& p, const Point_2& a, const Point_2& b) {
    return std::min(a.x(), b.x()) <= p.x() && p.x() <= std::max(a.x(), b.x()) &&
           std::min(a.y(), b.y()) <= p.y() && p.y() <= std::max(a.y(), b.y());
  };
  const auto cross = [&](const Point_2& a, const Point_2& b, const Point_2& c, const Point_2& d) {
    const int o[4] = {CGAL::orientation(a, b, c), CGAL::orientation(a, b, d), CGAL::orientation(c, d, a),
                      CGAL::orientation(c, d, b)};
    return (o[0] * o[1] < 0 && o[2] * o[3] < 0) || (o[0] == 0 && on_edge(c, a, b)) ||
           (o[1] == 0 && on_edge(d, a, b)) || (o[2] == 0 && on_edge(a, c, d)) ||
           (o[3] == 0 && on_edge(b, c, d));
  };
  const auto holds = [](const Stored_triangle& outer, const Point_2& p) {
    const auto& [a, b, c] = outer.corners;
    const int turn = CGAL::orientation(a, b, c);
    return turn != 0 && CGAL::orientation(a, b, p) * turn >= 0 && CGAL::orientation(b, c, p) * turn >= 0 &&
           CGAL::orientation(c, a, p) * turn >= 0;
  };
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      if (cross(s.corners[i], s.corners[(i + 1) % 3], t.corners[k], t.corners[(k + 1) % 3]))
        return true;
  return holds(s, t.corners[0]) || holds(t, s.corners[0]);
}

template <typename Number>
Number squared_distance_of(const Stored_triangle& s, const Stored_triangle& t)
{
  Number least = squared_distance_of<Number>(s.corners[0], t.corners[0], t.corners[1]);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      least =
          std::min(least, squared_distance_of<Number>(s.corners[i], t.corners[k], t.corners[(k + 1) % 3]));
      least =
          std::min(least, squared_distance_of<Number>(t.corners[k], s.corners[i], s.corners[(i + 1) % 3]));
    }
  return least;
}

/// Whether two charts meet, or are nearer than `gutter`.
inline bool are_too_near(const Stored_chart& a, const Stored_chart& b, double gutter)
{
  for (const Stored_triangle& s : a)
    for (const Stored_triangle& t : b) {
      const double apart =
          std::max({s.low[0] - t.high[0], t.low[0] - s.high[0], s.low[1] - t.high[1], t.low[1] - s.high[1]});
      if (apart > gutter)
        continue;
      if (have_common_point(s, t))
        return true;
      if (squared_distance_of<double>(s, t) > gutter * gutter * (1 + 1e-9) + 1e-9)
        continue;
      using Rational = CGAL::Exact_rational;
      if (squared_distance_of<Rational>(s, t) < Rational(gutter) * Rational(gutter))
        return true;
    }
  return false;
}

/// Whether the corners of both charts lie in the same places, to rounding and to what copies may differ by.
/// Of charts that are symmetric the triangles may differ.
inline bool are_stacked(const Stored_chart& a, const Stored_chart& b)
{
  double size = 0;
  for (const Stored_triangle& t : a)
    size = std::max({size, t.high[0] - a[0].low[0], a[0].high[0] - t.low[0], t.high[1] - a[0].low[1],
                     a[0].high[1] - t.low[1]});
  const double tolerance = 1e-3 * size + 1e-4;
  const auto is_corner_of = [&](const Stored_chart& chart, const Point_2& p) {
    return std::any_of(chart.begin(), chart.end(), [&](const Stored_triangle& t) {
      return std::any_of(t.corners.begin(), t.corners.end(), [&](const Point_2& q) {
        return CGAL::squared_distance(p, q) <= tolerance * tolerance;
      });
    });
  };
  const auto is_within = [&](const Stored_chart& inner, const Stored_chart& outer) {
    return std::all_of(inner.begin(), inner.end(), [&](const Stored_triangle& t) {
      return std::all_of(t.corners.begin(), t.corners.end(),
                         [&](const Point_2& p) { return is_corner_of(outer, p); });
    });
  };
  return is_within(a, b) && is_within(b, a);
}

/// Collects what is wrong with a packing, in words.
class Packing_checker
{
public:
  Packing_checker(const Packing_case& c, const Packing& packing)
      : charts_(c.charts), page_(c.page), packing_(packing)
  {}

  /// Empty if all is well.
  std::string operator()()
  {
    check_numbers();
    if (packing_.number_of_pages == 0 || !wrong_.str().empty())
      return wrong_.str();
    for (Index i = 0; i < charts_.size(); ++i)
      stored_.push_back(stored_chart(charts_[i], packing_.placements[i], page_));
    for (Index i = 0; i < charts_.size(); ++i) {
      check_shape(i);
      check_border(i);
      for (Index j = 0; j < i; ++j)
        check_pair(j, i);
    }
    return wrong_.str();
  }

private:
  bool is_locked(Index i) const { return i < page_.locked.size() && page_.locked[i]; }

  double weight(Index i) const
  {
    if (is_locked(i))
      return 0;
    for (Index k = 0; k < page_.groups.size(); ++k) // a group has the weight of its first chart
      if (page_.groups[k] != no_index && page_.groups[k] == page_.groups[i] && !is_locked(k))
        return k < page_.weights.size() ? page_.weights[k] : 1;
    return i < page_.weights.size() ? page_.weights[i] : 1;
  }

  void check_numbers()
  {
    if (packing_.placements.size() != charts_.size())
      wrong_ << "charts are lost; ";
    if (!charts_.empty() && packing_.number_of_pages == 0 && page_.locked.empty())
      wrong_ << "no packing; ";
    if (page_.density == 0 && page_.locked.empty() && packing_.number_of_pages > page_.pages)
      wrong_ << "too many pages; ";
    const double asked = std::max({page_.gutter, page_.mip_levels > 0 ? std::pow(2.0, page_.mip_levels) : 0,
                                   page_.block > 1 ? page_.block * std::sqrt(2.0) : 0});
    const double needed = static_cast<double>(charts_.size()) * asked * asked * 9;
    const double least = needed < double(page_.width) * page_.height ? asked * (1 - 1e-12) : 0;
    if (packing_.number_of_pages > 0 && !(packing_.gutter >= least && packing_.gutter <= asked))
      wrong_ << "a gutter of " << packing_.gutter << " instead of " << asked << "; ";
    for (const Placement& p : packing_.placements)
      if (packing_.number_of_pages > 0 && p.page >= packing_.number_of_pages)
        wrong_ << "a page that is none; ";
  }

  /// Turned as allowed, scaled as all, not mirrored, and so on the page as it is stored.
  void check_shape(Index i)
  {
    const Placement& p = packing_.placements[i];
    if (is_locked(i)) {
      const Placement& l = *page_.locked[i];
      if (!(p.a == l.a && p.b == l.b && p.x == l.x && p.y == l.y && p.page == l.page &&
            p.is_mirrored == l.is_mirrored))
        wrong_ << "locked chart " << i << " has moved; ";
      return;
    }
    const double scale = weight(i) * packing_.density;
    if (!(std::abs(std::hypot(p.a, p.b) - scale) <= 1e-9 * scale))
      wrong_ << "chart " << i << " has density " << std::hypot(p.a, p.b) << " instead of " << scale << "; ";
    const bool is_free = page_.rotation == Chart_rotation::aligned || page_.rotation == Chart_rotation::any ||
                         page_.stacking != Chart_stacking::none;
    const bool is_turned =
        page_.rotation == Chart_rotation::none ? p.b != 0 || p.a < 0 : p.a != 0 && p.b != 0;
    if (!is_free && is_turned) // copies turn until they lie on their model
      wrong_ << "chart " << i << " is turned; ";
    if (p.is_mirrored && page_.stacking != Chart_stacking::copies_and_mirrored)
      wrong_ << "chart " << i << " is mirrored; ";
    check_lengths(i, scale);
  }

  /// Edges keep their lengths, and triangles their sides, as far as rounding can tell.
  void check_lengths(Index i, double scale)
  {
    const Chart& chart = charts_[i];
    const double error = std::max(page_.width, page_.height) * 0x1p-22;
    for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
      const auto& corners = stored_[i][t].corners;
      const auto old = [&](Index k) { return chart.uv[chart.triangles[t][k]]; };
      double reach = 1;
      for (Index k = 0; k < 3; ++k) {
        const double before = scale * std::sqrt(CGAL::squared_distance(old(k), old((k + 1) % 3)));
        const double after = std::sqrt(CGAL::squared_distance(corners[k], corners[(k + 1) % 3]));
        reach = std::max(reach, before);
        if (!(std::abs(before - after) <= error + 1e-9 * before)) {
          wrong_ << "an edge of chart " << i << " measures " << after << " instead of " << before << "; ";
          return;
        }
      }
      const double sign = packing_.placements[i].is_mirrored ? -1 : 1;
      const double before = sign * scale * scale * CGAL::area(old(0), old(1), old(2));
      const double after = CGAL::area(corners[0], corners[1], corners[2]);
      if (!(std::abs(before - after) <= 4 * error * reach + 1e-9 * std::abs(before))) {
        wrong_ << "a triangle of chart " << i << " has area " << after << " instead of " << before << "; ";
        return;
      }
    }
  }

  void check_border(Index i)
  {
    const double half = packing_.gutter / 2;
    for (const Stored_triangle& t : stored_[i])
      if (!is_locked(i) && !(t.low[0] >= half && t.low[1] >= half && page_.width - t.high[0] >= half &&
                             page_.height - t.high[1] >= half)) {
        wrong_ << "chart " << i << " is too near to the border; ";
        return;
      }
  }

  void check_pair(Index i, Index j)
  {
    const Placement &p = packing_.placements[i], &q = packing_.placements[j];
    if (is_locked(i) && is_locked(j))
      return;
    if (!is_locked(i) && !is_locked(j) && i < page_.groups.size() && page_.groups[i] != no_index &&
        page_.groups[i] == page_.groups[j]) {
      if (!(p.a == q.a && p.b == q.b && p.x == q.x && p.y == q.y && p.page == q.page))
        wrong_ << "charts " << i << " and " << j << " are no group; ";
      return;
    }
    if (p.page != q.page || (page_.stacking != Chart_stacking::none && are_stacked(stored_[i], stored_[j])))
      return;
    if (are_too_near(stored_[i], stored_[j], packing_.gutter))
      wrong_ << "charts " << i << " and " << j << " are too near; ";
  }

  const std::vector<Chart>& charts_;
  const Page_options& page_;
  const Packing& packing_;
  std::vector<Stored_chart> stored_;
  std::ostringstream wrong_;
};

inline bool are_equal(const Packing& a, const Packing& b)
{
  return a.density == b.density && a.gutter == b.gutter && a.number_of_pages == b.number_of_pages &&
         std::equal(a.placements.begin(), a.placements.end(), b.placements.begin(), b.placements.end(),
                    [](const Placement& p, const Placement& q) {
                      return p.a == q.a && p.b == q.b && p.x == q.x && p.y == q.y && p.page == q.page &&
                             p.is_mirrored == q.is_mirrored;
                    });
}

} // namespace Atlas::test

#endif
