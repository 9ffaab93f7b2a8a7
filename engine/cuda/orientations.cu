// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/orientations.h"

#include "engine/cuda/device.cuh"
#include "engine/cuda/device_data.cuh"
#include "engine/cuda/host_pages.h"
#include "engine/cuda/tensor.cuh"

#include <algorithm>
#include <array>

namespace episcope::cuda {
namespace {

constexpr int kTile = 32;
constexpr int kRows = 8;

// What is known of one ray.
struct Orientation {
  float disparity, coherence;
};

// The slope of ∂s + d ∂x = 0, −d, of one tensor by least squares.
__device__ float slope_of(const Tensor& tensor) {
  return tensor.xs * reciprocal(tensor.xx + 1e-20F);
}

__device__ float agreement(const Tensor& tensor, float own) {
  const float off = tensor.xs - own * tensor.xx;
  const float agreeing = kTensorDisagreement * (tensor.xx * tensor.xx) + 1e-30F;
  return agreeing * reciprocal(agreeing + off * off);
}

// Least squares of ∂s + d ∂x = 0; coherence in the frame sheared by d.
__device__ Orientation read_off(const Tensor& sum, const AverageSettings& settings) {
  const float xx = sum.xx + 1e-20F;
  const float disparity = -sum.xs * reciprocal(xx);
  const float residual = fmaxf(sum.ss + disparity * sum.xs, 0);
  float coherence = (xx - residual) * reciprocal(xx + residual + settings.noise_energy);
  const bool inside = disparity >= settings.min && disparity <= settings.max;
  if (!(inside && coherence > 0)) coherence = 0;
  return {fminf(fmaxf(disparity, settings.min), settings.max), coherence};
}

// `best` stands at the lane of EPI 0 of the band.
__device__ Orientation averaged(const AveragedBand& averaged, const AverageSettings& settings,
                                const float* best, int epi) {
  const EpiBand& band = averaged.band;
  const long part = static_cast<long>(band.count) * band.length;
  const int radius = settings.across.count / 2;
  const auto tensor_of = [&](int i) {
    const int neighbor = min(max(epi + i, 0), averaged.last_epi) - band.first;
    return load(best + static_cast<long>(neighbor) * band.length, part);
  };
  const Tensor middle = tensor_of(0);
  const float own = slope_of(middle);
  Tensor sum{0, 0, 0};
  add(sum, settings.across.values[radius], middle);
  for (int i = -radius; i <= radius; ++i) {
    if (i == 0) continue;
    const Tensor tensor = tensor_of(i);
    add(sum, settings.across.values[radius + i] * agreement(tensor, own), tensor);
  }
  return read_off(sum, settings);
}

__device__ float raised(float base, int power) {
  float result = 1;
  for (; power > 0; power >>= 1) {
    if ((power & 1) != 0) result *= base;
    base *= base;
  }
  return result;
}

// Estimates of vertical EPIs merged into those of horizontal ones.
__device__ Orientation merged(const Orientation& vertical, const Orientation& horizontal,
                              const AverageSettings& settings) {
  const bool wins = vertical.coherence > horizontal.coherence;
  const Orientation winner = wins ? vertical : horizontal;
  const bool agree = fabsf(vertical.disparity - horizontal.disparity) < kDirectionAgreement &&
                     vertical.coherence > 0 && horizontal.coherence > 0;
  if (settings.takes_winner || !agree) return winner;
  const float weight = raised(vertical.coherence, settings.fusion_power);
  const float share =
      weight / (weight + raised(horizontal.coherence, settings.fusion_power) + 1e-30F);
  return {horizontal.disparity + share * (vertical.disparity - horizontal.disparity),
          winner.coherence};
}

// Writes the estimate of a pixel of the maps; `pixel` is the same one of the samples.
__device__ void write(const DeviceSamples& samples, Orientation found,
                      const AverageSettings& settings, const MapPointers& maps, long at,
                      long pixel) {
  if (settings.outcome == Outcome::MergedIntoNothing) found = merged(found, {0, 0}, settings);
  if (settings.outcome == Outcome::MergedWithStored) {
    found = merged({maps.disparity[at], maps.confidence[at]}, found, settings);
  }
  if (settings.is_last) {
    if (samples.valid && samples.valid[pixel] == 0) found.coherence = 0;
    if (settings.squares_coherence) found.coherence *= found.coherence;
    if (settings.clamps) {
      found.disparity = fminf(fmaxf(found.disparity, settings.clamp_min), settings.clamp_max);
    }
  }
  maps.disparity[at] = found.disparity;
  maps.confidence[at] = found.coherence;
}

__device__ void write_at(const DeviceSamples& samples, const EpiBand& band, int view, int y, int x,
                         const Orientation& found, const AverageSettings& settings,
                         const MapPointers& maps) {
  const int v = band.is_vertical ? view : band.line, u = band.is_vertical ? band.line : view;
  const long inside = static_cast<long>(y) * samples.width + x;
  const long size = static_cast<long>(samples.height) * samples.width;
  write(samples, found, settings, maps, maps.index(v, u) * size + inside,
        samples.pixel(v, u, y, x));
}

template <bool kVertical>
__global__ __launch_bounds__(kTile* kRows) void average(DeviceSamples samples, AveragedBand band,
                                                        WantedViews wanted, const float* best,
                                                        AverageSettings settings,
                                                        MapPointers maps) {
  __shared__ float2 tile[kTile][kTile + 1];
  const int view = static_cast<int>(blockIdx.z);
  const int first_lane = static_cast<int>(blockIdx.x) * kTile;
  const int first_epi = band.first + static_cast<int>(blockIdx.y) * kTile;
  const int lane = first_lane + static_cast<int>(threadIdx.x);
  const int end = band.first + band.count;
  best += 3L * view * band.band.count * band.band.length + lane;
  for (int i = threadIdx.y; i < kTile; i += kRows) {
    const int epi = first_epi + i;
    if (lane >= band.band.length || epi >= end) continue;
    const Orientation found = averaged(band, settings, best, epi);
    if (kVertical) {
      tile[i][threadIdx.x] = {found.disparity, found.coherence};
    } else {
      write_at(samples, band.band, wanted.first + view, epi, lane, found, settings, maps);
    }
  }
  if (!kVertical) return;
  __syncthreads();
  // Lanes are rows of the image: neighboring threads write neighboring columns.
  const int x = first_epi + static_cast<int>(threadIdx.x);
  for (int i = threadIdx.y; i < kTile; i += kRows) {
    const int y = first_lane + i;
    if (y >= band.band.length || x >= end) continue;
    const float2 found = tile[threadIdx.x][i];
    write_at(samples, band.band, wanted.first + view, y, x, {found.x, found.y}, settings, maps);
  }
}

// Of the free memory, what a band may take, and at most.
constexpr double kShare = 0.5;
constexpr double kMostBytes = 768e6;

// Keeps the host at most two bands ahead of the device, so that a stop request is soon obeyed.
class Pace {
 public:
  explicit Pace(const DeviceStream& stream) : stream_(stream) {
    for (cudaEvent_t& event : events_) {
      check(cudaEventCreateWithFlags(&event, cudaEventDisableTiming));
    }
  }
  ~Pace() {
    for (cudaEvent_t event : events_) cudaEventDestroy(event);
  }
  Pace(const Pace&) = delete;
  Pace& operator=(const Pace&) = delete;

