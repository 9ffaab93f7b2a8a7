// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/region_metrics.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace episcope {
namespace {

constexpr float kBumpinessClip = 0.05F;
constexpr double kNoError = std::numeric_limits<double>::quiet_NaN();

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
    Image<double> error(evaluation_.judged.height(), evaluation_.judged.width(), 1, kNoError);
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
        map.at(y, x) = view.is_valid(y, x) ? view.disparity.at(y, x) : kNoError;
      }
    }
    return map;
  }

  Evaluation& evaluation_;
  const RegionInput& input_;
  Image<float> bumpiness_;
  Image<float> angle_;
};

using Vector = std::array<double, 3>;

/// Position of a pixel's surface point per unit of depth.
struct PointGrid {
  double x_step = 0;
  double y_step = 0;

  PointGrid(const CameraGrid& camera, int height, int width) {
    constexpr double least_focal_px = 32;
    const double side = std::max(height, width);
    const double sensor_per_focal =
        camera.focal_length < least_focal_px ? 1 / camera.focal_length : side / camera.focal_length;
    x_step = 0.5 * sensor_per_focal / std::max(1, width - 1);
    y_step = 0.5 * sensor_per_focal / std::max(1, height - 1);
  }
};

Image<double> depth_map(const Image<double>& disparity, const CameraGrid& camera) {
  Image<double> depth(disparity.height(), disparity.width());
  std::transform(disparity.begin(), disparity.end(), depth.begin(),
                 [&](double d) { return camera.depth_from_disparity(d); });
  return depth;
}

Vector normal(const Image<double>& depth, const PointGrid& grid, int y, int x) {
  Vector along_x{};
  Vector along_y{};
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      const double weight_x = (j == 0 ? 10 : 3) * i;
      const double weight_y = (i == 0 ? 10 : 3) * j;
      const int yy = (y + j + depth.height()) % depth.height();
      const int xx = (x + i + depth.width()) % depth.width();
      const double z = depth.at(yy, xx);
      const Vector point{grid.x_step * xx * z, grid.y_step * yy * z, z};
      for (int k = 0; k < 3; ++k) {
        along_x[k] += weight_x * point[k];
        along_y[k] += weight_y * point[k];
      }
    }
  }
  Vector cross{along_x[1] * along_y[2] - along_x[2] * along_y[1],
               along_x[2] * along_y[0] - along_x[0] * along_y[2],
               along_x[0] * along_y[1] - along_x[1] * along_y[0]};
  const double length = std::hypot(cross[0], cross[1], cross[2]);
  for (double& component : cross) component /= length;
  return cross;
}

int reflected(int i, int size) {
  if (i < 0) return std::min(-i - 1, size - 1);
  return i < size ? i : std::max(2 * size - 1 - i, 0);
}

/// Difference along one axis, [3, 10, 3]/16 across it.
template <bool along_x>
Image<double> scharr(const Image<double>& map) {
  Image<double> result(map.height(), map.width());
  for (int y = 0; y < map.height(); ++y) {
    const double* rows[3] = {map.row(reflected(y - 1, map.height())), map.row(y),
                             map.row(reflected(y + 1, map.height()))};
    for (int x = 0; x < map.width(); ++x) {
      const int left = reflected(x - 1, map.width());
      const int right = reflected(x + 1, map.width());
      const double sum =
          along_x ? 3 * (rows[0][right] - rows[0][left]) + 10 * (rows[1][right] - rows[1][left]) +
                        3 * (rows[2][right] - rows[2][left])
                  : 3 * (rows[2][left] - rows[0][left]) + 10 * (rows[2][x] - rows[0][x]) +
                        3 * (rows[2][right] - rows[0][right]);
      result.at(y, x) = sum / 16;
    }
  }
  return result;
}

void append_all(Metrics& metrics, const Metrics& more, const char* suffix = "") {
  for (const auto& [key, value] : more) metrics.emplace_back(key + suffix, value);
}

bool has_region(const RegionInput& input, const std::string& name) {
  if (input.regions.contains(name)) return true;
  if (!input.options.high_res) return false;
  return std::ranges::count(input.options.high_res->regions(), name) > 0;
}

bool has_any(const RegionInput& input, std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(),
                     [&](const char* name) { return has_region(input, name); });
}

/// Whether the official tool scores all pixels of the scene in high resolution.
bool is_scored_high(StratifiedScene scene) {
  return scene == StratifiedScene::Backgammon || scene == StratifiedScene::Dots ||
         scene == StratifiedScene::Stripes;
}

