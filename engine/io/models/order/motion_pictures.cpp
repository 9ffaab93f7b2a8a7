// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/order/motion_pictures.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace episcope::io {

namespace {

std::vector<float> gaussian(double sigma) {
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  std::vector<float> kernel(static_cast<std::size_t>(2 * radius + 1));
  float sum = 0;
  for (int i = -radius; i <= radius; ++i) {
    const auto weight = static_cast<float>(std::exp(-0.5 * i * i / (sigma * sigma)));
    kernel[static_cast<std::size_t>(i + radius)] = weight;
    sum += weight;
  }
  for (float& weight : kernel) weight /= sum;
  return kernel;
}

/// Blurs the rows, with the border repeated, and transposes.
Image<float> blurred_and_transposed(const Image<float>& picture, const std::vector<float>& kernel) {
  const int width = picture.width();
  const int radius = static_cast<int>(kernel.size() / 2);
  Image<float> out(width, picture.height());
  std::vector<float> row(static_cast<std::size_t>(width + 2 * radius));
  for (int y = 0; y < picture.height(); ++y) {
    for (int i = 0; i < width + 2 * radius; ++i) {
      row[static_cast<std::size_t>(i)] = picture.at(y, std::clamp(i - radius, 0, width - 1));
    }
    for (int x = 0; x < width; ++x) {
      float sum = 0;
      for (std::size_t k = 0; k < kernel.size(); ++k) {
        sum += kernel[k] * row[static_cast<std::size_t>(x) + k];
      }
      out.at(x, y) = sum;
    }
  }
  return out;
}

Image<float> blurred(const Image<float>& picture, double sigma) {
  const std::vector<float> kernel = gaussian(sigma);
  return blurred_and_transposed(blurred_and_transposed(picture, kernel), kernel);
}

}  // namespace

Image<float> middle_of(const Image<float>& picture, int side) {
  const int height = std::min(picture.height(), side);
  const int width = std::min(picture.width(), side);
  const int top = (picture.height() - height) / 2;
  const int left = (picture.width() - width) / 2;
  Image<float> part(height, width);
  for (int y = 0; y < height; ++y) {
    std::copy_n(picture.row(top + y) + left, width, part.row(y));
  }
  return part;
}

int reduction(int larger, int side) {
  return std::max((larger + side - 1) / side, 1);
}

Image<float> reduced(const Image<float>& picture, int side) {
  return reduced_by(picture, reduction(std::max(picture.height(), picture.width()), side));
}

Image<float> reduced_by(const Image<float>& picture, int k) {
  Image<float> small(std::max(picture.height() / k, 1), std::max(picture.width() / k, 1));
  for (int y = 0; y < small.height(); ++y) {
    for (int x = 0; x < small.width(); ++x) {
      float sum = 0;
      int count = 0;
      for (int j = y * k; j < std::min((y + 1) * k, picture.height()); ++j) {
        for (int i = x * k; i < std::min((x + 1) * k, picture.width()); ++i, ++count) {
          sum += picture.at(j, i);
        }
      }
      small.at(y, x) = sum / static_cast<float>(count);
    }
  }
  return small;
}

Image<float> smoothed(const Image<float>& picture) {
  return blurred(picture, 0.7);
}

Image<float> band_passed(const Image<float>& picture) {
  Image<float> fine = blurred(picture, 0.8);
  const Image<float> coarse = blurred(picture, 4);
  double sum = 0;
  double squares = 0;
  for (std::size_t i = 0; i < fine.size(); ++i) {
    float& value = fine.data()[i];
    value -= coarse.data()[i];
    sum += value;
    squares += static_cast<double>(value) * value;
  }
  const auto n = static_cast<double>(fine.size());
  const double mean = sum / n;
  const double variance = squares / n - mean * mean;
  const double scale = variance > 1e-8 ? 1 / std::sqrt(variance) : 0;
  for (float& value : fine) value = static_cast<float>(scale * (value - mean));
  return fine;
}

namespace {

double contrast_of(const Image<float>& picture) {
  double sum = 0;
  double squares = 0;
  for (const float value : picture) {
    sum += value;
    squares += static_cast<double>(value) * value;
  }
  const auto n = static_cast<double>(std::max<std::size_t>(picture.size(), 1));
  return std::sqrt(std::max(squares / n - sum / n * (sum / n), 0.0));
}

}  // namespace

MotionPictures::MotionPictures(const Image<float>& grey) {
  const Image<float> small = reduced(grey, 160);
  contrast = contrast_of(small);
  scales = {band_passed(middle_of(grey, 256)), band_passed(small), band_passed(reduced(grey, 40))};
}

double correlation(const Image<float>& a, const Image<float>& b) {
  double sum = 0;
  for (int y = 0; y < a.height(); ++y) {
    float row = 0;
    for (int x = 0; x < a.width(); ++x) row += a.at(y, x) * b.at(y, x);
    sum += row;
  }
  return sum / static_cast<double>(a.size());
}

}  // namespace episcope::io
