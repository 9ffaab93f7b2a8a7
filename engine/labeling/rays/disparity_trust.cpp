// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/disparity_trust.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <vector>

namespace episcope {
namespace {

constexpr float kSure = 0.43F;
constexpr double kScale_px = 2;

// What a tenth of the pixels exceed.
float surest_tenth(ImageView<const float> confidence) {
  std::vector<float> sorted(confidence.data, confidence.data + confidence.size());
  const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 9 / 10);
  std::ranges::nth_element(sorted, at);
  return *at;
}

}  // namespace

Image<float> disparity_trust(ImageView<const float> confidence) {
  Image<float> trust(confidence.height, confidence.width);
  // OpenCV has no constant matrices; this one is only read.
  const cv::Mat in(confidence.height, confidence.width, CV_32F,
                   const_cast<float*>(confidence.data));
  cv::Mat out(confidence.height, confidence.width, CV_32F, trust.data());
  cv::GaussianBlur(in, out, {}, kScale_px, kScale_px, cv::BORDER_REPLICATE);
  const float sure = kSure * surest_tenth(confidence);
  for (float& t : trust) {
    const float share = sure > 0 ? std::min(t / sure, 1.0F) : 0.0F;
    t = share * share;
  }
  return trust;
}

}  // namespace episcope
