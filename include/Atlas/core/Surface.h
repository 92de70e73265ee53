// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_SURFACE_H
#define ATLAS_CORE_SURFACE_H

#include <Atlas/core/Kernel.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace Atlas {

/// What the user asks of an edge.
enum class Edge_constraint : std::uint8_t {
  none,
  seam,   ///< must be a seam
  no_seam ///< must not be a seam (wishes yield to topology: a closed surface needs a cut somewhere)
};

/// Why a face takes no part.
enum class Rejection {
  too_few_corners, ///< fewer than three distinct consecutive vertices
  bad_index,       ///< a corner names a vertex that does not exist
  not_finite       ///< a coordinate is NaN or infinite
};

/// A sentence for the user.
inline const char* message(Rejection reason)
{
  switch (reason) {
  case Rejection::too_few_corners:
    return "fewer than three distinct corners";
  case Rejection::bad_index:
    return "a corner names a vertex that does not exist";
  case Rejection::not_finite:
    return "a coordinate is not finite";
  }
  return "unknown reason";
}

/// \brief The whole input below the border of the package: triangles in flat arrays, with adjacency.
///
/// Polygons are triangulated; `face` tells the polygon of each triangle and `corner` the polygon corner of
/// each triangle corner. Halfedges that are not shared by exactly two consistently oriented triangles have no
/// opposite, so that the adjacency is always that of an oriented 2-manifold with boundary, whatever the input
/// was. Coordinates of corners on either side of a seam differ; inside a face they must not, hence
/// `is_diagonal()`.
struct Surface
{
  std::vector<Point_3> points;                 ///< positions of the vertices, unit of the model
  std::vector<std::array<Index, 3>> triangles; ///< their vertices, counterclockwise seen from outside
  std::vector<Index> opposite; ///< per halfedge: the halfedge on the other side, or `no_index`
  std::vector<Index> face;     ///< per triangle: the input face
  std::vector<Index> corner;   ///< per triangle corner: the input corner (faces in order, corners in order)
  std::size_t number_of_faces = 0;   ///< of the input
  std::size_t number_of_corners = 0; ///< of the input

  std::vector<Edge_constraint> constraint; ///< per halfedge, the same on both sides; empty: none
  std::vector<double> seam_cost; ///< per halfedge, the same on both sides: what a seam costs here per length,
                                 ///< positive, 1 is usual; empty: 1 everywhere
  std::vector<Index> patch;      ///< per triangle: patches that no chart may cross; empty: one patch
  std::vector<double> density_weight; ///< per triangle, positive: a chart gets the density of all times the
                                      ///< mean of its triangles' weights, by area; empty: 1 everywhere

  /// A face that cannot have coordinates of its own.
  struct Rejected_face
  {
    Index face;       ///< of the input
    Rejection reason; ///< why it cannot
  };
  std::vector<Rejected_face> rejected; ///< faces without a single triangle here, in order

  /// How many triangles there are.
  std::size_t number_of_triangles() const { return triangles.size(); }
  /// Where a halfedge starts.
  const Point_3& point(Index halfedge) const { return points[triangles[halfedge / 3][halfedge % 3]]; }

  /// Whether the halfedge is inside an input polygon; such an edge can never be a seam. Where a polygon
  /// touches itself along an edge of its own (the bridge to a hole), the corners on either side differ, and
  /// it can.
  bool is_diagonal(Index h) const
  {
    const Index o = opposite[h];
    return o != no_index && face[h / 3] == face[o / 3] && corner[h] == corner[next_halfedge(o)] &&
           corner[o] == corner[next_halfedge(h)];
  }
};

/// \brief Which triangles belong together, and where charts are cut open.
struct Segmentation
{
  std::vector<Index> chart;      ///< per triangle of the surface: its chart, in [0, number_of_charts)
  std::vector<std::uint8_t> cut; ///< per halfedge, the same on both sides: whether the edge is a cut. Edges
                                 ///< between different charts are seams with or without it.
  Index number_of_charts = 0;    ///< numbers of charts are below it

  /// Whether triangles are glued along the halfedge.
  bool is_glued(const Surface& surface, Index h) const
  {
    const Index o = surface.opposite[h];
    return o != no_index && !cut[h] && chart[h / 3] == chart[o / 3];
  }
};

} // namespace Atlas

#endif
