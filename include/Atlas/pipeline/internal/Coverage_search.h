// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_COVERAGE_SEARCH_H
#define ATLAS_PIPELINE_INTERNAL_COVERAGE_SEARCH_H

#include <Atlas/core/internal/Flattened_chart.h>
#include <Atlas/pipeline/internal/Cut_forest.h>
#include <Atlas/pipeline/internal/Packed_charts.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Charts that are cut, on their pages.
struct Cut_charts
{
  Segmentation segmentation; ///< of the models of parts
  std::vector<Flattened_chart> flattened;
  Packed_charts packed;
};

/// \brief Looks for the fewest cuts with which pages are as full as asked for.
///
/// Cuts are made one after the other, until the estimate of the room that charts need says that it is time
/// to pack anew; what comes out corrects the estimate. Once pages are full enough, cuts are taken back: first
/// by halving the step that brought success, then one by one, the least useful first.
class Coverage_search
{
public:
  /// What a search may cost.
  struct Limits
  {
    int packings = most_packings, retractions = most_retractions; ///< on the way up, and on the way back
    double added_length = std::numeric_limits<double>::infinity();
    double least_coverage = 0; ///< less is of no use
  };
  /// Packings at most: on the way up, and on the way back.
  static constexpr int most_packings = 24, most_halvings = 3, most_retractions = 6;

  /// Packs charts. May leave that if they cannot cover as much as the last argument says: then there are no
  /// pages, and `coverage` is a bound.
  using Pack = std::function<Packed_charts(const Segmentation&, const std::vector<Flattened_chart>&, double)>;

  Coverage_search(Cut_forest forest, Pack pack) : forest_(std::move(forest)), pack_(std::move(pack)) {}

  /// \param coverage  what the charts of the forest reach as they are
  /// \param wanted    larger than that
  /// \return the charts with the least added seam that reach it, or else those that cover most; none if that
  /// is what there was
  std::optional<Cut_charts> reach(double coverage, double wanted, const Limits& limits)
  {
    double most = std::max(coverage, limits.least_coverage), room = forest_.room();
    std::size_t enough = 0, few = 0;
    for (int i = 0; i < limits.packings && most < wanted; ++i) {
      // The room that charts need times what of it is covered hardly changes by few cuts.
      const double goal = room * coverage / wanted;
      few = number_of_cuts_;
      bool is_cut = false;
      while (!is_cut || (forest_.room() > goal && number_of_cuts_ < few + 1 + few / 2)) {
        if (!forest_.cut())
          break;
        is_cut = true;
        ++number_of_cuts_;
      }
      if (!is_cut) {
        is_exhausted_ = true;
        break;
      }
      if (forest_.added_length() > limits.added_length)
        break;
      room = forest_.room();
      coverage = try_now(most, wanted);
      enough = number_of_cuts_;
    }
    if (most >= wanted)
      take_back(few, enough, wanted, limits.retractions);
    return std::move(best_);
  }

  /// Makes the cuts of a forest that knows what they are worth, or the better half of them: whichever is
  /// worth more. There are not hundreds: the pieces of needles would take longer to pack than all the rest.
  ///
  /// \param seam  the length of all borders between charts
  /// \return none if the density does not rise by what that length and the pieces are worth
  std::optional<Cut_charts> trade(double coverage, double seam, double exchange_rate)
  {
    while (forest_.cuts().size() < most_cuts_of_trade && forest_.cut()) {
    }
    const std::vector<Index> cuts = forest_.cuts(); // the best first
    number_of_cuts_ = cuts.size();
    std::optional<Cut_charts> best;
    double most_worth = 0; // gain of density beyond the least one
    for (int i = 0; i < trials_of_trade && number_of_cuts_ > 0; ++i) {
      const double added = forest_.added_length() / seam;
      const double least_gain =
          std::max(exchange_rate * added, gain_of_cut * static_cast<double>(number_of_cuts_));
      const double needed = 1 + least_gain + most_worth;
      Cut_charts now = packed_now(coverage * needed * needed);
      const double worth = std::sqrt(now.packed.coverage / coverage) - 1 - least_gain;
      if (now.packed.packing.number_of_pages > 0 && (best ? worth > most_worth : worth >= 0)) {
        most_worth = worth;
        best = std::move(now);
      }
      set_number(cuts, number_of_cuts_ / 2);
    }
    return best;
  }

