// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_PAGE_CUTTER_H
#define ATLAS_PIPELINE_INTERNAL_PAGE_CUTTER_H

#include <Atlas/core/internal/Flattened_chart.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/pipeline/Atlas_report.h>
#include <Atlas/pipeline/internal/Coverage_search.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Whether pages are as full as asked for, and why not.
inline Coverage_outcome coverage_outcome(double coverage, double wanted, bool are_cuts_exhausted)
{
  if (!(wanted > 0))
    return Coverage_outcome::not_asked_for;
  if (coverage >= wanted)
    return Coverage_outcome::kept;
  return are_cuts_exhausted ? Coverage_outcome::no_cut_helps : Coverage_outcome::given_up;
}

/// \brief Cuts charts until the pages are as full as asked for, or where that is worth its seam.
class Page_cutter
{
public:
  /// What is taken for full pages where no coverage is asked for: less would make pages too large to be of
  /// use for what is too long for them.
  static constexpr double usual_coverage = 0.7;
  /// Pages that are emptier are filled if that is worth anything.
  static constexpr double poor_coverage = 0.6;
  /// Rounding takes that much of the coverage at most.
  static constexpr double coverage_lost = 2e-4;

  /// \param surface       of the charts. All must outlive this object
  /// \param min_coverage  that is asked for; 0: none, then charts are cut as `trade` says
  /// \param bound         that pieces keep where nothing is asked for
  Page_cutter(const Surface& surface, const Chart_packing& packing, const Page_options& page,
              double min_coverage, const Cut_trade& trade, const Distortion_bound& bound,
              const Execution& execution)
      : surface_(surface), packing_(packing), page_(page), min_coverage_(min_coverage), trade_(trade),
        bound_(bound), execution_(execution)
  {}

  /// \param packed  the charts as they are
  /// \return none if they stay as they are
  std::optional<Cut_charts> operator()(const Segmentation& segmentation,
                                       const std::vector<Flattened_chart>& charts,
                                       const Packed_charts& packed)
  {
    if (page_.density > 0)
      return fit(segmentation, charts, packed.packing);
    const double coverage = packed.coverage, wanted = min_coverage_ + coverage_lost;
    const bool is_asked = min_coverage_ > 0;
    const bool is_full = coverage >= (is_asked ? wanted : trade_.full_coverage);
    if (packed.packing.number_of_pages == 0 || is_full || !(is_asked || trade_.rate > 0))
      return std::nullopt;
    if (!is_asked)
      return is_worth_a_trial(packed) ? trade(segmentation, charts, coverage) : std::nullopt;
    const double seam = half_of_borders(charts);
    Coverage_search search = search_in(Cut_forest(surface_, segmentation, charts, room_on_pages(wanted),
                                                  execution_, std::nullopt, seam, {}));
    std::optional<Cut_charts> cut = search.reach(coverage, wanted, {});
    is_exhausted_ = search.is_exhausted();
    return cut;
  }

  /// Whether the last search ended as there was nothing more to cut.
  bool is_exhausted() const { return is_exhausted_; }

private:
  /// What of a search for an asked coverage is done where none is asked for.
  static constexpr int packings_of_trade = 6, retractions_of_trade = 3;
  static constexpr std::size_t most_charts_of_trade = 256;
  /// What the density may lose by rounding.
  static constexpr double density_lost = 1e-9;

  /// Packing hundreds of charts takes long, and few cuts change little, unless a single chart is too large
  /// for the page.
  bool is_worth_a_trial(const Packed_charts& packed) const
  {
    return packed.charts.size() <= most_charts_of_trade ||
           packing_.most_coverage(packed, page_) < trade_.full_coverage;
  }

  Coverage_search search_in(Cut_forest forest) const
  {
    const auto pack = [this](const Segmentation& s, const std::vector<Flattened_chart>& flattened,
                             double least_coverage) {
      Packed_charts result = packing_.charts(s, flattened);
      result.coverage = packing_.most_coverage(result, page_);
      if (result.coverage >= least_coverage)
        packing_.pack(result, page_);
      return result;
    };
    return {std::move(forest), pack};
  }

