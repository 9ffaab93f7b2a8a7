// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/stereo/stereo_matcher.h"

#include "engine/cuda/device/device_volume.cuh"
#include "engine/cuda/device/transfer.cuh"
#include "engine/cuda/light_field/device_light_field.cuh"
#include "engine/cuda/stereo/cost_winners.cuh"
#include "engine/cuda/stereo/guided_costs.cuh"
#include "engine/cuda/stereo/matching_tables.cuh"
#include "engine/cuda/stereo/ranked_values.cuh"
#include "engine/cuda/stereo/view_noise.cuh"
#include "engine/cuda/stereo/view_planes.cuh"
#include "engine/cuda/stereo/view_surfaces.cuh"
#include "engine/cuda/stereo/volume_scale.cuh"

#include <algorithm>
#include <limits>
#include <numeric>

namespace episcope::cuda {
namespace {

// Costs that are held at once, where only the winners are asked for.
constexpr std::size_t kBandBytes = std::size_t{1} << 29;
constexpr int kLeastBandRows = 32;
// Pixels, labels and views of one launch: some ten milliseconds.
constexpr double kSamplesAtOnce = 1e10;

}  // namespace

struct StereoMatcher::State {
  std::shared_ptr<const DeviceLightField> compared, shown;
  ViewIndex view;
  DeviceStream stream;
  DeviceArray<float> samples_of_views, noise, guide, caps, surfaces;
  Visibility visibility;
  float mean_cap = 0;
  ViewPlanes planes;
  int radius = 0;

  [[nodiscard]] const DeviceSamples& samples() const { return compared->samples(); }
  [[nodiscard]] DeviceMatching on_device(const StereoMatching& matching) const {
    return {matching, planes, noise.data(), stream};
  }
  [[nodiscard]] CostRows with_margin(const CostRows& rows) const;
  void compute(const MatchingTables& tables, const CostRows& rows, float* costs,
               const Progress& progress) const;
  void aggregate(const CostRows& from, const float* costs, const CostRows& to,
                 float* filtered) const;
};

// The rows that aggregation needs.
CostRows StereoMatcher::State::with_margin(const CostRows& rows) const {
  const int first = std::max(rows.first - 2 * radius, 0);
  const int end = std::min(rows.first + rows.rows + 2 * radius, samples().height);
  return {first, end - first, rows.labels};
}

// Piece by piece, so that a stop request need not wait long.
void StereoMatcher::State::compute(const MatchingTables& tables, const CostRows& rows, float* costs,
                                   const Progress& progress) const {
  const double row_samples =
      static_cast<double>(samples().width) * tables.labels * tables.view_count;
  const int at_once = std::max(kLeastBandRows, static_cast<int>(kSamplesAtOnce / row_samples) /
                                                   kLeastBandRows * kLeastBandRows);
  const bool is_long = rows.rows > at_once;
  for (int row = 0; row < rows.rows; row += at_once) {
    progress.check();
    const std::size_t begin = static_cast<std::size_t>(row) * rows.labels * samples().width;
    compute_costs(tables, rows.first + row, std::min(at_once, rows.rows - row), costs + begin,
                  stream);
    if (is_long) stream.wait();
    progress.report(static_cast<double>(row + at_once) / rows.rows);
  }
}

void StereoMatcher::State::aggregate(const CostRows& from, const float* costs, const CostRows& to,
                                     float* filtered) const {
  const DeviceGuide tables{guide.data(), radius, samples().height, samples().width,
                           shown->samples().channels};
  filter_costs(tables, from, costs, to, filtered, stream);
}

StereoMatcher::StereoMatcher(const LightField& compared, const LightField& shown, ViewIndex view,
                             bool is_cross_hair, const Progress& progress)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.shown = on_device(shown, progress);
  s.compared =
      &compared == &shown ? s.shown : std::make_shared<DeviceLightField>(compared, progress);
  s.view = view;
  const DeviceSamples& samples = s.samples();
  s.planes = {nullptr,       samples.grid,    view, is_cross_hair, samples.height,
              samples.width, samples.channels};
  s.samples_of_views = make_view_planes(samples, s.planes, s.stream);
  s.planes.planes = s.samples_of_views.data();
}
StereoMatcher::~StereoMatcher() = default;

std::vector<float> StereoMatcher::least_costs(const StereoMatching& matching,
                                              const std::vector<int>& rows, float most,
                                              const std::vector<int>& ranks,
                                              const Progress& progress) {
  State& s = *state_;
  progress.check();
  const DeviceMatching tables = s.on_device(matching);
  const auto on_device = upload(rows.data(), rows.size(), s.stream, progress);
  DeviceArray<float> found(rows.size() * s.samples().width, s.stream);
  find_least_costs(tables.tables(), s.samples(), on_device.data(), static_cast<int>(rows.size()),
                   most, found.data(), s.stream);
  return ranked_on_device(found.data(), static_cast<int>(found.size()), ranks, s.stream);
}

void StereoMatcher::compensate_noise(float most, const Progress& progress) {
  State& s = *state_;
  progress.check();
  s.noise = local_noise_on_device(s.samples(), s.view, most, s.stream);
}

