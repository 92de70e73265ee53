// SPDX-License-Identifier: MIT
#ifndef ATLAS_DEFAULT_POLICIES_H
#define ATLAS_DEFAULT_POLICIES_H

#include <Atlas/packing/Horizon_packer.h>
#include <Atlas/parameterization/Identity_optimizer.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/segmentation/Variational_segmentation.h>
#include <Atlas/validation/Exact_validator.h>

namespace Atlas {

using Default_segmentation = Variational_segmentation;
using Default_parameterizer = LSCM_parameterizer<>;
using Default_optimizer = Identity_optimizer;
using Default_validator = Exact_validator;
using Default_packer = Horizon_packer;

} // namespace Atlas

#endif
