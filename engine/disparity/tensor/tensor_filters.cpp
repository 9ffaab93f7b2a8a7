// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/tensor/tensor_filters.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace episcope {
namespace {

double gaussian(double sigma, int offset) {
  return sigma > 0 ? std::exp(-0.5 * offset * offset / (sigma * sigma)) : (offset == 0 ? 1 : 0);
}

Taps gaussian_taps(double sigma) {
  Taps taps;
  taps.radius = gaussian_radius(sigma);
  double sum = 0;
  for (int i = -taps.radius; i <= taps.radius; ++i) sum += gaussian(sigma, i);
  for (int i = -taps.radius; i <= taps.radius; ++i) {
    taps.values[i + taps.radius] = static_cast<float>(gaussian(sigma, i) / sum);
  }
  return taps;
}

// The same filter evaluated half a sample further: the mean of two neighbouring positions.
Taps half_sample(const Taps& taps) {
  Taps half = taps;
  const int count = 2 * taps.radius + 1;
  half.values[count] = 0;
  for (int i = count; i >= 0; --i) {
    const float here = i < count ? taps.values[i] : 0;
    half.values[i] = 0.5F * (here + (i > 0 ? taps.values[i - 1] : 0));
  }
  return half;
}

using Matrix = std::vector<std::vector<double>>;

Matrix zero_matrix(int rows) {
  return Matrix(rows, std::vector<double>(rows, 0));
}

// A filter along the views, truncated at the first and last view and renormalised.
Matrix smoothing_matrix(int rows, int radius, const std::function<double(int)>& weight) {
  Matrix matrix = zero_matrix(rows);
  for (int r = 0; r < rows; ++r) {
    double sum = 0;
    for (int i = std::max(0, r - radius); i <= std::min(rows - 1, r + radius); ++i) {
      sum += matrix[r][i] = weight(i - r);
    }
    for (double& value : matrix[r]) value /= sum;
  }
  return matrix;
}

// d/ds with s = −u: central inside, one-sided at the ends.
Matrix derivative_matrix(int rows) {
  Matrix matrix = zero_matrix(rows);
  for (int r = 0; r < rows; ++r) {
    const int before = std::max(0, r - 1);
    const int after = std::min(rows - 1, r + 1);
    matrix[r][before] += 1.0 / (after - before);
    matrix[r][after] -= 1.0 / (after - before);
  }
  return matrix;
}

Matrix product(const Matrix& a, const Matrix& b) {
  const int rows = static_cast<int>(a.size());
  Matrix matrix = zero_matrix(rows);
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < rows; ++k) {
      for (int j = 0; j < rows; ++j) matrix[i][j] += a[i][k] * b[k][j];
    }
  }
  return matrix;
}

std::vector<RowTaps> banded(const Matrix& matrix, int radius) {
  const int rows = static_cast<int>(matrix.size());
  std::vector<RowTaps> taps(rows);
  for (int r = 0; r < rows; ++r) {
    taps[r].first = std::max(0, r - radius);
    taps[r].count = std::min(rows - 1, r + radius) - taps[r].first + 1;
    for (int i = 0; i < taps[r].count; ++i) {
      taps[r].values[i] = static_cast<float>(matrix[r][taps[r].first + i]);
    }
  }
  return taps;
}

// Energy of a contrast given in 1/255, over all channels.
float sample_energy(double contrast, int channels) {
  return static_cast<float>(channels * contrast * contrast / (255.0 * 255.0));
}

// Weights of contrast/(energy + contrast) are 1 for all energies that samples have.
float contrast_energy(double contrast, int channels) {
  constexpr float kNoLimit = 1e20F;
  return contrast >= 255 ? kNoLimit : sample_energy(contrast, channels);
}

// The farthest row that any row takes in.
int reach_of(const std::vector<RowTaps>& filter) {
  int reach = 0;
  for (int r = 0; r < static_cast<int>(filter.size()); ++r) {
    reach = std::max({reach, r - filter[r].first, filter[r].first + filter[r].count - 1 - r});
  }
  return reach;
}

}  // namespace

// Cut at 2σ, where the Gaussian has fallen to 13 %.
int gaussian_radius(double sigma) {
  return static_cast<int>(std::ceil(2 * sigma));
}

TensorFilterSet make_tensor_filters(int rows, int channels, const TensorScales& scales) {
  const int inner = gaussian_radius(scales.inner);
  const int views = gaussian_radius(scales.views);
  const Matrix before =
      smoothing_matrix(rows, inner, [&](int i) { return gaussian(scales.inner, i); });
  const Matrix scharr = smoothing_matrix(rows, 1, [](int i) { return i == 0 ? 10.0 : 3.0; });
  const Matrix after =
      smoothing_matrix(rows, views, [&](int i) { return gaussian(scales.views, i); });
  TensorFilterSet set;
  set.row_smooth = banded(product(scharr, before), inner + 1);
  set.row_derivative = banded(product(derivative_matrix(rows), before), inner + 1);
  set.row_integrate = banded(after, views);
  set.view_reach = reach_of(set.row_smooth) + reach_of(set.row_integrate);
  set.filters.smooth = gaussian_taps(scales.inner);
  set.filters.integrate = gaussian_taps(scales.outer);
  set.filters.integrate_half = half_sample(set.filters.integrate);
  set.filters.row_smooth = set.row_smooth.data();
  set.filters.row_derivative = set.row_derivative.data();
  set.filters.row_integrate = set.row_integrate.data();
  set.filters.contrast_energy = contrast_energy(scales.contrast, channels);
  set.filters.noise_energy = sample_energy(scales.noise, channels);
  set.across = gaussian_taps(scales.across);
  return set;
}

}  // namespace episcope
