// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_INTERNAL_NAMED_STAGES_IMPL_H
#define ATLAS_SOUP_INTERNAL_NAMED_STAGES_IMPL_H

#include <Atlas/core/errors.h>
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
#include <Atlas/soup/internal/named_stages.h>

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

namespace Atlas::internal {

// The tables of models. A new model is a new line.
template <typename Model>
using Models = std::map<std::string, Model>;

inline const Models<Any_segmentation>& segmentations()
{
  static const Models<Any_segmentation> table{
      {"features", Feature_segmentation()},        {"paper", Feature_segmentation::paper()},
      {"normals", Normal_segmentation()},          {"region-growing", Region_growing_segmentation()},
      {"variational", Variational_segmentation()}, {"seams", Patch_segmentation()},
  };
  return table;
}

/// LSCM with a solver, and the pins of the paper or those that are quicker to find.
template <LSCMSolver Solver>
Any_parameterizer lscm_by(bool has_diameter_pins)
{
  if (has_diameter_pins)
    return LSCM_parameterizer<Diameter_LSCM_traits<Solver>>();
  return LSCM_parameterizer<Basic_LSCM_traits<Solver>>();
}

using Make_lscm = Any_parameterizer (*)(bool has_diameter_pins);

/// The solvers of LSCM.
inline const Models<Make_lscm>& lscm_solvers()
{
  static const Models<Make_lscm> table{
      {"direct", lscm_by<Direct_LSCM_solver>},           {"cg", lscm_by<Conjugate_gradient_LSCM_solver>},
      {"pcg", lscm_by<Preconditioned_CG_LSCM_solver>},   {"multigrid", lscm_by<Multigrid_LSCM_solver>},
      {"out-of-core", lscm_by<Out_of_core_LSCM_solver>},
  };
  return table;
}

/// Parameterizers that begin with LSCM, made of it.
inline const Models<std::function<Any_parameterizer(Any_parameterizer)>>& lscm_parameterizers()
{
  static const Models<std::function<Any_parameterizer(Any_parameterizer)>> table{
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

inline const Models<Any_parameterizer>& other_parameterizers()
{
  static const Models<Any_parameterizer> table{
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

inline Any_optimizer stretch_with_fixed_border()
{
  Distortion_options options;
  options.keeps_border = true;
  return Stretch_optimizer(options);
}

inline const Models<Any_optimizer>& named_optimizers()
{
  static const Models<Any_optimizer> table{
      {"none", Identity_optimizer()},
      {"symmetric-dirichlet", Symmetric_dirichlet_optimizer()},
      {"mips", MIPS_optimizer()},
      {"stretch", Stretch_optimizer()},
      {"stretch-fixed-border", stretch_with_fixed_border()},
      {"conformal-stretch", Conformal_stretch_optimizer()},
  };
  return table;
}

inline const Models<Any_packer (*)(Packing_effort)>& named_packers()
{
  static const Models<Any_packer (*)(Packing_effort)> table{
      {"raster", [](Packing_effort effort) -> Any_packer { return Raster_packer(effort); }},
      {"horizon", [](Packing_effort) -> Any_packer { return Horizon_packer(); }},
      {"rectangles", [](Packing_effort) -> Any_packer { return Rectangle_packer(); }},
      {"rows", [](Packing_effort) -> Any_packer { return Row_packer(); }},
  };
  return table;
}

/// The stages with their members and the names of their models.
inline const auto& named_stages()
{
  struct Entry
  {
    const char* stage;
    std::string Stage_names::*member;
    std::vector<std::string> models;
  };
  static const std::vector<Entry> table = [] {
    const auto names = [](const auto&... models) {
      std::vector<std::string> result;
      const auto add = [&](const auto& of) {
        for (const auto& entry : of)
          result.push_back(entry.first);
      };
      (add(models), ...);
      std::sort(result.begin(), result.end());
      return result;
    };
    return std::vector<Entry>{
        {"segmentation", &Stage_names::segmentation, names(segmentations())},
        {"parameterizer", &Stage_names::parameterizer, names(lscm_parameterizers(), other_parameterizers())},
        {"solver", &Stage_names::solver, names(lscm_solvers())},
        {"pins", &Stage_names::pins, {"diameter", "sweep"}},
        {"optimizer", &Stage_names::optimizer, names(named_optimizers())},
        {"packer", &Stage_names::packer, names(named_packers())},
    };
  }();
  return table;
}

ATLAS_INLINE std::vector<std::string> models_of_stage(const std::string& stage)
{
  for (const auto& entry : named_stages())
    if (stage == entry.stage)
      return entry.models;
  return {};
}

ATLAS_INLINE void check(const Stage_names& names)
{
  for (const auto& entry : named_stages()) {
    const std::string& name = names.*entry.member;
    if (name.empty() || std::find(entry.models.begin(), entry.models.end(), name) != entry.models.end())
      continue;
    std::string known;
    for (const std::string& model : entry.models)
      known += (known.empty() ? "'" : ", '") + model + '\'';
    throw Invalid_argument(entry.stage, "must be one of " + known + ", but is '" + name + '\'');
  }
  const bool has_lscm = names.parameterizer.empty() || lscm_parameterizers().contains(names.parameterizer);
  for (const auto& [stage, name] : {std::pair("solver", &names.solver), {"pins", &names.pins}})
    if (!name->empty() && !has_lscm)
      throw Invalid_argument(stage, "speaks to LSCM, which the parameterizer '" + names.parameterizer +
                                        "' does not begin with");
}

inline Any_parameterizer named_parameterizer(const Stage_names& names, Atlas_mode mode)
{
  const auto or_else = [](const std::string& name, const char* otherwise) {
    return name.empty() ? std::string(otherwise) : name;
  };
  const bool is_paper = mode == Atlas_mode::paper;
  const std::string name =
      or_else(names.parameterizer, is_paper                        ? "lscm"
                                   : mode == Atlas_mode::conformal ? "bijective-conformal"
                                                                   : "bijective");
  if (const auto other = other_parameterizers().find(name); other != other_parameterizers().end())
    return other->second;
  const Make_lscm make = lscm_solvers().at(or_else(names.solver, is_paper ? "cg" : "direct"));
  return lscm_parameterizers().at(name)(
      make(or_else(names.pins, is_paper ? "diameter" : "sweep") == "diameter"));
}

ATLAS_INLINE void set_stages(const Stage_names& names, Atlas_mode mode, Packing_effort effort,
                             Policies& policies)
{
  if (!names.segmentation.empty())
    policies.segmentation = segmentations().at(names.segmentation);
  if (!names.parameterizer.empty() || !names.solver.empty() || !names.pins.empty())
    policies.parameterizer = named_parameterizer(names, mode);
  if (!names.optimizer.empty())
    policies.optimizer = named_optimizers().at(names.optimizer);
  if (!names.packer.empty())
    policies.packer = named_packers().at(names.packer)(effort);
  else if (mode != Atlas_mode::paper)
    policies.packer = Raster_packer(effort);
}

} // namespace Atlas::internal

#endif
