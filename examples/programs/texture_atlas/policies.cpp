// SPDX-License-Identifier: MIT
// The options that name stages.
#include "policies.h"

#include <Atlas/core/errors.h>
#include <Atlas/validation/Culprit_splitter.h>
#include <Atlas/validation/Exact_validator.h>
#include <Atlas/validation/Stencil_validator.h>

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace Atlas;

/// The validator and the splitter that goes with it.
void set_validator(const Stage_choice& names, Atlas_mode mode, Policies& policies)
{
  const bool is_paper = mode == Atlas_mode::paper;
  const double ratio = names.max_area_ratio < 0 ? default_max_area_ratio : names.max_area_ratio;
  const double quantile = is_paper ? 0 : default_density_quantile;
  if (names.validator == "stencil" || (is_paper && names.validator.empty())) {
    policies.validator = Stencil_validator(default_stencil_resolution, ratio);
    policies.splitter = Stencil_validator(default_stencil_resolution, ratio);
  } else if (is_paper || names.max_area_ratio >= 0) {
    policies.validator = Exact_validator(ratio, quantile);
    policies.splitter = Culprit_splitter(quantile);
  }
}

} // namespace

void add_stage_options(CLI::App& app, Stage_choice& names)
{
  const auto add = [&](const char* option, std::string& name, std::vector<std::string> known,
                       const std::string& description) {
    return app.add_option(option, name, description + ". Default: that of the mode")
        ->check(CLI::IsMember(std::move(known)));
  };
  add("--segmentation", names.segmentation, internal::models_of_stage("segmentation"),
      "Who cuts the surface into charts, which are not merged then. `features`: section 3 of Levy et al. "
      "2002; "
      "`paper`: the same to the letter; `seams`: nobody, there are only the seams of --seams, "
      "--separate-materials and --hard-angle, and what discs need");
  add("--parameterizer", names.parameterizer, internal::models_of_stage("parameterizer"),
      "Who flattens charts. `bijective`: LSCM, made one-to-one, with low symmetric Dirichlet energy; "
      "`bijective-conformal`: LSCM, made one-to-one only where it is not");
  add("--solver", names.solver, internal::models_of_stage("solver"), "Who solves the linear system of LSCM");
  add("--pins", names.pins, internal::models_of_stage("pins"),
      "Which two vertices LSCM pins: the ends of the `diameter` of the chart's graph, or those of a double "
      "`sweep`, which are quicker to find");
  add("--optimizer", names.optimizer, internal::models_of_stage("optimizer"),
      "Who lowers the distortion of flattened charts; in the mode `paper` that is done when they are "
      "accepted");
  add("--validator", names.validator, {"exact", "stencil"},
      "Who accepts charts: `exact` proves them free of flips and overlaps, `stencil` draws them in a stencil "
      "buffer");
  app.add_option(
         "--max-area-ratio", names.max_area_ratio,
         "Split charts in which the largest density is more than so many times the smallest; 0: do not. "
         "Default: that of the mode; with `--validator stencil` 2")
      ->check([](const std::string& text) {
        double value = 0;
        return CLI::detail::lexical_cast(text, value) && (value == 0 || value >= 1)
                   ? std::string()
                   : "must be at least 1, or 0 for no bound";
      });
  add("--packer", names.packer, internal::models_of_stage("packer"),
      "Who puts charts on pages. `horizon`: section 4 of Levy et al. 2002; `rectangles` on a horizon, and in "
      "`rows`, for comparison");
}

void check(const Stage_choice& names)
{
  try {
    internal::check(names);
  } catch (const Invalid_argument& e) {
    throw CLI::ValidationError("--" + e.argument(), std::string(e.what()).substr(e.argument().size() + 1));
  }
}

Policies policies_of(const Stage_choice& names, Atlas_mode mode, const Merge_options& merge,
                     Symmetry symmetry, Packing_effort effort)
{
  Policies policies =
      mode == Atlas_mode::paper ? paper_preset(Stencil_validator()) : preset(mode, merge, symmetry);
  set_stages(names, mode, effort, policies);
  set_validator(names, mode, policies);
  return policies;
}
