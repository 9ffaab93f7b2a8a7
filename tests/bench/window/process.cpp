// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/window/process.h"

#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace episcope::bench {
namespace {

int entries_of(const char* folder) {
  const std::filesystem::directory_iterator all(folder);
  return static_cast<int>(std::distance(begin(all), end(all)));
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

Process this_process() {
  Process process;
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double* const kib = word == "VmRSS:"   ? &process.memory_mib
                        : word == "VmHWM:" ? &process.most_memory_mib
                                           : nullptr;
    if (kib && status >> *kib) *kib /= 1024;
  }
  process.files = entries_of("/proc/self/fd");
  process.threads = entries_of("/proc/self/task");
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  process.cpu_s = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  return process;
}

}  // namespace episcope::bench
