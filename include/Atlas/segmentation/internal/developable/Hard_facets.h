// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_HARD_FACETS_H
#define ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_HARD_FACETS_H

#include <Atlas/core/internal/Union_find.h>
#include <Atlas/segmentation/internal/developable/Facets.h>
#include <Atlas/segmentation/internal/developable/curved_regions.h>
#include <Atlas/segmentation/internal/merging/Chart_arcs.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace Atlas::internal {

/// Edges that turn by more, in degrees, are creases.
inline constexpr double crease_degrees = 31; // not 30: that of prisms of twelve sides, but for rounding
/// Across edges that turn by less, in degrees, facets with rulings are one piece: the sides of a cylinder of
/// six sides.
inline constexpr double ruling_degrees = 61;
/// The shares of a connected component from which on a triangle alone, a plane facet of several triangles,
/// and a piece that such facets make by smooth bending tell of a shape that was made to be plane.
inline constexpr double share_of_large_triangles = 0.04, share_of_large_facets = 0.005,
                        share_of_large_pieces = 0.01;
/// A component is hard if such facets have at least this share of its area.
inline constexpr double share_of_hard_components = 0.25;
/// Smooth pieces of more facets are not hard. The time for nets grows with the square of that number, and
/// flattening unrolls what is that finely tessellated just as well.
inline constexpr Index most_facets_in_piece = 10'000;

/// \brief Which facets belong to hard, developable parts of a surface, and across which of its edges these
/// bend smoothly.
///
/// On a developable surface the rulings end at its border, at a crease, at the apex of a cone, or at vertices
/// without angle defect.
/// Facets joined across edges that do are pieces: cylinders, cones and strips. Curved surfaces have neither
/// large facets of several triangles nor vertices without defect, at any resolution.
class Hard_facets
{
public:
  /// \param noise  how far points may be off their place
  Hard_facets(const Surface& surface, const Facets& facets, double noise)
      : surface_(surface), facets_(facets), pieces_(facets.count())
  {
    find_angles(noise);
    find_pieces();
    choose();
  }

  bool is_hard(Index facet) const { return is_hard_[facet] != 0; }
  /// Whether the surface bends smoothly across the halfedge, along a ruling.
  bool is_ruling(Index h) const { return is_ruling_[h] != 0; }
  /// The angle by which the surface turns there, in radians; pi at borders.
  double turn(Index h) const { return turn_[h]; }
  bool is_any_hard() const { return std::find(is_hard_.begin(), is_hard_.end(), 1) != is_hard_.end(); }

private:
  Index facet(Index h) const { return facets_.of_triangle[h / 3]; }
  const Vector_3& normal(Index h) const { return facets_.normal[facet(h)]; }

  void find_angles(double noise)
  {
    const Index n = manifold_vertices(surface_, vertex_);
    std::vector<double> sum(n, 0), bend(n, 0), squares(n, 0), length(n, 0), edges(n, 0);
    is_smooth_end_.assign(n, 0);
    is_apex_.assign(n, 0);
    turn_.assign(vertex_.size(), CGAL_PI);
    for (Index h = 0; h < vertex_.size(); ++h) {
      const Point_3& p = surface_.point(h);
      sum[vertex_[h]] +=
          angle_between(surface_.point(next_halfedge(h)) - p, surface_.point(previous_halfedge(h)) - p);
      if (const Index o = surface_.opposite[h]; o != no_index)
        turn_[h] = angle_between(normal(h), normal(o));
      for (const Index v : {vertex_[h], vertex_[next_halfedge(h)]}) {
        bend[v] = std::max(bend[v], turn_[h]);
        squares[v] += turn_[h] * turn_[h] / 2; // each edge is seen from both sides
        length[v] += edge_length(surface_, h);
        ++edges[v];
        if (turn_[h] > crease_degrees * CGAL_PI / 180)
          is_smooth_end_[v] = 1;
      }
    }
    std::vector<double> defect(n);
    std::vector<std::uint8_t> is_flat(n, 0), is_excused(n, 0);
    for (Index v = 0; v < n; ++v) {
      defect[v] = 2 * CGAL_PI - sum[v];
      const double allowed = defect_per_squared_bend * bend[v] * bend[v] * length[v],
                   found = std::abs(defect[v]) * length[v];
      is_flat[v] = found < allowed + noise * edges[v];
      is_excused[v] = is_flat[v] && !is_smooth_end_[v] && found >= allowed;
    }
    withdraw_excuses(is_excused, defect, is_flat);
    for (Index v = 0; v < n; ++v) {
      const bool is_apex = std::abs(defect[v]) > defect_of_apex * squares[v];
      if (is_flat[v] || is_apex)
        is_smooth_end_[v] = 1;
      is_apex_[v] = is_apex && !is_flat[v] && edges[v] >= 2 * least_valence_of_apex;
    }
  }

