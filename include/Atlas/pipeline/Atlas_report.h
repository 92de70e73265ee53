// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_ATLAS_REPORT_H
#define ATLAS_PIPELINE_ATLAS_REPORT_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/validation/certify.h>

#include <array>
#include <cstddef>
#include <vector>

namespace Atlas {

/// How a run ended.
enum class Atlas_status {
  valid,         ///< every face that can has coordinates, and the certificate proves them
  not_valid,     ///< coordinates are complete, but the certificate names faults
  no_surface,    ///< not one face has an area: there is nothing to map
  no_room,       ///< the packer found no room for the charts; the coordinates are untouched
  cancelled,     ///< the caller asked to stop; the coordinates are untouched
  vertices_split ///< seams split vertices, for which the map has one place each; it is untouched
};

/// A sentence for the user.
inline const char* message(Atlas_status status)
{
  switch (status) {
  case Atlas_status::valid:
    return "the atlas is valid";
  case Atlas_status::not_valid:
    return "the atlas is not valid";
  case Atlas_status::no_surface:
    return "no face of the mesh has an area";
  case Atlas_status::no_room:
    return "the pages have no room for the charts";
  case Atlas_status::cancelled:
    return "the caller asked to stop";
  case Atlas_status::vertices_split:
    return "seams split vertices, and a map of vertices has one place for each: use a map of halfedges";
  }
  return "unknown status";
}

/// What became of the wish for full pages.
enum class Coverage_outcome {
  not_asked_for, ///< there was none
  kept,          ///< the pages are at least that full
  no_cut_helps,  ///< no cut along edges that may be seams makes charts that need less room
  given_up       ///< many cuts were made, and the pages are still not full enough
};

/// A sentence for the user.
inline const char* message(Coverage_outcome outcome)
{
  switch (outcome) {
  case Coverage_outcome::not_asked_for:
    return "no coverage was asked for";
  case Coverage_outcome::kept:
    return "the pages are as full as asked for";
  case Coverage_outcome::no_cut_helps:
    return "no cut along the edges of the mesh makes the pages fuller";
  case Coverage_outcome::given_up:
    return "the pages are not as full as asked for after all cuts that were tried";
  }
  return "unknown outcome";
}

/// Why a chart exceeds the bound on distortion.
enum class Excess_reason {
  none,             ///< it does not
  single_face,      ///< it is a single face, and faces are never cut
  split_in_vain,    ///< cutting it up hardly lowers the distortion: the surface is rough there
  density_given_up, ///< its densities vary too much, and splitting has not mended that
  not_asked_for,    ///< the validator accepts it: one without this bound, or because a wish for few or large
                    ///< charts goes before
  rounded           ///< it keeps the bound but for the rounding of its coordinates
};

/// A sentence for the user.
inline const char* message(Excess_reason reason)
{
  switch (reason) {
  case Excess_reason::none:
    return "the chart keeps its bound";
  case Excess_reason::single_face:
    return "the chart is a single face, and faces are not cut";
  case Excess_reason::split_in_vain:
    return "cutting the chart up hardly lowers its distortion";
  case Excess_reason::density_given_up:
    return "splitting has not made the densities in the chart alike";
  case Excess_reason::not_asked_for:
    return "the chart is accepted as other wishes go before the bound";
  case Excess_reason::rounded:
    return "the chart keeps its bound but for the rounding of its coordinates";
  }
  return "unknown reason";
}

/// Why the pins of a chart could not be kept.
enum class Pin_fault {
  not_one_to_one,  ///< with them triangles of the chart flip, are flat or overlap; or they are all at one
                   ///< place
  outside_page,    ///< with them the chart leaves the page
  covers_chart,    ///< with them the chart lies on another one that has pins, or stays
  no_seam_between, ///< two corners of one vertex are pinned to two places, and no seam is between them
  refused,         ///< the validator that was given refuses the chart
  not_solved,      ///< the linear system of the map has no solution
  no_room          ///< what is pinned leaves the other charts no room
};

/// A sentence for the user.
inline const char* message(Pin_fault fault)
{
  switch (fault) {
  case Pin_fault::not_one_to_one:
    return "with its pins the chart would fold or overlap itself";
  case Pin_fault::outside_page:
    return "with its pins the chart would leave the page";
  case Pin_fault::covers_chart:
    return "with its pins the chart would lie on another that is pinned or stays";
  case Pin_fault::no_seam_between:
    return "corners of one vertex are pinned to two places, but no seam is between them";
  case Pin_fault::refused:
    return "the validator refuses the chart with its pins";
  case Pin_fault::not_solved:
    return "the linear system of the map with these pins could not be solved";
  case Pin_fault::no_room:
    return "what is pinned leaves no room for the other charts";
  }
  return "unknown fault";
}

/// \brief A chart that was laid out without its pins.
struct Moved_pins
{
  Index chart = no_index;     ///< which one
  Pin_fault fault = {};       ///< why
  std::vector<Index> corners; ///< its pinned corners: of the input, sorted
};

/// \brief What became of one chart.
struct Chart_report
{
  Chart_status status = Chart_status::valid; ///< `valid`, or `bound_exceeded` or `area_ratio_exceeded` where
                                             ///< a bound was given up
  std::size_t triangles = 0;                 ///< how many it has
  double area = 0;                           ///< in space, squared units of the model
  Distortion distortion;                     ///< up to the chart's own scale
  Distortion unoptimized;                    ///< the same before the optimizer
  double stretch = 1;          ///< what the share of its area that `Atlas_report::bound` names has at most
  bool is_within_bound = true; ///< whether the distortion is at most `Atlas_report::bound`
  Excess_reason reason = Excess_reason::none; ///< why it is not
  Flattening_record
      flattening; ///< what was done to flatten it; as by default for parameterizers that do not tell
};

/// \brief What happened: the answer of `generate_atlas()`.
struct [[nodiscard]] Atlas_report
{
  Atlas_status status = Atlas_status::no_surface; ///< how the run ended

