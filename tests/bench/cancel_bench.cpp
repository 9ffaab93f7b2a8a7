// SPDX-License-Identifier: BSD-3-Clause
// How long each method goes on after it was told to stop, at 9×9×768×768 RGB: stopped at eight
// points of its run, the slowest answer. Names of methods as arguments; all without.
#include "engine/core/error.h"
#include "engine/disparity/registry.h"
#include "tests/bench/bench_scene.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace episcope;
using bench::now;

constexpr int kPoints = 8;

ViewSelection views_of(const Estimator& estimator) {
  return estimator.info.all_views ? ViewSelection::All : ViewSelection::Center;
}

double whole_run(const Estimator& estimator) {
  const double start = now();
  (void)estimator.run(bench::demo_768(), {}, {.views = views_of(estimator)}, Progress());
  return now() - start;
}

struct Answer {
  double milliseconds = 0;
  std::string stage;  // that was stopped
};

// Runs until `after` seconds have passed; no answer if it ended before.
Answer answer_to_stop(const Estimator& estimator, double after) {
  std::stop_source stop;
  std::string stage;
  std::atomic<double> asked = 0;
  // Called one at a time; what is told after the stop is of no interest.
  const Progress progress(stop.get_token(), [&](const ProgressState& state) {
    if (asked == 0) stage = state.step;
  });
  std::jthread asking([&](std::stop_token ended) {
    const double until = now() + after;
    while (now() < until && !ended.stop_requested()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (ended.stop_requested()) return;
    asked = now();
    stop.request_stop();
  });
  try {
    (void)estimator.run(bench::demo_768(), {}, {.views = views_of(estimator)}, progress);
  } catch (const Cancelled&) {
    return {1e3 * (now() - asked), stage};
  }
  return {};
}

void print_slowest(const Estimator& estimator) {
  const double whole = whole_run(estimator);
  Answer slowest;
  for (int i = 0; i < kPoints; ++i) {
    const Answer answer = answer_to_stop(estimator, whole * (i + 0.5) / kPoints);
    if (answer.milliseconds > slowest.milliseconds) slowest = answer;
  }
  std::printf("%-14s %7.1f s   slowest answer %6.1f ms   %s\n", estimator.info.id.c_str(), whole,
              slowest.milliseconds, slowest.stage.c_str());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  (void)bench::demo_768();  // rendered before anything is timed
  const std::vector<std::string> wanted(argv + 1, argv + argc);
  for (const Estimator& estimator : registered_estimators()) {
    const bool is_wanted =
        wanted.empty() || std::count(wanted.begin(), wanted.end(), estimator.info.id) > 0;
    if (is_wanted) print_slowest(estimator);
  }
  return 0;
}