  /// Makes the cuts that are worth it: first those within the budget of added seam. Where pages are rather
  /// empty then, others may be worth more.
  std::optional<Cut_charts> trade(const Segmentation& segmentation,
                                  const std::vector<Flattened_chart>& charts, double coverage) const
  {
    const double seam = half_of_borders(charts);
    const Room_estimate room = room_on_pages(std::max(coverage, usual_coverage));
    std::optional<Cut_charts> best =
        search_in(Cut_forest(surface_, segmentation, charts, room, execution_, trade_, seam, bound_))
            .trade(coverage, seam, trade_.rate);
    const double reached = best ? best->packed.coverage : coverage;
    if (reached >= trade_.empty_coverage)
      return best;
    std::optional<Cut_charts> full = fill(segmentation, charts, coverage);
    const double worth_before = best && reached >= poor_coverage ? worth(*best, coverage, seam) : 0;
    return full && worth(*full, coverage, seam) > worth_before ? std::move(full) : std::move(best);
  }

  /// By how much more the density rises than the added seam has to bring, relative.
  double worth(const Cut_charts& cut, double coverage, double seam) const
  {
    return std::sqrt(cut.packed.coverage / coverage) - 1 -
           trade_.rate * (half_of_borders(cut.flattened) / seam - 1);
  }

  /// Cuts charts until pages are as full as usual; none if they stay rather empty, or that takes too much
  /// seam. Few charts leave room that no estimate foresees, so they are packed again and again.
  std::optional<Cut_charts> fill(const Segmentation& segmentation, const std::vector<Flattened_chart>& charts,
                                 double coverage) const
  {
    const double seam = half_of_borders(charts);
    const double most_added = trade_.most_added_when_empty * (seam - half_of_surface_borders());
    Coverage_search search =
        search_in(Cut_forest(surface_, segmentation, charts, room_on_pages(trade_.full_coverage), execution_,
                             std::nullopt, seam, bound_));
    std::optional<Cut_charts> cut =
        search.reach(coverage, usual_coverage,
                     {packings_of_trade, retractions_of_trade, most_added, trade_.empty_coverage});
    const bool is_enough = cut && half_of_borders(cut->flattened) - seam <= most_added;
    return is_enough ? std::move(cut) : std::nullopt;
  }

  /// Cuts charts that are larger than a page at the density that is asked for.
  std::optional<Cut_charts> fit(const Segmentation& segmentation, const std::vector<Flattened_chart>& charts,
                                const Packing& packing) const
  {
    const double least = page_.density * (1 - density_lost), gutter = page_.effective_gutter();
    if (!trade_.is_for_density || (packing.number_of_pages > 0 && packing.density >= least))
      return std::nullopt;
    const Room_estimate room{(std::min(page_.width, page_.height) - gutter) / page_.density,
                             gutter / page_.density};
    return search_in(Cut_forest(surface_, segmentation, charts, room, execution_, std::nullopt, 0, {}))
        .fit(least);
  }

  /// The length of all seams in space. Borders of the surface count half: a strip has no other seams.
  static double half_of_borders(const std::vector<Flattened_chart>& charts)
  {
    double length = 0;
    for (const Flattened_chart& f : charts) {
      const std::vector<Index> opposite = opposite_halfedges(f.chart.triangles);
      for (Index h = 0; h < opposite.size(); ++h)
        if (opposite[h] == no_index)
          length += std::sqrt(CGAL::squared_distance(f.chart.points[f.chart.triangles[h / 3][h % 3]],
                                                     f.chart.points[f.chart.triangles[h / 3][(h + 1) % 3]]));
    }
    return length / 2;
  }

  double half_of_surface_borders() const
  {
    double length = 0;
    for (Index h = 0; h < surface_.opposite.size(); ++h)
      if (surface_.opposite[h] == no_index)
        length += edge_length(surface_, h);
    return length / 2;
  }

  Room_estimate room_on_pages(double coverage) const
  {
    const double area = double(page_.width) * page_.height;
    const double texel = std::sqrt(area_3d(surface_) / (area * page_.pages * coverage));
    return {texel * std::sqrt(area), texel * page_.effective_gutter()};
  }

  const Surface& surface_;
  const Chart_packing& packing_;
  const Page_options& page_;
  double min_coverage_;
  const Cut_trade& trade_;
  const Distortion_bound& bound_;
  const Execution& execution_;
  bool is_exhausted_ = false;
};

} // namespace Atlas::internal

#endif
