// SPDX-License-Identifier: MIT
#ifndef ATLAS_REPORT_INTERNAL_HISTOGRAM_SVG_H
#define ATLAS_REPORT_INTERNAL_HISTOGRAM_SVG_H

#include <Atlas/soup/internal/face_distortion.h>

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

namespace Atlas::internal {

/// Bars of a histogram as SVG, with ticks at equal distances.
inline std::string histogram_svg(const Histogram& histogram, const std::vector<std::string>& ticks)
{
  constexpr double width = 480, height = 150, left = 34;
  const double most = std::max(*std::max_element(histogram.share.begin(), histogram.share.end()), 1e-9);
  std::ostringstream svg;
  svg << "<svg viewBox=\"0 0 530 182\" role=\"img\"><rect x=\"34\" y=\"10\" width=\"480\" height=\"150\" "
         "fill=\"#f6f6f3\"/>";
  const double step = width / static_cast<double>(histogram.share.size());
  for (std::size_t i = 0; i < histogram.share.size(); ++i) {
    const double h = height * histogram.share[i] / most;
    svg << "<rect x=\"" << left + step * static_cast<double>(i) + 0.5 << "\" y=\"" << 10 + height - h
        << "\" width=\"" << step - 1 << "\" height=\"" << h << "\" fill=\"#365ca8\"/>";
  }
  for (std::size_t i = 0; i < ticks.size(); ++i)
    svg << "<text text-anchor=\"middle\" x=\""
        << left + width * static_cast<double>(i) / static_cast<double>(ticks.size() - 1) << "\" y=\"176\">"
        << ticks[i] << "</text>";
  svg.precision(3);
  svg << "<text text-anchor=\"end\" x=\"508\" y=\"24\">highest bar " << 100 * most << " %</text></svg>\n";
  return svg.str();
}

} // namespace Atlas::internal

#endif
