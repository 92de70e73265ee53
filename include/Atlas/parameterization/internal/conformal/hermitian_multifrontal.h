// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_HERMITIAN_MULTIFRONTAL_H
#define ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_HERMITIAN_MULTIFRONTAL_H

#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/internal/conformal/conformal_energy.h>
#include <Atlas/parameterization/internal/sparse/fill_reducing_order.h>
#include <Atlas/parameterization/internal/sparse/multifrontal_cholesky.h>

#include <memory>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief The mixed real and complex factorization of LSCM's matrix for large charts.
class Hermitian_multifrontal
{
public:
  template <typename System>
  bool factorize(const System& system, const Execution& execution)
  {
    Conformal_matrix h = free_part(system.energy.matrix(), system.column, system.number_of_columns);
    const Graph graph{std::move(h.first), std::move(h.neighbor)};
    symbolic_ = std::make_unique<Supernodal_symbolic>(graph, approximate_minimum_degree(graph));
    if (!execution.proceed())
      return false;
    cholesky_ = std::make_unique<Multifrontal_cholesky<1>>(*symbolic_);
    return cholesky_->factorize(
        [&](Index c, auto add) { add(0, 0, h.diagonal[symbolic_->vertex(c)]); },
        [&](std::size_t k, auto add) { add(0, 0, std::conj(h.entry(symbolic_->lower_source(k)))); },
        [&](std::size_t k) { return h.half_turns[symbolic_->lower_source(k)] != 0; });
  }

  bool solve(std::vector<Complex>& b) const
  {
    std::vector<Complex> x(b.size());
    for (Index c = 0; c < b.size(); ++c)
      x[c] = b[symbolic_->vertex(c)];
    const bool is_solved = cholesky_->solve(x);
    for (Index c = 0; c < b.size(); ++c)
      b[symbolic_->vertex(c)] = x[c];
    return is_solved;
  }

  /// Numbers of type double in the factor.
  std::size_t factor_size() const { return cholesky_->factor_size(); }

private:
  static Conformal_matrix free_part(Conformal_matrix h, const std::vector<Index>& column, std::size_t size)
  {
    // In place: free vertices keep their order, so entries only move towards the front.
    std::size_t place = 0, begin = 0;
    for (std::size_t v = 0; v < column.size(); ++v) {
      const std::size_t end = h.first[v + 1];
      if (column[v] != no_index) {
        for (std::size_t k = begin; k < end; ++k)
          if (const Index c = column[h.neighbor[k]]; c != no_index) {
            h.neighbor[place] = c;
            h.re[place] = h.re[k];
            h.half_turns[place] = h.half_turns[k];
            ++place;
          }
        h.diagonal[column[v]] = h.diagonal[v];
        h.first[column[v] + 1] = place;
      }
      begin = end;
    }
    h.neighbor.resize(place);
    h.re.resize(place);
    h.half_turns.resize(place);
    h.diagonal.resize(size);
    h.first.resize(size + 1);
    return h;
  }

  std::unique_ptr<Supernodal_symbolic> symbolic_;
  std::unique_ptr<Multifrontal_cholesky<1>> cholesky_;
};

} // namespace Atlas::internal

#endif
