// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/output/job.h"

#include "app/cli/arguments/arguments.h"

#include <sys/resource.h>
#include <iostream>

namespace episcope::cli {

void declare_job_options(Arguments& arguments, JobOptions& options) {
  options.run.declare(arguments, {run_schema().description("threads")});
  arguments.flag("-q,--quiet", options.is_quiet, "Show no progress bar and no notes");
}

Job::Job(std::stop_token stop, const JobOptions& options)
    : is_quiet_(options.is_quiet),
      bar_(options.is_quiet),
      progress_(
          std::move(stop), [this](const ProgressState& state) { bar_.draw(state); },
          options.run_options().threads) {}

void Job::note(const std::string& sentence) {
  if (is_quiet_) return;
  bar_.wipe();
  std::cerr << "note: " << sentence << '\n';
}

double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // Linux counts KiB
}

}  // namespace episcope::cli
