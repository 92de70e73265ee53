// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_SEARCH_CONTACT_RELAXATION_H
#define ATLAS_PACKING_INTERNAL_SEARCH_CONTACT_RELAXATION_H

#include <Atlas/packing/internal/raster/Raster_builder.h>
#include <Atlas/packing/internal/search/contacts.h>
#include <Atlas/packing/internal/search/near_circles.h>
#include <Atlas/packing/internal/shapes/Packing_shape.h>
#include <Atlas/packing/internal/shapes/Placed_rectangle.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// What shapes may do while they are pushed apart.
struct Relaxation_options
{
  double width = 0, height = 0; ///< of the page in texels
  double gutter = 0;            ///< wanted between charts, in texels
  double border = 0;            ///< wanted to the border of the page
  double tolerance = 0.02;      ///< what the gutter may be violated by, in texels
  std::size_t obstacles = 0;    ///< so many of the last shapes stay where they are, at scale 1
};

/// Shapes on a page that push each other and the border away until they keep the gutter.
///
/// Points along the border of one shape are looked up in the distance field of another. Where they are nearer
/// than the gutter, both shapes are moved and turned by as much as is missing, the lighter one more,
/// obstacles not at all. One pair follows the other (Gauss-Seidel), until no pair is too near. A pair whose
/// shapes have moved by less than what was free between them cannot be, and is passed over.
class Contact_relaxation
{
public:
  Contact_relaxation(const std::vector<Packing_shape>& shapes, const Relaxation_options& options)
      : shapes_(&shapes), options_(options), movable_(shapes.size() - options.obstacles),
        travel_(shapes.size(), 0.0), extra_(shapes.size(), 0.0)
  {}

  const Shape_layout& layout() const { return layout_; }
  std::uint64_t work() const { return work_; }
  void set_work(std::uint64_t work) { work_ = work; }

  void assign(Shape_layout layout)
  {
    layout_ = std::move(layout);
    std::fill(travel_.begin(), travel_.end(), 0.0);
    std::fill(extra_.begin(), extra_.end(), 0.0);
    pairs_.clear(); // nothing that was known of pairs holds any longer
    reference_.clear();
  }

  /// Goes back or on to a layout that is near to the present one.
  void move_to(const Shape_layout& target)
  {
    const double growth = std::abs(target.scale - layout_.scale);
    for (std::size_t i = 0; i < movable_; ++i) {
      const double radius = (*shapes_)[i].radius;
      travel_[i] += length(target.positions[i] - layout_.positions[i]) + radius * growth +
                    radius * target.scale * length(target.turns[i] - layout_.turns[i]);
    }
    layout_ = target;
  }

  void set_scale(double scale)
  {
    const double growth = std::abs(scale - layout_.scale);
    for (std::size_t i = 0; i < movable_; ++i)
      travel_[i] += (*shapes_)[i].radius * growth;
    layout_.scale = scale;
  }

  /// Asks for more room around a chart.
  void widen(Index chart, double by)
  {
    extra_[chart] += by;
    travel_[chart] += by;
  }

  /// Pushes shapes apart for at most `sweeps` rounds; tells whether all keep the gutter then.
  bool relax(int sweeps)
  {
    double checkpoint = HUGE_VAL;
    Shape_layout previous;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      if (sweep > 0)
        coast(previous);
      previous = layout_;
      update_pairs();
      double worst = 0, sum = 0;
      for (Index i = 0; i < movable_; ++i)
        worst = std::max(worst, push_from_border(i));
      for (Pair& pair : pairs_)
        if (travel_[pair.i] + travel_[pair.j] >= pair.clear_until) {
          const double v = push_apart(pair);
          worst = std::max(worst, v);
          sum += v;
        }
      if (worst <= options_.tolerance)
        return true;
      if (sweep % 12 == 11) { // no use in going on without progress
        if (sum > progress * checkpoint)
          return false;
        checkpoint = sum;
      }
    }
    return false;
  }

