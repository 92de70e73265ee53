// SPDX-License-Identifier: MIT
// Stands in for TBB when the thread sanitizer looks: the library itself is not instrumented, so that the
// sanitizer does not see that its threads wait for each other. Here they are std::threads, which it knows.
#pragma once
namespace tbb::info {
inline int default_concurrency()
{
  return 4;
}
} // namespace tbb::info
