// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/orientations.h"

#include "engine/core/indices.h"
#include "engine/cuda/device.cuh"
#include "engine/cuda/device_data.cuh"
#include "engine/cuda/double_products.cuh"
#include "engine/disparity/kernels/shared_constants.h"

#include <algorithm>
#include <cstdlib>

namespace episcope::cuda {
namespace {

__device__ float eighth_power(float value) {
  const float square = value * value, fourth = square * square;
  return fourth * fourth;
}

// What is on the device of the results, `[v][u][y][x]` of the wanted views.
struct Maps {
  float* near;
  float* far;
  std::uint8_t* confidence;
};

// The tiles of a line of which every `stride`th has results; `before` lie in lines before it.
struct Tiles {
  int height, width, stride, columns, before;
  int image_width;

  __device__ bool has(long i) const {
    if (stride == 1) return true;
    const int y = static_cast<int>(i / image_width), x = static_cast<int>(i % image_width);
    return (before + y / height * columns + x / width) % stride == 0;
  }
};

// Into what the other direction left there: confidence 0 if nothing. Block y is a view of the line,
// whose maps begin at `first` and lie `step` apart.
__global__ void merge(DoubleBest best, Maps maps, Tiles tiles, long pixels, long first, long step) {
  const long i = static_cast<long>(blockIdx.x) * blockDim.x + threadIdx.x;
  if (i >= pixels || !tiles.has(i)) return;
  const long from = blockIdx.y * pixels + i, to = first + blockIdx.y * step + i;
  const float here = best.confidence[from], there = static_cast<float>(maps.confidence[to]) / 255;
  float& near = maps.near[to];
  float& far = maps.far[to];
  const bool agree = here > 0 && there > 0 && fabsf(best.near[from] - near) < kDirectionAgreement &&
                     fabsf(best.far[from] - far) < kDirectionAgreement;
  if (!agree && here <= there) return;
  const float weight = eighth_power(here);
  const float share = agree ? weight / (weight + eighth_power(there) + 1e-30F) : 1.0F;
  near = share * best.near[from] + (1 - share) * near;
  far = share * best.far[from] + (1 - share) * far;
  maps.confidence[to] = static_cast<std::uint8_t>(lroundf(255 * fmaxf(here, there)));
}

// One direction of EPIs on the device.
class Pass {
 public:
  Pass(const DeviceSamples& samples, const DoublePass& pass, const DoubleShears& shears,
       GridShape wanted, ViewIndex first, const DeviceStream& stream);

  void run(const Maps& maps, const Progress& progress);

 private:
  [[nodiscard]] DoublePlanes planes(int margin) const {
    return {pass_.is_horizontal, samples_.height, samples_.width, margin};
  }
  void run_line(int number, const Progress& progress);
  void merge_line(int number, const Maps& maps);
  [[nodiscard]] Tiles tiles_of(int line) const;

