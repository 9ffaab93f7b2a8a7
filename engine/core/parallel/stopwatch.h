// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace episcope {

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
