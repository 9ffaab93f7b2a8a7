// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <stop_token>
#include <string>
#include <vector>

namespace episcope::cli {

/// The words after the verb.
using VerbArguments = std::vector<std::string>;

/// A row of the table of verbs.
struct Verb {
  const char* name;
  const char* summary;
  /// Runs the verb and writes its answer to standard output. Throws UsageError for a wrong command
  /// line, Error, Cancelled.
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
void run_decode(const VerbArguments& arguments, std::stop_token stop);
void run_rectify(const VerbArguments& arguments, std::stop_token stop);
void run_pose(const VerbArguments& arguments, std::stop_token stop);
void run_ground_truth(const VerbArguments& arguments, std::stop_token stop);
void run_benchmark(const VerbArguments& arguments, std::stop_token stop);

/// What the program does, in a sentence.
inline constexpr const char* kProgramSummary =
    "Estimates and evaluates disparity in 4D light fields.";
/// What INPUT can be, in lines that end with a new line.
inline constexpr const char* kInputHelp =
    "INPUT is an lf.h5, a scene folder of the 2013 archive, a folder of the 2016 benchmark,\n"
    "a folder of images on a grid, demo, or demo:<scene> for a built-in scene.\n";
/// Command lines that work, one a line.
inline constexpr const char* kProgramExample =
    "  episcope-cli estimate epi_s demo -o demo.h5\n"
    "  episcope-cli evaluate demo.h5 --truth demo\n";

/// What `--help` without a verb prints.
[[nodiscard]] std::string program_help();

/// Exit codes that scripts rely on.
inline constexpr int kSuccess = 0;
inline constexpr int kFailed = 1;
inline constexpr int kWrongUsage = 2;
inline constexpr int kCancelled = 130;

}  // namespace episcope::cli
