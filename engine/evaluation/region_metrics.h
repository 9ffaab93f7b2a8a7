// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/camera_grid.h"
#include "engine/core/image.h"
#include "engine/evaluation/metrics.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// Errors of one map against a truth of its own size or `scale` times as large, pixel by pixel of
/// the truth, without ever storing the enlarged map. Pixel k of N along an axis belongs to
/// the pixel of the map nearest to k·(n − 1)/(N − 1). Corners lie on corners, as in the zoom of
/// order 0 of the official toolkit, so blocks at the border are scale/2 + 1 wide. Errors are truth
/// − estimate in float. Source: evaluation toolkit of [HJKG16].
class ResolvedErrors {
 public:
  /// Borrows all three. `truth` that is not finite is not judged, nor are pixels where `shown` (of
  /// the size of the map; empty = all) is 0. Throws InvalidInput unless the truth is `scale` times
  /// as large as the map.
  ResolvedErrors(const DisparityView& estimate, ImageView<const float> truth, int scale,
                 const EvaluationOptions& options);

  [[nodiscard]] int scale() const { return scale_; }
  [[nodiscard]] const ImageView<const float>& truth() const { return truth_; }

  /// Calls `visit(y, x, estimate)` for every judged pixel where `mask` is not 0 (null = anywhere)
  /// at least `border` px of the truth from its border. A missing estimate is NaN. Throws
  /// Cancelled.
  template <class Visit>
  void visit(const Image<std::uint8_t>* mask, int border, Visit visit) const;

  /// Percentage of these pixels that are bad: `is_bad(y, x, estimate)`, or missing ones as
  /// `InvalidEstimates` says. Empty if there is no such pixel.
  template <class IsBad>
  [[nodiscard]] std::optional<double> percentage(const Image<std::uint8_t>* mask, int border,
                                                 IsBad is_bad) const;

  /// Whether |error| > `limit`, strictly; missing ones as `InvalidEstimates` says.
  [[nodiscard]] bool is_off(int y, int x, float estimate, float limit) const {
    if (std::isnan(estimate)) return invalid_ == InvalidEstimates::Bad;
    return std::abs(truth_.at(y, x) - estimate) > limit;
  }

  /// 100 · mean of the squared errors of these pixels.
  [[nodiscard]] std::optional<double> mse_100(const Image<std::uint8_t>* mask, int border) const;

  /// mse_100, badpix_0010, badpix_0030, badpix_0070 and q_25_100 of all judged pixels.
  [[nodiscard]] Metrics general(int border) const;

 private:
  [[nodiscard]] std::optional<double> q_25_100(int border) const;
  /// Fills `row` with the estimates of the truth's row `y`; NaN where missing.
  void sample_row(int y, std::vector<float>& row) const;
  [[nodiscard]] bool is_shown(int y, int x) const {
    return options_.shown.empty() || options_.shown.at(rows_[y], columns_[x]) != 0;
  }

  DisparityView estimate_;
  ImageView<const float> truth_;
  int scale_;
  const EvaluationOptions& options_;
  InvalidEstimates invalid_;
  std::vector<int> rows_, columns_;  ///< Of the map, for each of the truth.
  float farthest_ = 0;               ///< The least true disparity that is judged.
};

/// A map with NaN where it has no value, as a truth of scale 1.
[[nodiscard]] Image<float> marked(const DisparityView& map);

template <class Visit>
void ResolvedErrors::visit(const Image<std::uint8_t>* mask, int border, Visit visit) const {
  constexpr int rows_between_checks = 64;
  std::vector<float> estimates;
  for (int y = border; y < truth_.height - border; ++y) {
    if (y % rows_between_checks == 0) options_.progress.check();
    sample_row(y, estimates);
    const float* truth = truth_.row(y);
    const std::uint8_t* inside = mask ? mask->row(y) : nullptr;
    for (int x = border; x < truth_.width - border; ++x) {
      if (inside && inside[x] == 0) continue;
      if (std::isfinite(truth[x]) && is_shown(y, x)) visit(y, x, estimates[x]);
    }
  }
}

