// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/brush.h"
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

// Central differences, one-sided at the border.
double gradient_at(const Image<float>& picture, int y, int x) {
  const int left = std::max(x - 1, 0), right = std::min(x + 1, picture.width() - 1);
  const int up = std::max(y - 1, 0), down = std::min(y + 1, picture.height() - 1);
  double sum = 0;
  for (int c = 0; c < picture.channels(); ++c) {
    const double dx = picture.at(y, right, c) - picture.at(y, left, c);
    const double dy = picture.at(down, x, c) - picture.at(up, x, c);
    sum += std::pow(dx / std::max(right - left, 1), 2) + std::pow(dy / std::max(down - up, 1), 2);
  }
  return std::sqrt(sum);
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

  void fill_stopsAtEdges() {
    Image<float> picture(20, 30, 3, 0.2F);
    for (int y = 0; y < 20; ++y) {
      for (int x = 15; x < 30; ++x) picture.at(y, x, 1) = 0.5F;  // in one channel only
    }

    const auto filled = drawn(region_within_edges(picture.view(), {10, 5}, 0.1), 20, 30);

    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 30; ++x) QCOMPARE(int{filled.at(y, x)}, x < 14 ? 1 : 0);
    }
    QVERIFY(region_within_edges(picture.view(), {10, 15}, 0.1).empty());
  }

  void fill_isWhatSpreadingReachesBetweenEdges_data() {
    QTest::addColumn<int>("height");
    QTest::addColumn<int>("width");
    QTest::addColumn<int>("channels");
    QTest::newRow("rgb") << 23 << 31 << 3;
    QTest::newRow("grey") << 17 << 40 << 1;
    QTest::newRow("a column") << 30 << 1 << 3;
    QTest::newRow("a row") << 1 << 30 << 3;
    QTest::newRow("two columns") << 30 << 2 << 1;
  }

  void fill_isWhatSpreadingReachesBetweenEdges() {
    QFETCH(int, height);
    QFETCH(int, width);
    QFETCH(int, channels);
    std::mt19937 random(4);
    std::uniform_real_distribution<float> uniform;
    for (int i = 0; i < 20; ++i) {
      Image<float> picture(height, width, channels);
      for (float& value : picture) value = uniform(random);
      constexpr double kLimit = 0.55;  // about half of the pixels
      Image<std::int32_t> map(height, width);
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) map.at(y, x) = gradient_at(picture, y, x) < kLimit ? 1 : 2;
      }
      const auto open = std::find(map.begin(), map.end(), 1) - map.begin();
      const PixelIndex seed{static_cast<int>(open) / width, static_cast<int>(open) % width};

      const auto filled = drawn(region_within_edges(picture.view(), seed, kLimit), height, width);

      const auto expected = spread(map, seed);
      QVERIFY(std::equal(filled.begin(), filled.end(), expected.begin()));
    }
  }

  void fill_isHeldByALineOfOnePixel() {
    Image<float> picture(20, 30, 1, 0.2F);
    for (int y = 0; y < 20; ++y) picture.at(y, 15) = 0.9F;

    const auto filled = drawn(region_within_edges(picture.view(), {10, 5}, 0.1), 20, 30);

    QCOMPARE(int{filled.at(10, 13)}, 1);
    QCOMPARE(int{filled.at(10, 25)}, 0);
  }

  void fill_crossesSlowChanges() {
    Image<float> picture(4, 100);
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 100; ++x) picture.at(y, x) = 0.009F * static_cast<float>(x);
    }

    QCOMPARE(region_within_edges(picture.view(), {0, 0}, 0.01).size(), std::size_t{4});
    QVERIFY(region_within_edges(picture.view(), {0, 0}, 0.008).empty());
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)region_within_edges(picture.view(), {0, 0}, -1));
  }

  void seedsOutside_fillNothing() {
    const Image<float> picture(4, 5);
    const Image<std::int32_t> map(4, 5);

    QVERIFY(region_within_edges(picture.view(), {4, 0}, 1).empty());
    QVERIFY(region_of_segment(map.view(), {0, -1}).empty());
  }
};

}  // namespace episcope::in_flood_fill_test

EPISCOPE_TEST(flood_fill_test, FloodFillTest)
#include "flood_fill_test.moc"
