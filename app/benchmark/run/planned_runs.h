// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/benchmark/run/benchmark.h"
#include "app/benchmark/run/record.h"

#include <cstddef>
#include <vector>

namespace episcope {

/// A run that a benchmark makes on every scene.
struct PlannedRun {
  BenchmarkRun run;
  std::size_t index = 0;  ///< Of the method, for labels of the way, in the options.
  ParameterSet point{};   ///< Of a search: the parameters that are searched.
};

/// All runs on a scene: methods for the tables, ways to label, then point by point the search of
/// each method. Searches need a true disparity.
[[nodiscard]] std::vector<PlannedRun> planned_runs(const BenchmarkOptions& options);

}  // namespace episcope
