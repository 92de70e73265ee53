// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_SIMILARITY_PATCHES_H
#define ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_SIMILARITY_PATCHES_H

#include <Atlas/parameterization/LSCM_traits.h>
#include <Atlas/parameterization/internal/conformal/conformal_system.h>
#include <Atlas/parameterization/internal/sparse/supernodal_symbolic.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// The pattern of the whole matrix without its diagonal.
inline Graph neighbors(const LSCM_system& system)
{
  const std::size_t n = system.size();
  Graph graph{std::vector<std::size_t>(n + 1, 0), {}};
  const auto for_each_edge = [&](auto visit) {
    for (std::size_t c = 0; c < n; ++c)
      for (int k = system.first[c] + 1; k < system.first[c + 1]; ++k)
        visit(c, static_cast<std::size_t>(system.row[static_cast<std::size_t>(k)]));
  };
  for_each_edge([&](std::size_t c, std::size_t r) {
    ++graph.first[c + 1];
    ++graph.first[r + 1];
  });
  for (std::size_t v = 0; v < n; ++v)
    graph.first[v + 1] += graph.first[v];
  graph.neighbor.resize(graph.first[n]);
  std::vector<std::size_t> place(graph.first.begin(), graph.first.end() - 1);
  for_each_edge([&](std::size_t c, std::size_t r) {
    graph.neighbor[place[c]++] = static_cast<Index>(r);
    graph.neighbor[place[r]++] = static_cast<Index>(c);
  });
  return graph;
}

/// \brief The coarse maps of multigrid for LSCM: the chart in patches of some neighbouring vertices, each
/// flattened by its own LSCM, and moved by a similarity z -> a + b z.
///
/// A coarse space must have maps of small energy near every map of small energy. Those are nearly
/// holomorphic, hence nearly similarities on a patch; constants alone, as for Laplace's equation, are far
/// from them.
class Similarity_patches
{
public:
  static constexpr std::size_t patch_size = 16; ///< vertices of a patch, as a rule

  /// Unknowns 2p and 2p + 1 of the coarse system are a and b of the patch p.
  Similarity_patches(const LSCM_system& system, const Graph& graph)
      : patch_(system.size(), no_index), shape_(system.size())
  {
    grow(graph);
    flatten(system);
    coarsen(system);
  }

  const LSCM_system& coarse() const { return coarse_; }

  /// Adds to x what the similarities are at the vertices.
  void prolong(const std::vector<Complex>& similarities, std::vector<Complex>& x) const
  {
    for (std::size_t i = 0; i < x.size(); ++i) {
      const std::size_t p = patch_[i];
      x[i] += unit_[p] * similarities[2 * p] + times(shape_[i], similarities[2 * p + 1]);
    }
  }

  /// The adjoint: the forces on the similarities.
  void restrict(const std::vector<Complex>& r, std::vector<Complex>& forces) const
  {
    forces.assign(2 * unit_.size(), 0);
    for (std::size_t i = 0; i < r.size(); ++i) {
      const std::size_t p = patch_[i];
      forces[2 * p] += unit_[p] * r[i];
      forces[2 * p + 1] += times(std::conj(shape_[i]), r[i]);
    }
  }

private:
  /// Things in groups: those of group g are item[first[g]], ..., item[first[g + 1] - 1], in order.
  struct Groups
  {
    std::vector<std::size_t> first;
    std::vector<Index> item;
  };

  /// \param group  of each item, or no_index
  static Groups groups(std::size_t count, const std::vector<Index>& group)
  {
    Groups result{std::vector<std::size_t>(count + 1, 0), {}};
    for (const Index g : group)
      if (g != no_index)
        ++result.first[g + 1];
    for (std::size_t g = 0; g < count; ++g)
      result.first[g + 1] += result.first[g];
    result.item.resize(result.first[count]);
    std::vector<std::size_t> place(result.first.begin(), result.first.end() - 1);
    for (Index i = 0; i < group.size(); ++i)
      if (group[i] != no_index)
        result.item[place[group[i]]++] = i;
    return result;
  }

