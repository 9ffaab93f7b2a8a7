// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/unlike_planes.h"

#include "engine/core/array/quantile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace episcope::io {
namespace {

constexpr int kSquare_px = 8;        ///< Of pictures of half the size.
constexpr int kFurthest_px = 4;      ///< Motion of these squares that is looked for.
constexpr double kUnlike_px = 0.2;   ///< Difference of motion of different scenes is above.
constexpr double kUnlike = 0.5;      ///< Correlation of different scenes is below.
constexpr double kNoDetail = 1e-12;  ///< Variance, relative to the mean square.

/// Means of 2×2 pixels, which have half of the noise.
Image<float> halved(const Image<float>& picture) {
  Image<float> half(picture.height() / 2, picture.width() / 2);
  for (int y = 0; y < half.height(); ++y) {
    const float* above = picture.row(2 * y);
    const float* below = picture.row(2 * y + 1);
    for (int x = 0; x < half.width(); ++x, above += 2, below += 2) {
      half.at(y, x) = (above[0] + above[1] + below[0] + below[1]) / 4;
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

/// Calls `use(top, left)` for the squares of a picture that may move by `margin` within it.
template <class Use>
void for_squares(const Image<float>& picture, int margin, const Use& use) {
  for (int y = margin; y + kSquare_px + margin <= picture.height(); y += kSquare_px) {
    for (int x = margin; x + kSquare_px + margin <= picture.width(); x += kSquare_px) use(y, x);
  }
}

/// Of the squares in which both vary; 0 if there are none.
double median_correlation(const Image<float>& a, const Image<float>& b) {
  std::vector<float> all;
  for_squares(a, 0, [&](int y, int x) {
    if (const auto one = correlation(a, b, y, x, kSquare_px, kSquare_px)) {
      all.push_back(static_cast<float>(*one));
    }
  });
  return all.empty() ? 0 : quantile(all, 0.5);
}

/// How far each square has moved in the neighbouring view, to a fraction of a pixel.
std::vector<float> motion_of(const PlaneViews& plane) {
  std::vector<float> all;
  for_squares(plane.center, kFurthest_px, [&](int top, int left) {
    std::array<double, 2 * kFurthest_px + 1> costs{};
    for (std::size_t i = 0; i < costs.size(); ++i) {
      const int shift = static_cast<int>(i) - kFurthest_px;
      for (int y = top; y < top + kSquare_px; ++y) {
        for (int x = left; x < left + kSquare_px; ++x) {
          const double off =
              plane.center.at(y, x) - (plane.is_above ? plane.neighbour.at(y + shift, x)
                                                      : plane.neighbour.at(y, x + shift));
          costs[i] += off * off;
        }
      }
    }
    const auto best = std::ranges::min_element(costs) - costs.begin();
    double part = 0;
    if (best > 0 && best + 1 < std::ssize(costs)) {
      const auto at = static_cast<std::size_t>(best);
      const double bend = costs[at - 1] - 2 * costs[at] + costs[at + 1];
      if (bend > 0) part = (costs[at - 1] - costs[at + 1]) / (2 * bend);
    }
    all.push_back(static_cast<float>(static_cast<double>(best) + part));
  });
  return all;
}

bool move_differently(const std::vector<float>& a, const std::vector<float>& b) {
  if (a.empty()) return false;
  std::vector<float> differences;
  for (std::size_t i = 0; i < a.size(); ++i) differences.push_back(std::abs(a[i] - b[i]));
  constexpr double kHalved = 2;
  return kHalved * quantile(differences, 0.5) > kUnlike_px;
}

bool are_correlated(const Image<float>& a, const Image<float>& b) {
  const auto whole = correlation(a, b, 0, 0, a.height(), a.width());
  return !whole || *whole > kUnlike || median_correlation(a, b) > kUnlike;
}

}  // namespace

bool are_unlike(const std::vector<PlaneViews>& planes) {
  std::vector<PlaneViews> halves;
  std::vector<std::vector<float>> motions;
  for (const PlaneViews& plane : planes) {
    halves.push_back({halved(plane.center), halved(plane.neighbour), plane.is_above});
    motions.push_back(motion_of(halves.back()));
  }
  for (std::size_t i = 0; i < halves.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (are_correlated(halves[i].center, halves[k].center)) return false;
      if (!move_differently(motions[i], motions[k])) return false;
    }
  }
  return halves.size() > 1;
}

}  // namespace episcope::io
