// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_MESH_CONCEPTS_H
#define ATLAS_CORE_MESH_CONCEPTS_H

#include <Atlas/core/Surface.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <concepts>
#include <cstddef>
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

namespace internal {

/// What has `x()` and `y()`, as points of CGAL and vectors of Eigen.
template <typename UV>
concept HasXY = requires(const UV& p)
{
  CGAL::to_double(p.x());
  CGAL::to_double(p.y());
};

/// What has elements 0 and 1 only, as `std::array`.
template <typename UV>
concept HasElements = !HasXY<UV> && requires(UV p)
{
  CGAL::to_double(p[0]);
  p[1] = p[0];
};

/// One of the two coordinates.
template <typename UV>
double coordinate(const UV& p, int i)
{
  if constexpr (HasXY<UV>)
    return CGAL::to_double(i == 0 ? p.x() : p.y());
  else
    return CGAL::to_double(p[static_cast<std::size_t>(i)]);
}

/// Coordinates of a type.
template <typename UV>
UV make_uv(double u, double v)
{
  if constexpr (std::constructible_from<UV, double, double>) {
    return UV(u, v);
  } else {
    UV result{};
    using Number = std::remove_cvref_t<decltype(result[0])>;
    result[0] = static_cast<Number>(u);
    result[1] = static_cast<Number>(v);
    return result;
  }
}

} // namespace internal

/// \ingroup mesh_concepts
/// \brief A map from halfedges into which texture coordinates can be written: points and vectors
/// constructible from two doubles, as those of CGAL and Eigen, or arrays of two numbers.
template <typename Map, typename Mesh>
concept WritableHalfedgeUVMap =
    (std::constructible_from<typename boost::property_traits<Map>::value_type, double, double> ||
     internal::HasElements<typename boost::property_traits<
         Map>::value_type>)&&WritableMap<Map, typename boost::graph_traits<Mesh>::halfedge_descriptor,
                                         typename boost::property_traits<Map>::value_type>;

/// \ingroup mesh_concepts
/// \brief As `WritableHalfedgeUVMap`, or the same from vertices: for atlases whose seams split none.
template <typename Map, typename Mesh>
concept WritableUVMap = WritableHalfedgeUVMap<Map, Mesh> ||
    ((std::constructible_from<typename boost::property_traits<Map>::value_type, double, double> ||
      internal::HasElements<typename boost::property_traits<
          Map>::value_type>)&&WritableMap<Map, typename boost::graph_traits<Mesh>::vertex_descriptor,
                                          typename boost::property_traits<Map>::value_type>);

/// \ingroup mesh_concepts
/// \brief A map from halfedges to texture coordinates, or from vertices where no seam splits them: points
/// and vectors with `x()` and `y()`, or arrays of two numbers.
template <typename Map, typename Mesh>
concept ReadableHalfedgeUVMap =
    (ReadableMap<Map, typename boost::graph_traits<Mesh>::halfedge_descriptor> ||
     ReadableMap<
         Map,
         typename boost::graph_traits<Mesh>::
             vertex_descriptor>)&&(internal::HasXY<typename boost::property_traits<Map>::value_type> ||
                                   internal::HasElements<typename boost::property_traits<Map>::value_type>);

} // namespace Atlas

#endif