float StereoMatcher::median_noise() const {
  const State& s = *state_;
  if (s.noise.empty()) return 0;
  return median_on_device(s.noise.data(), static_cast<int>(s.noise.size()), s.stream);
}

float StereoMatcher::noise_variance(const Progress& progress) const {
  progress.check();
  const DeviceArray<float> noise =
      local_noise_on_device(state_->shown->samples(), state_->view,
                            std::numeric_limits<float>::infinity(), state_->stream);
  return median_on_device(noise.data(), static_cast<int>(noise.size()), state_->stream);
}

void StereoMatcher::aggregate(int radius, double regularization) {
  State& s = *state_;
  s.radius = radius;
  s.guide = make_guide_planes(s.shown->samples(), s.view, radius, regularization, s.stream);
}

void StereoMatcher::choose(const StereoMatching& matching, const LabelPlaces& places,
                           ImageView<float> disparity, ImageView<float> confidence,
                           const Progress& progress) {
  State& s = *state_;
  const DeviceMatching tables = s.on_device(matching);
  const int height = s.samples().height, width = s.samples().width;
  const std::size_t row_size = static_cast<std::size_t>(matching.labels) * width;
  const int fit = static_cast<int>(kBandBytes / (row_size * sizeof(float)));
  const int at_once = std::min(height, std::max(fit, kLeastBandRows));
  const int margins = std::min(height, at_once + 4 * s.radius);
  DeviceArray<float> costs(margins * row_size, s.stream);
  DeviceArray<float> filtered(s.radius > 0 ? at_once * row_size : 0, s.stream);
  const std::size_t pixels = static_cast<std::size_t>(height) * width;
  DeviceArray<float> maps(2 * pixels, s.stream);
  for (int y = 0; y < height; y += at_once) {
    const CostRows rows{y, std::min(at_once, height - y), matching.labels};
    const CostRows needed = s.with_margin(rows);
    const Progress part =
        progress.part(static_cast<double>(y) / height, static_cast<double>(y + rows.rows) / height);
    s.compute(tables.tables(), needed, costs.data(), part);
    if (s.radius > 0) s.aggregate(needed, costs.data(), rows, filtered.data());
    const VolumeView<const float> band{s.radius > 0 ? filtered.data() : costs.data(), rows.rows,
                                       matching.labels, width};
    float* const from_y = maps.data() + static_cast<std::size_t>(y) * width;
    choose_winners(band, places, from_y, from_y + pixels, s.stream);
  }
  // Memory that was never touched takes as long as the costs: meanwhile.
  for (const ImageView<float>& map : {disparity, confidence}) std::fill_n(map.data, pixels, 0.0F);
  PipelinedDownload download(s.stream, progress);
  download.add(disparity.data, maps.data(), pixels * sizeof(float));
  download.add(confidence.data, maps.data() + pixels, pixels * sizeof(float));
  download.finish();
}

Image<float> StereoMatcher::noise(const Progress& progress) const {
  const State& s = *state_;
  if (s.noise.empty()) return {};
  Image<float> noise(s.samples().height, s.samples().width);
  download_bytes(noise.data(), s.noise.data(), s.noise.byte_size(), s.stream, progress);
  return noise;
}

void StereoMatcher::set_caps(const Image<float>& caps, const Progress& progress) {
  State& s = *state_;
  s.caps = upload(caps.data(), caps.size(), s.stream, progress);
  s.visibility.caps = s.caps.data();
  s.mean_cap = static_cast<float>(std::accumulate(caps.begin(), caps.end(), 0.0) /
                                  static_cast<double>(caps.size()));
}

void StereoMatcher::set_occluders(const Image<float>& surface, float tolerance, float softness,
                                  const Progress& progress) {
  State& s = *state_;
  const auto disparity = upload(surface.data(), surface.size(), s.stream, progress);
  s.surfaces = {};  // before the next ones take their place
  s.surfaces = cast_surfaces(s.planes, disparity.data(), s.stream);
  s.visibility.nearest = s.surfaces.data();
  s.visibility.tolerance = tolerance;
  s.visibility.softness = softness;
}

SharedVolume StereoMatcher::volume(const StereoMatching& matching, const Progress& progress) {
  State& s = *state_;
  const DeviceMatching tables(matching, s.planes, s.noise.data(), s.stream, s.visibility);
  const CostRows all{0, s.samples().height, matching.labels};
  const auto make = [&] {
    return std::make_shared<DeviceVolume>(all.rows, all.labels, s.samples().width);
  };
  // The stream of a volume frees it; what is written here comes after its allocation there.
  auto costs = make();
  costs->stream.wait();
  s.compute(tables.tables(), all, costs->values.data(), progress);
  if (s.radius > 0) {
    auto filtered = make();
    filtered->stream.wait();
    s.aggregate(all, costs->values.data(), all, filtered->values.data());
    s.stream.wait();
    costs = std::move(filtered);
  }
  if (s.visibility.caps != nullptr) {
    divide_by_caps(*costs, s.visibility.caps, s.mean_cap, s.stream);
  }
  s.stream.wait();
  return costs;
}

}  // namespace episcope::cuda
