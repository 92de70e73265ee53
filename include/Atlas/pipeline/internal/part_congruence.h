// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_PART_CONGRUENCE_H
#define ATLAS_PIPELINE_INTERNAL_PART_CONGRUENCE_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/halfedges.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// A connected part of a surface as a mesh of polygons, and what does not change when it moves in space.
struct Surface_part
{
  std::vector<Index> triangles;
  std::vector<Index> sides; ///< halfedges that are sides of polygons
  Point_3 centre;           ///< mean of the polygons' corners
  double radius = 0;        ///< largest distance of a corner from the centre
  double spread = 0;        ///< root mean square of these distances
};

inline Surface_part surface_part(const Surface& surface, std::vector<Index> triangles)
{
  Surface_part part;
  part.triangles = std::move(triangles);
  Vector_3 sum(0, 0, 0);
  for (const Index t : part.triangles)
    for (Index h = 3 * t; h < 3 * t + 3; ++h)
      if (!surface.is_diagonal(h)) {
        part.sides.push_back(h);
        sum = sum + (surface.point(h) - CGAL::ORIGIN);
      }
  const double n = static_cast<double>(part.sides.size());
  part.centre = CGAL::ORIGIN + sum / n;
  double square = 0;
  for (const Index h : part.sides) {
    const double d = CGAL::squared_distance(surface.point(h), part.centre);
    part.radius = std::max(part.radius, std::sqrt(d));
    square += d;
  }
  part.spread = std::sqrt(square / n);
  return part;
}

/// Which side of a polygon of one part is which of the other.
using Side_pairs = std::vector<std::pair<Index, Index>>;

/// Finds out whether a part of a surface is a copy of another: whether a motion of space, perhaps after a
/// reflection, takes the polygons of one to those of the other within `tolerance` of the radius. Parts may
/// count their polygons and corners in any order.
///
/// A walk over both at once, from two sides of polygons that are to be the same, tells which corner is which;
/// the motion that fits them best (Kabsch 1976) then decides. Walks begin where corners are as far from the
/// centre as those of the first part; those that fail do so after few steps, but on symmetric parts, where
/// most succeed. So the work is bounded by a multiple of the size of the parts.
class Part_matcher
{
public:
  static constexpr double tolerance = 1e-4;

  explicit Part_matcher(const Surface& surface) : surface_(surface), image_(surface.opposite.size(), no_index)
  {}

  /// The sides of `copy` with those of `model`. In mirror images a side stands for the corner it starts at.
  std::optional<Side_pairs> match(const Surface_part& copy, const Surface_part& model, bool is_mirrored)
  {
    const double slack = tolerance * model.radius;
    if (copy.sides.size() != model.sides.size() || copy.triangles.size() != model.triangles.size() ||
        std::abs(copy.radius - model.radius) > slack || std::abs(copy.spread - model.spread) > slack)
      return std::nullopt;
    copy_ = &copy;
    model_ = &model;
    is_mirrored_ = is_mirrored;
    const auto start = std::max_element(copy.sides.begin(), copy.sides.end(), [&](Index g, Index h) {
      return distance(g, copy) < distance(h, copy);
    });
    std::size_t work = most_work * copy.sides.size();
    for (const Index h : model.sides) {
      if (!looks_alike(*start, h))
        continue;
      std::optional<Side_pairs> pairs = walk(*start, h, work);
      if (pairs && is_motion(*pairs))
        return pairs;
      if (work == 0)
        break;
    }
    return std::nullopt;
  }

private:
  static constexpr std::size_t most_work = 64; ///< steps per side

  double distance(Index h, const Surface_part& part) const
  {
    return std::sqrt(CGAL::squared_distance(surface_.point(h), part.centre));
  }

  /// The next side around the polygon.
  Index next(Index h) const
  {
    return next_on_border(surface_.opposite, h, [&](Index g) { return !surface_.is_diagonal(g); });
  }
  Index previous(Index h) const
  {
    Index g = previous_halfedge(h);
    while (surface_.is_diagonal(g))
      g = previous_halfedge(surface_.opposite[g]);
    return g;
  }

  /// The side of the model's polygon that follows the corner of `h`, in the order of the copy.
  Index next_in_model(Index h) const { return is_mirrored_ ? previous(h) : next(h); }
  /// The side of the model that is the image of the side of the copy which starts at corner `h`'s image.
  Index side_in_model(Index h) const { return is_mirrored_ ? previous(h) : h; }

