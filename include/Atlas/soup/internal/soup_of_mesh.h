// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_INTERNAL_SOUP_OF_MESH_H
#define ATLAS_SOUP_INTERNAL_SOUP_OF_MESH_H

#include <Atlas/core/Kernel.h>
#include <Atlas/core/internal/Mesh_arrays.h>
#include <Atlas/soup/Polygon_soup.h>

#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>

#include <array>
#include <cstddef>
#include <iterator>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// A colour of CGAL, or three or four numbers in [0, 1].
template <typename Color>
std::array<float, 4> soup_color(const Color& color)
{
  if constexpr (requires { color.red(); })
    return {static_cast<float>(color.red()) / 255, static_cast<float>(color.green()) / 255,
            static_cast<float>(color.blue()) / 255, static_cast<float>(color.alpha()) / 255};
  else
    return {static_cast<float>(color[0]), static_cast<float>(color[1]), static_cast<float>(color[2]),
            std::size(color) > 3 ? static_cast<float>(*(std::begin(color) + 3)) : 1.f};
}

template <typename Mesh>
void read_vertex_colors(const Mesh&, const Mesh_arrays<Mesh>&, Polygon_soup&, Param_not_found)
{}

/// Vertices without a face stay white.
template <typename Mesh, typename ColorMap>
void read_vertex_colors(const Mesh& mesh, const Mesh_arrays<Mesh>& arrays, Polygon_soup& soup, ColorMap map)
{
  soup.colors.assign(soup.points.size(), {1, 1, 1, 1});
  for (std::size_t c = 0; c < soup.vertices.size(); ++c)
    soup.colors[soup.vertices[c]] = soup_color(get(map, target(arrays.halfedges[c], mesh)));
}

template <typename Mesh>
void read_face_colors(const Mesh_arrays<Mesh>&, Polygon_soup&, Param_not_found)
{}

template <typename Mesh, typename ColorMap>
void read_face_colors(const Mesh_arrays<Mesh>& arrays, Polygon_soup& soup, ColorMap map)
{
  for (const auto f : arrays.faces)
    soup.face_colors.push_back(soup_color(get(map, f)));
}

template <typename Mesh>
void read_normals(const Mesh&, const Mesh_arrays<Mesh>&, Polygon_soup&, Param_not_found)
{}

/// Normals come from a map of vertices, whose numbers are theirs.
template <typename Mesh, typename NormalMap>
void read_normals(const Mesh& mesh, const Mesh_arrays<Mesh>& arrays, Polygon_soup& soup, NormalMap map)
{
  soup.normals.resize(soup.points.size());
  soup.corner_normal = soup.vertices;
  for (std::size_t c = 0; c < soup.vertices.size(); ++c) {
    const auto& n = get(map, target(arrays.halfedges[c], mesh));
    soup.normals[soup.vertices[c]] =
        Vector_3(CGAL::to_double(n.x()), CGAL::to_double(n.y()), CGAL::to_double(n.z()));
  }
}

template <typename Mesh>
void read_materials(const Mesh_arrays<Mesh>&, Polygon_soup&, Param_not_found)
{}

/// Materials come from a map of faces, to names or to numbers, in their order.
template <typename Mesh, typename FaceMap>
void read_materials(const Mesh_arrays<Mesh>& arrays, Polygon_soup& soup, FaceMap map)
{
  using Material = std::remove_cvref_t<decltype(get(map, arrays.faces.front()))>;
  std::map<Material, Index> number;
  for (const auto f : arrays.faces)
    number.try_emplace(get(map, f), 0);
  for (auto& [material, i] : number) {
    i = static_cast<Index>(soup.material_names.size());
    if constexpr (std::is_convertible_v<Material, std::string>)
      soup.material_names.push_back(material);
    else
      soup.material_names.push_back(std::to_string(material));
  }
  for (const auto f : arrays.faces)
    soup.face_material.push_back(number.at(get(map, f)));
}

/// The places of the vertices, and the corners of the faces.
template <typename Mesh, typename NamedParameters>
Mesh_arrays<Mesh> read_faces(const Mesh& mesh, const NamedParameters& np, Polygon_soup& soup)
{
  Mesh_arrays<Mesh> arrays = mesh_arrays(mesh, np);
  const auto index = CGAL::get_initialized_vertex_index_map(mesh, np);
  soup.points = arrays.surface.points;
  std::size_t c = 0;
  for (const auto f : arrays.faces) {
    for (std::size_t n = degree(f, mesh); n > 0; --n, ++c)
      soup.vertices.push_back(static_cast<Index>(get(index, target(arrays.halfedges[c], mesh))));
    soup.close_face();
  }
  return arrays;
}

} // namespace Atlas::internal

#endif
