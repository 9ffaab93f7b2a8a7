// SPDX-License-Identifier: BSD-3-Clause
// Every hot kernel of the disparity methods by itself, on 9×9×768×768 RGB and all threads: bytes
// that it must move (what it reads and writes from memory if every sample, map and cost went there
// once) by the time it takes, against what the memory copies, and its arithmetic. Where a kernel
// stays under a third of the copy, the comment says what it waits for. TV-L2 and the lifted
// labeling have programs of their own (tv_l2_bench, lifted_labeling_bench).
#include "engine/core/parallel.h"
#include "engine/disparity/double_orientation.h"
#include "engine/disparity/epi_c.h"
#include "engine/disparity/epi_l.h"
#include "engine/disparity/line_check.h"
#include "engine/disparity/matching_cost.h"
#include "engine/disparity/stereo_costs.h"
#include "engine/disparity/structure_tensor.h"
#include "engine/solvers/ordering_terms.h"
#include "tests/bench/bench_scene.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>

namespace {

using namespace episcope;
using bench::now;

constexpr int kLabels = 64;
constexpr Interval kRange{-1.5, 2.2};
constexpr TensorScales kScales;

// What a run moves, and its multiplications and additions.
struct Work {
  double bytes = 0;
  double operations = 0;
};

const LightField& scene() {
  return bench::demo_768();
}

double pixels() {
  return static_cast<double>(scene().height()) * scene().width();
}

template <class Run>
void measure(benchmark::State& state, const Work& work, const Run& run) {
  double best = 1e9, processor = 1e9;
  for (auto _ : state) {
    const double start = now();
    const std::clock_t used = std::clock();
    run();
    best = std::min(best, now() - start);
    processor = std::min(processor, static_cast<double>(std::clock() - used) / CLOCKS_PER_SEC);
  }
  state.counters["best_ms"] = 1e3 * best;
  state.counters["cpu_ms"] = 1e3 * processor;  // of all threads
  state.counters["GB_per_s"] = work.bytes / best / 1e9;
  state.counters["of_copy"] = work.bytes / best / bench::copied_bytes_per_second();
  state.counters["GFLOP_per_s"] = work.operations / best / 1e9;
}
#define EPISCOPE_BENCH_KERNEL(name) \
  BENCHMARK(name)->Unit(benchmark::kMillisecond)->Iterations(3)->UseRealTime()

// Reads the views that are compared and writes the costs of a pixel at all labels. Bound by
// arithmetic: a sample, once it is in the cache, is interpolated by four taps along each axis on
// which its view lies beside the reference, subtracted, squared and summed, 64 times.
void matching_cost(benchmark::State& state, MatchedViews views) {
  const LightField& lf = scene();
  const bool all = views == MatchedViews::All;
  const double compared = all ? lf.grid().count() - 1 : lf.grid().u + lf.grid().v - 2;
  // Off the cross-hair by both axes; a root, a least and a sum for three channels.
  const double beside = all ? compared - (lf.grid().u + lf.grid().v - 2) : 0;
  const double taps = 7 * (compared + beside);
  const Work work{pixels() * (3 * compared + 4.0 * kLabels),
                  pixels() * kLabels * (3 * (taps + 3 * compared) + 3 * compared)};
  const std::vector<float> labels = equidistant_labels(kRange, kLabels);
  measure(state, work, [&] {
    benchmark::DoNotOptimize(
        matching_costs(lf, lf.center(), {views, Interpolation::Cubic, 0.02}, labels, Progress()));
  });
}
void matching_cost_ch(benchmark::State& state) {
  matching_cost(state, MatchedViews::CrossHair);
}
void matching_cost_av(benchmark::State& state) {
  matching_cost(state, MatchedViews::All);
}
EPISCOPE_BENCH_KERNEL(matching_cost_ch);
EPISCOPE_BENCH_KERNEL(matching_cost_av);

// Reads and writes 32 layers of costs; each layer also takes in the samples, means and inverse
// covariances of the view, 12 numbers a pixel.
void guided_filter(benchmark::State& state) {
  const LightField& lf = scene();
  constexpr int layers = 32, band = 64;
  const GuideImage guide(lf, lf.center(), 2, 1e-3, Progress());
  Volume<float> costs(lf.height(), layers, lf.width());
  std::fill_n(costs.view().data, costs.view().size(), 0.5F);
  const auto filter_band = [&](GuidedFilter& filter, int i) {
    VolumeView<float> rows = costs.view();
    rows.data = rows.row(i * band, 0);
    rows.height = std::min(band, lf.height() - i * band);
    filter.apply(i * band, rows, Progress());
  };
  // Windows of 5×5 for four sums of products and four of models, by rows and columns; products,
  // a symmetric 3×3 system, the model applied.
  const Work work{pixels() * layers * (8 + 48), pixels() * layers * (2 * 4 * (2 * 5) + 4 + 24 + 6)};
  measure(state, work, [&] {
    parallel_for_workers((lf.height() + band - 1) / band, Progress(), [&] {
      return [&, filter = GuidedFilter(guide)](int i) mutable { filter_band(filter, i); };
    });
  });
}
EPISCOPE_BENCH_KERNEL(guided_filter);

// Rows of pixels that one thread takes from one row of cameras.
constexpr int kBandRows = 64;

// Tensors of all views of the horizontal EPIs of one row of cameras: reads their samples, writes
// disparity and coherence. Bound by arithmetic: 9 shears, each with 12 taps along the views for
// either derivative of three channels, and 5 along the image and views for each of three products.
void structure_tensor(benchmark::State& state) {
  const LightField& lf = scene();
  const TensorSearch search = cover_range(kRange, 1);
  const auto shears = static_cast<double>(search.half_step_shears.size());
  const double rays = pixels() * lf.grid().u;
  const Work work{rays * (3 + 8), rays * shears * (3 * (2 * 4 + 6) * 2 + 3 * (7 + 5) * 2 + 40)};
  const auto drop = [](int, PixelIndex, int, const float* disparity, const float*) {
    benchmark::DoNotOptimize(*disparity);
  };
  measure(state, work, [&] {
    parallel_for_workers((lf.height() + kBandRows - 1) / kBandRows, Progress(), [&] {
      return [&, tensor = StructureTensor(lf, StructureTensor::Direction::Horizontal, kScales,
                                          search)](int i) mutable {
        const int y = i * kBandRows;
        tensor.estimate({lf.center().v,
                         {y, 0},
                         std::min(kBandRows, lf.height() - y),
                         lf.width(),
                         0,
                         lf.grid().u},
                        drop);
      };
    });
  });
}
EPISCOPE_BENCH_KERNEL(structure_tensor);

// The same with two orientations; writes both and their confidence. Bound by arithmetic: for each
// of 4 shears three second derivatives of three channels, six products, integrated along three
// axes, and an eigenvector.
void double_orientation(benchmark::State& state) {
  const LightField& lf = scene();
  constexpr auto direction = DoubleOrientation::Direction::Horizontal;
  const DoubleSearch search{kRange};
  const PixelIndex tile = DoubleOrientation::tile(direction);
  const int columns = (lf.width() + tile.x - 1) / tile.x;
  const int rows = (lf.height() + tile.y - 1) / tile.y;
  const double rays = pixels() * lf.grid().u;
  const Work work{rays * (3 + 12), rays * 4 * (3 * 3 * 10 + 6 * 3 * 2 + 6 * (5 + 5 + 5) * 2 + 150)};
  const auto drop = [](int, PixelIndex, int, const float* near, const float*, const float*) {
    benchmark::DoNotOptimize(*near);
  };
  measure(state, work, [&] {
    parallel_for_workers(rows * columns, Progress(), [&] {
      return [&, orientation = DoubleOrientation(lf, direction, kScales, search)](int i) mutable {
        const PixelIndex begin{i / columns * tile.y, i % columns * tile.x};
        orientation.estimate({lf.center().v, begin, std::min(tile.y, lf.height() - begin.y),
                              std::min(tile.x, lf.width() - begin.x), 0, lf.grid().u},
                             drop);
      };
    });
  });
}
EPISCOPE_BENCH_KERNEL(double_orientation);

// EPI_L of all views: what the kernels below begin with.
const Estimate& local_estimate() {
  static const Estimate estimate = [] {
    EpiLParameters parameters;
    parameters.range = kRange;
    return estimate_epi_l(scene(), parameters, ViewSelection::All, Progress());
  }();
  return estimate;
}

double rays() {
  return pixels() * scene().grid().count();
}

// Packs the samples; then every ray reads its own, its disparity, and those of up to 16 views where
// its line meets them; its confidence is renewed. Bound by arithmetic: for each of those views the
// meeting of the line, two samples picked from three or four runs, unpacked and interpolated.
void line_residual(benchmark::State& state) {
  Estimate estimate;
  estimate.field.disparity = local_estimate().field.disparity.clone();
  estimate.confidence = local_estimate().confidence.clone();
  const Work work{rays() * (3 + 4 + 4 + 4 + 16 * 4 + 8), rays() * 16 * (3 * 5 + 12)};
  measure(state, work, [&] { reduce_confidence(scene(), estimate, Progress()); });
}
EPISCOPE_BENCH_KERNEL(line_residual);

// Every ray reads disparity and confidence of up to 16 views, one element of each where its line
// meets them, copies itself first. Scalar: it waits for the branches on what is met, and runs once
// for EPI_C, a hundredth of its time.
void visibility(benchmark::State& state) {
  ViewStack<float> disparity = local_estimate().field.disparity.clone();
  const PackedViews views = pack_views(scene(), Progress());
  const Work work{rays() * (8 + 4 + 16 * 8), rays() * 16 * 6};
  measure(state, work, [&] {
    benchmark::DoNotOptimize(
        replace_occluded(views, disparity, local_estimate().confidence, Progress()));
  });
}
EPISCOPE_BENCH_KERNEL(visibility);

// Both pulls between a view and one neighbor, for all rows of views: each reads slopes and both
// images and renews curvature and force. Where the lines of a view end follows from its slopes, and
// two lines may end at one pixel, so it is scalar; a thread keeps its view in the cache. An eighth
// of the time of EPI_C, the rest being the TV-L2 problems that it prepares.
void ordering_terms(benchmark::State& state) {
  const LightField& lf = scene();
  const ViewStack<float>& disparity = local_estimate().field.disparity;
  const GridShape grid = lf.grid();
  const double pulls = 2.0 * grid.v * (grid.u - 1);
  const Work work{pixels() * pulls * (3 * 4 + 4 * 4), pixels() * pulls * 20};
  measure(state, work, [&] {
    parallel_for_workers(grid.v * (grid.u - 1), Progress(), [&] {
      return [&, curvature = Image<float>(lf.height(), lf.width()),
              force = Image<float>(lf.height(), lf.width())](int i) mutable {
        const ViewIndex view{i / (grid.u - 1), i % (grid.u - 1)};
        const auto here = disparity.view(view), there = disparity.view({view.v, view.u + 1});
        const OrderingPull pull{curvature.view(), force.view()};
        add_pull_on_from(here, here, there, {false, -1}, {}, pull);
        add_pull_on_to(there, there, here, {false, 1}, {}, pull);
      };
    });
  });
}
EPISCOPE_BENCH_KERNEL(ordering_terms);

}  // namespace

BENCHMARK_MAIN();
