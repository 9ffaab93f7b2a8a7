// SPDX-License-Identifier: BSD-3-Clause
// EPI_L and EPI_S of all views at 9×9×768×768 RGB against the same work through OpenCV's separable
// filters, against what the memory can copy, and the memory they take.
#include "engine/disparity/disparity_range.h"
#include "engine/disparity/epi_l.h"
#include "engine/disparity/epi_s.h"
#include "tests/bench/bench_scene.h"
#include "tests/bench/opencv_epi_l.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <optional>

namespace {

using namespace episcope;
using bench::now;

// Every so many EPIs are done through OpenCV: all of them, which takes about 15 s on 2 cores.
constexpr int kOpenCvStep = 1;

const Interval& found_range() {
  static const Interval range = find_disparity_range(bench::demo_768(), Progress());
  return range;
}

EpiLParameters with_range(bool automatic) {
  if (automatic) return {};
  return {.range = found_range()};
}

double result_bytes() {
  const LightField& lf = bench::demo_768();
  return 2.0 * sizeof(float) * lf.grid().count() * lf.height() * lf.width();
}

// Runs `estimate` for each iteration; counts the best time, the range and the memory beyond samples
// and results.
template <class Run>
double measure(benchmark::State& state, const Run& run) {
  const double needed = static_cast<double>(bench::demo_768().byte_size()) + result_bytes();
  const bool has_peak = bench::reset_peak_memory();
  double best = 1e9;
  Interval range;
  for (auto _ : state) {
    const double start = now();
    const Estimate estimate = run();
    best = std::min(best, now() - start);
    range = estimate.range;
  }
  if (has_peak) {
    const auto peak = static_cast<double>(bench::peak_memory());
    state.counters["peak_MB"] = peak / 1e6;
    state.counters["beyond_samples_and_results_MB"] = (peak - needed) / 1e6;
  }
  state.counters["best_s"] = best;
  state.counters["range_min"] = range.min;
  state.counters["range_max"] = range.max;
  return best;
}

void epi_l(benchmark::State& state) {
  const LightField& lf = bench::demo_768();
  const auto parameters = with_range(state.range(0) != 0);
  const double best = measure(
      state, [&] { return estimate_epi_l(lf, parameters, ViewSelection::All, Progress()); });
  // Samples are read for each direction; results are written, then read and written in the merge.
  // Bound by arithmetic: see structure_tensor in kernel_bench.
  const double bytes = 2.0 * static_cast<double>(lf.byte_size()) + 3 * result_bytes();
  state.counters["GB_per_s"] = bytes / best / 1e9;
  state.counters["of_copy"] = bytes / best / bench::copied_bytes_per_second();
}
BENCHMARK(epi_l)
    ->ArgName("auto")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(3)
    ->UseRealTime();

// Both in the same run, one after the other.
void epi_l_against_opencv(benchmark::State& state) {
  const LightField& lf = bench::demo_768();
  const auto parameters = with_range(false);
  double seconds = 1e9;
  bench::OpenCvRun other;
  for (auto _ : state) {
    std::optional<Estimate> estimate;
    for (int i = 0; i < 2; ++i) {
      estimate.reset();
      const double start = now();
      estimate = estimate_epi_l(lf, parameters, ViewSelection::All, Progress());
      seconds = std::min(seconds, now() - start);
    }
    other = bench::run_opencv_epi_l(lf, parameters, *estimate, kOpenCvStep);
  }
  state.counters["epi_l_s"] = seconds;
  state.counters["opencv_s"] = other.seconds;
  state.counters["opencv_share_done"] = other.share;
  state.counters["opencv_agrees"] = other.agreeing;
  state.counters["ratio"] = other.seconds / seconds;
}
BENCHMARK(epi_l_against_opencv)->Unit(benchmark::kMillisecond)->Iterations(1)->UseRealTime();

void epi_s(benchmark::State& state) {
  const EpiSParameters parameters{.tensor = with_range(state.range(0) != 0)};
  double denoising = 1e9;
  measure(state, [&] {
    double begin = now();
    // The part begins when it is announced.
    const Progress progress({}, [&begin, last = std::string()](const ProgressState& s) mutable {
      if (s.step == "denoising" && last != s.step) begin = now();
      last = s.step;
    });
    Estimate estimate = estimate_epi_s(bench::demo_768(), parameters, ViewSelection::All, progress);
    denoising = std::min(denoising, now() - begin);
    return estimate;
  });
  state.counters["tv_l2_s"] = denoising;
}
BENCHMARK(epi_s)
    ->ArgName("auto")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(2)
    ->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
