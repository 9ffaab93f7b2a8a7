// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/forest/pixel_votes.h"

#include "engine/core/parallel/parallel.h"

#include <algorithm>

namespace episcope {

PixelVotes::PixelVotes(const Forest& forest, VolumeView<const float> features)
    : height_(features.height),
      width_(features.width),
      label_count_(forest.label_count()),
      pitch_(forest.pitch()),
      votes_(make_large<float>(static_cast<std::size_t>(height_ * row_size()))) {}

PixelVotes::PixelVotes(const Forest& forest, VolumeView<const float> features,
                       const Progress& progress)
    : PixelVotes(forest, features) {
  parallel_for((height_ + kForestRows - 1) / kForestRows, progress, [&](int band) {
    const int first = band * kForestRows;
    forest.predict_rows(features, {first, std::min(kForestRows, height_ - first)},
                        votes_.get() + first * row_size());
  });
}

PixelVotes::PixelVotes(const Forest& forest, VolumeView<const float> features,
                       const cuda::DeviceForest& device, const Progress& progress)
    : PixelVotes(forest, features) {
  device.vote(features, progress, votes_.get());
}

}  // namespace episcope
