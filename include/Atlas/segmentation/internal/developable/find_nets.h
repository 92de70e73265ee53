// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_FIND_NETS_H
#define ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_FIND_NETS_H

#include <Atlas/core/Any_policies.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/internal/bounding_box.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/segmentation/internal/developable/Net_builder.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Nets of the hard parts of a surface.
struct Nets
{
  std::vector<Index> of_triangle; ///< `no_index` for what is not hard
  std::vector<std::uint8_t> cut;  ///< per halfedge, the same on both sides: open though inside of a net
  Index count = 0;
};

/// \brief Makes nets in many styles, and keeps those with short seams that fill a page well.
///
/// How well is told by the packer, which gets the most promising ones.
class Net_finder
{
public:
  Net_finder(const Surface& surface, const Any_packer& packer, const Execution& execution)
      : surface_(surface), packer_(packer), execution_(execution),
        noise_(relative_position_noise * 2 * bounding_box(surface).half_side)
  {}

  Nets operator()()
  {
    const std::size_t n = surface_.number_of_triangles();
    Nets none{std::vector<Index>(n, no_index), std::vector<std::uint8_t>(3 * n, 0), 0};
    if (!(noise_ > 0) || !std::isfinite(noise_))
      return none;
    const Facets facets = coplanar_facets(surface_, noise_);
    const Hard_facets hard(surface_, facets, noise_);
    if (!hard.is_any_hard())
      return none;
    const Net_facets parts(surface_, facets, hard, noise_);
    make_trials(parts);
    if (execution_.is_cancelled())
      return none;
    keep_promising();
    pack_trials(parts.whole_area);
    const auto best = std::min_element(trials_.begin(), trials_.end(),
                                       [](const Trial& a, const Trial& b) { return a.cost < b.cost; });
    return nets_of(*best->builder, facets, hard);
  }

private:
  /// A page that is emptier than this counts like seams that are longer in this power of the ratio.
  static constexpr double enough_fullness = 0.72, exponent_of_fullness = 0.9;
  /// Pieces that unroll are cut where they get larger than a page that is full to one of these shares.
  /// Patterns run on across rulings, so seams there that the first share does not need count so many times
  /// more.
  static constexpr std::array shares_of_pieces{0.12, 0.7, 0.35};
  static constexpr double price_of_cut_rulings = 2;
  /// Styles are tried as long as all arcs, counted once per style, are fewer; at least one.
  static constexpr std::size_t most_arcs_tried = 120'000;
  /// The least number of trials that are packed, if there are as many, and the facets in all of them together
  /// up to which it may be more.
  static constexpr std::size_t least_packed = 2, most_packed = 16, most_facets_packed = 3000;
  static constexpr Index page_side = 512;

  struct Trial
  {
    std::unique_ptr<Net_builder> builder;
    double cut_rulings = 0, seams = 0, fullness = 0, cost = 0;
  };

  static std::vector<Net_style> styles()
  {
    std::vector<Net_style> result;
    for (unsigned variation = 0; variation < 8; ++variation)
      for (const double waste : {0.8, 0.2, 1.4, 0.1})
        for (const double share : {0.7, 0.6, 0.8, 0.5})
          result.push_back({waste, share, variation});
    return result;
  }

  static double cost(const Trial& t)
  {
    const double fullness = std::min(t.fullness, enough_fullness);
    return (t.seams + price_of_cut_rulings * t.cut_rulings) *
           std::pow(enough_fullness / fullness, exponent_of_fullness);
  }

  void make_trials(const Net_facets& parts)
  {
    const std::vector<Net_style> all = styles();
    const std::size_t n =
        std::clamp<std::size_t>(most_arcs_tried / std::max<std::size_t>(parts.arcs.size(), 1), 1,
                                all.size() * shares_of_pieces.size());
    std::vector<Net_builder> pieces;
    for (std::size_t i = 0; i < std::min(n, shares_of_pieces.size()); ++i)
      pieces.emplace_back(parts).glue_rulings(shares_of_pieces[i], execution_);
    const std::vector<std::size_t> jobs = different(pieces, n);
    trials_.resize(jobs.size());
    execution_.for_each(jobs.size(), [&](std::size_t k) {
      const std::size_t i = jobs[k];
      Trial& trial = trials_[k];
      trial.builder = std::make_unique<Net_builder>(pieces[i % pieces.size()]);
      trial.builder->glue_creases(all[i / pieces.size()], execution_);
      trial.seams = trial.builder->seam_length();
      trial.fullness = trial.builder->fullness();
      const double least = pieces.front().length_of_open_rulings();
      trial.cut_rulings = std::max(pieces[i % pieces.size()].length_of_open_rulings() - least, 0.0);
      trial.cost = cost(trial);
    });
  }