private:
  static constexpr double momentum = 0.9;   ///< share of its last motion that a shape goes on with
  static constexpr double look_ahead = 3.0; ///< in texels: nearer samples than gutter and this are listed
  static constexpr double progress = 0.7;   ///< what is left after twelve sweeps, or it is given up

  struct Pair
  {
    Index i, j;
    double clear_until = -1; ///< travel of both up to which nothing can be nearer than the gutter
    double known_until = -1; ///< travel of both up to which no other samples than those of the lists can be
    std::vector<Index> samples_of_i = {}, samples_of_j = {}; ///< near the other shape
  };

  double scale(Index i) const { return i < movable_ ? layout_.scale : 1; }
  double reach(Index i) const { return (*shapes_)[i].radius * scale(i) + options_.gutter / 2 + extra_[i]; }
  Contact_body body(Index i) const
  {
    if (i >= movable_)
      return {layout_.positions[i]};
    const Packing_shape& shape = (*shapes_)[i];
    return {layout_.positions[i], 1 / shape.mass,
            shape.may_turn() ? 1 / (shape.inertia * layout_.scale * layout_.scale) : 0};
  }

  void apply(Index i, Contact_motion m)
  {
    const double most = 0.3 * reach(i), l = length(m.shift);
    if (l > most)
      m.shift = (most / l) * m.shift;
    m.turn = std::clamp(m.turn, -0.2, 0.2);
    layout_.positions[i] = layout_.positions[i] + m.shift;
    if (m.turn != 0) {
      Vec2& t = layout_.turns[i];
      t = rotated({std::cos(m.turn), std::sin(m.turn)}, t);
      t = (1 / length(t)) * t;
    }
    travel_[i] += length(m.shift) + std::abs(m.turn) * (*shapes_)[i].radius * layout_.scale;
  }

  /// Repeats a part of the last motion of each shape.
  void coast(const Shape_layout& previous)
  {
    for (Index i = 0; i < movable_; ++i) {
      const Vec2 shift = layout_.positions[i] - previous.positions[i];
      const Vec2 a = previous.turns[i], b = layout_.turns[i];
      if (shift.x != 0 || shift.y != 0 || !(a == b))
        apply(i, {momentum * shift, momentum * std::atan2(cross(a, b), dot(a, b))});
    }
  }

  /// Lists the pairs whose circles come near to each other, when a shape may have come near to a new one.
  void update_pairs()
  {
    const std::size_t n = layout_.positions.size();
    if (!reference_.empty()) {
      bool is_current = true;
      for (std::size_t i = 0; i < n && is_current; ++i)
        is_current = travel_[i] - reference_[i] <= 0.5 * skin(static_cast<Index>(i));
      if (is_current)
        return;
    }
    std::vector<double> radii(n);
    for (Index i = 0; i < n; ++i)
      radii[i] = reach(i) + skin(i);
    const std::vector<std::pair<Index, Index>> near =
        near_circles(layout_.positions, radii, options_.height, movable_);
    std::vector<Pair> pairs;
    pairs.reserve(near.size());
    std::size_t known = 0;
    for (const auto& [i, j] : near) { // keep what is known
      while (known < pairs_.size() && std::pair(pairs_[known].i, pairs_[known].j) < std::pair(i, j))
        ++known;
      if (known < pairs_.size() && pairs_[known].i == i && pairs_[known].j == j)
        pairs.push_back(std::move(pairs_[known++]));
      else
        pairs.push_back({i, j});
    }
    work_ += 20 * pairs.size() + 20 * n;
    pairs_ = std::move(pairs);
    reference_ = travel_;
  }
  double skin(Index i) const { return 0.1 * reach(i); }

  /// How shape a lies in the frame of shape b, in the unit of b.
  struct Relation
  {
    double unit; ///< of a, in that of b
    Vec2 turn, shift;
    Vec2 operator()(Vec2 p) const { return rotated(turn, p) + shift; }
  };
  Relation relation(Index a, Index b) const
  {
    const Vec2 back{layout_.turns[b].x, -layout_.turns[b].y};
    const double unit = scale(a) / scale(b);
    return {unit, unit * rotated(back, layout_.turns[a]),
            rotated((1 / scale(b)) * back, layout_.positions[a] - layout_.positions[b])};
  }

  /// Lists the samples of shape a that are nearer to shape b than `distance`, in texels.
  void list_samples(Index a, Index b, double distance, std::vector<Index>& list)
  {
    list.clear();
    const Packing_shape &from = (*shapes_)[a], &to = (*shapes_)[b];
    const Relation place = relation(a, b);
    const double horizon = distance / scale(b) + 0.5 * to.field.cell();
    for (Index k = 0; k < from.nodes.size();) {
      const auto& node = from.nodes[k];
      work_ += 12;
      if (to.field.lower_bound(place(node.centre)) - place.unit * node.radius > horizon) {
        k = node.skip;
        continue;
      }
      if (node.skip == k + 1) {
        work_ += 12 * (node.end - node.begin);
        for (Index i = node.begin; i < node.end; ++i)
          if (to.field.lower_bound(place(from.samples[i])) <= horizon)
            list.push_back(i);
      }
      ++k;
    }
  }

  /// Collects the contacts of the listed samples of shape a with shape b; lowers `clearance` to what is free.
  void collect(Index a, Index b, const std::vector<Index>& list, double sign, double wanted,
               double& clearance)
  {
    const Relation place = relation(a, b);
    for (const Index i : list)
      collect_sample(b, place((*shapes_)[a].samples[i]), sign, wanted, clearance);
  }

  static Vec2 direction(Vec2 v)
  {
    const double l = length(v);
    return l > 1e-3 ? (1 / l) * v : Vec2{1, 0};
  }

  void collect_sample(Index b, Vec2 p, double sign, double wanted, double& clearance)
  {
    const Packing_shape& to = (*shapes_)[b];
    const Distance_field::Sample sample = to.field.sample(p);
    work_ += 12;
    double d = sample.distance;
    Vec2 normal{1, 0};
    const double s = scale(b);
    if (sample.is_inside_grid && (d - to.field.cell()) * s < wanted) {
      const Segment_set::Closest q = to.field.closest(to.set, sample, p);
      const Vec2 away = p - q.point;
      const double l = length(away), cell = to.field.cell();
      const bool is_oriented = !to.set.segment_normals.empty() && std::abs(d) < 1.5 * cell;
      work_ += 25;
      if (is_oriented) {
        const double side = dot(away, q.normal);
        d = side >= 0 ? l : -l;
        normal = l > 1e-9 * cell ? (1 / d) * away : direction(q.normal);
      } else if (d > 0.3 * cell && l > 0) { // outside for sure
        d = l;
        normal = (1 / l) * away;
      } else {
        normal = direction(to.field.gradient(sample));
      }
    }
    const double depth = wanted - d * s;
    clearance = std::min(clearance, -depth);
    if (depth > 0.5 * options_.tolerance) {
      const Vec2 turn = layout_.turns[b];
      contacts_.push_back({layout_.positions[b] + rotated(s * turn, p), sign * rotated(turn, normal), depth});
    }
  }

  /// The bounding rectangle in its place.
  Placed_rectangle rectangle(Index i) const
  {
    const Packing_shape& shape = (*shapes_)[i];
    const double s = scale(i);
    const Vec2 turn = layout_.turns[i];
    return {layout_.positions[i] + rotated(s * turn, shape.middle),
            turn,
            {0.5 * s * shape.width, 0.5 * s * shape.height}};
  }

  /// Resolves the deepest contacts of a pair together. Gives the depth of the deepest.
  double push_apart(Pair& pair)
  {
    const Index i = pair.i, j = pair.j;
    const Vec2 between = layout_.positions[i] - layout_.positions[j];
    const double wanted = options_.gutter + extra_[i] + extra_[j],
                 gap = length(between) - reach(i) - reach(j);
    work_ += 5;
    if (gap > 0) {
      pair.clear_until = travel_[i] + travel_[j] + gap;
      return 0;
    }
    contacts_.clear();
    const double travel = travel_[i] + travel_[j];
    if (travel >= pair.known_until) {
      work_ += 20;
      if (const double room = least_distance(rectangle(i), rectangle(j)) - wanted;
          room > 0) { // long shapes side by side
        pair.clear_until = travel + room;
        return 0;
      }
      list_samples(i, j, wanted + look_ahead, pair.samples_of_i);
      list_samples(j, i, wanted + look_ahead, pair.samples_of_j);
      pair.known_until = travel + look_ahead;
    }
    double clearance = pair.known_until - travel;
    collect(i, j, pair.samples_of_i, 1, wanted, clearance);
    collect(j, i, pair.samples_of_j, -1, wanted, clearance);
    if (contacts_.empty()) {
      pair.clear_until = travel_[i] + travel_[j] + std::max(clearance, 0.0);
      return 0;
    }
    pair.clear_until = -1;
    thin_contacts(contacts_, 0.35 * std::min(reach(i), reach(j)));
    Contact_body a = body(i), b = body(j);
    internal::push_apart(contacts_, a, b);
    const double deepest = contacts_.front().depth;
    if (!a.is_fixed())
      apply(i, a.motion);
    if (!b.is_fixed())
      apply(j, b.motion);
    return deepest;
  }

  /// Keeps a shape on the page. Gives by how much it stuck out.
  double push_from_border(Index i)
  {
    const Packing_shape& shape = (*shapes_)[i];
    const double wanted = options_.border + extra_[i];
    const Vec2 x = layout_.positions[i];
    const double r = shape.radius * layout_.scale + wanted;
    if (x.x >= r && x.y >= r && x.x <= options_.width - r && x.y <= options_.height - r)
      return 0;
    work_ += 4 * shape.hull.size();
    std::array<Contact, 4> walls{Contact{{}, {1, 0}, 0}, Contact{{}, {0, 1}, 0}, Contact{{}, {-1, 0}, 0},
                                 Contact{{}, {0, -1}, 0}};
    for (const Vec2& p : shape.hull) {
      const Vec2 q = x + rotated(layout_.scale * layout_.turns[i], p);
      const std::array<double, 4> depth{wanted - q.x, wanted - q.y, q.x - options_.width + wanted,
                                        q.y - options_.height + wanted};
      for (int k = 0; k < 4; ++k)
        if (depth[k] > walls[k].depth) {
          walls[k].depth = depth[k];
          walls[k].point = q;
        }
    }
    Contact_body pushed = body(i);
    push_from_walls(walls, pushed);
    double deepest = 0;
    for (const Contact& c : walls)
      deepest = std::max(deepest, c.depth);
    if (deepest > 0)
      apply(i, pushed.motion);
    return deepest;
  }

  const std::vector<Packing_shape>* shapes_;
  Relaxation_options options_;
  std::size_t movable_; ///< shapes; the others are obstacles
  Shape_layout layout_;
  std::vector<double> travel_;    ///< upper bound of how far any point of the shape has moved, in texels
  std::vector<double> extra_;     ///< additional margin
  std::vector<double> reference_; ///< travel when pairs were listed
  std::vector<Pair> pairs_;
  std::vector<Contact> contacts_;
  std::uint64_t work_ = 0;
};

} // namespace Atlas::internal

#endif
