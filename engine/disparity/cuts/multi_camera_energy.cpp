// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/cuts/multi_camera_energy.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace episcope {
namespace {

// Neighbours that differ less belong to one surface, so more speaks against a jump there.
constexpr float kAlike = 8;
constexpr std::int32_t kAlikeFactor = 3;

// λ_pq of every pixel and the one `dy` rows below and `dx` columns to the right.
Image<std::int32_t> neighbour_weights(const CameraImage& image, int height, int width, int dy,
                                      int dx, std::int32_t weight) {
  Image<std::int32_t> weights(height, width);
  for (int y = 0; y < height - dy; ++y) {
    for (int x = 0; x < width - dx; ++x) {
      bool alike = true;
      for (int c = 0; c < image.channels(); ++c) {
        alike = alike && std::fabs(image.row(c, y)[x] - image.row(c, y + dy)[x + dx]) < kAlike;
      }
      weights.at(y, x) = alike ? kAlikeFactor * weight : weight;
    }
  }
  return weights;
}

}  // namespace

MultiCameraEnergy::MultiCameraEnergy(const Interactions& interactions, CameraSmoothness smoothness)
    : interactions_(interactions), truncation_(smoothness.truncation) {
  const int height = interactions.height(), width = interactions.width();
  for (int view = 0; view <= static_cast<int>(interactions.sides().size()); ++view) {
    const CameraImage& image = interactions.image(view);
    to_right_.push_back(neighbour_weights(image, height, width, 0, 1, smoothness.weight));
    below_.push_back(neighbour_weights(image, height, width, 1, 0, smoothness.weight));
  }
}

CameraLabels MultiCameraEnergy::farthest() const {
  return CameraLabels(views(), Image<std::int16_t>(interactions_.height(), interactions_.width()));
}

std::int64_t MultiCameraEnergy::smoothness_of(const CameraLabels& labels) const {
  std::int64_t sum = 0;
  for (int view = 0; view < views(); ++view) {
    const Image<std::int16_t>& f = labels[view];
    for (int y = 0; y < f.height(); ++y) {
      for (int x = 0; x < f.width(); ++x) {
        const int here = f.at(y, x);
        const auto jump = [&](int y1, int x1) {
          return std::min(std::abs(here - f.at(y1, x1)), truncation_);
        };
        if (x + 1 < f.width()) sum += to_right(view, y)[x] * jump(y, x + 1);
        if (y + 1 < f.height()) sum += below(view, y)[x] * jump(y + 1, x);
      }
    }
  }
  return sum;
}

bool MultiCameraEnergy::is_visible(const CameraLabels& labels) const {
  const Image<std::int16_t>& reference = labels[0];
  const auto blocked = [](const Image<std::int16_t>& f, PixelIndex at, int label) {
    return at.y >= 0 && at.y < f.height() && at.x >= 0 && at.x < f.width() &&
           f.at(at.y, at.x) < label;
  };
  for (int side = 0; side + 1 < views(); ++side) {
    const SideView& there = interactions_.sides()[side];
    const Image<std::int16_t>& other = labels[side + 1];
    for (int y = 0; y < reference.height(); ++y) {
      for (int x = 0; x < reference.width(); ++x) {
        const int p = reference.at(y, x), q = other.at(y, x);
        if (blocked(other, there.place(y, x, p), p)) return false;
        if (blocked(reference, there.place_in_reference(y, x, q), q)) return false;
      }
    }
  }
  return true;
}

std::optional<std::int64_t> MultiCameraEnergy::of(const CameraLabels& labels) const {
  if (!is_visible(labels)) return std::nullopt;
  std::int64_t sum = smoothness_of(labels);
  const Image<std::int16_t>& reference = labels[0];
  std::vector<std::int32_t> gains(reference.width());
  for (int side = 0; side + 1 < views(); ++side) {
    const SideView& there = interactions_.sides()[side];
    for (int y = 0; y < reference.height(); ++y) {
      for (int label = 0; label < interactions_.labels(); ++label) {
        interactions_.gains(side, label, y, gains.data());
        for (int x = 0; x < reference.width(); ++x) {
          if (gains[x] == 0 || reference.at(y, x) != label) continue;
          const PixelIndex q = there.place(y, x, label);
          if (labels[side + 1].at(q.y, q.x) == label) sum += gains[x];
        }
      }
    }
  }
  return sum;
}

}  // namespace episcope
