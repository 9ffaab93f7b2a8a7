// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/disparity_trust.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace episcope {
namespace {

constexpr float kSure = 0.4F;
constexpr double kScale_px = 2;

}  // namespace

Image<float> disparity_trust(ImageView<const float> confidence) {
  Image<float> trust(confidence.height, confidence.width);
  // OpenCV has no constant matrices; this one is only read.
  const cv::Mat in(confidence.height, confidence.width, CV_32F,
                   const_cast<float*>(confidence.data));
  cv::Mat out(confidence.height, confidence.width, CV_32F, trust.data());
  cv::GaussianBlur(in, out, {}, kScale_px, kScale_px, cv::BORDER_REPLICATE);
  for (float& t : trust) {
    const float share = std::min(t / kSure, 1.0F);
    t = share * share;
  }
  return trust;
}

}  // namespace episcope
