// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACK_CHARTS_H
#define ATLAS_PACK_CHARTS_H

#include <Atlas/core/concepts.h>
#include <Atlas/core/internal/Mesh_arrays.h>
#include <Atlas/core/internal/page_options.h>
#include <Atlas/core/parameters.h>
#include <Atlas/packing/Raster_packer.h>
#include <Atlas/packing/pack_charts.h>

#include <boost/property_map/property_map.hpp>

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace Atlas {

/// \brief Packs the texture coordinates of a mesh anew, whatever made them; the shapes of charts stay as they
/// are.
///
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`
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
template <typename FaceListGraph, typename HalfedgeUVMap, typename T = bool,
          typename Tag = CGAL::internal_np::all_default_t, typename Base = CGAL::internal_np::No_property>
Packing pack_charts(const FaceListGraph& mesh, HalfedgeUVMap uv,
                    const CGAL::Named_function_parameters<T, Tag, Base>& np = parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  using Point = typename boost::property_traits<HalfedgeUVMap>::value_type;
  const internal::Mesh_arrays<FaceListGraph> view = internal::mesh_arrays(mesh, np);
  const std::vector<Point_2> corner_uv = internal::read_corner_uv(view, uv);
  const auto packer = choose_parameter(get_parameter(np, internal::packer_t()), Raster_packer());
  static_assert(ChartPacker<std::remove_cvref_t<decltype(packer)>>, "the packer must model ChartPacker");
  const Execution execution(
      static_cast<unsigned>(choose_parameter(get_parameter(np, internal::number_of_threads_t()), 0u)));
  const Surface& surface = view.surface;
  Repacked_charts repacked = pack_charts(surface, corner_uv, internal::page_options(np), packer, execution);

  std::vector<Index> chart(view.faces.size(), no_index), page(view.faces.size(), 0);
  for (Index t = 0; t < surface.number_of_triangles(); ++t) {
    chart[surface.face[t]] = repacked.segmentation.chart[t];
    page[surface.face[t]] = repacked.page[surface.corner[3 * t]];
  }
  internal::write_face_numbers(view, chart, get_parameter(np, internal::face_chart_map_t()));
  internal::write_face_numbers(view, page, get_parameter(np, internal::face_page_map_t()));
  if (repacked.packing.number_of_pages > 0)
    for (std::size_t c = 0; c < corner_uv.size(); ++c)
      if (repacked.uv[c] != corner_uv[c] && std::isfinite(repacked.uv[c].x()))
        put(uv, view.halfedges[c], Point(repacked.uv[c].x(), repacked.uv[c].y()));
  return std::move(repacked.packing);
}

} // namespace Atlas

#endif
