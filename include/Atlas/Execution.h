// SPDX-License-Identifier: MIT
#ifndef ATLAS_EXECUTION_H
#define ATLAS_EXECUTION_H

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace Atlas {

/// \brief How a stage runs: on how many threads, whom it tells how far it is, and whether it has been
/// cancelled.
///
/// Every stage takes one. Results never depend on the number of threads. Copies share the cancel flag.
class Execution
{
public:
  /// Called with the fraction of the stage that is done, in [0, 1], from one thread at a time.
  /// Returning `false` cancels.
  using Callback = std::function<bool(double)>;

  /// \param threads number of threads; 0 takes all cores, 1 is sequential. Without TBB everything is
  /// sequential.
  explicit Execution(unsigned threads = 1, Callback callback = {})
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

  /// The same threads and the same cancel flag, another listener.
  Execution with_callback(Callback callback) const
  {
    Execution copy(*this);
    copy.callback_ = std::move(callback);
    return copy;
  }

  unsigned threads() const
  {
    return state_->threads;
  }

  /// Tells that `fraction` of the stage is done; returns `false` once the caller has asked to stop. A stage
  /// that sees `false` returns as soon as it can; what it returns then is not used.
  bool proceed(double fraction) const
  {
    if (callback_ && !is_cancelled()) {
      const std::lock_guard<std::mutex> lock(state_->mutex);
      state_->fraction = fraction;
      if (!callback_(fraction))
        state_->cancelled = true;
    }
    return !is_cancelled();
  }

  /// Asks whether to go on, without news: the listener hears the last fraction again, unless it is listening
  /// to another thread. For steps inside long work, milliseconds apart or more.
  bool proceed() const
  {
    if (callback_ && !is_cancelled()) {
      const std::unique_lock<std::mutex> lock(state_->mutex, std::try_to_lock);
      if (lock && !callback_(state_->fraction))
        state_->cancelled = true;
    }
    return !is_cancelled();
  }

  bool is_cancelled() const
  {
    return state_->cancelled;
  }
  void cancel() const
  {
    state_->cancelled = true;
  }

  /// Calls `body(i)` for every i in [0, n), in any order and in parallel; exceptions reach the caller.
  /// Iterations that have not started when the run is cancelled are left out.
  template <typename Body>
  void for_each(std::size_t n, Body&& body) const
  {
    const auto guarded = [&](std::size_t i) {
      if (!is_cancelled())
        body(i);
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

private:
  struct State
  {
    std::mutex mutex;
    double fraction = 0; ///< the last one told
    std::atomic<bool> cancelled{false};
    unsigned threads = 1;
#ifdef CGAL_LINKED_WITH_TBB
    tbb::task_arena arena;
#endif
  };
  std::shared_ptr<State> state_;
  Callback callback_;
};

} // namespace Atlas

#endif
