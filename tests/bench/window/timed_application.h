// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QApplication>

#include <map>
#include <string>

namespace episcope::bench {

/// What this thread computed so far, in ms.
[[nodiscard]] double thread_cpu_ms();

/// Times every event that the thread of windows handles, by its kind and receiver: how long it
/// took, and how much of that the thread computed itself. What an event waits for (other threads,
/// other programs, the display) is the difference.
class TimedApplication : public QApplication {
 public:
  using QApplication::QApplication;

  bool notify(QObject* receiver, QEvent* event) override;

  /// Forgets what was timed until now, and times from now on.
  void begin();
  /// Prints what computed longest at once, then the sums.
  void report() const;

 private:
  struct Cost {
    int count = 0;
    double wall_ms = 0;
    double cpu_ms = 0;
    double most_wall_ms = 0;
    double most_cpu_ms = 0;
  };

  bool is_timing_ = false;
  int depth_ = 0;  // events that others send are part of those
  std::map<std::string, Cost> costs_;
};

}  // namespace episcope::bench
