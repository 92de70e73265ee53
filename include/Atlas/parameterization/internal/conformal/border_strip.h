// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_BORDER_STRIP_H
#define ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_BORDER_STRIP_H

#include <Atlas/parameterization/LSCM_traits.h>
#include <Atlas/parameterization/internal/conformal/conformal_system.h>
#include <Atlas/parameterization/internal/conformal/hermitian_multifrontal.h>

#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// \brief The unknowns within some rings of the border, and the exact solution of the system there, with
/// nothing moving elsewhere.
///
/// Nearly holomorphic maps that oscillate along the border die out inward within a few of their wavelengths.
/// They have so little energy that no smoother reduces them, and those with short waves are unlike any
/// coarse map: they are left to the strip.
class Border_strip
{
public:
  static constexpr int rings = 32; ///< how many the strip is wide

  bool factorize(const LSCM_system& system, const Graph& graph, const Execution& execution)
  {
    std::vector<int> place = find(system, graph);
    strip_.chart = system.chart;
    strip_.first.assign(1, 0);
    for (std::size_t c = 0; c < system.size(); ++c) {
      if (place[c] < 0)
        continue;
      for (auto k = static_cast<std::size_t>(system.first[c]);
           k < static_cast<std::size_t>(system.first[c + 1]); ++k)
        if (const int r = place[static_cast<std::size_t>(system.row[k])]; r >= 0) {
          strip_.row.push_back(r);
          strip_.value.push_back(system.value[k]);
        }
      strip_.first.push_back(static_cast<int>(strip_.row.size()));
    }
    const bool is_done = member_.empty() || factor_.factorize(strip_, execution);
    strip_ = {};
    return is_done;
  }

  /// x += what solves the system in the strip for the residual r.
  void correct(const std::vector<Complex>& r, std::vector<Complex>& x)
  {
    part_.resize(member_.size());
    for (std::size_t i = 0; i < member_.size(); ++i)
      part_[i] = r[member_[i]];
    if (!part_.empty())
      (void)factor_.solve(part_);
    for (std::size_t i = 0; i < member_.size(); ++i)
      x[member_[i]] += part_[i];
  }

private:
  /// The number in the strip of each unknown, or -1. Only border edges have imaginary parts.
  std::vector<int> find(const LSCM_system& system, const Graph& graph)
  {
    std::vector<int> ring(system.size(), -1);
    std::vector<Index> queue;
    const auto reach = [&](std::size_t v, int distance) {
      if (ring[v] >= 0)
        return;
      ring[v] = distance;
      queue.push_back(static_cast<Index>(v));
    };
    for (std::size_t c = 0; c < system.size(); ++c)
      for (auto k = static_cast<std::size_t>(system.first[c]);
           k < static_cast<std::size_t>(system.first[c + 1]); ++k)
        if (system.value[k].imag() != 0) {
          reach(c, 0);
          reach(static_cast<std::size_t>(system.row[k]), 0);
        }
    for (std::size_t head = 0; head < queue.size(); ++head)
      if (ring[queue[head]] + 1 < rings)
        for (std::size_t k = graph.first[queue[head]]; k < graph.first[queue[head] + 1]; ++k)
          reach(graph.neighbor[k], ring[queue[head]] + 1);
    for (std::size_t v = 0; v < ring.size(); ++v)
      if (ring[v] >= 0) {
        ring[v] = static_cast<int>(member_.size());
        member_.push_back(static_cast<Index>(v));
      }
    return ring;
  }

  LSCM_system strip_;
  std::vector<Index> member_; ///< the unknowns in the strip, increasing
  Basic_hermitian_multifrontal<Panels_in_single_precision> factor_;
  std::vector<Complex> part_;
};

} // namespace Atlas::internal

#endif