  /// Noise excuses the defect of a vertex, but not of a whole region.
  void withdraw_excuses(const std::vector<std::uint8_t>& is_excused, const std::vector<double>& defect,
                        std::vector<std::uint8_t>& is_flat) const
  {
    const std::vector<std::uint8_t> is_curved =
        Curved_regions(surface_, vertex_, defect, is_excused).vertices();
    for (Index v = 0; v < is_flat.size(); ++v)
      if (is_excused[v] && is_curved[v])
        is_flat[v] = 0;
  }

  void find_pieces()
  {
    is_ruling_.assign(vertex_.size(), 0);
    for (Index h = 0; h < vertex_.size(); ++h) {
      if (!may_cross(surface_, h) || facet(h) == facet(surface_.opposite[h]) ||
          turn_[h] > ruling_degrees * CGAL_PI / 180 || !is_smooth_end_[vertex_[h]] ||
          !is_smooth_end_[vertex_[next_halfedge(h)]])
        continue;
      is_ruling_[h] = 1;
      pieces_.unite(facet(h), facet(surface_.opposite[h]));
    }
  }

  /// Per facet the area of the triangles around the apex of the cone that it is part of; 0 if it is of none.
  std::vector<double> areas_of_cones() const
  {
    std::vector<double> fan(is_apex_.size(), 0), result(facets_.count(), 0);
    for (Index h = 0; h < vertex_.size(); ++h)
      if (is_apex_[vertex_[h]])
        fan[vertex_[h]] += triangle_area(surface_, h / 3);
    for (Index h = 0; h < vertex_.size(); ++h)
      if (is_apex_[vertex_[h]] && is_smooth_end_[vertex_[next_halfedge(h)]] &&
          is_smooth_end_[vertex_[previous_halfedge(h)]])
        result[facet(h)] = std::max(result[facet(h)], fan[vertex_[h]]);
    return result;
  }

