// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/pixel_features.h"

#include "engine/core/error.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace episcope {
namespace {

constexpr double kColorScales[] = {1, 2.5, 6};
constexpr double kShapeScales[] = {1, 2, 4};
constexpr double kDisparityScale = 2;
constexpr float kLabUnit = 0.01F;

std::string at_scale(const char* name, double sigma) {
  std::string digits = std::to_string(sigma);
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
  return std::string(name) + ", " + digits + " px";
}

cv::Mat smoothed(const cv::Mat& plane, double sigma) {
  cv::Mat out;
  cv::GaussianBlur(plane, out, {}, sigma, sigma, cv::BORDER_REPLICATE);
  return out;
}

cv::Mat derivative(const cv::Mat& plane, int dx, int dy) {
  cv::Mat out;
  // The kernels of Sobel weigh 8 for a first and 4 for a second derivative, the mixed one 4.
  cv::Sobel(plane, out, CV_32F, dx, dy, 3, dx + dy == 1 ? 1.0 / 8 : 1.0 / 4, 0,
            cv::BORDER_REPLICATE);
  return out;
}

cv::Mat magnitude(const cv::Mat& dx, const cv::Mat& dy) {
  cv::Mat out;
  cv::magnitude(dx, dy, out);
  return out;
}

/// Fills the layers of a volume one after the other.
class LayerWriter {
 public:
  explicit LayerWriter(PixelFeatures& features) : features_(features.view()) {}

  void add(const cv::Mat& plane, float unit = 1) {
    for (int y = 0; y < features_.height; ++y) {
      const auto* in = plane.ptr<float>(y);
      std::transform(in, in + features_.width, features_.row(y, layer_),
                     [unit](float value) { return value * unit; });
    }
    ++layer_;
  }

  void add(const std::vector<cv::Mat>& planes, float unit) {
    for (const cv::Mat& plane : planes) add(plane, unit);
  }

  /// The larger and the smaller eigenvalue of [a b; b c] in each pixel.
  void add_eigenvalues(const cv::Mat& a, const cv::Mat& b, const cv::Mat& c, float unit) {
    for (int y = 0; y < features_.height; ++y) {
      const auto *pa = a.ptr<float>(y), *pb = b.ptr<float>(y), *pc = c.ptr<float>(y);
      float* larger = features_.row(y, layer_);
      float* smaller = features_.row(y, layer_ + 1);
      for (int x = 0; x < features_.width; ++x) {
        const float mean = 0.5F * (pa[x] + pc[x]);
        const float half = 0.5F * (pa[x] - pc[x]);
        const float spread = std::sqrt(half * half + pb[x] * pb[x]);
        larger[x] = unit * (mean + spread);
        smaller[x] = unit * (mean - spread);
      }
    }
    layer_ += 2;
  }

 private:
  VolumeView<float> features_;
  int layer_ = 0;
};

cv::Mat color_image(const LightField& lf, ViewIndex view) {
  Image<float> samples = lf.view_as_float(view);
  const cv::Mat wrapped(lf.height(), lf.width(), CV_32FC(lf.channels()), samples.data());
  if (lf.channels() == 3) return wrapped.clone();
  cv::Mat color;
  cv::cvtColor(wrapped, color, cv::COLOR_GRAY2RGB);
  return color;
}

void add_color(LayerWriter& layers, const cv::Mat& rgb, const std::vector<cv::Mat>& lab) {
  std::vector<cv::Mat> channels;
  cv::split(rgb, channels);
  layers.add(channels, 1);
  layers.add(lab, kLabUnit);
  for (const double sigma : kColorScales) {
    for (const cv::Mat& channel : lab) layers.add(smoothed(channel, sigma), kLabUnit);
  }
}

void add_shape(LayerWriter& layers, const cv::Mat& lightness) {
  for (const double sigma : kShapeScales) {
    const auto first = static_cast<float>(kLabUnit * sigma);
    const auto second = static_cast<float>(kLabUnit * sigma * sigma);
    const cv::Mat smooth = smoothed(lightness, sigma);
    const cv::Mat dx = derivative(smooth, 1, 0);
    const cv::Mat dy = derivative(smooth, 0, 1);
    const cv::Mat dxx = derivative(smooth, 2, 0);
    const cv::Mat dyy = derivative(smooth, 0, 2);
    layers.add(magnitude(dx, dy), first);
    layers.add(dxx + dyy, second);
    layers.add_eigenvalues(dxx, derivative(smooth, 1, 1), dyy, second);
    layers.add_eigenvalues(smoothed(dx.mul(dx), 2 * sigma), smoothed(dx.mul(dy), 2 * sigma),
                           smoothed(dy.mul(dy), 2 * sigma), first * first);
  }
}

void add_place(LayerWriter& layers, const cv::Mat& disparity, ViewIndex step) {
  const float unit = 1.0F / static_cast<float>(std::max(disparity.rows, disparity.cols));
  cv::Mat column(disparity.size(), CV_32F);
  cv::Mat row(disparity.size(), CV_32F);
  for (int y = 0; y < disparity.rows; ++y) {
    const auto* d = disparity.ptr<float>(y);
    for (int x = 0; x < disparity.cols; ++x) {
      column.at<float>(y, x) = static_cast<float>(x) + d[x] * static_cast<float>(step.u);
      row.at<float>(y, x) = static_cast<float>(y) + d[x] * static_cast<float>(step.v);
    }
  }
  layers.add(column, unit);
  layers.add(row, unit);
}

void add_disparity(LayerWriter& layers, const cv::Mat& disparity) {
  const cv::Mat smooth = smoothed(disparity, kDisparityScale);
  layers.add(disparity);
  layers.add(smooth);
  layers.add(magnitude(derivative(smooth, 1, 0), derivative(smooth, 0, 1)));
}

}  // namespace

