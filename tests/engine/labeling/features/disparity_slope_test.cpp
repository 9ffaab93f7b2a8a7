// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/pixel_features.h"

#include "tests/test_main.h"

#include <cmath>

namespace episcope::in_disparity_slope_test {

constexpr int kJump = 12;  ///< First column of the other surface.

/// Two inclined planes side by side, far apart in depth.
Image<float> two_planes() {
  Image<float> map(16, 24);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const auto column = static_cast<float>(x), row = static_cast<float>(y);
      map.at(y, x) = x < kJump ? 0.02F * column - 0.01F * row : 5 - 0.03F * column + 0.04F * row;
    }
  }
  return map;
}

class DisparitySlopeTest : public QObject {
  Q_OBJECT

 private slots:
  void besideAJump_theOwnSurfaceCounts() {
    const Image<float> map = two_planes();

    const DisparitySlopes slopes = disparity_slopes(map.view());

    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        const bool is_left = x < kJump;
        QVERIFY(std::abs(slopes.x.at(y, x) - (is_left ? 0.02F : -0.03F)) < 1e-5F);
        QVERIFY(std::abs(slopes.y.at(y, x) - (is_left ? -0.01F : 0.04F)) < 1e-5F);
      }
    }
  }

  void narrowThings_haveTheSlopeOfTheJump() {
    Image<float> map(16, 16);
    for (int y = 0; y < map.height(); ++y) map.at(y, 8) = 6;

    QCOMPARE(std::abs(disparity_slopes(map.view()).x.at(4, 8)), 1.0F);
  }

  void smallMaps_areFlat() {
    Image<float> map(2, 3);
    map.at(1, 2) = 9;

    const DisparitySlopes slopes = disparity_slopes(map.view());

    QCOMPARE(slopes.x.at(1, 2), 0.0F);
    QCOMPARE(slopes.y.at(1, 2), 0.0F);
  }
};

}  // namespace episcope::in_disparity_slope_test

EPISCOPE_TEST(disparity_slope_test, DisparitySlopeTest)
#include "disparity_slope_test.moc"
