// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_SEARCH_PACKING_SEARCH_H
#define ATLAS_PACKING_INTERNAL_SEARCH_PACKING_SEARCH_H

#include <Atlas/packing/internal/raster/Raster_builder.h>
#include <Atlas/packing/internal/search/Contact_relaxation.h>
#include <Atlas/packing/internal/search/Guided_local_search.h>
#include <Atlas/packing/internal/search/Packing_problem.h>
#include <Atlas/packing/internal/shapes/chart_clearance.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <random>
#include <vector>

namespace Atlas::internal {

/// One search for a dense layout.
///
/// `start()` places shapes on a raster, pushes them apart, and lets them grow as long as that succeeds. Then
/// there are two ways to go on, each until a given number of operations have been done: `explore()` moves
/// shapes to other places at a scale that is still too large, by their overlaps; `run()` takes a few shapes
/// out, puts them elsewhere, and lets all grow anew. What a search does depends on the problem and on its
/// number, by which its random choices differ from those of others; its best layout never gets worse.
class Packing_search
{
public:
  Packing_search(const Packing_problem& problem, unsigned number)
      : problem_(&problem), number_(number), random_(1234567 + 7919 * number),
        empty_(problem.empty_page(problem.pixel())), frame_(empty_),
        relaxation_(problem.shapes,
                    {problem.width, problem.height, problem.gutter + 2 * problem.tolerance + 2 * slack(),
                     problem.gutter / 2 + problem.tolerance + slack(), slack(), problem.obstacles().size()}),
        overlap_(problem.coarse,
                 {problem.width, problem.height, problem.gutter - problem.leniency(),
                  problem.gutter / 2 + problem.tolerance, problem.obstacles().size()},
                 987654 + 104729 * number)
  {}

  /// The best layout so far that keeps the gutter exactly; its scale is 0 if there is none yet.
  const Shape_layout& best() const { return best_; }
  std::uint64_t work() const { return work_ + relaxation_.work() + overlap_.work(); }

  /// Builds the first layout.
  void start(const Execution& execution)
  {
    best_ = current_ = problem_->fallback;
    relaxation_.assign(best_);
    std::optional<Shape_layout> layout = build(execution);
    if (!layout)
      return;
    relaxation_.assign(std::move(*layout));
    bool is_relaxed = relaxation_.relax(60);
    for (int i = 0; i < 8 && !is_relaxed; ++i) {
      relaxation_.set_scale(relaxation_.layout().scale * 0.985);
      is_relaxed = relaxation_.relax(40);
    }
    if (is_relaxed && accept())
      inflate(0.006, start_work());
    current_ = best_;
  }

  /// Whether the first layout will be that of another search; then it can be taken from there.
  bool starts_like(const Packing_search& other) const { return order() == other.order(); }
  void start_like(const Packing_search& other)
  {
    best_ = current_ = other.best_;
    relaxation_ = other.relaxation_;
    work_ = other.work_;
  }

  /// Goes on from another layout.
  void restart(const Shape_layout& layout)
  {
    relaxation_.assign(layout);
    current_ = candidate_ = layout;
    if (layout.scale > best_.scale)
      best_ = layout;
  }

  /// Ruins and recreates until that much work has been done.
  void run(std::uint64_t work_limit, const Execution& execution)
  {
    while (best_.scale > 0 && work() < work_limit && !execution.is_cancelled())
      improve();
  }

  /// Looks for quite other layouts, at larger scales, until that much work has been done, or many attempts in
  /// a row gained nothing: few shapes have been tried in every way soon. A scale at which
  /// shapes overlap in the end is not lost: pushed apart at a smaller one, they often are better than before.
  void explore(std::uint64_t work_limit, const Execution& execution)
  {
    if (best_.scale <= 0 || problem_->coarse.empty())
      return;
    if (candidate_.positions.empty())
      candidate_ = best_;
    const std::size_t most_idle = 8 + 12 * problem_->movable;
    for (std::size_t idle = 0; idle < most_idle && work() < work_limit && !execution.is_cancelled(); ++idle) {
      const double before = best_.scale;
      candidate_.scale = before * (1 + step_);
      const double left = overlap_.solve(candidate_, patience, overlap_.work() + (work_limit - work()));
      work_ += 1000;
      if (left <= most_overlap * step_ * problem_->width * problem_->height)
        settle(candidate_);
      const bool is_worth_while = !(left > 0) || best_.scale > before * (1 + 0.5 * step_);
      step_ = is_worth_while ? std::min(largest_step, 1.3 * step_) : std::max(least_step, 0.6 * step_);
      if (best_.scale > before) {
        candidate_ = best_;
        idle = 0;
      } else {
        if (below(3) == 0)
          candidate_ = best_;
        disturb(candidate_);
      }
    }
    current_ = best_;
  }

