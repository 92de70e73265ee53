// SPDX-License-Identifier: MIT
#include "Material_rules.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace {

/// "NAME=FACTOR"; names may have an equals sign in them.
std::pair<std::string, double> read_weight(const std::string& text)
{
  const std::size_t equals = text.rfind('=');
  double factor = 0;
  if (equals == std::string::npos || !CLI::detail::lexical_cast(text.substr(equals + 1), factor) ||
      !(factor > 0 && std::isfinite(factor)))
    throw CLI::ValidationError("--weight", "'" + text + "' is not MATERIAL=FACTOR with a positive factor");
  return {text.substr(0, equals), factor};
}

} // namespace

void check(const Material_rules& rules)
{
  for (const std::string& text : rules.weights)
    (void)read_weight(text);
}

std::vector<Material_rule> rules_of(const Material_rules& rules, const Atlas::Polygon_soup& model)
{
  if (rules.weights.empty() && rules.grouped.empty() && rules.locked.empty())
    return {};
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
