// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane/regional_trust.h"

#include "engine/disparity/common/box_mean.h"

#include <algorithm>
#include <vector>

namespace episcope {
namespace {

constexpr int kRadius = 4;

}  // namespace

Image<float> regional_trust(ImageView<const float> confidence) {
  const int height = confidence.height, width = confidence.width;
  Image<float> own(height, width), means(height, width);
  for (int y = 0; y < height; ++y) std::copy_n(confidence.row(y), width, own.row(y));
  std::vector<float> columns(width);
  for (int y = 0; y < height; ++y) {
    window_mean_row(own, y, kRadius, columns.data(), means.row(y));
  }
  return means;
}

}  // namespace episcope
