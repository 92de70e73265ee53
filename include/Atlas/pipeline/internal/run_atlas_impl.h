// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_RUN_ATLAS_IMPL_H
#define ATLAS_PIPELINE_INTERNAL_RUN_ATLAS_IMPL_H

#include <Atlas/core/build_surface.h>
#include <Atlas/core/errors.h>
#include <Atlas/core/internal/check_surface.h>
#include <Atlas/parameterization/Bijective_parameterizer.h>
#include <Atlas/pipeline/internal/Atlas_pipeline.h>
#include <Atlas/pipeline/internal/remake_faces.h>
#include <Atlas/pipeline/internal/run_atlas.h>
#include <Atlas/segmentation/Merged_segmentation.h>
#include <Atlas/segmentation/Patch_segmentation.h>
#include <Atlas/validation/Exact_validator.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace Atlas::internal {

/// When charts merge, as the request says.
inline Merge_options merge_options_of(const Atlas_request& request)
{
  Merge_options options = request.merge_options.value_or(merge_options(request.mode));
  options.max_charts = request.max_charts.value_or(options.max_charts);
  if (request.min_chart_texels > 0)
    options.min_chart_area = area_share_of_texels(request.min_chart_texels, request.page);
  return options;
}

/// Charts that the user draws are what they are: nobody else has a say in it.
inline void check_given_seams(const Atlas_request& request)
{
  if (!request.has_only_given_seams)
    return;
  const char* reason = "has no meaning where the given seams alone make the charts (only_given_seams)";
  require(!request.segmentation, "segmentation", reason);
  require(!request.merge_options, "merge_options", reason);
  require(!request.max_charts, "max_charts", reason);
  require(request.min_chart_texels == 0, "min_chart_texels", reason);
  require(request.symmetry == Symmetry::off, "symmetry", reason);
  require(!request.is_straightened, "straighten", reason);
  require(request.wishes.min_coverage == 0, "min_coverage", reason);
  require(request.wishes.seam_exchange_rate.value_or(0) == 0, "seam_exchange_rate", reason);
}

/// A segmentation that is given merges as it likes: who asks for something else too would not get it.
inline void check_wishes(const Atlas_request& request)
{
  if (!request.segmentation && !request.policies && request.mode != Atlas_mode::paper)
    return;
  const char* reason = "speaks to the default segmentation, but another one is given; give it to that one";
  require(!request.merge_options, "merge_options", reason);
  require(!request.max_charts, "max_charts", reason);
  require(request.min_chart_texels == 0, "min_chart_texels", reason);
  require(request.symmetry == Symmetry::off, "symmetry", reason);
}

/// All policies as they are given, or those of the mode.
inline Policies first_policies(const Atlas_request& request)
{
  if (request.policies)
    return *request.policies;
  if (request.mode == Atlas_mode::paper && request.validator)
    return paper_preset(*request.validator);
  return preset(request.mode, merge_options_of(request), request.symmetry);
}

/// The policies of the mode, and those that are given in their place.
inline Policies policies_of(const Surface& surface, const Atlas_request& request)
{
  Policies policies = first_policies(request);
  policies.segmentation = request.segmentation.value_or(policies.segmentation);
  policies.parameterizer = request.parameterizer.value_or(policies.parameterizer);
  policies.optimizer = request.optimizer.value_or(policies.optimizer);
  policies.validator = request.validator.value_or(policies.validator);
  policies.splitter = request.splitter.value_or(policies.splitter);
  policies.packer = request.packer.value_or(policies.packer);
  if (request.has_only_given_seams) {
    policies.segmentation = Patch_segmentation();
    if (!request.validator)
      policies.validator = Exact_validator(std::numeric_limits<double>::infinity(), 0);
    policies.repair.rejoin_pieces = false;
  }
  if (request.is_straightened) {
    const Distortion_bound bound =
        policies.segmentation.bound().value_or(bound_of(merge_options_of(request)));
    policies.segmentation = Straight_segmentation(policies.segmentation, bound);
    policies.parameterizer = Straight_parameterizer(surface.face, policies.parameterizer, bound);
  }
  return policies;
}