  double distance(Index h, Index g) const
  {
    return std::sqrt(CGAL::squared_distance(surface_.point(h), surface_.point(g)));
  }

  /// Whether two corners are as far from the centres and from the next corners.
  bool looks_alike(Index h, Index in_model) const
  {
    const double slack = 2 * tolerance * model_->radius;
    return std::abs(distance(h, *copy_) - distance(in_model, *model_)) <= slack &&
           std::abs(distance(h, next(h)) - distance(in_model, next_in_model(in_model))) <= slack;
  }

  bool is_same(Index h, Index in_model) const
  {
    return looks_alike(h, in_model) && is_same_wish(h, side_in_model(in_model));
  }

  /// Whether two sides are alike in what the caller asks of them.
  bool is_same_wish(Index h, Index m) const
  {
    const Index o = surface_.opposite[h], p = surface_.opposite[m];
    if ((o == no_index) != (p == no_index))
      return false;
    const auto same = [&](const auto& list, Index a, Index b) { return list.empty() || list[a] == list[b]; };
    const auto is_patch_border = [&](Index a, Index b) { return !same(surface_.patch, a / 3, b / 3); };
    return same(surface_.constraint, h, m) && same(surface_.seam_cost, h, m) &&
           same(surface_.density_weight, h / 3, m / 3) &&
           (o == no_index || is_patch_border(h, o) == is_patch_border(m, p));
  }

  /// Pairs all sides, beginning with two; nothing if that leads to a contradiction.
  std::optional<Side_pairs> walk(Index h, Index in_model, std::size_t& work)
  {
    Side_pairs pairs;
    const bool is_consistent = walk(h, in_model, pairs, work) && pairs.size() == copy_->sides.size();
    for (const auto& [side, m] : pairs)
      image_[side] = no_index;
    return is_consistent ? std::optional(std::move(pairs)) : std::nullopt;
  }

  bool walk(Index h, Index in_model, Side_pairs& pairs, std::size_t& work)
  {
    std::vector<std::pair<Index, Index>> stack{{h, in_model}};
    while (!stack.empty()) {
      const auto [a, b] = stack.back();
      stack.pop_back();
      if (image_[a] != no_index) {
        if (image_[a] != b)
          return false;
        continue;
      }
      if (!enter_polygon(a, b, pairs, stack, work))
        return false;
    }
    return true;
  }

  /// Pairs the sides of two polygons, and lists their neighbours.
  bool enter_polygon(Index first, Index first_in_model, Side_pairs& pairs, Side_pairs& stack,
                     std::size_t& work)
  {
    Index h = first, m = first_in_model;
    do {
      if (work == 0 || image_[h] != no_index || !is_same(h, m))
        return false;
      --work;
      image_[h] = m;
      pairs.emplace_back(h, m);
      const Index o = surface_.opposite[h], p = surface_.opposite[side_in_model(m)];
      // The other side starts where this one ends: in a mirror image, that is where `p` ends.
      if (o != no_index)
        stack.emplace_back(o, is_mirrored_ ? next(p) : p);
      h = next(h);
      m = next_in_model(m);
    } while (h != first && m != first_in_model);
    return h == first && m == first_in_model;
  }

  /// Whether a motion of space takes the corners to those of the model.
  bool is_motion(const Side_pairs& pairs) const
  {
    const auto vector = [&](Index h, const Point_3& centre, bool is_reflected) {
      const Vector_3 d = surface_.point(h) - centre;
      return Eigen::Vector3d(is_reflected ? -d.x() : d.x(), d.y(), d.z());
    };
    Eigen::Matrix3d product = Eigen::Matrix3d::Zero();
    for (const auto& [h, m] : pairs)
      product += vector(m, model_->centre, false) * vector(h, copy_->centre, is_mirrored_).transpose();
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(product, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d sign = Eigen::Matrix3d::Identity();
    sign(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
    const Eigen::Matrix3d turn = svd.matrixU() * sign * svd.matrixV().transpose();
    const double slack = tolerance * model_->radius;
    return std::all_of(pairs.begin(), pairs.end(), [&](const auto& pair) {
      const Eigen::Vector3d p = turn * vector(pair.first, copy_->centre, is_mirrored_);
      return (p - vector(pair.second, model_->centre, false)).norm() <= slack;
    });
  }

  const Surface& surface_;
  std::vector<Index> image_; ///< per halfedge of the copy, while walking
  const Surface_part* copy_ = nullptr;
  const Surface_part* model_ = nullptr;
  bool is_mirrored_ = false;
};

} // namespace Atlas::internal

#endif
