// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/unlike_planes.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace episcope::io {
namespace {

constexpr int kSquare_px = 8;        ///< Of pictures of half the size.
constexpr double kUnlike = 0.5;      ///< Correlation of different scenes is below.
constexpr double kNoDetail = 1e-12;  ///< Variance, relative to the mean square.

/// Means of 2×2 pixels, which have half of the noise.
Image<float> halved(const Image<float>& picture) {
  Image<float> half(picture.height() / 2, picture.width() / 2);
  for (int y = 0; y < half.height(); ++y) {
    const float* above = picture.row(2 * y);
    const float* below = picture.row(2 * y + 1);
    for (int x = 0; x < half.width(); ++x) {
      half.at(y, x) = (above[2 * x] + above[2 * x + 1] + below[2 * x] + below[2 * x + 1]) / 4;
    }
  }
  return half;
}

/// Size without sign; nothing where one of the two does not vary.
std::optional<double> correlation(const Image<float>& a, const Image<float>& b, int top, int left,
                                  int height, int width) {
  double sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
  for (int y = top; y < top + height; ++y) {
    for (int x = left; x < left + width; ++x) {
      const double p = a.at(y, x), q = b.at(y, x);
      sum_a += p;
      sum_b += q;
      aa += p * p;
      bb += q * q;
      ab += p * q;
    }
  }
  const double count = static_cast<double>(height) * width;
  const double variance_a = aa - sum_a * sum_a / count, variance_b = bb - sum_b * sum_b / count;
  if (!(variance_a > kNoDetail * aa) || !(variance_b > kNoDetail * bb)) return std::nullopt;
  return std::abs(ab - sum_a * sum_b / count) / std::sqrt(variance_a * variance_b);
}

/// Of the squares in which both vary.
double median_correlation(const Image<float>& a, const Image<float>& b) {
  std::vector<double> all;
  for (int y = 0; y + kSquare_px <= a.height(); y += kSquare_px) {
    for (int x = 0; x + kSquare_px <= a.width(); x += kSquare_px) {
      if (const auto one = correlation(a, b, y, x, kSquare_px, kSquare_px)) all.push_back(*one);
    }
  }
  if (all.empty()) return 0;
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::ranges::nth_element(all, middle);
  return *middle;
}

}  // namespace

bool are_unlike(const std::vector<Image<float>>& pictures) {
  std::vector<Image<float>> halves;
  for (const Image<float>& picture : pictures) halves.push_back(halved(picture));
  for (std::size_t i = 0; i < halves.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const Image<float>&a = halves[i], &b = halves[k];
      const auto whole = correlation(a, b, 0, 0, a.height(), a.width());
      if (!whole || *whole > kUnlike || median_correlation(a, b) > kUnlike) return false;
    }
  }
  return halves.size() > 1;
}

}  // namespace episcope::io
