// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace episcope::io {

/// How much brighter one view is than another, by the median ratio of grey levels of their pixels,
/// whichever of them show the same.
class PairGain {
 public:
  /// Grey levels (0 … 255); dark ones do not count.
  void add(float here, float there);
  /// What `there` is to be multiplied by; 1 where that is so within 2 %, or not known. Reorders
  /// what was added.
  [[nodiscard]] float value();

 private:
  std::vector<float> ratios_;
};

}  // namespace episcope::io
