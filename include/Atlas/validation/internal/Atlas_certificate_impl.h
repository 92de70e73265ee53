// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_INTERNAL_ATLAS_CERTIFICATE_IMPL_H
#define ATLAS_VALIDATION_INTERNAL_ATLAS_CERTIFICATE_IMPL_H

#include <Atlas/validation/certify.h>

#include <sstream>

namespace Atlas {

ATLAS_INLINE std::string message(const Atlas_certificate& c)
{
  if (c.is_valid())
    return "the atlas is valid";
  std::ostringstream out;
  const char* separator = "";
  const auto add = [&](bool is_fault, auto... words) {
    if (is_fault) {
      out << separator;
      (out << ... << words);
      separator = ", ";
    }
  };
  const char* at_least = c.are_overlaps_complete ? "" : "at least ";
  add(c.not_finite > 0, c.not_finite, " triangles without finite coordinates");
  add(c.flipped > 0, c.flipped, " flipped triangles");
  add(c.degenerate > 0, c.degenerate, " flat triangles");
  add(c.overlaps_in_charts > 0, at_least, c.overlaps_in_charts, " overlapping pairs of triangles in charts");
  add(c.overlaps_between_charts > 0, at_least, c.overlaps_between_charts,
      " overlapping pairs of triangles between charts");
  add(!c.is_overlap_free && c.overlaps_in_charts + c.overlaps_between_charts == 0, "overlapping triangles");
  add(c.corners_outside > 0, c.corners_outside, " corners outside of the page");
  add(c.chart_distance < c.gutter - c.gutter_tolerance, "charts ", c.chart_distance,
      " texels apart instead of ", c.gutter);
  add(c.page_border_distance < c.gutter / 2 - c.gutter_tolerance, "a chart ", c.page_border_distance,
      " texels from the border of the page instead of ", c.gutter / 2);
  return out.str();
}

} // namespace Atlas

#endif
