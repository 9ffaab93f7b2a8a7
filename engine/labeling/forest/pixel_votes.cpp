// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/forest/pixel_votes.h"

#include "engine/core/parallel/parallel.h"

#include <algorithm>
#include <utility>

namespace episcope {

PixelVotes::PixelVotes(const Forest& forest, VolumeView<const float> features)
    : forest_(forest), features_(features) {}

PixelVotes::PixelVotes(const Forest& forest, VolumeView<const float> features,
                       const cuda::DeviceForest& device, const Progress& progress)
    : PixelVotes(forest, features) {
  counted_.resize(static_cast<std::size_t>(height()) * width() * pitch());
  device.vote(features, progress, counted_.data());
}

void PixelVotes::count_all(const Progress& progress) {
  if (!counted_.empty()) return;
  const std::size_t size = static_cast<std::size_t>(width()) * pitch();
  std::vector<float> counted(static_cast<std::size_t>(height()) * size);
  parallel_for(height(), progress,
               [&](int y) { forest_.predict_row(features_, y, counted.data() + y * size); });
  counted_ = std::move(counted);
}

void PixelVotes::row(int y, float* out) const {
  if (counted_.empty()) {
    forest_.predict_row(features_, y, out);
    return;
  }
  const std::ptrdiff_t size = static_cast<std::ptrdiff_t>(width()) * pitch();
  std::copy_n(counted_.data() + y * size, size, out);
}

}  // namespace episcope
