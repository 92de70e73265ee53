// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_COUNT_ANGLES_H
#define ATLAS_PIPELINE_INTERNAL_COUNT_ANGLES_H

#include <Atlas/core/Chart.h>
#include <Atlas/measure/distortion.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// Figure 9 of the LSCM paper: the share of the triangles per degree of the angle between the gradients.
inline void count_angles(const std::vector<Chart>& charts, std::array<double, 180>& shares)
{
  double count = 0;
  for (const Chart& chart : charts)
    for (const double angle : gradient_angles(chart))
      if (std::isfinite(angle)) {
        const double last = static_cast<double>(shares.size() - 1);
        ++shares[static_cast<std::size_t>(std::min(angle, last))];
        ++count;
      }
  for (double& share : shares)
    share /= std::max(count, 1.0);
}

} // namespace Atlas::internal

#endif
