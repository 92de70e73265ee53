// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_STRETCH_OPTIMIZER_H
#define ATLAS_PARAMETERIZATION_STRETCH_OPTIMIZER_H

#include <Atlas/parameterization/Distortion_optimizer.h>

namespace Atlas {

/// \brief Lowers the L2 stretch of Sander, Snyder, Gortler and Hoppe, Texture mapping progressive meshes,
/// 2001, with a free border, as the LSCM paper does for its Table 1.
///
/// Their method moves one vertex after another along random lines; this one finds the same minimum with
/// derivatives. The record's energies are those of `internal::Stretch`, whose least mean over all scales is
/// the L2 stretch.
using Stretch_optimizer = Distortion_optimizer<internal::Stretch>;

} // namespace Atlas

#endif
