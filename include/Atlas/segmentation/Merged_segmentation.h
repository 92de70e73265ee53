// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_MERGED_SEGMENTATION_H
#define ATLAS_SEGMENTATION_MERGED_SEGMENTATION_H

#include <Atlas/core/Any_policies.h>
#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/segmentation/merge_charts.h>

namespace Atlas {

/// \brief Few charts under a bound: many charts of another model, merged while the bound allows it.
///
/// The charts are discs. Edges that must not be seams (`Edge_constraint::no_seam`) are none wherever discs
/// can be had otherwise, and seams keep off edges where they cost much (`Surface::seam_cost`). Borders are
/// smoothed before charts merge and afterwards; what was refused on the coarse surface is tried once more on
/// finer copies. A model of `BoundedSegmentation`. See `merge_charts()`.
class Merged_segmentation
{
public:
  /// \param base           makes the charts to begin with: more than needed, of simple shape
  /// \param parameterizer  flattens unions for trial
  /// \param optimizer      lowers their distortion
  /// \throws Invalid_argument if an option is out of its range
  Merged_segmentation(Any_segmentation base, Any_parameterizer parameterizer, Any_optimizer optimizer,
                      const Merge_options& options = {});

  /// Who makes the charts to begin with.
  const Any_segmentation& base() const { return base_; }
  /// Who flattens unions for trial.
  const Any_parameterizer& parameterizer() const { return parameterizer_; }
  /// Who lowers their distortion.
  const Any_optimizer& optimizer() const { return optimizer_; }
  /// When charts merge.
  const Merge_options& options() const { return options_; }
  /// Of the charts that come from merging. Splits that a flattening needs later only lower the distortion.
  Distortion_bound bound() const { return internal::bound_of(options_); }

  /// Once cancelled, returns the charts of that moment.
  Segmentation segment(const Surface& surface, const Execution& execution) const;

private:
  Any_segmentation base_;
  Any_parameterizer parameterizer_;
  Any_optimizer optimizer_;
  Merge_options options_;
};

/// \brief Whether the charts of a surface that is its own mirror image are mirrored too.
enum class Symmetry {
  off,
  automatic, ///< at the best plane there is: across an axis of the model, or in any direction
  x,         ///< at a plane across this axis
  y,
  z
};

/// \brief Charts that are mirrored where the surface is: the charts of one half, and their mirror images.
///
/// A plane is sought at which the surface is its own mirror image, within 0.5 % of the diagonal of the
/// bounding box; its mesh may be another one. The triangles on one side of it are segmented alone. The
/// charts of the other side are their images, triangle by triangle where the mesh is symmetric, else as near
/// as its edges allow. Charts that reach the plane go on beyond it: they are flattened for trial together
/// with their image. The seam is on the plane only where such a chart has more than one piece of the plane,
/// or would not keep the bound.
///
/// Where there is no such plane, all is as it was without. Deterministic. A model of `BoundedSegmentation`.
/// O(n log n), and the work of `Merged_segmentation` on half the surface.
class Mirrored_segmentation
{
public:
  /// \param merged    segments halves, and surfaces without symmetry
  /// \param symmetry  which planes come into question
  explicit Mirrored_segmentation(Merged_segmentation merged, Symmetry symmetry = Symmetry::automatic);

  /// Who segments halves.
  const Merged_segmentation& merged() const { return merged_; }
  /// Which planes come into question.
  Symmetry symmetry() const { return symmetry_; }
  /// That of the merged charts.
  Distortion_bound bound() const { return merged_.bound(); }

  /// Once cancelled, returns the charts of that moment.
  Segmentation segment(const Surface& surface, const Execution& execution) const;

private:
  Merged_segmentation merged_, half_;
  Symmetry symmetry_;
};

/// \brief A chart for each part of the surface that is a regular grid of quadrilaterals, tubes opened along
/// one line of edges; the rest by another model.
///
/// A part is all that hangs together of quadrilaterals. It has to be rows and columns without a gap, four
/// faces around each inner vertex, and to keep a bound on the distortion as a rectangle with its rows and
/// columns on straight lines (`Straight_parameterizer`). Patches, wanted and forbidden seams are respected; a
/// grid of fewer than 16 faces is no chart of its own if it is part of something larger. A model of
/// `BoundedSegmentation`. O(n) and the other model.
class Straight_segmentation
{
public:
  /// \param rest   segments what is no such grid
  /// \param bound  that a grid keeps when it is straight
  Straight_segmentation(Any_segmentation rest, const Distortion_bound& bound);

  /// Who segments the rest.
  const Any_segmentation& rest() const { return rest_; }
  /// What grids keep.
  Distortion_bound bound() const { return bound_; }

  /// Once cancelled, returns the charts of that moment.
  Segmentation segment(const Surface& surface, const Execution& execution) const;

private:
  Any_segmentation rest_;
  Distortion_bound bound_;
};

/// \brief Nets where the surface is made of plane and unrollable pieces; the rest by another model.
///
/// Facets, which are triangles in one plane, are glued to nets like those of paper models: first along
/// rulings, across which the surface bends smoothly, so that cylinders and cones unroll; then along creases,
/// as long as the seam saved is worth the page that the larger net leaves empty. Nothing in a net is
/// stretched, and no net covers itself or nearly touches itself. A facet with holes stays whole, so charts
/// may have several border loops.
///
/// What counts as hard is told by the surface alone: components of which a good part lies in facets of
/// several triangles that are large or have creases all around. Curved surfaces have none, and are left to
/// the other model altogether. Deterministic. A model of `BoundedSegmentation`. O(n log n) for n triangles,
/// and about O(k^2) for nets of k facets.
class Developable_segmentation
{
public:
  /// \param rest    segments what is not hard
  /// \param packer  tells which nets fill a page well, of several that have about the same seams
  /// \param max_charts  where there would be more charts, the other model segments the whole surface; 0:
  /// never
  Developable_segmentation(Any_segmentation rest, Any_packer packer, std::size_t max_charts = 0);

  /// Who segments the rest.
  const Any_segmentation& rest() const { return rest_; }
  /// That of the other model.
  Distortion_bound bound() const { return rest_.bound().value_or(Distortion_bound()); }

  /// Once cancelled, returns the charts of that moment.
  Segmentation segment(const Surface& surface, const Execution& execution) const;

private:
  Any_segmentation rest_;
  Any_packer packer_;
  std::size_t max_charts_;
};

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/segmentation/internal/developable/Developable_segmentation_impl.h>
#include <Atlas/segmentation/internal/merging/Merged_segmentation_impl.h>
#include <Atlas/segmentation/internal/mirror/Mirrored_segmentation_impl.h>
#include <Atlas/segmentation/internal/straight/Straight_segmentation_impl.h>
#endif

#endif
