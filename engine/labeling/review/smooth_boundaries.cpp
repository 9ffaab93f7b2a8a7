// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/review/smooth_boundaries.h"

#include "engine/core/array/pixel_rect.h"
#include "engine/core/error.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace episcope {
namespace {

constexpr double kReach = 3;  // of a Gaussian, in standard deviations

std::map<std::int32_t, PixelRect> bounds_of(ImageView<const std::int32_t> labels) {
  std::map<std::int32_t, PixelRect> bounds;
  for (int y = 0; y < labels.height; ++y) {
    const std::int32_t* row = labels.row(y);
    for (int x = 0; x < labels.width;) {
      const int begin = x;
      while (x < labels.width && row[x] == row[begin]) ++x;
      bounds[row[begin]].include({y, begin, y + 1, x});
    }
  }
  return bounds;
}

// Where pixels of the label can have any weight.
PixelRect widened(const PixelRect& rect, int margin, ImageView<const std::int32_t> labels) {
  return {std::max(0, rect.y0 - margin), std::max(0, rect.x0 - margin),
          std::min(labels.height, rect.y1 + margin), std::min(labels.width, rect.x1 + margin)};
}

cv::Mat weights_of(std::int32_t label, const PixelRect& rect, ImageView<const std::int32_t> labels,
                   double smoothing_px) {
  cv::Mat weights(rect.y1 - rect.y0, rect.x1 - rect.x0, CV_32F);
  for (int y = rect.y0; y < rect.y1; ++y) {
    const std::int32_t* row = labels.row(y);
    std::transform(row + rect.x0, row + rect.x1, weights.ptr<float>(y - rect.y0),
                   [label](std::int32_t each) { return each == label ? 1.0F : 0.0F; });
  }
  const int size = 2 * static_cast<int>(std::ceil(kReach * smoothing_px)) + 1;
  cv::GaussianBlur(weights, weights, cv::Size(size, size), smoothing_px, smoothing_px,
                   cv::BORDER_REPLICATE);
  return weights;
}

}  // namespace

Image<std::int32_t> smooth_boundaries(ImageView<const std::int32_t> labels,
                                      ImageView<const std::uint8_t> painted, double smoothing_px) {
  if (smoothing_px < 0) throw InvalidInput("boundaries cannot be smoothed by less than 0 px");
  if (!painted.empty() && (painted.height != labels.height || painted.width != labels.width)) {
    throw InvalidInput("labels and scribbles differ in size");
  }
  Image<std::int32_t> smooth(labels.height, labels.width);
  for (int y = 0; y < labels.height; ++y) std::copy_n(labels.row(y), labels.width, smooth.row(y));
  if (smoothing_px == 0) return smooth;
  constexpr float kTie = 1e-4F;  // own labels win against rounding
  Image<float> best(labels.height, labels.width);
  const int margin = static_cast<int>(std::ceil(kReach * smoothing_px));
  for (const auto& [label, bounds] : bounds_of(labels)) {
    const PixelRect rect = widened(bounds, margin, labels);
    const cv::Mat weights = weights_of(label, rect, labels, smoothing_px);
    for (int y = rect.y0; y < rect.y1; ++y) {
      const auto* weight = weights.ptr<float>(y - rect.y0);
      for (int x = rect.x0; x < rect.x1; ++x, ++weight) {
        if (!painted.empty() && painted.at(y, x) != 0) continue;
        const float now = *weight + (labels.at(y, x) == label ? kTie : 0);
        if (now <= best.at(y, x)) continue;
        best.at(y, x) = now;
        smooth.at(y, x) = label;
      }
    }
  }
  return smooth;
}

}  // namespace episcope
