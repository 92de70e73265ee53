// SPDX-License-Identifier: MIT
#ifndef ATLAS_PYTHON_CONVERSATION_H
#define ATLAS_PYTHON_CONVERSATION_H

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace Atlas::python {

/// \brief Work on a thread of its own, while the thread that asked for it waits, answers questions of the
/// work, and looks around from time to time.
///
/// So Python's callbacks run where they were given, signals such as Ctrl-C are seen, and the work never holds
/// the interpreter's lock.
template <typename Question>
class Conversation
{
public:
  using Work = std::function<void()>;

  /// \param answer  whether to go on; called by the waiting thread
  /// \param look    the same without a question, about 20 times a second
  /// Exceptions of all three reach the caller, once the work has ended.
  void hold(const Work& work, const std::function<bool(const Question&)>& answer,
            const std::function<bool()>& look)
  {
    std::thread worker([&] {
      try {
        work();
      } catch (...) {
        failure_ = std::current_exception();
      }
      const std::lock_guard<std::mutex> lock(mutex_);
      is_done_ = true;
      changed_.notify_all();
    });
    try {
      wait(answer, look);
    } catch (...) {
      end();
      worker.join();
      throw;
    }
    worker.join();
    if (failure_)
      std::rethrow_exception(failure_);
  }

  /// For the work: asks, and waits for the answer.
  bool ask(const Question& question)
  {
    std::unique_lock<std::mutex> lock(mutex_);
    question_ = question;
    changed_.notify_all();
    changed_.wait(lock, [&] { return !question_ || !goes_on_; });
    return goes_on_;
  }

  bool goes_on() const { return goes_on_; }

private:
  void wait(const std::function<bool(const Question&)>& answer, const std::function<bool()>& look)
  {
    std::unique_lock<std::mutex> lock(mutex_);
    while (!is_done_) {
      changed_.wait_for(lock, std::chrono::milliseconds(50), [&] { return is_done_ || question_; });
      if (is_done_)
        return;
      const std::optional<Question> question = question_;
      lock.unlock();
      const bool goes_on = goes_on_ && look() && (!question || answer(*question));
      lock.lock();
      goes_on_ = goes_on;
      if (question)
        question_.reset();
      changed_.notify_all();
    }
  }

  void end()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    goes_on_ = false;
    question_.reset();
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Question> question_;
  std::atomic<bool> goes_on_{true};
  bool is_done_ = false;
  std::exception_ptr failure_;
};

} // namespace Atlas::python

#endif
