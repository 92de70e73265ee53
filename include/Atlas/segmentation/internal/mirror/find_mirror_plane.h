// SPDX-License-Identifier: MIT
// Before the guard: where there is no library, that header includes its definitions, and they need all of
// this one.
#include <Atlas/segmentation/Merged_segmentation.h>

#ifndef ATLAS_SEGMENTATION_INTERNAL_MIRROR_FIND_MIRROR_PLANE_H
#define ATLAS_SEGMENTATION_INTERNAL_MIRROR_FIND_MIRROR_PLANE_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/segmentation/internal/mirror/Triangle_tree.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// The plane {p : normal * (p - origin) = offset}; the normal has length 1.
struct Mirror_plane
{
  Vector_3 normal;
  double offset = 0;

  double distance(const Point_3& p) const { return normal * (p - CGAL::ORIGIN) - offset; }
  Point_3 image(const Point_3& p) const { return p - 2 * distance(p) * normal; }
};

inline Point_3 centroid_of_triangle(const Surface& surface, Index t)
{
  return CGAL::centroid(surface.point(3 * t), surface.point(3 * t + 1), surface.point(3 * t + 2));
}

/// \brief Finds the plane at which a surface is mirrored onto itself, if there is one.
///
/// Only where the surface lies counts, not its mesh. Planes through the centroid are the candidates: those
/// across the axes of the model and across its principal axes. Each is moved to where it fits best, by a few
/// steps of the iterative closest point method (P. Besl, N. McKay 1992) for reflections. A plane is accepted
/// if the images of vertices and of centroids of triangles are near the surface, all of them. O(n log n).
class Mirror_plane_finder
{
public:
  /// The largest distance of an image from the surface, as a share of the diagonal of the bounding box.
  static constexpr double tolerance = 0.005;

  Mirror_plane_finder(const Surface& surface, const Execution& execution)
      : surface_(surface), execution_(execution), tree_(surface, all_triangles(surface))
  {
    measure();
  }

  /// \param symmetry  not `off`; an axis: the plane is across this axis
  std::optional<Mirror_plane> operator()(Symmetry symmetry) const
  {
    if (!(diagonal_ > 0) || samples_.empty())
      return std::nullopt;
    std::optional<Mirror_plane> best;
    double least = tolerance * diagonal_;
    for (const Vector_3& normal : candidates(symmetry)) {
      if (execution_.is_cancelled())
        return std::nullopt;
      if (least < good_enough * diagonal_)
        break;
      const Mirror_plane plane{normal, normal * (centroid_ - CGAL::ORIGIN)};
      for (const Mirror_plane& p : {plane, refined(plane, symmetry != Symmetry::automatic)}) {
        // Those that come later have to be clearly better: the axes of the model go first.
        const double error = largest_error(p, least);
        if (error < least) {
          best = p;
          least = clearly_better * error;
        }
      }
    }
    return best;
  }

private:
  static constexpr std::size_t number_of_samples = 300;
  static constexpr int steps = 12;
  static constexpr double clearly_better = 0.8;
  /// A plane with a smaller error, as a share of the diagonal, ends the search.
  static constexpr double good_enough = 0.001;
  /// Candidates with a larger mean error, as a share of the diagonal, are not refined.
  static constexpr double hopeless = 0.05;

  static std::vector<Index> all_triangles(const Surface& surface)
  {
    std::vector<Index> all(surface.number_of_triangles());
    std::iota(all.begin(), all.end(), Index(0));
    return all;
  }

