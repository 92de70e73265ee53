// SPDX-License-Identifier: MIT
#ifndef ATLAS_GENERATE_ATLAS_H
#define ATLAS_GENERATE_ATLAS_H

#include <Atlas/core/internal/Mesh_arrays.h>
#include <Atlas/core/internal/named_parameters.h>
#include <Atlas/core/mesh_concepts.h>
#include <Atlas/core/parameters.h>
#include <Atlas/pipeline/Atlas_report.h>
#include <Atlas/pipeline/internal/run_atlas.h>
#include <Atlas/pipeline/presets.h>

#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

namespace Atlas {

namespace internal {

/// The names that both overloads of `generate_atlas()` know.
template <typename... More>
using Atlas_names =
    Only_names<texture_size_t, gutter_t, page_options_t, mode_t, merge_options_t, max_charts_t,
               min_chart_texels_t, min_coverage_t, seam_exchange_rate_t, min_texels_per_chart_t, hard_angle_t,
               only_given_seams_t, face_selection_map_t, pinned_map_t, hide_seams_t, straighten_t, symmetry_t,
               policies_t, segmentation_t, parameterizer_t, optimizer_t, validator_t, splitter_t, packer_t,
               number_of_threads_t, progress_t, More...>;

/// The policies of a pack.
template <typename NamedParameters>
void read_policies(const NamedParameters& np, Atlas_request& request)
{
  read_parameter<policies_t>(np, request.policies);
  if constexpr (has_parameter<segmentation_t, NamedParameters>) {
    static_assert(ChartSegmentation<std::remove_cvref_t<decltype(parameter<segmentation_t>(np))>>,
                  "the segmentation must model ChartSegmentation");
    request.segmentation.emplace(parameter<segmentation_t>(np));
  }
  if constexpr (has_parameter<parameterizer_t, NamedParameters>) {
    static_assert(ChartParameterizer<std::remove_cvref_t<decltype(parameter<parameterizer_t>(np))>>,
                  "the parameterizer must model ChartParameterizer");
    request.parameterizer.emplace(parameter<parameterizer_t>(np));
  }
  if constexpr (has_parameter<optimizer_t, NamedParameters>) {
    static_assert(UVOptimizer<std::remove_cvref_t<decltype(parameter<optimizer_t>(np))>>,
                  "the optimizer must model UVOptimizer");
    request.optimizer.emplace(parameter<optimizer_t>(np));
  }
  if constexpr (has_parameter<validator_t, NamedParameters>) {
    using Validator = std::remove_cvref_t<decltype(parameter<validator_t>(np))>;
    static_assert(ChartValidator<Validator>, "the validator must model ChartValidator");
    request.validator.emplace(parameter<validator_t>(np));
    if constexpr (ChartSplitter<Validator>) // unless a splitter is given, a validator that can split does
      request.splitter.emplace(parameter<validator_t>(np));
  }
  if constexpr (has_parameter<splitter_t, NamedParameters>) {
    static_assert(ChartSplitter<std::remove_cvref_t<decltype(parameter<splitter_t>(np))>>,
                  "the splitter must model ChartSplitter");
    request.splitter.emplace(parameter<splitter_t>(np));
  }
  if constexpr (has_parameter<packer_t, NamedParameters>) {
    static_assert(ChartPacker<std::remove_cvref_t<decltype(parameter<packer_t>(np))>>,
                  "the packer must model ChartPacker");
    request.packer.emplace(parameter<packer_t>(np));
  }
}

/// What a pack of named parameters asks for.
template <typename NamedParameters>
Atlas_request atlas_request(const NamedParameters& np)
{
  Atlas_request request;
  request.page = page_options(np);
  read_parameter<mode_t>(np, request.mode);
  read_parameter<merge_options_t>(np, request.merge_options);
  if constexpr (has_parameter<max_charts_t, NamedParameters>)
    request.max_charts = checked_count("max_charts", parameter<max_charts_t>(np), 0, no_index - 1);
  if constexpr (has_parameter<min_chart_texels_t, NamedParameters>)
    request.min_chart_texels = static_cast<double>(parameter<min_chart_texels_t>(np));
  if constexpr (has_parameter<hard_angle_t, NamedParameters>)
    request.hard_angle = static_cast<double>(parameter<hard_angle_t>(np));
  if constexpr (has_parameter<min_coverage_t, NamedParameters>)
    request.wishes.min_coverage = static_cast<double>(parameter<min_coverage_t>(np));
  if constexpr (has_parameter<seam_exchange_rate_t, NamedParameters>)
    request.wishes.seam_exchange_rate = parameter<seam_exchange_rate_t>(np);
  if constexpr (has_parameter<min_texels_per_chart_t, NamedParameters>)
    request.wishes.min_texels_per_chart = static_cast<double>(parameter<min_texels_per_chart_t>(np));
  read_parameter<hide_seams_t>(np, request.hiding);
  read_parameter<straighten_t>(np, request.is_straightened);
  read_parameter<only_given_seams_t>(np, request.has_only_given_seams);
  read_parameter<symmetry_t>(np, request.symmetry);
  request.threads = number_of_threads(np);
  read_parameter<progress_t>(np, request.progress);
  read_policies(np, request);
  return request;
}

inline std::optional<std::vector<bool>> read_flags(Param_not_found, std::size_t)
{
  return std::nullopt;
}

inline std::vector<Index> read_numbers(Param_not_found, std::size_t)
{
  return {};
}

/// Pages of faces, from a map of the faces' numbers.
template <typename Map>
std::vector<Index> read_numbers(const Map& map, std::size_t size)
{
  static_assert(ReadableMap<Map, Index>, "face_page_map must be a readable map from numbers of faces");
  std::vector<Index> result;
  for (Index i = 0; i < size; ++i)
    result.push_back(static_cast<Index>(get(map, i)));
  return result;
}

/// Booleans of faces or corners, from a map of their numbers.
template <typename Map>
std::optional<std::vector<bool>> read_flags(const Map& map, std::size_t size)
{
  static_assert(ReadableMap<Map, Index>,
                "face_selection_map and pinned_map must be readable maps from numbers of faces or corners");
  std::vector<bool> result;
  for (Index i = 0; i < size; ++i)
    result.push_back(get(map, i));
  return result;
}

} // namespace internal

/// \brief Makes a texture atlas of a surface in flat arrays, such as `build_surface()` makes of any polygon
/// soup.
///
/// \param surface    what to map
/// \param corner_uv  output (with `face_selection_map` or `pinned_map` input too): per corner of the input,
///                   in the order in which the surface counts them, the coordinates in [0, 1]^2 of its page,
///                   origin bottom left; all but those that were given are floats in value. Left as it is
///                   when the run is cancelled or there is no surface.
/// \param np         any of the names of `parameters.h` but the maps; another name fails to compile
///
/// \throws Invalid_argument if an argument cannot be, or the arrays of the surface do not fit together;
/// before any work \throws Policy_error     if a policy returns what its concept does not allow
template <typename T = bool, typename Tag = CGAL::internal_np::all_default_t,
          typename Base = CGAL::internal_np::No_property>
Atlas_report
generate_atlas(const Surface& surface, std::vector<Point_2>& corner_uv,
               const CGAL::Named_function_parameters<T, Tag, Base>& np = parameters::default_values())
{
  using namespace internal;
  Atlas_names<face_page_map_t>::check(&np);
  Atlas_request request = atlas_request(np);
  using Parameters = CGAL::Named_function_parameters<T, Tag, Base>;
  static_assert(has_parameter<face_selection_map_t, Parameters> ||
                    !has_parameter<face_page_map_t, Parameters>,
                "of flat arrays the pages are in the report; face_page_map goes with face_selection_map");
  request.selection = read_flags(parameter<face_selection_map_t>(np), surface.number_of_faces);
  request.face_page = read_numbers(parameter<face_page_map_t>(np), surface.number_of_faces);
  request.pins = read_flags(parameter<pinned_map_t>(np), surface.number_of_corners);
  return run_atlas(surface, request, corner_uv);
}

/// \brief Makes a texture atlas of a mesh: segments it into charts, flattens them, proves them, packs them.
///
/// \tparam Mesh          a model of CGAL's `FaceListGraph`; triangles, quads or any polygons, open or closed
/// \tparam UVMap         a writable property map from halfedges, or from vertices, to points or vectors that
/// are constructible from two doubles, or to arrays of two numbers
///
/// \param mesh  stays as it is
/// \param uv    output: for every halfedge h that is not on the border, the image of `target(h)` in
/// `face(h)`, in [0, 1]^2 of the face's page, origin bottom left. Left as it is when the run is cancelled or
/// there is no atlas. A map of vertices is left as it is where a seam splits one, too: the status then is
/// `vertices_split`.
/// \param np    names of Atlas (see `parameters.h`) and of CGAL: `vertex_point_map`,
/// `vertex_index_map`,
///              `edge_is_constrained_map` (edges that must be seams), `face_patch_map` (faces of different
///              patches never share a chart). Another name fails to compile.
///
/// \return what happened; `is_valid()` tells whether the coordinates are proved to be free of flips and
/// overlaps. Faults of the data are in here, nothing is thrown for them.
///
/// \throws Invalid_argument if an argument cannot be; before any work
/// \throws Policy_error     if a policy returns what its concept does not allow
///
/// The steps are those of Levy, Petitjean, Ray, Maillot 2002.
template <FaceListMesh Mesh, WritableUVMap<Mesh> UVMap, typename T = bool,
          typename Tag = CGAL::internal_np::all_default_t, typename Base = CGAL::internal_np::No_property>
Atlas_report
generate_atlas(const Mesh& mesh, UVMap uv,
               const CGAL::Named_function_parameters<T, Tag, Base>& np = parameters::default_values())
{
  using namespace internal;
  Atlas_names<seam_cost_map_t, forbidden_seam_map_t, face_weight_map_t, face_chart_map_t, face_page_map_t,
              edge_seam_map_t, CGAL::internal_np::vertex_point_t, CGAL::internal_np::vertex_index_t,
              CGAL::internal_np::edge_is_constrained_t, CGAL::internal_np::face_patch_t>::check(&np);
  Atlas_request request = atlas_request(np);
  const Mesh_arrays<Mesh> arrays = mesh_arrays(mesh, np);
  std::vector<Point_2> corner_uv;
  using Parameters = CGAL::Named_function_parameters<T, Tag, Base>;
  constexpr bool has_selection = has_parameter<face_selection_map_t, Parameters>,
                 has_pins = has_parameter<pinned_map_t, Parameters>;
  if constexpr (has_selection || has_pins) {
    static_assert(ReadableHalfedgeUVMap<UVMap, Mesh>,
                  "with face_selection_map or pinned_map the map of coordinates must be readable, too");
    corner_uv = read_corner_uv(mesh, arrays, uv);
  }
  if constexpr (has_selection) {
    request.selection = read_selection(arrays, parameter<face_selection_map_t>(np));
    using Pages = std::remove_cvref_t<decltype(parameter<face_page_map_t>(np))>;
    if constexpr (ReadableMap<Pages, typename Mesh_arrays<Mesh>::Face>)
      request.face_page = read_face_numbers(arrays, parameter<face_page_map_t>(np));
  }
  if constexpr (has_pins)
    request.pins = read_pins(mesh, arrays, parameter<pinned_map_t>(np));
  const std::vector<Point_2> before = corner_uv; // what stays is not written again
  Atlas_report report = run_atlas(arrays.surface, request, corner_uv);
  if (report.status != Atlas_status::valid && report.status != Atlas_status::not_valid)
    return report;
  if (!write_corner_uv(mesh, arrays, corner_uv, before, uv)) {
    report.status = Atlas_status::vertices_split;
    return report;
  }
  write_edge_seams(mesh, arrays, report.segmentation, parameter<edge_seam_map_t>(np));
  write_face_numbers(arrays, report.face_chart, parameter<face_chart_map_t>(np));
  write_face_numbers(arrays, report.face_page, parameter<face_page_map_t>(np));
  return report;
}

} // namespace Atlas

#endif
