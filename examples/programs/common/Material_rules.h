// SPDX-License-Identifier: MIT
// What the charts of some materials may do, for the programs that have options for it.
#ifndef MATERIAL_RULES_H
#define MATERIAL_RULES_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Surface.h>
#include <Atlas/soup/Polygon_soup.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

/// Wishes as they are on the command line, by names of materials.
struct Material_rules
{
  std::vector<std::string> weights; ///< "NAME=FACTOR"
  std::vector<std::string> grouped, locked;
};

/// "NAME=FACTOR"; names may have an equals sign in them.
inline std::pair<std::string, double> read_weight(const std::string& text)
{
  const std::size_t equals = text.rfind('=');
  double factor = 0;
  if (equals == std::string::npos || !CLI::detail::lexical_cast(text.substr(equals + 1), factor) ||
      !(factor > 0 && std::isfinite(factor)))
    throw CLI::ValidationError("--weight", "'" + text + "' is not MATERIAL=FACTOR with a positive factor");
  return {text.substr(0, equals), factor};
}

/// Refuses what has no meaning for any file.
inline void check(const Material_rules& rules)
{
  for (const std::string& text : rules.weights)
    (void)read_weight(text);
}

/// The rules for one material.
struct Material_rule
{
  double weight = 1;
  bool is_grouped = false, is_locked = false;
};

/// The rules for each material of a model. \throw CLI::ValidationError if one of them is not there
inline std::vector<Material_rule> rules_of(const Material_rules& rules, const Atlas::Polygon_soup& model)
{
  std::vector<Material_rule> result(model.material_names.size());
  const auto rule_of = [&](const std::string& name, const char* option) -> Material_rule& {
    const auto& names = model.material_names;
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end())
      throw CLI::ValidationError(option, "there is no material called '" + name + "' in what was read");
    return result[static_cast<std::size_t>(at - names.begin())];
  };
  for (const std::string& text : rules.weights) {
    const auto [name, factor] = read_weight(text);
    rule_of(name, "--weight").weight = factor;
  }
  for (const std::string& name : rules.grouped)
    rule_of(name, "--group").is_grouped = true;
  for (const std::string& name : rules.locked)
    rule_of(name, "--lock").is_locked = true;
  return result;
}

/// The material of a face; `no_index` if it has none.
inline Atlas::Index material_of(const Atlas::Polygon_soup& model, Atlas::Index face)
{
  return model.face_material.empty() ? Atlas::no_index : model.face_material[face];
}

/// The material of a chart: that of its first face.
inline Atlas::Index material_of(const Atlas::Polygon_soup& model, const Atlas::Surface& surface,
                                const Atlas::Chart& chart)
{
  return chart.source.empty() ? Atlas::no_index : material_of(model, surface.face[chart.source.front()]);
}

/// Gives faces the weights of their materials.
inline void set_weights(const Material_rules& rules, const Atlas::Polygon_soup& model,
                        Atlas::Surface& surface)
{
  if (rules.weights.empty())
    return;
  const std::vector<Material_rule> rule = rules_of(rules, model);
  for (const Atlas::Index face : surface.face) {
    const Atlas::Index material = material_of(model, face);
    surface.density_weight.push_back(material == Atlas::no_index ? 1 : rule[material].weight);
  }
}

#endif
