// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane/evened_views.h"

#include "engine/disparity/plane/visible_costs.h"

#include <fmt/format.h>

#include <algorithm>

namespace episcope {
namespace {

// Brightness is taken from a map of which so many pixels are sure.
constexpr double kLeastSure = 0.1;

}  // namespace

EvenedViews::EvenedViews(const LightField& lf, const PlaneParameters& parameters, Device device)
    : lf_(lf), parameters_(parameters), device_(device) {}

void EvenedViews::begin(const Progress& progress) {
  const ViewIndex view = parameters_.matching.view.value_or(lf_.center());
  if (parameters_.even && lf_.grid().contains(view)) {
    use(brightness_of_means(lf_, view, progress.part(0, 0.2)), progress.part(0.2, 0.4));
  }
  prepare(parameters_.matching, progress.part(0.4, 1));
}

void EvenedViews::improve(const MapOfView& map, const Progress& progress) {
  const Image<float> sure =
      sure_surfaces(map.disparity, map.confidence, parameters_.visibility.least_trust);
  const auto known = std::ranges::count_if(sure, [](float d) { return d > kNothingNear; });
  if (!parameters_.even) return;
  Brightness brightness;
  if (known >= kLeastSure * static_cast<double>(sure.size())) {
    brightness = brightness_of_points(lf_, stereo_.view, sure, progress.part(0, 0.4));
  }
  if (!even_ && !brightness.is_uneven()) return;
  use(brightness, progress.part(0.4, 0.6));
  StereoCostParameters matching = parameters_.matching;
  matching.range = stereo_.range;
  prepare(matching, progress.part(0.6, 1));
  if (even_) {
    note_ = fmt::format("brightness of the views evened: fall-off {:.3f}", brightness.fall_off);
  }
}

std::vector<double> EvenedViews::evened() const {
  std::vector<double> numbers{brightness_.fall_off};
  for (const auto& gain : brightness_.gains)
    numbers.insert(numbers.end(), gain.begin(), gain.end());
  return numbers;
}

void EvenedViews::restore(const std::vector<double>& evened, const Progress& progress) {
  Brightness brightness;
  brightness.fall_off = evened.front();
  for (std::size_t i = 1; i + 2 < evened.size(); i += 3) {
    brightness.gains.push_back({evened[i], evened[i + 1], evened[i + 2]});
  }
  stereo_ = {};
  use(brightness, progress);
}

void EvenedViews::use(const Brightness& brightness, const Progress& progress) {
  brightness_ = brightness;
  even_.reset();
  if (brightness.is_uneven()) even_.emplace(even_views(lf_, brightness, progress));
}

void EvenedViews::prepare(const StereoCostParameters& matching, const Progress& progress) {
  stereo_ =
      prepare_stereo(light_field(), MatchedViews::All, matching, progress.part(0, 0.9), device_);
  set_local_caps(light_field(), parameters_.visibility, progress.part(0.9, 1), stereo_);
}

}  // namespace episcope
