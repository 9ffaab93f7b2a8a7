// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"

#include <chrono>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>

namespace episcope {

/// Report of a running computation.
struct ProgressState {
  double fraction = 0;  ///< Of the whole job, in [0, 1], never falling.
  std::string step;     ///< The stage, e.g. "vertical EPIs".
};

/// The link between a computation and whoever waits for it: the computation reports its progress
/// and learns whether it should stop; the waiting side also limits the number of threads. Cheap to
/// copy; copies refer to the same job. All members may be called from any thread.
class Progress {
 public:
  using Listener = std::function<void(const ProgressState&)>;

  /// Nobody listens and nothing stops. `threads` 0 = as many as the machine has.
  explicit Progress(int threads = 0);
  /// `listener` is called from the computing threads, one call at a time; it must not block.
  Progress(std::stop_token stop, Listener listener, int threads = 0);
  /// As before; a stop of `finish` asks an iterative method for what it has (`finish_requested`).
  Progress(std::stop_token stop, std::stop_token finish, Listener listener, int threads = 0);

  /// Reports that `fraction` in [0, 1] of this part is done. Throttled to 1/1000 of the job.
  void report(double fraction) const;
  /// Names the stage that begins now.
  void step(const std::string& text) const;
  /// Throws Cancelled if a stop was requested.
  void check() const;
  [[nodiscard]] bool stop_requested() const;
  /// Whether the best result so far is preferred to waiting: an iterative method then ends its
  /// iteration and continues with what it has, as if it had converged.
  [[nodiscard]] bool finish_requested() const;
  [[nodiscard]] int threads() const;

  /// A progress for the part [begin, end] of this one.
  [[nodiscard]] Progress part(double begin, double end) const;
  /// This one, for a computation that may use at most `threads` threads; 0 = no fewer than before.
  [[nodiscard]] Progress limited_to(int threads) const;
  /// This one, for a computation that should stay on the calling thread because many of them run in
  /// parallel.
  [[nodiscard]] Progress on_one_thread() const { return limited_to(1); }
  /// This one, with "<title>: " before the name of every stage.
  [[nodiscard]] Progress titled(const std::string& title) const;

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;
  double begin_ = 0;
  double end_ = 1;
  int threads_ = 1;
  std::string title_;
};

/// Measures wall-clock time from its construction.
class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
  }

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point start_ = Clock::now();
};

/// How a job ended: with a value, cancelled, or with an exception.
template <class T>
struct Outcome {
  std::optional<T> value;
  std::exception_ptr failure;
  [[nodiscard]] bool was_cancelled() const { return !value && !failure; }
};

using JobId = std::uint64_t;

/// Runs jobs one after the other on a thread of its own. A job receives values and returns a value.
/// All its messages go through `post`, which hands a closure to the owner's thread: a queued call
/// in the window, inline in the command line, a deque in tests.
///
/// All members must be called on the owner's thread. The destructor requests a stop of every job
/// and waits for the running one, which ends within 200 ms if it checks its progress as required;
/// outcomes of those jobs are not delivered.
class JobRunner {
 public:
  using Post = std::function<void(std::function<void()>)>;
  using OnProgress = std::function<void(const ProgressState&)>;

  explicit JobRunner(Post post);
  ~JobRunner();
  JobRunner(const JobRunner&) = delete;
  JobRunner& operator=(const JobRunner&) = delete;

  /// Queues `work(progress) -> T`. `done(outcome)` is posted exactly once; `on_progress` is posted
  /// at most as often as the owner keeps up (states in between are dropped).
  template <class T>
  JobId start(std::function<T(const Progress&)> work, std::function<void(Outcome<T>)> done,
              OnProgress on_progress = nullptr) {  // NOLINT(performance-unnecessary-value-param)
    auto outcome = std::make_shared<Outcome<T>>();
    return enqueue(
        [work = std::move(work), outcome](const Progress& progress) {
          try {
            outcome->value.emplace(work(progress));
          } catch (const Cancelled&) {
          } catch (...) {
            outcome->failure = std::current_exception();
          }
        },
        [done = std::move(done), outcome] { done(std::move(*outcome)); }, std::move(on_progress));
  }

  /// Asks a queued or running job to stop; its outcome says whether it did. Unknown ids are
  /// ignored.
  void cancel(JobId id);
  /// Asks a running job for the best result so far (Progress::finish_requested); a queued one ends
  /// at its first check. Unknown ids are ignored.
  void finish(JobId id);
  void cancel_all();

  /// Jobs queued or running.
  [[nodiscard]] int pending() const;

 private:
  JobId enqueue(std::function<void(const Progress&)> run, std::function<void()> finish,
                OnProgress on_progress);

  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace episcope