  /// Lowers the scale of the best layout; false if that cannot be done.
  bool shrink(double scale)
  {
    relaxation_.assign(best_);
    relaxation_.set_scale(scale);
    for (int attempt = 0; attempt < 4; ++attempt)
      if (relaxation_.relax(60) && is_exact()) {
        best_ = relaxation_.layout();
        return true;
      }
    return false;
  }

private:
  static constexpr int patience = 15; ///< sweeps without gain after which a search for places is given up
  static constexpr double most_overlap = 0.3; ///< more, relative to page and step, cannot be pushed apart
  static constexpr double largest_step = 0.04, least_step = 0.008; ///< of the scale
  static double slack() { return 0.02; }
  /// What the first layout may cost before it is taken as it is.
  std::uint64_t start_work() const { return 50'000'000 + 20'000 * problem_->shapes.size(); }
  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }

  /// The order in which shapes are placed: each search has its own.
  std::vector<Index> order() const
  {
    const auto shapes = problem_->movables();
    std::vector<double> size(shapes.size());
    for (std::size_t i = 0; i < size.size(); ++i) {
      const Packing_shape& s = shapes[i];
      size[i] = number_ % 4 == 0   ? s.width * s.height
                : number_ % 4 == 1 ? s.radius * s.radius
                : number_ % 4 == 2 ? s.mass
                                   : s.perimeter * s.perimeter;
    }
    std::vector<Index> result(shapes.size());
    std::iota(result.begin(), result.end(), Index(0));
    std::stable_sort(result.begin(), result.end(), [&](Index i, Index j) { return size[i] > size[j]; });
    return result;
  }

  /// Raises the scale of raster layouts until they fail.
  std::optional<Shape_layout> build(const Execution& execution)
  {
    std::vector<Index> sequence = order();
    const Packing_problem& p = *problem_;
    const int tries = p.movable <= 300 ? 2 : 1;
    double scale = std::min({p.scale_of_share(0.74), 1.45 * p.fallback.scale, p.most_scale});
    const auto attempt = [&](double s) {
      std::optional<Shape_layout> layout =
          build_on_raster(*p.masks, p.empty_page(p.masks->pixel(s)), s, sequence, tries, work_);
      if (layout)
        add_obstacles(*layout);
      return layout;
    };
    std::optional<Shape_layout> best = attempt(scale);
    while (!best && scale > 0.98 * p.fallback.scale && !execution.is_cancelled()) {
      scale *= 0.96;
      best = attempt(scale);
    }
    for (const double step : {0.02, 0.007})
      while (best && work() < start_work() / 2 && !execution.is_cancelled()) {
        auto next = attempt(scale * (1 + step));
        if (!next)
          break;
        best = std::move(next);
        scale *= 1 + step;
      }
    return best;
  }

  /// Appends the obstacles to a layout of what moves.
  void add_obstacles(Shape_layout& layout) const
  {
    const auto append = [&](std::vector<Vec2>& to, const std::vector<Vec2>& from) {
      to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(problem_->movable), from.end());
    };
    append(layout.turns, problem_->fallback.turns);
    append(layout.positions, problem_->fallback.positions);
  }

  /// Pushes the shapes of a layout apart, at its scale or a smaller one that is still better than the best.
  void settle(const Shape_layout& layout)
  {
    relaxation_.assign(layout);
    bool is_relaxed = relaxation_.relax(60);
    for (double scale = layout.scale; !is_relaxed && scale > best_.scale * 1.0005;) {
      scale = std::max(best_.scale * 1.0004, 0.99 * scale);
      relaxation_.set_scale(scale);
      is_relaxed = relaxation_.relax(40);
    }
    if (is_relaxed && accept())
      inflate(0.004, std::numeric_limits<std::uint64_t>::max());
  }

  /// Swaps two shapes or throws one anywhere.
  void disturb(Shape_layout& layout)
  {
    const std::size_t n = problem_->movable, i = below(n), j = below(n);
    if (i != j && below(3) != 0)
      std::swap(layout.positions[i], layout.positions[j]);
    else
      layout.positions[i] = {uniform() * problem_->width, uniform() * problem_->height};
  }

  /// Takes the present layout as the best if it is better and passes the exact test. Charts that fail get
  /// more room and everything is relaxed again.
  bool accept()
  {
    for (int attempt = 0; attempt < 3; ++attempt) {
      if (relaxation_.layout().scale <= best_.scale)
        return true;
      if (is_exact()) {
        best_ = relaxation_.layout();
        return true;
      }
      if (!relaxation_.relax(30))
        return false;
    }
    return false;
  }

  bool is_exact()
  {
    const std::vector<Placed_outline> placed = problem_->placed(relaxation_.layout());
    bool is_good = true;
    const double border = problem_->gutter / 2;
    std::size_t segments = 0;
    for (Index i = 0; i < problem_->movable; ++i) {
      double least = HUGE_VAL;
      for (const Vec2& p : placed[i].points)
        least = std::min({least, p.x, p.y, problem_->width - p.x, problem_->height - p.y});
      segments += placed[i].points.size();
      if (least < border) {
        is_good = false;
        relaxation_.widen(i, border - least + slack());
      }
    }
    work_ += 400 * segments;
    const double gutter = problem_->gutter;
    std::vector<double> missing(placed.size(), 0.0);
    Chart_clearance(placed, gutter).search([&](Index i, Index j, double distance) {
      if (i >= problem_->movable && j >= problem_->movable)
        return true;
      missing[i] = std::max(missing[i], gutter - distance);
      missing[j] = std::max(missing[j], gutter - distance);
      return true;
    });
    for (Index i = 0; i < placed.size(); ++i)
      if (missing[i] > 0) {
        is_good = false;
        relaxation_.widen(i, missing[i] / 2 + slack());
      }
    return is_good;
  }

