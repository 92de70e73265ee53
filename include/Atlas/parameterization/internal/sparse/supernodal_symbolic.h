// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_SPARSE_SUPERNODAL_SYMBOLIC_H
#define ATLAS_PARAMETERIZATION_INTERNAL_SPARSE_SUPERNODAL_SYMBOLIC_H

#include <Atlas/core/Kernel.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// A symmetric pattern without its diagonal: the neighbours of v are at [first[v], first[v+1]).
struct Graph
{
  std::vector<std::size_t> first;
  std::vector<Index> neighbor;

  std::size_t size() const { return first.size() - 1; }
};

/// \brief The symbolic part of a sparse Cholesky factorization: columns in postorder of the elimination tree,
/// gathered into supernodes, with the rows of each. Near-equal neighbours in the tree are merged at the price
/// of some explicit zeros ("relaxed"), so that dense kernels get work.
class Supernodal_symbolic
{
public:
  struct Supernode
  {
    Index begin, end;      ///< its columns
    std::size_t first_row; ///< its rows below are at [first_row, last_row) of rows()
    std::size_t last_row;
    Index parent; ///< the supernode of the first row below, or no_index

    std::size_t width() const { return end - begin; }
    std::size_t height() const { return last_row - first_row; }
  };

  /// \param order  a fill-reducing order: the k-th vertex to eliminate
  Supernodal_symbolic(const Graph& graph, std::vector<Index> order)
      : n_(static_cast<Index>(graph.size())), vertex_(std::move(order)), place_(n_)
  {
    number_places();
    std::vector<Index> parent = elimination_tree(graph);
    postorder(parent);
    number_places();
    list_lower(graph);
    parent = elimination_tree(graph);
    gather(parent, column_counts(graph, parent));
    find_rows();
  }

  Index size() const { return n_; }
  Index vertex(Index column) const { return vertex_[column]; }
  Index place(Index v) const { return place_[v]; }
  const std::vector<Supernode>& supernodes() const { return supernodes_; }
  const std::vector<Index>& rows() const { return rows_; }

  /// The entries below the diagonal of column c are at [lower_begin(c), lower_begin(c + 1)), by rows.
  std::size_t lower_begin(Index c) const { return lower_first_[c]; }
  Index lower_row(std::size_t k) const { return lower_row_[k]; }
  /// The place of entry (c, r) = conj of (r, c) in the graph.
  std::size_t lower_source(std::size_t k) const { return lower_source_[k]; }
  std::size_t number_of_entries() const { return lower_row_.size(); }
  /// What this takes, and what the numeric part has for each supernode besides its numbers.
  std::size_t bytes() const
  {
    return 4 * n_ * sizeof(Index) + lower_first_.capacity() * sizeof(std::size_t) +
           lower_row_.capacity() * (sizeof(std::size_t) + sizeof(Index)) + rows_.capacity() * sizeof(Index) +
           supernodes_.capacity() * (sizeof(Supernode) + 64);
  }

private:
  void number_places()
  {
    for (Index k = 0; k < n_; ++k)
      place_[vertex_[k]] = k;
  }

  /// Liu 1986, with path compression.
  std::vector<Index> elimination_tree(const Graph& graph) const
  {
    std::vector<Index> parent(n_, no_index), ancestor(n_, no_index);
    for (Index k = 0; k < n_; ++k)
      for (std::size_t e = graph.first[vertex_[k]]; e < graph.first[vertex_[k] + 1]; ++e)
        for (Index i = place_[graph.neighbor[e]]; i < k;) {
          const Index next = ancestor[i];
          ancestor[i] = k;
          if (next == no_index)
            parent[i] = k;
          i = next;
        }
    return parent;
  }

  /// Renumbers the columns so that every subtree is contiguous and children precede parents.
  void postorder(const std::vector<Index>& parent)
  {
    std::vector<Index> head(n_, no_index), next(n_, no_index), stack, order;
    order.reserve(n_);
    for (Index k = n_; k-- > 0;)
      if (parent[k] != no_index) {
        next[k] = head[parent[k]];
        head[parent[k]] = k;
      }
    for (Index root = 0; root < n_; ++root) {
      if (parent[root] != no_index)
        continue;
      stack.push_back(root);
      while (!stack.empty()) {
        const Index k = stack.back();
        if (head[k] != no_index) {
          stack.push_back(head[k]);
          head[k] = next[head[k]];
        } else {
          order.push_back(vertex_[k]);
          stack.pop_back();
        }
      }
    }
    vertex_ = std::move(order);
  }

