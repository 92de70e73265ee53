// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_INTERNAL_INDEX_UV_H
#define ATLAS_SOUP_INTERNAL_INDEX_UV_H

#include <Atlas/core/Kernel.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace Atlas::internal {

/// \brief Numbers distinct rows of a few 64-bit words in the order in which they occur first.
template <std::size_t N>
class Row_table
{
public:
  using Row = std::array<std::uint64_t, N>;

  explicit Row_table(std::size_t expected) { numbers_.reserve(expected); }

  /// The number of the row; a new one is the number of rows before.
  Index operator()(const Row& row)
  {
    return numbers_.try_emplace(row, static_cast<Index>(numbers_.size())).first->second;
  }
  std::size_t size() const { return numbers_.size(); }

private:
  struct Hash
  {
    std::size_t operator()(const Row& row) const
    {
      std::uint64_t h = 0;
      for (const std::uint64_t word : row)
        h = std::rotl((h ^ word) * 0x9E3779B97F4A7C15u, 29);
      return static_cast<std::size_t>(h ^ (h >> 32));
    }
  };
  std::unordered_map<Row, Index, Hash> numbers_;
};

/// Coordinates at corners as a table of distinct ones and an index per corner.
struct Indexed_uv
{
  std::vector<Point_2> points; ///< in the order in which they occur first
  std::vector<Index> corner;   ///< per corner: its point, or `no_index` where a coordinate is not finite
};

inline Indexed_uv index_uv(const std::vector<Point_2>& uv)
{
  Indexed_uv result;
  result.corner.reserve(uv.size());
  Row_table<2> table(uv.size() / 4);
  for (const Point_2& p : uv) {
    if (!std::isfinite(p.x()) || !std::isfinite(p.y())) {
      result.corner.push_back(no_index);
      continue;
    }
    const Index i =
        table({std::bit_cast<std::uint64_t>(p.x() + 0.0), std::bit_cast<std::uint64_t>(p.y() + 0.0)});
    if (i == result.points.size())
      result.points.push_back(p);
    result.corner.push_back(i);
  }
  return result;
}

} // namespace Atlas::internal

#endif
