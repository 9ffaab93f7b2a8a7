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

/// Until `has_ended`, which is looked at between events. `input` gets a number that grows.
[[nodiscard]] std::vector<double> event_ages(QObject& window, const std::function<void(int)>& input,
                                             const std::function<bool()>& has_ended,
                                             int patience_ms);

/// Below which a share of the values is.
[[nodiscard]] double percentile(std::vector<double> values, double share);

}  // namespace episcope::bench
