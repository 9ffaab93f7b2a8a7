// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/metrics/region_metrics.h"

#include "engine/evaluation/metrics/benchmark_metrics.h"
#include "engine/evaluation/metrics/bumpiness.h"
#include "engine/evaluation/metrics/normals.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope {
namespace {

constexpr float kBumpinessClip = 0.05F;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class RegionMetrics {
 public:
  RegionMetrics(Evaluation& evaluation, const RegionInput& input)
      : evaluation_(evaluation), input_(input) {}

  void append() {
    append_bumpiness("bumpiness_planes_100_0050", region("planes"));
    append_bumpiness("bumpiness_contin_surfaces_100_0050", region("smooth_surfaces"));
    append_angle("mae_planes", region("planes"));
    append_angle("mae_contin_surfaces", region("smooth_surfaces"));
  }

  /// Those of the scene pyramids.
  void append_pyramids() {
    const auto *in = region("sphere_in"), *out = region("sphere_out"), *sides = region("pyramids");
    if (in && out && sides) {
      Image<std::uint8_t> slanted = *in;
      for (std::size_t i = 0; i < slanted.size(); ++i) {
        slanted.data()[i] |= out->data()[i] | sides->data()[i];
      }
      append_bumpiness("bumpiness_slanted_100_0050", &slanted);
    }
    append_bumpiness("bumpiness_parallel_100_0050", region("plane"));
  }

 private:
  [[nodiscard]] const Image<std::uint8_t>* region(const char* name) const {
    const auto found = input_.regions.find(name);
    if (found == input_.regions.end()) return nullptr;
    return &found->second;
  }

  /// Values of `map` inside the region. Where it has none, the pixel counts as `worst` if that is
  /// the estimate's doing and missing values are bad; else it is left out.
  [[nodiscard]] std::vector<float> values_inside(const Image<float>& map,
                                                 const Image<std::uint8_t>& mask,
                                                 float worst) const {
    std::vector<float> values;
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        if (mask.at(y, x) == 0 || evaluation_.judged.at(y, x) == 0) continue;
        if (std::isfinite(map.at(y, x)) && evaluation_.missing.at(y, x) == 0) {
          values.push_back(map.at(y, x));
        } else if (input_.options.invalid == InvalidEstimates::Bad && truth_is_whole(y, x)) {
          values.push_back(worst);
        }
      }
    }
    return values;
  }

  /// Whether the truth has values as far as derivatives reach.
  [[nodiscard]] bool truth_is_whole(int y, int x) const {
    constexpr int reach = 2;
    const int last_y = std::min(y + reach, evaluation_.judged.height() - 1);
    const int last_x = std::min(x + reach, evaluation_.judged.width() - 1);
    for (int j = std::max(0, y - reach); j <= last_y; ++j) {
      for (int i = std::max(0, x - reach); i <= last_x; ++i) {
        if (!input_.truth.is_valid(j, i)) return false;
      }
    }
    return true;
  }

  void append_bumpiness(const char* key, const Image<std::uint8_t>* mask) {
    if (!mask) return;
    if (bumpiness_.empty()) bumpiness_ = hessian_norm(error_everywhere());
    const auto values = values_inside(bumpiness_, *mask, kBumpinessClip);
    if (values.empty()) return;
    double sum = 0;
    for (const float value : values) sum += std::min(value, kBumpinessClip);
    evaluation_.metrics.emplace_back(key, 100 * sum / static_cast<double>(values.size()));
  }

  void append_angle(const char* key, const Image<std::uint8_t>* mask) {
    if (!mask || !input_.options.camera.is_known()) return;
    if (angle_.empty()) {
      angle_ = angle_between_normals(disparity_map(input_.estimate), disparity_map(input_.truth),
                                     input_.options.camera);
    }
    constexpr float opposite = 180;
    auto values = values_inside(angle_, *mask, opposite);
    if (values.empty()) return;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    double median = *middle;
    if (values.size() % 2 == 0) median = (median + *std::max_element(values.begin(), middle)) / 2;
    evaluation_.metrics.emplace_back(key, median);
  }

  /// estimate − truth, also outside the judged pixels, since derivatives reach over the border; NaN
  /// where one of them has no value.
  [[nodiscard]] Image<double> error_everywhere() const {
    Image<double> error(evaluation_.judged.height(), evaluation_.judged.width(), 1, kNan);
    for (int y = 0; y < error.height(); ++y) {
      for (int x = 0; x < error.width(); ++x) {
        if (!input_.estimate.is_valid(y, x) || !input_.truth.is_valid(y, x)) continue;
        error.at(y, x) = input_.estimate.disparity.at(y, x) - input_.truth.disparity.at(y, x);
      }
    }
    return error;
  }

  [[nodiscard]] static Image<double> disparity_map(const DisparityView& view) {
    Image<double> map(view.disparity.height, view.disparity.width);
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        map.at(y, x) = view.is_valid(y, x) ? view.disparity.at(y, x) : kNan;
      }
    }
    return map;
  }

  Evaluation& evaluation_;
  const RegionInput& input_;
  Image<float> bumpiness_;
  Image<float> angle_;
};

}  // namespace

void append_region_metrics(Evaluation& evaluation, const RegionInput& input) {
  RegionMetrics metrics(evaluation, input);
  metrics.append();
  if (scene_of(input) == StratifiedScene::Pyramids) metrics.append_pyramids();
}

}  // namespace episcope
