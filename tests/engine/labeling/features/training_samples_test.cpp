// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/pixel_features.h"

#include "tests/test_main.h"

#include <string>
#include <vector>

namespace episcope::in_training_samples_test {

namespace {

constexpr int kHeight = 4;
constexpr int kWidth = 5;

// Strokes of labels 7 and 9; every feature of a pixel is its column.
ForestSamples samples_with(PixelFeatureSet set) {
  PixelFeatures features(kHeight, static_cast<int>(pixel_feature_names(set).size()), kWidth);
  for (int y = 0; y < kHeight; ++y) {
    for (int f = 0; f < features.layers(); ++f) {
      for (int x = 0; x < kWidth; ++x) features.view().row(y, f)[x] = static_cast<float>(x);
    }
  }
  ViewScribbles painted{{0, 0}, Image<std::int32_t>(kHeight, kWidth)};
  painted.labels.at(1, 2) = 9;
  painted.labels.at(3, 4) = 7;
  ForestSamples samples;
  samples.feature_count = features.layers();
  append_samples(painted, features.view(), {7, 9}, samples);
  return samples;
}

std::vector<std::string> names_of_occasional(PixelFeatureSet set) {
  const std::vector<std::string> names = pixel_feature_names(set);
  std::vector<std::string> found;
  for (const int feature : samples_with(set).occasional) {
    found.push_back(names.at(static_cast<std::size_t>(feature)));
  }
  return found;
}

}  // namespace

class TrainingSamplesTest : public QObject {
  Q_OBJECT

 private slots:
  void paintedPixels_areSamplesOfTheirLabels() {
    const ForestSamples samples = samples_with({});

    QCOMPARE(samples.labels, (std::vector<std::int32_t>{1, 0}));
    QCOMPARE(samples.features.front(), 2.0F);
    QCOMPARE(samples.features.back(), 4.0F);
  }

  void withoutDisparity_placeIsOccasional() {
    QCOMPARE(names_of_occasional({}),
             (std::vector<std::string>{"column in the center view", "row in the center view"}));
  }

  // Strokes lie in the middle of things: that a jump is near says little about what is beside it.
  void withDisparity_slopeIsOccasionalAsWell() {
    QCOMPARE(names_of_occasional({true}),
             (std::vector<std::string>{"column in the center view", "row in the center view",
                                       "disparity, slope along x", "disparity, slope along y"}));
  }
};

}  // namespace episcope::in_training_samples_test

EPISCOPE_TEST(training_samples_test, TrainingSamplesTest)
#include "training_samples_test.moc"
