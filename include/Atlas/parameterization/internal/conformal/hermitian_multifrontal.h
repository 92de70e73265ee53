// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_HERMITIAN_MULTIFRONTAL_H
#define ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_HERMITIAN_MULTIFRONTAL_H

#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/LSCM_traits.h>
#include <Atlas/parameterization/internal/sparse/fill_reducing_order.h>
#include <Atlas/parameterization/internal/sparse/multifrontal_cholesky.h>

#include <complex>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief The mixed real and complex factorization of LSCM's matrix for large charts.
/// \tparam Panels  where the factor is kept: see factor_panels.h
template <typename Panels>
class Basic_hermitian_multifrontal
{
public:
  explicit Basic_hermitian_multifrontal(Panels panels = {}) : panels_(std::move(panels)) {}

  bool factorize(const LSCM_system& system, const Execution& execution)
  {
    std::vector<int> source; // per neighbour, the entry of the lower triangle
    const Graph graph = both_triangles(system, source);
    symbolic_ = std::make_unique<Supernodal_symbolic>(graph, approximate_minimum_degree(graph));
    if (!execution.proceed())
      return false;
    cholesky_ = std::make_unique<Multifrontal_cholesky<1, Panels>>(*symbolic_);
    const auto entry = [&](std::size_t k) {
      const std::size_t place = symbolic_->lower_source(k);
      const std::complex<double>& z = system.value[static_cast<std::size_t>(source[place])];
      // The graph's place is (column, row) of the permuted matrix, of which (row, column) is wanted.
      return graph.neighbor[place] == static_cast<Index>(system.row[static_cast<std::size_t>(source[place])])
                 ? z
                 : std::conj(z);
    };
    const auto is_complex = [&](std::size_t k) { return entry(k).imag() != 0; };
    if constexpr (requires { panels_.plan(std::size_t{}); }) {
      const std::size_t indices = graph.first.size() * sizeof(std::size_t) +
                                  graph.neighbor.size() * (sizeof(Index) + sizeof(int)) + symbolic_->bytes();
      if (!panels_.plan(indices + cholesky_->peak_of_fronts(is_complex)))
        return false;
    }
    cholesky_->keep_in(std::move(panels_));
    return cholesky_->factorize(
        [&](Index c, auto add) {
          add(0, 0, system.value[static_cast<std::size_t>(system.first[symbolic_->vertex(c)])].real());
        },
        [&](std::size_t k, auto add) { add(0, 0, entry(k)); }, is_complex);
  }

  bool solve(std::span<std::complex<double>> b)
  {
    std::vector<std::complex<double>> x(b.size());
    for (Index c = 0; c < b.size(); ++c)
      x[c] = b[symbolic_->vertex(c)];
    const bool is_solved = cholesky_->solve(x);
    for (Index c = 0; c < b.size(); ++c)
      b[symbolic_->vertex(c)] = x[c];
    return is_solved;
  }

  /// Numbers in the factor, a complex one counting twice.
  std::size_t factor_size() const { return cholesky_->factor_size(); }

private:
  /// The pattern without the diagonal, sorted, and where each entry comes from.
  static Graph both_triangles(const LSCM_system& system, std::vector<int>& source)
  {
    const std::size_t n = system.size();
    Graph graph{std::vector<std::size_t>(n + 1, 0), {}};
    const auto for_each_below_diagonal = [&](auto visit) {
      for (std::size_t c = 0; c < n; ++c)
        for (auto k = static_cast<std::size_t>(system.first[c]) + 1;
             k < static_cast<std::size_t>(system.first[c + 1]); ++k)
          visit(static_cast<std::size_t>(system.row[k]), c, k);
    };
    for_each_below_diagonal([&](std::size_t r, std::size_t c, std::size_t) {
      ++graph.first[r + 1];
      ++graph.first[c + 1];
    });
    for (std::size_t v = 0; v < n; ++v)
      graph.first[v + 1] += graph.first[v];
    graph.neighbor.resize(graph.first[n]);
    source.resize(graph.first[n]);
    std::vector<std::size_t> place(graph.first.begin(), graph.first.end() - 1);
    const auto put = [&](std::size_t v, std::size_t w, std::size_t k) {
      graph.neighbor[place[v]] = static_cast<Index>(w);
      source[place[v]++] = static_cast<int>(k);
    };
    // Columns in increasing order put all smaller neighbours of a vertex first, then the larger ones.
    for_each_below_diagonal([&](std::size_t r, std::size_t c, std::size_t k) { put(r, c, k); });
    for_each_below_diagonal([&](std::size_t r, std::size_t c, std::size_t k) { put(c, r, k); });
    return graph;
  }

  std::unique_ptr<Supernodal_symbolic> symbolic_;
  Panels panels_;
  std::unique_ptr<Multifrontal_cholesky<1, Panels>> cholesky_;
};

using Hermitian_multifrontal = Basic_hermitian_multifrontal<Panels_in_memory>;

} // namespace Atlas::internal

#endif
