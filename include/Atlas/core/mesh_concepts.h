// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_MESH_CONCEPTS_H
#define ATLAS_CORE_MESH_CONCEPTS_H

#include <Atlas/core/Surface.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <concepts>
#include <type_traits>

namespace Atlas {

/// \defgroup mesh_concepts Meshes and maps
/// \brief What the front doors ask of a mesh and its maps.

/// \ingroup mesh_concepts
/// \brief CGAL's `FaceListGraph`, as far as Atlas uses it: faces, their halfedges, vertices.
/// `CGAL::Surface_mesh` and `CGAL::Polyhedron_3` are models, and so is any graph with these functions.
template <typename Mesh>
concept FaceListMesh = std::is_class_v<Mesh> && !std::is_same_v<Mesh, Surface> &&
                       requires(const Mesh& mesh, typename boost::graph_traits<Mesh>::vertex_descriptor v,
                                typename boost::graph_traits<Mesh>::halfedge_descriptor h,
                                typename boost::graph_traits<Mesh>::edge_descriptor e,
                                typename boost::graph_traits<Mesh>::face_descriptor f)
{
  vertices(mesh);
  edges(mesh);
  faces(mesh);
  num_vertices(mesh);
  halfedge(f, mesh);
  halfedge(e, mesh);
  edge(h, mesh);
  next(h, mesh);
  opposite(h, mesh);
  target(h, mesh);
  face(h, mesh);
};

/// \ingroup mesh_concepts
/// \brief A property map that can be read at keys of a kind.
template <typename Map, typename Key>
concept ReadableMap = requires(const Map& map, const Key& key)
{
  typename boost::property_traits<Map>::value_type;
  get(map, key);
};

/// \ingroup mesh_concepts
/// \brief A property map into which values of a type can be written at keys of a kind.
template <typename Map, typename Key, typename Value>
concept WritableMap = requires(const Map& map, const Key& key, const Value& value)
{
  put(map, key, value);
};

/// \ingroup mesh_concepts
/// \brief A map from halfedges into which texture coordinates can be written: to points constructible from
/// two doubles.
template <typename Map, typename Mesh>
concept WritableHalfedgeUVMap = std::constructible_from < typename boost::property_traits<Map>::value_type,
double, double > &&WritableMap<Map, typename boost::graph_traits<Mesh>::halfedge_descriptor,
                               typename boost::property_traits<Map>::value_type>;

/// \ingroup mesh_concepts
/// \brief A map from halfedges to texture coordinates: points with `x()` and `y()`.
template <typename Map, typename Mesh>
concept ReadableHalfedgeUVMap = ReadableMap<Map, typename boost::graph_traits<Mesh>::halfedge_descriptor> &&
    requires(const typename boost::property_traits<Map>::value_type& p)
{
  CGAL::to_double(p.x());
  CGAL::to_double(p.y());
};

} // namespace Atlas

#endif
