// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_CUT_TO_DISCS_H
#define ATLAS_SEGMENTATION_CUT_TO_DISCS_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/edge_rules.h>
#include <Atlas/segmentation/internal/discs/Disc_cutter.h>
#include <Atlas/segmentation/internal/surface/Submesh.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace Atlas {

namespace internal {

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
      const Submesh all = make_piece(surface_, std::move(triangles), is_glued, local_);
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
        segmentation_.cut[h] = segmentation_.cut[o] = is_wanted && !surface_.is_diagonal(h);
      }
  }

  void cut(Index h) { segmentation_.cut[h] = segmentation_.cut[surface_.opposite[h]] = 1; }

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
      Submesh piece = make_piece(surface_, std::move(triangles), is_glued, local_);
      Disc_cutter(surface_, piece).run([&](Index h) { cut(h); });
      const std::vector<Index> blamed = ambiguous_triangles(piece);
      if (blamed.empty()) {
        discs.push_back(std::move(piece.triangles));
        continue;
      }
      split_faces_off(piece, blamed, attempt + 1 == attempts);
      for (std::vector<Index>& sub : connected_parts(piece)) {
        for (Index& t : sub)
          t = piece.triangles[t];
        tasks.push_back({std::move(sub), attempt + 1});
      }
    }
    return discs;
  }

  /// Unglues the faces of the blamed triangles, or all faces, from the rest. Edges between pieces that part
  /// here are cut, which does no harm, since they become charts of their own.
  void split_faces_off(Submesh& piece, const std::vector<Index>& blamed, bool all)
  {
    std::vector<Index> faces;
    for (const Index t : blamed)
      faces.push_back(surface_.face[piece.triangles[t]]);
    std::sort(faces.begin(), faces.end());
    for (Index h = 0; h < piece.opposite.size(); ++h) {
      const Index o = piece.opposite[h];
      if (o == no_index || surface_.is_diagonal(piece.global(h)))
        continue;
      const auto is_blamed = [&](Index t) {
        return std::binary_search(faces.begin(), faces.end(), surface_.face[piece.triangles[t]]);
      };
      if (all || is_blamed(h / 3) || is_blamed(o / 3)) {
        cut(piece.global(h));
        piece.opposite[h] = piece.opposite[o] = no_index;
      }
    }
  }

  const Surface& surface_;
  Segmentation& segmentation_;
  const Execution& execution_;
  std::vector<Index> local_;
};

} // namespace internal

/// \brief Makes every chart a disc that can be flattened.
///
/// Afterwards every chart is connected over glued edges and has one border loop and Euler characteristic 1,
/// as `topology(extract_chart(...))` measures it; the triangles of an input face are in one chart, and no cut
/// runs on a diagonal; no chart crosses a patch border (`Surface::patch`), and edges that must be seams are
/// cut. Cuts that the segmentation brings along stay. Edges that must not be seams are cut only where there
/// is no other way.
///
/// Charts in several parts become several charts. Closed charts are opened: a sphere along the shortest path
/// between the ends of a diameter, handles along shortest loops that do not separate; several border loops
/// are joined by shortest cuts. Cuts are shortest in a measure that makes sharp edges up to four times
/// cheaper. Charts are numbered by their first triangles.
///
/// O(n log n log k) for n triangles and k cuts; parallel over charts.
inline void cut_to_discs(const Surface& surface, Segmentation& segmentation,
                         const Execution& execution = Execution())
{
  std::vector<Index> triangles(surface.number_of_triangles());
  std::iota(triangles.begin(), triangles.end(), Index(0));
  const auto discs = internal::Chart_opener(surface, segmentation, execution).run(std::move(triangles));
  for (Index c = 0; c < discs.size(); ++c)
    for (const Index t : discs[c])
      segmentation.chart[t] = c;
  segmentation.number_of_charts = static_cast<Index>(discs.size());
}

/// \brief The same for some charts only; all others keep their triangles, cuts and numbers.
///
/// The first part of each of these charts keeps its number; the other parts get new numbers, from
/// `number_of_charts` on in the order of their first triangles. (Should one of these charts lose all its
/// triangles because it had but pieces of faces, its number goes to the next part without one, else to the
/// chart with the largest number.) Returns the numbers of all charts that came from the given ones,
/// increasing.
inline std::vector<Index> cut_to_discs(const Surface& surface, Segmentation& segmentation,
                                       std::span<const Index> charts,
                                       const Execution& execution = Execution())
{
  std::vector<std::uint8_t> is_free(segmentation.number_of_charts, 0);
  for (const Index c : charts)
    is_free[c] = 1;
  std::vector<Index> triangles;
  for (Index t = 0; t < segmentation.chart.size(); ++t)
    if (is_free[segmentation.chart[t]])
      triangles.push_back(t);
  const auto discs = internal::Chart_opener(surface, segmentation, execution).run(std::move(triangles));

  std::vector<Index> numbers;
  for (const auto& disc : discs) {
    const Index c = segmentation.chart[disc.front()];
    numbers.push_back(is_free[c] ? c : no_index);
    is_free[c] = 0;
  }
  std::vector<Index> left;
  for (Index c = 0; c < is_free.size(); ++c)
    if (is_free[c])
      left.push_back(c);
  auto next = left.begin();
  for (Index& number : numbers)
    if (number == no_index)
      number = next != left.end() ? *next++ : segmentation.number_of_charts++;
  for (std::size_t i = 0; i < discs.size(); ++i)
    for (const Index t : discs[i])
      segmentation.chart[t] = numbers[i];
  for (auto c = left.end(); c != next;) {
    const Index last = --segmentation.number_of_charts;
    if (*--c == last)
      continue;
    std::replace(segmentation.chart.begin(), segmentation.chart.end(), last, *c);
    std::replace(numbers.begin(), numbers.end(), last, *c);
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

} // namespace Atlas

#endif
