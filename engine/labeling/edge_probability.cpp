// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/edge_probability.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace episcope {
namespace {

// Jumps of disparity that are none, and how soon larger ones count in full.
constexpr float kNoEdgeJump_px = 0.02F;
constexpr float kJumpSharpness = 10;
constexpr int kNearJump_px = 2;

// Length of the disparity's forward differences, 0 where one of the pixels is invalid.
float disparity_jump(const DisparityView& map, int y, int x) {
  const int right = std::min(x + 1, map.disparity.width - 1);
  const int below = std::min(y + 1, map.disparity.height - 1);
  if (!map.is_valid(y, x) || !map.is_valid(y, right) || !map.is_valid(below, x)) return 0;
  const float d = map.disparity.at(y, x);
  return std::hypot(map.disparity.at(y, right) - d, map.disparity.at(below, x) - d);
}

// The largest value within kNearJump_px in every direction.
Image<float> widened(const Image<float>& map) {
  const int height = map.height(), width = map.width();
  Image<float> across(height, width);
  Image<float> out(height, width);
  for (int y = 0; y < height; ++y) {
    const float* in = map.row(y);
    for (int x = 0; x < width; ++x) {
      const int end = std::min(x + kNearJump_px + 1, width);
      across.at(y, x) = *std::max_element(in + std::max(x - kNearJump_px, 0), in + end);
    }
  }
  for (int y = 0; y < height; ++y) {
    float* to = out.row(y);
    for (int i = std::max(y - kNearJump_px, 0); i < std::min(y + kNearJump_px + 1, height); ++i) {
      const float* from = across.row(i);
      std::transform(from, from + width, to, to, [](float a, float b) { return std::max(a, b); });
    }
  }
  return out;
}

// What image edges count at each pixel; `trust` in disparity may be empty.
Image<float> edge_trust(const Image<float>& jumps, const Image<float>& trust, float texture) {
  Image<float> gaps(jumps.height(), jumps.width());
  std::transform(jumps.begin(), jumps.end(), gaps.begin(), [](float jump) {
    return 1 - std::exp(-kJumpSharpness * std::max(jump - kNoEdgeJump_px, 0.F));
  });
  Image<float> count = widened(gaps);
  for (float& c : count) c = texture + (1 - texture) * c;
  if (!trust.empty()) {
    std::transform(count.begin(), count.end(), trust.begin(), count.begin(),
                   [](float c, float t) { return std::lerp(1.0F, c, t); });
  }
  return count;
}

Image<float> disparity_jumps(const DisparityView& map) {
  Image<float> jumps(map.disparity.height, map.disparity.width);
  for (int y = 0; y < jumps.height(); ++y) {
    for (int x = 0; x < jumps.width(); ++x) jumps.at(y, x) = disparity_jump(map, y, x);
  }
  return jumps;
}

void fill_view(const LightField& lf, ViewIndex view, const DisparityField& disparity,
               const EdgeParameters& parameters, const ViewStack<float>* confidence,
               ImageView<float> out) {
  gradient_magnitude(lf, view, out);
  const auto beta = static_cast<float>(parameters.image);
  const auto gamma = static_cast<float>(parameters.disparity);
  if (!disparity.contains(view)) {
    for (int y = 0; y < out.height; ++y) {
      float* const row = out.row(y);
      std::transform(row, row + out.width, row,
                     [=](float edge) { return 1 - std::exp(-beta * edge); });
    }
    return;
  }
  Image<float> jumps = disparity_jumps(disparity.view(view));
  Image<float> trust;
  if (confidence != nullptr && confidence->contains(view)) {
    trust = disparity_trust(confidence->view(view));
    std::transform(jumps.begin(), jumps.end(), trust.begin(), jumps.begin(), std::multiplies<>());
  }
  const Image<float> count = edge_trust(jumps, trust, static_cast<float>(parameters.texture));
  for (int y = 0; y < out.height; ++y) {
    float* const row = out.row(y);
    const float *const jump = jumps.row(y), *const m = count.row(y);
    for (int x = 0; x < out.width; ++x) {
      row[x] = 1 - std::exp(-beta * m[x] * row[x] - gamma * jump[x]);
    }
  }
}

void check_sizes(const LightField& lf, const DisparityField& disparity) {
  if (disparity.empty() ||
      (disparity.disparity.height() == lf.height() && disparity.disparity.width() == lf.width())) {
    return;
  }
  throw InvalidInput("edges need disparities of the size of the light field");
}

constexpr float kSureTrust = 0.43F;
constexpr double kScale_px = 2;

// What a tenth of the pixels exceed.
float surest_tenth(ImageView<const float> confidence) {
  std::vector<float> sorted(confidence.data, confidence.data + confidence.size());
  const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 9 / 10);
  std::ranges::nth_element(sorted, at);
  return *at;
}

}  // namespace

Image<float> edge_probability(const LightField& light_field, ViewIndex view,
                              const DisparityField& disparity, const EdgeParameters& parameters) {
  check_sizes(light_field, disparity);
  Image<float> edges(light_field.height(), light_field.width());
  fill_view(light_field, view, disparity, parameters, nullptr, edges.view());
  return edges;
}

ViewStack<float> edge_probabilities(const LightField& light_field, const DisparityField& disparity,
                                    const EdgeParameters& parameters, const Progress& progress) {
  return edge_probabilities(light_field, {{0, 0}, light_field.grid()}, disparity, parameters,
                            progress);
}

ViewStack<float> edge_probabilities(const LightField& light_field, ViewRectangle views,
                                    const DisparityField& disparity,
                                    const EdgeParameters& parameters, const Progress& progress,
                                    const ViewStack<float>* confidence) {
  check_sizes(light_field, disparity);
  ViewStack<float> edges(views.grid, light_field.height(), light_field.width(), 1, views.first);
  parallel_for(views.grid.count(), progress, [&](int i) {
    const ViewIndex view = views.grid.view_at(i, views.first);
    fill_view(light_field, view, disparity, parameters, confidence, edges.view(view));
  });
  return edges;
}

Image<float> disparity_trust(ImageView<const float> confidence) {
  Image<float> trust(confidence.height, confidence.width);
  // OpenCV has no constant matrices; this one is only read.
  const cv::Mat in(confidence.height, confidence.width, CV_32F,
                   const_cast<float*>(confidence.data));
  cv::Mat out(confidence.height, confidence.width, CV_32F, trust.data());
  cv::GaussianBlur(in, out, {}, kScale_px, kScale_px, cv::BORDER_REPLICATE);
  const float sure = kSureTrust * surest_tenth(confidence);
  for (float& t : trust) {
    const float share = sure > 0 ? std::min(t / sure, 1.0F) : 0.0F;
    t = share * share;
  }
  return trust;
}

}  // namespace episcope
