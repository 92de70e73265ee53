// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_INTERNAL_OVERLAPS_IMPL_H
#define ATLAS_VALIDATION_INTERNAL_OVERLAPS_IMPL_H

#include <Atlas/planar/internal/box_tree.h>
#include <Atlas/planar/internal/coverage_sweep.h>
#include <Atlas/validation/overlaps.h>

#include <algorithm>
#include <cstdint>

namespace Atlas {

ATLAS_INLINE std::vector<Index> triangles_of(const Overlaps& overlaps)
{
  std::vector<Index> result;
  for (const auto& [s, t] : overlaps.pairs) {
    result.push_back(s);
    result.push_back(t);
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

ATLAS_INLINE bool do_interiors_intersect(const Triangle_uv& s, const Triangle_uv& t)
{
  const auto is_separating = [](const Point_2& a, const Point_2& b, const Triangle_uv& other) {
    return CGAL::orientation(a, b, other[0]) != CGAL::LEFT_TURN &&
           CGAL::orientation(a, b, other[1]) != CGAL::LEFT_TURN &&
           CGAL::orientation(a, b, other[2]) != CGAL::LEFT_TURN;
  };
  for (int i = 0; i < 3; ++i)
    if (is_separating(s[i], s[(i + 1) % 3], t) || is_separating(t[i], t[(i + 1) % 3], s))
      return false;
  return true;
}

namespace internal {

/// The triangles that have an interior, turned counterclockwise, in the order of a tree of boxes.
class Overlap_finder
{
public:
  Overlap_finder(std::span<const Triangle_uv> triangles, const Execution& execution)
      : items_(collect(triangles, execution)), tree_(boxes(items_), leaf_size, execution)
  {
    std::vector<Item> sorted(items_.size());
    execution.for_each((sorted.size() + block_size - 1) / block_size, [&](std::size_t block) {
      for (std::size_t i = block * block_size; i < std::min(sorted.size(), (block + 1) * block_size); ++i)
        sorted[i] = items_[tree_.order()[i]];
    });
    items_ = std::move(sorted);
  }

  /// Blocks of queries run in rounds that grow: a million triangles in one spot fill the list in the first
  /// round, before a second block is started; a valid atlas takes few rounds. What is looked at does not
  /// depend on the number of threads.
  Overlaps find(std::size_t max_pairs, const Execution& execution) const
  {
    Overlaps result;
    const std::size_t blocks = (items_.size() + block_size - 1) / block_size;
    std::vector<Overlaps> round;
    for (std::size_t done = 0, size = 1; done < blocks && result.is_complete;
         size = std::min<std::size_t>(2 * size, 256)) {
      round.assign(std::min(size, blocks - done), {});
      execution.for_each(round.size(), [&](std::size_t i) { find(done + i, max_pairs, round[i]); });
      for (const Overlaps& found : round) {
        result.pairs.insert(result.pairs.end(), found.pairs.begin(), found.pairs.end());
        result.is_complete = result.is_complete && found.is_complete;
      }
      if (result.pairs.size() > max_pairs)
        result.is_complete = false;
      done += round.size();
    }
    std::sort(result.pairs.begin(), result.pairs.end());
    result.pairs.resize(std::min(result.pairs.size(), max_pairs));
    return result;
  }

private:
  static constexpr std::size_t leaf_size = 4, block_size = 512;
  /// How many boxes the queries of a block may look at, on average: long parallel needles can have n^2
  /// intersecting boxes without an overlap.
  static constexpr std::size_t steps_per_query = 4096;

  struct Item
  {
    Triangle_uv corners;
    Box_2 box;
    Index id;
  };

  static std::vector<Item> collect(std::span<const Triangle_uv> triangles, const Execution& execution)
  {
    std::vector<std::uint8_t> has_interior(triangles.size());
    std::vector<std::int8_t> sign(triangles.size());
    execution.for_each((triangles.size() + block_size - 1) / block_size, [&](std::size_t block) {
      for (std::size_t i = block * block_size; i < std::min(triangles.size(), (block + 1) * block_size); ++i)
        sign[i] =
            static_cast<std::int8_t>(CGAL::orientation(triangles[i][0], triangles[i][1], triangles[i][2]));
    });
    std::vector<Item> items;
    items.reserve(triangles.size());
    for (Index i = 0; i < triangles.size(); ++i) {
      if (sign[i] == 0)
        continue;
      Item item{triangles[i], {}, i};
      if (sign[i] < 0)
        std::swap(item.corners[1], item.corners[2]);
      for (const Point_2& p : item.corners)
        item.box.add(p.x(), p.y());
      items.push_back(item);
    }
    return items;
  }

  static std::vector<Box_2> boxes(const std::vector<Item>& items)
  {
    std::vector<Box_2> result(items.size());
    for (std::size_t i = 0; i < items.size(); ++i)
      result[i] = items[i].box;
    return result;
  }

  /// All overlaps of an item of the block with one at a later place.
  void find(std::size_t block, std::size_t max_pairs, Overlaps& found) const
  {
    std::size_t steps = block_size * steps_per_query;
    for (std::size_t i = block * block_size; i < std::min(items_.size(), (block + 1) * block_size); ++i) {
      const Item& item = items_[i];
      tree_.visit(
          [&](const Box_2& box, std::size_t, std::size_t last) {
            if (found.is_complete && steps-- == 0)
              found.is_complete = false;
            return found.is_complete && last > i + 1 && box.overlaps(item.box);
          },
          [&](std::size_t first, std::size_t last) {
            for (std::size_t j = std::max(first, i + 1); j < last && found.is_complete; ++j) {
              const Item& other = items_[j];
              if (!item.box.overlaps(other.box) || !do_interiors_intersect(item.corners, other.corners))
                continue;
              if (found.pairs.size() == max_pairs)
                found.is_complete = false;
              else
                found.pairs.push_back(std::minmax(item.id, other.id));
            }
          });
      if (!found.is_complete)
        return;
    }
  }

  std::vector<Item> items_;
  Box_tree tree_;
};

} // namespace internal

ATLAS_INLINE Overlaps find_overlaps(std::span<const Triangle_uv> triangles, const Execution& execution,
                                    std::size_t max_pairs)
{
  return internal::Overlap_finder(triangles, execution).find(max_pairs, execution);
}

ATLAS_INLINE bool is_overlap_free(std::span<const Triangle_uv> triangles, std::span<const Index> opposite)
{
  std::vector<std::int8_t> sign(triangles.size());
  for (std::size_t i = 0; i < sign.size(); ++i)
    sign[i] = static_cast<std::int8_t>(CGAL::orientation(triangles[i][0], triangles[i][1], triangles[i][2]));
  const auto from = [&](Index h) -> const Point_2& { return triangles[h / 3][h % 3]; };
  const auto to = [&](Index h) -> const Point_2& { return from(next_halfedge(h)); };
  internal::Coverage_sweep sweep;
  for (Index h = 0; h < opposite.size(); ++h) {
    if (sign[h / 3] == 0)
      continue;
    const Index o = opposite[h];
    if (o != no_index && sign[o / 3] == sign[h / 3] && from(h) == to(o) && to(h) == from(o))
      continue;
    if (sign[h / 3] > 0)
      sweep.add(from(h), to(h));
    else
      sweep.add(to(h), from(h));
  }
  return sweep.is_covered_at_most_once();
}

} // namespace Atlas

#endif
