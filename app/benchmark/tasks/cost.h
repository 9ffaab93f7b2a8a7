// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/benchmark/run/record.h"

#include <cstddef>

namespace episcope {

/// The size of a scene, as far as the time of a run depends on it.
struct SceneSize {
  std::size_t views = 0;
  std::size_t pixels = 0;  ///< Of one view.
};

/// Processor seconds that a run is expected to take: a constant of the method (measured, see the
/// source) times the pixels of all views that it reads. Rough, and measured on one small scene, but
/// enough to bundle short runs and to begin with the long ones.
[[nodiscard]] double estimated_seconds(const BenchmarkRun& run, const SceneSize& size);

/// Seconds to open such a scene, which every task spends again.
[[nodiscard]] double opening_seconds(const SceneSize& size);

}  // namespace episcope
