// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_MERGING_TRIAL_MEMORY_H
#define ATLAS_SEGMENTATION_INTERNAL_MERGING_TRIAL_MEMORY_H

#include <Atlas/core/Chart.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief What trials of merging found, by the chart that was flattened. Safe to use from several threads.
///
/// Orders of merging have most of their trials in common, and a second sweep repeats what was refused in the
/// first. A verdict depends on the chart alone, so it does not matter who found it.
class Trial_memory
{
public:
  struct Verdict
  {
    bool is_accepted = false;
    std::vector<Point_2> uv; ///< of an accepted chart
  };
  /// Two hash values of all that tells charts of one surface apart: which triangles, glued how.
  using Key = std::array<std::uint64_t, 2>;

  static Key key(const Chart& chart, bool is_slit)
  {
    Key result{is_slit ? 1u : 2u, 3};
    const auto add = [&](std::uint64_t x) {
      result[0] = mixed(result[0] ^ x, 0x9E3779B97F4A7C15u);
      result[1] = mixed(result[1] + x, 0xC2B2AE3D27D4EB4Fu);
    };
    for (const Index t : chart.source)
      add(t);
    for (const auto& triangle : chart.triangles)
      for (const Index v : triangle)
        add(v);
    return result;
  }

  std::optional<Verdict> find(const Key& key) const
  {
    const std::lock_guard lock(mutex_);
    const auto found = verdicts_.find(key);
    return found == verdicts_.end() ? std::nullopt : std::optional(found->second);
  }

  /// Remembers a verdict while there is room.
  void remember(const Key& key, Verdict verdict)
  {
    const std::lock_guard lock(mutex_);
    size_ += verdict.uv.size() + least_size;
    if (size_ <= most)
      verdicts_.emplace(key, std::move(verdict));
  }

private:
  static constexpr std::size_t most = 4'000'000, least_size = 8; ///< points, or as much memory

  static std::uint64_t mixed(std::uint64_t x, std::uint64_t factor)
  {
    x *= factor;
    return x ^ (x >> 29);
  }

  mutable std::mutex mutex_;
  std::map<Key, Verdict> verdicts_;
  std::size_t size_ = 0;
};

} // namespace Atlas::internal

#endif
