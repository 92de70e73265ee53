// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_PACKING_IMPL_H
#define ATLAS_CORE_INTERNAL_PACKING_IMPL_H

#include <Atlas/core/Packing.h>
#include <Atlas/core/errors.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace Atlas {

namespace internal {

inline void require_range(Index value, Index least, Index most, const char* argument)
{
  if (value < least || value > most)
    throw Invalid_argument(argument, "must be between " + std::to_string(least) + " and " +
                                         std::to_string(most) + ", but is " + std::to_string(value));
}

inline void require_finite_not_negative(double value, const char* argument)
{
  if (!(value >= 0 && std::isfinite(value)))
    throw Invalid_argument(argument, "must be finite and not negative, but is " + std::to_string(value));
}

inline bool is_finite_place(const Placement& p)
{
  return std::isfinite(p.a) && std::isfinite(p.b) && std::isfinite(p.x) && std::isfinite(p.y);
}

/// Refuses lists with an entry that cannot be.
inline void check_lists(const Page_options& page)
{
  for (const double weight : page.weights)
    if (!(weight > 0 && std::isfinite(weight)))
      throw Invalid_argument("weights", "must be positive and finite, but one is " + std::to_string(weight));
  for (const Placement& place : page.places_in_group)
    require(is_finite_place(place) && !(place.a == 0 && place.b == 0), "places_in_group",
            "must be finite, with a scale that is not 0");
  for (const std::optional<Placement>& place : page.locked)
    if (place) {
      require(is_finite_place(*place), "locked", "must be finite places");
      require(place->page != no_index, "locked", "must be on pages that have a number");
    }
}

inline void require_length(std::size_t length, std::size_t charts, const char* argument)
{
  if (length != 0 && length != charts)
    throw Invalid_argument(argument, "must be empty or have one entry for each of " + std::to_string(charts) +
                                         " charts, but has " + std::to_string(length));
}

} // namespace internal

ATLAS_INLINE void check(const Page_options& page)
{
  internal::require_range(page.width, 1, max_page_side, "width");
  internal::require_range(page.height, 1, max_page_side, "height");
  internal::require_finite_not_negative(page.gutter, "gutter");
  internal::require_range(page.mip_levels, 0, max_mip_levels, "mip_levels");
  internal::require_range(page.block, 0, max_block, "block");
  internal::require_range(page.pages, 1, max_pages, "pages");
  internal::require_finite_not_negative(page.density, "density");
  if (const double gutter = page.effective_gutter(); !(2 * gutter < std::min(page.width, page.height)))
    throw Invalid_argument("gutter", "must leave room on a page of " + std::to_string(page.width) + " x " +
                                         std::to_string(page.height) +
                                         " texels, but with mip levels and blocks it is " +
                                         std::to_string(gutter));
  for (const double coordinate : page.up)
    internal::require(std::isfinite(coordinate), "up", "must be finite");
  internal::check_lists(page);
}

ATLAS_INLINE void check(const Page_options& page, std::size_t number_of_charts)
{
  check(page);
  internal::require_length(page.weights.size(), number_of_charts, "weights");
  internal::require_length(page.groups.size(), number_of_charts, "groups");
  internal::require_length(page.places_in_group.size(), number_of_charts, "places_in_group");
  internal::require_length(page.locked.size(), number_of_charts, "locked");
}

} // namespace Atlas

#endif
