// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <stop_token>
#include <string>
#include <vector>

namespace episcope::cli {

/// What stands after the verb.
using VerbArguments = std::vector<std::string>;

/// A row of the table of verbs.
struct Verb {
  const char* name;
  const char* summary;
  /// Does it, and writes its answer to standard output. Throws UsageError for a wrong command line,
  /// Error for what failed, Cancelled.
  void (*run)(const VerbArguments& arguments, std::stop_token stop);
};

/// Every verb, in the order of the help.
[[nodiscard]] std::span<const Verb> verbs();

/// One function for each verb, in a source of its own; for the table.
void run_info(const VerbArguments& arguments, std::stop_token stop);
void run_list(const VerbArguments& arguments, std::stop_token stop);
void run_methods(const VerbArguments& arguments, std::stop_token stop);
void run_estimate(const VerbArguments& arguments, std::stop_token stop);
void run_evaluate(const VerbArguments& arguments, std::stop_token stop);
void run_show(const VerbArguments& arguments, std::stop_token stop);
void run_convert(const VerbArguments& arguments, std::stop_token stop);
void run_synthesize(const VerbArguments& arguments, std::stop_token stop);
void run_label(const VerbArguments& arguments, std::stop_token stop);
void run_validate(const VerbArguments& arguments, std::stop_token stop);
void run_calibrate(const VerbArguments& arguments, std::stop_token stop);
void run_rectify(const VerbArguments& arguments, std::stop_token stop);
void run_pose(const VerbArguments& arguments, std::stop_token stop);
void run_ground_truth(const VerbArguments& arguments, std::stop_token stop);
void run_benchmark(const VerbArguments& arguments, std::stop_token stop);

}  // namespace episcope::cli
