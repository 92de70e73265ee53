// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_ATLAS_CERTIFICATE_H
#define ATLAS_VALIDATION_ATLAS_CERTIFICATE_H

#include <Atlas/core/Kernel.h>
#include <Atlas/core/library.h>

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace Atlas {

/// \brief What has been proved about the texture coordinates of a mesh, at the precision they are stored in.
///
/// Counts are of triangles (polygons are triangulated), unless their names say otherwise. Flips, flat
/// triangles, overlaps and corners outside of the page are decided exactly on the coordinates; lengths, areas
/// and distances are measured in double precision.
///
/// A *chart* is a set of triangles connected over edges on which both sides have equal coordinates.
struct Atlas_certificate
{
  // How much has been looked at.
  std::size_t faces = 0;     ///< faces of the mesh
  std::size_t triangles = 0; ///< triangles of those that can take part
  std::size_t rejected_faces =
      0; ///< faces that are none (too few corners, no finite position); never to blame
  std::size_t pages = 0;
  Index width = 0, height = 0; ///< of a page, in texels

  // Triangles.
  std::size_t not_finite = 0;      ///< a corner has no coordinates, or NaN or infinite ones
  std::size_t flipped = 0;         ///< of the orientation that is in the minority in their chart
  std::size_t degenerate = 0;      ///< flat in the plane, but not in space
  std::size_t corners_outside = 0; ///< corners of faces that lie outside of the page

  // Overlaps: pairs of triangles on the same page whose interiors intersect. Contact is none.
  bool is_overlap_free = true;
  std::size_t overlaps_in_charts = 0;
  std::size_t overlaps_between_charts = 0;
  bool are_overlaps_complete = true; ///< `false`: counting was stopped, there may be more

  // Charts.
  std::size_t charts = 0;
  std::size_t non_disc_charts = 0; ///< not homeomorphic to a disc
  std::size_t mirrored_charts = 0; ///< most triangles are clockwise
  double seam_length = 0;          ///< in space: edges whose triangles differ in the plane, each once

  // Distances, in texels.
  double gutter = 0; ///< asked for between charts; half of it to the border of the page
  double gutter_tolerance = 0;
  double chart_distance = std::numeric_limits<double>::infinity(); ///< smallest between two charts on a page
  double page_border_distance =
      std::numeric_limits<double>::infinity(); ///< smallest from a chart to the border of its page; negative
                                               ///< outside
  std::array<Index, 2> closest_faces{no_index, no_index}; ///< of two charts, at `chart_distance`

  // Density, in texels per unit of the model: square root of (area in texels / area in space).
  double density_min = std::numeric_limits<double>::infinity();
  double density_max = 0;

  std::vector<Index>
      face_chart; ///< per face its chart, in the order of their first triangles; `no_index`: none
  std::vector<Index> culprits; ///< faces to blame for a fault of the triangle kind or an overlap, sorted
  bool are_culprits_complete = true; ///< `false`: the list has been capped

  std::vector<Index> crowded_faces; ///< faces of which a border edge is too near to another chart, or a
                                    ///< corner to the border of the page; sorted, capped like `culprits`.
                                    ///< Where charts overlap each other, only the latter.

  bool keeps_gutter() const
  {
    return chart_distance >= gutter - gutter_tolerance &&
           page_border_distance >= gutter / 2 - gutter_tolerance;
  }

  /// \brief Whether the coordinates are a one-to-one map into the pages that keeps the gutter.
  ///
  /// Charts that are mirrored or no discs are reported, but are no fault by themselves.
  bool is_valid() const
  {
    return not_finite == 0 && flipped == 0 && degenerate == 0 && corners_outside == 0 && is_overlap_free &&
           keeps_gutter();
  }
};

/// The faults, as one sentence for the user.
std::string message(const Atlas_certificate& c);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/validation/internal/Atlas_certificate_impl.h>
#endif

#endif
