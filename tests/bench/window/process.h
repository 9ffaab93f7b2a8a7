// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope::bench {

/// What this process takes, as the system counts it.
struct Process {
  double memory_mib = 0;       ///< In memory now, mapped files included.
  double most_memory_mib = 0;  ///< The most so far.
  int files = 0;               ///< Open descriptors.
  int threads = 0;
  double cpu_s = 0;  ///< Of all threads.
};

[[nodiscard]] Process this_process();

}  // namespace episcope::bench
