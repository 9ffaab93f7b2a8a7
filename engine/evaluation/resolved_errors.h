// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/evaluation/metrics.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
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

}  // namespace episcope
