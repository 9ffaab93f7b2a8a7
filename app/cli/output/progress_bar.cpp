// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/output/progress_bar.h"

#include <fmt/format.h>

#include <sys/ioctl.h>
#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace episcope::cli {
namespace {

constexpr const char* kWipeLine = "\r\x1b[K";

int terminal_columns() {
  winsize size{};
  constexpr int usual = 80;
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual;
}

std::string time_left(double fraction, double seconds) {
  // Too early to tell before the first second or two per cent.
  if (seconds < 1 || fraction < 0.02) return "";
  const long left = std::lround(seconds * (1 - fraction) / fraction);
  if (left < 60) return fmt::format(", {} s left", left);
  return fmt::format(", {} min {} s left", left / 60, left % 60);
}

}  // namespace

std::string progress_line(const ProgressState& state, double seconds, int columns) {
  constexpr int bar_width = 24;
  const int filled = static_cast<int>(std::clamp(state.fraction, 0.0, 1.0) * bar_width);
  std::string line = fmt::format("[{:.<{}}] {:3} %  {}{}", std::string(filled, '#'), bar_width,
                                 std::lround(100 * state.fraction), state.step,
                                 time_left(state.fraction, seconds));
  if (static_cast<int>(line.size()) >= columns) line.resize(std::max(0, columns - 1));
  return line;
}

ProgressBar::ProgressBar(bool is_quiet) : is_shown_(!is_quiet && isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  wipe();
}

void ProgressBar::wipe() {
  if (!is_shown_) return;
  std::fputs(kWipeLine, stderr);
  std::fflush(stderr);
}

void ProgressBar::draw(const ProgressState& state) {
  constexpr auto interval = std::chrono::milliseconds(100);
  const auto now = Clock::now();
  if (!is_shown_ || (now - last_draw_ < interval && state.step == last_step_)) return;
  last_draw_ = now;
  last_step_ = state.step;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  std::fputs((kWipeLine + progress_line(state, seconds, terminal_columns())).c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace episcope::cli
