// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/metrics/masked_metrics.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace episcope {
namespace {

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

Metrics masked_metrics(const ResolvedErrors& errors, int border, StratifiedScene scene,
                       const RegionLookup& region, std::vector<std::string>& problems) {
  return MaskedMetrics(errors, border, region, problems).of(scene);
}

}  // namespace episcope
