// SPDX-License-Identifier: MIT
// The tables of models. A new model is a new line.
#include "policies.h"

#include <Atlas/packing/Horizon_packer.h>
#include <Atlas/parameterization/ABF_parameterizer.h>
#include <Atlas/parameterization/ARAP_parameterizer.h>
#include <Atlas/parameterization/Bijective_parameterizer.h>
#include <Atlas/parameterization/Fixed_border_parameterizer.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/parameterization/Spectral_parameterizer.h>
#include <Atlas/segmentation/Feature_segmentation.h>
#include <Atlas/segmentation/Normal_segmentation.h>
#include <Atlas/segmentation/Patch_segmentation.h>
#include <Atlas/segmentation/Region_growing_segmentation.h>
#include <Atlas/segmentation/Variational_segmentation.h>
#include <Atlas/validation/Culprit_splitter.h>
#include <Atlas/validation/Exact_validator.h>
#include <Atlas/validation/Stencil_validator.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <map>
#include <set>

namespace {

using namespace Atlas;

template <typename Value>
using Table = std::map<std::string, Value>;

const Table<Any_segmentation>& segmentations()
{
  static const Table<Any_segmentation> table{
      {"features", Feature_segmentation()},        {"paper", Feature_segmentation::paper()},
      {"normals", Normal_segmentation()},          {"region-growing", Region_growing_segmentation()},
      {"variational", Variational_segmentation()}, {"seams", Patch_segmentation()},
  };
  return table;
}

/// LSCM with a solver, and the pins of the paper or those that are quicker to find.
template <LSCMSolver Solver>
Any_parameterizer lscm(bool has_diameter_pins)
{
  if (has_diameter_pins)
    return LSCM_parameterizer<Diameter_LSCM_traits<Solver>>();
  return LSCM_parameterizer<Basic_LSCM_traits<Solver>>();
}

using Make_lscm = Any_parameterizer (*)(bool has_diameter_pins);

/// The solvers of LSCM.
const Table<Make_lscm>& solvers()
{
  static const Table<Make_lscm> table{
      {"direct", lscm<Direct_LSCM_solver>},           {"cg", lscm<Conjugate_gradient_LSCM_solver>},
      {"pcg", lscm<Preconditioned_CG_LSCM_solver>},   {"multigrid", lscm<Multigrid_LSCM_solver>},
      {"out-of-core", lscm<Out_of_core_LSCM_solver>},
  };
  return table;
}

/// Parameterizers that begin with LSCM, made of it.
const Table<std::function<Any_parameterizer(Any_parameterizer)>>& lscm_parameterizers()
{
  static const Table<std::function<Any_parameterizer(Any_parameterizer)>> table{
      {"lscm", [](Any_parameterizer first) { return first; }},
      {"bijective",
       [](Any_parameterizer first) {
         return Bijective_parameterizer(Optimize_charts::always, {}, std::move(first));
       }},
      {"bijective-conformal",
       [](Any_parameterizer first) {
         return Bijective_parameterizer(Optimize_charts::if_needed, {}, std::move(first));
       }},
  };
  return table;
}

const Table<Any_parameterizer>& other_parameterizers()
{
  static const Table<Any_parameterizer> table{
      {"abf", ABF_parameterizer()},
      {"arap", ARAP_parameterizer()},
      {"floater", Floater_parameterizer()},
      {"harmonic", Harmonic_parameterizer()},
      {"mean-value", Mean_value_parameterizer()},
      {"schnyder", Schnyder_parameterizer()},
      {"spectral", Spectral_parameterizer()},
      {"tutte", Tutte_parameterizer()},
  };
  return table;
}

Any_optimizer stretch_with_fixed_border()
{
  Distortion_options options;
  options.keeps_border = true;
  return Stretch_optimizer(options);
}

const Table<Any_optimizer>& optimizers()
{
  static const Table<Any_optimizer> table{
      {"none", Identity_optimizer()},
      {"symmetric-dirichlet", Symmetric_dirichlet_optimizer()},
      {"mips", MIPS_optimizer()},
      {"stretch", Stretch_optimizer()},
      {"stretch-fixed-border", stretch_with_fixed_border()},
      {"conformal-stretch", Conformal_stretch_optimizer()},
  };
  return table;
}

const Table<Any_packer (*)(Packing_effort)>& packers()
{
  static const Table<Any_packer (*)(Packing_effort)> table{
      {"raster", [](Packing_effort effort) -> Any_packer { return Raster_packer(effort); }},
      {"horizon", [](Packing_effort) -> Any_packer { return Horizon_packer(); }},
      {"rectangles", [](Packing_effort) -> Any_packer { return Rectangle_packer(); }},
      {"rows", [](Packing_effort) -> Any_packer { return Row_packer(); }},
  };
  return table;
}

/// The names of tables, for a check and its message.
template <typename... Tables>
CLI::IsMember names_in(const Tables&... tables)
{
  std::set<std::string> names;
  const auto add = [&](const auto& table) {
    for (const auto& [name, value] : table)
      names.insert(name);
  };
  (add(tables), ...);
  return CLI::IsMember(names);
}

/// `value` if there is a name, else `otherwise`.
std::string or_else(const std::string& value, const char* otherwise)
{
  return value.empty() ? otherwise : value;
}

Any_parameterizer parameterizer_of(const Stage_names& names, Atlas_mode mode)
{
  const bool is_paper = mode == Atlas_mode::paper;
  const std::string name =
      or_else(names.parameterizer, is_paper                        ? "lscm"
                                   : mode == Atlas_mode::conformal ? "bijective-conformal"
                                                                   : "bijective");
  if (const auto other = other_parameterizers().find(name); other != other_parameterizers().end())
    return other->second;
  const Make_lscm make = solvers().at(or_else(names.solver, is_paper ? "cg" : "direct"));
  return lscm_parameterizers().at(name)(
      make(or_else(names.pins, is_paper ? "diameter" : "sweep") == "diameter"));
}

/// The validator and the splitter that goes with it.
void set_validator(const Stage_names& names, Atlas_mode mode, Policies& policies)
{
  const bool is_paper = mode == Atlas_mode::paper;
  const double ratio = names.max_area_ratio < 0 ? default_max_area_ratio : names.max_area_ratio;
  const double quantile = is_paper ? 0 : default_density_quantile;
  if (or_else(names.validator, is_paper ? "stencil" : "exact") == "stencil") {
    policies.validator = Stencil_validator(default_stencil_resolution, ratio);
    policies.splitter = Stencil_validator(default_stencil_resolution, ratio);
  } else if (is_paper || names.max_area_ratio >= 0) {
    policies.validator = Exact_validator(ratio, quantile);
    policies.splitter = Culprit_splitter(quantile);
  }
}

} // namespace