  /// Finds the centroid, the principal axes and the size of the surface, and samples it evenly.
  void measure()
  {
    double sum = 0;
    Vector_3 moment(0, 0, 0);
    std::vector<double> area(surface_.number_of_triangles());
    for (Index t = 0; t < area.size(); ++t) {
      area[t] = triangle_area(surface_, t);
      sum += area[t];
      moment = moment + area[t] * (centroid_of_triangle(surface_, t) - CGAL::ORIGIN);
    }
    if (!(sum > 0))
      return;
    centroid_ = CGAL::ORIGIN + moment / sum;
    CGAL::Bbox_3 box;
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    double passed = 0, next = sum / (2 * number_of_samples);
    for (Index t = 0; t < area.size(); ++t) {
      for (Index h = 3 * t; h < 3 * t + 3; ++h) {
        const Eigen::Vector3d d = vector(surface_.point(h) - centroid_);
        spread += area[t] * d * d.transpose();
        box += surface_.point(h).bbox();
      }
      passed += area[t];
      if (passed > next) {
        samples_.push_back(centroid_of_triangle(surface_, t));
        next = passed + sum / number_of_samples;
      }
    }
    diagonal_ = std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d axis = solver.eigenvectors().col(i);
      axes_.emplace_back(axis.x(), axis.y(), axis.z());
    }
  }

  static Eigen::Vector3d vector(const Vector_3& v) { return {v.x(), v.y(), v.z()}; }

  std::vector<Vector_3> candidates(Symmetry symmetry) const
  {
    const std::vector<Vector_3> model{Vector_3(1, 0, 0), Vector_3(0, 1, 0), Vector_3(0, 0, 1)};
    if (symmetry == Symmetry::x)
      return {model[0]};
    if (symmetry == Symmetry::y)
      return {model[1]};
    if (symmetry == Symmetry::z)
      return {model[2]};
    std::vector<Vector_3> all = model;
    all.insert(all.end(), axes_.begin(), axes_.end());
    return all;
  }

  /// Pairs each sample with the point of the surface nearest to its image, and moves the plane to where the
  /// images are nearest to these points, again and again.
  ///
  /// For samples p with partners q, the sum of |image(p) - q|^2 is a constant plus four times that of
  /// d(p) d(q), d being distances from the plane. So the plane goes through the middle of all p and q, and
  /// its normal is the least eigenvector of the sum of (p - m) (q - m)^T, made symmetric.
  Mirror_plane refined(Mirror_plane plane, bool keeps_normal) const
  {
    std::vector<Point_3> partner(samples_.size());
    for (int step = 0; step < steps; ++step) {
      std::vector<double> error(samples_.size());
      execution_.for_each(samples_.size(), [&](std::size_t i) {
        const Triangle_tree::Hit hit = tree_.nearest(plane.image(samples_[i]));
        partner[i] = hit.point;
        error[i] = std::sqrt(hit.squared_distance);
      });
      if (execution_.is_cancelled() ||
          std::accumulate(error.begin(), error.end(), 0.0) > hopeless * diagonal_ * double(samples_.size()))
        break;
      Eigen::Vector3d middle = Eigen::Vector3d::Zero();
      for (std::size_t i = 0; i < samples_.size(); ++i)
        middle += vector(samples_[i] - CGAL::ORIGIN) + vector(partner[i] - CGAL::ORIGIN);
      middle /= 2 * double(samples_.size());
      Eigen::Matrix3d product = Eigen::Matrix3d::Zero();
      for (std::size_t i = 0; i < samples_.size(); ++i) {
        const Eigen::Vector3d p = vector(samples_[i] - CGAL::ORIGIN) - middle,
                              q = vector(partner[i] - CGAL::ORIGIN) - middle;
        product += p * q.transpose() + q * p.transpose();
      }
      if (!keeps_normal) {
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(product);
        const Eigen::Vector3d n = solver.eigenvectors().col(0);
        plane.normal = Vector_3(n.x(), n.y(), n.z());
      }
      plane.offset = vector(plane.normal).dot(middle);
    }
    return plane;
  }

  /// How far images are from the surface at most; infinite if that is more than `limit`.
  double largest_error(const Mirror_plane& plane, double limit) const
  {
    const auto error_of = [&](const std::vector<Point_3>& points) {
      std::vector<double> error(points.size(), 0);
      execution_.for_each(points.size(), [&](std::size_t i) {
        error[i] = tree_.nearest(plane.image(points[i])).squared_distance;
      });
      return std::sqrt(*std::max_element(error.begin(), error.end()));
    };
    const double first = error_of(samples_);
    if (first > limit)
      return std::numeric_limits<double>::infinity();
    std::vector<Point_3> points;
    for (Index t = 0; t < surface_.number_of_triangles(); ++t)
      points.push_back(centroid_of_triangle(surface_, t));
    std::vector<bool> is_used(surface_.points.size(), false);
    for (const auto& triangle : surface_.triangles)
      for (const Index v : triangle)
        is_used[v] = true;
    for (Index v = 0; v < is_used.size(); ++v)
      if (is_used[v])
        points.push_back(surface_.points[v]);
    return std::max(first, error_of(points));
  }

  const Surface& surface_;
  const Execution& execution_;
  Triangle_tree tree_;
  Point_3 centroid_{0, 0, 0};
  std::vector<Vector_3> axes_;
  std::vector<Point_3> samples_;
  double diagonal_ = 0;
};

} // namespace Atlas::internal

#endif
