// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACK_CHARTS_H
#define ATLAS_PACK_CHARTS_H

#include <Atlas/core/Any_policies.h>
#include <Atlas/core/internal/Mesh_arrays.h>
#include <Atlas/core/internal/named_parameters.h>
#include <Atlas/core/mesh_concepts.h>
#include <Atlas/core/parameters.h>
#include <Atlas/packing/Raster_packer.h>
#include <Atlas/packing/pack_charts.h>

#include <boost/property_map/property_map.hpp>

#include <cmath>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace Atlas {

/// \brief Packs the texture coordinates of a mesh anew, whatever made them; the shapes of charts stay as they
/// are.
///
/// \tparam Mesh          a model of CGAL's `FaceListGraph`
/// \tparam HalfedgeUVMap a readable and writable property map from halfedges to a point type constructible
/// from two doubles
///
/// \param mesh  stays as it is
/// \param uv    for every halfedge h that is not on the border, the image of `target(h)` in `face(h)`. In:
///              faces are glued to charts where coordinates are equal on both sides of an edge; faces with
///              coordinates that are not finite are left as they are. Out: in [0, 1]^2 of the face's page,
///              origin bottom left.
/// \param np    `texture_size`, `gutter`, `page_options` (lists in it count charts by their first faces),
///              `packer` (default `Raster_packer`), `face_weight_map`, `number_of_threads`; outputs:
///              `face_chart_map`, `face_page_map`; CGAL's `vertex_point_map`, `vertex_index_map`
///
/// Gives the packing: a placement for every chart. Charts that are folded or overlap themselves are packed
/// as they are. Where there is no room at all, `number_of_pages` is 0 and coordinates are left alone.
template <FaceListMesh Mesh, ReadableHalfedgeUVMap<Mesh> HalfedgeUVMap, typename T = bool,
          typename Tag = CGAL::internal_np::all_default_t, typename Base = CGAL::internal_np::No_property>
requires WritableHalfedgeUVMap<HalfedgeUVMap, Mesh> Packing
pack_charts(const Mesh& mesh, HalfedgeUVMap uv,
            const CGAL::Named_function_parameters<T, Tag, Base>& np = parameters::default_values())
{
  using namespace internal;
  using Point = typename boost::property_traits<HalfedgeUVMap>::value_type;
  Only_names<texture_size_t, gutter_t, page_options_t, packer_t, face_weight_map_t, number_of_threads_t,
             face_chart_map_t, face_page_map_t, CGAL::internal_np::vertex_point_t,
             CGAL::internal_np::vertex_index_t>::check(&np);
  const Page_options page = page_options(np);
  std::optional<Any_packer> packer;
  if constexpr (has_parameter<packer_t, CGAL::Named_function_parameters<T, Tag, Base>>) {
    static_assert(ChartPacker<std::remove_cvref_t<decltype(parameter<packer_t>(np))>>,
                  "the packer must model ChartPacker");
    packer.emplace(parameter<packer_t>(np));
  } else {
    packer.emplace(Raster_packer());
  }
  const Mesh_arrays<Mesh> arrays = mesh_arrays(mesh, np);
  const std::vector<Point_2> corner_uv = read_corner_uv(mesh, arrays, uv);
  const Surface& surface = arrays.surface;
  Repacked_charts repacked = pack_charts(surface, corner_uv, page, *packer, Execution(number_of_threads(np)));

  std::vector<Index> chart(arrays.faces.size(), no_index), page_of_face(arrays.faces.size(), 0);
  for (Index t = 0; t < surface.number_of_triangles(); ++t) {
    chart[surface.face[t]] = repacked.segmentation.chart[t];
    page_of_face[surface.face[t]] = repacked.page[surface.corner[3 * t]];
  }
  write_face_numbers(arrays, chart, parameter<face_chart_map_t>(np));
  write_face_numbers(arrays, page_of_face, parameter<face_page_map_t>(np));
  if (repacked.packing.number_of_pages > 0)
    for (std::size_t c = 0; c < corner_uv.size(); ++c)
      if (repacked.uv[c] != corner_uv[c] && std::isfinite(repacked.uv[c].x()))
        put(uv, arrays.halfedges[c], make_uv<Point>(repacked.uv[c].x(), repacked.uv[c].y()));
  return std::move(repacked.packing);
}

} // namespace Atlas

#endif
