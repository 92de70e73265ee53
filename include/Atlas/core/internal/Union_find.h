// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_UNION_FIND_H
#define ATLAS_CORE_INTERNAL_UNION_FIND_H

#include <Atlas/core/Kernel.h>

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Disjoint sets of the numbers [0, n). The root of a set is its least number, so that results do not depend
/// on the order in which sets were united.
class Union_find
{
public:
  explicit Union_find(std::size_t n = 0) : parent_(n) { std::iota(parent_.begin(), parent_.end(), Index(0)); }

  /// Adds a number, alone in its set, and returns it.
  Index add()
  {
    parent_.push_back(static_cast<Index>(parent_.size()));
    return parent_.back();
  }

  std::size_t size() const { return parent_.size(); }

  Index find(Index i)
  {
    while (parent_[i] != i)
      i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  /// Returns whether the two were in different sets.
  bool unite(Index i, Index j)
  {
    i = find(i);
    j = find(j);
    if (i == j)
      return false;
    if (j < i)
      std::swap(i, j);
    parent_[j] = i;
    return true;
  }

  /// Per number that of its set; sets are numbered in the order of their least numbers. Returns how many.
  Index number_sets(std::vector<Index>& number)
  {
    Index count = 0;
    number.resize(parent_.size());
    for (Index i = 0; i < parent_.size(); ++i)
      number[i] = find(i) == i ? count++ : number[find(i)];
    return count;
  }

private:
  std::vector<Index> parent_;
};

} // namespace Atlas::internal

#endif
