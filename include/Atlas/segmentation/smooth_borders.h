// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_SMOOTH_BORDERS_H
#define ATLAS_SEGMENTATION_SMOOTH_BORDERS_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/library.h>

#include <cstddef>
#include <functional>
#include <numbers>
#include <span>

namespace Atlas {

/// \brief How borders between charts are smoothed.
struct Smoothing_options
{
  /// Borders move by at most so many rings of triangles in a round; not negative.
  int rings = 4;
  /// Every border is tried once a round; not negative.
  int rounds = 2;
  /// Angle between the normals of neighbouring triangles, in radians, from which on a seam is cheapest;
  /// positive.
  double sharp_angle = std::numbers::pi / 4;
  /// How much cheaper it is there than in flat land, in [0, 1]: 0.75 makes it cost a quarter.
  double sharp_discount = 0.75;
};

/// Decides on two charts as they would be after a border between them has moved. Both are discs, not yet
/// flattened. Called from several threads.
using Smoothing_filter = std::function<bool(const Chart&, const Chart&)>;

/// \brief Makes the seams between charts shorter and smoother.
///
/// The border between each two neighbouring charts moves to the cheapest place in a band around it, by a
/// minimum cut; seams are cheap along sharp edges, so that borders do not leave features. A change is kept if
/// both charts are discs and `keep` says yes. Cuts inside charts stay where they are. Charts keep their
/// numbers, faces stay whole, patches, wanted seams and forbidden seams are respected.
///
/// \param segmentation  of discs, as cut_to_discs() makes them. Marks of cuts between different charts are
///                      cleared, since the edges are seams anyway.
/// \param keep          which changes are kept; empty: all. A pair of charts is tried at most once a round.
/// \returns how many borders moved
/// \throws Invalid_argument if an option is out of its range, or the segmentation has other sizes than the
/// surface
///
/// Near-linear: the work of a round is bounded by a multiple of the number of triangles; where one chart has
/// very many neighbours, the shortest borders are left out. Parallel over pairs of charts.
std::size_t smooth_borders(const Surface& surface, Segmentation& segmentation,
                           const Smoothing_options& options = {}, const Execution& execution = Execution(),
                           const Smoothing_filter& keep = {});

/// \brief Who shall not see seams: viewers in all directions up to an angle from an axis.
struct Seam_hiding
{
  Vector_3 toward =
      Vector_3(0, 0, 1);  ///< the axis, from the model to the viewers; finite, of any length but 0
  double max_angle = 180; ///< degrees from the axis, in (0, 180]; 180: all around

  /// Viewers everywhere: what counts is how open a place is (ambient occlusion).
  static Seam_hiding openness() { return {}; }
  /// Viewers in the half-space beyond a plane, such as above the ground.
  static Seam_hiding dome(const Vector_3& up) { return {up, 90}; }
  /// Viewers who look at the model from about one direction.
  static Seam_hiding view(const Vector_3& toward) { return {toward, 20}; }
};

/// \brief Makes seams cheap where they are hardly seen: multiplies `Surface::seam_cost`.
///
/// A place is seen as much as the light from all viewers that reaches it is of what reaches a place that
/// faces their axis and that nothing hides. The model hides itself, as depth buffers from 64 directions tell;
/// what is smaller than two of their pixels, 1/150 of the model's size, counts as open. Faces have two sides,
/// and of each component the side counts that is seen more. O(vertices + triangles) for each direction.
/// Deterministic for any number of threads. Once cancelled, the surface stays as it is.
///
/// \throws Invalid_argument if the axis or the angle is out of its range
void hide_seams(Surface& surface, const Seam_hiding& from = {}, const Execution& execution = Execution());

/// \brief The same by a map: how much each point of the surface is seen, painted or from elsewhere.
///
/// \param visibility  per point of the surface, in [0, 1]; a seam where it is 1 costs 20 times one where it
/// is 0 \throws Invalid_argument if there is not one value per point, or one is out of its range
void hide_seams(Surface& surface, std::span<const double> visibility);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/segmentation/internal/smoothing/smooth_borders_impl.h>
#include <Atlas/segmentation/internal/visibility/hide_seams_impl.h>
#endif

#endif