  /// Cuts charts that are larger than a page until all have the density that they are packed at.
  ///
  /// \return none if no cut raises what density there is
  std::optional<Cut_charts> fit(double density)
  {
    double most = 0;
    for (int i = 0; i < most_packings && most < density; ++i) {
      bool is_cut = false;
      while (forest_.cut_longest(Room_estimate::longest))
        is_cut = true;
      if (!is_cut && !forest_.cut_longest(0))
        break;
      Cut_charts now = packed_now(0);
      if (now.packed.packing.number_of_pages > 0 && now.packed.packing.density > most) {
        most = now.packed.packing.density;
        best_ = std::move(now);
      }
    }
    return std::move(best_);
  }

  /// Whether the last search ended because there was nothing more to cut.
  bool is_exhausted() const { return is_exhausted_; }

private:
  /// Each cut has to raise the density by that much: few charts are worth something too.
  static constexpr double gain_of_cut = 0.01;
  /// With all cuts, then with half of them.
  static constexpr int trials_of_trade = 2;
  static constexpr std::size_t most_cuts_of_trade = 128;

  /// The charts as they are now, packed unless it is clear that they cover less than `least`.
  Cut_charts packed_now(double least) const
  {
    Cut_charts now;
    now.flattened = forest_.write(now.segmentation);
    now.packed = pack_(now.segmentation, now.flattened, least);
    return now;
  }

  /// Packs the charts as they are now, and keeps them if they are the best so far. Charts that were not
  /// enough once are not packed again.
  double try_now(double& most, double wanted)
  {
    std::vector<Index> pieces = forest_.pieces();
    if (const auto before = too_little_.find(pieces); before != too_little_.end())
      return before->second;
    Cut_charts now = packed_now(std::min(most, wanted));
    const double coverage = now.packed.coverage;
    if (coverage < wanted)
      too_little_.emplace(std::move(pieces), coverage);
    if (now.packed.packing.number_of_pages > 0 && (coverage > most || coverage >= wanted)) {
      most = coverage;
      best_ = std::move(now);
    }
    return coverage;
  }

  /// Takes cuts back, or makes them again, until there are the first so many. They are numbered in the order
  /// in which they were made.
  void set_number(const std::vector<Index>& order, std::size_t number)
  {
    for (; number_of_cuts_ > number; --number_of_cuts_)
      forest_.set_cut(order[number_of_cuts_ - 1], false);
    for (; number_of_cuts_ < number; ++number_of_cuts_)
      forest_.set_cut(order[number_of_cuts_], true);
  }

  /// `few` cuts are not enough, `enough` are.
  void take_back(std::size_t few, std::size_t enough, double wanted, int retractions)
  {
    double most = wanted;
    const std::vector<Index> order = forest_.cuts();
    for (int i = 0; i < most_halvings && few + 1 < enough; ++i) {
      const std::size_t middle = (few + enough) / 2;
      set_number(order, middle);
      (try_now(most, wanted) >= wanted ? enough : few) = middle;
    }
    set_number(order, enough);
    const std::vector<Index> last = forest_.last_cuts();
    for (int i = 0; i < std::min(retractions, static_cast<int>(last.size())); ++i) {
      forest_.set_cut(last[i], false);
      if (try_now(most, wanted) < wanted)
        forest_.set_cut(last[i], true);
    }
  }

  Cut_forest forest_;
  Pack pack_;
  std::optional<Cut_charts> best_;
  std::map<std::vector<Index>, double> too_little_; ///< what these pieces cover
  std::size_t number_of_cuts_ = 0;
  bool is_exhausted_ = false;
};

} // namespace Atlas::internal

#endif
