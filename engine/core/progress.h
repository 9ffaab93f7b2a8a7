// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>

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

}  // namespace episcope
