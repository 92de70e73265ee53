// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_FLATTENED_CHART_H
#define ATLAS_CORE_INTERNAL_FLATTENED_CHART_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/concepts.h>

#include <vector>

namespace Atlas::internal {

/// A chart in the plane, in units of the model, with what the policies said of it.
struct Flattened_chart
{
  Chart chart;
  Chart_verdict verdict;
  Flattening_record record;
  std::vector<Point_2> uv_before =
      {}; ///< what the optimizer began with, per vertex; empty if it changed nothing
};

} // namespace Atlas::internal

#endif
