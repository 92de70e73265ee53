// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_NET_PLACEMENT_H
#define ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_NET_PLACEMENT_H

#include <Atlas/core/Chart.h>
#include <Atlas/segmentation/internal/developable/Net_clearance.h>
#include <Atlas/segmentation/internal/developable/Net_facets.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace Atlas::internal {

/// \brief Where facets lie in the planes of their nets, which edges are glued there, and what is in the way.
class Net_placement
{
public:
  explicit Net_placement(const Net_facets& parts)
      : parts_(&parts), clearance_(share_of_gap * parts.unit, slack * parts.noise),
        motion_(parts.facets.count()), is_glued_(parts.local.size(), 0)
  {
    for (Index f = 0; f < motion_.size(); ++f)
      boxes_.push_back(box_of(f, motion_[f]));
  }

  bool is_glued(Index h) const { return is_glued_[h]; }
  /// Where the halfedge starts in the plane of its net.
  Vec2 place(Index h) const { return motion_[parts_->facet(h)](parts_->local[h]); }
  /// How far the two sides of an edge may be apart that is to be glued.
  double looseness() const { return slack * parts_->noise; }

  void move(const std::vector<Index>& facets, const Rigid_motion& motion)
  {
    for (const Index f : facets) {
      motion_[f] = motion.after(motion_[f]);
      boxes_[f] = box_of(f, motion_[f]);
    }
  }
  void glue(const std::vector<Index>& halfedges)
  {
    for (const Index h : halfedges)
      is_glued_[h] = is_glued_[parts_->surface.opposite[h]] = 1;
  }

  /// Whether net `a` and net `b` after a motion overlap or nearly touch, once the halfedges `closed` of `a`
  /// are glued.
  bool do_collide(const std::vector<Index>& a, const std::vector<Index>& b, const Rigid_motion& motion,
                  const std::vector<Index>& closed)
  {
    on_trial_.clear();
    std::vector<Vec2> welded;
    for (const Index h : closed) {
      on_trial_.push_back(h);
      on_trial_.push_back(parts_->surface.opposite[h]);
      welded.push_back(place(h));
      welded.push_back(place(next_halfedge(h)));
    }
    std::sort(on_trial_.begin(), on_trial_.end());
    const bool result = do_collide(items(a), moved_items(b, motion), welded);
    on_trial_.clear();
    return result;
  }

  /// A net as a flat chart.
  Chart chart_of(const std::vector<Index>& facets) const
  {
    Chart chart;
    for (const Index f : facets)
      chart.source.insert(chart.source.end(), parts_->triangles_of[f].begin(), parts_->triangles_of[f].end());
    std::sort(chart.source.begin(), chart.source.end());
    chart.triangles.assign(chart.source.size(), {no_index, no_index, no_index});
    const auto slot = [&](Index t) {
      return std::lower_bound(chart.source.begin(), chart.source.end(), t) - chart.source.begin();
    };
    const auto vertex = [&](Index h) -> Index& { return chart.triangles[slot(h / 3)][h % 3]; };
    for (const Index t : chart.source)
      for (Index start = 3 * t; start < 3 * t + 3; ++start) {
        if (vertex(start) != no_index)
          continue;
        const Vec2 p = place(start);
        const Index number = static_cast<Index>(chart.points.size());
        chart.points.push_back(parts_->surface.point(start));
        chart.uv.emplace_back(p.x, p.y);
        for_each_in_fan(
            parts_->surface.opposite, start, [&](Index h) { return !is_border(h); },
            [&](Index h) { vertex(h) = number; });
      }
    return chart;
  }

private:
  /// A facet that is moved.
  struct Item
  {
    Index facet;
    Rigid_motion motion;
    Planar_box box;
    std::vector<Vec2> hull = {};
  };

  std::vector<Item> items(const std::vector<Index>& facets) const
  {
    std::vector<Item> result;
    for (const Index f : facets)
      result.push_back({f, motion_[f], boxes_[f]});
    return result;
  }

  std::vector<Item> moved_items(const std::vector<Index>& facets, const Rigid_motion& motion) const
  {
    std::vector<Item> result;
    for (const Index f : facets) {
      const Rigid_motion all = motion.after(motion_[f]);
      result.push_back({f, all, box_of(f, all)});
    }
    return result;
  }

