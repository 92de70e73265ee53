// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_KERNEL_H
#define ATLAS_CORE_KERNEL_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cstdint>
#include <limits>

namespace Atlas {

/// The kernel below the border of the package: exact predicates, double coordinates.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_2 = Kernel::Point_2;
using Point_3 = Kernel::Point_3;
using Vector_2 = Kernel::Vector_2;
using Vector_3 = Kernel::Vector_3;

/// Indices of vertices, triangles, corners and charts: 32 bits carry 1.4 billion triangles.
using Index = std::uint32_t;

/// "No such thing": the opposite of a border halfedge, the chart of an unassigned triangle.
inline constexpr Index no_index = std::numeric_limits<Index>::max();

/// The halfedges of triangle t are 3t, 3t+1, 3t+2; halfedge 3t+i runs from corner i to corner i+1 (mod 3),
/// and bears the same number as the corner it starts at.
constexpr Index next_halfedge(Index h)
{
  return h % 3 == 2 ? h - 2 : h + 1;
}
constexpr Index previous_halfedge(Index h)
{
  return h % 3 == 0 ? h + 2 : h - 1;
}

} // namespace Atlas

#endif
