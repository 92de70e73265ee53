// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_PAGE_MATERIAL_NAME_H
#define ATLAS_IO_INTERNAL_PAGE_MATERIAL_NAME_H

#include <Atlas/IO/write_model.h>
#include <Atlas/core/Packing.h>
#include <Atlas/image/pages.h>
#include <Atlas/soup/Polygon_soup.h>

#include <string>

namespace Atlas::internal {

/// The name of a material; where every page has materials of its own, with the number of its tile.
inline std::string page_material_name(const Polygon_soup& soup, Index material, Index page, bool names_pages)
{
  const std::string name = material == no_index ? default_material_name : soup.material_names[material];
  return names_pages ? name + '.' + std::to_string(udim_tile(page)) : name;
}

} // namespace Atlas::internal

#endif
