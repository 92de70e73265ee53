// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_IDENTITY_OPTIMIZER_H
#define ATLAS_PARAMETERIZATION_IDENTITY_OPTIMIZER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>

namespace Atlas {

/// \brief Leaves every chart as the parameterizer made it. A model of `UVOptimizer`.
struct Identity_optimizer
{
  [[nodiscard]] Chart_status optimize(Chart&, const Execution&) const { return Chart_status::valid; }
};

} // namespace Atlas

#endif
