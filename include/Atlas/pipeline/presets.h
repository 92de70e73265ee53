// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_PRESETS_H
#define ATLAS_PIPELINE_PRESETS_H

#include <Atlas/core/Any_policies.h>
#include <Atlas/core/Packing.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/segmentation/Merged_segmentation.h>
#include <Atlas/segmentation/merge_charts.h>

#include <limits>
#include <optional>

namespace Atlas {

/// \brief What matters most in an atlas.
enum class Atlas_mode {
  standard,  ///< few charts, short seams, low distortion: mean symmetric Dirichlet energy of at most 1.035
  few_seams, ///< fewer and larger charts, shorter seams; a bound of 1.05
  conformal, ///< least squares conformal maps as they are; densities in a chart within a factor of 2
  paper ///< B. Levy, S. Petitjean, N. Ray, J. Maillot, SIGGRAPH 2002, to the letter, and nothing else: for
        ///< study and comparison. See `paper_preset()`
};

/// The name of a mode, as programs write it.
inline const char* name(Atlas_mode mode)
{
  switch (mode) {
  case Atlas_mode::standard:
    return "standard";
  case Atlas_mode::few_seams:
    return "few_seams";
  case Atlas_mode::conformal:
    return "conformal";
  case Atlas_mode::paper:
    return "paper";
  }
  return "unknown";
}

/// When charts merge in a mode. In `paper` they do not; the options are the defaults.
Merge_options merge_options(Atlas_mode mode);

/// At which rate the charts of a mode are cut for fuller pages, see `seam_exchange_rate` of `parameters.h`:
/// 0.5 in `standard`, never in other modes.
double seam_exchange_rate(Atlas_mode mode);
/// By that share seams get longer at most where charts are cut without being asked to.
inline constexpr double default_added_seam = 0.06;
/// Pages of which charts cover that share are left as they are then: few charts are worth more than the rest.
inline constexpr double default_full_coverage = 0.75;
/// Pages of which charts cover less than that are rather empty.
inline constexpr double default_empty_coverage = 0.65;
/// By that share seams within the surface get longer at most where that ends that pages are rather empty.
inline constexpr double default_added_seam_of_empty_pages = 0.35;

/// Within a chart, areas in the plane over areas in space differ by at most this factor, the extreme
/// `default_density_quantile` of the area on either side left out: texel density varies at most by its square
/// root.
inline constexpr double default_density_ratio = 4;
/// The share of a chart's area that the bound on density leaves out at either end: a few triangles decide
/// nothing.
inline constexpr double default_density_quantile = 0.01;

/// \brief What is done about charts that are refused, besides splitting them. None of it is in the paper.
struct Repair_options
{
  /// Stands for a round that never comes: splitting goes on until every chart is accepted. It ends, as every
  /// split lowers the number of faces in a chart.
  static constexpr int never = std::numeric_limits<int>::max();

  /// Whether pieces of charts that were split may join neighbours, where the bound on distortion lets them.
  bool rejoin_pieces = true;
  /// From this round of splitting on charts are halved, whatever the splitter proposes: then there are at
  /// most log2(faces) rounds more. At least 0.
  int first_halving_round = 8;
  /// Splits that only serve the bound on densities stop after so many rounds; what is left keeps its status.
  /// At least 0.
  int max_bound_rounds = 12;
  /// Whether charts are optimised after they have been accepted, as the paper does, not before. An optimised
  /// chart that the validator refuses stays as it was.
  bool optimize_accepted = false;
  /// Charts are opened by short slits where more of the whole surface than the bound on stretch leaves out
  /// would be stretched farther than this, and a slit is worth its length: greater than 1; infinity: never.
  /// Before that, cuts that end inside a chart are zipped where hardly more is stretched farther without
  /// them. Only where the segmentation has such a bound, and mirrored charts do not stay mirrored.
  double wanted_stretch = std::numeric_limits<double>::infinity();
  /// Optimises a chart that was opened by a slit from the coordinates that it had before, which are near its
  /// best. None: such charts are flattened anew, which takes several times as long.
  std::optional<Any_optimizer> slit_optimizer = std::nullopt;

  /// The paper's: only splitting.
  static Repair_options paper()
  {
    return {.rejoin_pieces = false,
            .first_halving_round = never,
            .max_bound_rounds = never,
            .optimize_accepted = true};
  }
};

/// \brief The policies of a run, one for each stage.
struct Policies
{
  Any_segmentation segmentation;   ///< makes charts
  Any_parameterizer parameterizer; ///< lays them flat
  Any_optimizer optimizer;         ///< lowers their distortion
  Any_validator validator;         ///< accepts or refuses them
  Any_splitter splitter;           ///< divides what was refused
  Any_packer packer;               ///< puts charts on pages
  Repair_options repair = {};      ///< what else is done about refused charts
};

/// \brief The policies of a mode. Each may be exchanged for another.
///
/// - `segmentation`: `Variational_segmentation`, merged as `options` say (`Merged_segmentation`)
/// - `parameterizer`: `Bijective_parameterizer`: LSCM, made one-to-one where it is not; but for the conformal
/// mode, with
///   low symmetric Dirichlet energy
/// - `optimizer`: `Identity_optimizer`, as the parameterizer optimises already
/// - `validator`: `Exact_validator`, with the bound of `options` and one on densities: that of `options`, if
/// they
///   bound densities, else `default_density_ratio`. There is none where a wish for few or large charts goes
///   before.
/// - `splitter`: `Culprit_splitter`
/// - `packer`: `Raster_packer`
/// - `repair`: the usual; in the standard mode, without symmetry and with no wish for few or large charts,
///   also zips and slits (`wanted_stretch`), to 0.56 of what the bound on stretch allows beyond 1
///
/// \param options   when charts merge
/// \param symmetry  which planes are sought at which the surface is its own mirror image, so that its charts
///                  are too (`Mirrored_segmentation`)
/// \throws Invalid_argument if an option is out of its range, or the mode is `paper`, which needs a
/// validator: see `paper_preset()`
Policies preset(Atlas_mode mode, const Merge_options& options, Symmetry symmetry = Symmetry::off);

/// The policies of a mode with its own options.
inline Policies preset(Atlas_mode mode = Atlas_mode::standard)
{
  return preset(mode, merge_options(mode));
}

/// \brief The policies of the paper.
///
/// - `segmentation`: `Feature_segmentation::paper()`
/// - `parameterizer`: `LSCM_parameterizer` with `Paper_LSCM_traits`: conjugate gradients, pins at the ends of
///   the graph's diameter
/// - `optimizer`: `Identity_optimizer`; the paper's optional one is `Stretch_optimizer`
/// - `splitter`: `Culprit_splitter`; `Stencil_validator` can take its place, as it does where only the mode
/// and
///   the validator are given to `generate_atlas()`
/// - `packer`: `Horizon_packer`
/// - `repair`: `Repair_options::paper()`
///
/// \param validator  the paper's is `Stencil_validator`, of the component `Atlas::Rendering`;
///                   `Exact_validator` proves what that one samples. Both keep the paper's bound on
///                   densities.
Policies paper_preset(Any_validator validator);

/// The share of the surface's area that so many texels of a page are, about. For
/// `Merge_options::min_chart_area`.
double area_share_of_texels(double texels, const Page_options& page);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/pipeline/internal/presets_impl.h>
#endif

#endif
