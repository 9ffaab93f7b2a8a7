// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"
#include "engine/core/progress.h"

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace episcope {

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
