// SPDX-License-Identifier: MIT
// What the charts of some materials may do, for the programs that have options for it.
#ifndef MATERIAL_RULES_H
#define MATERIAL_RULES_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Surface.h>
#include <Atlas/soup/Polygon_soup.h>

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

/// The rules for one material.
struct Material_rule
{
  double weight = 1;
  bool is_grouped = false, is_locked = false;
};

/// The rules for each material of a model. \throw CLI::ValidationError if one of them is not there
std::vector<Material_rule> rules_of(const Material_rules& rules, const Atlas::Polygon_soup& model);

/// The material of a face; `no_index` if it has none.
Atlas::Index material_of(const Atlas::Polygon_soup& model, Atlas::Index face);

/// The material of a chart: that of its first face.
Atlas::Index material_of(const Atlas::Polygon_soup& model, const Atlas::Surface& surface,
                         const Atlas::Chart& chart);

/// Gives faces the weights of their materials.
void set_weights(const Material_rules& rules, const Atlas::Polygon_soup& model, Atlas::Surface& surface);

#endif
