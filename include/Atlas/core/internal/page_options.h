// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_PAGE_OPTIONS_H
#define ATLAS_CORE_INTERNAL_PAGE_OPTIONS_H

#include <Atlas/core/Packing.h>
#include <Atlas/core/parameters.h>

#include <CGAL/assertions.h>

#include <type_traits>

namespace Atlas::internal {

/// The page that a pack of named parameters asks for.
template <typename NamedParameters>
Page_options page_options(const NamedParameters& np, const Page_options& defaults = {})
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  Page_options page = choose_parameter(get_parameter(np, page_options_t()), defaults);
  const auto size = get_parameter(np, texture_size_t());
  if constexpr (!std::is_same_v<std::remove_cvref_t<decltype(size)>, CGAL::internal_np::Param_not_found>) {
    CGAL_precondition_msg(size > 0, "texture_size must be positive");
    page.width = page.height = static_cast<Index>(size);
  }
  page.gutter = static_cast<double>(choose_parameter(get_parameter(np, gutter_t()), page.gutter));
  CGAL_precondition_msg(page.width > 0 && page.height > 0, "the page must have at least one texel");
  CGAL_precondition_msg(page.gutter >= 0, "the gutter must not be negative");
  return page;
}

} // namespace Atlas::internal

#endif
