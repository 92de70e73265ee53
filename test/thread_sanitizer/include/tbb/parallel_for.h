// SPDX-License-Identifier: MIT
// Stands in for TBB when the thread sanitizer looks: the library itself is not instrumented, so that the
// sanitizer does not see that its threads wait for each other. Here they are std::threads, which it knows.
#pragma once
#include <atomic>
#include <exception>
#include <latch>
#include <mutex>
#include <tbb/blocked_range.h>
#include <thread>
#include <vector>
namespace tbb {
/// Four threads that start together and take one number after the other.
template <typename Value, typename Body>
void parallel_for(const blocked_range<Value>& range, const Body& body)
{
  std::atomic<Value> next{range.begin()};
  std::exception_ptr failure;
  std::mutex mutex;
  // Relaxed, so that taking a number orders nothing else and hides no race.
  const auto take = [&] { return next.fetch_add(1, std::memory_order_relaxed); };
  std::latch start(4);
  const auto work = [&] {
    start.arrive_and_wait();
    for (Value i = take(); i < range.end(); i = take())
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
