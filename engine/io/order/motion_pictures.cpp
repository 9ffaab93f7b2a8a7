// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/order/motion_pictures.h"

#include "engine/io/order/grey_picture.h"

#include <algorithm>
#include <cmath>

namespace episcope::io {
namespace {

double contrast_of(const Image<float>& picture) {
  double sum = 0;
  double squares = 0;
  for (const float value : picture) {
    sum += value;
    squares += static_cast<double>(value) * value;
  }
  const auto n = static_cast<double>(std::max<std::size_t>(picture.size(), 1));
  return std::sqrt(std::max(squares / n - sum / n * (sum / n), 0.0));
}

}  // namespace

MotionPictures::MotionPictures(const Image<float>& grey) {
  const Image<float> small = reduced(grey, 160);
  contrast = contrast_of(small);
  scales = {band_passed(middle_of(grey, 256)), band_passed(small), band_passed(reduced(grey, 40))};
}

double correlation(const Image<float>& a, const Image<float>& b) {
  double sum = 0;
  for (int y = 0; y < a.height(); ++y) {
    float row = 0;
    for (int x = 0; x < a.width(); ++x) row += a.at(y, x) * b.at(y, x);
    sum += row;
  }
  return sum / static_cast<double>(a.size());
}

}  // namespace episcope::io
