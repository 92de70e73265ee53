// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_INTERNAL_ATLAS_OF_SOUP_H
#define ATLAS_SOUP_INTERNAL_ATLAS_OF_SOUP_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Packing.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/packing/Raster_packer.h>
#include <Atlas/packing/pack_charts.h>
#include <Atlas/pipeline/Atlas_report.h>
#include <Atlas/pipeline/presets.h>
#include <Atlas/soup/Polygon_soup.h>
#include <Atlas/soup/internal/Material_packer.h>
#include <Atlas/soup/internal/named_stages.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace Atlas::internal {

/// \brief What the programs and the interfaces to other languages can be asked for.
struct Soup_options
{
  Atlas_mode mode = Atlas_mode::standard;
  std::optional<Distortion_measure> measure;     ///< what `max_distortion` is about; none: the mode's
  double max_distortion = 0;                     ///< bound under which charts merge; 0: the mode's
  double max_stretch = 0, max_stretch_share = 0; ///< bounds on single triangles; 0: the mode's
  bool is_straightened = false;                  ///< grids of quadrilaterals become rectangles
  std::size_t max_charts = 0;                    ///< 0: no such wish
  double min_chart_texels = 0;                   ///< 0: no such wish
  double hard_angle = 0;                         ///< degrees; 0: none
  double min_coverage = 0;                       ///< charts are cut for pages that full; 0: no such wish
  std::optional<double> seam_exchange_rate;      ///< density that cuts have to bring; none: the mode's
  double min_texels_per_chart = 0;               ///< 0: no such wish
  Symmetry symmetry = Symmetry::off;             ///< where charts are to be mirror images of each other
  bool keeps_uv = false;                         ///< charts are those of the soup's coordinates
  bool merges_uv = false;                     ///< charts are those of the coordinates, merged within bounds
  bool has_only_given_seams = false;          ///< charts are what wanted seams, angles and materials make
  bool separates_materials = false;           ///< no chart has faces of two materials
  std::optional<std::vector<bool>> selection; ///< per face: whether it is unwrapped anew; none: all are
  std::optional<std::vector<bool>> pins; ///< per corner: whether it keeps its coordinates; none: none does
  Page_options page;
  Packing_effort effort = Packing_effort::fast; ///< of `Raster_packer`
  Stage_names stages;                           ///< stages whose models are not those of the mode
  std::optional<Policies>
      policies; ///< none: those of the mode, with the effort and the stages that are named
  std::vector<Material_rule> rules; ///< per material of the soup, or empty
  unsigned threads = 0;
};

/// When charts merge, as the options say.
Merge_options merge_options_of(const Soup_options& options);

/// \brief Makes the atlas of a soup.
/// \param surface  of the soup; gets patches and weights as the options say
/// \param uv       output, per corner. \see `generate_atlas()`
Atlas_report atlas_of_soup(const Soup_options& options, const Polygon_soup& model, Surface& surface,
                           std::vector<Point_2>& uv, const std::function<bool(Stage, double)>& progress);

/// \brief Packs the soup's coordinates anew, under the rules for its materials.
/// \param surface  of the soup; gets weights as the options say
Repacked_charts repack_soup(const Soup_options& options, const Polygon_soup& model, Surface& surface,
                            const Execution& execution);

/// The page of each face, of those without a triangle 0.
std::vector<Index> pages_of_faces(const Repacked_charts& repacked, const Surface& surface);

/// The share of the pages that repacked charts cover, in [0, 1].
double packing_efficiency(const Repacked_charts& repacked, const Page_options& page);

} // namespace Atlas::internal

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/soup/internal/atlas_of_soup_impl.h>
#endif

#endif
