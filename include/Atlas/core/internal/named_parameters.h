// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_NAMED_PARAMETERS_H
#define ATLAS_CORE_INTERNAL_NAMED_PARAMETERS_H

#include <Atlas/core/Packing.h>
#include <Atlas/core/errors.h>
#include <Atlas/core/parameters.h>

#include <CGAL/boost/graph/named_params_helper.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

namespace Atlas::internal {

using CGAL::internal_np::Param_not_found;

/// Whether a tag is one of a list.
template <typename Tag, typename... Known>
inline constexpr bool is_one_of = (std::is_same_v<Tag, Known> || ...);

/// Fails to compile when a pack has a name that the function does not know: it would be ignored.
template <typename... Known>
struct Only_names
{
  template <typename T, typename Tag, typename Base>
  static constexpr void check(const CGAL::Named_function_parameters<T, Tag, Base>*)
  {
    static_assert(is_one_of<Tag, CGAL::internal_np::all_default_t, Known...>,
                  "this function has no such named parameter");
    if constexpr (!std::is_same_v<Base, CGAL::internal_np::No_property>)
      check(static_cast<const Base*>(nullptr));
  }
};

/// The parameter as it was given, or `Param_not_found`.
template <typename Tag, typename NamedParameters>
decltype(auto) parameter(const NamedParameters& np, Tag tag = {})
{
  return CGAL::parameters::get_parameter(np, tag);
}

/// Whether a parameter was given.
template <typename Tag, typename NamedParameters>
inline constexpr bool has_parameter =
    !std::is_same_v<std::remove_cvref_t<decltype(CGAL::parameters::get_parameter(
                        std::declval<const NamedParameters&>(), std::declval<Tag>()))>,
                    Param_not_found>;

/// Stores a parameter in `place` if it was given.
template <typename Tag, typename NamedParameters, typename Place>
void read_parameter(const NamedParameters& np, Place& place)
{
  if constexpr (has_parameter<Tag, NamedParameters>)
    place = CGAL::parameters::get_parameter(np, Tag());
}

/// A count of any number type that has to be in [least, most].
template <typename Count>
std::size_t checked_count(const char* name, const Count& count, std::size_t least, std::size_t most)
{
  const double value = static_cast<double>(count);
  if (!(value >= static_cast<double>(least) && value <= static_cast<double>(most) &&
        value == std::floor(value)))
    throw Invalid_argument(name, "must be a whole number from " + std::to_string(least) + " to " +
                                     std::to_string(most) + ", but is " + std::to_string(value));
  return static_cast<std::size_t>(value);
}

/// Stores a count in `place` if it was given.
template <typename Tag, typename NamedParameters, typename Place>
void read_count(const NamedParameters& np, const char* name, std::size_t least, std::size_t most,
                Place& place)
{
  if constexpr (has_parameter<Tag, NamedParameters>)
    place = static_cast<Index>(checked_count(name, CGAL::parameters::get_parameter(np, Tag()), least, most));
}

/// The page that a pack of named parameters asks for.
template <typename NamedParameters>
Page_options page_options(const NamedParameters& np, const Page_options& defaults = {})
{
  Page_options page = defaults;
  read_parameter<page_options_t>(np, page);
  if constexpr (has_parameter<texture_size_t, NamedParameters>) {
    read_count<texture_size_t>(np, "texture_size", 1, max_page_side, page.width);
    page.height = page.width;
  }
  if constexpr (has_parameter<gutter_t, NamedParameters>)
    page.gutter = static_cast<double>(CGAL::parameters::get_parameter(np, gutter_t()));
  return page;
}

/// The number of threads that a pack asks for.
template <typename NamedParameters>
unsigned number_of_threads(const NamedParameters& np)
{
  unsigned threads = 0;
  read_count<number_of_threads_t>(np, "number_of_threads", 0, std::numeric_limits<std::uint16_t>::max(),
                                  threads);
  return threads;
}

} // namespace Atlas::internal

#endif
