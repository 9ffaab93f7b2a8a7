// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/brush.h"
#include "annotation/likeness.h"
#include "engine/core/error.h"
#include "tests/annotation/drawn_region.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace episcope::in_flood_fill_test {

using episcope::test::drawn;

namespace {

// The simplest flood fill: spreads from pixel to pixel until nothing changes.
Image<std::uint8_t> spread(const Image<std::int32_t>& map, PixelIndex seed) {
  Image<std::uint8_t> reached(map.height(), map.width());
  reached.at(seed.y, seed.x) = 1;
  for (bool is_growing = true; is_growing;) {
    is_growing = false;
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        if (reached.at(y, x) != 0 || map.at(y, x) != map.at(seed.y, seed.x)) continue;
        const bool touches = (y > 0 && reached.at(y - 1, x) != 0) ||
                             (y + 1 < map.height() && reached.at(y + 1, x) != 0) ||
                             (x > 0 && reached.at(y, x - 1) != 0) ||
                             (x + 1 < map.width() && reached.at(y, x + 1) != 0);
        if (!touches) continue;
        reached.at(y, x) = 1;
        is_growing = true;
      }
    }
  }
  return reached;
}

}  // namespace

class FloodFillTest : public QObject {
  Q_OBJECT

 private slots:
  void segment_isWhatSpreadingReaches() {
    std::mt19937 random(2);
    for (int i = 0; i < 40; ++i) {
      Image<std::int32_t> map(23, 31);
      // Two labels near the percolation threshold: long, winding segments.
      for (std::int32_t& label : map) label = random() % 100 < 59 ? 1 : 2;
      const PixelIndex seed{static_cast<int>(random() % 23), static_cast<int>(random() % 31)};

      const auto filled = drawn(region_of_segment(map.view(), seed), 23, 31);

      const auto expected = spread(map, seed);
      QVERIFY(std::equal(filled.begin(), filled.end(), expected.begin()));
    }
  }

  void fill_isOfLikeColors() {
    Image<float> picture(20, 30, 3, 0.2F);
    for (int y = 0; y < 20; ++y) {
      for (int x = 15; x < 30; ++x) picture.at(y, x, 1) = 0.5F;  // in one channel only
    }
    const Likeness likeness(picture.view(), {});

    const auto filled = drawn(likeness.region({10, 5}, 10), 20, 30);

    for (int y = 0; y < 20; ++y) {
      // The edge is two pixels wide after smoothing.
      for (int x = 0; x < 30; ++x) QCOMPARE(int{filled.at(y, x)}, x < 14 ? 1 : 0);
    }
    QVERIFY(!likeness.region({10, 15}, 10).empty());
    QCOMPARE(drawn(likeness.region({10, 5}, 100), 20, 30).at(10, 29), 1);
  }

  // A fill that suits a dark picture also suits it brightened, with its noise.
  void tolerance_isInUnitsOfTheNoise() {
    std::mt19937 random(5);
    std::normal_distribution<float> noise(0, 0.02F);
    Image<float> dark(60, 60), bright(60, 60);
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 60; ++x) {
        dark.at(y, x) = (x < 30 ? 0.1F : 0.25F) + noise(random);
        bright.at(y, x) = 3 * dark.at(y, x);
      }
    }
    const Likeness of_dark(dark.view(), {}), of_bright(bright.view(), {});

    const auto filled = drawn(of_dark.region({30, 10}, 8), 60, 60);
    const auto brightened = drawn(of_bright.region({30, 10}, 8), 60, 60);

    QVERIFY(std::fabs(of_bright.noise() / of_dark.noise() - 3) < 1e-3);
    QVERIFY(std::equal(filled.begin(), filled.end(), brightened.begin()));
    const auto left = std::count(filled.begin(), filled.end(), 1);
    QVERIFY2(left > 25 * 60 && left < 32 * 60, qPrintable(QString::number(left)));
  }

  void fill_isHeldByAJumpOfDisparity() {
    const Image<float> picture(20, 30, 1, 0.5F);
    Image<float> disparity(20, 30);
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 30; ++x) disparity.at(y, x) = 0.1F * static_cast<float>(x);
      for (int x = 18; x < 30; ++x) disparity.at(y, x) += 1;
    }

    const auto filled =
        drawn(Likeness(picture.view(), {disparity.view(), {}}).region({10, 5}, 10), 20, 30);

    QCOMPARE(int{filled.at(10, 17)}, 1);
    QCOMPARE(int{filled.at(10, 19)}, 0);
  }

  void negativeTolerance_isRefused() {
    const Image<float> picture(4, 5);
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)Likeness(picture.view(), {}).region({0, 0}, -1));
  }

  void seedsOutside_fillNothing() {
    const Image<float> picture(4, 5);
    const Image<std::int32_t> map(4, 5);

    QVERIFY(Likeness(picture.view(), {}).region({4, 0}, 1).empty());
    QVERIFY(region_of_segment(map.view(), {0, -1}).empty());
  }
};

}  // namespace episcope::in_flood_fill_test

EPISCOPE_TEST(flood_fill_test, FloodFillTest)
#include "flood_fill_test.moc"