std::vector<std::string> pixel_feature_names(PixelFeatureSet set) {
  std::vector<std::string> names{"red", "green", "blue", "lightness", "Lab a", "Lab b"};
  for (const double sigma : kColorScales) {
    for (const char* name : {"lightness", "Lab a", "Lab b"}) {
      names.push_back(at_scale((std::string(name) + " smoothed").c_str(), sigma));
    }
  }
  for (const double sigma : kShapeScales) {
    for (const char* name : {"gradient", "Laplacian", "Hessian, larger", "Hessian, smaller",
                             "structure, larger", "structure, smaller"}) {
      names.push_back(at_scale(name, sigma));
    }
  }
  names.insert(names.end(), {"column in the centre view", "row in the centre view"});
  if (set.with_disparity) {
    names.insert(names.end(), {"disparity", at_scale("disparity smoothed", kDisparityScale),
                               at_scale("disparity gradient", kDisparityScale)});
  }
  return names;
}

PixelFeatures compute_pixel_features(const LightField& lf, ViewIndex view,
                                     const DisparityView& disparity, PixelFeatureSet set) {
  if (set.with_disparity && disparity.disparity.empty()) {
    throw InvalidInput("features of disparity were asked for, but view " + view_text(view) +
                       " has no disparity; estimate all views first");
  }
  PixelFeatures features(lf.height(), static_cast<int>(pixel_feature_names(set).size()),
                         lf.width());
  LayerWriter layers(features);
  const cv::Mat rgb = color_image(lf, view);
  cv::Mat lab_image;
  cv::cvtColor(rgb, lab_image, cv::COLOR_RGB2Lab);
  std::vector<cv::Mat> lab;
  cv::split(lab_image, lab);
  add_color(layers, rgb, lab);
  add_shape(layers, lab[0]);

  Image<float> filled(lf.height(), lf.width());
  if (!disparity.disparity.empty()) filled = filled_disparity(disparity);
  const cv::Mat map(lf.height(), lf.width(), CV_32F, filled.data());
  add_place(layers, map, {view.v - lf.center().v, view.u - lf.center().u});
  if (set.with_disparity) add_disparity(layers, map);
  return features;
}

Image<float> filled_disparity(const DisparityView& disparity) {
  const ImageView<const float> map = disparity.disparity;
  Image<float> filled(map.height, map.width);
  for (int y = 0; y < map.height; ++y) {
    float* row = filled.row(y);
    int last = -1;
    for (int x = 0; x < map.width; ++x) {
      if (!disparity.is_valid(y, x)) continue;
      row[x] = map.at(y, x);
      // Holes are filled half from either side.
      const int middle = last < 0 ? 0 : (last + x + 1) / 2;
      for (int hole = last + 1; hole < x; ++hole) row[hole] = hole < middle ? row[last] : row[x];
      last = x;
    }
    if (last < 0) {
      if (y > 0) std::copy_n(filled.row(y - 1), map.width, row);
      continue;
    }
    std::fill(row + last + 1, row + map.width, row[last]);
  }
  return filled;
}

}  // namespace episcope
