// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_EXECUTION_IMPL_H
#define ATLAS_CORE_INTERNAL_EXECUTION_IMPL_H

#include <Atlas/core/Execution.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <utility>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace Atlas {

struct Execution::State
{
  std::mutex mutex;
  double fraction = 0; ///< the last one told
  std::atomic<bool> cancelled{false};
  unsigned threads = 1;
#ifdef CGAL_LINKED_WITH_TBB
  tbb::task_arena arena;
#endif
};

ATLAS_INLINE Execution::Execution(unsigned threads, Callback callback)
    : state_(std::make_shared<State>()), callback_(std::move(callback))
{
#ifdef CGAL_LINKED_WITH_TBB
  // More threads than cores gain nothing, and TBB complains about them on the console.
  const int cores = tbb::info::default_concurrency();
  state_->arena.initialize(threads == 0 ? cores
                                        : std::min(static_cast<int>(std::min(threads, 1u << 16)), cores));
  state_->threads = static_cast<unsigned>(state_->arena.max_concurrency());
#else
  (void)threads;
#endif
}

ATLAS_INLINE Execution Execution::with_callback(Callback callback) const
{
  Execution copy(*this);
  copy.callback_ = std::move(callback);
  return copy;
}

ATLAS_INLINE unsigned Execution::threads() const
{
  return state_->threads;
}

ATLAS_INLINE bool Execution::proceed(double fraction) const
{
  if (callback_ && !is_cancelled()) {
    const std::lock_guard<std::mutex> lock(state_->mutex);
    state_->fraction = fraction;
    if (!callback_(fraction))
      state_->cancelled = true;
  }
  return !is_cancelled();
}

ATLAS_INLINE bool Execution::proceed() const
{
  if (callback_ && !is_cancelled()) {
    const std::unique_lock<std::mutex> lock(state_->mutex, std::try_to_lock);
    if (lock && !callback_(state_->fraction))
      state_->cancelled = true;
  }
  return !is_cancelled();
}

ATLAS_INLINE bool Execution::is_cancelled() const
{
  return state_->cancelled;
}

ATLAS_INLINE void Execution::cancel() const
{
  state_->cancelled = true;
}

ATLAS_INLINE void Execution::run(std::size_t n, void (*call)(const void*, std::size_t),
                                 const void* body) const
{
  const auto guarded = [&](std::size_t i) {
    if (!is_cancelled())
      call(body, i);
  };
#ifdef CGAL_LINKED_WITH_TBB
  if (threads() > 1 && n > 1) {
    state_->arena.execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 1), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i)
          guarded(i);
      });
    });
    return;
  }
#endif
  for (std::size_t i = 0; i < n; ++i)
    guarded(i);
}

} // namespace Atlas

#endif
