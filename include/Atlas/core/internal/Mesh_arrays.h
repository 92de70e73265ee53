// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_MESH_ARRAYS_H
#define ATLAS_CORE_INTERNAL_MESH_ARRAYS_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/core/errors.h>
#include <Atlas/core/internal/named_parameters.h>
#include <Atlas/core/mesh_concepts.h>
#include <Atlas/core/parameters.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/number_utils.h>
#include <CGAL/property_map.h>

#include <boost/graph/graph_traits.hpp>

#include <cmath>
#include <cstddef>
#include <map>
#include <type_traits>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// The surface of a mesh, and the way back to the mesh.
template <typename FaceListGraph>
struct Mesh_arrays
{
  using Halfedge = typename boost::graph_traits<FaceListGraph>::halfedge_descriptor;
  using Face = typename boost::graph_traits<FaceListGraph>::face_descriptor;

  Surface surface;
  std::vector<Halfedge> halfedges; ///< per input corner: the halfedge whose target it is
  std::vector<Face> faces;         ///< per input face

  /// The halfedge of the mesh that a halfedge of the surface lies on; only for those on the border of a
  /// polygon.
  Halfedge halfedge_of(Index h) const { return halfedges[surface.corner[next_halfedge(h)]]; }
};

/// Flattens a mesh into arrays. Corners are numbered face by face, in the order of the halfedges around each
/// face.
template <typename FaceListGraph, typename VertexPointMap, typename VertexIndexMap>
Mesh_arrays<FaceListGraph> flatten_mesh(const FaceListGraph& mesh, VertexPointMap vertex_point,
                                        VertexIndexMap vertex_index)
{
  Mesh_arrays<FaceListGraph> view;
  std::vector<Point_3> points(num_vertices(mesh));
  for (const auto v : vertices(mesh)) {
    const auto& p = get(vertex_point, v);
    const auto i = static_cast<std::size_t>(get(vertex_index, v));
    require(i < points.size(), "vertex_index_map", "must number the vertices from 0 on");
    points[i] = Point_3(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
  }
  std::vector<std::size_t> first{0};
  std::vector<Index> corners;
  for (const auto f : faces(mesh)) {
    for (const auto h : CGAL::halfedges_around_face(halfedge(f, mesh), mesh)) {
      corners.push_back(static_cast<Index>(get(vertex_index, target(h, mesh))));
      view.halfedges.push_back(h);
    }
    view.faces.push_back(f);
    first.push_back(corners.size());
  }
  view.surface = build_surface(std::move(points), first, corners);
  return view;
}

template <typename FaceListGraph>
void read_constraints(const FaceListGraph&, Mesh_arrays<FaceListGraph>&, Param_not_found, Edge_constraint)
{}

/// Gives the edges of the mesh for which `is_marked` holds a constraint.
template <typename FaceListGraph, typename EdgeMap>
void read_constraints(const FaceListGraph& mesh, Mesh_arrays<FaceListGraph>& view, EdgeMap is_marked,
                      Edge_constraint constraint)
{
  static_assert(ReadableMap<EdgeMap, typename boost::graph_traits<FaceListGraph>::edge_descriptor>,
                "edge_is_constrained_map and forbidden_seam_map must be readable maps from edges");
  Surface& surface = view.surface;
  surface.constraint.resize(surface.opposite.size(), Edge_constraint::none);
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (surface.opposite[h] != no_index && !surface.is_diagonal(h) &&
        get(is_marked, edge(view.halfedge_of(h), mesh)))
      surface.constraint[h] = surface.constraint[surface.opposite[h]] = constraint;
}

template <typename FaceListGraph>
void read_seam_costs(const FaceListGraph&, Mesh_arrays<FaceListGraph>&, Param_not_found)
{}

/// Costs come from a map of edges or of vertices.
template <typename FaceListGraph, typename CostMap>
void read_seam_costs(const FaceListGraph& mesh, Mesh_arrays<FaceListGraph>& view, CostMap cost)
{
  using Edge = typename boost::graph_traits<FaceListGraph>::edge_descriptor;
  using Vertex = typename boost::graph_traits<FaceListGraph>::vertex_descriptor;
  static_assert(ReadableMap<CostMap, Edge> || ReadableMap<CostMap, Vertex>,
                "seam_cost_map must be a readable map from edges or from vertices");
  const auto cost_of = [&](const auto h) -> double {
    if constexpr (std::is_convertible_v<Edge, typename boost::property_traits<CostMap>::key_type>)
      return CGAL::to_double(get(cost, edge(h, mesh)));
    else
      return (CGAL::to_double(get(cost, source(h, mesh))) + CGAL::to_double(get(cost, target(h, mesh)))) / 2;
  };
  Surface& surface = view.surface;
  surface.seam_cost.assign(surface.opposite.size(), 1);
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (const Index o = surface.opposite[h]; o != no_index && h < o && !surface.is_diagonal(h)) {
      surface.seam_cost[h] = surface.seam_cost[o] = cost_of(view.halfedge_of(h));
      require(surface.seam_cost[h] > 0 && std::isfinite(surface.seam_cost[h]), "seam_cost_map",
              "must be finite and positive everywhere");
    }
}

template <typename FaceListGraph>
void read_patches(Mesh_arrays<FaceListGraph>&, Param_not_found)
{}

/// Patch identifiers of any ordered type become numbers.
template <typename FaceListGraph, typename FaceMap>
void read_patches(Mesh_arrays<FaceListGraph>& view, FaceMap face_patch)
{
  static_assert(ReadableMap<FaceMap, typename Mesh_arrays<FaceListGraph>::Face>,
                "face_patch_map must be a readable map from faces");
  using Patch = std::remove_cvref_t<decltype(get(face_patch, view.faces.front()))>;
  std::map<Patch, Index> number;
  for (const auto f : view.faces)
    number.try_emplace(get(face_patch, f), 0);
  Index next = 0;
  for (auto& entry : number)
    entry.second = next++;
  view.surface.patch.resize(view.surface.number_of_triangles());
  for (std::size_t t = 0; t < view.surface.patch.size(); ++t)
    view.surface.patch[t] = number.at(get(face_patch, view.faces[view.surface.face[t]]));
}

/// Per face whether it is selected.
template <typename FaceListGraph, typename FaceMap>
std::vector<bool> read_selection(const Mesh_arrays<FaceListGraph>& view, FaceMap is_selected)
{
  static_assert(ReadableMap<FaceMap, typename Mesh_arrays<FaceListGraph>::Face>,
                "face_selection_map must be a readable map from faces");
  std::vector<bool> result;
  for (const auto f : view.faces)
    result.push_back(get(is_selected, f));
  return result;
}

/// Whether the keys of a map are halfedges, and not vertices.
template <typename Map, typename FaceListGraph>
inline constexpr bool has_halfedge_keys =
    std::is_convertible_v<typename boost::graph_traits<FaceListGraph>::halfedge_descriptor,
                          typename boost::property_traits<Map>::key_type>;

/// The key of a corner in a map of halfedges or of vertices.
template <typename Map, typename FaceListGraph>
auto key_of_corner(typename boost::graph_traits<FaceListGraph>::halfedge_descriptor h,
                   const FaceListGraph& mesh)
{
  if constexpr (has_halfedge_keys<Map, FaceListGraph>)
    return h;
  else
    return target(h, mesh);
}

/// Per corner of the input whether it is pinned, from a map of halfedges or of vertices.
template <typename FaceListGraph, typename PinMap>
std::vector<bool> read_pins(const FaceListGraph& mesh, const Mesh_arrays<FaceListGraph>& view,
                            PinMap is_pinned)
{
  using Halfedge = typename Mesh_arrays<FaceListGraph>::Halfedge;
  using Vertex = typename boost::graph_traits<FaceListGraph>::vertex_descriptor;
  static_assert(ReadableMap<PinMap, Halfedge> || ReadableMap<PinMap, Vertex>,
                "pinned_map must be a readable map from halfedges or from vertices");
  std::vector<bool> result;
  result.reserve(view.halfedges.size());
  for (const auto h : view.halfedges)
    result.push_back(get(is_pinned, key_of_corner<PinMap>(h, mesh)));
  return result;
}

template <typename FaceListGraph>
void read_density_weights(Mesh_arrays<FaceListGraph>&, Param_not_found)
{}

template <typename FaceListGraph, typename WeightMap>
void read_density_weights(Mesh_arrays<FaceListGraph>& view, WeightMap weight)
{
  static_assert(ReadableMap<WeightMap, typename Mesh_arrays<FaceListGraph>::Face>,
                "face_weight_map must be a readable map from faces");
  Surface& surface = view.surface;
  surface.density_weight.resize(surface.number_of_triangles());
  for (std::size_t t = 0; t < surface.density_weight.size(); ++t) {
    surface.density_weight[t] = CGAL::to_double(get(weight, view.faces[surface.face[t]]));
    require(surface.density_weight[t] > 0 && std::isfinite(surface.density_weight[t]), "face_weight_map",
            "must be finite and positive everywhere");
  }
}

/// Flattens a mesh into arrays as the pack of named parameters asks.
template <typename FaceListGraph, typename NamedParameters>
Mesh_arrays<FaceListGraph> mesh_arrays(const FaceListGraph& mesh, const NamedParameters& np)
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  Mesh_arrays<FaceListGraph> view =
      flatten_mesh(mesh,
                   choose_parameter(get_parameter(np, CGAL::internal_np::vertex_point),
                                    CGAL::get_const_property_map(CGAL::vertex_point, mesh)),
                   CGAL::get_initialized_vertex_index_map(mesh, np));
  read_constraints(mesh, view, get_parameter(np, forbidden_seam_map_t()), Edge_constraint::no_seam);
  read_constraints(mesh, view, get_parameter(np, CGAL::internal_np::edge_is_constrained),
                   Edge_constraint::seam);
  read_seam_costs(mesh, view, get_parameter(np, seam_cost_map_t()));
  read_patches(view, get_parameter(np, CGAL::internal_np::face_patch));
  read_density_weights(view, get_parameter(np, face_weight_map_t()));
  return view;
}

