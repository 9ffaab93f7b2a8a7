// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/pixel_features.h"

#include "engine/core/error.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope::in_pixel_features_test {

namespace {

constexpr GridShape kGrid{3, 3};
constexpr int kHeight = 20;
constexpr int kWidth = 24;
constexpr float kDisparity = 1.5F;

LightField light_field(int channels, std::uint8_t value) {
  ViewStack<std::uint8_t> samples(kGrid, kHeight, kWidth, channels);
  std::fill_n(samples.data(), samples.size(), value);
  return {std::move(samples), {}};
}

Image<float> constant_map(float value) {
  return {kHeight, kWidth, 1, value};
}

int layer_of(PixelFeatureSet set, const std::string& name) {
  const auto names = pixel_feature_names(set);
  return static_cast<int>(std::ranges::find(names, name) - names.begin());
}

}  // namespace

class PixelFeaturesTest : public QObject {
  Q_OBJECT

 private slots:
  void everyFeature_hasAName_data();
  void everyFeature_hasAName();
  void constantImage_hasNoGradients();
  void place_isCarriedAlongTheRay();
  void constantDisparity_hasNoSlope();
  void inclinedDisparity_hasItsSlopeInEveryRow();
  void disparityAsFeature_mustBeThere();
  void holesInDisparity_takeTheirNeighbours();
};

void PixelFeaturesTest::everyFeature_hasAName_data() {
  QTest::addColumn<bool>("with_disparity");
  QTest::addColumn<int>("channels");
  QTest::newRow("image") << false << 3;
  QTest::newRow("disparity") << true << 3;
  QTest::newRow("grey") << true << 1;
}

void PixelFeaturesTest::everyFeature_hasAName() {
  QFETCH(bool, with_disparity);
  QFETCH(int, channels);
  const PixelFeatureSet set{with_disparity};
  const Image<float> map = constant_map(kDisparity);

  const PixelFeatures features =
      compute_pixel_features(light_field(channels, 100), {0, 1}, {map.view(), {}}, set, Progress());

  QCOMPARE(features.height(), kHeight);
  QCOMPARE(features.width(), kWidth);
  QCOMPARE(features.layers(), static_cast<int>(pixel_feature_names(set).size()));
  for (int i = 0; i < kHeight * features.layers() * kWidth; ++i) {
    QVERIFY(std::isfinite(features.view().data[i]));
  }
  QCOMPARE(kWiderSurfaceLayer, layer_of(set, "lightness, of the wider surface"));
}

void PixelFeaturesTest::constantImage_hasNoGradients() {
  const PixelFeatures features =
      compute_pixel_features(light_field(3, 128), {1, 1}, {}, {}, Progress());

  const float lightness = features.view().at(3, layer_of({}, "lightness"), 4);
  QVERIFY(lightness > 0.4F && lightness < 0.6F);
  for (const char* name :
       {"lightness, smoothed", "lightness, of the surface", "lightness, of the wider surface"}) {
    QVERIFY(std::abs(features.view().at(0, layer_of({}, name), kWidth - 1) - lightness) < 1e-4F);
  }
  for (const char* name : {"gradient", "Laplacian", "Hessian, larger", "structure, larger"}) {
    QVERIFY(std::abs(features.view().at(7, layer_of({}, name), 5)) < 1e-4F);
  }
}

void PixelFeaturesTest::place_isCarriedAlongTheRay() {
  const Image<float> map = constant_map(kDisparity);
  const LightField lf = light_field(3, 100);

  const PixelFeatures features =
      compute_pixel_features(lf, {0, 2}, {map.view(), {}}, {}, Progress());

  // View (0, 2) is one up and one to the right of the center: x + d, y − d, over the width.
  const int column = layer_of({}, "column in the center view");
  QVERIFY(std::abs(features.view().at(5, column, 10) - (10 + kDisparity) / kWidth) < 1e-5F);
  QVERIFY(std::abs(features.view().at(5, column + 1, 10) - (5 - kDisparity) / kWidth) < 1e-5F);
}

void PixelFeaturesTest::constantDisparity_hasNoSlope() {
  const Image<float> map = constant_map(kDisparity);
  const PixelFeatureSet set{true};

  const PixelFeatures features =
      compute_pixel_features(light_field(3, 9), {1, 1}, {map.view(), {}}, set, Progress());

  const int slope = layer_of(set, "disparity, slope along x");
  QVERIFY(std::abs(features.view().at(4, slope, 6)) < 1e-4F);
  QVERIFY(std::abs(features.view().at(4, slope + 1, 6)) < 1e-4F);
}

void PixelFeaturesTest::inclinedDisparity_hasItsSlopeInEveryRow() {
  Image<float> map = constant_map(0);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      map.at(y, x) = 0.01F * static_cast<float>(x * y) + 0.02F * static_cast<float>(y);
    }
  }
  const PixelFeatureSet set{true};

  const PixelFeatures features =
      compute_pixel_features(light_field(3, 9), {1, 1}, {map.view(), {}}, set, Progress());

  const int slope = layer_of(set, "disparity, slope along x");
  const int y = map.height() / 2, x = map.width() / 2;
  QVERIFY(std::abs(features.view().at(y, slope, x) - 0.01F * static_cast<float>(y)) < 0.01F);
  QVERIFY(features.view().at(y, slope + 1, x) > 0.03F);
}

void PixelFeaturesTest::disparityAsFeature_mustBeThere() {
  QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)compute_pixel_features(light_field(3, 9), {1, 1}, {},
                                                                      {true}, Progress()));
}

void PixelFeaturesTest::holesInDisparity_takeTheirNeighbours() {
  Image<float> map(2, 6);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (int x = 0; x < 6; ++x) map.at(0, x) = nan;
  map.at(0, 1) = 1;
  map.at(0, 4) = 2;
  for (int x = 0; x < 6; ++x) map.at(1, x) = nan;

  const Image<float> filled = filled_disparity({map.view(), {}});

  const float expected[] = {1, 1, 1, 2, 2, 2};
  QVERIFY(std::equal(expected, expected + 6, filled.row(0)));
  QVERIFY(std::equal(expected, expected + 6, filled.row(1)));
}

}  // namespace episcope::in_pixel_features_test

EPISCOPE_TEST(pixel_features_test, PixelFeaturesTest)
#include "pixel_features_test.moc"
