// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/layers/double_filters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace episcope {
namespace {

// Smoothing, first and second derivative of one radius. Five taps: the one set whose ratios
// h₁/h₀ = iν and h₂/h₀ = −ν² hold up to the sixth order, to 0.5 % for waves of 4 px. Three taps:
// the one set whose ratios agree, (h₁/h₀)² = h₂/h₀.
struct Matched {
  int radius;
  std::array<std::array<double, 5>, 3> values;
};
constexpr Matched kThreeTaps = {1, {{{0.25, 0.5, 0.25}, {-0.5, 0, 0.5}, {1, -2, 1}}}};
constexpr Matched kFiveTaps = {2,
                               {{{1.0 / 90, 2.0 / 9, 8.0 / 15, 2.0 / 9, 1.0 / 90},
                                 {-0.05, -0.4, 0, 0.4, 0.05},
                                 {11.0 / 60, 4.0 / 15, -0.9, 4.0 / 15, 11.0 / 60}}}};

Taps taps_of(const Matched& set, int order) {
  Taps taps;
  taps.radius = set.radius;
  for (int i = 0; i <= 2 * set.radius; ++i) {
    taps.values[i] = static_cast<float>(set.values[order][i]);
  }
  return taps;
}

Taps convolved(const Taps& a, const Taps& b) {
  Taps taps;
  taps.radius = a.radius + b.radius;
  for (int i = 0; i <= 2 * a.radius; ++i) {
    for (int j = 0; j <= 2 * b.radius; ++j) taps.values[i + j] += a.values[i] * b.values[j];
  }
  return taps;
}

double inner_product(const Taps& a, const Taps& b) {
  return std::inner_product(a.values, a.values + 2 * a.radius + 1, b.values, 0.0);
}

// What white noise of variance 1 leaves in each derivative, taken out again: the Cholesky factor of
// its covariance. Only f_xx and f_uu are correlated, the odd filters being orthogonal to the even.
void whiten(SecondOrderFilters& filters) {
  const auto covariance = [&](int i, int j) {
    return inner_product(filters.along[2 - i], filters.along[2 - j]) *
           inner_product(filters.views[i], filters.views[j]);
  };
  const double first = std::sqrt(covariance(0, 0));
  const double share = covariance(0, 2) / first;
  const double rest = std::sqrt(covariance(2, 2) - share * share);
  filters.scale[0] = static_cast<float>(1 / first);
  filters.scale[1] = static_cast<float>(1 / std::sqrt(covariance(1, 1)));
  filters.scale[2] = static_cast<float>(1 / rest);
  filters.mix = static_cast<float>(-share / (first * rest));
}

// Weights of the product rows for each view: a Gaussian, or the nearest row where it has none.
std::vector<float> integration_weights(int rows, int first, int last, double sigma) {
  const int count = last - first;
  std::vector<float> weights(static_cast<std::size_t>(rows) * count);
  for (int r = 0; r < rows; ++r) {
    float* row = &weights[static_cast<std::size_t>(r) * count];
    for (int i = 0; i < count; ++i) {
      const double off = first + i - r;
      row[i] = std::abs(off) <= std::ceil(2 * sigma)
                   ? static_cast<float>(std::exp(-0.5 * off * off / (sigma * sigma + 1e-9)))
                   : 0.0F;
    }
    const float sum = std::accumulate(row, row + count, 0.0F);
    if (sum < 1e-3F) {
      std::fill_n(row, count, 0.0F);
      row[std::clamp(r, first, last - 1) - first] = 1;
    } else {
      for (int i = 0; i < count; ++i) row[i] /= sum;
    }
  }
  return weights;
}

}  // namespace

DoubleFilterSet make_double_filters(int rows, int channels, const TensorScales& scales) {
  const TensorFilterSet set = make_tensor_filters(rows, channels, scales);
  const Matched& views = rows < 5 ? kThreeTaps : kFiveTaps;
  DoubleFilterSet result;
  SecondOrderFilters& filters = result.filters;
  for (int order = 0; order < 3; ++order) {
    filters.along[order] = convolved(taps_of(kFiveTaps, order), set.filters.smooth);
    filters.views[order] = taps_of(views, order);
  }
  filters.integrate = set.filters.integrate;
  filters.across = set.across;
  filters.contrast_energy = set.filters.contrast_energy;
  filters.noise_energy = set.filters.noise_energy;
  whiten(filters);
  result.first_product = views.radius;
  result.last_product = rows - views.radius;
  result.row_weights =
      integration_weights(rows, result.first_product, result.last_product, scales.views);
  filters.row_weights = result.row_weights.data();
  return result;
}

std::vector<int> double_steps(const DoubleSearch& search) {
  const double half = 0.5 * search.min_distance;
  const int first = static_cast<int>(std::ceil(search.accepted.min + half - 0.5));
  const int last = static_cast<int>(std::floor(search.accepted.max - half + 0.5));
  std::vector<int> steps;
  for (int step = first; step <= last; ++step) steps.push_back(step);
  return steps;
}

}  // namespace episcope
