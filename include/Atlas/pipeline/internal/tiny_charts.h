// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_TINY_CHARTS_H
#define ATLAS_PIPELINE_INTERNAL_TINY_CHARTS_H

#include <Atlas/core/internal/Flattened_chart.h>
#include <Atlas/measure/distortion.h>

#include <cstddef>

namespace Atlas::internal {

/// A chart of fewer triangles joins a neighbour if the bound allows it, even if that one gets worse ...
inline constexpr std::size_t triangles_of_least_chart = 10;
/// ... unless that one has less distortion than this, and so is unrolled: too good to take in what is bent.
inline constexpr double least_energy_of_bent_charts = 1.0001;

inline bool is_tiny(const Flattened_chart& f)
{
  return f.chart.number_of_triangles() < triangles_of_least_chart;
}

inline bool is_unrolled(const Flattened_chart& f)
{
  return measure_distortion(f.chart).symmetric_dirichlet_mean < least_energy_of_bent_charts;
}

} // namespace Atlas::internal

#endif