  /// Leaves out what is farther than the gap from all of `others`, as far as the box around them tells.
  void leave_out_distant(std::vector<Item>& some, const std::vector<Item>& others) const
  {
    Planar_box box;
    for (const Item& i : others)
      box.add(i.box);
    std::erase_if(some, [&](const Item& i) { return !i.box.meets(box, clearance_.gap()); });
  }

  bool do_collide(std::vector<Item> left, std::vector<Item> right, const std::vector<Vec2>& welded) const
  {
    leave_out_distant(left, right);
    leave_out_distant(right, left);
    add_hulls(left);
    add_hulls(right);
    const double gap = clearance_.gap();
    return any_meeting(left, right, gap, [&](const Item& x, const Item& y) {
      return !does_edge_keep_off(x.hull, y.hull, gap) && !does_edge_keep_off(y.hull, x.hull, gap) &&
             clearance_.do_collide(flat_triangles(x, y.box), flat_triangles(y, x.box), welded);
    });
  }

  void add_hulls(std::vector<Item>& items) const
  {
    for (Item& i : items)
      for (const Vec2 p : parts_->hulls[i.facet])
        i.hull.push_back(i.motion(p));
  }

  Planar_box box_of(Index f, const Rigid_motion& m) const
  {
    Planar_box box;
    for (const Vec2 p : parts_->hulls[f])
      box.add(m(p));
    return box;
  }

  bool is_border(Index h) const
  {
    const Index o = parts_->surface.opposite[h];
    if (o != no_index && parts_->facet(o) == parts_->facet(h) && may_cross(parts_->surface, h))
      return false;
    return !is_glued_[h] && !std::binary_search(on_trial_.begin(), on_trial_.end(), h);
  }

  /// The triangles of a facet that come near a box.
  std::vector<Flat_triangle> flat_triangles(const Item& item, const Planar_box& near) const
  {
    std::vector<Flat_triangle> result;
    const Box_2 here = in_plane_of(item, near);
    const Box_tree& tree = parts_->trees[item.facet];
    const auto add = [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        add_if_near(parts_->triangles_of[item.facet][tree.order()[i]], item.motion, near, result);
    };
    tree.visit([&](const Box_2& box, std::size_t, std::size_t) { return box.meets(here); }, add);
    return result;
  }

  /// A box with the gap around it, in the plane of a facet.
  Box_2 in_plane_of(const Item& item, const Planar_box& box) const
  {
    constexpr double rounding = 1e-9;
    const double gap = clearance_.gap() + rounding * parts_->unit;
    const Vec2 back{item.motion.turn.x, -item.motion.turn.y};
    Box_2 result;
    for (const double x : {box.low_x - gap, box.high_x + gap})
      for (const double y : {box.low_y - gap, box.high_y + gap}) {
        const Vec2 p = rotated(back, Vec2{x, y} - item.motion.shift);
        result.add(p.x, p.y);
      }
    return result;
  }

  void add_if_near(Index t, const Rigid_motion& motion, const Planar_box& near,
                   std::vector<Flat_triangle>& to) const
  {
    Flat_triangle flat;
    for (Index i = 0; i < 3; ++i) {
      flat.p[i] = motion(parts_->local[3 * t + i]);
      flat.box.add(flat.p[i]);
    }
    if (!flat.box.meets(near, clearance_.gap()))
      return;
    for (Index i = 0; i < 3; ++i)
      flat.is_border[i] = is_border(3 * t + i);
    to.push_back(flat);
  }

  /// How much room two nets need between them at least, over the root of the whole area.
  static constexpr double share_of_gap = 0.004;
  static constexpr double slack = 8;

  const Net_facets* parts_;
  Net_clearance clearance_;
  std::vector<Rigid_motion> motion_;   ///< per facet: from its plane to that of its net
  std::vector<Planar_box> boxes_;      ///< per facet, there
  std::vector<std::uint8_t> is_glued_; ///< per halfedge
  std::vector<Index> on_trial_;        ///< halfedges that count as glued, sorted
};

} // namespace Atlas::internal

#endif
