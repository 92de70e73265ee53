// SPDX-License-Identifier: MIT
// Stands in for TBB when the thread sanitizer looks: the library itself is not instrumented, so that the
// sanitizer does not see that its threads wait for each other. Here they are std::threads, which it knows.
#pragma once
#include <atomic>
#include <exception>
#include <mutex>
#include <tbb/blocked_range.h>
#include <thread>
#include <vector>
namespace tbb {
/// Four threads that take one number after the other.
template <typename Value, typename Body>
void parallel_for(const blocked_range<Value>& range, const Body& body)
{
  std::atomic<Value> next{range.begin()};
  std::exception_ptr failure;
  std::mutex mutex;
  const auto work = [&] {
    for (Value i = next++; i < range.end(); i = next++)
      try {
        body(blocked_range<Value>(i, i + 1));
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex);
        failure = std::current_exception();
      }
  };
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back(work);
  for (std::thread& thread : threads)
    thread.join();
  if (failure)
    std::rethrow_exception(failure);
}
} // namespace tbb
