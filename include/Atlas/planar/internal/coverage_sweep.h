// SPDX-License-Identifier: MIT
#ifndef ATLAS_PLANAR_INTERNAL_COVERAGE_SWEEP_H
#define ATLAS_PLANAR_INTERNAL_COVERAGE_SWEEP_H

#include <Atlas/core/Kernel.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Decides whether a set of counterclockwise triangles covers any point of the plane twice, from their border
/// alone.
///
/// An edge that two triangles have in common, once in each direction, says nothing. The edges that are left
/// are the border, and how often a point is covered is how often the border winds around it. A vertical line
/// sweeps over these edges from left to right (Shamos and Hoey 1976) and knows, from bottom to top, how often
/// the gaps between them are covered: more than once ends the sweep. So do two edges that cross, since next
/// to the crossing there are points that are covered twice. Therefore no crossing is ever computed: all
/// decisions are orientation predicates and comparisons of given coordinates, and exact.
///
/// Edges that touch or lie on each other do not cross. They are cut at the given end points that lie on them,
/// and equal pieces are added up. So triangles that only touch cover nothing twice.
///
/// O(n log n) for n edges.
class Coverage_sweep
{
public:
  /// Adds an edge of a triangle; the triangle lies to the left. Coordinates are finite.
  void add(const Point_2& from, const Point_2& to)
  {
    if (from != to) {
      ends_.push_back(from);
      ends_.push_back(to);
    }
  }

  /// How many edges have been added.
  std::size_t size() const { return ends_.size() / 2; }

  /// Whether no point is covered twice. The edges added must bound triangles, whole ones.
  bool is_covered_at_most_once()
  {
    number_points();
    Status status{Order{&points_}};
    for (Index v = 0; v < points_.size(); ++v)
      if (!advance(status, v))
        return false;
    return true;
  }

private:
  /// Runs from the lexicographically smaller to the larger point; `weight` is how much more is covered on its
  /// left ("above") than on its right.
  struct Segment
  {
    Index from, to;
    int weight;
    int above; ///< how often points right above are covered
  };
  /// Segments that start at a point, as linked lists: cutting makes new ones on the way.
  struct Start
  {
    Index to;
    int weight;
    Index next;
  };

  /// From bottom to top along the sweep line, which is thought to lean over by an infinitesimal angle.
  struct Order
  {
    const std::vector<Point_2>* points;
    using is_transparent = void;

    CGAL::Orientation side(const Segment& s, Index v) const
    {
      return s.from == v || s.to == v ? CGAL::COLLINEAR
                                      : CGAL::orientation((*points)[s.from], (*points)[s.to], (*points)[v]);
    }
    bool operator()(const Segment& s, Index v) const { return side(s, v) == CGAL::LEFT_TURN; }
    bool operator()(Index v, const Segment& s) const { return side(s, v) == CGAL::RIGHT_TURN; }
    bool operator()(const Segment& s, const Segment& t) const
    {
      if (s.from == t.from)
        return side(s, t.to) == CGAL::LEFT_TURN;
      return s.from < t.from ? side(s, t.from) == CGAL::LEFT_TURN : side(t, s.from) == CGAL::RIGHT_TURN;
    }
  };
  using Status = std::set<Segment, Order>;

  /// Sorts the points, gives equal ones one number, and hangs every edge on its smaller end.
  void number_points()
  {
    std::vector<std::pair<Point_2, Index>> sorted(ends_.size());
    std::vector<Index> number(ends_.size());
    for (Index e = 0; e < ends_.size(); ++e)
      sorted[e] = {ends_[e], e};
    std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [point, e] : sorted) {
      if (points_.empty() || points_.back() != point)
        points_.push_back(point);
      number[e] = static_cast<Index>(points_.size() - 1);
    }
    first_start_.assign(points_.size(), no_index);
    starts_.reserve(ends_.size() / 2);
    for (std::size_t e = 0; e < ends_.size(); e += 2)
      add_start(std::min(number[e], number[e + 1]), std::max(number[e], number[e + 1]),
                number[e] < number[e + 1] ? 1 : -1);
  }

  void add_start(Index from, Index to, int weight)
  {
    starts_.push_back({to, weight, first_start_[from]});
    first_start_[from] = static_cast<Index>(starts_.size() - 1);
  }

  /// Moves the line over point v. `false`: something is covered twice.
  bool advance(Status& status, Index v)
  {
    auto upper = status.lower_bound(v);
    leaving_.clear();
    while (upper != status.end() && status.key_comp().side(*upper, v) == CGAL::COLLINEAR) {
      if (upper->to != v)
        leaving_.push_back({upper->to, upper->weight, no_index});
      upper = status.erase(upper);
    }
    for (Index s = first_start_[v]; s != no_index; s = starts_[s].next)
      leaving_.push_back(starts_[s]);
    add_up_collinear(v);

    const bool has_lower = upper != status.begin();
    auto lower = has_lower ? std::prev(upper) : status.end();
    int covered = has_lower ? lower->above : 0;
    for (const Start& s : leaving_) {
      covered += s.weight;
      if (covered > 1)
        return false;
      const auto inserted = status.insert(upper, Segment{v, s.to, s.weight, covered});
      if (has_lower && &s == &leaving_.front() && is_crossing(*lower, *inserted))
        return false;
      lower = inserted;
    }
    const bool has_neighbours = upper != status.end() && (has_lower || !leaving_.empty());
    return !has_neighbours || !is_crossing(*lower, *upper);
  }

  /// Sorts the segments that leave v from bottom to top and adds up those that run along each other, as far
  /// as they do; the rest starts at a later point.
  void add_up_collinear(Index v)
  {
    const auto turn = [&](const Start& a, const Start& b) {
      return a.to == b.to ? CGAL::COLLINEAR : CGAL::orientation(points_[v], points_[a.to], points_[b.to]);
    };
    std::sort(leaving_.begin(), leaving_.end(), [&](const Start& a, const Start& b) {
      const CGAL::Orientation o = turn(a, b);
      return o == CGAL::COLLINEAR ? a.to < b.to : o == CGAL::LEFT_TURN;
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < leaving_.size();) {
      Start sum = leaving_[i];
      for (++i; i < leaving_.size() && turn(sum, leaving_[i]) == CGAL::COLLINEAR; ++i) {
        sum.weight += leaving_[i].weight;
        if (leaving_[i].to != sum.to)
          add_start(sum.to, leaving_[i].to, leaving_[i].weight);
      }
      if (sum.weight != 0)
        leaving_[kept++] = sum;
    }
    leaving_.resize(kept);
  }

  /// Whether neighbours cross further on: the one that ends first ends on the wrong side of the other.
  bool is_crossing(const Segment& lower, const Segment& upper) const
  {
    const Order order{&points_};
    if (lower.to == upper.to)
      return false;
    return lower.to < upper.to ? order.side(upper, lower.to) == CGAL::LEFT_TURN
                               : order.side(lower, upper.to) == CGAL::RIGHT_TURN;
  }

  std::vector<Point_2> ends_;   ///< of the edges, two by two
  std::vector<Point_2> points_; ///< all distinct end points, sorted
  std::vector<Index> first_start_;
  std::vector<Start> starts_;
  std::vector<Start> leaving_; ///< scratch
};

} // namespace Atlas::internal

#endif
