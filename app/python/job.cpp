// SPDX-License-Identifier: BSD-3-Clause
#include "app/python/job.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stop_token>
#include <thread>

namespace episcope::python {
namespace {

namespace py = pybind11;

constexpr std::chrono::milliseconds kLookAgain{20};

/// What the working thread tells the waiting one.
class Messages {
 public:
  void report(const ProgressState& state) {
    const std::scoped_lock lock(lock_);
    state_ = state;
  }
  void end() {
    const std::scoped_lock lock(lock_);
    has_ended_ = true;
    ended_.notify_one();
  }
  /// Waits a moment; whether the work has ended.
  [[nodiscard]] bool wait() {
    std::unique_lock lock(lock_);
    return ended_.wait_for(lock, kLookAgain, [this] { return has_ended_; });
  }
  /// What was reported since the last call.
  [[nodiscard]] std::optional<ProgressState> take() {
    const std::scoped_lock lock(lock_);
    return std::exchange(state_, std::nullopt);
  }

 private:
  std::mutex lock_;
  std::condition_variable ended_;
  std::optional<ProgressState> state_;
  bool has_ended_ = false;
};

/// Raises what signals raise, and what the listener does.
void look_up(const py::object& listener, Messages& messages) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (listener.is_none()) return;
  if (const auto state = messages.take()) listener(state->fraction, state->step);
}

}  // namespace

void run_job(const py::object& listener, int threads,
             const std::function<void(const Progress&)>& work) {
  std::stop_source stop;
  Messages messages;
  std::exception_ptr failure;  // Of the work,
  std::exception_ptr raised;   // and of what was called meanwhile.
  {
    const py::gil_scoped_release without_lock;
    const std::jthread worker([&] {
      try {
        work(Progress(
            stop.get_token(), [&](const ProgressState& state) { messages.report(state); },
            threads));
      } catch (...) {
        failure = std::current_exception();
      }
      messages.end();
    });
    for (bool has_ended = false; !has_ended;) {
      has_ended = messages.wait();
      if (raised) continue;
      const py::gil_scoped_acquire lock;
      try {
        look_up(listener, messages);
      } catch (...) {
        raised = std::current_exception();
        stop.request_stop();
      }
    }
  }
  if (raised) std::rethrow_exception(raised);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace episcope::python
