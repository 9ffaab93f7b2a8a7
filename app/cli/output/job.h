// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/cli/arguments/parameter_options.h"
#include "app/cli/output/progress_bar.h"
#include "engine/core/parallel/progress.h"
#include "engine/disparity/common/run_options.h"

#include <stop_token>
#include <string>

namespace episcope::cli {

class Arguments;

/// Options that every verb with something to wait for has.
struct JobOptions {
  bool is_quiet = false;
  ParameterOptions run;  ///< Of run_schema.

  [[nodiscard]] RunOptions run_options() const { return run_schema().parse(run.values()); }
};

void declare_job_options(Arguments& arguments, JobOptions& options);

/// Progress of a verb: shows the bar, ends with the token of Ctrl+C.
class Job {
 public:
  Job(std::stop_token stop, const JobOptions& options);

  [[nodiscard]] const Progress& progress() const { return progress_; }
  /// A sentence for the user on standard error, unless quiet.
  void note(const std::string& sentence);
  /// To be called before the answer is written.
  void finish() { bar_.wipe(); }

 private:
  bool is_quiet_;
  ProgressBar bar_;
  Progress progress_;
};

/// Largest resident memory of this process so far.
[[nodiscard]] double peak_memory_mib();

}  // namespace episcope::cli
