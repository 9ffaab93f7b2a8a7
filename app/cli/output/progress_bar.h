// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/progress.h"

#include <chrono>
#include <string>

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
  /// Wipes the line, so that something else can be written; drawing goes on after that.
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

}  // namespace episcope::cli
