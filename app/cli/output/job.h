// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/cli/output/progress_bar.h"
#include "engine/core/parallel/progress.h"

#include <stop_token>
#include <string>

namespace episcope::cli {

class Arguments;

/// Options that every verb with something to wait for has.
struct JobOptions {
  bool is_quiet = false;
  std::string threads = "0";
};

void declare_job_options(Arguments& arguments, JobOptions& options);

/// Progress of a verb: shows the bar, ends with the token of Ctrl+C.
class Job {
 public:
  /// Throws UsageError for a bad number of threads.
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