  const DeviceSamples& samples_;
  const DoublePass& pass_;
  const DoubleShears& shears_;
  GridShape wanted_;
  ViewIndex first_;
  const DeviceStream& stream_;
  DoubleFilters filters_;
  int rows_, product_rows_;
  DoublePlanes of_derivatives_, of_products_;
  DeviceArray<float> derivatives_, products_, averaged_, weights_, best_;
};

Pass::Pass(const DeviceSamples& samples, const DoublePass& pass, const DoubleShears& shears,
           GridShape wanted, ViewIndex first, const DeviceStream& stream)
    : samples_(samples),
      pass_(pass),
      shears_(shears),
      wanted_(wanted),
      first_(first),
      stream_(stream),
      filters_{{pass.along[0], pass.along[1], pass.along[2]},
               {pass.views[0], pass.views[1], pass.views[2]},
               pass.integrate,
               pass.across,
               {pass.scale[0], pass.scale[1], pass.scale[2]},
               pass.mix,
               pass.contrast_energy,
               pass.noise_energy},
      rows_(pass.is_horizontal ? samples.grid.u : samples.grid.v),
      product_rows_(pass.last_product - pass.first_product) {
  int largest = 0;
  for (const int step : shears.steps) largest = std::max(largest, std::abs(step));
  of_derivatives_ = planes(pass.along[0].radius);
  of_products_ = planes(largest * (rows_ - 1));
  const auto size_of = [](const DoublePlanes& planes, int count) {
    return static_cast<std::size_t>(planes.size()) * count;
  };
  derivatives_ = {size_of(of_derivatives_, 3 * samples.channels * rows_), stream};
  products_ = {size_of(of_products_, 6 * product_rows_), stream};
  averaged_ = {products_.size(), stream};
  const int views = pass.is_horizontal ? wanted.u : wanted.v;
  best_ = {3 * size_of(planes(0), views), stream};
  weights_ = upload(pass.row_weights.data(), pass.row_weights.size(), stream, Progress(1));
}

void Pass::run_line(int number, const Progress& progress) {
  const DoubleLine line{samples_, number, rows_, pass_.first_product, product_rows_};
  differentiate(line, filters_, of_derivatives_, derivatives_.data(), stream_);
  best_.clear();
  const std::size_t third = best_.size() / 3;
  const DoubleBest best{pass_.is_horizontal ? first_.u : first_.v,
                        pass_.is_horizontal ? wanted_.u : wanted_.v, best_.data(),
                        best_.data() + third, best_.data() + 2 * third};
  for (const int step : shears_.steps) {
    progress.check();
    multiply(line, filters_, step, of_derivatives_, derivatives_.data(), of_products_,
             products_.data(), stream_);
    average_across(line, filters_, of_products_, products_.data(), averaged_.data(), stream_);
    select(line, filters_, weights_.data(),
           {step, shears_.limit, shears_.min, shears_.max, shears_.min_distance}, of_products_,
           averaged_.data(), best, stream_);
  }
}

Tiles Pass::tiles_of(int line) const {
  const int columns = (samples_.width + pass_.tile_width - 1) / pass_.tile_width;
  const int rows = (samples_.height + pass_.tile_height - 1) / pass_.tile_height;
  return {pass_.tile_height, pass_.tile_width,      pass_.tile_stride,
          columns,           line * columns * rows, samples_.width};
}

void Pass::merge_line(int number, const Maps& maps) {
  const long pixels = static_cast<long>(samples_.height) * samples_.width;
  const int views = pass_.is_horizontal ? wanted_.u : wanted_.v;
  const long first =
      pass_.is_horizontal ? (number - first_.v) * wanted_.u * pixels : (number - first_.u) * pixels;
  const long step = pass_.is_horizontal ? pixels : wanted_.u * pixels;
  const Tiles tiles = tiles_of(number - (pass_.is_horizontal ? first_.v : first_.u));
  const std::size_t third = best_.size() / 3;
  const DoubleBest best{0, views, best_.data(), best_.data() + third, best_.data() + 2 * third};
  const dim3 grid(blocks_for(pixels, 256), static_cast<unsigned>(views));
  const double count = static_cast<double>(pixels) * views;
  launch(stream_, {"double: merge", count * 30, count * 20},
         [&] { merge<<<grid, 256, 0, stream_.get()>>>(best, maps, tiles, pixels, first, step); });
}

void Pass::run(const Maps& maps, const Progress& progress) {
  const int first = pass_.is_horizontal ? first_.v : first_.u;
  const int count = pass_.is_horizontal ? wanted_.v : wanted_.u;
  for (int i = 0; i < count; ++i) {
    run_line(first + i, progress);
    merge_line(first + i, maps);
    stream_.wait();  // a stop request ends it soon
    progress.report(static_cast<double>(i + 1) / count);
  }
}

// All passes into arrays that hold nothing yet.
void measure(const LightField& lf, const std::vector<DoublePass>& passes,
             const DoubleShears& shears, const ViewRectangle& views, LayerMemory& to,
             const DeviceStream& stream, const Progress& progress) {
  const auto light_field = on_device(lf, progress.part(0, 0));
  to.near.clear();
  to.far.clear();
  to.confidence.clear();
  double done = 0;
  for (const DoublePass& each : passes) {
    const double share = 1.0 / static_cast<double>(passes.size());
    Pass(light_field->samples(), each, shears, views.grid, views.first, stream)
        .run({to.near.data(), to.far.data(), to.confidence.data()},
             progress.part(done, done + share));
    done += share;
  }
}

}  // namespace

DeviceLayers::DeviceLayers(const LightField& lf, const std::vector<DoublePass>& passes,
                           const DoubleShears& shears, DeviceMaps& like, const Progress& progress) {
  MapMemory& maps = like.memory();
  memory_ = std::make_unique<LayerMemory>(maps.disparity.size(), maps.stream);
  measure(lf, passes, shears, {maps.first, maps.grid}, *memory_, maps.stream, progress);
}
DeviceLayers::~DeviceLayers() = default;
DeviceLayers::DeviceLayers(DeviceLayers&&) noexcept = default;

void measure_double_layers(const LightField& lf, const std::vector<DoublePass>& passes,
                           const DoubleShears& shears, const DoubleResults& results,
                           const Progress& progress) {
  const DeviceStream stream;
  LayerMemory layers(results.near.size(), stream);
  measure(lf, passes, shears, {results.near.first(), results.near.grid()}, layers, stream,
          progress.part(0, 0.9));
  download(results.near, layers.near, stream, progress);
  download(results.far, layers.far, stream, progress);
  download(results.confidence, layers.confidence, stream, progress);
}

}  // namespace episcope::cuda
