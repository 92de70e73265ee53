// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_NET_BUILDER_H
#define ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_NET_BUILDER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/internal/Union_find.h>
#include <Atlas/segmentation/internal/developable/Net_placement.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// What a net may look like.
struct Net_style
{
  double waste_price = 1;  ///< what area between a net and its bounding rectangle costs against seam length
  double page_share = 0.7; ///< no net is larger than a page that all nets fill to this share
  unsigned variation = 0;  ///< other than 0: arcs count up to a third more or less, in a way of its own
};

/// \brief Glues facets along edges as long as they lie side by side in the plane: nets, as of paper models.
///
/// Each net is a set of facets with a rigid motion each. Two nets are glued along the arc between two of
/// their facets; every other edge whose two sides fall together then is glued as well. A union is refused if
/// its parts overlap or nearly touch. Edges along which the surface bends smoothly go first; the others as
/// long as the seam saved is worth the room that the union wastes.
class Net_builder
{
public:
  explicit Net_builder(const Net_facets& parts)
      : parts_(&parts), placement_(parts), is_glued_(parts.arcs.size(), 0), nets_of_(parts.facets.count()),
        nets_(parts.facets.count())
  {
    for (Index f = 0; f < nets_.size(); ++f)
      if (parts.hard.is_hard(f))
        begin_net(f);
  }

  /// Glues along rulings, and where seams must not be. What is not done when the run is cancelled stays open.
  void glue_rulings(double page_share, const Execution& execution)
  {
    const auto by_length = [&](Index a, Index b) {
      return std::tie(parts_->arcs[b].rank, a) < std::tie(parts_->arcs[a].rank, b);
    };
    std::vector<Index> order;
    for (Index a = 0; a < parts_->arcs.size(); ++a)
      if (parts_->arcs[a].is_ruling || parts_->arcs[a].is_forced)
        order.push_back(a);
    std::sort(order.begin(), order.end(), by_length);
    std::stable_partition(order.begin(), order.end(), [&](Index a) { return parts_->arcs[a].is_forced; });
    limit_sides(page_share);
    for (const Index a : order) {
      if (!may_go_on(execution))
        return;
      if (Joint j = joint(a);
          j.is_of_two && (parts_->arcs[a].is_forced || !is_too_large(j, extent_of(j))) && fits(j))
        glue(j);
    }
  }

  void glue_creases(const Net_style& style, const Execution& execution)
  {
    style_ = style;
    limit_sides(style.page_share);
    for (Net& net : nets_)
      net.pieces = 1;
    for (Index f = 0; f < nets_.size(); ++f)
      if (!nets_[f].facets.empty())
        push_arcs(f);
    while (!queue_.empty() && may_go_on(execution)) {
      const Entry e = queue_.top();
      queue_.pop();
      Joint j = joint(e.arc);
      if (!j.is_of_two || nets_[j.a].version != e.version_a || nets_[j.b].version != e.version_b)
        continue;
      if (fits(j)) {
        glue(j);
        push_arcs(nets_of_.find(j.a));
      }
    }
  }

  /// The length of what stays open between hard facets, over the root of their area.
  double seam_length() const
  {
    double sum = 0;
    for (Index a = 0; a < parts_->arcs.size(); ++a)
      if (!is_glued_[a])
        sum += parts_->arcs[a].length;
    return sum / parts_->unit;
  }

  /// The part of it across which the surface bends smoothly.
  double length_of_open_rulings() const
  {
    double sum = 0;
    for (Index a = 0; a < parts_->arcs.size(); ++a)
      if (!is_glued_[a] && parts_->arcs[a].is_ruling)
        sum += parts_->arcs[a].length;
    return sum / parts_->unit;
  }

  /// About the share of a page that the nets will fill.
  double fullness() const
  {
    double square = 0, side = 0, second = 0, room = 0;
    for (const Net& net : nets_)
      if (!net.facets.empty()) {
        square = std::max(square, net.extent.square);
        second = std::max(second, std::min(side, net.extent.side));
        side = std::max(side, net.extent.side);
        room += net.extent.room();
      }
    // One net may lie across the page, a second one hardly.
    constexpr double between_nets = 1.08;
    return parts_->whole_area / std::max({square * square, second * second, between_nets * room});
  }

  /// A bound on the share of a page that the nets can fill: the largest has to fit in any rotation. Its
  /// square has been tried in twelve directions; between two of them it is smaller by a cosine and a sine.
  double most_fullness() const
  {
    const double between = CGAL_PI / (4 * Extent::directions);
    double side = 0;
    for (const Net& net : nets_)
      side = std::max(side, net.extent.free_square / (std::cos(between) + std::sin(between)));
    return std::min(1.0, parts_->whole_area / (side * side));
  }

  /// Whether the same arcs are glued.
  bool is_like(const Net_builder& other) const { return is_glued_ == other.is_glued_; }