/// The coordinates of every corner of the input, from a map of halfedges or of vertices.
template <typename FaceListGraph, typename UVMap>
std::vector<Point_2> read_corner_uv(const FaceListGraph& mesh, const Mesh_arrays<FaceListGraph>& view,
                                    UVMap uv)
{
  std::vector<Point_2> corner_uv;
  corner_uv.reserve(view.halfedges.size());
  const auto add = [&](const auto& p) { corner_uv.emplace_back(coordinate(p, 0), coordinate(p, 1)); };
  for (const auto h : view.halfedges)
    add(get(uv, key_of_corner<UVMap>(h, mesh)));
  return corner_uv;
}

/// Whether corners of a vertex have different coordinates, on two sides of a seam.
inline bool are_vertices_split(const Surface& surface, const std::vector<Point_2>& corner_uv)
{
  std::vector<Index> first(surface.points.size(), no_index); // corner of the vertex
  for (std::size_t h = 0; h < surface.corner.size(); ++h) {
    Index& corner = first[surface.triangles[h / 3][h % 3]];
    if (corner == no_index)
      corner = surface.corner[h];
    else if (corner_uv[corner] != corner_uv[surface.corner[h]])
      return true;
  }
  return false;
}

/// Puts coordinates of corners, but those that are as before, into a map of halfedges or of vertices. In one
/// of vertices corners without a triangle have no say.
/// \param before  may be empty
/// \return false where the corners of a vertex differ: then nothing is written
template <typename FaceListGraph, typename UVMap>
bool write_corner_uv(const FaceListGraph& mesh, const Mesh_arrays<FaceListGraph>& view,
                     const std::vector<Point_2>& corner_uv, const std::vector<Point_2>& before, UVMap uv)
{
  using UV = typename boost::property_traits<UVMap>::value_type;
  const auto write = [&](std::size_t c) {
    if (before.empty() || before[c] != corner_uv[c])
      put(uv, key_of_corner<UVMap>(view.halfedges[c], mesh), make_uv<UV>(corner_uv[c].x(), corner_uv[c].y()));
  };
  if constexpr (has_halfedge_keys<UVMap, FaceListGraph>) {
    for (std::size_t c = 0; c < corner_uv.size(); ++c)
      write(c);
  } else {
    if (are_vertices_split(view.surface, corner_uv))
      return false;
    for (const Index c : view.surface.corner)
      write(c);
  }
  return true;
}

