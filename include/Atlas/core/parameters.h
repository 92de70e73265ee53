// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_PARAMETERS_H
#define ATLAS_CORE_PARAMETERS_H

#include <Atlas/core/internal/parameter_tags.h>

#include <CGAL/Named_function_parameters.h>

namespace Atlas {

/// \brief A pack of named parameters: CGAL's, with Atlas's names added.
///
/// Packs are chained with dots, in any order: `parameters::texture_size(1024).vertex_point_map(m).gutter(2)`.
/// Those of CGAL's names that Atlas knows are among them; a pack that begins in `CGAL::parameters` has only
/// CGAL's.
template <typename T, typename Tag, typename Base = CGAL::internal_np::No_property>
struct Named_parameters : CGAL::Named_function_parameters<T, Tag, Base>
{
  using Pack = CGAL::Named_function_parameters<T, Tag, Base>; ///< CGAL's pack
  using Pack::Pack;

  /// Side of the square page in texels; default `default_texture_size`.
  template <typename K>
  auto texture_size(const K& k) const
  {
    return with<internal::texture_size_t>(k);
  }
  /// Least distance between charts in texels; default `default_gutter`.
  template <typename K>
  auto gutter(const K& k) const
  {
    return with<internal::gutter_t>(k);
  }
  /// All of `Page_options` at once; `texture_size` and `gutter` prevail over it.
  template <typename K>
  auto page_options(const K& k) const
  {
    return with<internal::page_options_t>(k);
  }
  /// What matters most: an `Atlas_mode`; default `Atlas_mode::standard`. Policies that are given prevail.
  template <typename K>
  auto mode(const K& k) const
  {
    return with<internal::mode_t>(k);
  }
  /// When charts merge in the default segmentation: `Merge_options`; default: those of the mode.
  template <typename K>
  auto merge_options(const K& k) const
  {
    return with<internal::merge_options_t>(k);
  }
  /// Merging goes on past the bound on distortion until there are at most so many charts, as far as discs,
  /// patches and seams allow; default 0: no such wish.
  template <typename K>
  auto max_charts(const K& k) const
  {
    return with<internal::max_charts_t>(k);
  }
  /// Charts of fewer texels, about, join a neighbour even past the bound; default 0: no such wish.
  template <typename K>
  auto min_chart_texels(const K& k) const
  {
    return with<internal::min_chart_texels_t>(k);
  }
  /// Charts are cut until they cover this share of the pages, in [0, 1), at the least added seam that is
  /// found; where no cut helps any longer, the report says so. Goes before `max_charts`. Not together with a
  /// density. Default 0: no such wish.
  template <typename K>
  auto min_coverage(const K& k) const
  {
    return with<internal::min_coverage_t>(k);
  }
  /// Charts are cut where the density of texels rises by at least so many per cent for each per cent of added
  /// seam, 0: never. `min_coverage` goes before. Default: that of the mode, see `seam_exchange_rate()` of
  /// `presets.h`, where pages are less than 75 % full, with seams at most 6 % longer, or at twice that rate;
  /// and with seams within the surface at most 35 % longer where that fills pages to 65 %. Never where
  /// policies are given one by one, or with `max_charts`, `min_chart_texels`, `symmetry`, a density, or
  /// options of pages per chart.
  template <typename K>
  auto seam_exchange_rate(const K& k) const
  {
    return with<internal::seam_exchange_rate_t>(k);
  }
  /// Charts of fewer texels are enlarged until they have so many; default 0: no such wish.
  template <typename K>
  auto min_texels_per_chart(const K& k) const
  {
    return with<internal::min_texels_per_chart_t>(k);
  }
  /// Edges at which normals turn by more than so many degrees, in (0, 180], become seams; default: none.
  template <typename K>
  auto hard_angle(const K& k) const
  {
    return with<internal::hard_angle_t>(k);
  }
  /// Whether parts of the surface that are regular grids of quadrilaterals (a tube, a road, a rope) become
  /// rectangles, rows and columns on straight lines, where that keeps the bound on distortion; default:
  /// false.
  template <typename K>
  auto straighten(const K& k) const
  {
    return with<internal::straighten_t>(k);
  }
  /// Whether charts are mirrored where the surface is, in the default segmentation: a `Symmetry`; default
  /// `Symmetry::off`.
  template <typename K>
  auto symmetry(const K& k) const
  {
    return with<internal::symmetry_t>(k);
  }
  /// Whether charts are what the constrained edges (and hard angles) make of patches, or of the whole
  /// surface: nothing merges, and no bound on distortion cuts. Only what is no disc, or covers itself in the
  /// plane, is cut further; `Atlas_report::added_seams` tells. Default: false.
  template <typename K>
  auto only_given_seams(const K& k) const
  {
    return with<internal::only_given_seams_t>(k);
  }
  /// The faces that are unwrapped: a readable map of Booleans from faces (of flat arrays from their numbers).
  /// All others keep, to the bit, the coordinates that they have, in [0, 1]^2 of the first page or of that
  /// which `face_page_map` has, and new charts are packed around them. Default: all faces.
  template <typename K>
  auto face_selection_map(const K& k) const
  {
    return with<internal::face_selection_map_t>(k);
  }
  /// The corners that keep, to the bit, the coordinates that they have, in [0, 1]^2 of the first page: a
  /// readable map of Booleans from halfedges (the corner at the target), or from vertices (all of their
  /// corners); of flat arrays from numbers of corners. A chart with one such place is moved there, in a
  /// quarter turn that lies on the page. One with several is a least squares conformal map that has them, and
  /// the others are packed around.
  /// Where a chart would not be valid, its pins move, and `Atlas_report::moved_pins` tells why. Default:
  /// none.
  template <typename K>
  auto pinned_map(const K& k) const
  {
    return with<internal::pinned_map_t>(k);
  }
  /// What seams cost per length: a readable map of positive numbers from edges or from vertices (an edge then
  /// costs the mean of its ends); 1 is usual. Seams keep away from what is dear: what is seen, or painted.
  template <typename K>
  auto seam_cost_map(const K& k) const
  {
    return with<internal::seam_cost_map_t>(k);
  }
  /// Makes seams cheap where they are hardly seen, besides what the map of costs says: a `Seam_hiding`.
  template <typename K>
  auto hide_seams(const K& k) const
  {
    return with<internal::hide_seams_t>(k);
  }
  /// A readable map of Booleans from edges: those that must not be seams, as far as topology allows.
  template <typename K>
  auto forbidden_seam_map(const K& k) const
  {
    return with<internal::forbidden_seam_map_t>(k);
  }
  /// How much more texels a face gets than others: a readable map of positive numbers from faces; 1 is usual.
  /// A chart's density is that of the atlas times the mean of its faces' weights, by area in space, but no
  /// chart becomes smaller than about a texel. To have the weights of every face to the letter, give
  /// `face_patch_map` too, so that no chart has faces of different weights.
  template <typename K>
  auto face_weight_map(const K& k) const
  {
    return with<internal::face_weight_map_t>(k);
  }
  /// All policies at once, as `Policies`: those of `preset()`, some of them exchanged. Policies that are
  /// given by their own names prevail.
  template <typename K>
  auto policies(const K& k) const
  {
    return with<internal::policies_t>(k);
  }
  /// A model of `ChartSegmentation`.
  template <typename K>
  auto segmentation(const K& k) const
  {
    return with<internal::segmentation_t>(k);
  }
  /// A model of `ChartParameterizer`.
  template <typename K>
  auto parameterizer(const K& k) const
  {
    return with<internal::parameterizer_t>(k);
  }
  /// A model of `UVOptimizer`.
  template <typename K>
  auto optimizer(const K& k) const
  {
    return with<internal::optimizer_t>(k);
  }
  /// A model of `ChartValidator`.
  template <typename K>
  auto validator(const K& k) const
  {
    return with<internal::validator_t>(k);
  }
  /// A model of `ChartSplitter`; default: the validator, if one is given that can split, else
  /// `Culprit_splitter`.
  template <typename K>
  auto splitter(const K& k) const
  {
    return with<internal::splitter_t>(k);
  }
  /// A model of `ChartPacker`.
  template <typename K>
  auto packer(const K& k) const
  {
    return with<internal::packer_t>(k);
  }
  /// Number of threads; default 0, all cores. The result does not depend on it.
  template <typename K>
  auto number_of_threads(const K& k) const
  {
    return with<internal::number_of_threads_t>(k);
  }
  /// A callable `bool(Stage, double fraction)`; called from one thread at a time; returning `false` cancels.
  template <typename K>
  auto progress(const K& k) const
  {
    return with<internal::progress_t>(k);
  }
  /// Output: a writable face map of integers, the chart of each face, in [0, number of charts); -1 for
  /// rejected faces.
  template <typename K>
  auto face_chart_map(const K& k) const
  {
    return with<internal::face_chart_map_t>(k);
  }
  /// Output: a writable face map of integers, the page of each face. With `face_selection_map` a readable map
  /// is also asked for the pages of the faces that stay.
  template <typename K>
  auto face_page_map(const K& k) const
  {
    return with<internal::face_page_map_t>(k);
  }
  /// Output: a writable edge map of Booleans, whether the edge is a seam.
  template <typename K>
  auto edge_seam_map(const K& k) const
  {
    return with<internal::edge_seam_map_t>(k);
  }