  std::size_t faces = 0;     ///< of the input
  std::size_t triangles = 0; ///< after the triangulation of its polygons
  std::size_t pages = 0;     ///< how many have charts on them
  /// Width of a page, in texels.
  Index page_width = 0, page_height = 0; ///< height of a page, in texels
  double gutter = 0;                     ///< asked for, texels

  std::vector<Surface::Rejected_face>
      rejected;              ///< faces that cannot have coordinates of their own, with the reason
  Segmentation segmentation; ///< per triangle of the surface its chart, and the cuts. Charts are numbered in
                             ///< the order of their first triangles, here, in `charts` and in the certificate
  std::vector<Index> face_chart;    ///< per face of the input: its chart, or `no_index` for a rejected face
  std::vector<Index> face_page;     ///< per face of the input: its page
  std::vector<Chart_report> charts; ///< in the order of their first triangles
  std::size_t added_seams = 0; ///< with `only_given_seams`: edges that are seams besides those asked for, as
                               ///< charts would not be discs, or cover themselves, without
  std::size_t segmented_charts = 0; ///< how many charts the segmentation made, before they were cut to discs
  std::size_t split_charts = 0;     ///< how many charts were refused and split on the way
  std::size_t rejoined_pieces = 0;  ///< how many of the pieces were accepted together with a neighbour
  double min_coverage = 0;          ///< asked for: what charts are to cover of the pages
  Coverage_outcome coverage_outcome = Coverage_outcome::not_asked_for; ///< whether they do
  std::size_t pieces_cut_for_pages = 0; ///< how many charts more there are as some were cut for fuller pages
  std::size_t enlarged_charts = 0;      ///< how many charts are larger for `min_texels_per_chart`
  std::size_t stacked_charts = 0; ///< how many charts lie on a chart that they are a copy of, as asked for;
                                  ///< the certificate takes each such layer for a page of its own
  std::vector<Moved_pins> moved_pins; ///< the charts of which pinned corners could not stay, in order; empty:
                                      ///< all are where they were

  Distortion_bound bound; ///< what charts were merged under; infinite for segmentations without one
  std::size_t charts_beyond_bound = 0; ///< how many charts exceed it; each says why

  double area = 0;        ///< of the surface, squared units of the model
  double seam_length = 0; ///< units of the model, each seam once
  Distortion distortion;  ///< of the whole atlas, up to one scale; as `unoptimized` and `gradient_angles`
                          ///< without charts of faces that were not selected
  Distortion unoptimized; ///< the same before the optimizer, each chart scaled to its area in space; the same
                          ///< as `distortion` if the optimizer changed nothing
  std::array<double, 180> gradient_angles{}; ///< figure 9 of the LSCM paper: per degree of the angle between
                                             ///< the gradients of u and v, the share of the triangles
  double packing_efficiency = 0;             ///< share of the pages that is covered by charts, in [0, 1]
  double density = 0;                        ///< texels per unit of the model

  std::array<double, std::size(all_stages)> seconds{}; ///< wall-clock time of each stage
  Atlas_certificate certificate;                       ///< what has been proved

  /// Whether the coordinates are proved.
  bool is_valid() const { return status == Atlas_status::valid; }
  /// The time of all stages together.
  double total_seconds() const
  {
    double sum = 0;
    for (const double s : seconds)
      sum += s;
    return sum;
  }
};

} // namespace Atlas

#endif
