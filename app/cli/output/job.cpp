// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/output/job.h"

#include "app/cli/arguments/arguments.h"

#include <sys/resource.h>
#include <iostream>

namespace episcope::cli {

void declare_job_options(Arguments& arguments, JobOptions& options) {
  arguments.option("--threads", options.threads, "N", "Threads to use; 0 = as many as there are");
  arguments.flag("-q,--quiet", options.is_quiet, "No progress bar and no notes");
}

Job::Job(std::stop_token stop, const JobOptions& options)
    : is_quiet_(options.is_quiet),
      bar_(options.is_quiet),
      progress_(
          std::move(stop), [this](const ProgressState& state) { bar_.draw(state); },
          parse_integer("--threads", options.threads, 0, 1024)) {}

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
