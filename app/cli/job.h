// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/cli/parameter_options.h"
#include "engine/core/error.h"
#include "engine/core/progress.h"
#include "engine/disparity/estimator.h"

#include <chrono>
#include <cstddef>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace episcope::cli {

/// One line of progress on standard error: bar, percentage, stage, time left. Draws nothing unless
/// standard error is a terminal. The line is wiped when the bar goes.
class ProgressBar {
 public:
  explicit ProgressBar(bool is_quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  [[nodiscard]] bool is_shown() const { return is_shown_; }
  /// To be called by one thread at a time.
  void draw(const ProgressState& state);
  /// Wipes the line, so that something else can be written; later states are drawn again.
  void wipe();

 private:
  using Clock = std::chrono::steady_clock;
  bool is_shown_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_draw_{};
  std::string last_step_;
};

/// The line for a state after `seconds`, at most `columns` wide.
[[nodiscard]] std::string progress_line(const ProgressState& state, double seconds, int columns);

class Arguments;

/// Options that every verb with something to wait for has.
struct JobOptions {
  bool is_quiet = false;
  ParameterOptions run;  ///< Of run_schema.

  [[nodiscard]] RunOptions run_options() const { return run_schema().parse(run.values()); }
};

void declare_job_options(Arguments& arguments, JobOptions& options);

/// Progress of a verb: shows the bar, ends with the token of Ctrl+C.
class Job {
 public:
  Job(std::stop_token stop, const JobOptions& options);

  [[nodiscard]] const Progress& progress() const { return progress_; }
  /// A sentence for the user on standard error, unless quiet; kept for answers in JSON.
  void note(const std::string& sentence);
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
  /// To be called before the answer is written.
  void finish() { bar_.wipe(); }

 private:
  bool is_quiet_;
  ProgressBar bar_;
  Progress progress_;
  std::vector<std::string> notes_;
};

/// Largest resident memory of this process so far.
[[nodiscard]] double peak_memory_mib();

/// Counts light fields, or what else there are several of, that failed while others continue.
class Failures {
 public:
  void add(const std::string& sentence) {
    if (count_++ == 0) first_ = sentence;
  }
  /// Throws Error, with the first sentence, if anything failed of `total`.
  void require_none(std::size_t total, const std::string& kind = "light fields") const {
    if (count_ == 0) return;
    throw Error(std::to_string(count_) + " of " + std::to_string(total) + " " + kind +
                " failed, the first: " + first_);
  }

 private:
  std::size_t count_ = 0;
  std::string first_;
};

/// Turns Ctrl+C (SIGINT) and SIGTERM into a stop request while it lives. Further signals change
/// nothing, since a stopping job first removes half-written files. Make it before any other thread:
/// it blocks the signals in the calling thread and all later threads, and waits for them in a
/// thread of its own.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }

 private:
  struct Waiter;
  std::stop_source stop_;
  std::unique_ptr<Waiter> waiter_;
};

}  // namespace episcope::cli
