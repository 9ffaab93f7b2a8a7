// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/progress.h"

#include <cstddef>
#include <string>
#include <vector>

namespace episcope {

/// Divides a progress into items by the time that each is expected to take, so that the time left
/// means something.
class Workload {
 public:
  explicit Workload(const Progress& progress) : progress_(progress) {}

  /// To be called for every item before the first begins.
  void expect(double seconds);
  /// The part of the next item, titled.
  [[nodiscard]] Progress next(const std::string& title);
  /// Passes over items that will not be done.
  void skip(std::size_t count);

 private:
  Progress progress_;
  std::vector<double> ends_;  ///< Expected seconds up to the end of each item.
  std::size_t done_ = 0;
};

}  // namespace episcope
