// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"

#include <array>
#include <cstddef>
#include <string>

namespace episcope::accuracy {

/// Whether a confidence is the probability of being right to 0.07 px: pixels by their confidence,
/// in ten equal bins, and which share of each is right.
class Reliability {
 public:
  /// Pixels of about the same confidence.
  struct Bin {
    std::size_t count = 0;
    std::size_t right = 0;
    double confidence = 0;  ///< Sum.

    [[nodiscard]] double mean_confidence() const;
    [[nodiscard]] double share_right() const;
    /// How far one is from the other, in points of per cent.
    [[nodiscard]] double error() const;
  };
  static constexpr int kBins = 10;

  /// Adds the pixels of a view with truth, but for a border of 15 px. A pixel without an estimate
  /// is wrong. Precondition: all are of one size.
  void add(const DisparityView& estimate, ImageView<const float> confidence,
           const DisparityView& truth);

  [[nodiscard]] const std::array<Bin, kBins>& bins() const { return bins_; }
  [[nodiscard]] std::size_t count() const;
  /// The error of a bin, the mean over the pixels.
  [[nodiscard]] double mean_error() const;
  /// The largest error of a bin that holds at least 1 % of the pixels.
  [[nodiscard]] double largest_error() const;

 private:
  std::array<Bin, kBins> bins_{};
};

/// A Markdown table of the bins, and a line with the errors.
[[nodiscard]] std::string reliability_table(const std::string& method,
                                            const Reliability& reliability);

}  // namespace episcope::accuracy
