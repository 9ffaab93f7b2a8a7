// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/bench/window/late_stacks.h"

#include <QApplication>

#include <chrono>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace episcope::bench {

/// What this thread computed so far, in ms.
[[nodiscard]] double thread_cpu_ms();
/// How long the program's first thread was ready to run so far while others had the processors.
[[nodiscard]] double waited_for_processor_ms();

/// From here an event is late.
inline constexpr double kLate_ms = 50;

/// Times every event that the thread of windows handles, by its kind and receiver: how long it
/// took, and how much of that the thread computed itself. What an event waits for (other threads,
/// other programs, the display) is the difference.
class TimedApplication : public QApplication {
 public:
  using QApplication::QApplication;

  bool notify(QObject* receiver, QEvent* event) override;

  /// Forgets what was timed until now, and times from now on.
  void begin();
  /// To be called when an event is handled that waited for so long: keeps what was done meanwhile.
  void noteLate(double age_ms);
  /// Prints what computed longest at once, then the sums, then what made events late.
  void report() const;

 private:
  struct Cost {
    int count = 0;
    double wall_ms = 0;
    double cpu_ms = 0;
    double most_wall_ms = 0;
    double most_cpu_ms = 0;
  };

  using Clock = std::chrono::steady_clock;
  /// An event that was handled.
  struct Handled {
    std::string name;
    Clock::time_point begin;
    double wall_ms = 0;
    double cpu_ms = 0;
    double waited_ms = 0;  // for a processor
    long faults = 0;       // of pages
    std::vector<Stack> stacks{};
  };
  /// A time in which events had to wait.
  struct Delay {
    double age_ms = 0;  // of the event that waited longest
    int events = 0;     // that waited too long
    Clock::time_point end;
    double waited_ms = 0;
    std::vector<Handled> handled;  // meanwhile, if it took any time
  };

  void note(Handled handled);
  void beginWork(const std::string& name);
  void endWork();
  void reportDelays() const;

  bool is_timing_ = false;
  Handled now_;  // what is being done
  double cpu_begin_ms_ = 0;
  int depth_ = 0;  // events that others send are part of those
  std::map<std::string, Cost> costs_;
  std::deque<Handled> latest_;
  std::deque<std::pair<Clock::time_point, double>> waits_{};  // for a processor until then, in ms
  std::vector<Delay> delays_;
  std::optional<LateStacks> stacks_;
};

}  // namespace episcope::bench
