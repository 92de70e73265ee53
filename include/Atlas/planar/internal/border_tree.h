// SPDX-License-Identifier: MIT
#ifndef ATLAS_PLANAR_INTERNAL_BORDER_TREE_H
#define ATLAS_PLANAR_INTERNAL_BORDER_TREE_H

#include <Atlas/core/Kernel.h>
#include <Atlas/planar/internal/box_tree.h>
#include <Atlas/planar/internal/vectors.h>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief A binary tree of boxes over the border edges of a flat chart, in the order of the border, which
/// keeps near edges together without sorting.
class Border_tree
{
public:
  using Edge = std::pair<Index, Index>;

  explicit Border_tree(const std::vector<std::vector<Index>>& borders)
  {
    for (const std::vector<Index>& border : borders)
      for (std::size_t i = 0; i < border.size(); ++i)
        edges_.emplace_back(border[i], border[i + 1 == border.size() ? 0 : i + 1]);
    boxes_.resize(2 * edges_.size());
  }

  const std::vector<Edge>& edges() const { return edges_; }

  /// Fits the boxes to the coordinates. O(border).
  void fit(std::span<const Complex> u)
  {
    if (!edges_.empty())
      fit(u, {0, 0, edges_.size()});
  }

  /// Whether `test(e, f)` holds for two edges whose boxes meet.
  template <typename Test>
  bool any_pair(Test test) const
  {
    return !edges_.empty() && any_pair({0, 0, edges_.size()}, test);
  }

  /// Calls `visit(edge)` for every edge whose box comes within `radius` of z in both coordinates.
  template <typename Visit>
  void for_each_near(const Complex& z, double radius, Visit visit) const
  {
    Box_2 box;
    box.add(z.real() + radius, z.imag() + radius);
    box.add(z.real() - radius, z.imag() - radius);
    if (!edges_.empty())
      for_each_near({0, 0, edges_.size()}, box, visit);
  }

private:
  /// The node of the edges [begin, end): its left child is next to it, the right one behind that.
  struct Node
  {
    std::size_t box, begin, end;

    bool is_leaf() const { return end - begin == 1; }
    std::size_t middle() const { return begin + (end - begin) / 2; }
    Node left() const { return {box + 1, begin, middle()}; }
    Node right() const { return {box + 2 * (middle() - begin), middle(), end}; }
  };

  void fit(std::span<const Complex> u, const Node& node)
  {
    Box_2& box = boxes_[node.box] = Box_2();
    if (node.is_leaf()) {
      for (const Index v : {edges_[node.begin].first, edges_[node.begin].second})
        box.add(u[v].real(), u[v].imag());
      return;
    }
    fit(u, node.left());
    fit(u, node.right());
    box.add(boxes_[node.left().box]);
    box.add(boxes_[node.right().box]);
  }

  template <typename Test>
  bool any_pair(const Node& node, Test& test) const
  {
    return !node.is_leaf() && (any_pair(node.left(), test) || any_pair(node.right(), test) ||
                               any_pair(node.left(), node.right(), test));
  }

  template <typename Test>
  bool any_pair(const Node& a, const Node& b, Test& test) const
  {
    if (!boxes_[a.box].meets(boxes_[b.box]))
      return false;
    if (a.is_leaf() && b.is_leaf())
      return test(edges_[a.begin], edges_[b.begin]);
    if (a.end - a.begin >= b.end - b.begin)
      return any_pair(a.left(), b, test) || any_pair(a.right(), b, test);
    return any_pair(a, b.left(), test) || any_pair(a, b.right(), test);
  }

  template <typename Visit>
  void for_each_near(const Node& node, const Box_2& box, Visit& visit) const
  {
    if (!boxes_[node.box].meets(box))
      return;
    if (node.is_leaf())
      return visit(edges_[node.begin]);
    for_each_near(node.left(), box, visit);
    for_each_near(node.right(), box, visit);
  }

  std::vector<Edge> edges_;
  std::vector<Box_2> boxes_;
};

} // namespace Atlas::internal

#endif