  /// All vertices, each component from one of its vertices outward, so that patches grow side by side.
  static std::vector<Index> breadth_first(const Graph& graph)
  {
    std::vector<Index> order;
    order.reserve(graph.size());
    std::vector<char> is_seen(graph.size(), false);
    const auto see = [&](Index v) {
      if (!is_seen[v]) {
        is_seen[v] = true;
        order.push_back(v);
      }
    };
    for (Index start = 0; start < graph.size(); ++start) {
      std::size_t head = order.size();
      for (see(start); head < order.size(); ++head)
        for (std::size_t k = graph.first[order[head]]; k < graph.first[order[head] + 1]; ++k)
          see(graph.neighbor[k]);
    }
    return order;
  }

  /// Fills `patch_`. What is left over between patches joins one of them.
  void grow(const Graph& graph)
  {
    std::vector<Index> own;
    Index count = 0;
    for (const Index seed : breadth_first(graph)) {
      if (patch_[seed] != no_index)
        continue;
      own.assign(1, seed);
      patch_[seed] = count;
      Index other = no_index; // a patch beside this one
      for (std::size_t head = 0; head < own.size(); ++head)
        for (std::size_t k = graph.first[own[head]]; k < graph.first[own[head] + 1]; ++k) {
          Index& patch = patch_[graph.neighbor[k]];
          if (patch == no_index && own.size() < patch_size) {
            patch = count;
            own.push_back(graph.neighbor[k]);
          } else if (patch != no_index && patch != count)
            other = patch;
        }
      if (3 * own.size() < patch_size && other != no_index)
        for (const Index v : own)
          patch_[v] = other;
      else
        ++count;
    }
    unit_.assign(count, 0);
  }

  /// The patch that has all corners of a triangle, or no_index.
  Index patch_of(const LSCM_system& system, const std::array<Index, 3>& corner) const
  {
    std::array<Index, 3> patch;
    for (int i = 0; i < 3; ++i) {
      const int unknown = system.unknown[corner[i]];
      patch[i] = unknown < 0 ? no_index : patch_[static_cast<std::size_t>(unknown)];
    }
    return patch[0] == patch[1] && patch[0] == patch[2] ? patch[0] : no_index;
  }

  /// Fills `unit_` and `shape_`: on each patch the constants and the z of its own LSCM, orthonormal.
  void flatten(const LSCM_system& system)
  {
    const Chart_geometry geometry(*system.chart);
    const auto& triangles = system.chart->triangles;
    std::vector<Index> of_triangle(triangles.size()), local(system.size()), vertex(system.size());
    for (Index t = 0; t < triangles.size(); ++t)
      of_triangle[t] = patch_of(system, triangles[t]);
    for (Index v = 0; v < system.unknown.size(); ++v)
      if (system.unknown[v] >= 0)
        vertex[static_cast<std::size_t>(system.unknown[v])] = v;
    const Groups members = groups(unit_.size(), patch_), inner = groups(unit_.size(), of_triangle);
    Eigen::MatrixXcd h;
    for (Index p = 0; p < unit_.size(); ++p) {
      const std::size_t begin = members.first[p], size = members.first[p + 1] - begin;
      unit_[p] = 1 / std::sqrt(static_cast<double>(size));
      const Index* own = members.item.data() + begin;
      for (Index i = 0; i < size; ++i)
        local[own[i]] = i;
      h.setZero(static_cast<Eigen::Index>(size), static_cast<Eigen::Index>(size));
      for (std::size_t k = inner.first[p]; k < inner.first[p + 1]; ++k) {
        const Planar_triangle shape = geometry.planar(inner.item[k]);
        std::array<Index, 3> at;
        for (int i = 0; i < 3; ++i)
          at[i] = local[static_cast<std::size_t>(system.unknown[triangles[inner.item[k]][i]])];
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            h(at[i], at[j]) += times(std::conj(shape.w[i]), shape.w[j]) / (2 * shape.double_area);
      }
      const Eigen::VectorXcd z =
          solve_patch(h, [&](Index i, Index j) { return geometry.distance(vertex[own[i]], vertex[own[j]]); });
      for (Index i = 0; i < size; ++i)
        shape_[own[i]] = z[i];
    }
  }