template <class IsBad>
std::optional<double> ResolvedErrors::percentage(const Image<std::uint8_t>* mask, int border,
                                                 IsBad is_bad) const {
  std::size_t count = 0, bad = 0;
  visit(mask, border, [&](int y, int x, float estimate) {
    ++count;
    const bool counts =
        std::isnan(estimate) ? invalid_ == InvalidEstimates::Bad : is_bad(y, x, estimate);
    bad += counts ? 1 : 0;
  });
  if (count == 0) return std::nullopt;
  return 100.0 * static_cast<double>(bad) / static_cast<double>(count);
}

struct PartScore {
  std::size_t pixels = 0;  ///< That were judged.
  Metrics metrics;         ///< Empty without such pixels.
};

/// Scores the judged pixels of an evaluation where `part` is not 0; it has the size of the view,
/// null = everywhere. It has the metrics of `evaluate` that follow from the errors alone: of
/// vmv2013 mse_100 and density, of benchmark2016 also badpix_0010, badpix_0030, badpix_0070 and
/// q_25_100. Missing estimates count as InvalidEstimates::Bad does; for MSE, the farthest true
/// disparity of the whole view counts, as in the map of errors.
[[nodiscard]] PartScore score_part(const Evaluation& evaluation, const Image<std::uint8_t>* part,
                                   Protocol protocol);

/// The errors of the pixels whose true disparity lies in one of the bins of an axis.
struct ErrorBin {
  Interval disparity;      ///< True disparities, px.
  std::size_t pixels = 0;  ///< Judged ones, > 0.
  double mse_100 = 0;      ///< 100 · mean of the squared errors, px².
  double bad_percent = 0;  ///< With |error| strictly above the threshold, or missing.
};

/// Errors by true disparity: `bins` > 0 equal parts of the range of the true disparities that were
/// judged in `part` (null = everywhere), without those that no pixel lies in. `truth` is the map
/// that the evaluation is of.
[[nodiscard]] std::vector<ErrorBin> errors_by_disparity(const Evaluation& evaluation,
                                                        const DisparityView& truth,
                                                        const Image<std::uint8_t>* part, int bins,
                                                        double bad_threshold_px);

/// The value with this rank, from 0, among values ≥ 0 that `feed(sink)` gives to a sink one by one,
/// twice and alike. Counts in half a megabyte instead of sorting: floats ≥ 0 are ordered as their
/// bits are. Precondition: there are more than `rank` values.
template <class Feed>
[[nodiscard]] float nth_value(Feed feed, std::size_t rank) {
  constexpr int half = 16;
  constexpr std::uint32_t low_mask = (1U << half) - 1;
  std::vector<std::size_t> counts(1U << half);
  const auto take_bin = [&] {
    std::uint32_t bin = 0;
    while (rank >= counts[bin]) rank -= counts[bin++];
    return bin;
  };
  feed([&](float value) { ++counts[std::bit_cast<std::uint32_t>(value) >> half]; });
  const std::uint32_t high = take_bin();
  counts.assign(counts.size(), 0);
  feed([&](float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    if (bits >> half == high) ++counts[bits & low_mask];
  });
  return std::bit_cast<float>(high << half | take_bin());
}

/// Input of region metrics besides the errors of an evaluation.
struct RegionInput {
  const DisparityView& estimate;
  const DisparityView& truth;
  const std::map<std::string, Image<std::uint8_t>>& regions;
  const EvaluationOptions& options;
};

/// Percentage of the judged pixels inside `region` (null = everywhere) with a signed error for
/// which `is_bad` holds. Missing pixels are bad or good as `invalid` says. Empty if no pixel is
/// inside.
template <class IsBad>
std::optional<double> bad_percentage(const Evaluation& evaluation,
                                     const Image<std::uint8_t>* region, InvalidEstimates invalid,
                                     IsBad is_bad) {
  std::size_t count = 0;
  std::size_t bad = 0;
  for (std::size_t i = 0; i < evaluation.judged.size(); ++i) {
    if (evaluation.judged.data()[i] == 0 || (region && region->data()[i] == 0)) continue;
    ++count;
    const bool counts_as_bad = evaluation.missing.data()[i] != 0
                                   ? invalid == InvalidEstimates::Bad
                                   : is_bad(evaluation.signed_error.data()[i]);
    if (counts_as_bad) ++bad;
  }
  if (count == 0) return std::nullopt;
  return 100.0 * static_cast<double>(bad) / static_cast<double>(count);
}

