// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_ABF_PARAMETERIZER_H
#define ATLAS_PARAMETERIZATION_ABF_PARAMETERIZER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>

#include <array>
#include <vector>

namespace Atlas {

/// \brief What angle-based flattening found out on the way.
struct ABF_record
{
  std::vector<std::array<double, 3>> angles; ///< per triangle its angles in the plane, in radians
  int iterations = 0;                        ///< how many linear systems were solved
  double energy = 0;                         ///< sum over the corners of (angle / angle asked for - 1)^2
  /// The largest amount by which the angles around an inner vertex miss a condition: in radians, or as the
  /// logarithm of how much a wheel of triangles does not close up.
  double violation = 0;
  bool has_converged = true; ///< `false`: the limit of iterations came first
};

/// \brief Angle-based flattening: ABF++ of Sheffer, Levy, Mogilnitsky and Bogomyakov, 2005.
///
/// The unknowns are the angles of the flattened triangles: as near as possible, relative to their size, to
/// those in space, subject to the conditions under which triangles with these angles make a planar
/// triangulation. Newton's method, each step a system in the inner vertices only; coordinates then follow
/// from the angles by least squares (section 2.2 of the paper), so that errors do not pile up. The border is
/// free. Against the paper: the third condition is taken as a logarithm (Zayer, Levy and Seidel 2007), and
/// where an angle would fall below half of what is asked for, a barrier takes the place of the paper's
/// repeated change of weights.
///
/// Angles are positive, so no triangle flips as long as the conditions can be met and double precision holds
/// the sizes that go with them: on deep tubes triangles shrink below it. Triangles without area count as if
/// they were very thin. The border may overlap: see `Bijective_parameterizer`. The area in the plane is that
/// in space.
///
/// Cost: 4 to 10 sparse factorizations of order two times the number of vertices on usual charts, and one
/// complex one.
class ABF_parameterizer
{
public:
  static constexpr int default_max_iterations = 100; ///< of linear systems
  /// The iteration ends when no angle changes by more than this part of itself, and no condition is missed
  /// by more than `condition_tolerance`.
  static constexpr double angle_tolerance = 1e-6;
  static constexpr double condition_tolerance = 1e-10; ///< how well angles fit together in the end

  /// \throws Invalid_argument unless there is one iteration at least
  explicit ABF_parameterizer(int max_iterations = default_max_iterations);

  /// \return `not_a_disc` if the chart is none; `solver_failed` without finite solution. The coordinates are
  /// all zero then.
  Chart_status parameterize(Chart& chart, const Execution& execution) const;

  /// \copydoc parameterize
  /// \param record  the angles, and how well they were found
  Chart_status parameterize(Chart& chart, const Execution& execution, ABF_record& record) const;

private:
  int max_iterations_;
};

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/parameterization/internal/angles/ABF_parameterizer_impl.h>
#endif

#endif
