// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_EXECUTION_H
#define ATLAS_CORE_EXECUTION_H

#include <Atlas/core/internal/library.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <type_traits>

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
  explicit Execution(unsigned threads = 1, Callback callback = {});

  /// The same threads and the same cancel flag, another listener.
  Execution with_callback(Callback callback) const;

  /// The number of threads that work at the same time.
  unsigned threads() const;

  /// Tells the listener that `fraction` of the stage is done. Returns `false` once the run is cancelled. A
  /// stage that sees `false` returns as soon as it can; its result is not used then.
  bool proceed(double fraction) const;

  /// Asks the listener whether to go on, without news: it hears the last fraction again. If another thread is
  /// talking to it, it is not asked. For steps inside of long work, milliseconds apart or more.
  bool proceed() const;

  /// Whether the listener, or `cancel()`, has ended the run.
  bool is_cancelled() const;
  /// Ends the run.
  void cancel() const;

  /// Calls `body(i)` for every i in [0, n), in any order and in parallel; exceptions reach the caller.
  /// Iterations that have not started when the run is cancelled are left out.
  template <typename Body>
  void for_each(std::size_t n, Body&& body) const
  {
    using Called = std::remove_reference_t<Body>;
    run(
        n,
        [](const void* called, std::size_t i) {
          (*const_cast<Called*>(static_cast<const Called*>(called)))(i);
        },
        std::addressof(body));
  }

private:
  struct State;

  /// Calls `call(body, i)` for every i in [0, n).
  void run(std::size_t n, void (*call)(const void*, std::size_t), const void* body) const;

  std::shared_ptr<State> state_;
  Callback callback_;
};

/// The stages of the pipeline, in the order in which they run.
enum class Stage { segmentation, parameterization, packing, verification };

/// All stages, for loops over them.
inline constexpr Stage all_stages[] = {Stage::segmentation, Stage::parameterization, Stage::packing,
                                       Stage::verification};

/// The name of a stage.
inline const char* name(Stage stage)
{
  switch (stage) {
  case Stage::segmentation:
    return "segmentation";
  case Stage::parameterization:
    return "parameterization";
  case Stage::packing:
    return "packing";
  case Stage::verification:
    return "verification";
  }
  return "unknown";
}

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/core/internal/Execution_impl.h>
#endif

#endif
