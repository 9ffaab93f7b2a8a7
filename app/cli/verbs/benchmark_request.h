// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/benchmark/run/benchmark.h"
#include "app/cli/arguments/parameter_options.h"
#include "app/cli/cluster/slurm.h"
#include "app/cli/input/input.h"
#include "app/cli/output/job.h"
#include "app/cli/verbs/verbs.h"
#include "engine/labeling/labeler_parameters.h"

#include <optional>
#include <string>
#include <vector>

namespace episcope::cli {

/// Whether to submit to Slurm, with which options of sbatch.
struct SlurmRequest {
  bool is_wanted = false;
  std::vector<std::string> options;
};

/// What a command line of `benchmark` asks for.
struct BenchmarkRequest {
  std::vector<std::string> inputs;
  std::vector<std::string> submissions;
  std::optional<std::vector<Estimator>> methods;
  bool has_labels = false;
  std::optional<std::vector<FeatureSet>> features;
  std::optional<std::vector<Regularizer>> regularizers;
  std::optional<std::string> scribbles;  ///< Folder of SCRIBBLES, each named after a scene.
  std::string output;
  bool has_search = false;
  bool is_json = false;
  ParameterOptions profile;
  JobOptions job;
  ReadOptions read;

  SlurmRequest slurm;
  std::optional<std::string> plan_file;
  std::optional<int> point;
  bool collects = false;
  bool wants_status = false;
  std::optional<double> task_seconds;

  [[nodiscard]] bool makes_plan() const { return slurm.is_wanted || plan_file; }
  /// Whether a plan that is there says what to run.
  [[nodiscard]] bool follows_plan() const { return point || collects || wants_status; }
};

/// Returns and throws as `Arguments::parse`.
[[nodiscard]] bool parse_benchmark(const VerbArguments& arguments, BenchmarkRequest& request);

/// All but the inputs.
[[nodiscard]] BenchmarkOptions benchmark_options(const BenchmarkRequest& request);

}  // namespace episcope::cli
