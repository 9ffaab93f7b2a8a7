// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/pixel_features.h"

#include "tests/test_main.h"

#include <opencv2/imgproc.hpp>

#include <cmath>
#include <random>
#include <vector>

namespace episcope::in_surface_filter_test {

namespace {

// No multiple of any vector.
constexpr int kHeight = 21;
constexpr int kWidth = 45;
constexpr double kContrast = 0.1;

// Two surfaces with noise.
ColorPlanes noisy_halves() {
  std::mt19937 random(1);
  ColorPlanes planes;
  for (std::size_t c = 0; c < planes.size(); ++c) {
    planes[c] = Image<float>(kHeight, kWidth);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const float noise = static_cast<float>(random() % 1000) * 1e-4F;
        planes[c].at(y, x) = (x < kWidth / 2 ? 0.2F : 0.7F) + noise;
      }
    }
  }
  return planes;
}

ColorPlanes filtered(const ColorPlanes& planes, Isa isa = best_isa(), int threads = 2) {
  return filter_surfaces(planes, {kContrast, 6, 6, isa}, Progress(threads));
}

double largest_difference(const Image<float>& a, const Image<float>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, static_cast<double>(std::abs(a.data()[i] - b.data()[i])));
  }
  return largest;
}

}  // namespace

class SurfaceFilterTest : public QObject {
  Q_OBJECT

 private slots:
  void means_areThoseOfOpenCv() {
    const ColorPlanes planes = noisy_halves();
    std::vector<cv::Mat> channels;
    for (const Image<float>& plane : planes) {
      channels.push_back(
          cv::Mat(kHeight, kWidth, CV_32F, const_cast<float*>(plane.data())).clone());
    }
    cv::Mat image, expected;
    cv::merge(channels, image);
    cv::bilateralFilter(image, expected, 13, kContrast, 6, cv::BORDER_REPLICATE);

    const ColorPlanes own = filtered(planes);

    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        for (int c = 0; c < 3; ++c) {
          // OpenCV interpolates the weights in a table of 12,000 entries.
          QVERIFY(std::abs(own[static_cast<std::size_t>(c)].at(y, x) -
                           expected.at<cv::Vec3f>(y, x)[c]) < 1e-5F);
        }
      }
    }
  }

  void instructionSetsAndThreads_agree() {
    const ColorPlanes planes = noisy_halves();
    const ColorPlanes best = filtered(planes);
    const ColorPlanes plain = filtered(planes, Isa::Baseline, 1);

    for (std::size_t c = 0; c < planes.size(); ++c) {
      QVERIFY(largest_difference(best[c], plain[c]) < 1e-6);  // Fused multiply-adds.
    }
  }

  void evenColors_stay() {
    ColorPlanes planes;
    for (Image<float>& plane : planes) {
      plane = Image<float>(3, 5);
      for (float& value : plane) value = 0.25F;
    }

    for (const Image<float>& plane : filtered(planes)) {
      for (const float value : plane) QVERIFY(std::abs(value - 0.25F) < 1e-6F);
    }
  }
};

}  // namespace episcope::in_surface_filter_test

EPISCOPE_TEST(surface_filter_test, SurfaceFilterTest)
#include "surface_filter_test.moc"
