// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_DISTORTION_REMOVED_VERTEX_H
#define ATLAS_PARAMETERIZATION_INTERNAL_DISTORTION_REMOVED_VERTEX_H

#include <Atlas/parameterization/internal/geometry/chart_geometry.h>
#include <Atlas/parameterization/internal/geometry/injectivity.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Border vertices that are kept inside of the coarse mesh have barycentric coordinates of at least this.
inline constexpr double least_weight_inside = 0.05;

/// A point in relation to a triangle, by barycentric coordinates.
struct Barycentric_place
{
  std::array<Index, 3> corner{};
  std::array<double, 3> weight{};
  double least = -std::numeric_limits<double>::infinity(); ///< of the weights
};

/// A vertex that was taken away, and the ring around it, counterclockwise; a path at the border.
struct Removed_vertex
{
  Index vertex, target;
  std::array<Barycentric_place, 2> places; ///< where to put it back: as in space, or as in the given map
  std::size_t first_ring, last_ring;
  bool is_border;
};

/// From areas that are in proportion to the coordinates.
inline Barycentric_place barycentric_place(const std::array<Index, 3>& corner,
                                           const std::array<double, 3>& area)
{
  Barycentric_place result{corner, area};
  for (double& weight : result.weight)
    weight /= area[0] + area[1] + area[2];
  result.least = *std::min_element(result.weight.begin(), result.weight.end());
  return result;
}

inline Barycentric_place place_in_plane(std::span<const Complex> u, Index v,
                                        const std::array<Index, 3>& corner)
{
  std::array<double, 3> area;
  for (int i = 0; i < 3; ++i) {
    const Complex p = u[corner[(i + 1) % 3]] - u[v], q = u[corner[(i + 2) % 3]] - u[v];
    area[i] = p.real() * q.imag() - p.imag() * q.real();
  }
  return barycentric_place(corner, area);
}

/// The vertex is projected to the plane of the triangle.
inline Barycentric_place place_in_space(const Chart_geometry& geometry, Index v,
                                        const std::array<Index, 3>& corner)
{
  const auto normal =
      Chart_geometry::cross(geometry.edge(corner[0], corner[1]), geometry.edge(corner[0], corner[2]));
  std::array<double, 3> area;
  for (int i = 0; i < 3; ++i)
    area[i] = Chart_geometry::dot(normal, Chart_geometry::cross(geometry.edge(v, corner[(i + 1) % 3]),
                                                                geometry.edge(v, corner[(i + 2) % 3])));
  return barycentric_place(corner, area);
}

/// \brief The two edges of a triangle at a vertex, in space (p and q) and in the plane (s and t).
struct Mapped_triangle
{
  double pp, qq, pq;
  double space2;    ///< the square of twice the area in space
  double plane;     ///< twice the area in the plane
  double stretched; ///< `space2` times the sum of the squared singular values of the map

  Mapped_triangle(const Chart_geometry::Vector& p, const Chart_geometry::Vector& q, const Complex& s,
                  const Complex& t)
      : pp(Chart_geometry::squared_length(p)), qq(Chart_geometry::squared_length(q)),
        pq(Chart_geometry::dot(p, q)), space2(pp * qq - pq * pq),
        plane(s.real() * t.imag() - s.imag() * t.real()),
        stretched(qq * std::norm(s) - 2 * pq * (s.real() * t.real() + s.imag() * t.imag()) +
                  pp * std::norm(t))
  {}
};

/// Symmetric Dirichlet energy of the triangles around v with v at z.
inline double ring_energy(const Chart_geometry& geometry, Index v, const Complex& z,
                          std::span<const Index> ring, bool is_border, const std::vector<Complex>& u)
{
  double sum = 0;
  for (std::size_t k = 0; k + is_border < ring.size(); ++k) {
    const Index a = ring[k], b = ring[(k + 1) % ring.size()];
    const Mapped_triangle triangle(geometry.edge(v, a), geometry.edge(v, b), u[a] - z, u[b] - z);
    if (triangle.space2 > 0)
      sum += triangle.stretched / std::sqrt(triangle.space2) *
             (1 + triangle.space2 / (triangle.plane * triangle.plane));
  }
  return sum;
}

inline Complex point_at(const Barycentric_place& place, const std::vector<Complex>& u, bool is_inside)
{
  std::array<double, 3> weight = place.weight;
  if (is_inside)
    for (double& w : weight)
      w = std::max(w, least_weight_inside);
  Complex z = 0;
  for (int i = 0; i < 3; ++i)
    z += weight[i] / (weight[0] + weight[1] + weight[2]) * u[place.corner[i]];
  return z;
}

/// From the target into the ring: the mean of the inward normals of the ring's edges there, and a length.
inline std::pair<Complex, double> way_in(const Removed_vertex& removed, std::span<const Index> ring,
                                         const std::vector<Complex>& u)
{
  const auto i = static_cast<std::size_t>(std::find(ring.begin(), ring.end(), removed.target) - ring.begin());
  const std::size_t n = ring.size();
  Complex direction = 0;
  double reach = 0;
  const auto add = [&](std::size_t from, std::size_t to) {
    const Complex along = u[ring[to]] - u[ring[from]];
    const double length = std::abs(along);
    direction += Complex(-along.imag(), along.real()) / length;
    reach = std::max(reach, length);
  };
  add(i, (i + 1) % n);
  add((i + n - 1) % n, i); // at the border the edge that took the place of two
  return {direction, reach / 2};
}

/// Whether a vertex at z would see its whole ring, its triangles being counterclockwise.
inline bool sees(const Complex& z, std::span<const Index> ring, bool is_border, const std::vector<Complex>& u)
{
  for (std::size_t k = 0; k + is_border < ring.size(); ++k)
    if (turn(z, u[ring[k]], u[ring[(k + 1) % ring.size()]]) != CGAL::LEFT_TURN)
      return false;
  return true;
}

/// Puts a vertex back into its ring: in relation to the triangle that took its place, or else near the corner
/// around which its ring was filled.
/// \param is_inside  puts border vertices into the coarse mesh
/// \return `false` if double precision has no place for it
inline bool put_back(const Chart_geometry& geometry, const Removed_vertex& removed,
                     std::span<const Index> ring, std::vector<Complex>& u, bool is_inside)
{
  double least = std::numeric_limits<double>::infinity();
  for (const Barycentric_place& place : removed.places) {
    const Complex z = point_at(place, u, is_inside && removed.is_border);
    if (const double e = ring_energy(geometry, removed.vertex, z, ring, removed.is_border, u);
        e < least && sees(z, ring, removed.is_border, u)) {
      least = e;
      u[removed.vertex] = z;
    }
  }
  if (std::isfinite(least))
    return true;
  const Complex& origin = u[removed.target];
  const auto [direction, reach] = way_in(removed, ring, u);
  constexpr int halvings = 40;
  double length = reach;
  for (int i = 0; i < halvings; ++i, length /= 2) {
    const Complex z = origin + length * direction;
    if (sees(z, ring, removed.is_border, u)) {
      u[removed.vertex] = z;
      return true;
    }
  }
  return false;
}

} // namespace Atlas::internal

#endif
