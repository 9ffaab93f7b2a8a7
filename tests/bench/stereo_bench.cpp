// SPDX-License-Identifier: BSD-3-Clause
// Multi-view stereo of the center view at 9×9×768×768 RGB, 64 labels: each method's time and
// memory, and the matching costs against the same work through OpenCV.
#include "engine/core/parallel.h"
#include "engine/disparity/matching_cost.h"
#include "engine/disparity/registry.h"
#include "tests/bench/bench_scene.h"

#include <benchmark/benchmark.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace {

using namespace episcope;
using bench::now;

constexpr int kLabels = 64;
constexpr Interval kRange{-1.5, 2.2};

void method(benchmark::State& state, const char* id) {
  const Estimator estimator = find_estimator(id);
  const ParameterSet values{{"range", IntervalOrAuto(kRange)}};
  const auto samples = static_cast<double>(bench::demo_768().byte_size());
  const bool has_peak = bench::reset_peak_memory();
  double best = 1e9;
  for (auto _ : state) {
    const double start = now();
    benchmark::DoNotOptimize(
        estimator.run(bench::demo_768(), values, {.views = ViewSelection::Center}, Progress()));
    best = std::min(best, now() - start);
  }
  if (has_peak) {
    const auto peak = static_cast<double>(bench::peak_memory());
    state.counters["beyond_samples_MB"] = (peak - samples) / 1e6;
  }
  state.counters["best_s"] = best;
  // Of every sample, once: the least that all views and nothing else need. Compute-bound: a sample
  // read once is interpolated and compared 64 times.
  state.counters["of_copy"] = samples / best / bench::copied_bytes_per_second();
}
#define EPISCOPE_BENCH_METHOD(id) \
  BENCHMARK_CAPTURE(method, id, #id)->Unit(benchmark::kMillisecond)->Iterations(3)->UseRealTime()
EPISCOPE_BENCH_METHOD(st_ch_l);
EPISCOPE_BENCH_METHOD(st_av_l);
EPISCOPE_BENCH_METHOD(st_ch_s);
EPISCOPE_BENCH_METHOD(st_av_s);

cv::Mat float_view(const LightField& lf, ViewIndex index) {
  // OpenCV has no views of constant memory; nothing is written through it.
  auto* data = const_cast<std::uint8_t*>(lf.view<std::uint8_t>(index).data);
  cv::Mat result;
  cv::Mat(lf.height(), lf.width(), CV_8UC3, data).convertTo(result, CV_32F, 1.0 / 255);
  return result;
}

// One label's cost over the cross-hair, samples repeated beyond the border.
void opencv_label(const LightField& lf, float label, cv::Mat& cost) {
  const ViewIndex center = lf.center();
  const cv::Mat reference = float_view(lf, center);
  cost = cv::Mat::zeros(reference.size(), CV_32F);
  cv::Mat warped, sum;
  for (int i = 0; i < lf.grid().u + lf.grid().v; ++i) {
    const bool row = i < lf.grid().u;
    const ViewIndex view = row ? ViewIndex{center.v, i} : ViewIndex{i - lf.grid().u, center.u};
    if (view == center) continue;
    const cv::Matx23f shift(1, 0, -label * static_cast<float>(view.u - center.u), 0, 1,
                            -label * static_cast<float>(view.v - center.v));
    cv::warpAffine(float_view(lf, view), warped, shift, reference.size(),
                   cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
    warped -= reference;
    cv::multiply(warped, warped, warped);
    cv::transform(warped, sum, cv::Matx13f(1, 1, 1));
    cv::sqrt(sum, sum);
    cost += cv::min(sum, 0.02);
  }
}

// Bilinear, for OpenCV's cubic has other weights.
void costs_against_opencv(benchmark::State& state) {
  const LightField& lf = bench::demo_768();
  const std::vector<float> labels = equidistant_labels(kRange, kLabels);
  const MatchingCost cost{MatchedViews::CrossHair, Interpolation::Bilinear, 0.02};
  constexpr int share = 8;
  double ours = 1e9;
  double other = 1e9;
  for (auto _ : state) {
    for (int i = 0; i < 3; ++i) {
      const double start = now();
      benchmark::DoNotOptimize(matching_costs(lf, lf.center(), cost, labels, Progress()));
      ours = std::min(ours, now() - start);
    }
    cv::setNumThreads(1);
    const double start = now();
    parallel_for(kLabels / share, Progress(), [&](int i) {
      cv::Mat label_cost;
      opencv_label(lf, labels[i * share], label_cost);
      benchmark::DoNotOptimize(label_cost.data);
    });
    other = share * (now() - start);
  }
  state.counters["ours_s"] = ours;
  state.counters["opencv_s"] = other;
  state.counters["ratio"] = other / ours;
}
BENCHMARK(costs_against_opencv)->Unit(benchmark::kMillisecond)->Iterations(1)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
