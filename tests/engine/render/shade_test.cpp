// SPDX-License-Identifier: BSD-3-Clause
#include "engine/render/shade.h"
#include "engine/core/error.h"
#include "tests/test_main.h"

#include <cmath>
#include <limits>
#include <set>

namespace episcope::in_shade_test {

using namespace episcope::render;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Rgb pixel(const Image<std::uint8_t>& picture, int y, int x) {
  return {picture.at(y, x, 0), picture.at(y, x, 1), picture.at(y, x, 2)};
}

/// A textured plane of disparity `d`: in view (v, u) the sample at (x, y) is that of the center at
/// (x + d·(u − u_c), y + d·(v − v_c)).
template <class T>
LightField plane(double d, double scale, int size = 40, int channels = 3) {
  ViewStack<T> stack({5, 5}, size, size, channels);
  for (int v = 0; v < 5; ++v) {
    for (int u = 0; u < 5; ++u) {
      auto view = stack.view({v, u});
      for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
          const double cx = x + d * (u - 2);
          const double cy = y + d * (v - 2);
          for (int c = 0; c < channels; ++c) {
            const double value = 0.5 + 0.4 * std::sin(0.25 * cx + c) * std::cos(0.2 * cy);
            view.at(y, x, c) = static_cast<T>(value * scale + (scale > 1 ? 0.5 : 0));
          }
        }
      }
    }
  }
  return LightField(std::move(stack), {});
}

/// Largest difference between refocused and true center, away from the border.
double worst_inside(const LightField& light_field, double focus) {
  const auto refocused = refocus(light_field, {2, 2}, focus);
  const auto center = light_field.view_as_float({2, 2});
  double worst = 0;
  for (int y = 8; y < 32; ++y) {
    for (int x = 8; x < 32; ++x) {
      for (int c = 0; c < 3; ++c) {
        worst = std::max<double>(worst, std::abs(refocused.at(y, x, c) - center.at(y, x, c)));
      }
    }
  }
  return worst;
}

}  // namespace

class ShadeTest : public QObject {
  Q_OBJECT
 private slots:
  void shade_coloursValuesAndInvalidPixels() {
    Image<float> map(2, 2);
    map.at(0, 0) = -1;
    map.at(0, 1) = 1;
    map.at(1, 0) = kNan;
    map.at(1, 1) = 0;
    Image<std::uint8_t> valid(2, 2, 1, 1);
    valid.at(1, 1) = 0;
    const Shading shading{color_map("viridis"), {-1, 1}};

    const auto picture = shade(map.view(), valid.view(), shading);

    QCOMPARE(picture.channels(), 4);
    QCOMPARE(pixel(picture, 0, 0), shading.map.colors.front());
    QCOMPARE(pixel(picture, 0, 1), shading.map.colors.back());
    QCOMPARE(pixel(picture, 1, 0), shading.map.invalid);
    QCOMPARE(pixel(picture, 1, 1), shading.map.invalid);
    QCOMPARE(int{picture.at(1, 1, 3)}, 255);
  }

  void defaultShading_belongsToTheQuantity() {
    const Interval disparities{-1.5, 2};
    QCOMPARE(default_shading(Quantity::Disparity, disparities).range, disparities);
    QCOMPARE(default_shading(Quantity::Truth, disparities).map.name, std::string("viridis"));
    const auto error = default_shading(Quantity::SignedError, disparities);
    QCOMPARE(error.map.name, std::string("seismic"));
    QCOMPARE(error.range, (Interval{-0.2, 0.2}));
    const Rgb too_near = error.map.color(-0.1, error.range.min, error.range.max);
    const Rgb too_far = error.map.color(0.1, error.range.min, error.range.max);
    QVERIFY(too_near[2] > too_near[0]);
    QVERIFY(too_far[0] > too_far[2]);
    const auto bad = default_shading(Quantity::BadPixels, disparities);
    const Rgb good_pixel = bad.map.color(0.2, bad.range.min, bad.range.max);
    const Rgb bad_pixel = bad.map.color(1, bad.range.min, bad.range.max);
    QVERIFY(good_pixel[1] > good_pixel[0]);
    QVERIFY(bad_pixel[0] > bad_pixel[1]);
  }

