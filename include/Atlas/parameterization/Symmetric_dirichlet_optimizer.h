// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_SYMMETRIC_DIRICHLET_OPTIMIZER_H
#define ATLAS_PARAMETERIZATION_SYMMETRIC_DIRICHLET_OPTIMIZER_H

#include <Atlas/parameterization/Distortion_optimizer.h>

namespace Atlas {

/// \brief Brings the singular values near 1 everywhere: symmetric Dirichlet energy (Smith and Schaefer 2015),
/// with the secants of SLIM (Rabinovich et al. 2017) along the singular values. The default finish of charts.
///
/// Some 3 to 10 iterations from LSCM, more from Tutte's map.
using Symmetric_dirichlet_optimizer = Distortion_optimizer<internal::Symmetric_dirichlet>;

} // namespace Atlas

#endif