/// Adds the official numbers, and why some are missing.
void append_high_res(const RegionInput& input, StratifiedScene scene, BenchmarkMetrics& metrics) {
  const HighResTruth* high_res = input.options.high_res;
  if (!high_res) return;
  const std::vector<std::string> names = high_res->regions();
  if (names.empty() && !is_scored_high(scene)) return;
  try {
    const Image<float> truth = high_res->read_disparity();
    const ResolvedErrors errors(input.estimate, truth.view(), kHighResScale, input.options);
    constexpr int border = kBenchmarkBorder * kHighResScale;
    if (is_scored_high(scene)) append_all(metrics.general, errors.general(border));
    const RegionLookup region = [&](const std::string& name) -> RegionMask {
      if (std::ranges::count(names, name) == 0) return nullptr;
      return std::make_shared<const Image<std::uint8_t>>(high_res->read_region(name));
    };
    append_all(metrics.masked, masked_metrics(errors, border, scene, region, metrics.notes));
  } catch (const Error& error) {
    metrics.notes.push_back(fmt::format(finding_text("result.high_resolution"), error.what()));
  }
}

void append_low_res(const RegionInput& input, StratifiedScene scene, BenchmarkMetrics& metrics) {
  const Image<float> truth = marked(input.truth);
  const ResolvedErrors errors(input.estimate, truth.view(), 1, input.options);
  append_all(metrics.general, errors.general(kBenchmarkBorder),
             is_scored_high(scene) ? kLowResSuffix : "");
  const RegionLookup region = [&](const std::string& name) -> RegionMask {
    const auto found = input.regions.find(name);
    if (found == input.regions.end()) return nullptr;
    return {RegionMask(), &found->second};  // borrowed
  };
  append_all(metrics.masked, masked_metrics(errors, kBenchmarkBorder, scene, region, metrics.notes),
             kLowResSuffix);
}

using Mask = Image<std::uint8_t>;

constexpr float kBadPixel = 0.07F;
constexpr float kFine = 0.15F;
constexpr float kMissedDot = 0.4F;
constexpr int kForegroundColumn = 14;     // of the views, in backgammon
constexpr int kBackgroundFromRight = 11;  // of the truth at any scale
constexpr int kDotSizes = 8;              // the largest ones count

class MaskedMetrics {
 public:
  MaskedMetrics(const ResolvedErrors& errors, int border, const RegionLookup& region,
                std::vector<std::string>& problems)
      : errors_(errors), border_(border), region_(region), problems_(problems) {}

  Metrics of(StratifiedScene scene) {
    append_photorealistic();
    if (scene == StratifiedScene::Backgammon) append_backgammon();
    if (scene == StratifiedScene::Dots) append_dots();
    if (scene == StratifiedScene::Stripes) append_stripes();
    return std::move(metrics_);
  }

 private:
  /// Appends what `value_of(mask)` yields, if there is a mask.
  template <class ValueOf>
  void append(const char* key, const char* name, ValueOf value_of) {
    try {
      const RegionMask mask = sized(name);
      if (!mask) return;
      const std::optional<double> value = value_of(*mask);
      if (value) metrics_.emplace_back(key, *value);
    } catch (const Error& error) {
      problems_.push_back(fmt::format("{} is left out: {}", key, error.what()));
    }
  }

  [[nodiscard]] RegionMask sized(const char* name) const {
    RegionMask mask = region_(name);
    const auto& truth = errors_.truth();
    if (mask && (mask->height() != truth.height || mask->width() != truth.width)) {
      throw InvalidInput(fmt::format("the region mask {} is {}×{} px, but the truth is {}×{} px",
                                     name, mask->width(), mask->height(), truth.width,
                                     truth.height));
    }
    return mask;
  }

  template <class IsBad>
  void append_percentage(const char* key, const char* name, IsBad is_bad) {
    append(key, name, [&](const Mask& mask) { return errors_.percentage(&mask, border_, is_bad); });
  }

  void append_bad_pixels(const char* key, const char* name) {
    append_percentage(key, name, [&](int y, int x, float estimate) {
      return errors_.is_off(y, x, estimate, kBadPixel);
    });
  }

  void append_photorealistic() {
    append_bad_pixels("discontinuities_0070", "discontinuities");
    append_percentage("fine_fattening_0150", "fine_surrounding", [&](int y, int x, float estimate) {
      return errors_.truth().at(y, x) - estimate < -kFine;
    });
    append_percentage("fine_thinning_0150", "fine", [&](int y, int x, float estimate) {
      return errors_.truth().at(y, x) - estimate > kFine;
    });
  }

  /// The middle between the truth of a pixel and that of its row in another column.
  [[nodiscard]] double middle(int y, int x, int column) const {
    const auto& truth = errors_.truth();
    return 0.5 * (double{truth.at(y, column)} + double{truth.at(y, x)});
  }

  void append_backgammon() {
    const int foreground = kForegroundColumn * errors_.scale();
    const int background = errors_.truth().width - kBackgroundFromRight;
    if (foreground >= errors_.truth().width || background < 0) return;
    append_percentage(
        "backgammon_fattening_0070", "foreground_fattening",
        [&](int y, int x, float estimate) { return estimate > middle(y, x, foreground); });
    append_percentage(
        "backgammon_thinning_0070", "foreground_thinning",
        [&](int y, int x, float estimate) { return estimate < middle(y, x, background); });
  }

