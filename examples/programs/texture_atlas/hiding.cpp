// SPDX-License-Identifier: MIT
// From whom seams are hidden.
#include <Atlas/core/errors.h>
#include <Atlas/segmentation/smooth_borders.h>
#include <Atlas/soup/internal/viewers_of.h>

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
  return Atlas::internal::viewers_of(text) ||
         (text != "dome" && text != "view" && !Atlas::internal::argument_of(text, "dome") &&
          !Atlas::internal::argument_of(text, "view") && !text.empty());
}

void hide_seams(const Options& options, const Atlas::Polygon_soup& model, Atlas::Surface& surface)
{
  if (const auto viewers = Atlas::internal::viewers_of(options.hiding))
    Atlas::hide_seams(surface, *viewers, Atlas::Execution(options.threads));
  else if (options.hiding == "colors")
    Atlas::hide_seams(surface, visibility_of_colors(options, model));
  else
    Atlas::hide_seams(surface, read_visibility(options.hiding, model.points.size()));
}
