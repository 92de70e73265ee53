// SPDX-License-Identifier: MIT
#ifndef ATLAS_GENERATE_ATLAS_H
#define ATLAS_GENERATE_ATLAS_H

#include <Atlas/core/concepts.h>
#include <Atlas/core/constrain_hard_edges.h>
#include <Atlas/core/internal/Mesh_arrays.h>
#include <Atlas/core/internal/page_options.h>
#include <Atlas/core/parameters.h>
#include <Atlas/pipeline/Atlas_report.h>
#include <Atlas/pipeline/internal/Atlas_pipeline.h>
#include <Atlas/pipeline/presets.h>

#include <CGAL/assertions.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <cstddef>
#include <type_traits>
#include <vector>

namespace Atlas {

namespace internal {

/// The share of a page that charts cover as a rule.
inline constexpr double usual_packing_efficiency = 0.6;

/// When charts merge, as a pack of named parameters asks.
template <typename NamedParameters>
Merge_options chosen_merge_options(const NamedParameters& np, Atlas_mode mode, const Page_options& page)
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  Merge_options options = choose_parameter(get_parameter(np, merge_options_t()), merge_options(mode));
  const auto max_charts = choose_parameter(get_parameter(np, max_charts_t()), options.max_charts);
  CGAL_precondition_msg(!(max_charts < 0), "the number of charts must not be negative");
  options.max_charts = static_cast<std::size_t>(max_charts);
  const double texels = choose_parameter(get_parameter(np, min_chart_texels_t()), 0.0);
  CGAL_precondition_msg(texels >= 0, "the size of charts must not be negative");
  if (texels > 0)
    options.min_chart_area = texels / (usual_packing_efficiency * double(page.width) * page.height);
  return options;
}

/// Runs the pipeline with the policies of a pack. `use(pipeline)` gets it after a run that filled the
/// coordinates.
template <typename NamedParameters, typename Use>
Atlas_report run_pipeline(const Surface& surface, std::vector<Point_2>& corner_uv, const NamedParameters& np,
                          Use use)
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  const Page_options page = page_options(np);
  const Atlas_mode mode = choose_parameter(get_parameter(np, mode_t()), Atlas_mode::standard);
  const Merge_options merge = chosen_merge_options(np, mode, page);
  const auto segmentation =
      choose_parameter(get_parameter(np, segmentation_t()), Default_segmentation(merge, finish(mode)));
  const auto parameterizer =
      choose_parameter(get_parameter(np, parameterizer_t()), Default_parameterizer(mode));
  const auto optimizer = choose_parameter(get_parameter(np, optimizer_t()), Default_optimizer());
  const auto validator = choose_parameter(get_parameter(np, validator_t()), Default_validator(merge));
  const auto packer = choose_parameter(get_parameter(np, packer_t()), Default_packer());
  const auto threads = choose_parameter(get_parameter(np, number_of_threads_t()), 0u);
  const Progress progress = choose_parameter(get_parameter(np, progress_t()), Progress());
  static_assert(ChartSegmentation<std::remove_cvref_t<decltype(segmentation)>>,
                "the segmentation must model ChartSegmentation");
  static_assert(ChartParameterizer<std::remove_cvref_t<decltype(parameterizer)>>,
                "the parameterizer must model ChartParameterizer");
  static_assert(UVOptimizer<std::remove_cvref_t<decltype(optimizer)>>,
                "the optimizer must model UVOptimizer");
  static_assert(ChartValidator<std::remove_cvref_t<decltype(validator)>>,
                "the validator must model ChartValidator");
  static_assert(ChartPacker<std::remove_cvref_t<decltype(packer)>>, "the packer must model ChartPacker");

  Surface with_hard_edges;
  const double hard_angle = choose_parameter(get_parameter(np, hard_angle_t()), 0.0);
  CGAL_precondition_msg(hard_angle >= 0 && hard_angle <= 180, "the hard angle must be in (0, 180] degrees");
  if (hard_angle > 0)
    constrain_hard_edges(with_hard_edges = surface, hard_angle);
  Atlas_pipeline pipeline(hard_angle > 0 ? with_hard_edges : surface, segmentation, parameterizer, optimizer,
                          validator, packer, page, static_cast<unsigned>(threads), progress);
  Atlas_report report = pipeline.run(corner_uv);
  if (report.status == Atlas_status::valid || report.status == Atlas_status::not_valid)
    use(pipeline.segmentation());
  return report;
}

} // namespace internal

/// \brief Makes a texture atlas of a surface in flat arrays, such as `build_surface()` makes of any polygon
/// soup.
///
/// \param surface    what to map
/// \param corner_uv  output: per corner of the input, in the order in which the surface counts them, the
/// coordinates
///                   in [0, 1]^2 of its page, origin bottom left; all of them are floats in value. Left as it
///                   is when the run is cancelled or there is no surface.
/// \param np         any of the names of `parameters.h` but the maps
template <typename T = bool, typename Tag = CGAL::internal_np::all_default_t,
          typename Base = CGAL::internal_np::No_property>
Atlas_report
generate_atlas(const Surface& surface, std::vector<Point_2>& corner_uv,
               const CGAL::Named_function_parameters<T, Tag, Base>& np = parameters::default_values())
{
  return internal::run_pipeline(surface, corner_uv, np, [](const Segmentation&) {});
}

/// \brief Makes a texture atlas of a mesh: segments it into charts, flattens them, proves them, packs them.
///
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`; triangles, quads or any polygons, open or closed
/// \tparam HalfedgeUVMap a writable property map from halfedges to a point type constructible from two
/// doubles
///
/// \param mesh  stays as it is
/// \param uv    output: for every halfedge h that is not on the border, the image of `target(h)` in
/// `face(h)`, in
///              [0, 1]^2 of the face's page, origin bottom left
/// \param np    names of Atlas (see `parameters.h`), then of CGAL: `vertex_point_map`, `vertex_index_map`,
///              `edge_is_constrained_map` (edges that must be seams), `face_patch_map` (faces of different
///              patches never share a chart)
///
/// \return what happened; `is_valid()` tells whether the coordinates are proved to be free of flips and
/// overlaps
///
/// Errors: a wrong parameter violates a precondition. Faults of the data are in the report, nothing is
/// thrown. The steps are those of Levy, Petitjean, Ray, Maillot 2002.
template <typename FaceListGraph, typename HalfedgeUVMap, typename T = bool,
          typename Tag = CGAL::internal_np::all_default_t, typename Base = CGAL::internal_np::No_property>
Atlas_report
generate_atlas(const FaceListGraph& mesh, HalfedgeUVMap uv,
               const CGAL::Named_function_parameters<T, Tag, Base>& np = parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  using UV_point = typename boost::property_traits<HalfedgeUVMap>::value_type;

  const internal::Mesh_arrays<FaceListGraph> view = internal::mesh_arrays(mesh, np);
  std::vector<Point_2> corner_uv;
  Atlas_report report =
      internal::run_pipeline(view.surface, corner_uv, np, [&](const Segmentation& segmentation) {
        internal::write_edge_seams(mesh, view, segmentation, get_parameter(np, internal::edge_seam_map_t()));
      });
  for (std::size_t c = 0; c < corner_uv.size(); ++c)
    put(uv, view.halfedges[c], UV_point(corner_uv[c].x(), corner_uv[c].y()));
  internal::write_face_numbers(view, report.face_chart, get_parameter(np, internal::face_chart_map_t()));
  internal::write_face_numbers(view, report.face_page, get_parameter(np, internal::face_page_map_t()));
  return report;
}

} // namespace Atlas

#endif