  /// Goes back to an earlier state but for the work that has been done.
  void go_back(const Contact_relaxation& state)
  {
    const std::uint64_t done = relaxation_.work();
    relaxation_ = state;
    relaxation_.set_work(done);
  }

  /// Raises the scale in ever smaller steps as long as shapes can be pushed apart.
  void inflate(double step, std::uint64_t work_limit)
  {
    Contact_relaxation good = relaxation_;
    while (step > 0.0004 && work() < work_limit) {
      relaxation_.set_scale(good.layout().scale * (1 + step));
      if (relaxation_.relax(100))
        good = relaxation_;
      else {
        step /= 2.5;
        go_back(good);
      }
    }
    go_back(good);
    if (!accept())
      go_back(good);
  }

  /// Shapes to take out: one and its neighbours, or any.
  std::vector<Index> victims()
  {
    const std::size_t n = problem_->movable;
    const std::size_t k = 1 + below(std::min<std::size_t>(5, n));
    const bool is_local = below(3) != 0;
    const Index first = static_cast<Index>(below(n));
    std::vector<std::pair<double, Index>> by_distance;
    for (Index i = 0; i < n; ++i) {
      const double d = length(current_.positions[i] - current_.positions[first]) -
                       problem_->shapes[i].radius * current_.scale;
      by_distance.emplace_back(i == first ? -HUGE_VAL : is_local ? d : uniform(), i);
    }
    std::partial_sort(by_distance.begin(), by_distance.begin() + static_cast<std::ptrdiff_t>(k),
                      by_distance.end());
    std::vector<Index> result;
    for (std::size_t i = 0; i < k; ++i)
      result.push_back(by_distance[i].second);
    std::sort(result.begin(), result.end(), [&](Index i, Index j) {
      const double a = problem_->shapes[i].mass, b = problem_->shapes[j].mass;
      return a != b ? a > b : i < j;
    });
    if (result.size() > 1 && below(3) == 0)
      std::swap(result[0], result[1]);
    return result;
  }

  /// Takes shapes out and puts them elsewhere; false if no place is found.
  bool rebuild(Shape_layout& layout)
  {
    const std::vector<Index> out = victims();
    std::vector<bool> is_out(problem_->movable, false);
    for (const Index i : out)
      is_out[i] = true;
    const Packing_problem& p = *problem_;
    frame_ = empty_;
    draw_on_raster(frame_, p.movables(), layout, is_out, p.grown(), work_);
    const double angle = 2 * M_PI * uniform();
    const Vec2 any_twist{std::cos(angle), std::sin(angle)};
    for (const Index i : out) {
      bool is_placed = false;
      const std::vector<Vec2> turns = turns_of(p.shapes[i].rotation, 16);
      const Vec2 twist = p.shapes[i].may_turn() ? any_twist : Vec2{1, 0};
      for (double erosion = 0; erosion <= 4 && !is_placed; erosion += 0.75)
        is_placed = insert_on_raster(frame_, p.shapes[i], i, turns, twist, p.grown() - erosion * frame_.pixel,
                                     layout, work_);
      if (!is_placed)
        return false;
    }
    return true;
  }

  /// Takes charts out and puts them elsewhere. Pushing all charts apart at a scale that is too large, even in
  /// vain, spreads the free space; at the former scale or just below they then find room, and grow again.
  void improve()
  {
    Shape_layout layout = current_;
    const double scale = current_.scale, loss = -0.0015 * std::log(uniform());
    work_ += 1000;
    if (!rebuild(layout))
      return;
    const Contact_relaxation before = relaxation_;
    relaxation_.move_to(layout);
    relaxation_.set_scale(scale * (1 + 0.001 + 0.004 * uniform()));
    bool is_relaxed = relaxation_.relax(48);
    if (!is_relaxed) {
      relaxation_.set_scale(scale * (1 - 0.001 * (0.5 - std::log(uniform()))));
      is_relaxed = relaxation_.relax(40);
    }
    if (!is_relaxed) {
      go_back(before);
      return;
    }
    inflate(0.003, std::numeric_limits<std::uint64_t>::max());
    if (relaxation_.layout().scale >= scale * (1 - loss))
      current_ = relaxation_.layout();
    else
      go_back(before);
  }

  const Packing_problem* problem_;
  unsigned number_;
  std::mt19937_64 random_;
  Raster_frame empty_, frame_; ///< the obstacles; and what a layout is rebuilt on
  Contact_relaxation relaxation_;
  Guided_local_search overlap_;
  Shape_layout best_, current_, candidate_;
  double step_ = 0.03; ///< by which the next scale is larger
  std::uint64_t work_ = 0;
};

} // namespace Atlas::internal

#endif
