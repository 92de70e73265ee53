// SPDX-License-Identifier: MIT
// What every segmentation has to fulfil once it is cut to discs.
#ifndef ATLAS_TEST_SEGMENTATION_CHECKS_H
#define ATLAS_TEST_SEGMENTATION_CHECKS_H

#include <Atlas/core/extract_charts.h>

#include <gtest/gtest.h>
#include <set>

namespace Atlas::test {

inline void expect_whole_faces(const Surface& surface, const Segmentation& segmentation)
{
  for (Index h = 0; h < surface.opposite.size(); ++h) {
    const Index o = surface.opposite[h];
    if (o == no_index)
      continue;
    ASSERT_EQ(segmentation.cut[h], segmentation.cut[o]) << "halfedge " << h;
    if (surface.is_diagonal(h)) {
      ASSERT_TRUE(segmentation.is_glued(surface, h)) << "diagonal " << h;
    }
  }
}

inline void expect_constraints(const Surface& surface, const Segmentation& segmentation)
{
  for (Index h = 0; h < surface.opposite.size(); ++h) {
    const Index o = surface.opposite[h];
    if (o == no_index || surface.is_diagonal(h))
      continue;
    if (!surface.constraint.empty() && surface.constraint[h] == Edge_constraint::seam) {
      ASSERT_FALSE(segmentation.is_glued(surface, h)) << "halfedge " << h;
    }
    if (!surface.patch.empty() && surface.patch[h / 3] != surface.patch[o / 3]) {
      ASSERT_NE(segmentation.chart[h / 3], segmentation.chart[o / 3]) << "halfedge " << h;
    }
  }
}

/// The postcondition of cut_to_discs().
inline void expect_discs(const Surface& surface, const Segmentation& segmentation)
{
  ASSERT_EQ(segmentation.chart.size(), surface.number_of_triangles());
  ASSERT_EQ(segmentation.cut.size(), surface.opposite.size());
  expect_whole_faces(surface, segmentation);
  expect_constraints(surface, segmentation);
  const std::vector<Chart> charts = extract_charts(surface, segmentation);
  for (std::size_t c = 0; c < charts.size(); ++c) {
    const Chart_topology t = topology(charts[c]);
    ASSERT_TRUE(t.is_disc()) << "chart " << c << ": " << t.components << " components, " << t.border_loops
                             << " loops, Euler " << t.euler << ", " << charts[c].number_of_triangles()
                             << " triangles";
    for (const auto& [i, j, k] : charts[c].triangles)
      ASSERT_TRUE(i != j && j != k && k != i) << "chart " << c;
  }
}

/// Charts numbered 0, 1, ... by their first triangles.
inline void expect_numbered_by_first_triangle(const Segmentation& segmentation)
{
  Index next = 0;
  for (const Index c : segmentation.chart) {
    ASSERT_LE(c, next);
    next += c == next;
  }
  EXPECT_EQ(next, segmentation.number_of_charts);
}

} // namespace Atlas::test

#endif
