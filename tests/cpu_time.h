// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/patience.h"

#include <ctime>
#include <thread>

namespace episcope {

/// Computing time of this process, all its threads together: unlike the clock on the wall it does
/// not depend on what else the machine does.
inline double cpu_time_ms() {
  return 1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// What may be computed after a stop was asked for: 200 ms on every core.
inline double cpu_limit_of_a_stop_ms() {
  return 200.0 * kSlowdown * static_cast<double>(std::thread::hardware_concurrency());
}

}  // namespace episcope
