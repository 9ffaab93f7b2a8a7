// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/benchmark/run/benchmark.h"

#include <set>
#include <string>

namespace episcope {

/// A scene of a benchmark while it is in memory.
struct OpenScene {
  Scene scene;
  std::string name;   ///< Unique in the benchmark.
  std::string input;  ///< As it was asked for.
  std::string fingerprint;
  std::string labels_fingerprint;  ///< With all that labels depend on; empty unless wanted.
  Interval range;

  /// 16 hexadecimal digits that change with all that the runs of a benchmark depend on.
  [[nodiscard]] std::string whole_fingerprint() const;
};

/// Opens an input; its name differs from all that are `taken`. Throws what `load` throws.
[[nodiscard]] OpenScene open_benchmark_scene(const BenchmarkOptions& options,
                                             const std::string& input, const SceneLoader& load,
                                             const std::set<std::string>& taken,
                                             const Progress& progress);

/// Throws InvalidInput if the scene is not the one that had this fingerprint when a plan was made.
void require_unchanged(const OpenScene& open, const std::string& whole_fingerprint);

/// `wanted`, with a number behind it if that is taken.
[[nodiscard]] std::string unused_name(const std::string& wanted,
                                      const std::set<std::string>& taken);

}  // namespace episcope