  Index net_of(Index facet) { return nets_of_.find(facet); }
  bool is_glued(Index h) const { return placement_.is_glued(h); }
  std::size_t number_of_nets() const
  {
    return static_cast<std::size_t>(
        std::count_if(nets_.begin(), nets_.end(), [](const Net& net) { return !net.facets.empty(); }));
  }

  /// The nets as flat charts.
  std::vector<Chart> charts() const
  {
    std::vector<Chart> result;
    for (const Net& net : nets_)
      if (!net.facets.empty())
        result.push_back(placement_.chart_of(net.facets));
    return result;
  }

private:
  struct Net
  {
    std::vector<Index> facets;
    std::vector<Vec2> hull;
    Alignment border;
    Extent extent;
    Index pieces = 1; ///< glued along creases
    Index version = 0;
  };

  struct Joint
  {
    Index arc, a, b; ///< nets
    bool is_of_two = false;
    Rigid_motion motion;       ///< takes b to a
    std::vector<Index> closed; ///< halfedges of a, glued by it
  };

  struct Entry
  {
    double score;
    Index arc, version_a, version_b;
    bool operator<(const Entry& o) const { return std::tie(score, o.arc) < std::tie(o.score, arc); }
  };

  /// Asks now and then.
  bool may_go_on(const Execution& execution)
  {
    constexpr std::size_t steps_between = 64;
    return ++steps_ % steps_between != 0 || execution.proceed();
  }

  void begin_net(Index f)
  {
    Net& net = nets_[f];
    net.facets = {f};
    net.hull = parts_->hulls[f];
    net.border = parts_->borders[f];
    net.extent = extent_of_hull(net.hull, net.border);
    largest_facet_ = std::max(largest_facet_, net.extent.square);
  }

  /// How the two nets beside an arc lie if they are glued there.
  Joint joint(Index arc)
  {
    const Facet_arc& r = parts_->arcs[arc];
    Joint j{arc, nets_of_.find(r.a), nets_of_.find(r.b), false, {}, {}};
    j.is_of_two = j.a != j.b;
    if (!j.is_of_two)
      return j;
    // The two ends of the arc that are farthest apart
    Index first = r.halfedges.front(), last = first;
    Vec2 p = placement_.place(first), q = placement_.place(next_halfedge(first));
    for (const Index h : r.halfedges) {
      if (length(placement_.place(next_halfedge(h)) - p) > length(q - p)) {
        q = placement_.place(next_halfedge(h));
        last = h;
      }
    }
    for (const Index h : r.halfedges) {
      if (length(q - placement_.place(h)) > length(q - p)) {
        p = placement_.place(h);
        first = h;
      }
    }
    const Index of = parts_->surface.opposite[first], ol = parts_->surface.opposite[last];
    j.motion = motion_of_segment(placement_.place(next_halfedge(of)), placement_.place(ol), p, q);
    return j;
  }

  /// Finds the edges that fall together; false if nothing is left of the arc or the nets overlap.
  bool fits(Joint& j)
  {
    const Net &a = nets_[j.a], &b = nets_[j.b];
    const double loose = placement_.looseness();
    const auto falls_together = [&](Index h, Index o, const Rigid_motion& h_to, const Rigid_motion& o_to) {
      const Vec2 p = h_to(placement_.place(h)), q = h_to(placement_.place(next_halfedge(h))),
                 r = o_to(placement_.place(next_halfedge(o))), s = o_to(placement_.place(o));
      const double allowed = std::min(loose, 0.05 * length(q - p) + parts_->noise);
      return length(p - r) <= allowed && length(q - s) <= allowed;
    };
    const bool b_is_smaller = b.facets.size() < a.facets.size();
    const Net& small = b_is_smaller ? b : a;
    const Index other = b_is_smaller ? j.a : j.b;
    bool is_arc_closed = true;
    j.closed.clear();
    const Rigid_motion none;
    for (const Index f : small.facets)
      for (const Index r : parts_->arcs_at[f]) {
        const Facet_arc& arc = parts_->arcs[r];
        const Index g = arc.a == f ? arc.b : arc.a;
        if (nets_of_.find(g) != other)
          continue;
        const bool a_side_in_a = nets_of_.find(arc.a) == j.a;
        bool all = true;
        for (const Index h : arc.halfedges)
          all &= falls_together(h, parts_->surface.opposite[h], a_side_in_a ? none : j.motion,
                                a_side_in_a ? j.motion : none);
        if (!all) {
          is_arc_closed &= r != j.arc;
          continue;
        }
        for (const Index h : arc.halfedges)
          j.closed.push_back(a_side_in_a ? h : parts_->surface.opposite[h]);
      }
    return is_arc_closed && !placement_.do_collide(a.facets, b.facets, j.motion, j.closed);
  }

