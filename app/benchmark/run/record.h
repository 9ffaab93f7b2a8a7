// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/named.h"
#include "engine/core/parameter/parameter.h"
#include "engine/disparity/common/estimator.h"
#include "engine/evaluation/tables/benchmark_result.h"

#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// What a run is for. The names are those of the log.
enum class RunKind {
  Table,   ///< A method, judged for the tables,
  Search,  ///< or as a point of a search.
  Labels   ///< Labels from strokes.
};
[[nodiscard]] Names<RunKind> names_of(RunKind);

/// What is run: a method, or a way to label, with parameters.
struct BenchmarkRun {
  RunKind kind = RunKind::Table;
  std::string method;
  int revision = 1;         ///< EstimatorInfo::revision.
  ParameterSet parameters;  ///< All of the method.
  ViewSelection views = ViewSelection::Center;
  /// What was demanded, if the method computes there; else Auto.
  Device device = Device::Auto;
};

/// `point` over the defaults of the method.
[[nodiscard]] BenchmarkRun plan_run(const Estimator& estimator, const ParameterSet& point,
                                    const RunOptions& options, RunKind kind);

/// Names the result of a run on a scene with this fingerprint, by all that it depends on, the
/// version of the program included.
[[nodiscard]] std::string record_key(const BenchmarkRun& run, const std::string& fingerprint);

/// One finished run, a line of the log.
struct BenchmarkRecord {
  std::string key;
  std::string input;  ///< The scene as it was asked for.
  BenchmarkRun run;
  BenchmarkResult result;
  std::vector<std::string> files;  ///< Written by the run, below the folder of the benchmark.
};

/// One line of JSON, without its end.
[[nodiscard]] std::string record_to_json(const BenchmarkRecord& record);
/// Empty for a line that is no record.
[[nodiscard]] std::optional<BenchmarkRecord> record_from_json(const std::string& line);

}  // namespace episcope
