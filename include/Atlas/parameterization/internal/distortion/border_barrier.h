// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_DISTORTION_BORDER_BARRIER_H
#define ATLAS_PARAMETERIZATION_INTERNAL_DISTORTION_BORDER_BARRIER_H

#include <Atlas/parameterization/internal/sparse/Vertex_block_cholesky.h>
#include <Atlas/planar/internal/border_tree.h>
#include <Atlas/planar/internal/segments.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace Atlas::internal {

/// \brief Energy that rises without limit as a border vertex comes near a border edge: w (e / distance - 1)^2
/// below the distance e, zero above (Smith and Schaefer 2015, section 4). It keeps the border from
/// touching itself without pushing where there is room.
class Border_barrier
{
public:
  Border_barrier(const Chart_geometry& geometry, const std::vector<std::vector<Index>>& borders)
  {
    for (const std::vector<Index>& border : borders) {
      const std::size_t n = border.size();
      for (std::size_t i = 0; i < n; ++i) {
        const double before = geometry.distance(border[(i + n - 1) % n], border[i]),
                     after = geometry.distance(border[i], border[(i + 1) % n]);
        guards_.push_back({border[i], range_share * std::min(before, after),
                           weight_share * (before * before + after * after)});
      }
    }
  }

  /// The tree must be fitted to u.
  double value(const Border_tree& tree, std::span<const Complex> u) const
  {
    double sum = 0;
    for_each_contact(tree, u, [&](const Guard& guard, const Contact& contact) {
      const double x = guard.range / contact.distance - 1;
      sum += guard.weight * x * x;
    });
    return sum;
  }

  /// Adds the gradient, and diagonal blocks that bound the positive part of the second derivative.
  void add(const Border_tree& tree, std::span<const Complex> u, std::vector<Complex>& gradient,
           Vertex_block_cholesky& system) const
  {
    for_each_contact(tree, u, [&](const Guard& guard, const Contact& contact) {
      const double d = contact.distance, e = guard.range, x = e / d - 1;
      const double slope = -2 * guard.weight * x * e / (d * d),
                   curvature = 2 * guard.weight * (e * e / (d * d * d * d) + 2 * x * e / (d * d * d));
      const Complex& n = contact.normal;
      const auto add_to = [&](Index v, double share) {
        gradient[v] += slope * share * n;
        const double c = 2 * curvature * std::abs(share);
        system.add(v, {c * n.real() * n.real(), c * n.real() * n.imag(), c * n.imag() * n.real(),
                       c * n.imag() * n.imag()});
      };
      add_to(guard.vertex, 1);
      add_to(contact.edge.first, contact.position - 1);
      add_to(contact.edge.second, -contact.position);
    });
  }

private:
  static constexpr double range_share = 0.25;  ///< of the shorter border edge at the vertex
  static constexpr double weight_share = 0.05; ///< of the squares of the border edges at the vertex

  struct Guard
  {
    Index vertex;
    double range;
    double weight;
  };

  struct Contact
  {
    Border_tree::Edge edge;
    double position; ///< of the nearest point on the edge, in [0, 1]
    double distance;
    Complex normal; ///< from there to the vertex
  };

  template <typename Visit>
  void for_each_contact(const Border_tree& tree, std::span<const Complex> u, Visit visit) const
  {
    for (const Guard& guard : guards_) {
      const Complex p = u[guard.vertex];
      tree.for_each_near(p, guard.range, [&](const Border_tree::Edge& edge) {
        if (edge.first == guard.vertex || edge.second == guard.vertex)
          return;
        const Complex a = u[edge.first], along = u[edge.second] - a, to = p - a;
        const double position = closest_position(to_vector(p), to_vector(a), to_vector(u[edge.second]));
        const Complex away = to - position * along;
        const double distance = std::abs(away);
        if (distance < guard.range && distance > 0)
          visit(guard, Contact{edge, position, distance, away / distance});
      });
    }
  }

  std::vector<Guard> guards_;
};

} // namespace Atlas::internal

#endif