  /// The numbers up to n of pieces in styles, without pieces that are like others: where nothing unrolls, all
  /// are.
  static std::vector<std::size_t> different(const std::vector<Net_builder>& pieces, std::size_t n)
  {
    const auto is_first = [&](std::size_t i) {
      return std::none_of(pieces.begin(), pieces.begin() + static_cast<std::ptrdiff_t>(i),
                          [&](const Net_builder& other) { return pieces[i].is_like(other); });
    };
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < n; ++i)
      if (is_first(i % pieces.size()))
        result.push_back(i);
    return result;
  }

  /// Each layout once, as far as its figures tell, the best estimates first.
  void keep_promising()
  {
    const auto is_less = [](const Trial& a, const Trial& b) {
      return std::tie(a.cost, a.seams) < std::tie(b.cost, b.seams);
    };
    const auto is_same = [](const Trial& a, const Trial& b) {
      const double rounding = 1e-6;
      return std::abs(a.seams - b.seams) < rounding && std::abs(a.fullness - b.fullness) < rounding;
    };
    std::stable_sort(trials_.begin(), trials_.end(), is_less);
    trials_.erase(std::unique(trials_.begin(), trials_.end(), is_same), trials_.end());
    const std::size_t facets = std::max<std::size_t>(trials_.front().builder->number_of_nets(), 1);
    const std::size_t kept = std::clamp(most_facets_packed / facets, least_packed, most_packed);
    if (trials_.size() > kept)
      trials_.erase(trials_.begin() + static_cast<std::ptrdiff_t>(kept), trials_.end());
  }

  /// A trial that is dearer than the best so far, however well it may fill the page, is not packed.
  void pack_trials(double area)
  {
    if (trials_.size() < 2)
      return;
    double least_cost = HUGE_VAL;
    for (Trial& trial : trials_) {
      if (execution_.is_cancelled())
        return;
      trial.fullness = trial.builder->most_fullness();
      trial.cost = cost(trial);
      if (trial.cost >= least_cost)
        continue;
      Page_options page;
      page.width = page.height = page_side;
      page.gutter = 1;
      const std::vector<Chart> charts = trial.builder->charts();
      const Packing packing = packer_.pack(charts, page, execution_);
      const double covered = area * packing.density * packing.density;
      trial.fullness = std::max(covered / (double(page_side) * page_side), 1e-3);
      trial.cost = cost(trial);
      least_cost = std::min(least_cost, trial.cost);
    }
  }

  Nets nets_of(Net_builder& builder, const Facets& facets, const Hard_facets& hard) const
  {
    const std::size_t n = surface_.number_of_triangles();
    Nets nets{std::vector<Index>(n, no_index), std::vector<std::uint8_t>(3 * n, 0), 0};
    for (Index t = 0; t < n; ++t)
      if (const Index f = facets.of_triangle[t]; hard.is_hard(f))
        nets.of_triangle[t] = builder.net_of(f);
    trim(nets.of_triangle, hard);
    std::vector<Index> number(facets.count(), no_index);
    for (Index& net : nets.of_triangle)
      if (net != no_index) {
        Index& name = number[net];
        if (name == no_index)
          name = nets.count++;
        net = name;
      }
    for (Index h = 0; h < 3 * n; ++h) {
      const Index o = surface_.opposite[h];
      nets.cut[h] = o != no_index && nets.of_triangle[h / 3] != no_index &&
                    nets.of_triangle[h / 3] == nets.of_triangle[o / 3] && !surface_.is_diagonal(h) &&
                    facets.of_triangle[h / 3] != facets.of_triangle[o / 3] && !builder.is_glued(h);
    }
    return nets;
  }

  /// Leaves small triangles that stick out into what is curved to it, where no crease is between: borders are
  /// straighter then. Nets stay connected, since such a triangle has one neighbour in its net.
  void trim(std::vector<Index>& net, const Hard_facets& hard) const
  {
    constexpr int rounds = 3;
    constexpr double share_of_teeth = 1e-3; // of the area of the surface
    const double largest_tooth = share_of_teeth * area_3d(surface_);
    const auto is_open = [&](Index h) {
      return may_cross(surface_, h) && net[surface_.opposite[h] / 3] == no_index &&
             hard.turn(h) <= crease_degrees * CGAL_PI / 180;
    };
    for (int round = 0; round < rounds; ++round) {
      std::vector<Index> teeth;
      for (Index t = 0; t < net.size(); ++t) {
        int open = 0, kept = 0;
        for (Index h = 3 * t; net[t] != no_index && h < 3 * t + 3; ++h) {
          open += is_open(h);
          kept += must_not_be_seam(surface_, h);
        }
        if (open >= 2 && kept == 0 && triangle_area(surface_, t) <= largest_tooth)
          teeth.push_back(t);
      }
      for (const Index t : teeth)
        net[t] = no_index;
    }
  }

  const Surface& surface_;
  const Any_packer& packer_;
  const Execution& execution_;
  double noise_;
  std::vector<Trial> trials_;
};

} // namespace Atlas::internal

#endif