/// Appends the metrics of surfaces of benchmark2016, bumpiness and angles of normals, for the masks
/// there are. Regions with no judged pixel add nothing.
void append_region_metrics(Evaluation& evaluation, const RegionInput& input);

/// Angle in degrees between the surface normals of two disparity maps of the same size, NaN where
/// one of them has no normal. Normals come from depth by Scharr's kernel with wrapped borders, on
/// points (x, y)·Z as the 2016 benchmark places them: the origin is the first pixel and half the
/// sensor spans the image. Source: Honauer et al. 2016 [HJKG16], evaluation toolkit.
/// `camera.focal_length` below 32 is in units of the larger side, as archive files store it, else
/// in px. Precondition: `camera.is_known()`.
[[nodiscard]] Image<float> angle_between_normals(const Image<double>& a, const Image<double>& b,
                                                 const CameraGrid& camera);

/// Frobenius norm of the Hessian of a map by the scale of the 2016 benchmark: Scharr's kernel
/// [3, 10, 3]/16 × [1, 0, −1] without the half, applied twice, so every second derivative counts
/// four times; all four terms enter the norm. The border is reflected (… b a | a b …). NaN samples
/// make their surroundings NaN. Source: Honauer et al. 2016 [HJKG16], evaluation toolkit.
[[nodiscard]] Image<float> hessian_norm(const Image<double>& map);

/// Suffix of keys that the official tool computes in high resolution, for numbers of the low one.
inline constexpr const char* kLowResSuffix = "_lowres";

/// Numbers of benchmark2016 from errors alone.
struct BenchmarkMetrics {
  Metrics general;                 ///< Of all pixels: ResolvedErrors::general.
  Metrics masked;                  ///< Of regions: masked_metrics.
  std::vector<std::string> notes;  ///< Sentences: which numbers are missing, and why.
};

/// The scene of the benchmark whose rules and masks apply: from `options`, else from the names of
/// the masks.
[[nodiscard]] StratifiedScene scene_of(const RegionInput& input);

/// Official keys hold numbers that are computed as by the official tool: masked metrics, and all of
/// backgammon, dots and stripes, in high resolution; general metrics of other scenes in the
/// resolution of the views. Keys of the other numbers of low resolution end in `kLowResSuffix`.
/// High resolution is read here, one map and one mask or two at a time, and released. Files that
/// cannot be read are noted. Throws InvalidInput, Cancelled.
[[nodiscard]] BenchmarkMetrics benchmark_metrics(const RegionInput& input);

using RegionMask = std::shared_ptr<const Image<std::uint8_t>>;

/// The mask of a region at the resolution of the truth; null if the scene has none of this name.
/// Throws Error if it cannot be read.
using RegionLookup = std::function<RegionMask(const std::string& name)>;

/// Metrics of regions that the 2016 benchmark scores in high resolution; those for whose masks
/// there are, pixels nearer than `border` to the border of the truth left out but where said:
///
/// - discontinuities_0070 (region discontinuities), % with |error| > 0.07; fine_fattening_0150
///   (fine_surrounding) and fine_thinning_0150 (fine), % with an error < −0.15 and > 0.15;
/// - backgammon_fattening_0070 (foreground_fattening), % nearer than the middle between truth and
///   foreground, which is the truth of the row in column 14·scale; backgammon_thinning_0070
///   (foreground_thinning), % farther than the middle between truth and background, which is that
///   of the eleventh column from the right, of the truth whatever its scale;
/// - missed_dots_50_0400 (dots_by_size and boxes, which are numbered), % of the dots, one of each
///   size of 1 … 8 in each box, with at least half of their pixels off by more than 0.4 px, also
///   within the border; a dot without pixels is missed; background_mse_100 (background);
/// - low_texture_0070 (low_texture), dark_stripes_0070 (high_contrast) and bright_stripes_0070
///   (low_contrast), % with |error| > 0.07.
///
/// Thresholds in the keys of backgammon are names only. Metrics of backgammon, dots and stripes are
/// those of `scene` alone. Source: [HJKG16], evaluation toolkit. A metric whose mask cannot be read
/// or has another size adds the sentence to `problems`. Throws Cancelled.
[[nodiscard]] Metrics masked_metrics(const ResolvedErrors& errors, int border,
                                     StratifiedScene scene, const RegionLookup& region,
                                     std::vector<std::string>& problems);

}  // namespace episcope
