// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_RASTER_RASTER_LAYOUT_H
#define ATLAS_PACKING_INTERNAL_RASTER_RASTER_LAYOUT_H

#include <Atlas/packing/Page_packer.h>
#include <Atlas/packing/internal/horizon/horizon_layout.h>
#include <Atlas/packing/internal/pages/Layout.h>
#include <Atlas/packing/internal/pages/obstacle_layout.h>
#include <Atlas/packing/internal/pages/page_task.h>
#include <Atlas/packing/internal/pages/single_layout.h>
#include <Atlas/packing/internal/search/Packing_search.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace Atlas::internal {

/// How long to search. Work counts operations, so that a search takes the same course on every machine.
struct Search_budget
{
  /// With more charts than this the first layout stays: a search takes tens of seconds then.
  std::size_t max_charts = std::numeric_limits<std::size_t>::max();
  unsigned searches = 4;            ///< side by side
  std::uint64_t round = 36'000'000; ///< operations of each search between two looks at the others
  unsigned rounds = 1;
  /// Whether it is a race: searches that fall behind drop out, and all end as soon as some rounds in a row
  /// gain little.
  bool is_race = false;

  /// What that many shapes are worth: few have been tried in every way soon.
  std::uint64_t round_for(std::size_t shapes) const
  {
    return round * std::min<std::size_t>(shapes + 1, 6) / 6;
  }

  /// Of thousands of shapes one step of a search moves all, and takes as long as many rounds with few shapes:
  /// they get half of the searches and rounds. In a race few shapes get half of the searches too: each of
  /// them sees most layouts that there are, and the only one of very few shapes all.
  unsigned searches_for(std::size_t shapes) const
  {
    if (is_race && shapes <= very_few_shapes)
      return 1;
    return shapes > many_shapes || (is_race && shapes <= few_shapes) ? (searches + 1) / 2 : searches;
  }
  /// How fine rasters and shapes are. When time is short, few shapes are seen coarsely: they are large.
  double fineness_for(std::size_t shapes) const
  {
    return is_race && rounds > 0 && shapes <= very_few_shapes ? 0.5 : 1;
  }
  unsigned rounds_for(std::size_t shapes) const { return shapes > many_shapes ? (rounds + 1) / 2 : rounds; }
  /// How many rounds of a race in a row may gain little.
  std::size_t patience_for(std::size_t shapes) const { return shapes <= very_few_shapes ? 2 : 4; }
  static constexpr std::size_t many_shapes = 2000, few_shapes = 12, very_few_shapes = 3;
};

/// A race, for when time is short: about one round of the default, in parts of which most are not run.
inline Search_budget racing_budget()
{
  Search_budget budget;
  budget.is_race = true;
  budget.rounds = 16;
  budget.round = 2'750'000;
  return budget;
}

/// Up to that many shapes look for places by their overlaps; beyond, overlaps of all pairs are too many.
inline constexpr std::size_t max_shapes_of_exploration = 400;
/// Up to that many shapes, taking out and putting back gains less than looking for other layouts.
inline constexpr std::size_t max_shapes_of_pure_exploration = 64;

/// A search whose scale is that much below the best one's has little hope to catch up.
inline constexpr double most_lag = 0.012;
/// Rounds that raise the scale by less than this, all together, end a race.
inline constexpr double least_gain_of_rounds = 0.0004;
/// The scale from which on nothing is left to be gained: the one wanted, or nearly the largest there can be.
inline double enough_scale(double wanted, double largest)
{
  constexpr double error = 1e-9;
  return wanted <= (1 + error) * largest ? wanted : (1 - least_gain_of_rounds) * largest;
}

/// The share of searches that stays in a race after each round.
inline constexpr double share_in_race = 0.6;

/// The largest scale that layouts are likely to reach, by which shapes are made fine enough.
inline double likely_scale(const Outlines& outlines, double side, double fallback)
{
  return std::min(std::sqrt(0.75 * side * side / outlines.area), 1.5 * fallback);
}

/// How fine shapes have to be at a scale, on a page with sides of that length.
inline Shape_resolution search_resolution(const Packing_problem& problem, double side, double scale)
{
  Shape_resolution resolution;
  resolution.tolerance = problem.tolerance / scale;
  resolution.spacing = side / 128 / scale;
  resolution.cell = side / (256 * problem.fineness) / scale;
  resolution.gutter = (problem.gutter + 4 * problem.tolerance) / scale;
  resolution.cells_per_chart = problem.outlines.size() > Search_budget::many_shapes ? 12 : 20;
  return resolution;
}

