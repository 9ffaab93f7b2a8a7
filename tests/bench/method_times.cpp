// SPDX-License-Identifier: BSD-3-Clause
// Processor time and memory of methods on the center view of the scene `demo`, 9×9 views of the
// given size, on all threads, in one run: method_times 256 plane_pm net. Of three runs the least;
// ratios to the first method.
#include "engine/disparity/registry.h"
#include "engine/scenes/builtin.h"
#include "tests/bench/bench_scene.h"

#include <sys/resource.h>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

using namespace episcope;

constexpr int kRuns = 3;

// Seconds that this process has computed, without those of the system.
double processor_time() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

double least_time(const Estimator& method, const LightField& light_field) {
  double least = 1e9;
  for (int i = 0; i < kRuns; ++i) {
    const double begin = processor_time();
    (void)method.run(light_field, {}, {.views = ViewSelection::Center}, Progress());
    least = std::min(least, processor_time() - begin);
  }
  return least;
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 3 || std::atoi(arguments[1]) < 16) {
    std::fprintf(stderr, "give a size of 16 or more and methods: method_times 256 plane_pm net\n");
    return 2;
  }
  scenes::RenderOptions options;
  options.height = options.width = std::atoi(arguments[1]);
  const LightFieldPtr scene = scenes::render_builtin("demo", options, Progress()).light_field;
  double first = 0;
  for (int i = 2; i < count; ++i) {
    const Estimator* const method = known_estimator(arguments[i]);
    if (method == nullptr) {
      std::fprintf(stderr, "there is no method %s\n", arguments[i]);
      return 2;
    }
    bench::reset_peak_memory();
    const double seconds = least_time(*method, *scene);
    if (i == 2) first = seconds;
    std::printf("%-12s %6.2f s of processor time, ratio %.2f, %zu MB at most\n", arguments[i],
                seconds, seconds / first, bench::peak_memory() / 1000000);
  }
  return 0;
}