  /// LSCM of a patch with two vertices pinned that are far apart, centred and of norm 1; zero if there is
  /// none.
  template <typename Distance>
  static Eigen::VectorXcd solve_patch(Eigen::MatrixXcd& h, Distance distance)
  {
    const Eigen::Index size = h.rows();
    const auto farthest = [&](Eigen::Index from) {
      Eigen::Index best = from;
      for (Eigen::Index i = 0; i < size; ++i)
        if (h(i, i).real() > 0 && distance(static_cast<Index>(from), static_cast<Index>(i)) >
                                      distance(static_cast<Index>(from), static_cast<Index>(best)))
          best = i;
      return best;
    };
    const Eigen::Index a = farthest(0), b = farthest(a);
    const double mean = h.trace().real() / static_cast<double>(size);
    Eigen::VectorXcd z = Eigen::VectorXcd::Zero(size);
    if (a == b || !(mean > 0) || !(h(a, a).real() > 0))
      return z;
    z = -h.col(b);
    z[a] = 0;
    z[b] = mean;
    for (const Eigen::Index pin : {a, b}) {
      h.row(pin).setZero();
      h.col(pin).setZero();
      h(pin, pin) = mean;
    }
    h.diagonal().array() += 1e-12 * mean; // vertices without a triangle inside the patch
    z = h.llt().solve(z).eval();
    z.array() -= z.mean();
    const double norm = z.norm();
    if (!(norm > 0) || !std::isfinite(norm))
      return Eigen::VectorXcd::Zero(size);
    return z / norm;
  }

  /// What an entry of H says about two patches, by rows: constants and shapes of the one, of the other.
  using Block = std::array<Complex, 4>;

  /// P* H P, its lower triangle.
  void coarsen(const LSCM_system& system)
  {
    std::vector<std::vector<std::pair<Index, Block>>> columns(unit_.size());
    const auto add = [&](std::size_t i, std::size_t j, const Complex& h) {
      const Index row = patch_[i], column = patch_[j];
      if (row < column)
        return;
      auto& blocks = columns[column];
      auto at = std::find_if(blocks.begin(), blocks.end(), [&](const auto& b) { return b.first == row; });
      if (at == blocks.end())
        at = blocks.insert(at, {row, Block{}});
      const Complex one = unit_[column] * h, shape = times(shape_[j], h), left = std::conj(shape_[i]);
      at->second[0] += unit_[row] * one;
      at->second[1] += unit_[row] * shape;
      at->second[2] += times(left, one);
      at->second[3] += times(left, shape);
    };
    for (std::size_t c = 0; c < system.size(); ++c)
      for (auto k = static_cast<std::size_t>(system.first[c]);
           k < static_cast<std::size_t>(system.first[c + 1]); ++k) {
        const auto r = static_cast<std::size_t>(system.row[k]);
        add(r, c, system.value[k]);
        if (r != c)
          add(c, r, std::conj(system.value[k]));
      }
    coarse_.first.push_back(0);
    for (Index p = 0; p < columns.size(); ++p) {
      std::sort(columns[p].begin(), columns[p].end(),
                [](const auto& a, const auto& b) { return a.first < b.first; });
      for (int j = 0; j < 2; ++j) {
        for (const auto& [q, block] : columns[p])
          for (int i = q == p ? j : 0; i < 2; ++i)
            append(2 * static_cast<int>(q) + i, block[2 * i + j], q == p && i == j);
        coarse_.first.push_back(static_cast<int>(coarse_.row.size()));
      }
    }
  }

  /// A patch without a shape has an unknown of no effect.
  void append(int row, const Complex& value, bool is_diagonal)
  {
    coarse_.row.push_back(row);
    if (is_diagonal)
      coarse_.value.emplace_back(value.real() > 0 ? value.real() : 1);
    else
      coarse_.value.push_back(value);
  }

  std::vector<Index> patch_;   ///< of each unknown
  std::vector<Complex> shape_; ///< z of each unknown
  std::vector<double> unit_;   ///< of each patch, the constant of norm 1
  LSCM_system coarse_;
};

} // namespace Atlas::internal

#endif
