// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/reweight_by_color.h"

#include "tests/test_main.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace episcope::in_local_colors_test {

namespace {

constexpr int kHeight = 32, kWidth = 256, kMiddle = kWidth / 2;
constexpr std::array<float, 3> kDark{0.2F, 0, 0}, kLight{0.8F, 0, 0};

// Label 0 is dark on the left, label 1 light on the right; label 2 is nowhere.
LocalColors halves() {
  Image<float> colors(kHeight, kWidth, 3);
  Image<std::int32_t> labels(kHeight, kWidth);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      labels.at(y, x) = x < kMiddle ? 0 : 1;
      colors.at(y, x) = x < kMiddle ? kDark[0] : kLight[0];
    }
  }
  return {colors, labels, 3};
}

std::vector<float> weighed(std::array<float, 3> color, float y, float x,
                           std::vector<float> probabilities) {
  halves().weigh(color, y, x, probabilities);
  return probabilities;
}

}  // namespace

class LocalColorsTest : public QObject {
  Q_OBJECT

 private slots:
  void ofLabelsNearby_theOneOfTheSameColorGains() {
    const std::vector<float> dark = weighed(kDark, 16, kMiddle, {0.3F, 0.6F, 0.1F});
    const std::vector<float> light = weighed(kLight, 16, kMiddle - 1, {0.6F, 0.3F, 0.1F});

    QVERIFY(dark[0] > 0.6F && dark[0] + dark[1] + dark[2] > 0.999F);
    QVERIFY(light[1] > 0.6F);
  }

  void labelsOfOtherColors_keepTheLeastShare() {
    const std::vector<float> p = weighed(kDark, 16, kMiddle, {0.49F, 0.49F, 0});

    QVERIFY(std::abs(p[1] - LocalColors::kLeastShare * p[0]) < 1e-6F);
  }

  void labelsThatAreNotNearby_keepMost() {
    const std::vector<float> p = weighed(kDark, 16, 2, {0.49F, 0.49F, 0});

    QVERIFY(std::abs(p[1] - LocalColors::kShareElsewhere * p[0]) < 1e-6F);
    QVERIFY(std::abs(p[2] - p[1] / 50) < 1e-6F);
  }

  void farFromBothColors_littleChanges() {
    const std::vector<float> p = weighed({0.5F, 0.9F, 0}, 16, kMiddle, {0.5F, 0.5F, 0});

    QVERIFY(std::abs(p[0] - p[1]) < 0.02F);
  }

  void placesOutside_countAsThoseAtTheBorder() {
    const std::vector<float> even{0.4F, 0.4F, 0.2F};

    QCOMPARE(weighed(kDark, -50, -3, even), weighed(kDark, 0, 0, even));
    QCOMPARE(weighed(kDark, 1e9F, 1e9F, even), weighed(kDark, kHeight - 1, kWidth - 1, even));
  }
};

}  // namespace episcope::in_local_colors_test

EPISCOPE_TEST(local_colors_test, LocalColorsTest)
#include "local_colors_test.moc"
