// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_LSCM_TRAITS_H
#define ATLAS_PARAMETERIZATION_LSCM_TRAITS_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>

#include <array>
#include <complex>
#include <concepts>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace Atlas {

/// \brief A vertex whose image in the plane is given.
struct LSCM_pin
{
  Index vertex; ///< of the chart
  Point_2 uv;   ///< in the unit of the model
};

/// \brief The linear system of least squares conformal maps as solvers see it: a sparse Hermitian matrix H in
/// `std::complex<double>`, of which the lower triangle is stored.
///
/// The unknowns are the images u + iv of the free vertices, which are those that have a triangle and no pin.
/// Unknowns are numbered in increasing order of vertices. The conformal energy of a map is 1/2 U* H U plus
/// what the pins add. H is positive definite if the chart is connected and two vertices are pinned. Its
/// condition grows with the square of the number of vertices, so iterative solvers are slow on large charts.
///
/// Lengths are in a unit in which the chart has an extent between 1 and 2; H does not depend on it.
struct LSCM_system
{
  /// The lower triangle with the diagonal, in compressed columns: what Eigen, CHOLMOD and others call CSC.
  /// The entries of column c are at [first[c], first[c+1]) of `row` and `value`, in increasing order of rows;
  /// the first of each column is the diagonal, which is real. Off the diagonal, only entries between two
  /// neighbours on the border have an imaginary part.
  std::vector<int> first;
  std::vector<int> row;                    ///< of each entry, increasing in a column
  std::vector<std::complex<double>> value; ///< of each entry

  /// Per vertex of the chart: the number of its unknown, or -1 if it has none.
  std::vector<int> unknown;

  /// The number of unknowns.
  std::size_t size() const { return first.size() - 1; }

  /// \brief A row of the paper's complex matrix M (section 2.4), which belongs to a triangle: W_j / sqrt(d_T)
  /// for its three corners j.
  struct Row
  {
    std::array<int, 3> unknown;                ///< of each corner, or -1
    std::array<std::complex<double>, 3> entry; ///< for the corner, also if it has no unknown
  };

  /// The rows of M, one for each triangle of the chart: for solvers of the least squares problem itself. With
  /// the columns of the free vertices only, H = M* M / 2. Computed anew at each call, O(n).
  std::vector<Row> least_squares_rows() const;

  /// The chart that the system was made of; outlives the system.
  const Chart* chart = nullptr;
};

/// The system of a chart in which some vertices are pinned; where to does not matter. For those who solve it
/// themselves, and for tests of solvers. O(n).
/// \throws Invalid_argument if a pin is no vertex of the chart
LSCM_system lscm_system(const Chart& chart, std::span<const LSCM_pin> pins);

/// \brief Solves H x = b for the Hermitian matrix of an `LSCM_system`. See \ref LSCMTraits.
///
/// Solvers are default constructible; each chart gets one of its own. The system outlives the solver.
template <typename S>
concept LSCMSolver = std::default_initializable<S> &&
    requires(S& solver, const LSCM_system& system, std::span<std::complex<double>> b,
             const Execution& execution)
{
  /// Prepares for any number of right-hand sides; `false` if that is not possible.
  {
    solver.factorize(system, execution)
    } -> std::same_as<bool>;
  /// Replaces b, one number for each unknown, by the solution; `false` if none is found.
  {
    solver.solve(b)
    } -> std::same_as<bool>;
};

namespace internal {

/// A solver of any type.
struct LSCM_solver_interface
{
  virtual ~LSCM_solver_interface() = default;
  virtual bool factorize(const LSCM_system& system, const Execution& execution) = 0;
  virtual bool solve(std::span<std::complex<double>> b) = 0;
};

template <LSCMSolver Solver>
struct LSCM_solver_model final : LSCM_solver_interface
{
  LSCM_solver_model() = default;
  explicit LSCM_solver_model(Solver s) : solver(std::move(s)) {}

  /// See \ref LSCMTraits.
  bool factorize(const LSCM_system& system, const Execution& execution) override
  {
    return solver.factorize(system, execution);
  }
  /// See \ref LSCMTraits.
  bool solve(std::span<std::complex<double>> b) override { return solver.solve(b); }

  Solver solver;
};

} // namespace internal

/// \brief What LSCM leaves open: the solver of its sparse system, and the pins.
///
/// Traits whose solvers have parameters say `solver()` too, which makes one for a chart; else solvers are
/// default constructed.
///
/// `pins()` returns the vertices whose images are given: at least two, at two different places at least; or
/// none, which stands for two border vertices far apart, and for a result that is scaled to the chart's own
/// area.
template <typename T>
concept LSCMTraits = LSCMSolver<typename T::Solver> && requires(const T& traits, const Chart& chart)
{
  {
    traits.pins(chart)
    } -> std::convertible_to<std::vector<LSCM_pin>>;
};

