// SPDX-License-Identifier: MIT
// What the charts of some materials may do, for the programs that have options for it.
#ifndef MATERIAL_RULES_H
#define MATERIAL_RULES_H

#include <Atlas/soup/Polygon_soup.h>
#include <Atlas/soup/internal/Material_packer.h>

#include <string>
#include <vector>

/// Wishes as they are on the command line, by names of materials.
struct Material_rules
{
  std::vector<std::string> weights; ///< "NAME=FACTOR"
  std::vector<std::string> grouped, locked;
};

/// Refuses what has no meaning for any file. \throw CLI::ValidationError
void check(const Material_rules& rules);

using Atlas::internal::Material_rule;

/// The rules for each material of a model. \throw CLI::ValidationError if one of them is not there
std::vector<Material_rule> rules_of(const Material_rules& rules, const Atlas::Polygon_soup& model);

#endif
