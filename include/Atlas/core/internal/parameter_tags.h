// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_PARAMETER_TAGS_H
#define ATLAS_CORE_INTERNAL_PARAMETER_TAGS_H

/// What tells named parameters apart: a type for each, called as the parameter.
namespace Atlas::internal {

struct texture_size_t
{};
struct gutter_t
{};
struct page_options_t
{};
struct mode_t
{};
struct merge_options_t
{};
struct max_charts_t
{};
struct min_chart_texels_t
{};
struct hard_angle_t
{};
struct min_coverage_t
{};
struct seam_exchange_rate_t
{};
struct min_texels_per_chart_t
{};
struct straighten_t
{};
struct hide_seams_t
{};
struct symmetry_t
{};
struct seam_cost_map_t
{};
struct only_given_seams_t
{};
struct face_selection_map_t
{};
struct pinned_map_t
{};
struct forbidden_seam_map_t
{};
struct face_weight_map_t
{};
struct policies_t
{};
struct segmentation_t
{};
struct parameterizer_t
{};
struct optimizer_t
{};
struct validator_t
{};
struct splitter_t
{};
struct packer_t
{};
struct number_of_threads_t
{};
struct progress_t
{};
struct face_chart_map_t
{};
struct face_page_map_t
{};
struct edge_seam_map_t
{};

} // namespace Atlas::internal

#endif
