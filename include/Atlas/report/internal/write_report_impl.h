// SPDX-License-Identifier: MIT
#ifndef ATLAS_REPORT_INTERNAL_WRITE_REPORT_IMPL_H
#define ATLAS_REPORT_INTERNAL_WRITE_REPORT_IMPL_H

#include <Atlas/core/internal/library.h>
#include <Atlas/image/internal/Output_file.h>
#include <Atlas/report/write_report.h>

#include <nlohmann/json.hpp>
#include <utility>

namespace Atlas {

ATLAS_INLINE Json to_json(const Distortion& d)
{
  return {{"l2_stretch", d.l2_stretch},
          {"linf_stretch", d.linf_stretch},
          {"stretch_p99", d.stretch_p99},
          {"stretch_max", d.stretch_max},
          {"quasi_conformal_mean", d.quasi_conformal_mean},
          {"quasi_conformal_max", d.quasi_conformal_max},
          {"angle_mean_degrees", d.angle_mean},
          {"area_mean", d.area_mean},
          {"area_min", d.area_min},
          {"area_max", d.area_max},
          {"symmetric_dirichlet_mean", d.symmetric_dirichlet_mean},
          {"symmetric_dirichlet_max", d.symmetric_dirichlet_max},
          {"triangles", d.triangles}};
}

ATLAS_INLINE Json to_json(const Atlas_certificate& c)
{
  return {{"is_valid", c.is_valid()},
          {"message", message(c)},
          {"faces", c.faces},
          {"rejected_faces", c.rejected_faces},
          {"triangles", c.triangles},
          {"not_finite", c.not_finite},
          {"flipped", c.flipped},
          {"degenerate", c.degenerate},
          {"corners_outside_of_page", c.corners_outside},
          {"is_overlap_free", c.is_overlap_free},
          {"overlaps_in_charts", c.overlaps_in_charts},
          {"overlaps_between_charts", c.overlaps_between_charts},
          {"are_overlaps_complete", c.are_overlaps_complete},
          {"charts", c.charts},
          {"non_disc_charts", c.non_disc_charts},
          {"mirrored_charts", c.mirrored_charts},
          {"seam_length", c.seam_length},
          {"gutter_texels", c.gutter},
          {"chart_distance_texels", c.chart_distance},
          {"page_border_distance_texels", c.page_border_distance},
          {"texels_per_unit_min", c.density_min},
          {"texels_per_unit_max", c.density_max},
          {"crowded_faces", c.crowded_faces},
          {"culprits", c.culprits},
          {"are_culprits_complete", c.are_culprits_complete}};
}

ATLAS_INLINE Json to_json(const Flattening_record& record)
{
  return {{"start", message(record.start)},
          {"flips_of_first_choice", record.flips},
          {"first_choice_overlapped", record.was_overlapping},
          {"is_optimized", record.is_optimized},
          {"optimizer_iterations", record.distortion.iterations},
          {"border_was_guarded", record.distortion.was_border_guarded}};
}

namespace internal {

inline Json to_json(const Distortion_bound& bound)
{
  return {{"measure", name(bound.measure)},
          {"max", bound.max},
          {"max_stretch", bound.max_stretch},
          {"max_stretch_share", bound.stretch_share}};
}

inline Json to_json(const Chart_report& chart)
{
  return {{"triangles", chart.triangles},
          {"area", chart.area},
          {"status", message(chart.status)},
          {"is_within_bound", chart.is_within_bound},
          {"bound_message", message(chart.reason)},
          {"stretch", chart.stretch},
          {"stretch_max", chart.distortion.stretch_max},
          {"symmetric_dirichlet_mean", chart.distortion.symmetric_dirichlet_mean},
          {"l2_stretch", chart.distortion.l2_stretch},
          {"l2_stretch_unoptimized", chart.unoptimized.l2_stretch},
          {"quasi_conformal_mean", chart.distortion.quasi_conformal_mean},
          {"area_min", chart.distortion.area_min},
          {"area_max", chart.distortion.area_max},
          {"flattening", Atlas::to_json(chart.flattening)}};
}

} // namespace internal

ATLAS_INLINE Json to_json(const Atlas_report& report)
{
  Json rejected = Json::array(), moved = Json::array(), charts = Json::array(), seconds = Json::object();
  for (const auto& [face, reason] : report.rejected)
    rejected.push_back({{"face", face}, {"reason", message(reason)}});
  for (const auto& [chart, fault, corners] : report.moved_pins)
    moved.push_back({{"chart", chart}, {"reason", message(fault)}, {"corners", corners}});
  for (const Chart_report& chart : report.charts)
    charts.push_back(internal::to_json(chart));
  for (const Stage stage : all_stages)
    seconds[name(stage)] = report.seconds[static_cast<std::size_t>(stage)];
  seconds["total"] = report.total_seconds();
  return {{"is_valid", report.is_valid()},
          {"message", message(report.status)},
          {"faces", report.faces},
          {"triangles", report.triangles},
          {"rejected_faces", std::move(rejected)},
          {"pages", report.pages},
          {"page_width", report.page_width},
          {"page_height", report.page_height},
          {"gutter_texels", report.gutter},
          {"number_of_charts", report.charts.size()},
          {"segmented_charts", report.segmented_charts},
          {"split_charts", report.split_charts},
          {"added_seams", report.added_seams},
          {"rejoined_pieces", report.rejoined_pieces},
          {"stacked_charts", report.stacked_charts},
          {"min_coverage", report.min_coverage},
          {"coverage_outcome", message(report.coverage_outcome)},
          {"pieces_cut_for_pages", report.pieces_cut_for_pages},
          {"enlarged_charts", report.enlarged_charts},
          {"moved_pins", std::move(moved)},
          {"bound", internal::to_json(report.bound)},
          {"charts_beyond_bound", report.charts_beyond_bound},
          {"area", report.area},
          {"seam_length", report.seam_length},
          {"packing_efficiency", report.packing_efficiency},
          {"texels_per_unit", report.density},
          {"distortion", to_json(report.distortion)},
          {"unoptimized", to_json(report.unoptimized)},
          {"gradient_angles", report.gradient_angles},
          {"certificate", to_json(report.certificate)},
          {"seconds", std::move(seconds)},
          {"charts", std::move(charts)}};
}

ATLAS_INLINE std::string json_text(const Json& json)
{
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

ATLAS_INLINE void write_report(const std::filesystem::path& path, const Atlas_report& report)
{
  internal::write_whole_file(path, json_text(to_json(report)));
}

} // namespace Atlas

#endif
