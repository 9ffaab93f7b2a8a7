// SPDX-License-Identifier: BSD-3-Clause
#include "tests/accuracy/reliability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace episcope::accuracy {
namespace {

constexpr int kBorder = 15;          // px, of protocol benchmark2016
constexpr double kRight = 0.07;      // px
constexpr double kLeastPart = 0.01;  // of the pixels

}  // namespace

double Reliability::Bin::mean_confidence() const {
  return confidence / static_cast<double>(std::max<std::size_t>(count, 1));
}

double Reliability::Bin::share_right() const {
  return static_cast<double>(right) / static_cast<double>(std::max<std::size_t>(count, 1));
}

double Reliability::Bin::error() const {
  return 100 * std::abs(mean_confidence() - share_right());
}

void Reliability::add(const DisparityView& estimate, ImageView<const float> confidence,
                      const DisparityView& truth) {
  for (int y = kBorder; y < confidence.height - kBorder; ++y) {
    for (int x = kBorder; x < confidence.width - kBorder; ++x) {
      if (!truth.is_valid(y, x)) continue;
      const float sure = confidence.at(y, x);
      Bin& bin = bins_[std::clamp(static_cast<int>(sure * kBins), 0, kBins - 1)];
      ++bin.count;
      bin.confidence += sure;
      const double off = std::abs(estimate.disparity.at(y, x) - truth.disparity.at(y, x));
      if (estimate.is_valid(y, x) && off <= kRight) ++bin.right;
    }
  }
}

std::size_t Reliability::count() const {
  std::size_t count = 0;
  for (const Bin& bin : bins_) count += bin.count;
  return count;
}

double Reliability::mean_error() const {
  double sum = 0;
  for (const Bin& bin : bins_) sum += bin.error() * static_cast<double>(bin.count);
  return sum / static_cast<double>(std::max<std::size_t>(count(), 1));
}

double Reliability::largest_error() const {
  const double least = kLeastPart * static_cast<double>(count());
  double largest = 0;
  for (const Bin& bin : bins_) {
    if (bin.count > 0 && static_cast<double>(bin.count) >= least) {
      largest = std::max(largest, bin.error());
    }
  }
  return largest;
}

std::string reliability_table(const std::string& method, const Reliability& reliability) {
  std::string text =
      "| method | confidence | pixels % | mean confidence % | right to 0.07 px % "
      "| off by |\n|---|---|---:|---:|---:|---:|\n";
  const auto all = static_cast<double>(std::max<std::size_t>(reliability.count(), 1));
  for (int i = 0; i < Reliability::kBins; ++i) {
    const Reliability::Bin& bin = reliability.bins()[i];
    if (bin.count == 0) continue;
    text += fmt::format("| {} | {:.1f} to {:.1f} | {:.2f} | {:.1f} | {:.1f} | {:.1f} |\n", method,
                        i / 10.0, (i + 1) / 10.0, 100 * static_cast<double>(bin.count) / all,
                        100 * bin.mean_confidence(), 100 * bin.share_right(), bin.error());
  }
  return text + fmt::format(
                    "\n{}: off by {:.1f} points in the mean over the pixels, by {:.1f} at most in "
                    "bins of 1 % of the pixels or more.\n",
                    method, reliability.mean_error(), reliability.largest_error());
}

}  // namespace episcope::accuracy
