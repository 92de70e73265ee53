// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_CERTIFY_H
#define ATLAS_VALIDATION_CERTIFY_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Kernel.h>
#include <Atlas/core/Packing.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/library.h>

#include <array>
#include <cstddef>
#include <limits>
#include <span>
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
      0;                 ///< faces that are none (too few corners, no finite position); never to blame
  std::size_t pages = 0; ///< how many have faces on them
  /// Width of a page, in texels.
  Index width = 0, height = 0; ///< height of a page, in texels

  // Triangles.
  std::size_t not_finite = 0;      ///< a corner has no coordinates, or NaN or infinite ones
  std::size_t flipped = 0;         ///< of the orientation that is in the minority in their chart
  std::size_t degenerate = 0;      ///< flat in the plane, but not in space
  std::size_t corners_outside = 0; ///< corners of faces that lie outside of the page

  // Overlaps: pairs of triangles on the same page whose interiors intersect. Contact is none.
  bool is_overlap_free = true;             ///< decided by a sweep over the border
  std::size_t overlaps_in_charts = 0;      ///< pairs of one chart
  std::size_t overlaps_between_charts = 0; ///< pairs of two charts
  bool are_overlaps_complete = true;       ///< `false`: counting was stopped, there may be more

  // Charts.
  std::size_t charts = 0;          ///< see above
  std::size_t non_disc_charts = 0; ///< not homeomorphic to a disc
  std::size_t mirrored_charts = 0; ///< most triangles are clockwise
  double seam_length = 0;          ///< in space: edges whose triangles differ in the plane, each once

  // Distances, in texels.
  double gutter = 0;           ///< asked for between charts; half of it to the border of the page
  double gutter_tolerance = 0; ///< by how much a distance may fall short
  double chart_distance = std::numeric_limits<double>::infinity(); ///< smallest between two charts on a page
  double page_border_distance =
      std::numeric_limits<double>::infinity(); ///< smallest from a chart to the border of its page; negative
                                               ///< outside
  std::array<Index, 2> closest_faces{no_index, no_index}; ///< of two charts, at `chart_distance`

  // Density, in texels per unit of the model: square root of (area in texels / area in space).
  double density_min = std::numeric_limits<double>::infinity(); ///< the least of a triangle
  double density_max = 0;                                       ///< the largest of a triangle

  std::vector<Index>
      face_chart; ///< per face its chart, in the order of their first triangles; `no_index`: none
  std::vector<Index> culprits; ///< faces to blame for a fault of the triangle kind or an overlap, sorted
  bool are_culprits_complete = true; ///< `false`: the list has been capped

  std::vector<Index> crowded_faces; ///< faces of which a border edge is too near to another chart, or a
                                    ///< corner to the border of the page; sorted, capped like `culprits`.
                                    ///< Where charts overlap each other, only the latter.

  /// Whether charts keep the gutter from each other, and half of it from the border.
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

/// How coordinates are stored where they are used.
enum class Uv_precision {
  single_precision, ///< 32 bits: glTF, engines, graphics hardware
  double_precision  ///< 64 bits: taken as they are
};

/// By how many texels a distance may fall short of the gutter: distances are measured in coordinates that
/// have been rounded, to a thousandth of a texel on a page of 16 k.
inline constexpr double default_gutter_tolerance = 0.01;

/// What a certificate is asked for.
struct Certificate_options
{
  Index width = default_texture_size;  ///< texels; a unit of u
  Index height = default_texture_size; ///< texels; a unit of v
  double gutter = 0; ///< least distance between charts, in texels; half of it to the page border
  double gutter_tolerance = default_gutter_tolerance;      ///< texels
  Uv_precision precision = Uv_precision::double_precision; ///< to which coordinates are rounded first
  std::size_t max_overlaps = 1'000'000;                    ///< pairs of triangles to count at most
  std::size_t max_culprits = 1'000'000;                    ///< faces to list at most
};

/// \brief Examines texture coordinates of any origin.
///
/// Coordinates are rounded to the precision asked for, then everything is decided on the rounded values. The
/// result does not depend on the number of threads. O(n log n) whatever the input; a valid atlas costs little
/// more than reading it, because overlap is decided on the border edges alone (see `is_overlap_free()`).
///
/// \param corner_uv  coordinates per corner of the input (`surface.corner` tells which a triangle has), in
/// pages
///                   of size 1 x 1; NaN where there are none
/// \param face_page  page per face of the input; empty: all on one page
///
/// \throws Invalid_argument unless `corner_uv` has an entry for each corner, and `face_page` is empty or has
/// one for each face; and if the size of the page or the gutter cannot be
Atlas_certificate certify(const Surface& surface, std::span<const Point_2> corner_uv,
                          std::span<const Index> face_page = {}, const Certificate_options& options = {},
                          const Execution& execution = Execution());

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/validation/internal/Atlas_certificate_impl.h>
#include <Atlas/validation/internal/certify_impl.h>
#endif

#endif