  void list_lower(const Graph& graph)
  {
    lower_first_.assign(n_ + 1, 0);
    std::vector<std::pair<Index, std::size_t>> below;
    lower_row_.reserve(graph.neighbor.size() / 2);
    lower_source_.reserve(graph.neighbor.size() / 2);
    for (Index c = 0; c < n_; ++c) {
      below.clear();
      for (std::size_t e = graph.first[vertex_[c]]; e < graph.first[vertex_[c] + 1]; ++e)
        if (const Index r = place_[graph.neighbor[e]]; r > c)
          below.emplace_back(r, e);
      std::sort(below.begin(), below.end());
      for (const auto& [r, e] : below) {
        lower_row_.push_back(r);
        lower_source_.push_back(e);
      }
      lower_first_[c + 1] = lower_row_.size();
    }
  }

  /// Entries below the diagonal of each column of the factor, by walking the row subtrees.
  std::vector<Index> column_counts(const Graph& graph, const std::vector<Index>& parent) const
  {
    std::vector<Index> count(n_, 0), mark(n_, no_index);
    for (Index r = 0; r < n_; ++r) {
      mark[r] = r;
      for (std::size_t e = graph.first[vertex_[r]]; e < graph.first[vertex_[r] + 1]; ++e)
        for (Index c = place_[graph.neighbor[e]]; c < r && mark[c] != r; c = parent[c]) {
          mark[c] = r;
          ++count[c];
        }
    }
    return count;
  }

  /// Whether so many zeros are worth a wider supernode (the thresholds are CHOLMOD's).
  static bool is_worth_merging(double width, double zeros, double entries)
  {
    return width <= 4 || (width <= 16 && zeros < 0.8 * entries) || (width <= 48 && zeros < 0.1 * entries) ||
           zeros < 0.05 * entries;
  }

  void gather(const std::vector<Index>& parent, const std::vector<Index>& count)
  {
    struct Group
    {
      Index begin, end;
      double zeros;
    };
    std::vector<Group> groups;
    for (Index c = 0; c < n_; ++c) {
      if (!groups.empty() && parent[c - 1] == c && count[c - 1] == count[c] + 1)
        groups.back().end = c + 1; // the same rows
      else {
        merge(groups, parent, count);
        groups.push_back({c, c + 1, 0});
      }
    }
    merge(groups, parent, count);
    for (const Group& group : groups)
      supernodes_.push_back({group.begin, group.end, 0, 0, no_index});
  }

  /// Merges the last group with those before it whose parents it contains, as long as that is worth it.
  template <typename Group>
  static void merge(std::vector<Group>& groups, const std::vector<Index>& parent,
                    const std::vector<Index>& count)
  {
    while (groups.size() > 1) {
      Group &child = groups[groups.size() - 2], &top = groups.back();
      const Index up = parent[child.end - 1];
      if (up == no_index || up >= top.end)
        return;
      const double below = count[top.end - 1], wide = top.end - top.begin, narrow = child.end - child.begin,
                   child_below = count[child.end - 1];
      const double new_zeros = narrow * (wide + below - child_below);
      const double zeros = child.zeros + top.zeros + new_zeros, width = wide + narrow;
      if (!is_worth_merging(width, zeros, width * (width + 1) / 2 + width * below))
        return;
      child.end = top.end;
      child.zeros = zeros;
      groups.pop_back();
    }
  }

  void find_rows()
  {
    std::vector<Index> of_column(n_), mark(n_, no_index), own;
    std::vector<std::vector<Index>> children(supernodes_.size());
    for (Index s = 0; s < supernodes_.size(); ++s)
      for (Index c = supernodes_[s].begin; c < supernodes_[s].end; ++c)
        of_column[c] = s;
    for (Index s = 0; s < supernodes_.size(); ++s) {
      Supernode& node = supernodes_[s];
      own.clear();
      const auto add = [&](Index r) {
        if (r >= node.end && mark[r] != s) {
          mark[r] = s;
          own.push_back(r);
        }
      };
      for (std::size_t k = lower_first_[node.begin]; k < lower_first_[node.end]; ++k)
        add(lower_row_[k]);
      for (const Index child : children[s])
        for (std::size_t k = supernodes_[child].first_row; k < supernodes_[child].last_row; ++k)
          add(rows_[k]);
      std::vector<Index>().swap(children[s]);
      std::sort(own.begin(), own.end());
      node.first_row = rows_.size();
      rows_.insert(rows_.end(), own.begin(), own.end());
      node.last_row = rows_.size();
      if (!own.empty()) {
        node.parent = of_column[own.front()];
        children[node.parent].push_back(s);
      }
    }
  }

  Index n_;
  std::vector<Index> vertex_, place_;
  std::vector<std::size_t> lower_first_, lower_source_;
  std::vector<Index> lower_row_;
  std::vector<Supernode> supernodes_;
  std::vector<Index> rows_;
};

} // namespace Atlas::internal

#endif
