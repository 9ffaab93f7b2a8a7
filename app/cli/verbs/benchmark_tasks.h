// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/benchmark/run/benchmark.h"
#include "app/benchmark/tasks/plan.h"
#include "app/cli/verbs/benchmark_request.h"

#include <string>
#include <vector>

namespace episcope::cli {

/// What opens the light fields that the INPUTs of a benchmark stand for.
[[nodiscard]] std::vector<std::string> benchmark_inputs(const BenchmarkRequest& request, Job& job);

/// Opens them by the reading options; warnings become notes. Borrows both.
[[nodiscard]] SceneLoader scene_loader(const BenchmarkRequest& request, Job& job);

/// Makes the plan, keeps it in the output folder, and writes it to a file or submits its unfinished
/// tasks to Slurm. `arguments`: of the verb, for whoever runs a task.
void plan_benchmark(const VerbArguments& arguments, const BenchmarkRequest& request, Job& job);

/// A plan with what it was made of.
struct PlannedBenchmark {
  BenchmarkPlan plan;
  BenchmarkRequest request;  ///< Of the command line that made the plan.
  BenchmarkOptions options;

  [[nodiscard]] BenchmarkReport collect(Job& job) const;
};

/// The plan in the output folder; the working folder becomes that of the command line that made it.
/// Throws IoError if there is none, InvalidInput if it is one of other inputs, settings, or another
/// version of the program.
[[nodiscard]] PlannedBenchmark planned_benchmark(const BenchmarkRequest& request, Job& job);

/// Runs a task. Throws Error if one of its points fails.
void run_point(const PlannedBenchmark& planned, const BenchmarkRequest& request, Job& job);

void print_status(const PlannedBenchmark& planned, const BenchmarkRequest& request, Job& job);

}  // namespace episcope::cli
