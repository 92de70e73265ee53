// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_JOINED_SOUPS_H
#define ATLAS_SOUP_JOINED_SOUPS_H

#include <Atlas/core/Kernel.h>
#include <Atlas/core/errors.h>
#include <Atlas/core/mesh_concepts.h>
#include <Atlas/core/parameters.h>
#include <Atlas/soup/Polygon_soup.h>
#include <Atlas/soup/internal/soup_of_mesh.h>

#include <cstddef>
#include <string>
#include <vector>

namespace Atlas {

/// \brief Several models as one, and the way back.
///
/// Vertices, faces and corners are counted on from one model to the next, as `join_surfaces()` counts them.
/// Materials of the same name are one. Where only some models have an attribute, the others get its usual
/// value: white, no coordinates, no material.
class Joined_soups
{
public:
  /// Joins them, in this order.
  explicit Joined_soups(std::vector<Polygon_soup> soups);

  /// All models as one. It may be changed as long as its lists keep their lengths, but for those of
  /// attributes, which may be filled or emptied, and as long as each vertex stays in its model.
  Polygon_soup& whole() { return whole_; }
  /// All of them as one.
  const Polygon_soup& whole() const { return whole_; }

  /// How many were joined.
  std::size_t number_of_parts() const { return parts_.size() - 1; }
  /// Where the vertices of a part begin.
  std::size_t first_vertex(std::size_t part) const { return parts_[part].vertex; }
  /// Where the faces of a part begin.
  std::size_t first_face(std::size_t part) const { return parts_[part].face; }

  /// One of the models, as it is now.
  Polygon_soup part(std::size_t i) const;

private:
  /// Which attributes there are.
  struct Attributes
  {
    bool colors = false, face_colors = false, uv = false, normals = false, materials = false, groups = false,
         pages = false;
  };

  /// Where a model starts in each of the lists.
  struct Part
  {
    std::size_t vertex, corner, face, normal, group;
    Attributes has;
  };

  void start_part(const Attributes& has);
  void append(Polygon_soup&& soup);

  /// Vertices that do not exist in their model must not become vertices of the next: they get numbers beyond
  /// all.
  Index common_vertex(Index v, std::size_t first, std::size_t size) const;
  Index own_vertex(Index v, std::size_t first, std::size_t end) const;

  /// The numbers that the materials of a model have in common.
  std::vector<Index> common_materials(const std::vector<std::string>& names);

  Polygon_soup whole_;
  Attributes has_;
  std::size_t number_of_points_ = 0;
  std::vector<Part> parts_; ///< one more closes
};

/// \brief A mesh as a soup, so that every writer and every bake takes it.
///
/// \param mesh  triangles, quads or any polygons
/// \param uv    for every halfedge h that is not on the border, the image of `target(h)` in `face(h)`; or a
/// map
///              of vertices
/// \param np    CGAL's `vertex_normal_map`, `vertex_color_map` and `face_color_map` (to colours of CGAL or
///              to three or four numbers in [0, 1]), `face_patch_map` (to names or numbers of materials),
///              `vertex_point_map`, `vertex_index_map`; `face_page_map`
///
/// Vertices are in the order of their indices, faces in that of the mesh, corners in that of the halfedges
/// around a face. Linear. \throw Invalid_argument a vertex index is not in [0, vertices)
template <FaceListMesh Mesh, ReadableHalfedgeUVMap<Mesh> HalfedgeUVMap, typename T = bool,
          typename Tag = CGAL::internal_np::all_default_t, typename Base = CGAL::internal_np::No_property>
Polygon_soup soup_of(const Mesh& mesh, HalfedgeUVMap uv,
                     const CGAL::Named_function_parameters<T, Tag, Base>& np = parameters::default_values())
{
  using namespace internal;
  namespace names = CGAL::internal_np;
  Only_names<names::vertex_normal_map_t, names::vertex_color_map_t, names::face_color_map_t,
             names::face_patch_t, names::vertex_point_t, names::vertex_index_t, face_page_map_t>::check(&np);
  Polygon_soup soup;
  const Mesh_arrays<Mesh> arrays = read_faces(mesh, np, soup);
  soup.uv = read_corner_uv(mesh, arrays, uv);
  soup.face_page = read_face_numbers(arrays, parameter<face_page_map_t>(np));
  read_normals(mesh, arrays, soup, parameter<names::vertex_normal_map_t>(np));
  read_vertex_colors(mesh, arrays, soup, parameter<names::vertex_color_map_t>(np));
  read_face_colors(arrays, soup, parameter<names::face_color_map_t>(np));
  read_materials(arrays, soup, parameter<names::face_patch_t>(np));
  return soup;
}

/// \brief Puts the coordinates of a soup into a map of the mesh that `soup_of()` has made it of, or of one
/// with as many corners in the same order. Linear. \throw Invalid_argument the soup has not a coordinate for
/// each corner of the mesh
template <FaceListMesh Mesh, WritableHalfedgeUVMap<Mesh> HalfedgeUVMap>
void put_uv(const Polygon_soup& soup, const Mesh& mesh, HalfedgeUVMap uv)
{
  std::size_t corner = 0;
  for (const auto f : faces(mesh))
    for (const auto h : CGAL::halfedges_around_face(halfedge(f, mesh), mesh)) {
      internal::require(corner < soup.uv.size(), "soup",
                        "must have a coordinate for each corner of the mesh");
      const Point_2& p = soup.uv[corner++];
      put(uv, h, internal::make_uv<typename boost::property_traits<HalfedgeUVMap>::value_type>(p.x(), p.y()));
    }
  internal::require(corner == soup.uv.size(), "soup",
                    "must have no more coordinates than the mesh has corners");
}

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/soup/internal/Joined_soups_impl.h>
#endif

#endif
