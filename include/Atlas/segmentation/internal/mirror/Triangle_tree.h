// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_MIRROR_TRIANGLE_TREE_H
#define ATLAS_SEGMENTATION_INTERNAL_MIRROR_TRIANGLE_TREE_H

#include <Atlas/core/Surface.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// The squared distance of a point from a triangle (C. Ericson, Real-Time Collision Detection, 5.1.5), and
/// the nearest point of the triangle.
inline double squared_distance_to_triangle(const Point_3& p, const Point_3& a, const Point_3& b,
                                           const Point_3& c, Point_3& nearest)
{
  const Vector_3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab * ap, d2 = ac * ap, d3 = ab * bp, d4 = ac * bp, d5 = ab * cp, d6 = ac * cp;
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (d1 <= 0 && d2 <= 0)
    nearest = a;
  else if (d3 >= 0 && d4 <= d3)
    nearest = b;
  else if (d6 >= 0 && d5 <= d6)
    nearest = c;
  else if (vc <= 0 && d1 >= 0 && d3 <= 0)
    nearest = a + d1 / (d1 - d3) * ab;
  else if (vb <= 0 && d2 >= 0 && d6 <= 0)
    nearest = a + d2 / (d2 - d6) * ac;
  else if (va <= 0 && d4 >= d3 && d5 >= d6)
    nearest = b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  else
    nearest = a + vb / (va + vb + vc) * ab + vc / (va + vb + vc) * ac;
  return CGAL::squared_distance(p, nearest);
}

/// \brief The triangles of a surface in a tree of boxes, for the nearest one to a point.
///
/// Building takes O(n log n), a query about O(log n). Of triangles at the same distance that with the least
/// number is the nearest.
class Triangle_tree
{
public:
  struct Hit
  {
    Index triangle = no_index;
    double squared_distance = std::numeric_limits<double>::infinity();
    Point_3 point; ///< of the triangle
  };

  /// \param triangles  those that count
  Triangle_tree(const Surface& surface, std::vector<Index> triangles)
      : surface_(surface), order_(std::move(triangles))
  {
    if (!order_.empty())
      build(0, order_.size());
  }

  Hit nearest(const Point_3& p) const
  {
    Hit hit;
    if (!nodes_.empty())
      search(0, p, hit);
    return hit;
  }

private:
  static constexpr std::size_t leaf_size = 4;

  struct Node
  {
    std::array<double, 3> low, high;
    std::size_t begin, end; ///< of its triangles
    std::size_t right = 0;  ///< the second child, the first follows the node; 0: a leaf
  };

  double twice_middle(Index t, int axis) const
  {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (Index h = 3 * t; h < 3 * t + 3; ++h) {
      low = std::min(low, surface_.point(h)[axis]);
      high = std::max(high, surface_.point(h)[axis]);
    }
    return low + high;
  }

  Node node_of(std::size_t begin, std::size_t end) const
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Node node{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}, begin, end};
    for (std::size_t i = begin; i < end; ++i)
      for (Index h = 3 * order_[i]; h < 3 * order_[i] + 3; ++h)
        for (int axis = 0; axis < 3; ++axis) {
          double &low = node.low[static_cast<std::size_t>(axis)],
                 &high = node.high[static_cast<std::size_t>(axis)];
          low = std::min(low, surface_.point(h)[axis]);
          high = std::max(high, surface_.point(h)[axis]);
        }
    return node;
  }

  std::size_t build(std::size_t begin, std::size_t end)
  {
    const std::size_t number = nodes_.size();
    nodes_.push_back(node_of(begin, end));
    if (end - begin <= leaf_size)
      return number;
    int axis = 0;
    const auto extent = [&](int k) {
      const auto i = static_cast<std::size_t>(k);
      return nodes_[number].high[i] - nodes_[number].low[i];
    };
    for (int k = 1; k < 3; ++k)
      if (extent(k) > extent(axis))
        axis = k;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](Index s, Index t) {
      return std::pair(twice_middle(s, axis), s) < std::pair(twice_middle(t, axis), t);
    });
    build(begin, middle);
    const std::size_t right = build(middle, end);
    nodes_[number].right = right;
    return number;
  }

  static double squared_distance(const Node& node, const Point_3& p)
  {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      const double d = std::max({node.low[i] - p[axis], p[axis] - node.high[i], 0.0});
      sum += d * d;
    }
    return sum;
  }

  void search(std::size_t number, const Point_3& p, Hit& hit) const
  {
    const Node& node = nodes_[number];
    if (node.right == 0) {
      for (std::size_t i = node.begin; i < node.end; ++i) {
        const Index t = order_[i];
        Point_3 point;
        const double d = squared_distance_to_triangle(p, surface_.point(3 * t), surface_.point(3 * t + 1),
                                                      surface_.point(3 * t + 2), point);
        if (d < hit.squared_distance || (d == hit.squared_distance && t < hit.triangle))
          hit = {t, d, point};
      }
      return;
    }
    std::pair<double, std::size_t> first{squared_distance(nodes_[number + 1], p), number + 1},
        second{squared_distance(nodes_[node.right], p), node.right};
    if (second < first)
      std::swap(first, second);
    for (const auto& [distance, child] : {first, second})
      if (distance <= hit.squared_distance)
        search(child, p, hit);
  }

  const Surface& surface_;
  std::vector<Index> order_; ///< triangles, those of a node next to each other
  std::vector<Node> nodes_;
};

} // namespace Atlas::internal

#endif
