// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stop_token>
#include <string>
#include <vector>

namespace episcope::cli {

/// One function for each verb, in a source of its own: gets what stands after the verb, writes its
/// answer to standard output. Throws UsageError for a wrong command line, Error for what failed,
/// Cancelled.
using VerbArguments = std::vector<std::string>;

void run_info(const VerbArguments& arguments, std::stop_token stop);
void run_methods(const VerbArguments& arguments, std::stop_token stop);
void run_estimate(const VerbArguments& arguments, std::stop_token stop);
void run_evaluate(const VerbArguments& arguments, std::stop_token stop);
void run_show(const VerbArguments& arguments, std::stop_token stop);
void run_convert(const VerbArguments& arguments, std::stop_token stop);
void run_synthesize(const VerbArguments& arguments, std::stop_token stop);
void run_label(const VerbArguments& arguments, std::stop_token stop);
void run_benchmark(const VerbArguments& arguments, std::stop_token stop);

}  // namespace episcope::cli
