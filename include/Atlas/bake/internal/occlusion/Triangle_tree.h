// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_INTERNAL_OCCLUSION_TRIANGLE_TREE_H
#define ATLAS_BAKE_INTERNAL_OCCLUSION_TRIANGLE_TREE_H

// This header needs CGAL's AABB tree, which is under the GPL; it is part of the component Occlusion.

#include <Atlas/core/Surface.h>

#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/version.h>
#if CGAL_VERSION_MAJOR >= 6
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

#include <cstddef>
#include <variant>
#include <vector>

namespace Atlas::internal {

/// \brief The triangles of a surface that have an area, in a tree that rays and nearest points ask.
class Triangle_tree
{
public:
  // Nothing is decided here that has to be exact.
  using K = CGAL::Simple_cartesian<double>;
  using Point = K::Point_3;
  using Vector = K::Vector_3;
  using Segment = K::Segment_3;
  using Ray = K::Ray_3;
  using Triangle = K::Triangle_3;
  using Iterator = std::vector<Triangle>::const_iterator;
#if CGAL_VERSION_MAJOR >= 6
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits_3<K, CGAL::AABB_triangle_primitive_3<K, Iterator>>>;
#else
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<K, CGAL::AABB_triangle_primitive<K, Iterator>>>;
#endif

  /// \param points  of the vertices of the surface
  Triangle_tree(const Surface& surface, const std::vector<Point_3>& points)
  {
    const auto point = [&](Index v) { return Point(points[v].x(), points[v].y(), points[v].z()); };
    for (Index t = 0; t < surface.number_of_triangles(); ++t) {
      const auto& [a, b, c] = surface.triangles[t];
      const Triangle triangle(point(a), point(b), point(c));
      if (triangle.is_degenerate())
        continue;
      triangles_.push_back(triangle);
      number_.push_back(t);
    }
    tree_.insert(triangles_.begin(), triangles_.end());
    tree_.build();
  }
  Triangle_tree(const Triangle_tree&) = delete; // the tree names triangles by where they are
  Triangle_tree& operator=(const Triangle_tree&) = delete;

  /// What a query has met, if it is a point.
  template <typename Variant>
  static const Point* point_of(const Variant& met)
  {
#if CGAL_VERSION_MAJOR >= 6
    return std::get_if<Point>(&met);
#else
    return boost::get<Point>(&met);
#endif
  }

  const Tree& tree() const
  {
    return tree_;
  }
  Tree& tree()
  {
    return tree_;
  }
  /// The number in the surface of a triangle that the tree names.
  Index number(Iterator triangle) const
  {
    return number_[static_cast<std::size_t>(triangle - triangles_.begin())];
  }

private:
  std::vector<Triangle> triangles_;
  std::vector<Index> number_;
  Tree tree_;
};

} // namespace Atlas::internal

#endif
