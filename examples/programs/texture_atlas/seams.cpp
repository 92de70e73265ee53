// SPDX-License-Identifier: MIT
// Seams that the user draws.
#include <Atlas/core/errors.h>

#include "texture_atlas.h"
#include <array>
#include <charconv>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

/// Vertices of the mesh, counting from 0, with an edge between each and the next, and the line they are from.
struct Polyline
{
  std::vector<Atlas::Index> vertices;
  std::size_t line;
};

/// \brief Reads a file of seams.
///
/// A line `l a b c ...`, as in OBJ files, or just `a b c ...` is a chain of edges. Vertices count from 1, or
/// backwards from -1, and are those of the mesh; in a file with vertices of its own (`v x y z`) they are
/// those, and each stands for the vertices of the mesh at the same place. All other lines are passed over.
class Seam_reader
{
public:
  Seam_reader(std::string name, const Atlas::Polygon_soup& model) : name_(std::move(name)), model_(model) {}

  std::vector<Polyline> read()
  {
    std::ifstream file(name_);
    if (!file)
      throw Atlas::IO_error(name_ + ": cannot be opened");
    std::vector<std::pair<std::size_t, std::string>> chains;
    std::string line;
    for (std::size_t number = 1; std::getline(file, line); ++number)
      if (line.starts_with("v ") || line.starts_with("v\t"))
        read_point(line.substr(2), number);
      else if (line.starts_with("l ") || line.starts_with("l\t"))
        chains.emplace_back(number, line.substr(2));
      else if (const auto start = line.find_first_not_of(" \t\r");
               start != std::string::npos &&
               (line[start] == '-' || (line[start] >= '0' && line[start] <= '9')))
        chains.emplace_back(number, line);
    if (chains.empty())
      throw Atlas::IO_error(name_ + ": has no line with seams, `l a b ...` or `a b ...`");
    std::vector<Polyline> result;
    for (const auto& [number, text] : chains)
      result.push_back(read_chain(text, number));
    return result;
  }

private:
  [[noreturn]] void fail(std::size_t line, const std::string& fault) const
  {
    throw Atlas::IO_error(name_ + ": line " + std::to_string(line) + ": " + fault);
  }

  void read_point(const std::string& text, std::size_t line)
  {
    if (places_.empty())
      for (Atlas::Index v = 0; v < model_.points.size(); ++v)
        places_.try_emplace(key(model_.points[v]), v);
    std::istringstream stream(text);
    std::array<double, 3> p{};
    if (!(stream >> p[0] >> p[1] >> p[2]))
      fail(line, "three coordinates expected");
    const auto found = places_.find(p);
    own_.push_back(found == places_.end() ? Atlas::no_index : found->second);
  }

  static std::array<double, 3> key(const Atlas::Point_3& p) { return {p.x(), p.y(), p.z()}; }

  Polyline read_chain(const std::string& text, std::size_t line) const
  {
    Polyline chain{{}, line};
    std::istringstream stream(text);
    for (std::string word; stream >> word;)
      chain.vertices.push_back(vertex(word.substr(0, word.find('/')), line));
    if (chain.vertices.size() < 2)
      fail(line, "an edge has two vertices");
    return chain;
  }

  Atlas::Index vertex(const std::string& word, std::size_t line) const
  {
    long long number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size())
      fail(line, "'" + word + "' is no number of a vertex");
    const auto count = static_cast<long long>(own_.empty() ? model_.points.size() : own_.size());
    const long long index = number < 0 ? count + number : number - 1;
    if (index < 0 || index >= count)
      fail(line, "there is no vertex " + word);
    const auto i = static_cast<std::size_t>(index);
    if (own_.empty())
      return static_cast<Atlas::Index>(i);
    if (own_[i] == Atlas::no_index)
      fail(line, "vertex " + word + " is at no vertex of the mesh");
    return own_[i];
  }

  std::string name_;
  const Atlas::Polygon_soup& model_;
  std::map<std::array<double, 3>, Atlas::Index> places_; ///< the first vertex of the mesh at a place
  std::vector<Atlas::Index> own_;                        ///< per vertex of the file: that of the mesh
};

/// For each vertex the first of those at the same place: meshes may repeat vertices along old seams.
std::vector<Atlas::Index> first_at_place(const Atlas::Polygon_soup& model)
{
  std::map<std::array<double, 3>, Atlas::Index> places;
  std::vector<Atlas::Index> first(model.points.size());
  for (Atlas::Index v = 0; v < first.size(); ++v) {
    const Atlas::Point_3& p = model.points[v];
    first[v] = places.try_emplace({p.x(), p.y(), p.z()}, v).first->second;
  }
  return first;
}

} // namespace

void constrain_seams(const std::string& file, const Atlas::Polygon_soup& model, Atlas::Surface& surface)
{
  using Edge = std::pair<Atlas::Index, Atlas::Index>;
  const std::vector<Polyline> chains = Seam_reader(file, model).read();
  const std::vector<Atlas::Index> first = first_at_place(model);
  std::map<Edge, std::size_t> wanted; // with the line
  for (const Polyline& chain : chains)
    for (std::size_t i = 1; i < chain.vertices.size(); ++i)
      wanted.try_emplace(std::minmax(first[chain.vertices[i - 1]], first[chain.vertices[i]]), chain.line);
  std::set<Edge> found;
  surface.constraint.resize(surface.opposite.size(), Atlas::Edge_constraint::none);
  const auto vertex = [&](Atlas::Index h) { return first[model.vertices[surface.corner[h]]]; };
  for (Atlas::Index h = 0; h < surface.opposite.size(); ++h) {
    const Atlas::Index a = vertex(h), b = vertex(Atlas::next_halfedge(h));
    const Edge edge = std::minmax(a, b);
    if (!wanted.contains(edge) || surface.is_diagonal(h))
      continue;
    found.insert(edge);
    surface.constraint[h] = Atlas::Edge_constraint::seam;
    if (surface.opposite[h] != Atlas::no_index)
      surface.constraint[surface.opposite[h]] = Atlas::Edge_constraint::seam;
  }
  for (const auto& [edge, line] : wanted)
    if (!found.contains(edge))
      throw Atlas::IO_error(file + ": line " + std::to_string(line) +
                            ": no edge of the mesh runs from vertex " + std::to_string(edge.first + 1) +
                            " to vertex " + std::to_string(edge.second + 1) + ", counting from 1");
}