  /// CGAL's: positions, a readable map from vertices to points.
  template <typename K>
  auto vertex_point_map(const K& k) const
  {
    return with<CGAL::internal_np::vertex_point_t>(k);
  }
  /// CGAL's: numbers, a readable map from vertices.
  template <typename K>
  auto vertex_index_map(const K& k) const
  {
    return with<CGAL::internal_np::vertex_index_t>(k);
  }
  /// CGAL's: edges that must be seams, a readable map of Booleans.
  template <typename K>
  auto edge_is_constrained_map(const K& k) const
  {
    return with<CGAL::internal_np::edge_is_constrained_t>(k);
  }
  /// CGAL's: patches that no chart crosses, a readable map from faces.
  template <typename K>
  auto face_patch_map(const K& k) const
  {
    return with<CGAL::internal_np::face_patch_t>(k);
  }

private:
  template <typename New_tag, typename K>
  Named_parameters<K, New_tag, Pack> with(const K& k) const
  {
    return Named_parameters<K, New_tag, Pack>(k, *this);
  }
};

/// \brief The names of Atlas as functions that start a pack. See `Named_parameters` for each of them.
namespace parameters {

// clang-format off
/// See `Named_parameters::texture_size()`.
template <typename K> auto texture_size(const K& k) { return Named_parameters<K, internal::texture_size_t>(k); }
/// See `Named_parameters::gutter()`.
template <typename K> auto gutter(const K& k) { return Named_parameters<K, internal::gutter_t>(k); }
/// See `Named_parameters::page_options()`.
template <typename K> auto page_options(const K& k) { return Named_parameters<K, internal::page_options_t>(k); }
/// See `Named_parameters::mode()`.
template <typename K> auto mode(const K& k) { return Named_parameters<K, internal::mode_t>(k); }
/// See `Named_parameters::merge_options()`.
template <typename K> auto merge_options(const K& k) { return Named_parameters<K, internal::merge_options_t>(k); }
/// See `Named_parameters::max_charts()`.
template <typename K> auto max_charts(const K& k) { return Named_parameters<K, internal::max_charts_t>(k); }
/// See `Named_parameters::min_chart_texels()`.
template <typename K> auto min_chart_texels(const K& k) { return Named_parameters<K, internal::min_chart_texels_t>(k); }
/// See `Named_parameters::min_coverage()`.
template <typename K> auto min_coverage(const K& k) { return Named_parameters<K, internal::min_coverage_t>(k); }
/// See `Named_parameters::seam_exchange_rate()`.
template <typename K> auto seam_exchange_rate(const K& k) { return Named_parameters<K, internal::seam_exchange_rate_t>(k); }
/// See `Named_parameters::min_texels_per_chart()`.
template <typename K> auto min_texels_per_chart(const K& k) { return Named_parameters<K, internal::min_texels_per_chart_t>(k); }
/// See `Named_parameters::hard_angle()`.
template <typename K> auto hard_angle(const K& k) { return Named_parameters<K, internal::hard_angle_t>(k); }
/// See `Named_parameters::straighten()`.
template <typename K> auto straighten(const K& k) { return Named_parameters<K, internal::straighten_t>(k); }
/// See `Named_parameters::symmetry()`.
template <typename K> auto symmetry(const K& k) { return Named_parameters<K, internal::symmetry_t>(k); }
/// See `Named_parameters::seam_cost_map()`.
template <typename K> auto seam_cost_map(const K& k) { return Named_parameters<K, internal::seam_cost_map_t>(k); }
/// See `Named_parameters::only_given_seams()`.
template <typename K> auto only_given_seams(const K& k) { return Named_parameters<K, internal::only_given_seams_t>(k); }
/// See `Named_parameters::face_selection_map()`.
template <typename K> auto face_selection_map(const K& k) { return Named_parameters<K, internal::face_selection_map_t>(k); }
/// See `Named_parameters::pinned_map()`.
template <typename K> auto pinned_map(const K& k) { return Named_parameters<K, internal::pinned_map_t>(k); }
/// See `Named_parameters::hide_seams()`.
template <typename K> auto hide_seams(const K& k) { return Named_parameters<K, internal::hide_seams_t>(k); }
/// See `Named_parameters::forbidden_seam_map()`.
template <typename K> auto forbidden_seam_map(const K& k) { return Named_parameters<K, internal::forbidden_seam_map_t>(k); }
/// See `Named_parameters::face_weight_map()`.
template <typename K> auto face_weight_map(const K& k) { return Named_parameters<K, internal::face_weight_map_t>(k); }
/// See `Named_parameters::policies()`.
template <typename K> auto policies(const K& k) { return Named_parameters<K, internal::policies_t>(k); }
/// See `Named_parameters::segmentation()`.
template <typename K> auto segmentation(const K& k) { return Named_parameters<K, internal::segmentation_t>(k); }
/// See `Named_parameters::parameterizer()`.
template <typename K> auto parameterizer(const K& k) { return Named_parameters<K, internal::parameterizer_t>(k); }
/// See `Named_parameters::optimizer()`.
template <typename K> auto optimizer(const K& k) { return Named_parameters<K, internal::optimizer_t>(k); }
/// See `Named_parameters::validator()`.
template <typename K> auto validator(const K& k) { return Named_parameters<K, internal::validator_t>(k); }
/// See `Named_parameters::splitter()`.
template <typename K> auto splitter(const K& k) { return Named_parameters<K, internal::splitter_t>(k); }
/// See `Named_parameters::packer()`.
template <typename K> auto packer(const K& k) { return Named_parameters<K, internal::packer_t>(k); }
/// See `Named_parameters::number_of_threads()`.
template <typename K> auto number_of_threads(const K& k) { return Named_parameters<K, internal::number_of_threads_t>(k); }
/// See `Named_parameters::progress()`.
template <typename K> auto progress(const K& k) { return Named_parameters<K, internal::progress_t>(k); }
/// See `Named_parameters::face_chart_map()`.
template <typename K> auto face_chart_map(const K& k) { return Named_parameters<K, internal::face_chart_map_t>(k); }
/// See `Named_parameters::face_page_map()`.
template <typename K> auto face_page_map(const K& k) { return Named_parameters<K, internal::face_page_map_t>(k); }
/// See `Named_parameters::edge_seam_map()`.
template <typename K> auto edge_seam_map(const K& k) { return Named_parameters<K, internal::edge_seam_map_t>(k); }
/// See `Named_parameters::vertex_point_map()`.
template <typename K> auto vertex_point_map(const K& k) { return Named_parameters<K, CGAL::internal_np::vertex_point_t>(k); }
/// See `Named_parameters::vertex_index_map()`.
template <typename K> auto vertex_index_map(const K& k) { return Named_parameters<K, CGAL::internal_np::vertex_index_t>(k); }
/// See `Named_parameters::edge_is_constrained_map()`.
template <typename K> auto edge_is_constrained_map(const K& k) { return Named_parameters<K, CGAL::internal_np::edge_is_constrained_t>(k); }
/// See `Named_parameters::face_patch_map()`.
template <typename K> auto face_patch_map(const K& k) { return Named_parameters<K, CGAL::internal_np::face_patch_t>(k); }
// clang-format on

/// A pack in which everything has its default.
inline auto default_values()
{
  return CGAL::parameters::default_values();
}

} // namespace parameters

} // namespace Atlas

#endif
