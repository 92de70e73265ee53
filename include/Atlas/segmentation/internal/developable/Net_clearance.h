// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_NET_CLEARANCE_H
#define ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_NET_CLEARANCE_H

#include <Atlas/planar/internal/segments.h>
#include <Atlas/planar/internal/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// An axis-parallel box.
struct Planar_box
{
  double low_x = HUGE_VAL, high_x = -HUGE_VAL, low_y = HUGE_VAL, high_y = -HUGE_VAL;

  void add(Vec2 p)
  {
    low_x = std::min(low_x, p.x);
    high_x = std::max(high_x, p.x);
    low_y = std::min(low_y, p.y);
    high_y = std::max(high_y, p.y);
  }
  void add(const Planar_box& o)
  {
    low_x = std::min(low_x, o.low_x);
    high_x = std::max(high_x, o.high_x);
    low_y = std::min(low_y, o.low_y);
    high_y = std::max(high_y, o.high_y);
  }
  bool meets(const Planar_box& o, double margin) const
  {
    return low_x <= o.high_x + margin && o.low_x <= high_x + margin && low_y <= o.high_y + margin &&
           o.low_y <= high_y + margin;
  }
};

/// Whether `is_found(x, y)` for some x of `left` and y of `right` whose boxes come nearer than `gap`. Sorts
/// `right`. O((n + m) log m + k) for k pairs whose boxes share an x.
template <typename Boxed, typename IsFound>
bool any_meeting(const std::vector<Boxed>& left, std::vector<Boxed>& right, double gap, IsFound is_found)
{
  std::sort(right.begin(), right.end(),
            [](const Boxed& x, const Boxed& y) { return x.box.low_x < y.box.low_x; });
  double widest = 0;
  for (const Boxed& y : right)
    widest = std::max(widest, y.box.high_x - y.box.low_x);
  for (const Boxed& x : left) {
    auto y = std::lower_bound(right.begin(), right.end(), x.box.low_x - widest - gap,
                              [](const Boxed& i, double v) { return i.box.low_x < v; });
    for (; y != right.end() && y->box.low_x <= x.box.high_x + gap; ++y)
      if (x.box.meets(y->box, gap) && is_found(x, *y))
        return true;
  }
  return false;
}

/// Whether an edge of the convex polygon `x`, counterclockwise, has all of `y` beyond it, at least `gap`
/// away.
inline bool does_edge_keep_off(const std::vector<Vec2>& x, const std::vector<Vec2>& y, double gap)
{
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec2 a = x[i], d = x[(i + 1) % x.size()] - a;
    const double least = gap * length(d);
    if (least > 0 && std::all_of(y.begin(), y.end(), [&](Vec2 p) { return cross(d, p - a) <= -least; }))
      return true;
  }
  return false;
}

/// A triangle of a net, counterclockwise.
struct Flat_triangle
{
  std::array<Vec2, 3> p;
  std::array<bool, 3> is_border; ///< per edge
  Planar_box box;
};

/// \brief Whether parts of a net keep off each other.
///
/// They must not overlap, and their borders keep a gap, but for wedges at the vertices where they are glued.
/// What falls together only in the plane would not survive the rounding of coordinates.
class Net_clearance
{
public:
  /// \param gap    least distance of borders
  /// \param noise  depth up to which triangles overlap by rounding only
  explicit Net_clearance(double gap = 0, double noise = 0) : gap_(gap), noise_(noise) {}

  double gap() const { return gap_; }

  /// \param welded  the ends of the edges along which the two are glued
  bool do_collide(const std::vector<Flat_triangle>& left, std::vector<Flat_triangle> right,
                  const std::vector<Vec2>& welded) const
  {
    return any_meeting(left, right, gap_, [&](const Flat_triangle& s, const Flat_triangle& t) {
      if (s.box.meets(t.box, 0) && do_overlap(s.p, t.p))
        return true;
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
          if (s.is_border[i] && t.is_border[k] &&
              is_too_near({s.p[i], s.p[(i + 1) % 3]}, {t.p[k], t.p[(k + 1) % 3]}, welded))
            return true;
      return false;
    });
  }

private:
  using Segment = std::array<Vec2, 2>;

  bool do_overlap(const std::array<Vec2, 3>& s, const std::array<Vec2, 3>& t) const
  {
    return !does_edge_separate(s, t) && !does_edge_separate(t, s);
  }

  /// Whether `y` lies outside of an edge of `x`.
  bool does_edge_separate(const std::array<Vec2, 3>& x, const std::array<Vec2, 3>& y) const
  {
    for (int i = 0; i < 3; ++i) {
      const Vec2 a = x[i], d = x[(i + 1) % 3] - a;
      const double l = length(d);
      if (std::all_of(y.begin(), y.end(), [&](Vec2 p) { return cross(d, p - a) <= noise_ * l; }))
        return true;
    }
    return false;
  }

  static std::pair<double, Vec2> distance(Vec2 p, const Segment& s)
  {
    return {std::sqrt(squared_distance(p, s[0], s[1])), p};
  }

  /// Whether two edges of borders come nearer than the gap, or, beside a vertex that is glued, than a narrow
  /// wedge.
  bool is_too_near(const Segment& s, const Segment& t, const std::vector<Vec2>& welded) const
  {
    constexpr double narrow_wedge = 0.02;
    const auto [d, at] =
        std::min({distance(s[0], t), distance(s[1], t), distance(t[0], s), distance(t[1], s)},
                 [](const auto& x, const auto& y) { return x.first < y.first; });
    if (d >= gap_)
      return false;
    double reach = HUGE_VAL;
    for (const Vec2 v : welded)
      reach = std::min(reach, length(v - at));
    if (reach > noise_)
      return d < std::min(gap_, narrow_wedge * reach);
    const Vec2 vertex = at; // the common one: their other ends tell
    const auto other = [&](const Segment& x) {
      return length(x[0] - vertex) > length(x[1] - vertex) ? x[0] : x[1];
    };
    const Vec2 p = other(s) - vertex, q = other(t) - vertex;
    const double l = length(p) * length(q);
    return l > 0 && dot(p, q) > 0 && std::abs(cross(p, q)) < narrow_wedge * l;
  }

  double gap_, noise_;
};

} // namespace Atlas::internal

#endif
