// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_MIPS_OPTIMIZER_H
#define ATLAS_PARAMETERIZATION_MIPS_OPTIMIZER_H

#include <Atlas/parameterization/Distortion_optimizer.h>

namespace Atlas {

/// \brief Brings the singular values near each other, at any scale: most isometric parameterizations (Hormann
/// and Greiner 2000), a conformal map that cannot flip.
using MIPS_optimizer = Distortion_optimizer<internal::Mips>;

} // namespace Atlas

#endif
