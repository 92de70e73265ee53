// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_ARGUMENTS_H
#define ATLAS_SEGMENTATION_INTERNAL_ARGUMENTS_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/errors.h>

#include <cstddef>
#include <string>

namespace Atlas::internal {

/// Throws `Invalid_argument` unless the value is in [0, 1].
inline void require_share(double value, const char* argument)
{
  if (!(value >= 0 && value <= 1))
    throw Invalid_argument(argument, "must be in [0, 1], but is " + std::to_string(value));
}

/// Throws `Invalid_argument` unless the value is 0 or more; infinity is.
inline void require_not_negative(double value, const char* argument)
{
  if (!(value >= 0))
    throw Invalid_argument(argument, "must be at least 0, but is " + std::to_string(value));
}

/// Throws `Invalid_argument` unless the value is greater than 0; infinity is.
inline void require_positive(double value, const char* argument)
{
  if (!(value > 0))
    throw Invalid_argument(argument, "must be greater than 0, but is " + std::to_string(value));
}

/// Throws `Invalid_argument` unless the value is in [least, most].
inline void require_in(long long value, long long least, long long most, const char* argument)
{
  if (value < least || value > most)
    throw Invalid_argument(argument, "must be in [" + std::to_string(least) + ", " + std::to_string(most) +
                                         "], but is " + std::to_string(value));
}

/// Throws `Invalid_argument` unless a list has as many entries as it must have.
inline void require_size(std::size_t size, std::size_t wanted, const char* argument, const char* of_what)
{
  if (size != wanted)
    throw Invalid_argument(argument, "has " + std::to_string(size) + " entries for " +
                                         std::to_string(wanted) + " " + of_what);
}

/// Throws `Invalid_argument` unless the segmentation has a chart for each triangle of the surface and a cut
/// or none for each halfedge.
inline void require_segmentation_of(const Surface& surface, const Segmentation& segmentation)
{
  require_size(segmentation.chart.size(), surface.number_of_triangles(), "segmentation.chart", "triangles");
  require_size(segmentation.cut.size(), surface.opposite.size(), "segmentation.cut", "halfedges");
}

/// The same, and that the charts have numbers in [0, number of charts).
inline void require_numbered_segmentation_of(const Surface& surface, const Segmentation& segmentation)
{
  require_segmentation_of(surface, segmentation);
  for (const Index c : segmentation.chart)
    if (c >= segmentation.number_of_charts)
      throw Invalid_argument("segmentation.chart",
                             "has the number " + std::to_string(c) + ", but there are " +
                                 std::to_string(segmentation.number_of_charts) + " charts");
}

} // namespace Atlas::internal

#endif