  void choose()
  {
    const Components components = connected_components(surface_.opposite);
    const Index n = facets_.count();
    std::vector<double> whole(components.count, 0), core(components.count, 0), piece_area(n, 0);
    std::vector<Index> triangles(n, 0), component(n), facets_in_piece(n, 0);
    std::vector<std::uint8_t> is_creased(n, 1); // all around
    for (Index h = 0; h < vertex_.size(); ++h)
      if (may_cross(surface_, h) && facet(h) != facet(surface_.opposite[h]) &&
          turn_[h] <= crease_degrees * CGAL_PI / 180)
        is_creased[facet(h)] = 0;
    for (Index t = 0; t < facets_.of_triangle.size(); ++t) {
      ++triangles[facets_.of_triangle[t]];
      component[facets_.of_triangle[t]] = components.of_triangle[t];
    }
    for (Index f = 0; f < n; ++f) {
      whole[component[f]] += facets_.area[f];
      piece_area[pieces_.find(f)] += facets_.area[f];
      ++facets_in_piece[pieces_.find(f)];
    }
    const std::vector<double> cone = areas_of_cones();
    for (Index f = 0; f < n; ++f) {
      const double share = 1 / whole[component[f]], area = share * facets_.area[f],
                   piece = share * piece_area[pieces_.find(f)];
      const bool is_core = std::max(area, share * cone[f]) >= share_of_large_triangles ||
                           (triangles[f] > 1 && (is_creased[f] || area >= share_of_large_facets ||
                                                 piece >= share_of_large_pieces));
      if (is_core)
        core[component[f]] += facets_.area[f];
    }
    std::vector<std::uint8_t> is_clean(n, 1); // no corner at a vertex that is curved without a crease
    for (Index h = 0; h < vertex_.size(); ++h)
      if (!is_smooth_end_[vertex_[h]])
        is_clean[facet(h)] = 0;
    is_hard_.assign(n, 0);
    for (Index f = 0; f < n; ++f) {
      const double share = facets_.area[f] / whole[component[f]];
      if (core[component[f]] >= share_of_hard_components * whole[component[f]] &&
          facets_in_piece[pieces_.find(f)] <= most_facets_in_piece)
        is_hard_[f] = is_clean[f] || share >= share_of_large_triangles ||
                      (triangles[f] > 1 && share >= share_of_large_facets);
    }
    for (bool is_other = true; is_other;) {
      keep_faces_whole();
      is_other = leave_fringes(whole, component);
    }
  }

  /// Small pieces that go over into the curved part without a crease belong to it. Returns whether there were
  /// any.
  bool leave_fringes(const std::vector<double>& whole, const std::vector<Index>& component)
  {
    Union_find groups(facets_.count());
    for (Index h = 0; h < vertex_.size(); ++h)
      if (is_ruling_[h] && is_hard_[facet(h)] && is_hard_[facet(surface_.opposite[h])])
        groups.unite(facet(h), facet(surface_.opposite[h]));
    std::vector<double> area(facets_.count(), 0);
    for (Index f = 0; f < facets_.count(); ++f)
      area[groups.find(f)] += facets_.area[f] / whole[component[f]];
    std::vector<std::uint8_t> is_fringe(facets_.count(), 0);
    for (Index h = 0; h < vertex_.size(); ++h)
      if (may_cross(surface_, h) && turn_[h] <= crease_degrees * CGAL_PI / 180 && is_hard_[facet(h)] &&
          !is_hard_[facet(surface_.opposite[h])])
        is_fringe[groups.find(facet(h))] = 1;
    bool is_any = false;
    for (Index f = 0; f < facets_.count(); ++f)
      if (is_hard_[f] && is_fringe[groups.find(f)] && area[groups.find(f)] < share_of_large_facets) {
        is_hard_[f] = 0;
        is_any = true;
      }
    return is_any;
  }

  /// An input face that is not all hard is not hard at all.
  void keep_faces_whole()
  {
    for (bool is_other = true; is_other;) {
      is_other = false;
      for (Index h = 0; h < vertex_.size(); ++h)
        if (surface_.is_diagonal(h) && is_hard_[facet(h)] != is_hard_[facet(surface_.opposite[h])]) {
          is_hard_[facet(h)] = is_hard_[facet(surface_.opposite[h])] = 0;
          is_other = true;
        }
    }
  }

  static constexpr double defect_per_squared_bend = 0.01;
  /// An apex of a cone has a larger defect per sum of the squares of the bends around it; in the middle of
  /// smooth surfaces it is less than half.
  static constexpr double defect_of_apex = 0.6, least_valence_of_apex = 8;

  const Surface& surface_;
  const Facets& facets_;
  Union_find pieces_;
  std::vector<Index> vertex_;
  std::vector<double> turn_; ///< per halfedge
  std::vector<std::uint8_t> is_smooth_end_, is_apex_, is_ruling_, is_hard_;
};

} // namespace Atlas::internal

#endif
