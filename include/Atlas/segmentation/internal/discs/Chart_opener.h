// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_DISCS_CHART_OPENER_H
#define ATLAS_SEGMENTATION_INTERNAL_DISCS_CHART_OPENER_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/cuts.h>
#include <Atlas/core/internal/edge_rules.h>
#include <Atlas/segmentation/internal/discs/Disc_cutter.h>
#include <Atlas/segmentation/internal/surface/Submesh.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief Turns some charts of a segmentation into discs.
class Chart_opener
{
public:
  Chart_opener(const Surface& surface, Segmentation& segmentation, const Execution& execution)
      : surface_(surface), segmentation_(segmentation), execution_(execution),
        local_(surface.number_of_triangles())
  {}

  /// Returns the triangles of the discs that the chosen triangles fall into, in the order of their first
  /// triangles. `triangles` are all those of some charts, in increasing order.
  std::vector<std::vector<Index>> run(std::vector<Index> triangles)
  {
    keep_faces_whole(triangles);
    put_cuts_where_they_belong(triangles);
    const auto is_glued = [&](Index h) { return segmentation_.is_glued(surface_, h); };
    std::vector<std::vector<Index>> parts;
    {
      const Submesh all = make_submesh(surface_, std::move(triangles), is_glued, local_);
      parts = connected_parts(all);
      for (std::vector<Index>& part : parts)
        for (Index& t : part)
          t = all.triangles[t];
    }
    std::vector<Index> part_of(surface_.number_of_triangles(), no_index);
    for (Index p = 0; p < parts.size(); ++p)
      for (const Index t : parts[p])
        part_of[t] = p;
    std::vector<std::vector<std::vector<Index>>> discs(parts.size());
    execution_.for_each(parts.size(), [&](std::size_t p) {
      discs[p] = open(std::move(parts[p]), [&](Index h) {
        const Index o = surface_.opposite[h];
        return o != no_index && part_of[o / 3] == p && !segmentation_.cut[h];
      });
    });
    std::vector<std::vector<Index>> result;
    for (auto& some : discs)
      std::move(some.begin(), some.end(), std::back_inserter(result));
    std::sort(result.begin(), result.end(),
              [](const auto& a, const auto& b) { return a.front() < b.front(); });
    return result;
  }

private:
  /// Triangles of one input face follow the first of them.
  void keep_faces_whole(const std::vector<Index>& triangles)
  {
    std::vector<Index> chart_of_face(surface_.number_of_faces, no_index);
    for (const Index t : triangles) {
      Index& chart = chart_of_face[surface_.face[t]];
      if (chart == no_index)
        chart = segmentation_.chart[t];
      segmentation_.chart[t] = chart;
    }
  }

  /// Cuts what has to be a seam, and nothing inside a face.
  void put_cuts_where_they_belong(const std::vector<Index>& triangles)
  {
    for (const Index t : triangles)
      for (Index h = 3 * t; h < 3 * t + 3; ++h) {
        const Index o = surface_.opposite[h];
        if (o == no_index)
          continue;
        const bool is_wanted =
            segmentation_.cut[h] || segmentation_.cut[o] || o / 3 == t || must_be_seam(surface_, h);
        set_cut(surface_, segmentation_, h, is_wanted && !surface_.is_diagonal(h));
      }
  }

  void cut(Index h) { set_cut(surface_, segmentation_, h, true); }

  /// Opens one connected part. In rare cases (edges that share both ends) the result cannot be written as an
  /// indexed mesh; then the faces to blame become charts of their own, in the last resort all faces.
  template <typename Is_glued>
  std::vector<std::vector<Index>> open(std::vector<Index> part, Is_glued is_glued)
  {
    struct Task
    {
      std::vector<Index> triangles;
      int attempt;
    };
    constexpr int attempts = 3;
    std::vector<std::vector<Index>> discs;
    std::vector<Task> tasks{{std::move(part), 0}};
    while (!tasks.empty()) {
      auto [triangles, attempt] = std::move(tasks.back());
      tasks.pop_back();
      Submesh submesh = make_submesh(surface_, std::move(triangles), is_glued, local_);
      Disc_cutter(surface_, submesh).run([&](Index h) { cut(h); });
      const std::vector<Index> blamed = ambiguous_triangles(submesh);
      if (blamed.empty()) {
        discs.push_back(std::move(submesh.triangles));
        continue;
      }
      split_faces_off(submesh, blamed, attempt + 1 == attempts);
      for (std::vector<Index>& sub : connected_parts(submesh)) {
        for (Index& t : sub)
          t = submesh.triangles[t];
        tasks.push_back({std::move(sub), attempt + 1});
      }
    }
    return discs;
  }

  /// Unglues the faces of the blamed triangles, or all faces, from the rest. Edges between parts that come
  /// apart here are cut, which does no harm, since they become charts of their own.
  void split_faces_off(Submesh& submesh, const std::vector<Index>& blamed, bool all)
  {
    std::vector<Index> faces;
    for (const Index t : blamed)
      faces.push_back(surface_.face[submesh.triangles[t]]);
    std::sort(faces.begin(), faces.end());
    for (Index h = 0; h < submesh.opposite.size(); ++h) {
      const Index o = submesh.opposite[h];
      if (o == no_index || surface_.is_diagonal(submesh.global(h)))
        continue;
      const auto is_blamed = [&](Index t) {
        return std::binary_search(faces.begin(), faces.end(), surface_.face[submesh.triangles[t]]);
      };
      if (all || is_blamed(h / 3) || is_blamed(o / 3)) {
        cut(submesh.global(h));
        submesh.opposite[h] = submesh.opposite[o] = no_index;
      }
    }
  }

  const Surface& surface_;
  Segmentation& segmentation_;
  const Execution& execution_;
  std::vector<Index> local_;
};

} // namespace Atlas::internal

#endif
