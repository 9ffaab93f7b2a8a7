// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/rectify/lanczos.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <type_traits>

namespace episcope::capture {
namespace {

constexpr int kLobes = 3;
constexpr int kMostChannels = 3;

double lanczos(double x) {
  if (std::abs(x) < 1e-9) return 1;
  if (std::abs(x) >= kLobes) return 0;
  const double p = std::numbers::pi * x;
  return kLobes * std::sin(p) * std::sin(p / kLobes) / (p * p);
}

template <class T>
T rounded(float value) {
  if constexpr (std::is_floating_point_v<T>) {
    return value;
  } else {
    constexpr auto most = static_cast<float>(std::numeric_limits<T>::max());
    return static_cast<T>(std::clamp(value + 0.5F, 0.0F, most));
  }
}

}  // namespace

Lanczos::Lanczos() : weights_(kSteps + 1) {
  for (int i = 0; i <= kSteps; ++i) {
    double weights[kTaps];
    double sum = 0;
    for (int k = 0; k < kTaps; ++k) {
      weights[k] = lanczos(k - (kLobes - 1) - static_cast<double>(i) / kSteps);
      sum += weights[k];
    }
    for (int k = 0; k < kTaps; ++k) weights_[i][k] = static_cast<float>(weights[k] / sum);
  }
}

template <class T>
void Lanczos::sample(ImageView<const T> picture, const PlanePoint& at, double gain, T* out) const {
  const int x = static_cast<int>(std::floor(at.x));
  const int y = static_cast<int>(std::floor(at.y));
  const auto& by_x = weights_[static_cast<std::size_t>(std::lround((at.x - x) * kSteps))];
  const auto& by_y = weights_[static_cast<std::size_t>(std::lround((at.y - y) * kSteps))];
  int columns[kTaps];
  for (int k = 0; k < kTaps; ++k) {
    columns[k] = std::clamp(x + k - (kLobes - 1), 0, picture.width - 1) * picture.channels;
  }
  float sum[kMostChannels] = {};
  for (int j = 0; j < kTaps; ++j) {
    const T* row = picture.row(std::clamp(y + j - (kLobes - 1), 0, picture.height - 1));
    for (int c = 0; c < picture.channels; ++c) {
      float in_row = 0;
      for (int k = 0; k < kTaps; ++k) in_row += by_x[k] * static_cast<float>(row[columns[k] + c]);
      sum[c] += by_y[j] * in_row;
    }
  }
  for (int c = 0; c < picture.channels; ++c) {
    out[c] = rounded<T>(sum[c] * static_cast<float>(gain));
  }
}

template void Lanczos::sample(ImageView<const std::uint8_t>, const PlanePoint&, double,
                              std::uint8_t*) const;
template void Lanczos::sample(ImageView<const std::uint16_t>, const PlanePoint&, double,
                              std::uint16_t*) const;
template void Lanczos::sample(ImageView<const float>, const PlanePoint&, double, float*) const;

}  // namespace episcope::capture