  // Before a band is begun.
  void wait() {
    cudaEvent_t event = events_[bands_++ % events_.size()];
    check(cudaEventSynchronize(event));
    check(cudaEventRecord(event, stream_.get()));
  }

 private:
  const DeviceStream& stream_;
  std::array<cudaEvent_t, 2> events_{};
  std::size_t bands_ = 0;
};

// The EPIs of one direction, one line of cameras after the other.
class DirectionRun {
 public:
  DirectionRun(const DeviceSamples& samples, const TensorSettings& settings, bool is_vertical,
               const MapPointers& maps, const DeviceStream& stream);

  void run(const AverageSettings& averages, const Progress& progress,
           const std::function<void(int line)>& on_line);

 private:
  [[nodiscard]] int last_epi() const {
    return (is_vertical_ ? samples_.width : samples_.height) - 1;
  }
  void upload_filters(const ViewFilters& filters);
  void size_bands();
  void run_band(int line, int first, const AverageSettings& averages);

  const DeviceSamples& samples_;
  const TensorSettings& settings_;
  bool is_vertical_;
  const MapPointers& maps_;
  const DeviceStream& stream_;
  TensorSearchFilters search_;
  NineViewFilters nine_;
  EpiBand band_;     // with the most EPIs
  int results_ = 0;  // EPIs with results of a band, at most
  WantedViews wanted_;
  DeviceArray<ViewFilter> filters_;
  DeviceArray<float2> planes_;
  DeviceArray<float> best_;
  Pace pace_;
};

DirectionRun::DirectionRun(const DeviceSamples& samples, const TensorSettings& settings,
                           bool is_vertical, const MapPointers& maps, const DeviceStream& stream)
    : samples_(samples),
      settings_(settings),
      is_vertical_(is_vertical),
      maps_(maps),
      stream_(stream),
      pace_(stream) {
  const ViewFilters& filters = is_vertical ? settings.vertical : settings.horizontal;
  search_.first_shear = settings.first_shear;
  search_.shear_step = settings.shear_step;
  search_.shear_count = settings.shear_count;
  search_.along = lane_taps(settings.integrate);
  search_.along_half = lane_taps(settings.integrate_half);
  search_.contrast_energy = settings.contrast_energy;
  search_.noise_energy = settings.noise_energy;
  search_.limit = settings.limit;
  search_.min = settings.min;
  search_.max = settings.max;
  search_.eigenvector = settings.eigenvector;
  upload_filters(filters);
  nine_ = nine_view_filters(filters);
  band_.is_vertical = is_vertical;
  band_.views = filters.views();
  band_.channels = samples.channels;
  band_.length = is_vertical ? samples.height : samples.width;
  band_.margin =
      needed_margin(filters, search_.largest_shear(), static_cast<int>(settings.smooth.size()) / 2,
                    search_.along.count / 2);
  constexpr int kUnit = 16;  // float2, so that rows begin at whole lines of the cache
  band_.pitch = (band_.length + 2 * band_.margin + kUnit - 1) / kUnit * kUnit;
  const int first = is_vertical ? maps.first.v : maps.first.u;
  wanted_ = {first, first + (is_vertical ? maps.grid.v : maps.grid.u)};
  size_bands();
}

void DirectionRun::upload_filters(const ViewFilters& filters) {
  std::vector<ViewFilter> all;
  for (const auto* each : {&filters.smooth, &filters.derivative, &filters.integrate}) {
    all.insert(all.end(), each->begin(), each->end());
  }
  filters_ = DeviceArray<ViewFilter>(all.size(), stream_);
  // From memory that is not pinned: the host's may go when the call returns.
  check(cudaMemcpyAsync(filters_.data(), all.data(), filters_.byte_size(), cudaMemcpyHostToDevice,
                        stream_.get()));
  search_.smooth = filters_.data();
  search_.derivative = search_.smooth + filters.views();
  search_.integrate = search_.derivative + filters.views();
}

void DirectionRun::size_bands() {
  std::size_t free = 0, total = 0;
  check(cudaMemGetInfo(&free, &total));
  const double most = std::min(kShare * static_cast<double>(free), kMostBytes);
  band_.count = 1;
  const bool with_half = search_.has_half_shear();
  const double each =
      static_cast<double>(DerivativePlanes::size(band_, with_half)) * sizeof(float2) +
      3.0 * wanted_.count() * band_.length * sizeof(float);
  const int reach = static_cast<int>(settings_.across.size()) - 1;
  const int all = last_epi() + 1;
  results_ = std::clamp(static_cast<int>(most / each) - reach, 1, all);
  band_.count = std::min(results_ + reach, all);
  planes_ = DeviceArray<float2>(DerivativePlanes::size(band_, with_half), stream_);
  best_ = DeviceArray<float>(3L * wanted_.count() * band_.count * band_.length, stream_);
}

void DirectionRun::run_band(int line, int first, const AverageSettings& averages) {
  const int reach = averages.across.count / 2;
  const int count = std::min(results_, last_epi() + 1 - first);
  EpiBand band = band_;
  band.line = line;
  band.first = std::max(first - reach, 0);
  band.count = std::min(first + count + reach, last_epi() + 1) - band.first;
  const DerivativePlanes planes{planes_.data(), search_.has_half_shear()};
  differentiate(samples_, band, lane_taps(settings_.smooth), planes, stream_);
  find_best_tensors(band, planes, search_, nine_, wanted_, best_.data(), stream_);
  average_tensors(samples_, {band, first, count, last_epi()}, wanted_, best_.data(), averages,
                  maps_, stream_);
}

void DirectionRun::run(const AverageSettings& averages, const Progress& progress,
                       const std::function<void(int line)>& on_line) {
  const int first_line = is_vertical_ ? maps_.first.u : maps_.first.v;
  const int lines = is_vertical_ ? maps_.grid.u : maps_.grid.v;
  for (int line = 0; line < lines; ++line) {
    for (int first = 0; first <= last_epi(); first += results_) {
      progress.check();
      pace_.wait();
      run_band(first_line + line, first, averages);
    }
    if (on_line) on_line(line);
    progress.report(static_cast<double>(line + 1) / lines);
  }
}

AverageSettings averages_of(const TensorSettings& settings) {
  AverageSettings averages;
  averages.across = lane_taps(settings.across);
  averages.noise_energy = settings.noise_energy;
  averages.min = settings.min;
  averages.max = settings.max;
  averages.takes_winner = settings.takes_winner;
  averages.fusion_power = settings.fusion_power;
  averages.squares_coherence = settings.squares_coherence;
  averages.clamps = settings.clamps;
  averages.clamp_min = settings.clamp_min;
  averages.clamp_max = settings.clamp_max;
  return averages;
}

}  // namespace

void average_tensors(const DeviceSamples& samples, const AveragedBand& band, WantedViews wanted,
                     const float* best, const AverageSettings& settings, const MapPointers& maps,
                     const DeviceStream& stream) {
  const bool is_vertical = band.band.is_vertical;
  const dim3 grid(blocks_for(band.band.length, kTile), blocks_for(band.count, kTile),
                  static_cast<unsigned>(wanted.count()));
  const double rays = static_cast<double>(band.count) * band.band.length * wanted.count();
  const double maps_moved = settings.outcome == Outcome::MergedWithStored ? 4 : 2;
  const KernelWork work{is_vertical ? "averages, vertical" : "averages, horizontal",
                        rays * (3 + maps_moved) * sizeof(float),
                        rays * (settings.across.count * 18.0 + 20)};
  launch(stream, work, [&] {
    const auto kernel = is_vertical ? average<true> : average<false>;
    kernel<<<grid, dim3(kTile, kRows), 0, stream.get()>>>(samples, band, wanted, best, settings,
                                                          maps);
  });
}

// Vertical EPIs come first, so that rows of views are done one after the other.
void find_orientations_on_device(const DeviceSamples& samples, const TensorSettings& settings,
                                 const MapPointers& maps, const DeviceStream& stream,
                                 const Progress& progress, const MapsBegun& on_maps) {
  const bool has_horizontal = settings.horizontal.views() > 0;
  const bool has_vertical = settings.vertical.views() > 0;
  const double half = !has_vertical ? 0 : !has_horizontal ? 1 : 0.5;
  AverageSettings averages = averages_of(settings);
  if (has_vertical) {
    progress.step("vertical EPIs");
    averages.is_last = !has_horizontal;
    if (averages.is_last && settings.merges) averages.outcome = Outcome::MergedIntoNothing;
    DirectionRun(samples, settings, true, maps, stream).run(averages, progress.part(0, half), {});
  }
  if (has_horizontal) {
    progress.step("horizontal EPIs");
    averages.is_last = true;
    averages.outcome = has_vertical ? Outcome::MergedWithStored : Outcome::Stored;
    const auto on_line = [&](int line) {
      if (on_maps) on_maps(line * maps.grid.u, maps.grid.u);
    };
    DirectionRun(samples, settings, false, maps, stream)
        .run(averages, progress.part(half, 1), on_line);
  } else if (on_maps) {
    on_maps(0, maps.grid.count());
  }
}

void find_orientations(const LightField& lf, const TensorSettings& settings, DeviceMaps& maps,
                       const Progress& progress) {
  MapMemory& memory = maps.memory();
  find_orientations_on_device(memory.samples(lf, progress), settings, memory.pointers(),
                              memory.stream, progress);
}

void find_orientations(const LightField& lf, const TensorSettings& settings,
                       ViewStack<float>& disparity, ViewStack<float>& confidence,
                       const Progress& progress) {
  const auto of_disparity = begin_pages(disparity, progress);
  const auto of_confidence = begin_pages(confidence, progress);
  const auto light_field = on_device(lf, progress.part(0, 0));
  const DeviceStream stream;
  DeviceArray<float> d(disparity.size(), stream), r(confidence.size(), stream);
  PipelinedDownload downloads(stream, progress.part(0, 0));
  const auto begin_download = [&](int first, int count) {
    const std::size_t from = first * disparity.view_size(), size = count * disparity.view_size();
    downloads.add(disparity.data() + from, d.data() + from, size * sizeof(float));
    downloads.add(confidence.data() + from, r.data() + from, size * sizeof(float));
  };
  find_orientations_on_device(light_field->samples(), settings,
                              {disparity.grid(), disparity.first(), d.data(), r.data()}, stream,
                              progress, begin_download);
  downloads.finish();
}

}  // namespace episcope::cuda