/// Which copies of parts get the charts of their models. Policies that are given one by one may ask which
/// triangle is which, so that they see the surface as it is.
inline Chart_stacking shared_parts(const Atlas_request& request)
{
  const bool is_given = request.segmentation || request.parameterizer || request.optimizer ||
                        request.validator || request.splitter;
  return is_given ? Chart_stacking::none : request.page.stacking;
}

inline void check_page_wishes(const Atlas_request& request)
{
  const auto require_not_negative = [](double value, const char* name) {
    require(std::isfinite(value) && value >= 0, name, "must be finite and not negative");
  };
  const Page_wishes& wishes = request.wishes;
  require(wishes.min_coverage >= 0 && wishes.min_coverage < 1, "min_coverage", "must be in [0, 1)");
  require(wishes.min_coverage == 0 || request.page.density == 0, "min_coverage",
          "cannot be kept at a given density: the last page has what is left over");
  require_not_negative(wishes.seam_exchange_rate.value_or(0), "seam_exchange_rate");
  require_not_negative(wishes.min_texels_per_chart, "min_texels_per_chart");
}

/// When charts are cut for their pages. Who says which charts there are, or wants few, large or mirrored
/// ones, gets them as they are, unless he gives a rate.
inline Cut_trade cut_trade(const Atlas_request& request)
{
  if (request.wishes.seam_exchange_rate)
    return {.rate = *request.wishes.seam_exchange_rate,
            .is_for_density = *request.wishes.seam_exchange_rate > 0};
  const Page_options& page = request.page;
  const bool has_lists = !page.weights.empty() || !page.groups.empty() || !page.locked.empty();
  const bool is_own = request.segmentation || request.parameterizer || request.optimizer ||
                      request.validator || request.splitter || request.has_only_given_seams;
  const Merge_options merging = merge_options_of(request);
  if (has_lists || is_own || merging.max_charts > 0 || merging.min_chart_area > 0 ||
      request.symmetry != Symmetry::off)
    return {};
  return {seam_exchange_rate(request.mode),
          default_added_seam,
          request.mode != Atlas_mode::paper,
          default_full_coverage,
          default_empty_coverage,
          default_added_seam_of_empty_pages};
}

/// Edges that are seams although nobody asked for them.
inline std::size_t added_seams(const Surface& surface, const Segmentation& segmentation)
{
  std::size_t count = 0;
  for (Index h = 0; h < surface.opposite.size(); ++h) {
    const Index o = surface.opposite[h];
    if (o == no_index || o < h || segmentation.is_glued(surface, h))
      continue;
    const bool is_wanted = !surface.constraint.empty() && surface.constraint[h] == Edge_constraint::seam;
    const bool is_border = !surface.patch.empty() && surface.patch[h / 3] != surface.patch[o / 3];
    count += !is_wanted && !is_border;
  }
  return count;
}

/// The surface with the seams that angles and viewers ask for.
inline Surface with_wishes(const Surface& surface, const Atlas_request& request)
{
  Surface result = surface;
  if (request.hard_angle > 0)
    constrain_hard_edges(result, request.hard_angle);
  if (request.hiding)
    hide_seams(result, *request.hiding, Execution(request.threads));
  return result;
}

/// Refuses what does not go with charts that have their places: lists for charts would speak of others than
/// those that there are, and copies of charts that stay would stay too.
inline void check_places(const Page_options& page, const char* reason, const char* reason_of_lists)
{
  require(page.stacking == Chart_stacking::none, "stacking", reason);
  require(!page.has_free_aspect, "has_free_aspect", reason);
  require(page.weights.empty() && page.groups.empty() && page.locked.empty(), "page_options",
          reason_of_lists);
}