  void shadeView_keepsEverySampleType() {
    const auto bytes = shade_view(plane<std::uint8_t>(0, 255), {1, 3});
    const auto words = shade_view(plane<std::uint16_t>(0, 65535), {1, 3});
    const auto floats = shade_view(plane<float>(0, 1), {1, 3});
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      QVERIFY(std::abs(bytes.data()[i] - words.data()[i]) <= 1);
      QVERIFY(std::abs(bytes.data()[i] - floats.data()[i]) <= 1);
    }
    const auto grey = shade_view(plane<std::uint8_t>(0, 255, 40, 1), {0, 0});
    QCOMPARE(grey.at(3, 5, 0), grey.at(3, 5, 2));
    QCOMPARE(int{grey.at(3, 5, 3)}, 255);
  }

  void shadeSamples_roundsAndClamps() {
    Image<float> samples(1, 4);
    samples.at(0, 0) = -1;
    samples.at(0, 1) = 0.5F;
    samples.at(0, 2) = 2;
    samples.at(0, 3) = kNan;

    const auto picture = shade_samples(samples.view());

    QCOMPARE(pixel(picture, 0, 0), (Rgb{0, 0, 0}));
    QCOMPARE(pixel(picture, 0, 1), (Rgb{128, 128, 128}));
    QCOMPARE(pixel(picture, 0, 2), (Rgb{255, 255, 255}));
    QCOMPARE(pixel(picture, 0, 3), (Rgb{0, 0, 0}));
  }

  void labels_haveColoursOfTheirOwn() {
    Image<std::int32_t> labels(1, 42);
    for (int i = 0; i < 42; ++i) labels.at(0, i) = i - 1;

    const auto picture = shade_labels(labels.view());

    QCOMPARE(int{picture.at(0, 0, 3)}, 0);
    QCOMPARE(int{picture.at(0, 1, 3)}, 0);
    std::set<Rgb> colors;
    for (int i = 2; i < 42; ++i) {
      QCOMPARE(int{picture.at(0, i, 3)}, 255);
      colors.insert(pixel(picture, 0, i));
    }
    QCOMPARE(colors.size(), std::size_t{40});
    QCOMPARE(pixel(picture, 0, 2), label_color(1));
  }

  void contours_areThePixelsThatTouchOtherLabels() {
    Image<std::int32_t> labels(6, 8, 1, 1);
    for (int y = 0; y < 6; ++y) {
      for (int x = 4; x < 8; ++x) labels.at(y, x) = 2;
    }
    const auto alpha = [&](LabelStyle style, int x) {
      return int{shade_labels(labels.view(), {}, style).at(3, x, 3)};
    };

    QCOMPARE(alpha({LabelDrawing::Contours}, 3), 255);
    QCOMPARE(alpha({LabelDrawing::Contours}, 4), 255);
    QCOMPARE(alpha({LabelDrawing::Contours}, 2), 0);
    QCOMPARE(alpha({LabelDrawing::Contours}, 7), 0);  // the border of the image is none
    QCOMPARE(alpha({LabelDrawing::Both}, 3), 255);
    QCOMPARE(alpha({LabelDrawing::Both}, 2), kFaintLabel);
    QCOMPARE(alpha({LabelDrawing::Fill, {2}}, 3), 255);
    QCOMPARE(alpha({LabelDrawing::Fill, {2}}, 4), 0);
    QCOMPARE(alpha({LabelDrawing::Contours, {2}}, 3), 255);
  }

  // Dashed, whatever their direction, unlike outlined strokes.
  void contours_haveGaps() {
    Image<std::int32_t> labels(32, 32, 1, 1);
    for (int i = 0; i < 32; ++i) labels.at(i, 16) = labels.at(7, i) = 2;

    const auto picture = shade_labels(labels.view(), {}, {LabelDrawing::Contours});

    int down = 0, across = 0;
    for (int i = 0; i < 32; ++i) {
      down += pixel(picture, i, 16) == label_color(2);
      across += pixel(picture, 7, i) == label_color(2);
    }
    QCOMPARE(down, 16);
    QCOMPARE(across, 16);
    QCOMPARE(pixel(picture, 7, 0), (Rgb{0, 0, 0}));
  }

  void robustRange_ignoresOutliersAndInvalidPixels() {
    Image<float> map(10, 100);
    for (int i = 0; i < 1000; ++i) map.data()[i] = static_cast<float>(i);
    map.at(0, 0) = -1e6F;
    map.at(9, 99) = kNan;
    Image<std::uint8_t> valid(10, 100, 1, 1);
    valid.at(9, 98) = 0;
    map.at(9, 98) = 1e6F;

    const auto range = robust_range(map.view(), valid.view());

    QCOMPARE(range.min, 10.0);
    QCOMPARE(range.max, 987.0);
    QCOMPARE(robust_range(map.view(), Image<std::uint8_t>(10, 100).view()), (Interval{0, 1}));
  }

  void refocus_onThePlaneGivesTheView() {
    // Linear interpolation of a wave of 25 px: 0.5·0.25²·¼ = 0.8 % at most; 8 bits add 1/510.
    QVERIFY(worst_inside(plane<std::uint8_t>(1, 255), 1) < 0.004);
    QVERIFY(worst_inside(plane<std::uint8_t>(-0.6, 255), -0.6) < 0.012);
    QVERIFY(worst_inside(plane<std::uint16_t>(0.4, 65535), 0.4) < 0.01);
    QVERIFY(worst_inside(plane<float>(-1.5, 1), -1.5) < 0.01);
  }

  void refocus_elsewhereBlurs() { QVERIFY(worst_inside(plane<float>(1, 1), -1) > 0.05); }

  void refocus_keepsAUniformField() {
    ViewStack<std::uint8_t> stack({3, 3}, 9, 11, 3);
    std::fill_n(stack.data(), stack.size(), std::uint8_t{200});
    const LightField light_field(std::move(stack), {});
    for (const double focus : {0.0, 0.37, -20.5}) {
      const auto mean = refocus(light_field, {0, 2}, focus);
      for (const float sample : mean) QVERIFY(std::abs(sample - 200.0F / 255) < 1e-6F);
    }
  }

  void refocus_outsideTheGridIsRefused() {
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)refocus(plane<float>(0, 1), {5, 0}, 0));
  }
};

}  // namespace episcope::in_shade_test

EPISCOPE_TEST(shade_test, ShadeTest)
#include "shade_test.moc"
