// SPDX-License-Identifier: MIT
// Vertices whose coordinates the user gives.
#include <Atlas/core/errors.h>

#include "texture_atlas.h"
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace {

/// The places of vertices of the mesh, counting from 0, by the lines `vertex u v` of a file.
std::map<Atlas::Index, Atlas::Point_2> read_places(const std::string& name, std::size_t number_of_vertices)
{
  std::ifstream file(name);
  if (!file)
    throw Atlas::IO_error(name + ": cannot be opened");
  std::map<Atlas::Index, Atlas::Point_2> places;
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    const auto start = line.find_first_not_of(" \t\r");
    if (start == std::string::npos || line[start] == '#')
      continue;
    const auto fail = [&](const std::string& fault) {
      throw Atlas::IO_error(name + ": line " + std::to_string(number) + ": " + fault);
    };
    std::istringstream stream(line);
    long long vertex = 0;
    float u = 0, v = 0; // as they are stored
    std::string rest;
    if (!(stream >> vertex >> u >> v) || stream >> rest)
      fail("a vertex and two coordinates expected");
    const auto count = static_cast<long long>(number_of_vertices);
    const long long index = vertex < 0 ? count + vertex : vertex - 1;
    if (index < 0 || index >= count)
      fail("there is no vertex " + std::to_string(vertex));
    if (!(u >= 0 && u <= 1 && v >= 0 && v <= 1))
      fail("coordinates must be in [0, 1]");
    places[static_cast<Atlas::Index>(index)] = Atlas::Point_2(u, v);
  }
  if (places.empty())
    throw Atlas::IO_error(name + ": has no line `vertex u v`");
  return places;
}

} // namespace

std::vector<bool> pin_vertices(const std::string& file, Atlas::Polygon_soup& model)
{
  const std::map<Atlas::Index, Atlas::Point_2> places = read_places(file, model.points.size());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<bool> is_pinned(model.number_of_corners(), false);
  model.uv.resize(model.number_of_corners(), Atlas::Point_2(nan, nan));
  for (std::size_t c = 0; c < is_pinned.size(); ++c)
    if (const auto place = places.find(model.vertices[c]); place != places.end()) {
      is_pinned[c] = true;
      model.uv[c] = place->second;
    }
  return is_pinned;
}