  void append_stripes() {
    append_bad_pixels("low_texture_0070", "low_texture");
    append_bad_pixels("dark_stripes_0070", "high_contrast");
    append_bad_pixels("bright_stripes_0070", "low_contrast");
  }

  void append_dots() {
    append("background_mse_100", "background",
           [&](const Mask& mask) { return errors_.mse_100(&mask, border_); });
    append("missed_dots_50_0400", "boxes", [&](const Mask& boxes) { return missed_dots(boxes); });
  }

  [[nodiscard]] std::optional<double> missed_dots(const Mask& boxes) const {
    const RegionMask dots = sized("dots_by_size");
    if (!dots) return std::nullopt;
    struct Dot {
      std::size_t count = 0, off = 0;
    };
    std::array<std::array<Dot, kDotSizes + 1>, 256> dots_in{};
    std::array<bool, kDotSizes + 1> has_size{};
    std::array<bool, 256> has_box{};
    for (std::size_t i = 0; i < dots->size(); ++i) {
      const int size = dots->data()[i];
      if (size > 0 && size <= kDotSizes) has_size[size] = true;
      has_box[boxes.data()[i]] = true;
    }
    errors_.visit(dots.get(), 0, [&](int y, int x, float estimate) {
      const int size = dots->at(y, x);
      if (size > kDotSizes) return;
      Dot& dot = dots_in[boxes.at(y, x)][size];
      ++dot.count;
      dot.off += errors_.is_off(y, x, estimate, kMissedDot) ? 1 : 0;
    });
    const auto sizes = std::count(has_size.begin(), has_size.end(), true);
    int all = 0, missed = 0;
    for (int box = 1; box < 256; ++box) {
      for (int size = 1; has_box[box] && size <= sizes; ++size) {
        const Dot& dot = dots_in[box][size];
        ++all;
        missed += 2 * dot.off >= dot.count ? 1 : 0;
      }
    }
    if (all == 0) return std::nullopt;
    return 100.0 * missed / all;
  }

  const ResolvedErrors& errors_;
  int border_;
  const RegionLookup& region_;
  std::vector<std::string>& problems_;
  Metrics metrics_;
};

}  // namespace

void append_region_metrics(Evaluation& evaluation, const RegionInput& input) {
  RegionMetrics metrics(evaluation, input);
  metrics.append();
  if (scene_of(input) == StratifiedScene::Pyramids) metrics.append_pyramids();
}

Image<float> angle_between_normals(const Image<double>& a, const Image<double>& b,
                                   const CameraGrid& camera) {
  const PointGrid grid(camera, a.height(), a.width());
  const Image<double> depth_a = depth_map(a, camera);
  const Image<double> depth_b = depth_map(b, camera);
  Image<float> angle(a.height(), a.width());
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const Vector na = normal(depth_a, grid, y, x);
      const Vector nb = normal(depth_b, grid, y, x);
      const double cosine = na[0] * nb[0] + na[1] * nb[1] + na[2] * nb[2];
      const double bounded = std::clamp(cosine, -1.0, 1.0);
      angle.at(y, x) = static_cast<float>(std::acos(bounded) * 180 / std::numbers::pi);
    }
  }
  return angle;
}

Image<float> hessian_norm(const Image<double>& map) {
  const Image<double> dx = scharr<true>(map);
  const Image<double> dy = scharr<false>(map);
  const Image<double> terms[] = {scharr<true>(dx), scharr<false>(dx), scharr<true>(dy),
                                 scharr<false>(dy)};
  Image<float> norm(map.height(), map.width());
  for (std::size_t i = 0; i < norm.size(); ++i) {
    double sum = 0;
    for (const auto& term : terms) sum += term.data()[i] * term.data()[i];
    norm.data()[i] = static_cast<float>(std::sqrt(sum));
  }
  return norm;
}

StratifiedScene scene_of(const RegionInput& input) {
  if (input.options.stratified != StratifiedScene::None) return input.options.stratified;
  if (has_any(input, {"foreground_fattening", "foreground_thinning"})) {
    return StratifiedScene::Backgammon;
  }
  if (has_any(input, {"dots_by_size"})) return StratifiedScene::Dots;
  if (has_any(input, {"pyramids", "sphere_in", "sphere_out"})) return StratifiedScene::Pyramids;
  if (has_any(input, {"low_texture", "high_contrast", "low_contrast"})) {
    return StratifiedScene::Stripes;
  }
  return StratifiedScene::None;
}

BenchmarkMetrics benchmark_metrics(const RegionInput& input) {
  const StratifiedScene scene = scene_of(input);
  BenchmarkMetrics metrics;
  append_high_res(input, scene, metrics);
  append_low_res(input, scene, metrics);
  return metrics;
}

Metrics masked_metrics(const ResolvedErrors& errors, int border, StratifiedScene scene,
                       const RegionLookup& region, std::vector<std::string>& problems) {
  return MaskedMetrics(errors, border, region, problems).of(scene);
}

}  // namespace episcope
