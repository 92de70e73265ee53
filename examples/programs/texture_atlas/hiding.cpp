// SPDX-License-Identifier: MIT
// From whom seams are hidden.
#include <Atlas/core/errors.h>
#include <Atlas/segmentation/smooth_borders.h>

#include "texture_atlas.h"
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace {

/// `x`, `-x`, `y`, ... or three numbers with commas; nothing if it is neither, or all are 0.
std::optional<Atlas::Vector_3> axis_of(const std::string& text)
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
  return Atlas::Vector_3(axis[0], axis[1], axis[2]);
}

/// What comes after a keyword and a colon.
std::optional<std::string> argument_of(const std::string& text, const std::string& keyword)
{
  if (!text.starts_with(keyword + ':'))
    return std::nullopt;
  return text.substr(keyword.size() + 1);
}

/// The viewers that the text names, if it names any.
std::optional<Atlas::Seam_hiding> viewers_of(const std::string& text)
{
  if (text == "openness")
    return Atlas::Seam_hiding::openness();
  if (const auto argument = argument_of(text, "dome"))
    if (const auto axis = axis_of(*argument))
      return Atlas::Seam_hiding::dome(*axis);
  if (const auto argument = argument_of(text, "view"))
    if (const auto axis = axis_of(*argument))
      return Atlas::Seam_hiding::view(*axis);
  return std::nullopt;
}

/// How much each vertex is seen: white is seen, black is not.
std::vector<double> visibility_of_colors(const Options& options, const Atlas::Polygon_soup& model)
{
  if (model.colors.empty())
    throw Atlas::IO_error(options.name() + ": the vertices have no colours that tell where seams are hidden");
  std::vector<double> visibility;
  for (const auto& [red, green, blue, alpha] : model.colors)
    visibility.push_back(std::clamp((double(red) + double(green) + double(blue)) / 3, 0., 1.));
  return visibility;
}

/// A number per vertex, in order; what follows a `#` is passed over.
std::vector<double> read_visibility(const std::string& name, std::size_t vertices)
{
  std::ifstream file(name);
  if (!file)
    throw Atlas::IO_error(name + ": cannot be opened");
  std::vector<double> visibility;
  std::string line, word;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    std::istringstream stream(line.substr(0, line.find('#')));
    while (stream >> word) {
      double value = -1;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc() || end != word.data() + word.size() || !(value >= 0 && value <= 1))
        throw Atlas::IO_error(name + ": line " + std::to_string(number) + ": '" + word +
                              "' is no number in [0, 1]");
      visibility.push_back(value);
    }
  }
  if (visibility.size() != vertices)
    throw Atlas::IO_error(name + ": has " + std::to_string(visibility.size()) +
                          " numbers, but the mesh has " + std::to_string(vertices) + " vertices");
  return visibility;
}

} // namespace

bool is_hiding(const std::string& text)
{
  return viewers_of(text) || (text != "dome" && text != "view" && !argument_of(text, "dome") &&
                              !argument_of(text, "view") && !text.empty());
}

void hide_seams(const Options& options, const Atlas::Polygon_soup& model, Atlas::Surface& surface)
{
  if (const auto viewers = viewers_of(options.hiding))
    Atlas::hide_seams(surface, *viewers, Atlas::Execution(options.threads));
  else if (options.hiding == "colors")
    Atlas::hide_seams(surface, visibility_of_colors(options, model));
  else
    Atlas::hide_seams(surface, read_visibility(options.hiding, model.points.size()));
}
