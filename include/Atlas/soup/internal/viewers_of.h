// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_INTERNAL_VIEWERS_OF_H
#define ATLAS_SOUP_INTERNAL_VIEWERS_OF_H

#include <Atlas/core/Kernel.h>
#include <Atlas/segmentation/smooth_borders.h>

#include <array>
#include <cstddef>
#include <optional>
#include <sstream>
#include <string>

namespace Atlas::internal {

/// `x`, `-x`, `y`, ... or three numbers with commas; nothing if it is neither, or all are 0.
inline std::optional<Vector_3> axis_of(const std::string& text)
{
  std::array<double, 3> axis{};
  const bool is_negative = text.starts_with('-');
  const std::string letter = text.substr(is_negative || text.starts_with('+') ? 1 : 0);
  if (letter == "x" || letter == "y" || letter == "z")
    axis[static_cast<std::size_t>(letter[0] - 'x')] = is_negative ? -1 : 1;
  else {
    std::istringstream stream(text);
    char comma = 0, other = 0;
    if (!(stream >> axis[0] >> comma >> axis[1] >> other >> axis[2]) || comma != ',' || other != ',' ||
        !(stream >> std::ws).eof())
      return std::nullopt;
  }
  if (axis == std::array<double, 3>{})
    return std::nullopt;
  return Vector_3(axis[0], axis[1], axis[2]);
}

/// What comes after a keyword and a colon.
inline std::optional<std::string> argument_of(const std::string& text, const std::string& keyword)
{
  if (!text.starts_with(keyword + ':'))
    return std::nullopt;
  return text.substr(keyword.size() + 1);
}

/// The viewers that the text names, if it names any.
inline std::optional<Seam_hiding> viewers_of(const std::string& text)
{
  if (text == "openness")
    return Seam_hiding::openness();
  if (const auto argument = argument_of(text, "dome"))
    if (const auto axis = axis_of(*argument))
      return Seam_hiding::dome(*axis);
  if (const auto argument = argument_of(text, "view"))
    if (const auto axis = axis_of(*argument))
      return Seam_hiding::view(*axis);
  return std::nullopt;
}

} // namespace Atlas::internal

#endif
