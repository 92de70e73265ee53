// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_RUN_ATLAS_H
#define ATLAS_PIPELINE_INTERNAL_RUN_ATLAS_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Packing.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/pipeline/Atlas_report.h>
#include <Atlas/pipeline/presets.h>
#include <Atlas/segmentation/smooth_borders.h>

#include <functional>
#include <optional>
#include <vector>

namespace Atlas::internal {

/// What the caller of the pipeline hears: the stage and its fraction in [0, 1]; `false` cancels.
using Progress = std::function<bool(Stage, double)>;

/// What charts do for their pages.
struct Page_wishes
{
  double min_coverage = 0; ///< charts are cut until they cover this share of the pages; 0: no such wish
  /// Cuts that raise the density by this per added seam are made, both relative; 0: none; nothing: as the
  /// mode says, where charts are the library's own.
  std::optional<double> seam_exchange_rate;
  double min_texels_per_chart = 0; ///< smaller charts are enlarged
};

/// What a run is asked for: what the named parameters say, with policies where they are given.
struct Atlas_request
{
  Page_options page;
  Atlas_mode mode = Atlas_mode::standard;
  std::optional<Merge_options> merge_options;
  std::optional<std::size_t> max_charts;
  double min_chart_texels = 0;
  Page_wishes wishes;
  Symmetry symmetry = Symmetry::off;
  double hard_angle = 0;                      ///< degrees; 0: none
  std::optional<Seam_hiding> hiding;          ///< from where seams shall not be seen
  bool is_straightened = false;               ///< whether grids of quadrilaterals become rectangles
  bool has_only_given_seams = false;          ///< whether charts are what wanted seams and patches make
  std::optional<std::vector<bool>> selection; ///< per input face whether it is unwrapped; none: all are
  std::vector<Index> face_page; ///< per input face: the page where it stays; empty: all on the first
  std::optional<std::vector<bool>>
      pins; ///< per input corner whether it keeps its coordinates; none: none does
  unsigned threads = 0;
  Progress progress;

  std::optional<Policies> policies; ///< those of the mode, if none; each of the following prevails
  std::optional<Any_segmentation> segmentation;
  std::optional<Any_parameterizer> parameterizer;
  std::optional<Any_optimizer> optimizer;
  std::optional<Any_validator> validator;
  std::optional<Any_splitter> splitter;
  std::optional<Any_packer> packer;
};

/// Makes the atlas. Everything about the request and the surface that can be wrong is checked before any
/// work.
///
/// \param corner_uv  per input corner; untouched when there is no atlas. With a selection also the
/// coordinates that other faces have, with pins those of pinned corners \throws Invalid_argument,
/// Policy_error
Atlas_report run_atlas(const Surface& surface, const Atlas_request& request, std::vector<Point_2>& corner_uv);

} // namespace Atlas::internal

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/pipeline/internal/run_atlas_impl.h>
#endif

#endif