namespace internal {

/// The solver of the traits for a chart.
template <LSCMTraits Traits>
LSCM_solver_model<typename Traits::Solver> lscm_solver(const Traits& traits)
{
  if constexpr (requires { traits.solver(); })
    return LSCM_solver_model<typename Traits::Solver>(traits.solver());
  else
    return {};
}

/// Throws `Invalid_argument` unless the pins have finite images at two places at least, each vertex once.
void check_pins(std::span<const LSCM_pin> pins);

/// The same, and the vertices must be less than the given number.
void check_pins(std::span<const LSCM_pin> pins, std::size_t number_of_vertices);

} // namespace internal

/// \brief Traits with a solver of one's choice.
template <LSCMSolver Solver_>
class Basic_LSCM_traits
{
public:
  /// Solves the system.
  using Solver = Solver_;

  Basic_LSCM_traits() = default;
  /// Pins for the one chart that will be flattened.
  /// \throws Invalid_argument if there are pins, but fewer than two; if all are at one place; if a vertex is
  /// pinned twice; if a coordinate is not finite
  explicit Basic_LSCM_traits(std::vector<LSCM_pin> pins) : pins_(std::move(pins))
  {
    if (!pins_.empty())
      internal::check_pins(pins_);
  }

  /// The given ones.
  const std::vector<LSCM_pin>& pins(const Chart&) const { return pins_; }

private:
  std::vector<LSCM_pin> pins_;
};

/// \brief Factorizes: Eigen's complex LDL* for charts of up to some thousand vertices, for larger ones a
/// multifrontal Cholesky factorization that is complex only where the border is.
class Direct_LSCM_solver
{
public:
  /// See \ref LSCMTraits.
  bool factorize(const LSCM_system& system, const Execution& execution);
  /// See \ref LSCMTraits.
  bool solve(std::span<std::complex<double>> b);

private:
  std::unique_ptr<internal::LSCM_solver_interface> chosen_;
};

/// \brief Conjugate gradients on the real least squares matrix A of the LSCM paper, equation 4, with the
/// diagonal of A^T A as preconditioner. A^T A itself is never formed.
///
/// Stops when the residual is 1e-8 of the right-hand side, which the refinement of `LSCM_parameterizer`
/// squares, or after ten times as many iterations as there are real unknowns.
class Conjugate_gradient_LSCM_solver
{
public:
  /// See \ref LSCMTraits.
  bool factorize(const LSCM_system& system, const Execution& execution);
  /// See \ref LSCMTraits.
  bool solve(std::span<std::complex<double>> b);

private:
  std::unique_ptr<internal::LSCM_solver_interface> chosen_;
};

/// \brief How an iterative solver fared with its last right-hand side.
struct LSCM_iteration_record
{
  std::size_t iterations = 0; ///< of the last solve
  double residual = 0;        ///< |b - H x| / |b|, computed anew from the solution
};

namespace internal {

/// A solver that iterates.
struct LSCM_iteration : LSCM_solver_interface
{
  LSCM_iteration_record record;
};

} // namespace internal

/// \brief Conjugate gradients on the Hermitian system, with a complete Cholesky factor that is kept in single
/// precision as the preconditioner: half the memory of `Direct_LSCM_solver` for its factor, a handful of
/// iterations.
///
/// The elimination itself is in double precision. Rounding what it leaves moves the factored matrix by one
/// part in 10^7, with random signs, and that hardly touches the smooth maps in which LSCM's energy is small:
/// incomplete factors and smoothers fail on just these. Stops when the residual is 1e-8 of the right-hand
/// side, in the norm of the components and in that of the preconditioner.
class Preconditioned_CG_LSCM_solver
{
public:
  /// See \ref LSCMTraits.
  bool factorize(const LSCM_system& system, const Execution& execution);
  /// See \ref LSCMTraits.
  bool solve(std::span<std::complex<double>> b);

  /// Of the last solution.
  LSCM_iteration_record record() const { return chosen_ ? chosen_->record : LSCM_iteration_record(); }

private:
  std::unique_ptr<internal::LSCM_iteration> chosen_;
};

/// \brief Conjugate gradients preconditioned by two grids: smoothing on the chart; the exact solution in a
/// strip along the border; and the similarities of patches of some 16 vertices, each flattened by its own
/// LSCM, as coarse maps, whose system is factorized.
///
/// For study. Multigrid for Laplace's equation does not converge here: LSCM's energy is small not only for
/// smooth maps but for all that are nearly holomorphic, down to waves along the border as short as its edges,
/// and maps that are small anywhere but in one place are never holomorphic. Strip and similarities are the
/// answer to that, but the number of iterations still grows with the chart: 50 for 30,000 vertices, 90 to 140
/// for 100,000, which takes ten times as long as a factorization, in half of its memory. Stops when the
/// residual is 1e-8 of the right-hand side, in the norm of the components and in that of the preconditioner.
class Multigrid_LSCM_solver
{
public:
  /// See \ref LSCMTraits.
  bool factorize(const LSCM_system& system, const Execution& execution);
  /// See \ref LSCMTraits.
  bool solve(std::span<std::complex<double>> b);

  /// Of the last solution.
  LSCM_iteration_record record() const { return chosen_ ? chosen_->record : LSCM_iteration_record(); }

private:
  std::unique_ptr<internal::LSCM_iteration> chosen_;
};

