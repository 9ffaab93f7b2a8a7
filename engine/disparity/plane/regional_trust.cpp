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
    const auto rows = static_cast<float>(sum_rows(own, y, kRadius, columns.data()));
    box_mean_row(columns.data(), width, kRadius, means.row(y));
    for (int x = 0; x < width; ++x) means.at(y, x) /= rows;
  }
  return means;
}

}  // namespace episcope
