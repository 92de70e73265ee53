// SPDX-License-Identifier: MIT
#ifndef ATLAS_VERIFY_ATLAS_H
#define ATLAS_VERIFY_ATLAS_H

#include <Atlas/core/internal/Mesh_arrays.h>
#include <Atlas/core/internal/page_options.h>
#include <Atlas/core/parameters.h>
#include <Atlas/validation/certify.h>

#include <cstddef>
#include <vector>

namespace Atlas {

/// \brief Examines the texture coordinates of a mesh, whatever made them.
///
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`
/// \tparam HalfedgeUVMap a readable property map from halfedges to points of the plane
///
/// \param mesh  triangles, quads or any polygons
/// \param uv    for every halfedge h that is not on the border, the image of `target(h)` in `face(h)`
/// \param np    `texture_size` (default `default_texture_size`), `gutter` (default 0: any distance will do),
///              `face_page_map` (the page of each face; default: all on one), `number_of_threads`;
///              CGAL's `vertex_point_map`, `vertex_index_map`
///
/// Everything is decided on the coordinates rounded to 32 bits, which is how they are stored where they are
/// used. O(n log n). Nothing is thrown for bad coordinates: the certificate says what is wrong with them, and
/// where.
template <typename FaceListGraph, typename HalfedgeUVMap, typename T = bool,
          typename Tag = CGAL::internal_np::all_default_t, typename Base = CGAL::internal_np::No_property>
Atlas_certificate
verify_atlas(const FaceListGraph& mesh, HalfedgeUVMap uv,
             const CGAL::Named_function_parameters<T, Tag, Base>& np = parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  const internal::Mesh_arrays<FaceListGraph> view = internal::mesh_arrays(mesh, np);
  const std::vector<Point_2> corner_uv = internal::read_corner_uv(view, uv);
  const Page_options page = internal::page_options(np, Page_options{.gutter = 0});
  Certificate_options options;
  options.width = page.width;
  options.height = page.height;
  options.gutter = page.gutter;
  options.precision = Uv_precision::single_precision;
  const std::vector<Index> pages =
      internal::read_face_numbers(view, get_parameter(np, internal::face_page_map_t()));
  const Execution execution(
      static_cast<unsigned>(choose_parameter(get_parameter(np, internal::number_of_threads_t()), 0u)));
  return certify(view.surface, corner_uv, pages, options, execution);
}

} // namespace Atlas

#endif
