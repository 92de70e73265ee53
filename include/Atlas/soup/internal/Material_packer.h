// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_INTERNAL_MATERIAL_PACKER_H
#define ATLAS_SOUP_INTERNAL_MATERIAL_PACKER_H

#include <Atlas/core/Any_policies.h>
#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Packing.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/errors.h>
#include <Atlas/packing/pack_charts.h>
#include <Atlas/soup/Polygon_soup.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace Atlas::internal {

/// What the charts of one material may do.
struct Material_rule
{
  double weight = 1; ///< so many times the density of the others, positive
  bool is_grouped = false, is_locked = false;
};

/// The material of a face; `no_index` if it has none.
inline Index material_of(const Polygon_soup& model, Index face)
{
  return model.face_material.empty() ? no_index : model.face_material[face];
}

/// The material of a chart: that of its first face.
inline Index material_of(const Polygon_soup& model, const Surface& surface, const Chart& chart)
{
  return chart.source.empty() ? no_index : material_of(model, surface.face[chart.source.front()]);
}

/// Gives triangles the weights of their materials, unless all materials weigh the same.
/// \param rules  per material of the model
inline void set_weights(const std::vector<Material_rule>& rules, const Polygon_soup& model, Surface& surface)
{
  if (std::all_of(rules.begin(), rules.end(), [](const auto& rule) { return rule.weight == 1; }))
    return;
  surface.density_weight.clear();
  for (const Index face : surface.face) {
    const Index material = material_of(model, face);
    surface.density_weight.push_back(material == no_index ? 1 : rules[material].weight);
  }
}

/// \brief A packer under rules for materials; a chart has the material of its first face.
///
/// Grouped and locked charts have the places of the file's coordinates, whatever has been done to their size
/// and place since. Charts that have another shape than in the file are as free as all others. For
/// weights see `set_weights()`. Models `ChartPacker`.
struct Material_packer
{
  const Surface& surface;           ///< what the charts will come from
  const Polygon_soup& model;        ///< with the coordinates of the file
  std::vector<Material_rule> rules; ///< per material
  Any_packer packer;

  /// \throws IO_error if a locked chart does not lie on a tile, or leaves no room for the others
  Packing pack(std::span<const Chart> charts, const Page_options& options, const Execution& execution) const
  {
    Page_options page = options;
    const bool is_plain = std::none_of(rules.begin(), rules.end(),
                                       [](const auto& rule) { return rule.is_grouped || rule.is_locked; });
    for (std::size_t c = 0; c < charts.size() && !is_plain; ++c) {
      const Index material = material_of(model, surface, charts[c]);
      const Material_rule rule = material == no_index ? Material_rule() : rules[material];
      const auto place = place_of_chart(surface, charts[c], model.uv);
      page.locked.emplace_back();
      if (place && rule.is_locked && !(page.locked[c] = place_on_tile(*place, charts[c], page.width)))
        throw IO_error(
            "a chart that is to stay lies outside of the tiles 1001 to 9999, or goes beyond its tile");
      page.groups.push_back(place && rule.is_grouped && !rule.is_locked ? material : no_index);
      page.places_in_group.push_back(place.value_or(Placement()));
    }
    Packing packing = packer.pack(charts, page, execution);
    if (packing.number_of_pages == 0 && !charts.empty() && !is_plain && !execution.is_cancelled())
      throw IO_error("the page has no room for the charts, those that are locked included");
    return packing;
  }
};

} // namespace Atlas::internal

#endif
