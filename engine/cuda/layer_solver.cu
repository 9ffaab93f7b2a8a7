// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/layer_solver.h"

#include "engine/cuda/device.cuh"
#include "engine/cuda/device_data.cuh"
#include "engine/cuda/double_products.cuh"
#include "engine/cuda/line_check.cuh"
#include "engine/cuda/tv_l2.cuh"
#include "engine/disparity/kernels/shared_constants.h"

#include <algorithm>
#include <future>
#include <utility>

namespace episcope::cuda {
namespace {

// What LayerScore judges and fills, of all views `[view][y][x]`: borrowed.
struct ScoredMaps {
  const float *fit = nullptr, *single = nullptr, *near = nullptr, *far = nullptr;
  const std::uint8_t* confidence = nullptr;
  float *score = nullptr, *weight = nullptr;
};

constexpr int kScoreThreads = 128;

// A thread has a column of a row of a view; those at either end of a block, and beyond the view,
// only help with windows of their neighbors.
struct Place {
  int view, y, x;
  long first;  // Of the view.
  bool exists, inside;
};

template <int kHalo>
__device__ Place place_in(const PackedField& field) {
  const int thread = static_cast<int>(threadIdx.x);
  const int x = static_cast<int>(blockIdx.x) * (kScoreThreads - 2 * kHalo) + thread - kHalo;
  const auto view = static_cast<int>(blockIdx.z);
  const bool exists = x >= 0 && x < field.width;
  const bool is_result = thread >= kHalo && thread < kScoreThreads - kHalo;
  return {view,   static_cast<int>(blockIdx.y),
          x,      static_cast<long>(view) * field.height * field.width,
          exists, exists && is_result};
}

template <int kHalo>
dim3 blocks_of(const PackedField& field, const MappedViews& views) {
  return {blocks_for(field.width, kScoreThreads - 2 * kHalo), static_cast<unsigned>(field.height),
          static_cast<unsigned>(views.grid.count())};
}

// What the columns of a window add up to, by thread.
using ColumnSums = float[5][kScoreThreads];

// The mean of `count` quantities over the window of a pixel, column by column as window_mean_row
// adds them up; `values(at, out)` gives those of pixel `at` of a view. All threads take part.
template <int count, class Values>
__device__ void window_means(const PackedField& field, const Place& place, int radius,
                             const Values& values, ColumnSums& columns, float (&means)[count]) {
  const int top = max(place.y - radius, 0), bottom = min(place.y + radius + 1, field.height);
  const int left = max(place.x - radius, 0), right = min(place.x + radius + 1, field.width);
  const int thread = static_cast<int>(threadIdx.x);
  float sums[count] = {};
  for (int row = top; place.exists && row < bottom; ++row) {
    float each[count];
    values(row * field.width + place.x, each);
    for (int k = 0; k < count; ++k) sums[k] += each[k];
  }
  __syncthreads();  // those of the window before have been read
  for (int k = 0; k < count; ++k) columns[k][thread] = sums[k];
  __syncthreads();
  for (float& mean : means) mean = 0;
  if (!place.inside) return;
  for (int column = left; column < right; ++column) {
    for (int k = 0; k < count; ++k) means[k] += columns[k][thread + column - place.x];
  }
  for (float& mean : means) {
    mean = mean / static_cast<float>(right - left) / static_cast<float>(bottom - top);
  }
}

// Residuals of the lines of the single layer, for line_fit.
__global__ __launch_bounds__(kScoreThreads) void find_misfits(PackedField field, MappedViews views,
                                                              const float* single, float* misfits) {
  const Place place = place_in<0>(field);
  if (!place.inside) return;
  const RayPlace ray{views.first.v + place.view / views.grid.u,
                     views.first.u + place.view % views.grid.u, place.y, place.x};
  const long at = place.first + static_cast<long>(place.y) * field.width + place.x;
  misfits[at] = fminf(line_residual(field, ray, single[at]), kMostFitResidual);
}

// Of one layer: its variance over a window, weighted by confidence.
__device__ float variance_of(const PackedField& field, const Place& place, const float* layer,
                             const std::uint8_t* confidence, ColumnSums& columns) {
  float means[3];
  window_means<3>(
      field, place, kLayerVarianceRadius,
      [&](int at, float(&out)[3]) {
        const float weight = confidence[at], d = layer[at];
        out[0] = weight;
        out[1] = __fmul_rn(weight, d);
        out[2] = __fmul_rn(out[1], d);
      },
      columns, means);
  const float of = fmaxf(means[0], kLeastLayerConfidence), mean = means[1] / of;
  return __fsub_rn(means[2] / of, __fmul_rn(mean, mean));
}

__global__ __launch_bounds__(kScoreThreads) void find_steadiness(PackedField field, ScoredMaps maps,
                                                                 float* steadiness) {
  __shared__ ColumnSums columns;
  const Place place = place_in<kLayerVarianceRadius>(field);
  const std::uint8_t* const confidence = maps.confidence + place.first;
  const float near = variance_of(field, place, maps.near + place.first, confidence, columns);
  const float far = variance_of(field, place, maps.far + place.first, confidence, columns);
  if (!place.inside) return;
  const float variance = fmaxf(fmaxf(0.0F, near), far);
  steadiness[place.first + static_cast<long>(place.y) * field.width + place.x] =
      1 / (1 + variance / (kLayerSpread * kLayerSpread));
}

// The largest coherence around a pixel. All threads take part.
__device__ float spread_at(const PackedField& field, const Place& place, const float* fit,
                           ColumnSums& columns) {
  const int thread = static_cast<int>(threadIdx.x);
  const int top = max(place.y - kCoherenceReach, 0);
  const int bottom = min(place.y + kCoherenceReach + 1, field.height);
  float most = -INFINITY;
  for (int y = top; place.exists && y < bottom; ++y) {
    most = fmaxf(most, fit[y * field.width + place.x]);
  }
  __syncthreads();
  columns[0][thread] = most;
  __syncthreads();
  if (!place.inside) return 0;
  for (int i = -kCoherenceReach; i <= kCoherenceReach; ++i)
    most = fmaxf(most, columns[0][thread + i]);
  return most;
}

// How well lines explain the pixels of a window: 1 − s·e/v, see raise_by_line_fit.
__device__ float line_fit(const PackedField& field, const MappedViews& views, const Place& place,
                          const float* misfits, float strictness, ColumnSums& columns) {
  const std::uint32_t* const pixels = field.view(views.first.v + place.view / views.grid.u,
                                                 views.first.u + place.view % views.grid.u);
  float means[5];
  window_means<5>(
      field, place, kLineFitRadius,
      [&](int at, float(&out)[5]) {
        out[3] = 0;
        for (int c = 0; c < 3; ++c) {
          out[c] = static_cast<float>(packed_channel(pixels[at], c)) / kPackedMost;
          out[3] = __fadd_rn(out[3], __fmul_rn(out[c], out[c]));
        }
        out[4] = misfits[at];
      },
      columns, means);
  float variance = means[3];
  for (int c = 0; c < 3; ++c) variance = __fsub_rn(variance, __fmul_rn(means[c], means[c]));
  return 1 - strictness * means[4] / (2 * fmaxf(variance, kLeastFitVariance));
}

__global__ __launch_bounds__(kScoreThreads) void judge(PackedField field, MappedViews views,
                                                       float decision, float strictness,
                                                       ScoredMaps maps, const float* misfits,
                                                       const float* steady) {
  __shared__ ColumnSums columns;
  const Place place = place_in<kSteadyRadius>(field);
  const float spread = spread_at(field, place, maps.fit + place.first, columns);
  const float r =
      fmaxf(spread, line_fit(field, views, place, misfits + place.first, strictness, columns));
  float means[1];
  window_means<1>(
      field, place, kSteadyRadius,
      [from = steady + place.first](int i, float(&out)[1]) { out[0] = from[i]; }, columns, means);
  if (!place.inside) return;
  const long at = place.first + static_cast<long>(place.y) * field.width + place.x;
  const float c = static_cast<float>(maps.confidence[at]) / 255;
  const float steadiness =
      fminf(fmaxf((means[0] - kUnsteadyMean) / (kSteadyMean - kUnsteadyMean), 0.0F), 1.0F);
  const float share = (1 - r) / (2 - r - c + kLeastMisfit);
  const float doubles =
      share > decision ? (share - decision) / (1 - decision) : share / decision - 1;
  // What is no surface speaks for one layer.
  const float seen = steadiness * (doubles + 1) - 1;
  const float fit = fmaxf((fmaxf(r, c) - kNoiseFit) / (1 - kNoiseFit), 0.0F);
  maps.score[at] = (fit * seen - kOneLayerWeight) / (fit + kOneLayerWeight);
  maps.weight[at] = fit + kOneLayerWeight;
}

// Whether rays see two layers or one, as LayerScore (engine/disparity/epi_two_layer.h), of
// these views of the field. Throws DeviceFailure.
void score_layers(const PackedField& field, const MappedViews& views, float decision,
                  float strictness, const ScoredMaps& maps, const DeviceStream& stream) {
  const auto count = static_cast<double>(field.height) * field.width * views.grid.count();
  const auto size = static_cast<std::size_t>(count);
  DeviceArray<float> misfits(size, stream), steady(size, stream);
  launch(stream, {"layers: misfits of lines", 12 * count, 700 * count}, [&] {
    find_misfits<<<blocks_of<0>(field, views), kScoreThreads, 0, stream.get()>>>(
        field, views, maps.single, misfits.data());
  });
  launch(stream, {"layers: steadiness", 13 * count, 250 * count}, [&] {
    find_steadiness<<<blocks_of<kLayerVarianceRadius>(field, views), kScoreThreads, 0,
                      stream.get()>>>(field, maps, steady.data());
  });
  launch(stream, {"layers: score", 25 * count, 400 * count}, [&] {
    judge<<<blocks_of<kSteadyRadius>(field, views), kScoreThreads, 0, stream.get()>>>(
        field, views, decision, strictness, maps, misfits.data(), steady.data());
  });
}

constexpr int kThreads = 256;

// Maps on the device, all `[view][y][x]`.
struct Maps {
  int height = 0, width = 0;
  long count = 0;  // Of all pixels.
  const float* single = nullptr;
  float* coherence = nullptr;
  float* near = nullptr;
  float* far = nullptr;
  std::uint8_t* layers = nullptr;  // Their confidence in 1/255; with a region, their number.
  std::uint8_t* region = nullptr;  // 1 = two layers.
  float* data = nullptr;
  float* weight = nullptr;
  float* image_edges = nullptr;
  float* edges = nullptr;
};

__device__ long place() {
  return static_cast<long>(blockIdx.x) * blockDim.x + threadIdx.x;
}

// Pixels that hold nothing have no second layer. Block y is a map.
__global__ void clear_invalid(Maps maps, DeviceSamples samples, MapPointers views) {
  const long pixels = static_cast<long>(maps.height) * maps.width, i = place();
  if (i >= pixels) return;
  const int map = static_cast<int>(blockIdx.y);
  const int v = views.first.v + map / views.grid.u, u = views.first.u + map % views.grid.u;
  if (samples.valid[samples.pixel(v, u, 0, 0) + i] == 0) maps.layers[map * pixels + i] = 0;
}

// The region from the solution in `data`: so many layers, their confidence, and as much trust.
__global__ void find_region(Maps maps, float* trust) {
  const long i = place();
  if (i >= maps.count) return;
  const bool is_double = maps.data[i] > 0;
  if (is_double) maps.coherence[i] = static_cast<float>(maps.layers[i]) / 255;
  trust[i] = maps.coherence[i];
  maps.region[i] = is_double ? 1 : 0;
  maps.layers[i] = is_double ? 2 : 1;
}

// The surface is an area, not a texture: it ignores image edges, and may jump at its border.
__global__ void begin_foreground(Maps maps, float factor, float border_weight) {
  const long i = place();
  if (i >= maps.count) return;
  const int x = static_cast<int>(i % maps.width);
  const int y = static_cast<int>(i / maps.width % maps.height);
  const std::uint8_t here = maps.region[i];
  const std::uint8_t right = maps.region[x + 1 < maps.width ? i + 1 : i];
  const std::uint8_t below = maps.region[y + 1 < maps.height ? i + maps.width : i];
  const bool is_border = right != here || below != here;
  maps.data[i] = here != 0 ? maps.near[i] : maps.single[i];
  maps.edges[i] = is_border ? border_weight : here != 0 ? 1.0F : maps.image_edges[i] / factor;
}

// Image edges of the region are those of both layers: they tell of neither.
__global__ void begin_background(Maps maps) {
  const long i = place();
  if (i >= maps.count) return;
  const bool is_double = maps.region[i] != 0;
  maps.data[i] = is_double ? maps.far[i] : maps.single[i];
  maps.edges[i] = is_double ? 1.0F : maps.image_edges[i];
}

__global__ void order_layers(Maps maps, float min, float max) {
  const long i = place();
  if (i >= maps.count) return;
  const bool is_double = maps.region[i] != 0;
  float near = is_double ? maps.near[i] : maps.far[i], far = maps.far[i];
  if (near < far) near = far = 0.5F * (near + far);
  maps.near[i] = fminf(fmaxf(near, min), max);
  maps.far[i] = fminf(fmaxf(far, min), max);
}

// All that the device holds for a run.
class LayerSolver {
 public:
  LayerSolver(const LightField& lf, const LayerSmoothing& smoothing, const RawLayers& raw,
              const Progress& progress);

