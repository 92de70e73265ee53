// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_PAGES_PACKING_PIECES_H
#define ATLAS_PACKING_INTERNAL_PAGES_PACKING_PIECES_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Packing.h>
#include <Atlas/packing/internal/shapes/Outline.h>
#include <Atlas/packing/internal/shapes/simplify.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// A motion of the plane, after a reflection (x, y) -> (x, -y) if it is mirrored.
struct Motion_2
{
  Vec2 turn{1, 0}, shift;
  bool is_mirrored = false;

  Vec2 operator()(Vec2 p) const { return rotated(turn, is_mirrored ? Vec2{p.x, -p.y} : p) + shift; }
};

/// The outer border of a chart, as a closed polygon about its centre of gravity, and what must be equal for
/// two charts to be copies.
struct Congruence_key
{
  std::vector<Vec2> border; ///< counterclockwise
  std::vector<Vec2> holes;  ///< the points of all other borders, by x
  Vec2 centre;
  std::size_t vertices = 0, triangles = 0;
  double area = 0, radius = 0;
  bool is_face_down = false; ///< whether the chart lies so in the plane, as halves of mirrored models do
};

inline std::optional<Congruence_key> congruence_key(const Chart& chart)
{
  Outline outline;
  const Chart_extent extent = extent_of(chart);
  outline.centre = extent.centre;
  build_outline(chart, 1, outline);
  const auto chains = chains_of(outline);
  const auto is_closed = [](const auto& chain) { return chain.size() >= 4 && chain.front() == chain.back(); };
  if (chains.empty() || !std::all_of(chains.begin(), chains.end(), is_closed) || !(outline.area > 0))
    return std::nullopt;
  Congruence_key key{
      {}, {}, outline.centre, chart.uv.size(), chart.triangles.size(), outline.area, outline.radius, false};
  // Closed chains start at their farthest point: that of the outer border is the farthest of all.
  const auto outer = std::max_element(chains.begin(), chains.end(), [&](const auto& a, const auto& b) {
    return length(outline.points[a.front()]) < length(outline.points[b.front()]);
  });
  for (auto chain = chains.begin(); chain != chains.end(); ++chain)
    for (std::size_t i = 0; i + 1 < chain->size(); ++i)
      (chain == outer ? key.border : key.holes).push_back(outline.points[(*chain)[i]]);
  std::sort(key.holes.begin(), key.holes.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
  double twice_area = 0;
  for (std::size_t i = 0; i < key.border.size(); ++i)
    twice_area += cross(key.border[i], key.border[(i + 1) % key.border.size()]);
  key.is_face_down = twice_area < 0;
  if (key.is_face_down)
    std::reverse(key.border.begin() + 1, key.border.end());
  return key;
}

/// Whether a turn, after a reflection, takes each of the points `from` to one of the points `to`, which are
/// sorted by x.
inline bool has_image_in(const std::vector<Vec2>& from, Vec2 turn, bool is_mirrored,
                         const std::vector<Vec2>& to, double tolerance)
{
  return from.size() == to.size() && std::all_of(from.begin(), from.end(), [&](Vec2 p) {
           const Vec2 q = rotated(turn, is_mirrored ? Vec2{p.x, -p.y} : p);
           auto it = std::lower_bound(to.begin(), to.end(), q.x - tolerance,
                                      [](Vec2 a, double x) { return a.x < x; });
           while (it != to.end() && it->x <= q.x + tolerance && length(*it - q) > tolerance)
             ++it;
           return it != to.end() && it->x <= q.x + tolerance;
         });
}

/// A motion that takes a border to another, and by how much a point is off at most.
struct Congruence
{
  Motion_2 motion;
  double error = 0;
};

/// The motion that takes the border `from` nearest to the border `to`, if there is one within 1e-4 of the
/// radius.
/// Chains start at their point farthest from the centre, so few starts come into question.
inline std::optional<Congruence> congruence(const Congruence_key& from, const Congruence_key& to,
                                            bool is_mirrored)
{
  const std::size_t n = to.border.size();
  const double tolerance = 1e-4 * to.radius;
  if (from.border.size() != n || from.vertices != to.vertices || from.triangles != to.triangles ||
      std::abs(from.radius - to.radius) > tolerance || std::abs(from.area - to.area) > 1e-3 * to.area)
    return std::nullopt;
  std::vector<Vec2> border = from.border;
  if (is_mirrored) {
    for (Vec2& p : border)
      p.y = -p.y;
    std::reverse(border.begin(), border.end());
  }
  int starts = 0;
  double least = tolerance;
  std::optional<Congruence> best;
  for (std::size_t k = 0; k < n && starts < 64; ++k) {
    if (std::abs(length(border[k]) - length(to.border[0])) > tolerance)
      continue;
    ++starts;
    const Vec2 p = border[k], q = to.border[0];
    Vec2 turn{dot(p, q), cross(p, q)};
    turn = (1 / length(turn)) * turn;
    double error = 0;
    for (std::size_t i = 0; i < n && error <= least; ++i)
      error = std::max(error, length(rotated(turn, border[(k + i) % n]) - to.border[i]));
    if (!(error <= least) || (best && error == least) ||
        !has_image_in(from.holes, turn, is_mirrored, to.holes, tolerance))
      continue;
    least = error;
    best = Congruence{{turn, {}, is_mirrored}, error};
    best->motion.shift = to.centre - best->motion(from.centre);
  }
  return best;
}

/// The motion that takes one border to another. A reflection where there is no other, or where that is much
/// nearer: of a triangle with two sides that are nearly equal. A chart that lies face down and one that does
/// not are mirror images of each other, even if they cover the same place.
inline std::optional<Congruence> best_congruence(const Congruence_key& from, const Congruence_key& to,
                                                 bool is_mirroring_allowed)
{
  if (!is_mirroring_allowed && from.is_face_down != to.is_face_down)
    return std::nullopt;
  const std::optional<Congruence> plain = congruence(from, to, false);
  if (!is_mirroring_allowed || (plain && plain->error <= 1e-7 * to.radius))
    return plain;
  const std::optional<Congruence> mirrored = congruence(from, to, true);
  return !plain || (mirrored && mirrored->error < 0.1 * plain->error) ? mirrored : plain;
}

/// What is packed in place of the charts: charts in the size their weight asks for, groups as one piece,
/// copies once.
class Packing_pieces
{
public:
  Packing_pieces(std::span<const Chart> charts, const Page_options& options, const Execution& execution)
      : original_(charts), is_plain_(options.weights.empty() && options.groups.empty() &&
                                     options.stacking == Chart_stacking::none)
  {
    if (is_plain_)
      return;
    make_pieces(options);
    if (options.stacking != Chart_stacking::none)
      stack(options.stacking == Chart_stacking::copies_and_mirrored, execution);
  }

  std::span<const Chart> charts() const { return is_plain_ ? original_ : std::span<const Chart>(pieces_); }

  /// The placement of a chart, given those of the pieces.
  Placement placement(std::size_t chart, const std::vector<Placement>& placements) const
  {
    if (is_plain_)
      return placements[chart];
    const Membership& m = members_[chart];
    const Placement& p = placements[m.piece];
    const Vec2 a = rotated({p.a, p.b}, m.motion.turn), t = rotated({p.a, p.b}, m.motion.shift);
    return {a.x * m.weight,
            a.y * m.weight,
            p.stretch_x * t.x + p.x,
            p.stretch_y * t.y + p.y,
            p.page,
            m.motion.is_mirrored,
            p.stretch_x,
            p.stretch_y};
  }

  /// How many copies of a chart lie below it.
  Index layer(std::size_t chart) const { return is_plain_ ? 0 : members_[chart].layer; }

private:
  /// The chart, scaled by its weight and moved, is part of the piece.
  struct Membership
  {
    Index piece = 0, layer = 0;
    double weight = 1;
    Motion_2 motion;
  };

  void make_pieces(const Page_options& options)
  {
    members_.resize(original_.size());
    std::map<Index, Index> piece_of_group;
    for (std::size_t i = 0; i < original_.size(); ++i) {
      const Index group = i < options.groups.size() ? options.groups[i] : no_index;
      const Index next = static_cast<Index>(pieces_.size());
      const auto [it, is_new] =
          group == no_index ? std::pair(piece_of_group.end(), true) : piece_of_group.try_emplace(group, next);
      const double weight = options.weights.empty() ? 1 : options.weights[i];
      if (is_new) {
        pieces_.emplace_back();
        is_single_.push_back(group == no_index);
      }
      members_[i].piece = is_new ? next : it->second;
      // The charts of a group keep their mutual places, so they have the weight of the first.
      members_[i].weight = is_new ? weight : weight_of_piece_[it->second];
      if (is_new)
        weight_of_piece_.push_back(members_[i].weight);
    }
    if (!options.places_in_group.empty())
      set_places(options.places_in_group);
    for (std::size_t i = 0; i < original_.size(); ++i)
      append(original_[i], members_[i], pieces_[members_[i].piece]);
  }

  /// Moves the charts of groups to their places, scaled so that each group keeps its area.
  void set_places(const std::vector<Placement>& places)
  {
    std::vector<std::pair<double, double>> areas(pieces_.size()); // of the charts, and in their places
    for (std::size_t i = 0; i < original_.size(); ++i) {
      const double area = area_of(original_[i]);
      areas[members_[i].piece].first += area;
      areas[members_[i].piece].second += area * (places[i].a * places[i].a + places[i].b * places[i].b);
    }
    for (std::size_t i = 0; i < original_.size(); ++i)
      if (Membership& m = members_[i]; !is_single_[m.piece]) {
        const auto [area, area_in_place] = areas[m.piece];
        const double scale = area_in_place > 0 ? std::sqrt(area / area_in_place) : 1;
        const Vec2 factor{scale * places[i].a, scale * places[i].b};
        const double size = length(factor);
        m.motion = {(1 / size) * factor, (m.weight * scale) * Vec2{places[i].x, places[i].y},
                    places[i].is_mirrored};
        m.weight *= size;
      }
  }

  static double area_of(const Chart& chart)
  {
    double area = 0;
    for (const auto& [a, b, c] : chart.triangles)
      area += CGAL::area(chart.uv[a], chart.uv[b], chart.uv[c]);
    return std::abs(area);
  }

  static void append(const Chart& chart, const Membership& member, Chart& piece)
  {
    const Index base = static_cast<Index>(piece.uv.size());
    for (const Point_2& p : chart.uv) {
      const Vec2 q = member.motion({member.weight * p.x(), member.weight * p.y()});
      piece.uv.emplace_back(q.x, q.y);
    }
    for (const auto& [a, b, c] : chart.triangles)
      piece.triangles.push_back({base + a, base + b, base + c});
    if (chart.points.size() == chart.uv.size())
      piece.points.insert(piece.points.end(), chart.points.begin(), chart.points.end());
  }

  /// Leaves one piece of all copies. A piece is compared with the last few of the same numbers and about the
  /// same area: O(n log n) in all.
  void stack(bool is_mirroring_allowed, const Execution& execution)
  {
    std::vector<std::optional<Congruence_key>> keys(pieces_.size());
    execution.for_each(pieces_.size(), [&](std::size_t i) {
      if (is_single_[i])
        keys[i] = congruence_key(pieces_[i]);
    });
    std::vector<Index> order;
    for (Index i = 0; i < keys.size(); ++i)
      if (keys[i])
        order.push_back(i);
    const auto rank = [&](Index i) {
      return std::tuple(keys[i]->border.size(), keys[i]->triangles, keys[i]->area, i);
    };
    std::sort(order.begin(), order.end(), [&](Index i, Index j) { return rank(i) < rank(j); });
    std::vector<std::pair<Index, Motion_2>> copy_of(pieces_.size(), {no_index, {}});
    std::vector<Index> models;
    for (const Index i : order) {
      bool is_copy = false;
      for (std::size_t k = 0; k < 32 && k < models.size() && !is_copy; ++k) {
        const Index model = models[models.size() - 1 - k];
        if (const auto found = best_congruence(*keys[i], *keys[model], is_mirroring_allowed)) {
          copy_of[i] = {model, found->motion};
          is_copy = true;
        }
      }
      if (!is_copy)
        models.push_back(i);
    }
    drop_copies(copy_of);
  }

  void drop_copies(const std::vector<std::pair<Index, Motion_2>>& copy_of)
  {
    std::vector<Index> number(pieces_.size(), no_index);
    Index kept = 0;
    for (Index i = 0; i < pieces_.size(); ++i)
      if (copy_of[i].first == no_index) {
        number[i] = kept;
        if (kept != i)
          pieces_[kept] = std::move(pieces_[i]);
        ++kept;
      }
    pieces_.resize(kept);
    std::vector<Index> copies(copy_of.size(), 0);
    for (Membership& m : members_) {
      const auto& [model, motion] = copy_of[m.piece];
      if (model != no_index) {
        m.motion = motion;
        m.layer = ++copies[model];
      }
      m.piece = number[model != no_index ? model : m.piece];
    }
  }

  std::span<const Chart> original_;
  bool is_plain_;
  std::vector<Chart> pieces_;
  std::vector<bool> is_single_;
  std::vector<double> weight_of_piece_;
  std::vector<Membership> members_;
};

} // namespace Atlas::internal

#endif
