// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_INTERNAL_TANGENT_FRAMES_H
#define ATLAS_BAKE_INTERNAL_TANGENT_FRAMES_H

#include <Atlas/core/Surface.h>
#include <Atlas/soup/Polygon_soup.h>
#include <Atlas/soup/internal/index_uv.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace Atlas::internal {

/// \brief Tangents as Mikkelsen defines them ("Simulation of wrinkled surfaces revisited", 2008; MikkTSpace),
/// which renderers and bakers agree on: corners of the same position, normal and coordinates, whose triangles
/// hang together by edges and are as mirrored on the page, share the mean of the directions of u, by angles.
///
/// Linear in triangles.
class Tangent_frames
{
public:
  /// \param points   of the vertices of the surface, at any scale near 1
  /// \param normals  per corner of the triangles, unit
  Tangent_frames(const Surface& surface, const std::vector<Point_3>& points, const Polygon_soup& soup,
                 const std::vector<Vector_3>& normals)
      : surface_(surface), points_(points), soup_(soup), normals_(normals),
        tangent_(normals.size(), Vector_3(1, 0, 0)), group_(normals.size(), no_index)
  {
    weld_corners();
    for (Index t = 0; t < surface.number_of_triangles(); ++t)
      add_triangle(t);
    for (Index h = 0; h < normals.size(); ++h)
      if (group_[h] == no_index && direction_[h / 3].squared_length() > 0)
        make_group(h);
  }

  /// Of a corner of a triangle: unit, but where no triangle around has an area on the page.
  const Vector_3& tangent(Index corner) const { return tangent_[corner]; }
  /// 1, or -1 where the triangle is mirrored on the page: the bitangent is this times normal x tangent.
  double sign(Index triangle) const { return sign_[triangle]; }

private:
  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
  const Point_3& point(Index h) const { return points_[surface_.triangles[h / 3][h % 3]]; }
  const Point_2& uv(Index h) const { return soup_.uv[surface_.corner[h]]; }

  void weld_corners()
  {
    Row_table<8> table(normals_.size());
    for (Index h = 0; h < normals_.size(); ++h) {
      const Point_3& p = point(h);
      const Vector_3& n = normals_[h];
      const std::array<double, 8> row{p.x(), p.y(), p.z(), n.x(), n.y(), n.z(), uv(h).x(), uv(h).y()};
      std::array<std::uint64_t, 8> bits{};
      for (std::size_t k = 0; k < 8; ++k)
        bits[k] = std::bit_cast<std::uint64_t>(row[k] + 0.0);
      welded_.push_back(table(bits));
    }
  }

  static std::uint64_t edge(Index from, Index to) { return std::uint64_t(from) << 32 | to; }

  /// Its direction of u, and which triangles its edges lead to.
  void add_triangle(Index t)
  {
    const Index a = 3 * t, b = a + 1, c = a + 2;
    const Vector_2 s = uv(b) - uv(a), r = uv(c) - uv(a);
    const double area = CGAL::determinant(s, r);
    const Vector_3 u = r.y() * (point(b) - point(a)) - s.y() * (point(c) - point(a));
    const double length = std::sqrt(u.squared_length());
    sign_.push_back(area < 0 ? -1 : 1);
    direction_.push_back(area != 0 && length > 0 && std::isfinite(length) ? u * (sign_.back() / length)
                                                                          : Vector_3(0, 0, 0));
    for (const Index h : {a, b, c})
      edges_.try_emplace(edge(welded_[h], welded_[next(h)]), h);
  }

  /// The corner at the same vertex of the triangle beyond an edge, if it may share the tangent.
  Index corner_beyond(Index h, Index from, Index to) const
  {
    const auto it = edges_.find(edge(welded_[to], welded_[from]));
    if (it == edges_.end())
      return no_index;
    const Index g = welded_[it->second] == welded_[h] ? it->second : next(it->second);
    const bool is_known = direction_[g / 3].squared_length() > 0;
    return is_known && sign_[g / 3] == sign_[h / 3] && group_[g] == no_index ? g : no_index;
  }

  void make_group(Index first)
  {
    std::vector<Index> members{first};
    group_[first] = first;
    Vector_3 sum(0, 0, 0);
    for (std::size_t i = 0; i < members.size(); ++i) {
      const Index h = members[i];
      sum = sum + angle(h) * in_plane(direction_[h / 3], normals_[h]);
      for (const Index g : {corner_beyond(h, h, next(h)), corner_beyond(h, previous(h), h)})
        if (g != no_index && group_[g] == no_index) {
          group_[g] = first;
          members.push_back(g);
        }
    }
    const double length = std::sqrt(sum.squared_length());
    for (const Index h : members)
      tangent_[h] = length > 0 ? sum / length : direction_[h / 3];
  }

  /// The unit vector of a direction's part in the plane across a normal, or zero.
  static Vector_3 in_plane(const Vector_3& v, const Vector_3& n)
  {
    const Vector_3 part = v - (v * n) * n;
    const double length = std::sqrt(part.squared_length());
    return length > 0 ? part / length : Vector_3(0, 0, 0);
  }

  double angle(Index h) const
  {
    const Vector_3 a = in_plane(point(next(h)) - point(h), normals_[h]),
                   b = in_plane(point(previous(h)) - point(h), normals_[h]);
    return std::acos(std::clamp(a * b, -1.0, 1.0));
  }

  const Surface& surface_;
  const std::vector<Point_3>& points_;
  const Polygon_soup& soup_;
  const std::vector<Vector_3>& normals_;
  std::vector<Vector_3> tangent_, direction_; ///< per corner; per triangle, zero where it has none
  std::vector<double> sign_;                  ///< per triangle
  std::vector<Index> group_, welded_;         ///< per corner
  std::unordered_map<std::uint64_t, Index> edges_;
};

} // namespace Atlas::internal

#endif