/// Makes the shapes of all outlines; turns of the fallback become relative to their frames.
///
/// \param may_explore  whether shapes may look for places by their overlaps
inline void make_shapes(Packing_problem& problem, double side, double scale, bool may_explore,
                        const Execution& execution)
{
  const Shape_resolution resolution = search_resolution(problem, side, scale);
  problem.shapes.resize(problem.outlines.size());
  execution.for_each(problem.shapes.size(), [&](std::size_t i) {
    const Outline& outline = *problem.outlines[i];
    if (i >= problem.movable) {
      problem.shapes[i] =
          packing_shape(outline, obstacle_resolution(search_resolution(problem, side, 1), outline));
      return;
    }
    problem.shapes[i] = packing_shape(outline, resolution);
    Vec2& turn = problem.fallback.turns[i];
    turn = rotated({problem.shapes[i].frame.x, -problem.shapes[i].frame.y}, turn);
  });
  if (!may_explore || problem.shapes.size() > max_shapes_of_exploration)
    return;
  problem.coarse.resize(problem.shapes.size());
  execution.for_each(problem.shapes.size(), [&](std::size_t i) {
    const double unit = i < problem.movable ? scale : 1;
    problem.coarse[i].build(problem.shapes[i], 0.007 * side / unit, 0.2 * side / unit, 48);
  });
}

/// What searches need to know: shapes of the outlines that are not empty, and of the obstacles, as fine as
/// suits the page.
inline Packing_problem packing_problem(const Outlines& outlines, const Obstacles& obstacles,
                                       const Page_task& page, const Layout& fallback,
                                       const Search_budget& budget, const Execution& execution)
{
  Packing_problem problem;
  problem.fineness = budget.fineness_for(outlines.size());
  problem.fallback.scale = fallback.scale;
  const auto add = [&](const Outline& outline, Vec2 turn, Vec2 position) {
    problem.outlines.push_back(&outline);
    problem.fallback.turns.push_back(turn);
    problem.fallback.positions.push_back(position);
  };
  for (std::size_t i = 0; i < outlines.size(); ++i)
    if (!outlines.charts[i].is_empty())
      add(outlines.charts[i], fallback.turns[i], fallback.positions[i]);
  problem.movable = problem.outlines.size();
  for (const Outline& outline : obstacles.outlines)
    add(outline, {1, 0}, outline.centre);
  problem.width = page.width;
  problem.height = page.height;
  problem.gutter = 2 * fallback.margin;
  problem.tolerance = 0.05;

  const double side = std::sqrt(problem.width * problem.height);
  const double scale = likely_scale(outlines, side, fallback.scale);
  make_shapes(problem, side, scale, budget.rounds > 0, execution);
  if (execution.is_cancelled())
    return problem;
  problem.masks.emplace(problem.movables(), 8, scale, problem.pixel() * scale / problem.scale_of_share(0.8),
                        problem.grown(), execution);
  return problem;
}

/// \brief Several searches for one layout, which take turns in looking at each other.
class Joint_search
{
public:
  Joint_search(const Packing_problem& problem, const Search_budget& budget)
      : budget_(budget), shapes_(problem.shapes.size())
  {
    for (unsigned k = 0; k < budget.searches_for(shapes_); ++k)
      searches_.emplace_back(problem, k);
    active_ = searches_.size();
  }

  /// The best layout at a scale of at most `most_scale`; its scale is 0 if there is none.
  /// \param enough  scale at which the search ends
  Shape_layout run(double most_scale, double enough, const Execution& execution)
  {
    start(execution);
    const unsigned rounds = budget_.rounds_for(shapes_);
    std::vector<double> scales; // before each round
    for (unsigned r = 0; r < rounds && best().best().scale < enough; ++r) {
      scales.push_back(best().best().scale);
      if (!execution.proceed((r + 1.0) / (rounds + 1)))
        break;
      run_round(r, execution);
      catch_up();
      if (budget_.is_race && has_ended(scales))
        break;
    }
    Packing_search& winner = best();
    if (winner.best().scale > most_scale && !winner.shrink(most_scale))
      return {};
    return winner.best();
  }

private:
  static bool is_behind(const Packing_search& a, const Packing_search& b)
  {
    return a.best().scale < b.best().scale;
  }
  Packing_search& best() { return *std::max_element(searches_.begin(), searches_.end(), is_behind); }