/// \brief The factorization of `Direct_LSCM_solver` for large charts with the factor in a file, where it is
/// more than may be in memory.
///
/// The limit is for all that LSCM needs beyond the chart itself: the geometry, the matrix, its order, the
/// fronts of the elimination, and as much of the factor as then fits; the rest of the factor goes to the
/// file, which each solution reads once forward and once backward. The chart itself stays in memory. What
/// does not go to the file takes 600 to 700 bytes for each vertex of a disc; with a lower limit the solver
/// fails. For charts of 4000 vertices and more the solution is that of `Direct_LSCM_solver`, bit for bit.
class Out_of_core_LSCM_solver
{
public:
  static constexpr std::size_t default_memory_limit = std::size_t(1) << 30; ///< bytes

  /// \param memory_limit  in bytes
  /// \param directory     of the temporary file; empty for the system's choice
  explicit Out_of_core_LSCM_solver(std::size_t memory_limit = default_memory_limit,
                                   std::string directory = {});

  /// `false` also if the limit is too low for the chart, or the file cannot be written.
  bool factorize(const LSCM_system& system, const Execution& execution);
  /// See \ref LSCMTraits.
  bool solve(std::span<std::complex<double>> b);

private:
  std::size_t memory_limit_;
  std::string directory_;
  std::unique_ptr<internal::LSCM_solver_interface> chosen_;
};

/// What `diameter_pins()` may visit of a chart's vertices, each as often as paths from anywhere reach it:
/// some seconds. So the pins of a chart of n vertices, b of them on the border, are exact if n b is no more;
/// long charts need less.
inline constexpr std::size_t default_diameter_visits = 20'000'000;

/// \brief The pins of the LSCM paper: the ends of the graph's diameter, the two vertices on the border whose
/// shortest path along edges is longest.
///
/// The paper pins "the two vertices maximizing the length of the shortest path between them", and triangles
/// keep their orientation "if the pinned vertices are chosen on the boundary". The default pins, those of a
/// double sweep, may be as near as 75 % of that; and they do not count the way around a cut, as this does. Of
/// a chart without border, any vertices. The pins lie as far apart in the plane as the path is long.
///
/// \param most_visits  after so many visits of vertices the longest path found so far is the answer, at least
/// that of a double sweep. O(n log n) for n visits.
/// \return two pins; none for a chart without triangles
/// \throws Invalid_argument if a triangle has a vertex that does not exist
std::vector<LSCM_pin> diameter_pins(const Chart& chart, std::size_t most_visits = default_diameter_visits);

/// \brief Traits with a solver of one's choice, and the pins of the paper: `diameter_pins()`.
template <LSCMSolver Solver_>
struct Diameter_LSCM_traits
{
  /// Solves the system.
  using Solver = Solver_;

  /// The ends of the diameter.
  std::vector<LSCM_pin> pins(const Chart& chart) const { return diameter_pins(chart); }
};

/// \brief The default: direct solvers that need nothing but Eigen.
using Eigen_LSCM_traits = Basic_LSCM_traits<Direct_LSCM_solver>;

/// \brief The solver of the LSCM paper.
///
/// For study: the condition of LSCM grows with the square of the number of vertices, so that direct solvers
/// win at every size.
using Conjugate_gradient_LSCM_traits = Basic_LSCM_traits<Conjugate_gradient_LSCM_solver>;

/// \brief Preconditioned conjugate gradients, which the LSCM paper proposes for the future: for large charts
/// where memory is short.
using Preconditioned_CG_LSCM_traits = Basic_LSCM_traits<Preconditioned_CG_LSCM_solver>;

/// \brief LSCM by multigrid, which the LSCM paper proposes for the future: for study.
using Multigrid_LSCM_traits = Basic_LSCM_traits<Multigrid_LSCM_solver>;

/// \brief LSCM within a memory limit, out of core where need be, as the LSCM paper proposes for huge models.
class Out_of_core_LSCM_traits : public Basic_LSCM_traits<Out_of_core_LSCM_solver>
{
public:
  /// \param memory_limit  in bytes: see `Out_of_core_LSCM_solver`
  /// \param directory     of the temporary file; empty for the system's choice
  explicit Out_of_core_LSCM_traits(std::size_t memory_limit = Out_of_core_LSCM_solver::default_memory_limit,
                                   std::string directory = {}, std::vector<LSCM_pin> pins = {})
      : Basic_LSCM_traits(std::move(pins)), memory_limit_(memory_limit), directory_(std::move(directory))
  {}

  /// A new solver for a chart.
  Out_of_core_LSCM_solver solver() const { return Out_of_core_LSCM_solver(memory_limit_, directory_); }

private:
  std::size_t memory_limit_;
  std::string directory_;
};

/// \brief The solver and the pins of the LSCM paper.
using Paper_LSCM_traits = Diameter_LSCM_traits<Conjugate_gradient_LSCM_solver>;

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/parameterization/internal/conformal/LSCM_system_impl.h>
#include <Atlas/parameterization/internal/conformal/LSCM_traits_impl.h>
#endif

#endif
