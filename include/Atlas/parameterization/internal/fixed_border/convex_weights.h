// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_FIXED_BORDER_CONVEX_WEIGHTS_H
#define ATLAS_PARAMETERIZATION_INTERNAL_FIXED_BORDER_CONVEX_WEIGHTS_H

#include <Atlas/core/internal/halfedges.h>
#include <Atlas/parameterization/internal/geometry/chart_geometry.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace Atlas::internal {

using Weight_entries = std::vector<Eigen::Triplet<double>>;

inline void add_weight(Weight_entries& entries, Index v, Index w, double weight)
{
  entries.emplace_back(static_cast<int>(v), static_cast<int>(w), weight);
}

/// The same for all neighbours: Tutte 1963.
struct Equal_weights
{
  static constexpr bool is_symmetric = true;

  /// Every inner edge is met from both of its triangles, which doubles all weights alike.
  static Weight_entries entries(const Chart_geometry& geometry, const std::vector<bool>&)
  {
    Weight_entries result;
    result.reserve(6 * geometry.number_of_triangles());
    for (const auto& corner : geometry.chart().triangles)
      for (int i = 0; i < 3; ++i) {
        add_weight(result, corner[i], corner[(i + 1) % 3], 0.5);
        add_weight(result, corner[(i + 1) % 3], corner[i], 0.5);
      }
    return result;
  }
};

/// Half the sum of the cotangents of the two angles opposite to an edge: Eck et al. 1995.
struct Cotangent_weights
{
  static constexpr bool is_symmetric = true;

  static Weight_entries entries(const Chart_geometry& geometry, const std::vector<bool>&)
  {
    Weight_entries result;
    for (Index t = 0; t < geometry.number_of_triangles(); ++t) {
      const Planar_triangle shape = geometry.planar(t);
      const auto& corner = geometry.chart().triangles[t];
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const double weight =
            -(shape.w[i].real() * shape.w[j].real() + shape.w[i].imag() * shape.w[j].imag()) /
            (2 * shape.double_area);
        add_weight(result, corner[i], corner[j], weight);
        add_weight(result, corner[j], corner[i], weight);
      }
    }
    return result;
  }
};

/// (tan(alpha / 2) + tan(beta / 2)) / length, alpha and beta being the angles at the vertex on both sides of
/// the edge: Floater 2003.
struct Mean_value_weights
{
  static constexpr bool is_symmetric = false;

  static Weight_entries entries(const Chart_geometry& geometry, const std::vector<bool>&)
  {
    Weight_entries result;
    for (Index t = 0; t < geometry.number_of_triangles(); ++t) {
      const Planar_triangle shape = geometry.planar(t);
      const auto& corner = geometry.chart().triangles[t];
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        // From corner i the edges run along w[k] and against w[j].
        const double along = -(shape.w[k].real() * shape.w[j].real() + shape.w[k].imag() * shape.w[j].imag());
        const double to_j = std::abs(shape.w[k]), to_k = std::abs(shape.w[j]);
        const double tangent =
            along > 0 ? shape.double_area / (to_j * to_k + along) : (to_j * to_k - along) / shape.double_area;
        add_weight(result, corner[i], corner[j], tangent / to_j);
        add_weight(result, corner[i], corner[k], tangent / to_k);
      }
    }
    return result;
  }
};

/// Barycentric coordinates of the vertex in triangles of its neighbours, laid out around it by scaled angles
/// and averaged: Floater 1997, section 6.
struct Shape_preserving_weights
{
  static constexpr bool is_symmetric = false;

  static Weight_entries entries(const Chart_geometry& geometry, const std::vector<bool>& is_fixed)
  {
    const Chart& chart = geometry.chart();
    const std::vector<Index> opposite = opposite_halfedges(chart.triangles);
    std::vector<Index> outgoing(chart.number_of_vertices(), no_index);
    for (Index h = 0; h < opposite.size(); ++h)
      outgoing[chart.triangles[h / 3][h % 3]] = h;
    Weight_entries result;
    std::vector<Index> ring;
    std::vector<Complex> image;
    for (Index v = 0; v < outgoing.size(); ++v) {
      if (is_fixed[v] || !lay_out(geometry, opposite, outgoing[v], ring, image))
        continue;
      std::vector<double> weight(ring.size(), 0);
      for (std::size_t k = 0; k < ring.size(); ++k)
        add_coordinates(image, k, weight);
      for (std::size_t k = 0; k < ring.size(); ++k)
        add_weight(result, v, ring[k], weight[k]);
    }
    return result;
  }

private:
  /// The neighbours around the vertex at the origin, lengths kept, angles scaled to a full turn.
  static bool lay_out(const Chart_geometry& geometry, const std::vector<Index>& opposite, Index start,
                      std::vector<Index>& ring, std::vector<Complex>& image)
  {
    const auto& triangles = geometry.chart().triangles;
    ring.clear();
    image.clear();
    std::vector<double> angle{0}, length;
    const bool is_inner = for_each_in_fan(
        opposite, start, [&](Index h) { return opposite[h] != no_index; },
        [&](Index h) {
          const Index t = h / 3;
          const int i = static_cast<int>(h % 3), j = (i + 1) % 3, k = (i + 2) % 3;
          const Planar_triangle shape = geometry.planar(t);
          ring.push_back(triangles[t][j]);
          length.push_back(std::abs(shape.w[k]));
          angle.push_back(angle.back() + std::abs(std::arg(-shape.w[j] / shape.w[k])));
        });
    if (!is_inner)
      return false; // no disc around this vertex
    for (std::size_t k = 0; k < ring.size(); ++k)
      image.push_back(std::polar(length[k], 2 * std::acos(-1.) * angle[k] / angle.back()));
    return true;
  }

  /// The triangle of neighbour k and the edge that the ray from it through the origin meets.
  static void add_coordinates(const std::vector<Complex>& image, std::size_t k, std::vector<double>& weight)
  {
    const auto cross = [](const Complex& a, const Complex& b) {
      return a.real() * b.imag() - a.imag() * b.real();
    };
    const std::size_t n = image.size();
    for (std::size_t step = 1; step + 1 < n; ++step) {
      const std::size_t i = (k + step) % n, j = (k + step + 1) % n;
      const double c = cross(image[i], image[j]), a = cross(image[j], image[k]),
                   b = cross(image[k], image[i]);
      if (a < 0 || b < 0 || !(a + b + c > 0))
        continue;
      const double sum = a + b + c;
      weight[k] += c / sum;
      weight[i] += a / sum;
      weight[j] += b / sum;
      return;
    }
  }
};

} // namespace Atlas::internal

#endif