  /// Whether the last rounds have gained little.
  bool has_ended(const std::vector<double>& scales)
  {
    const std::size_t patience = budget_.patience_for(shapes_);
    return scales.size() >= patience &&
           best().best().scale < (1 + least_gain_of_rounds) * scales[scales.size() - patience];
  }

  /// Few shapes have the same order by any size, and so the same first layout.
  void start(const Execution& execution)
  {
    std::vector<std::size_t> model(searches_.size());
    for (std::size_t k = 0; k < model.size(); ++k)
      while (model[k] < k && !searches_[k].starts_like(searches_[model[k]]))
        ++model[k];
    execution.for_each(searches_.size(), [&](std::size_t k) {
      if (model[k] == k)
        searches_[k].start(execution);
    });
    for (std::size_t k = 0; k < model.size(); ++k)
      if (model[k] != k)
        searches_[k].start_like(searches_[model[k]]);
  }

  void run_round(unsigned r, const Execution& execution)
  {
    if (budget_.is_race && r > 0)
      drop_out();
    const std::size_t n = shapes_;
    execution.for_each(active_, [&](std::size_t k) {
      Packing_search& search = searches_[k];
      const std::uint64_t limit = search.work() + budget_.round_for(n);
      if (n <= max_shapes_of_pure_exploration || (n <= max_shapes_of_exploration && (r + k) % 2 == 0))
        search.explore(limit, execution);
      else
        search.run(limit, execution);
    });
  }

  /// Brings the searches that stay in the race to the front.
  void drop_out()
  {
    std::stable_sort(searches_.begin(), searches_.end(),
                     [](const Packing_search& a, const Packing_search& b) { return is_behind(b, a); });
    active_ = static_cast<std::size_t>(std::ceil(share_in_race * static_cast<double>(active_)));
  }

  /// Searches that are far behind go on from where the best is.
  void catch_up()
  {
    const Shape_layout leader = best().best();
    for (Packing_search& search : searches_)
      if (search.best().scale < (1 - most_lag) * leader.scale)
        search.restart(leader);
  }

  Search_budget budget_;
  std::size_t shapes_;
  std::vector<Packing_search> searches_; ///< those that still run first
  std::size_t active_ = 0;
};

/// The layout of the raster packer at the largest scale it finds, at most the one wanted: the best there is
/// of a single outline; of several that of the horizon packer, or around obstacles a simple one on a raster,
/// unless the search finds a better one.
inline std::optional<Layout> raster_layout(const Outlines& outlines, const Obstacles& obstacles,
                                           const Page_task& page, const Search_budget& budget,
                                           const Execution& execution)
{
  if (outlines.size() == 1 && obstacles.is_empty()) {
    execution.proceed(); // a run that is cancelled hears of it, however short this is
    if (std::optional<Layout> alone = single_layout(outlines.charts.front(), page))
      return alone;
  }
  std::optional<Layout> result = obstacles.is_empty()
                                     ? horizon_layout(outlines, page, Horizon_source::outline, execution)
                                     : obstacle_layout(outlines, obstacles, page, execution);
  if (!result || !(outlines.area > 0) || result->scale >= page.most_scale ||
      outlines.size() > budget.max_charts || execution.is_cancelled())
    return result;
  const double largest = largest_scale_alone(outlines, page, result->margin);
  const double enough = enough_scale(page.most_scale, largest);
  if (result->scale >= enough)
    return result;
  Packing_problem problem = packing_problem(outlines, obstacles, page, *result, budget, execution);
  problem.most_scale = largest;
  if (execution.is_cancelled())
    return result;
  const Shape_layout found = Joint_search(problem, budget).run(page.most_scale, enough, execution);
  if (found.scale <= result->scale)
    return result;
  result->scale = found.scale;
  for (std::size_t i = 0, k = 0; i < outlines.size(); ++i)
    if (!outlines.charts[i].is_empty()) {
      result->turns[i] = rotated(found.turns[k], problem.shapes[k].frame);
      result->positions[i] = found.positions[k++];
    }
  return result;
}

/// The page engine behind `Raster_packer`, with any budget.
struct Raster_engine
{
  static constexpr bool heeds_obstacles = true;
  Search_budget budget;

  std::optional<Page_layout> lay_out(const Page_task& task, const Execution& execution) const
  {
    const Outlines outlines = outlines_of(task);
    return page_layout(raster_layout(outlines, obstacles_of(task), task, budget, execution));
  }
};

} // namespace Atlas::internal

#endif
