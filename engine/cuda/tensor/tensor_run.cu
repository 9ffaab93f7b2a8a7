// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/tensor/tensor_run.cuh"

#include "engine/cuda/device/device_array.cuh"
#include "engine/cuda/tensor/best_tensors.cuh"
#include "engine/cuda/tensor/derivative_planes.cuh"
#include "engine/cuda/tensor/tensor_average.cuh"

#include <algorithm>
#include <array>

namespace episcope::cuda {
namespace {

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

}  // namespace episcope::cuda
