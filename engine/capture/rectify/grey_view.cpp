// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/rectify/grey_view.h"

#include <opencv2/imgproc.hpp>

namespace episcope::capture {

Image<float> grey_view(const LightField& field, ViewIndex view) {
  constexpr double sigma = 0.8;
  const Image<float> samples = field.view_as_float(view);
  Image<float> grey(samples.height(), samples.width());
  for (int y = 0; y < grey.height(); ++y) {
    for (int x = 0; x < grey.width(); ++x) {
      float sum = 0;
      for (int c = 0; c < samples.channels(); ++c) sum += samples.at(y, x, c);
      grey.at(y, x) = sum * 255 / static_cast<float>(samples.channels());
    }
  }
  cv::Mat picture(grey.height(), grey.width(), CV_32F, grey.data());
  cv::GaussianBlur(picture, picture, {5, 5}, sigma);
  return grey;
}

}  // namespace episcope::capture
