// SPDX-License-Identifier: MIT
#ifndef MATERIAL_PACKER_H
#define MATERIAL_PACKER_H

#include <Atlas/core/Any_policies.h>
#include <Atlas/core/errors.h>
#include <Atlas/packing/pack_charts.h>

#include "Material_rules.h"
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

/// \brief A packer under rules for materials; a chart has the material of its first face.
///
/// Grouped and locked charts have the places of the file's coordinates, whatever has been done to their size
/// and place since. Charts that have another shape than in the file are as free as all others. For
/// weights see `set_weights()`. Models `ChartPacker`.
struct Material_packer
{
  const Atlas::Surface& surface;    ///< what the charts will come from
  const Atlas::Polygon_soup& model; ///< with the coordinates of the file
  std::vector<Material_rule> rules; ///< per material. \see `rules_of()`
  Atlas::Any_packer packer;

  Atlas::Packing pack(std::span<const Atlas::Chart> charts, const Atlas::Page_options& options,
                      const Atlas::Execution& execution) const
  {
    Atlas::Page_options page = options;
    const bool is_plain = std::none_of(rules.begin(), rules.end(),
                                       [](const auto& rule) { return rule.is_grouped || rule.is_locked; });
    for (std::size_t c = 0; c < charts.size() && !is_plain; ++c) {
      const Atlas::Index material = material_of(model, surface, charts[c]);
      const Material_rule rule = material == Atlas::no_index ? Material_rule() : rules[material];
      const auto place = Atlas::place_of_chart(surface, charts[c], model.uv);
      page.locked.emplace_back();
      if (place && rule.is_locked && !(page.locked[c] = place_on_tile(*place, charts[c], page.width)))
        throw Atlas::IO_error("a locked chart lies outside of the tiles 1001 to 9999");
      page.groups.push_back(place && rule.is_grouped && !rule.is_locked ? material : Atlas::no_index);
      page.places_in_group.push_back(place.value_or(Atlas::Placement()));
    }
    Atlas::Packing packing = packer.pack(charts, page, execution);
    if (packing.number_of_pages == 0 && !charts.empty() && !is_plain && !execution.is_cancelled())
      throw Atlas::IO_error("the page has no room for the charts, those that are locked included");
    return packing;
  }
};

#endif
