// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_LSCM_TRAITS_H
#define ATLAS_PARAMETERIZATION_LSCM_TRAITS_H

#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/internal/conformal/conformal_energy.h>
#include <Atlas/parameterization/internal/conformal/hermitian_ldlt.h>
#include <Atlas/parameterization/internal/conformal/hermitian_multifrontal.h>
#include <Atlas/parameterization/internal/geometry/border.h>

#include <concepts>
#include <cstddef>
#include <utility>
#include <vector>

namespace Atlas {

/// \brief A vertex whose image is given.
struct LSCM_pin
{
  Index vertex;
  Point_2 uv; ///< in the unit of the model
};

/// \brief The linear problem of LSCM as solvers see it: minimise the energy over the free vertices.
///
/// `column[v]` is the number of vertex v among the free ones, or `no_index` for a pinned vertex.
struct LSCM_system
{
  const internal::Conformal_energy& energy;
  std::vector<Index> column;
  std::size_t number_of_columns = 0;
};

namespace internal {

/// Numbers the free vertices. A vertex without triangles has no equation; it stays where it is.
inline LSCM_system lscm_system(const Conformal_energy& energy, const std::vector<LSCM_pin>& pins)
{
  LSCM_system system{energy, std::vector<Index>(energy.size(), no_index)};
  for (const auto& corner : energy.geometry().chart().triangles)
    for (const Index v : corner)
      system.column[v] = 0;
  for (const LSCM_pin& pin : pins)
    system.column[pin.vertex] = no_index;
  for (Index& c : system.column)
    if (c != no_index)
      c = static_cast<Index>(system.number_of_columns++);
  return system;
}

} // namespace internal

/// \brief Solves H_ff x = b, H_ff being the block of the conformal energy's matrix of the free vertices.
template <typename S>
concept LSCMSolver = std::default_initializable<S> &&
    requires(S& solver, const LSCM_system& system, std::vector<internal::Complex>& b,
             const Execution& execution)
{
  /// Prepares for any number of right-hand sides; `false` if that is not possible.
  {
    solver.factorize(system, execution)
    } -> std::same_as<bool>;
  /// Replaces b by the solution; `false` if none is found.
  {
    solver.solve(b)
    } -> std::same_as<bool>;
};

/// \brief What LSCM leaves open: the sparse solver (and in it the number type), and the pins.
///
/// `pins()` returns the vertices whose images are given, any number >= 2 of them at two places at least; or
/// none, which stands for two border vertices far apart, with coordinates scaled so that the chart keeps its
/// area.
template <typename T>
concept LSCMTraits = LSCMSolver<typename T::Solver> && requires(const T& traits, const Chart& chart)
{
  typename T::Number_type;
  {
    traits.pins(chart)
    } -> std::convertible_to<std::vector<LSCM_pin>>;
};

namespace internal {

/// Eigen's complex LDLT for small systems, the mixed multifrontal factorization for large ones.
class Hermitian_solver
{
public:
  /// From so many unknowns on dense fronts win over their overhead.
  static constexpr std::size_t large = 4000;

  bool factorize(const LSCM_system& system, const Execution& execution)
  {
    is_large_ = system.number_of_columns >= large;
    return is_large_ ? multifrontal_.factorize(system, execution) : ldlt_.factorize(system, execution);
  }
  bool solve(std::vector<Complex>& b) const { return is_large_ ? multifrontal_.solve(b) : ldlt_.solve(b); }

private:
  bool is_large_ = false;
  Hermitian_LDLT<double> ldlt_;
  Hermitian_multifrontal multifrontal_;
};

} // namespace internal

/// \brief Traits with a solver of one's choice.
template <LSCMSolver Solver_, typename Number_type_ = double>
class Basic_LSCM_traits
{
public:
  using Number_type = Number_type_;
  using Solver = Solver_;

  Basic_LSCM_traits() = default;
  /// Pins for the one chart that will be flattened.
  explicit Basic_LSCM_traits(std::vector<LSCM_pin> pins) : pins_(std::move(pins)) {}

  const std::vector<LSCM_pin>& pins(const Chart&) const { return pins_; }

private:
  std::vector<LSCM_pin> pins_;
};

/// \brief The default: direct solvers that need nothing but Eigen.
using Eigen_LSCM_traits = Basic_LSCM_traits<internal::Hermitian_solver>;

} // namespace Atlas

#endif
