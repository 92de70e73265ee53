// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_PAGES_SINGLE_LAYOUT_H
#define ATLAS_PACKING_INTERNAL_PAGES_SINGLE_LAYOUT_H

#include <Atlas/packing/Page_packer.h>
#include <Atlas/packing/internal/pages/Layout.h>
#include <Atlas/planar/internal/convex_hull.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief The turn in which a convex polygon fits a rectangle at the largest scale.
///
/// Between two turns that lay an edge along an axis, the width and the height of the box around the polygon
/// are those of two fixed diagonals, as concave functions of the turn. So the larger of the two, each over
/// its side of the rectangle, is least at such a turn or where both are equal. O(n log n).
class Best_turn
{
public:
  /// \param hull  counterclockwise, as `convex_hull()` gives it, with an area
  Best_turn(const std::vector<Vec2>& hull, double width, double height)
      : hull_(hull), width_(width), height_(height)
  {
    double before = -HUGE_VAL;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Vec2 e = hull[(i + 1) % hull.size()] - hull[i];
      before = std::max(before, std::atan2(e.y, e.x) + (e.x <= 0 && e.y < 0 ? 2 * std::numbers::pi : 0));
      angles_.push_back(before);
    }
  }

  /// Any turn.
  Vec2 operator()()
  {
    constexpr double quarter = std::numbers::pi / 2;
    std::vector<double> turns;
    for (const double a : angles_)
      for (int k = 0; k < 2; ++k)
        turns.push_back(positive_remainder(k * quarter - a, 2 * quarter));
    std::sort(turns.begin(), turns.end());
    turns.push_back(turns.front() + 2 * quarter);
    for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
      offer(turns[i]);
      offer_crossing(turns[i], turns[i + 1]);
    }
    return best_;
  }

  /// Multiples of 90 degrees.
  Vec2 quarter_turn()
  {
    offer(Vec2{1, 0});
    offer(Vec2{0, 1});
    return best_;
  }

  /// Those that a chart may make.
  Vec2 turn(Chart_rotation rotation)
  {
    if (rotation == Chart_rotation::none) {
      offer(Vec2{1, 0});
      return best_;
    }
    return rotation == Chart_rotation::quarter_turns ? quarter_turn() : (*this)();
  }

  /// The largest scale, of the turns that have been looked at.
  double scale() const { return 1 / size_; }

private:
  static double positive_remainder(double x, double period) { return x - period * std::floor(x / period); }

  /// The point of the hull that is farthest in the direction of an angle.
  Vec2 farthest(double angle) const
  {
    const double edge = angles_.front() + positive_remainder(angle + std::numbers::pi / 2 - angles_.front(),
                                                             2 * std::numbers::pi);
    const auto next = std::lower_bound(angles_.begin(), angles_.end(), edge);
    return hull_[static_cast<std::size_t>(next - angles_.begin()) % hull_.size()];
  }

  /// The diagonals that tell width and height of the box after a turn.
  std::pair<Vec2, Vec2> diagonals(double turn) const
  {
    using std::numbers::pi;
    return {farthest(-turn) - farthest(pi - turn), farthest(pi / 2 - turn) - farthest(-pi / 2 - turn)};
  }

  void offer(double turn) { offer(Vec2{std::cos(turn), std::sin(turn)}, diagonals(turn)); }
  void offer(Vec2 turn) { offer(turn, diagonals(std::atan2(turn.y, turn.x))); }
  void offer(Vec2 turn, const std::pair<Vec2, Vec2>& d)
  {
    const double size = std::max(rotated(turn, d.first).x / width_, rotated(turn, d.second).y / height_);
    if (size < size_) {
      size_ = size;
      best_ = turn;
    }
  }

  /// The turn between two others at which width and height are equal shares of the sides.
  void offer_crossing(double first, double last)
  {
    const auto d = diagonals((first + last) / 2);
    const Vec2 p = (1 / width_) * d.first, q = (1 / height_) * d.second;
    const double turn = std::atan2(p.x - q.y, p.y + q.x); // p.x cos - p.y sin = q.y cos + q.x sin
    const double after = positive_remainder(turn - first, std::numbers::pi);
    if (after < last - first)
      offer(first + after);
  }

  const std::vector<Vec2>& hull_;
  double width_, height_;
  std::vector<double> angles_; ///< of the edges, increasing
  Vec2 best_{1, 0};
  double size_ = HUGE_VAL;
};

/// The largest scale at which a convex polygon fits a rectangle, in any turn. \see `Best_turn`
inline double largest_scale_alone(const std::vector<Vec2>& hull, double width, double height)
{
  Best_turn turns(hull, width, height);
  turns();
  return turns.scale();
}

/// The largest scale at which each outline fits the page alone, within its margin: no layout has a larger
/// one.
inline double largest_scale_alone(const Outlines& outlines, const Page_task& page, double margin)
{
  const double width = page.width - 2 * margin, height = page.height - 2 * margin;
  double scale = HUGE_VAL;
  for (const Outline& outline : outlines.charts)
    if (const std::vector<Vec2> hull = convex_hull(outline.points); hull.size() > 2) {
      Best_turn turns(hull, width, height);
      turns.turn(outline.rotation);
      scale = std::min(scale, turns.scale());
    }
  return scale;
}

/// The layout of the only outline of a page, at the largest scale there is, at most the one wanted; nothing
/// if the page has no room for its margin.
inline std::optional<Layout> single_layout(const Outline& outline, const Page_task& page)
{
  const double width = page.width - 2 * page.margin, height = page.height - 2 * page.margin;
  const std::vector<Vec2> hull = convex_hull(outline.points);
  if (!(width > 0 && height > 0) || hull.size() < 3)
    return std::nullopt;
  Best_turn turns(hull, width, height);
  const Vec2 turn = turns.turn(outline.rotation);
  Vec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  for (const Vec2& p : outline.points) {
    const Vec2 q = rotated(turn, p);
    low = {std::min(low.x, q.x), std::min(low.y, q.y)};
    high = {std::max(high.x, q.x), std::max(high.y, q.y)};
  }
  const double scale = std::min({width / (high.x - low.x), height / (high.y - low.y), page.most_scale});
  return Layout{scale, page.margin, {turn}, {Vec2{page.margin, page.margin} - scale * low}};
}

} // namespace Atlas::internal

#endif
