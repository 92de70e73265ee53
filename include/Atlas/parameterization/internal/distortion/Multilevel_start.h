// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_DISTORTION_MULTILEVEL_START_H
#define ATLAS_PARAMETERIZATION_INTERNAL_DISTORTION_MULTILEVEL_START_H

#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/internal/distortion/Descent.h>
#include <Atlas/parameterization/internal/distortion/chart_hierarchy.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Charts with fewer vertices are optimised as they are.
inline constexpr std::size_t least_chart_with_levels = 2000;
/// Coarser meshes gain nothing.
inline constexpr std::size_t least_coarse_chart = 400;

/// \brief Finds a map near the minimum from coarse to fine: the minimum over a coarse mesh of the chart is
/// the start for the next finer one. That takes a few steps at full size instead of dozens, above all where
/// the border has to be kept from touching itself.
template <typename Energy>
class Multilevel_start
{
public:
  /// \param borders  the border loops of the chart
  /// \param descent  must outlive this object
  Multilevel_start(const Chart_geometry& geometry, const std::vector<std::vector<Index>>& borders,
                   const std::vector<Complex>& u, Descent<Energy>& descent)
      : descent_(descent), geometry_(geometry), borders_(borders), u_(u), hierarchy_(geometry, u_)
  {}

  /// \return `false` if there is no coarser mesh, or no way back from it
  bool operator()(const Execution& execution)
  {
    if (u_.size() < least_chart_with_levels)
      return false;
    hierarchy_.coarsen(least_coarse_chart);
    const bool was_simple = is_simple(0, u_);
    std::vector<Complex> u = u_;
    bool is_changed = false;
    for (std::size_t level = hierarchy_.levels().size(); level-- > 1;) {
      if (!is_changed && was_simple && !is_simple(level, u))
        continue; // two parts of the border are too near for a mesh so coarse
      if (!minimize(level, u, execution) || !refine(level - 1, u))
        return false;
      is_changed = true;
    }
    u_ = std::move(u);
    return is_changed;
  }

  /// The result, if there is one.
  const std::vector<Complex>& coordinates() const { return u_; }
  /// Whether the border had to be kept from touching itself.
  bool is_guarded() const { return is_guarded_; }

private:
  bool is_simple(std::size_t level, const std::vector<Complex>& u) const
  {
    std::vector<std::vector<Index>> loops = borders_;
    for (std::vector<Index>& loop : loops)
      std::erase_if(loop, [&](Index v) { return !hierarchy_.has(level, v); });
    return Injectivity_checker(geometry_.chart(), std::move(loops)).is_border_simple(u);
  }

  bool minimize(std::size_t level, std::vector<Complex>& u, const Execution& execution)
  {
    const Chart chart = hierarchy_.chart(level);
    const Chart_geometry geometry(chart);
    const std::vector<Index>& vertices = hierarchy_.levels()[level].vertices;
    const double unit = geometry.from_model(geometry_.to_model(1));
    std::vector<Complex> part;
    for (const Index v : vertices)
      part.push_back(unit * u[v]);
    typename Descent<Energy>::Minimizer minimizer(geometry, std::move(part), descent_.mean());
    if (minimizer.has_flip())
      return false;
    if (is_guarded_)
      minimizer.guard();
    (void)descent_(minimizer, 0, execution);
    is_guarded_ = minimizer.is_guarded();
    for (std::size_t i = 0; i < vertices.size(); ++i)
      u[vertices[i]] = minimizer.coordinates()[i] / unit;
    return !execution.is_cancelled();
  }

  bool refine(std::size_t level, std::vector<Complex>& u) const
  {
    if (!hierarchy_.refine(level, u, false))
      return false;
    if (is_simple(level, u) || !is_simple(level + 1, u))
      return true;
    return hierarchy_.refine(level, u, true) && is_simple(level, u);
  }

  Descent<Energy>& descent_;
  const Chart_geometry& geometry_;
  const std::vector<std::vector<Index>>& borders_;
  std::vector<Complex> u_;
  Chart_hierarchy hierarchy_;
  bool is_guarded_ = false;
};

} // namespace Atlas::internal

#endif