void add_stage_options(CLI::App& app, Stage_names& names)
{
  const auto add = [&](const char* option, std::string& name, const CLI::IsMember& known,
                       const std::string& description) {
    return app.add_option(option, name, description + ". Default: that of the mode")->check(known);
  };
  add("--segmentation", names.segmentation, names_in(segmentations()),
      "Who cuts the surface into charts, which are not merged then. `features`: section 3 of Levy et al. "
      "2002; "
      "`paper`: the same to the letter; `seams`: nobody, there are only the seams of --seams, "
      "--separate-materials and --hard-angle, and what discs need");
  add("--parameterizer", names.parameterizer, names_in(lscm_parameterizers(), other_parameterizers()),
      "Who flattens charts. `bijective`: LSCM, made one-to-one, with low symmetric Dirichlet energy; "
      "`bijective-conformal`: LSCM, made one-to-one only where it is not");
  add("--solver", names.solver, names_in(solvers()), "Who solves the linear system of LSCM");
  add("--pins", names.pins, CLI::IsMember({"diameter", "sweep"}),
      "Which two vertices LSCM pins: the ends of the `diameter` of the chart's graph, or those of a double "
      "`sweep`, which are quicker to find");
  add("--optimizer", names.optimizer, names_in(optimizers()),
      "Who lowers the distortion of flattened charts; in the mode `paper` that is done when they are "
      "accepted");
  add("--validator", names.validator, CLI::IsMember({"exact", "stencil"}),
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
  add("--packer", names.packer, names_in(packers()),
      "Who puts charts on pages. `horizon`: section 4 of Levy et al. 2002; `rectangles` on a horizon, and in "
      "`rows`, for comparison");
}

void check(const Stage_names& names)
{
  const bool has_lscm = names.parameterizer.empty() || lscm_parameterizers().contains(names.parameterizer);
  for (const auto& [option, name] : {std::pair("--solver", &names.solver), {"--pins", &names.pins}})
    if (!name->empty() && !has_lscm)
      throw CLI::ValidationError(option, "speaks to LSCM, which --parameterizer " + names.parameterizer +
                                             " does not begin with");
}

Policies policies_of(const Stage_names& names, Atlas_mode mode, const Merge_options& merge, Symmetry symmetry,
                     Packing_effort effort)
{
  Policies policies =
      mode == Atlas_mode::paper ? paper_preset(Stencil_validator()) : preset(mode, merge, symmetry);
  if (!names.segmentation.empty())
    policies.segmentation = segmentations().at(names.segmentation);
  if (!names.parameterizer.empty() || !names.solver.empty() || !names.pins.empty())
    policies.parameterizer = parameterizer_of(names, mode);
  if (!names.optimizer.empty())
    policies.optimizer = optimizers().at(names.optimizer);
  set_validator(names, mode, policies);
  if (!names.packer.empty())
    policies.packer = packers().at(names.packer)(effort);
  else if (mode != Atlas_mode::paper)
    policies.packer = Raster_packer(effort);
  return policies;
}
