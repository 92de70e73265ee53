// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_FEATURES_SMALL_CHART_ABSORBER_H
#define ATLAS_SEGMENTATION_INTERNAL_FEATURES_SMALL_CHART_ABSORBER_H

#include <Atlas/core/Surface.h>
#include <Atlas/segmentation/internal/features/Chart_boundaries.h>
#include <Atlas/segmentation/internal/surface/Submesh.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Which charts are too small to stay.
struct Smallness
{
  std::size_t faces = 0;  ///< fewer triangles than that
  double area = 0;        ///< less area than that
  std::size_t charts = 0; ///< more charts than that; 0: any number will do
};

/// \brief Merges charts that are too small, smallest first, with the neighbour they share the longest border
/// with. One arc of the border is opened, so that discs stay discs.
class Small_chart_absorber
{
public:
  Small_chart_absorber(const Surface& surface, const Submesh& submesh, Chart_boundaries& boundaries)
      : surface_(surface), submesh_(submesh), boundaries_(boundaries), charts_(boundaries.number_of_names())
  {
    for (Index t = 0; t < submesh.triangles.size(); ++t) {
      Chart_data& chart = charts_[boundaries.chart(t)];
      chart.area += triangle_area(surface, t);
      ++chart.triangles;
      for (Index h = 3 * t; h < 3 * t + 3; ++h)
        if (const Index o = submesh.opposite[h];
            o != no_index && boundaries.chart(o / 3) != boundaries.chart(t))
          chart.border.push_back(h);
    }
  }

  void run(const Smallness& small)
  {
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    std::size_t count = 0;
    for (Index c = 0; c < charts_.size(); ++c)
      if (charts_[c].triangles > 0) {
        queue.emplace(charts_[c].area, c);
        ++count;
      }
    while (!queue.empty()) {
      const auto [area, c] = queue.top();
      queue.pop();
      if (charts_[c].triangles == 0 || charts_[c].area != area)
        continue; // merged meanwhile
      const bool is_small = charts_[c].triangles < small.faces || area < small.area ||
                            (small.charts > 0 && count > small.charts);
      const Index h = is_small ? best_border(c) : no_index;
      if (h == no_index)
        continue;
      const Index merged = merge(h);
      queue.emplace(charts_[merged].area, merged);
      --count;
    }
  }

private:
  struct Chart_data
  {
    double area = 0;
    std::size_t triangles = 0;
    std::vector<Index> border; ///< halfedges of the chart; some may be border no more
  };

  /// The longest edge of the border with the neighbour that shares most of it.
  Index best_border(Index c)
  {
    struct Shared
    {
      Index neighbor, halfedge;
      double length;
    };
    std::vector<Shared> shared;
    for (const Index h : charts_[c].border)
      if (const Index d = boundaries_.chart(submesh_.opposite[h] / 3); d != c)
        shared.push_back({d, h, edge_length(surface_, h)});
    std::stable_sort(shared.begin(), shared.end(),
                     [](const Shared& a, const Shared& b) { return a.neighbor < b.neighbor; });
    Index best = no_index;
    double most = -1;
    for (std::size_t i = 0; i < shared.size();) {
      double sum = 0, longest = -1;
      Index halfedge = no_index;
      for (const Index d = shared[i].neighbor; i < shared.size() && shared[i].neighbor == d; ++i) {
        sum += shared[i].length;
        if (shared[i].length > longest) {
          longest = shared[i].length;
          halfedge = shared[i].halfedge;
        }
      }
      if (sum > most) {
        most = sum;
        best = halfedge;
      }
    }
    return best;
  }

  Index merge(Index h)
  {
    const Index c = boundaries_.chart(h / 3), d = boundaries_.chart(submesh_.opposite[h] / 3);
    const Index merged = boundaries_.unite(c, d);
    boundaries_.open(h);
    Chart_data &to = charts_[merged], &from = charts_[merged == c ? d : c];
    to.area += from.area;
    to.triangles += from.triangles;
    if (to.border.size() < from.border.size())
      to.border.swap(from.border);
    to.border.insert(to.border.end(), from.border.begin(), from.border.end());
    from = Chart_data();
    return merged;
  }

  const Surface& surface_;
  const Submesh& submesh_;
  Chart_boundaries& boundaries_;
  std::vector<Chart_data> charts_;
};

} // namespace Atlas::internal

#endif
