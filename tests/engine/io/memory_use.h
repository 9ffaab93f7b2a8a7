// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

namespace episcope::test {

/// The memory that this process takes at most from now on, beyond what it holds already.
class PeakMemory {
 public:
  PeakMemory() : before_(bytes("VmRSS:")) { std::ofstream("/proc/self/clear_refs") << "5"; }

  /// 0 under a sanitizer, which keeps what was freed.
  [[nodiscard]] std::uintmax_t used() const {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    return 0;
#endif
    const std::uintmax_t peak = bytes("VmHWM:");
    return peak > before_ ? peak - before_ : 0;
  }

 private:
  static std::uintmax_t bytes(const std::string& key) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
      std::uintmax_t kib = 0;
      if (word == key && status >> kib) return kib << 10;
    }
    return 0;
  }
  std::uintmax_t before_;
};

}  // namespace episcope::test
