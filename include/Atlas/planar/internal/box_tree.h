// SPDX-License-Identifier: MIT
#ifndef ATLAS_PLANAR_INTERNAL_BOX_TREE_H
#define ATLAS_PLANAR_INTERNAL_BOX_TREE_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Kernel.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// An axis-parallel box in the plane; empty until something is added.
struct Box_2
{
  double x0 = std::numeric_limits<double>::infinity(), y0 = x0, x1 = -x0, y1 = -x0;

  void add(double x, double y)
  {
    x0 = std::min(x0, x);
    y0 = std::min(y0, y);
    x1 = std::max(x1, x);
    y1 = std::max(y1, y);
  }
  void add(const Box_2& b)
  {
    x0 = std::min(x0, b.x0);
    y0 = std::min(y0, b.y0);
    x1 = std::max(x1, b.x1);
    y1 = std::max(y1, b.y1);
  }
  /// Whether the interiors intersect.
  bool overlaps(const Box_2& b) const { return x0 < b.x1 && b.x0 < x1 && y0 < b.y1 && b.y0 < y1; }

  /// Whether the closed boxes intersect.
  bool meets(const Box_2& b) const { return x0 <= b.x1 && b.x0 <= x1 && y0 <= b.y1 && b.y0 <= y1; }

  double squared_distance(const Box_2& b) const
  {
    const double dx = std::max({0.0, b.x0 - x1, x0 - b.x1}), dy = std::max({0.0, b.y0 - y1, y0 - b.y1});
    return dx * dx + dy * dy;
  }
};

/// \brief A balanced tree of boxes, halved at medians: items of node j of level l are those at the places
/// [n j / 2^l, n (j+1) / 2^l) of `order`. No pointers, the same for any number of threads. O(n log n).
class Box_tree
{
public:
  Box_tree(const std::vector<Box_2>& items, std::size_t leaf_size, const Execution& execution)
      : order_(items.size())
  {
    while ((items.size() >> levels_) > leaf_size)
      ++levels_;
    nodes_.resize((std::size_t(2) << levels_) - 1);
    std::vector<Centre> centres(items.size());
    for (std::size_t i = 0; i < items.size(); ++i)
      centres[i] = {0.5 * items[i].x0 + 0.5 * items[i].x1, 0.5 * items[i].y0 + 0.5 * items[i].y1,
                    static_cast<Index>(i)};
    for (unsigned level = 0; level < levels_; ++level)
      execution.for_each(std::size_t(1) << level, [&](std::size_t j) { halve(centres, level, j); });
    for (std::size_t i = 0; i < items.size(); ++i)
      order_[i] = centres[i].item;
    for (std::size_t j = 0; j < std::size_t(1) << levels_; ++j)
      for (std::size_t i = begin(levels_, j); i < begin(levels_, j + 1); ++i)
        node(levels_, j).add(items[order_[i]]);
    for (unsigned level = levels_; level-- > 0;)
      for (std::size_t j = 0; j < std::size_t(1) << level; ++j) {
        node(level, j) = node(level + 1, 2 * j);
        node(level, j).add(node(level + 1, 2 * j + 1));
      }
  }

  const std::vector<Index>& order() const { return order_; }

  /// Visits the leaves: `enter(box, first, last)` tells whether to go on below the node that holds the places
  /// [first, last), and `leaf(first, last)` handles them one by one.
  template <typename Enter, typename Leaf>
  void visit(Enter enter, Leaf leaf) const
  {
    visit(0, 0, enter, leaf);
  }

private:
  std::size_t begin(unsigned level, std::size_t j) const
  {
    return static_cast<std::size_t>(static_cast<std::uint64_t>(order_.size()) * j >> level);
  }
  Box_2& node(unsigned level, std::size_t j) { return nodes_[(std::size_t(1) << level) - 1 + j]; }
  const Box_2& node(unsigned level, std::size_t j) const { return nodes_[(std::size_t(1) << level) - 1 + j]; }

  /// What is sorted: by value, since looking up boxes all over the memory takes longer than moving these.
  struct Centre
  {
    double x, y;
    Index item;
  };

  void halve(std::vector<Centre>& centres, unsigned level, std::size_t j) const
  {
    const auto at = [&](std::size_t i) { return centres.begin() + static_cast<std::ptrdiff_t>(i); };
    const auto first = at(begin(level, j)), middle = at(begin(level + 1, 2 * j + 1)),
               last = at(begin(level, j + 1));
    Box_2 box;
    for (auto c = first; c != last; ++c)
      box.add(c->x, c->y);
    if (box.x1 - box.x0 >= box.y1 - box.y0)
      std::nth_element(first, middle, last, [](const Centre& a, const Centre& b) {
        return a.x != b.x ? a.x < b.x : a.item < b.item;
      });
    else
      std::nth_element(first, middle, last, [](const Centre& a, const Centre& b) {
        return a.y != b.y ? a.y < b.y : a.item < b.item;
      });
  }

  template <typename Enter, typename Leaf>
  void visit(unsigned level, std::size_t j, Enter& enter, Leaf& leaf) const
  {
    const std::size_t first = begin(level, j), last = begin(level, j + 1);
    if (!enter(node(level, j), first, last))
      return;
    if (level == levels_)
      return leaf(first, last);
    visit(level + 1, 2 * j, enter, leaf);
    visit(level + 1, 2 * j + 1, enter, leaf);
  }

  std::vector<Index> order_;
  std::vector<Box_2> nodes_;
  unsigned levels_ = 0;
};

} // namespace Atlas::internal

#endif