template <typename FaceListGraph>
void write_edge_seams(const FaceListGraph&, const Mesh_arrays<FaceListGraph>&, const Segmentation&,
                      Param_not_found)
{}

/// Says of every edge whether it is a seam. Border edges are none, as there is nothing on their other side.
template <typename FaceListGraph, typename EdgeMap>
void write_edge_seams(const FaceListGraph& mesh, const Mesh_arrays<FaceListGraph>& view,
                      const Segmentation& segmentation, EdgeMap is_seam)
{
  static_assert(WritableMap<EdgeMap, typename boost::graph_traits<FaceListGraph>::edge_descriptor, bool>,
                "edge_seam_map must be a writable map from edges");
  for (const auto e : edges(mesh))
    put(is_seam, e, false);
  const Surface& surface = view.surface;
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (surface.opposite[h] != no_index && !segmentation.is_glued(surface, h))
      put(is_seam, edge(view.halfedge_of(h), mesh), true);
}

template <typename FaceListGraph>
std::vector<Index> read_face_numbers(const Mesh_arrays<FaceListGraph>&, Param_not_found)
{
  return {};
}

/// The number of every face of the input; empty when there is no map.
template <typename FaceListGraph, typename FaceMap>
std::vector<Index> read_face_numbers(const Mesh_arrays<FaceListGraph>& view, FaceMap map)
{
  std::vector<Index> numbers;
  numbers.reserve(view.faces.size());
  for (const auto f : view.faces)
    numbers.push_back(static_cast<Index>(get(map, f)));
  return numbers;
}

template <typename FaceListGraph>
void write_face_numbers(const Mesh_arrays<FaceListGraph>&, const std::vector<Index>&, Param_not_found)
{}

/// Writes a number to every face; `no_index` becomes -1.
template <typename FaceListGraph, typename FaceMap>
void write_face_numbers(const Mesh_arrays<FaceListGraph>& view, const std::vector<Index>& numbers,
                        FaceMap map)
{
  using Value = typename boost::property_traits<FaceMap>::value_type;
  static_assert(WritableMap<FaceMap, typename Mesh_arrays<FaceListGraph>::Face, Value>,
                "face_chart_map and face_page_map must be writable maps from faces");
  for (std::size_t f = 0; f < numbers.size(); ++f)
    put(map, view.faces[f], numbers[f] == no_index ? static_cast<Value>(-1) : static_cast<Value>(numbers[f]));
}

} // namespace Atlas::internal

#endif
