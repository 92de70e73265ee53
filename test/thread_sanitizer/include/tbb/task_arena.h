// SPDX-License-Identifier: MIT
// Stands in for TBB when the thread sanitizer looks: the library itself is not instrumented, so that the
// sanitizer does not see that its threads wait for each other. Here they are std::threads, which it knows.
#pragma once
namespace tbb {
class task_arena
{
public:
  void initialize(int threads) { threads_ = threads; }
  int max_concurrency() const { return threads_; }
  template <typename Body>
  void execute(const Body& body)
  {
    body();
  }

private:
  int threads_ = 1;
};
} // namespace tbb