  void glue(const Joint& j)
  {
    Net *a = &nets_[j.a], *b = &nets_[j.b];
    placement_.move(b->facets, j.motion);
    placement_.glue(j.closed);
    for (const Index h : j.closed)
      is_glued_[parts_->arc_of[h]] = 1;
    std::vector<Vec2> points = a->hull;
    for (const Vec2 p : b->hull)
      points.push_back(j.motion(p));
    std::vector<Index> facets = a->facets;
    facets.insert(facets.end(), b->facets.begin(), b->facets.end());
    const Alignment border = border_of(j);
    const Index pieces = a->pieces + b->pieces;
    const Index version = std::max(a->version, b->version) + 1;
    *a = *b = Net();
    a->version = b->version = version;
    nets_of_.unite(j.a, j.b);
    Net& net = nets_[nets_of_.find(j.a)];
    net.facets = std::move(facets);
    net.hull = convex_hull(std::move(points));
    net.border = border;
    net.extent = extent_of_hull(net.hull, border);
    net.pieces = pieces;
    net.version = version;
  }

  // --- What is worth gluing

  void push_arcs(Index n)
  {
    for (const Index f : std::vector<Index>(nets_[n].facets))
      for (const Index r : parts_->arcs_at[f])
        if (!is_glued_[r])
          if (const double s = score(r); s > 0) {
            const Index a = nets_of_.find(parts_->arcs[r].a), b = nets_of_.find(parts_->arcs[r].b);
            queue_.push({s, r, nets_[a].version, nets_[b].version});
          }
  }

  /// The room that both nets take when they are glued. Squares within the limit are not looked for.
  Extent extent_of(const Joint& j) const
  {
    std::vector<Vec2> points;
    points.reserve(nets_[j.a].hull.size() + nets_[j.b].hull.size());
    points = nets_[j.a].hull;
    for (const Vec2 p : nets_[j.b].hull)
      points.push_back(j.motion(p));
    return extent_of_hull(convex_hull(std::move(points)), border_of(j), side_limit_);
  }

  Alignment border_of(const Joint& j) const
  {
    Alignment moved = nets_[j.b].border;
    moved.direction = rotated(j.motion.turn, moved.direction);
    return joined(nets_[j.a].border, moved);
  }

  /// No net gets larger than a page that all nets fill to this share; but any may be a little larger than the
  /// largest facet.
  void limit_sides(double page_share)
  {
    constexpr double room = 1.1;
    side_limit_ = std::max(parts_->unit / std::sqrt(page_share), room * largest_facet_);
  }

  bool is_too_large(const Joint& j, const Extent& e) const
  {
    constexpr double rounding = 1.0001;
    return e.square > side_limit_ &&
           e.square > rounding * std::max(nets_[j.a].extent.square, nets_[j.b].extent.square);
  }

  /// What gluing there saves, in units of the root of the whole area; 0 if it shall not be.
  double score(Index arc)
  {
    const Joint j = joint(arc);
    if (!j.is_of_two || nets_[j.a].pieces + nets_[j.b].pieces > most_pieces)
      return 0;
    const Extent e = extent_of(j);
    if (is_too_large(j, e))
      return 0;
    const double waste =
        (e.room() - nets_[j.a].extent.room() - nets_[j.b].extent.room()) / parts_->whole_area;
    const double gain = std::exp(parts_->arcs[arc].rank / 1e4) * factor_of_variation(arc);
    return std::round((gain - style_.waste_price * waste) * 1e7) / 1e7;
  }

  /// The same for arcs of the same length, and of the same areas beside them.
  double factor_of_variation(Index arc) const
  {
    if (style_.variation == 0)
      return 1;
    const auto area = [&](Index f) {
      return std::llround(1e5 * parts_->facets.area[f] / parts_->whole_area);
    };
    std::uint64_t x =
        static_cast<std::uint64_t>(std::llround(parts_->arcs[arc].rank)) + 1000003 * style_.variation;
    x = x * 0x9E3779B97F4A7C15u +
        static_cast<std::uint64_t>(area(parts_->arcs[arc].a) + area(parts_->arcs[arc].b));
    x = (x ^ (x >> 31)) * 0xBF58476D1CE4E5B9u;
    x ^= x >> 32;
    constexpr double spread = 0.6;
    return 1 + spread * (static_cast<double>(x >> 11) / 9007199254740992.0 - 0.5);
  }

  /// Of a net: a bound on the time, which grows with the square of it.
  static constexpr Index most_pieces = 160;

  const Net_facets* parts_;
  double largest_facet_ = 0, side_limit_ = 0; ///< sides of squares
  Net_placement placement_;
  std::vector<std::uint8_t> is_glued_; ///< per arc
  Union_find nets_of_;
  std::vector<Net> nets_;
  Net_style style_;
  std::priority_queue<Entry> queue_;
  std::size_t steps_ = 0;
};

} // namespace Atlas::internal

#endif
