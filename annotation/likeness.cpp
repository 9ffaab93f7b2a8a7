// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/likeness.h"

#include "annotation/brush.h"
#include "engine/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace episcope {
namespace {

constexpr float kLeastNoise = 1.0F / 255;

// Weighted 1 2 1 along x and y.
Image<float> smoothed(ImageView<const float> picture) {
  const int channels = picture.channels;
  Image<float> along(picture.height, picture.width, channels);
  Image<float> both(picture.height, picture.width, channels);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const int left = std::max(x - 1, 0), right = std::min(x + 1, picture.width - 1);
      for (int c = 0; c < channels; ++c) {
        along.at(y, x, c) =
            0.25F * (picture.at(y, left, c) + picture.at(y, right, c)) + 0.5F * picture.at(y, x, c);
      }
    }
  }
  for (int y = 0; y < picture.height; ++y) {
    const float *const up = along.row(std::max(y - 1, 0)), *const here = along.row(y),
                       *const down = along.row(std::min(y + 1, picture.height - 1));
    for (int i = 0; i < picture.width * channels; ++i) {
      both.row(y)[i] = 0.25F * (up[i] + down[i]) + 0.5F * here[i];
    }
  }
  return both;
}

float squared_difference(const float* a, const float* b, int channels) {
  float sum = 0;
  for (int c = 0; c < channels; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return sum;
}

float noise_of(const Image<float>& colors) {
  std::vector<float> differences;
  const int channels = colors.channels();
  for (int y = 0; y < colors.height(); ++y) {
    for (int x = 0; x + 1 < colors.width(); ++x) {
      differences.push_back(squared_difference(&colors.at(y, x), &colors.at(y, x + 1), channels));
    }
  }
  if (differences.empty()) return kLeastNoise;
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  return std::max(std::sqrt(*middle), kLeastNoise);
}

// Marks the nearer pixel of each pair that jumps: it hides the other surface.
Image<std::uint8_t> jumps_of(const DisparityView& disparity) {
  if (disparity.disparity.empty()) return {};
  const ImageView<const float>& d = disparity.disparity;
  Image<std::uint8_t> jumps(d.height, d.width);
  const auto look = [&](int y, int x, int to_y, int to_x) {
    if (to_y >= d.height || to_x >= d.width) return;
    if (!disparity.is_valid(y, x) || !disparity.is_valid(to_y, to_x)) return;
    const float step = d.at(to_y, to_x) - d.at(y, x);
    if (std::fabs(step) <= Likeness::kJump_px) return;
    (step > 0 ? jumps.at(to_y, to_x) : jumps.at(y, x)) = 1;
  };
  for (int y = 0; y < d.height; ++y) {
    for (int x = 0; x < d.width; ++x) {
      look(y, x, y, x + 1);
      look(y, x, y + 1, x);
    }
  }
  return jumps;
}

}  // namespace

Likeness::Likeness(ImageView<const float> picture, const DisparityView& disparity)
    : colors_(smoothed(picture)), jumps_(jumps_of(disparity)), noise_(noise_of(colors_)) {}

PixelRegion Likeness::region(PixelIndex seed, double tolerance) const {
  if (!(tolerance >= 0)) {
    throw InvalidInput(fmt::format("a fill cannot tolerate {:f}; choose 0 or more", tolerance));
  }
  const int height = colors_.height(), width = colors_.width(), channels = colors_.channels();
  if (seed.y < 0 || seed.y >= height || seed.x < 0 || seed.x >= width) return {};
  const float* const own = &colors_.at(seed.y, seed.x);
  const auto limit = static_cast<float>(tolerance) * noise_;
  Image<std::int32_t> alike(height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool jumps = !jumps_.empty() && jumps_.at(y, x) != 0;
      alike.at(y, x) =
          !jumps && squared_difference(&colors_.at(y, x), own, channels) <= limit * limit;
    }
  }
  alike.at(seed.y, seed.x) = 1;
  const Image<std::int32_t> open = alike;
  for (int y = 1; y + 1 < height; ++y) {
    for (int x = 1; x + 1 < width; ++x) {
      alike.at(y, x) |=
          open.at(y - 1, x) & open.at(y + 1, x) & open.at(y, x - 1) & open.at(y, x + 1);
    }
  }
  return region_of_segment(alike.view(), seed);
}

}  // namespace episcope
