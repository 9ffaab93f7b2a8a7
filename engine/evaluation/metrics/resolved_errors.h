// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/evaluation/metrics/metrics.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace episcope {

/// Errors of one map against a truth of its own size or `scale` times as large, pixel by pixel of
/// the truth, without ever storing the enlarged map. The pixel of the map that belongs to pixel k
/// of N along an axis is the one nearest to k·(n − 1)/(N − 1): corners lie on corners, as the zoom
/// of order 0 of the official toolkit has it, so that blocks at the border are scale/2 + 1 wide.
/// Errors are truth − estimate in float. Source: evaluation toolkit of [HJKG16].
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

}  // namespace episcope
