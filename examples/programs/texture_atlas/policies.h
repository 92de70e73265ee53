// SPDX-License-Identifier: MIT
// The stages of the pipeline by name.
#ifndef POLICIES_H
#define POLICIES_H

#include <Atlas/soup/internal/named_stages.h>

#include <string>

namespace CLI {
class App;
}

/// A name for each stage, as it is on the command line; empty: that of the mode.
struct Stage_choice : Atlas::internal::Stage_names
{
  std::string validator;
  double max_area_ratio = -1; ///< negative: that of the mode; 0: none
};

/// Declares the options that name stages. Names that are not known are refused with a list of those that are.
void add_stage_options(CLI::App& app, Stage_choice& names);

/// Refuses combinations that cannot be. \throw CLI::ValidationError
void check(const Stage_choice& names);

/// The policies of a mode, with those that are named in their places.
Atlas::Policies policies_of(const Stage_choice& names, Atlas::Atlas_mode mode,
                            const Atlas::Merge_options& merge, Atlas::Symmetry symmetry,
                            Atlas::Packing_effort effort);

#endif
