// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/job.h"

#include "app/cli/arguments.h"

#include <fmt/format.h>

#include <pthread.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <thread>

namespace episcope::cli {

void declare_job_options(Arguments& arguments, JobOptions& options) {
  options.run.declare(arguments, {run_schema().description("threads")});
  arguments.flag("-q,--quiet", options.is_quiet, "Show no progress bar and no notes");
}

Job::Job(std::stop_token stop, const JobOptions& options)
    : is_quiet_(options.is_quiet),
      bar_(options.is_quiet),
      progress_(
          std::move(stop), [this](const ProgressState& state) { bar_.draw(state); },
          options.run_options().threads) {}

void Job::note(const std::string& sentence) {
  notes_.push_back(sentence);
  if (is_quiet_) return;
  bar_.wipe();
  std::cerr << "note: " << sentence << '\n';
}

double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // Linux counts KiB
}

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

namespace {

// Ends the waiting thread; nobody else sends it.
constexpr int kEndOfWaiting = SIGUSR2;

/// Signals to wait for. One that the caller had ignored (nohup, a job in the background) stays so.
sigset_t awaited_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, kEndOfWaiting);
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_IGN) sigaddset(&signals, signal);
  }
  return signals;
}

void wait_for_signals(sigset_t signals, const std::stop_source& stop) {
  int signal = 0;
  while (sigwait(&signals, &signal) == 0 && signal != kEndOfWaiting) stop.request_stop();
}

/// The thread that waits, for `pass_on`.
std::atomic<pthread_t> waiting_thread;

// Libraries start threads before main that block no signal, and the system may choose one of these.
void pass_on(int signal) {
  pthread_kill(waiting_thread.load(), signal);
}

void handle(const sigset_t& signals, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  for (const int signal : {SIGINT, SIGTERM}) {
    if (sigismember(&signals, signal) == 1) sigaction(signal, &action, nullptr);
  }
}

}  // namespace

struct Interrupt::Waiter {
  sigset_t signals{};
  std::thread thread;
};

Interrupt::Interrupt() : waiter_(std::make_unique<Waiter>()) {
  waiter_->signals = awaited_signals();
  pthread_sigmask(SIG_BLOCK, &waiter_->signals, nullptr);
  waiter_->thread = std::thread(wait_for_signals, waiter_->signals, stop_);
  waiting_thread = waiter_->thread.native_handle();
  handle(waiter_->signals, pass_on);
}

Interrupt::~Interrupt() {
  // The exit code tells that it was cancelled: a second signal shall not take it back.
  handle(waiter_->signals, stop_.stop_requested() ? SIG_IGN : SIG_DFL);
  pthread_kill(waiter_->thread.native_handle(), kEndOfWaiting);
  waiter_->thread.join();
}

}  // namespace episcope::cli
