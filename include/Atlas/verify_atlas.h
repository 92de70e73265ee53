// SPDX-License-Identifier: MIT
#ifndef ATLAS_VERIFY_ATLAS_H
#define ATLAS_VERIFY_ATLAS_H

#include <Atlas/core/internal/Mesh_arrays.h>
#include <Atlas/core/internal/named_parameters.h>
#include <Atlas/core/mesh_concepts.h>
#include <Atlas/core/parameters.h>
#include <Atlas/validation/certify.h>

#include <vector>

namespace Atlas {

/// \brief Examines the texture coordinates of a mesh, whatever made them.
///
/// \tparam Mesh          a model of CGAL's `FaceListGraph`
/// \tparam HalfedgeUVMap a readable property map from halfedges to points of the plane
///
/// \param mesh  triangles, quads or any polygons
/// \param uv    for every halfedge h that is not on the border, the image of `target(h)` in `face(h)`; or a
/// map
///              of vertices
/// \param np    `texture_size` (default `default_texture_size`), `gutter` (default 0: any distance will do),
///              `face_page_map` (the page of each face; default: all on one), `number_of_threads`;
///              CGAL's `vertex_point_map`, `vertex_index_map`
///
/// Everything is decided on the coordinates rounded to 32 bits, which is how they are stored where they are
/// used. O(n log n). \throws Invalid_argument if an argument cannot be. Nothing is thrown for bad
/// coordinates: the certificate says what is wrong with them, and where.
template <FaceListMesh Mesh, ReadableHalfedgeUVMap<Mesh> HalfedgeUVMap, typename T = bool,
          typename Tag = CGAL::internal_np::all_default_t, typename Base = CGAL::internal_np::No_property>
Atlas_certificate
verify_atlas(const Mesh& mesh, HalfedgeUVMap uv,
             const CGAL::Named_function_parameters<T, Tag, Base>& np = parameters::default_values())
{
  using namespace internal;
  Only_names<texture_size_t, gutter_t, page_options_t, face_page_map_t, number_of_threads_t,
             CGAL::internal_np::vertex_point_t, CGAL::internal_np::vertex_index_t>::check(&np);
  const Page_options page = page_options(np, Page_options{.gutter = 0});
  const Mesh_arrays<Mesh> arrays = mesh_arrays(mesh, np);
  Certificate_options options;
  options.width = page.width;
  options.height = page.height;
  options.gutter = page.gutter;
  options.precision = Uv_precision::single_precision;
  const std::vector<Index> pages = read_face_numbers(arrays, parameter<face_page_map_t>(np));
  return certify(arrays.surface, read_corner_uv(mesh, arrays, uv), pages, options,
                 Execution(number_of_threads(np)));
}

} // namespace Atlas

#endif
