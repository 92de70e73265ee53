// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_FLATTENED_CHART_H
#define ATLAS_CORE_INTERNAL_FLATTENED_CHART_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/concepts.h>

namespace Atlas::internal {

/// A chart in the plane, in units of the model, with what the policies said of it.
struct Flattened_chart
{
  Chart chart;
  Chart_verdict verdict;
  Flattening_record record;
};

} // namespace Atlas::internal

#endif
