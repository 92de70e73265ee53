// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_INTERNAL_NAMED_STAGES_H
#define ATLAS_SOUP_INTERNAL_NAMED_STAGES_H

#include <Atlas/core/internal/library.h>
#include <Atlas/packing/Raster_packer.h>
#include <Atlas/pipeline/presets.h>

#include <string>
#include <vector>

namespace Atlas::internal {

/// \brief The stages of the pipeline by the names of their models; empty: that of the mode.
struct Stage_names
{
  std::string segmentation, parameterizer, solver, pins, optimizer, packer;

  /// Whether any stage is named.
  bool any() const
  {
    return !(segmentation.empty() && parameterizer.empty() && solver.empty() && pins.empty() &&
             optimizer.empty() && packer.empty());
  }
};

/// The models that a stage knows, in alphabetical order. \param stage  the name of a member of `Stage_names`
std::vector<std::string> models_of_stage(const std::string& stage);

/// \throw Invalid_argument that names the stage: a name is not known, or it says something of LSCM, which the
/// parameterizer does not begin with
void check(const Stage_names& names);

/// Puts the models that are named in the places of the policies of a mode. The names have been checked.
void set_stages(const Stage_names& names, Atlas_mode mode, Packing_effort effort, Policies& policies);

} // namespace Atlas::internal

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/soup/internal/named_stages_impl.h>
#endif

#endif
