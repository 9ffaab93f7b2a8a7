// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/device/transfer.cuh"
#include "engine/cuda/layers/layer_memory.cuh"
#include "engine/cuda/layers/layer_score.cuh"
#include "engine/cuda/layers/layer_solver.h"
#include "engine/cuda/maps/map_memory.cuh"
#include "engine/cuda/tv_l2/denoise_maps.cuh"
#include "engine/cuda/tv_l2/tv_l2_solver.cuh"

#include <algorithm>
#include <future>
#include <memory>
#include <utility>

namespace episcope::cuda {
namespace {

constexpr int kThreads = 256;

// Maps on the device, all `[view][y][x]`.
struct Maps {
  int height = 0, width = 0;
  long count = 0;  ///< Of all pixels.
  const float* single = nullptr;
  float* coherence = nullptr;
  float* near = nullptr;
  float* far = nullptr;
  std::uint8_t* layers = nullptr;  ///< Their confidence in 1/255; with a region, their number.
  std::uint8_t* region = nullptr;  ///< 1 = two layers.
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