inline void check_selection(const Atlas_request& request)
{
  if (request.selection)
    check_places(request.page, "does not go with face_selection_map",
                 "has lists for charts, which do not go with face_selection_map");
}

/// Whether any corner is pinned.
inline bool has_pins(const Atlas_request& request)
{
  return request.pins && std::find(request.pins->begin(), request.pins->end(), true) != request.pins->end();
}

/// Refuses pins without a place on the first page, and wishes that they would break.
inline void check_pinned(const Atlas_request& request, const Surface& surface,
                         const std::vector<Point_2>& corner_uv)
{
  if (!request.pins)
    return;
  const std::vector<bool>& pins = *request.pins;
  require(pins.size() == surface.number_of_corners, "pinned_map",
          "must tell of each corner whether it is pinned");
  check_places(request.page, "does not go with pinned_map",
               "has lists for charts, which do not go with pinned_map");
  require(request.wishes.min_coverage == 0, "min_coverage",
          "does not go with pinned_map: pages are as full as pins let them be");
  if (!has_pins(request))
    return;
  require(corner_uv.size() == pins.size(), "pinned_map",
          "goes with the coordinates that pinned corners have");
  for (std::size_t c = 0; c < pins.size(); ++c) {
    const Point_2& p = corner_uv[c];
    require(!pins[c] || (p.x() >= 0 && p.x() <= 1 && p.y() >= 0 && p.y() <= 1), "pinned_map",
            "pinned corners must have coordinates in [0, 1]^2");
  }
}

/// What is pinned, and how the map goes between pins: as in the mode.
inline Pins pins_of(const Atlas_request& request)
{
  if (!has_pins(request))
    return {};
  return {*request.pins, request.mode == Atlas_mode::standard || request.mode == Atlas_mode::few_seams,
          request.validator};
}

ATLAS_INLINE Atlas_report run_atlas(const Surface& surface, const Atlas_request& request,
                                    std::vector<Point_2>& corner_uv)
{
  check_surface(surface);
  check(request.page);
  require(request.hard_angle >= 0 && request.hard_angle <= 180, "hard_angle", "must be in (0, 180] degrees");
  require(std::isfinite(request.min_chart_texels) && request.min_chart_texels >= 0, "min_chart_texels",
          "must be finite and not negative");
  check_page_wishes(request);
  check_wishes(request);
  check_given_seams(request);
  check_selection(request);
  check_pinned(request, surface, corner_uv);
  const Policies policies = policies_of(surface, request); // faults of policies show before the work
  Page_options page = request.page;
  if (request.mode == Atlas_mode::paper && page.rotation == Chart_rotation::aligned)
    page.rotation = Chart_rotation::free; // the paper stands charts upright by their diameters
  const auto run = [&](const Surface& input, const Policies& of_input, std::vector<Point_2>& uv) {
    return Atlas_pipeline(input, of_input, page, request.wishes, cut_trade(request), shared_parts(request),
                          request.threads, request.progress)
        .run(uv);
  };
  const auto make = [&](const Surface& input) {
    Atlas_report report;
    if (request.selection || has_pins(request)) {
      const Execution execution(request.threads, [&](double fraction) {
        return !request.progress || request.progress(Stage::packing, fraction);
      });
      const auto run_part = [&](const Surface& part, std::vector<Point_2>& uv) {
        return run(part, policies_of(part, request), uv);
      };
      const std::vector<bool> all(request.selection ? 0 : input.number_of_faces, true);
      const Pins pins = pins_of(request);
      report = Face_remaker(input, request.selection ? *request.selection : all, request.face_page, pins,
                            corner_uv)(run_part, policies.packer, page, execution, corner_uv);
    } else {
      report = run(input, policies, corner_uv);
    }
    if (request.has_only_given_seams && !report.charts.empty())
      report.added_seams = added_seams(input, report.segmentation);
    return report;
  };
  return request.hard_angle > 0 || request.hiding ? make(with_wishes(surface, request)) : make(surface);
}

} // namespace Atlas::internal

#endif
