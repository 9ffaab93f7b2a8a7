// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/report/report_files.h"
#include "app/benchmark/report/report_json.h"
#include "app/benchmark/run/benchmark.h"
#include "app/cli/verbs/benchmark_request.h"
#include "app/cli/verbs/benchmark_tasks.h"
#include "app/cli/verbs/verbs.h"

#include <fmt/format.h>
#include <algorithm>

#include <iostream>
#include <map>

namespace episcope::cli {
namespace {

/// A sentence for the exit code, if anything failed.
void require_success(const BenchmarkReport& report, const std::string& folder) {
  const auto failures = report.failures();
  if (failures.empty()) return;
  const std::string more =
      failures.size() == 1 ? "" : fmt::format(" (and {} more)", failures.size() - 1);
  std::string first = failures.front();
  if (first.ends_with('.')) first.pop_back();
  throw Error(first + more + "; the tables of the others are in " + folder);
}

void print_answer(const BenchmarkRequest& request, const BenchmarkReport& report) {
  if (request.is_json) {
    std::cout << report_to_json(report);
    return;
  }
  for (const TitledTable& titled : report_tables(report)) {
    std::cout << titled.title << '\n';
    if (!titled.note.empty()) std::cout << titled.note << '\n';
    std::cout << '\n' << table_to_text(titled.table) << '\n';
  }
  std::cout << (std::filesystem::path(request.output) / "index.html").string() << ": "
            << report.results.size() << " results, " << report.searched.size()
            << " points searched, " << report.reused << " taken from before\n";
}

// What a scene does to every method is said once.
void note_problems(const BenchmarkReport& report, Job& job) {
  std::map<std::pair<std::string, std::string>, std::string> entries;  // by scene and problem
  for (const auto& result : report.results) {
    if (result.problem.empty() || result.has_failed) continue;
    std::string& names = entries[{result.scene, result.problem}];
    names += (names.empty() ? "" : ", ") + result.entry;
  }
  for (const auto& [where, names] : entries) {
    job.note(names + " on " + where.first + ": " + where.second);
  }
}

/// Throws Unavailable if runs demand a device that this machine lacks; where they are planned, it
/// may.
void require_devices(const BenchmarkOptions& options) {
  for (const Estimator& method : options.methods) {
    const bool can = std::ranges::count(method.info.devices, options.device) > 0;
    if (can) require_device(options.device, method.info);
  }
}

/// Writes what a benchmark found out, of whatever machines.
void answer(const BenchmarkRequest& request, const BenchmarkReport& report, Job& job) {
  note_problems(report, job);
  job.finish();
  require_success(report, request.output);
  print_answer(request, report);
}

}  // namespace

void run_benchmark(const VerbArguments& arguments, std::stop_token stop) {
  BenchmarkRequest request;
  if (!parse_benchmark(arguments, request)) return;
  Job job(std::move(stop), request.job);
  if (request.makes_plan()) return plan_benchmark(arguments, request, job);
  if (request.follows_plan()) {
    const PlannedBenchmark planned = planned_benchmark(request, job);
    if (request.point) {
      require_devices(planned.options);
      return run_point(planned, request, job);
    }
    if (request.wants_status) return print_status(planned, request, job);
    return answer(request, planned.collect(job), job);
  }
  BenchmarkOptions options = benchmark_options(request);
  require_devices(options);
  options.inputs = benchmark_inputs(request, job);
  answer(request, episcope::run_benchmark(options, scene_loader(request, job), job.progress()),
         job);
}

}  // namespace episcope::cli
