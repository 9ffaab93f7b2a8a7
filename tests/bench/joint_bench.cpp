// SPDX-License-Identifier: BSD-3-Clause
// The methods that work on several views together, at 9×9×768×768 RGB: EPI_C, EPI_TWO_LAYER and
// KZ02 against EPI_S in the same run, which solves the same TV-L2 problem once a view, and against
// what the memory can copy.
#include "engine/disparity/epi_c.h"
#include "engine/disparity/epi_s.h"
#include "engine/disparity/epi_two_layer.h"
#include "engine/disparity/kz02.h"
#include "tests/bench/bench_scene.h"

#include <benchmark/benchmark.h>

#include <algorithm>

namespace {

using namespace episcope;
using bench::now;

constexpr Interval kRange{-1.5, 2.2};

double rays() {
  const LightField& lf = bench::demo_768();
  return static_cast<double>(lf.grid().count()) * lf.height() * lf.width();
}

template <class Run>
double seconds_of(const Run& run) {
  const double start = now();
  benchmark::DoNotOptimize(run());
  return now() - start;
}

// Counts the time of `run`, its memory beyond the samples, and its share of the copy bandwidth if
// it moves no more than `bytes`.
template <class Run>
void measure(benchmark::State& state, double bytes, const Run& run) {
  const EpiSParameters smoothing{.tensor = {.range = kRange}};
  double best = 1e9, baseline = 1e9;
  for (auto _ : state) {
    baseline = std::min(baseline, seconds_of([&] {
                          return estimate_epi_s(bench::demo_768(), smoothing, ViewSelection::All,
                                                Progress());
                        }));
    const bool has_peak = bench::reset_peak_memory();
    best = std::min(best, seconds_of(run));
    if (has_peak) {
      const auto samples = static_cast<double>(bench::demo_768().byte_size());
      state.counters["beyond_samples_MB"] =
          (static_cast<double>(bench::peak_memory()) - samples) / 1e6;
    }
  }
  state.counters["best_s"] = best;
  state.counters["epi_s_s"] = baseline;
  state.counters["ratio"] = best / baseline;
  state.counters["of_copy"] = bytes / best / bench::copied_bytes_per_second();
}

// Compute-bound: multigrid works within the cache of its thread. Counted is what must come from
// memory: in each sweep of a view its samples, f, confidence and u, that of four neighbors twice,
// and u written.
void epi_c(benchmark::State& state) {
  const EpiCParameters parameters{.tensor = {.range = kRange}};
  const double bytes = parameters.sweeps * rays() * (3 + 12 * sizeof(float));
  measure(state, bytes, [&] {
    return estimate_epi_c(bench::demo_768(), parameters, ViewSelection::All, Progress());
  });
}
BENCHMARK(epi_c)->Unit(benchmark::kMillisecond)->Iterations(1)->UseRealTime();

// Compute-bound as well: six products of second derivatives for each ray and direction. Counted
// are the samples for each direction of the single and of the double tensor, and both layers with
// their confidences, written, denoised and merged.
void epi_two_layer(benchmark::State& state) {
  const EpiTwoLayerParameters parameters{.tensor = {.range = kRange}};
  const double bytes = rays() * (4 * 3 + 3 * 4 * sizeof(float));
  measure(state, bytes, [&] {
    return estimate_epi_two_layer(bench::demo_768(), parameters, ViewSelection::All, Progress());
  });
}
BENCHMARK(epi_two_layer)->Unit(benchmark::kMillisecond)->Iterations(1)->UseRealTime();

// Bound by latency: search trees jump through the memory of a graph. Counted are its nodes and
// edges, written and read once for every label.
void kz02(benchmark::State& state) {
  Kz02Parameters parameters;
  parameters.cycles = 1;
  parameters.range = kRange;
  constexpr double views = 5, edges = 3.5, bytes_a_node = 32, bytes_an_edge = 48;
  const double pixels = views * rays() / bench::demo_768().grid().count();
  measure(state, 2 * parameters.labels * pixels * (bytes_a_node + edges * bytes_an_edge),
          [&] { return estimate_kz02(bench::demo_768(), parameters, Progress()); });
}
BENCHMARK(kz02)->Unit(benchmark::kMillisecond)->Iterations(1)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