  void find_score(DeviceMaps fit);
  // Of either layer's data, and of the variation; after it, confidence and number of layers stay.
  void find_weights(const Progress& progress);
  // Begins to fill them, and to count rays with two, while layers are solved.
  std::future<std::size_t> begin_download(const LayerResults& results,
                                          const Progress& progress) const;
  std::vector<double> solve(const Progress& progress);
  void download_to(const LayerResults& results, const Progress& progress) const;

 private:
  template <class Kernel>
  void run(const char* name, double bytes, const Kernel& kernel) {
    const double count = static_cast<double>(maps_.count);
    launch(stream_, {name, bytes * count, 8 * count},
           [&] { kernel(blocks_for(maps_.count, kThreads)); });
  }
  void solve_layer(double lambda, float* result, const Progress& progress);

  LayerSmoothing smoothing_;
  MapMemory& single_;
  LayerMemory& layers_;
  const DeviceSamples& samples_;
  MappedViews views_;
  const DeviceStream& stream_;
  DeviceArray<float> data_, weight_, image_edges_, edges_;
  DeviceArray<std::uint8_t> region_;
  TvL2DeviceSolver solver_;
  Maps maps_;
  std::vector<double> gaps_;
};

LayerSolver::LayerSolver(const LightField& lf, const LayerSmoothing& smoothing,
                         const RawLayers& raw, const Progress& progress)
    : smoothing_(smoothing),
      single_(raw.single.memory()),
      layers_(raw.layers.memory()),
      samples_(single_.samples(lf, progress)),
      views_{single_.grid, single_.first},
      stream_(single_.stream),
      data_(single_.disparity.size(), stream_),
      weight_(data_.size(), stream_),
      image_edges_(data_.size(), stream_),
      edges_(data_.size(), stream_),
      region_(data_.size(), stream_),
      solver_(lf.height(), lf.width(), single_.grid.count(), stream_),
      maps_{lf.height(),
            lf.width(),
            static_cast<long>(data_.size()),
            single_.disparity.data(),
            single_.confidence.data(),
            layers_.near.data(),
            layers_.far.data(),
            layers_.confidence.data(),
            region_.data(),
            data_.data(),
            weight_.data(),
            image_edges_.data(),
            edges_.data()} {}

void LayerSolver::find_score(DeviceMaps fit) {
  const long pixels = static_cast<long>(maps_.height) * maps_.width;
  if (samples_.valid != nullptr) {
    const dim3 grid(blocks_for(pixels, kThreads), static_cast<unsigned>(views_.grid.count()));
    launch(stream_, {"layers: invalid pixels", 1.0 * maps_.count}, [&] {
      clear_invalid<<<grid, kThreads, 0, stream_.get()>>>(maps_, samples_, single_.pointers());
    });
  }
  stream_.wait_for(fit.memory().stream);
  const PackedFieldMemory packed(samples_, stream_);
  score_layers(packed.field(), views_, static_cast<float>(smoothing_.decision),
               smoothing_.strictness,
               {fit.memory().confidence.data(), maps_.single, maps_.near, maps_.far, maps_.layers,
                data_.data(), weight_.data()},
               stream_);
  fit.memory().stream.wait_for(stream_);
}

void LayerSolver::find_weights(const Progress& progress) {
  (void)solver_.solve({data_.data(), weight_.data(), nullptr, smoothing_.region_smoothness},
                      smoothing_.region_iterations, smoothing_.region_gap, progress, data_.data());
  run("layers: region", 18, [&](unsigned blocks) {
    find_region<<<blocks, kThreads, 0, stream_.get()>>>(maps_, edges_.data());
  });
  MapDenoising weights;
  weights.weight_power = smoothing_.weight_power;
  weights.min_weight = smoothing_.min_weight;
  weights.edge_strength = smoothing_.edge_strength;
  fill_weights(samples_, views_, 0, views_.grid.count(), weights, edges_.data(), nullptr,
               {weight_.data(), image_edges_.data()}, stream_);
}

void LayerSolver::solve_layer(double lambda, float* result, const Progress& progress) {
  const std::vector<TvL2Outcome> outcomes =
      solver_.solve({data_.data(), weight_.data(), edges_.data(), lambda},
                    smoothing_.max_iterations, smoothing_.gap, progress, result);
  gaps_.resize(outcomes.size(), 0);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    gaps_[i] = std::max(gaps_[i], outcomes[i].relative_gap());
  }
}

std::vector<double> LayerSolver::solve(const Progress& progress) {
  const auto factor = static_cast<float>(std::max(smoothing_.layer_smoothness, 1.0));
  run("layers: foreground", 18, [&](unsigned blocks) {
    begin_foreground<<<blocks, kThreads, 0, stream_.get()>>>(maps_, factor,
                                                             smoothing_.border_weight);
  });
  solve_layer(smoothing_.lambda * factor, maps_.near, progress.part(0, 0.5));
  run("layers: background", 18,
      [&](unsigned blocks) { begin_background<<<blocks, kThreads, 0, stream_.get()>>>(maps_); });
  solve_layer(smoothing_.lambda, maps_.far, progress.part(0.5, 1));
  run("layers: order", 17, [&](unsigned blocks) {
    order_layers<<<blocks, kThreads, 0, stream_.get()>>>(maps_, smoothing_.min, smoothing_.max);
  });
  return gaps_;
}

std::future<std::size_t> LayerSolver::begin_download(const LayerResults& results,
                                                     const Progress& progress) const {
  return begin_copies(stream_, [this, results, progress](const DeviceStream& copies) {
    download(results.confidence, single_.confidence, copies, progress);
    download(results.layers, layers_.confidence, copies, progress);
    const std::uint8_t* const layers = results.layers.data();
    return static_cast<std::size_t>(std::count(layers, layers + results.layers.size(), 2));
  });
}

void LayerSolver::download_to(const LayerResults& results, const Progress& progress) const {
  download_bytes({results.near.data(), results.near_again.data()}, layers_.near.data(),
                 layers_.near.byte_size(), stream_, progress);
  download(results.far, layers_.far, stream_, progress);
}

}  // namespace

LayerOutcome solve_layers(const LightField& lf, const LayerSmoothing& smoothing,
                          const RawLayers& raw, DeviceMaps fit, const LayerResults& results,
                          const Progress& progress) {
  LayerSolver solver(lf, smoothing, raw, progress.part(0, 0));
  solver.find_score(std::move(fit));
  solver.find_weights(progress.part(0, 0.3));
  std::future<std::size_t> doubles = solver.begin_download(results, progress.part(0.3, 0.3));
  LayerOutcome outcome{solver.solve(progress.part(0.3, 0.9))};
  solver.download_to(results, progress.part(0.9, 1));
  outcome.doubles = doubles.get();
  return outcome;
}

}  // namespace episcope::cuda
