// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <vector>

class QObject;

namespace episcope::bench {

/// How late the thread of windows handles events: one is posted every 5 ms from another thread, and
/// tells its age in ms when it is handled. Every `kEventsPerInput`-th of them gives an input first
/// after that, so that what the input costs is in the age of the next one.
inline constexpr int kEventsPerInput = 4;

struct Probe {
  std::function<void(int)> input;      ///< Gets a number that grows.
  std::function<bool()> has_ended;     ///< Looked at between events.
  int patience_ms = 0;                 ///< Ends in any case after this.
  std::function<void(double)> on_age;  ///< Told each age at once; may be empty.
};

[[nodiscard]] std::vector<double> event_ages(QObject& window, const Probe& probe);

/// Below which a share of the values is.
[[nodiscard]] double percentile(std::vector<double> values, double share);

}  // namespace episcope::bench
