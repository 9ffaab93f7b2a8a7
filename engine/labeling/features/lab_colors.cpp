// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/features/lab_colors.h"

#include <opencv2/imgproc.hpp>

namespace episcope {

cv::Mat rgb_colors(const cv::Mat& samples) {
  if (samples.channels() == 3) return samples;
  cv::Mat rgb;
  cv::cvtColor(samples, rgb, cv::COLOR_GRAY2RGB);
  return rgb;
}

cv::Mat lab_colors(const cv::Mat& samples) {
  constexpr double kUnit = 0.01;
  cv::Mat lab;
  cv::cvtColor(rgb_colors(samples), lab, cv::COLOR_RGB2Lab);
  lab *= kUnit;
  return lab;
}

}  // namespace episcope
