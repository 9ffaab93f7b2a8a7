// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/tasks/bundle.h"

namespace episcope {

std::vector<std::size_t> bundle_starts(const std::vector<double>& seconds, double least_seconds) {
  std::vector<std::size_t> starts;
  double sum = 0;
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    if (starts.empty() || sum >= least_seconds) {
      starts.push_back(i);
      sum = 0;
    }
    sum += seconds[i];
  }
  return starts;
}

}  // namespace episcope
