// SPDX-License-Identifier: BSD-3-Clause
#include "engine/render/quantity.h"
#include "tests/test_main.h"

#include <limits>
#include <numeric>

namespace episcope::in_region_statistics_test {

using render::region_statistics;

class RegionStatisticsTest : public QObject {
  Q_OBJECT

 private slots:
  void numbers_areOfTheRegionAlone();
  void invalidPixels_areCountedAndLeftOut();
  void pixelsOutside_doNotCountAtAll();
  void outliers_doNotSqueezeTheAxis();
  void shownRange_liesOnTheAxis();
  void constantMap_hasAnAxisWithLength();
  void nothingValid_givesNoCounts();
  void regionBeyondTheMap_isClipped();
};

namespace {

// Value of pixel (y, x): 10 y + x.
Image<float> numbered(int height, int width) {
  Image<float> map(height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) map.at(y, x) = static_cast<float>(10 * y + x);
  }
  return map;
}

std::size_t total(const render::Histogram& histogram) {
  return std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::size_t{0});
}

}  // namespace

void RegionStatisticsTest::numbers_areOfTheRegionAlone() {
  const Image<float> map = numbered(5, 5);

  const auto found = region_statistics({map, {}, {}}, {1, 2, 4, 5}, {}, 10);

  QCOMPARE(found.count, std::size_t{9});
  QCOMPARE(found.invalid, std::size_t{0});
  QCOMPARE(found.min, 12.0);
  QCOMPARE(found.max, 34.0);
  QCOMPARE(found.median, 23.0);
  QCOMPARE(found.mean, 23.0);
  QCOMPARE(total(found.histogram), std::size_t{9});
}

void RegionStatisticsTest::invalidPixels_areCountedAndLeftOut() {
  Image<float> map = numbered(2, 2);  // 0 1 / 10 11
  map.at(0, 0) = std::numeric_limits<float>::quiet_NaN();
  Image<std::uint8_t> valid(2, 2, 1, 1);
  valid.at(1, 1) = 0;

  const auto found = region_statistics({map, valid, {}}, {0, 0, 2, 2}, {}, 4);

  QCOMPARE(found.count, std::size_t{2});
  QCOMPARE(found.invalid, std::size_t{2});
  QCOMPARE(found.min, 1.0);
  QCOMPARE(found.max, 10.0);
  QCOMPARE(found.mean, 5.5);
}

void RegionStatisticsTest::pixelsOutside_doNotCountAtAll() {
  const Image<float> map = numbered(2, 2);
  Image<std::uint8_t> inside(2, 2, 1, 1);
  inside.at(1, 1) = 0;

  const auto found = region_statistics({map, {}, inside}, {0, 0, 2, 2}, {}, 4);

  QCOMPARE(found.count, std::size_t{3});
  QCOMPARE(found.invalid, std::size_t{0});
  QCOMPARE(found.max, 10.0);
}

void RegionStatisticsTest::outliers_doNotSqueezeTheAxis() {
  Image<float> map(100, 100, 1, 0.5F);
  for (int x = 0; x < 100; ++x) map.at(50, x) = 0.005F * static_cast<float>(x);
  map.at(3, 3) = 1000;

  const auto found = region_statistics({map, {}, {}}, {0, 0, 100, 100}, {}, 50);

  QCOMPARE(found.max, 1000.0);
  QVERIFY(found.histogram.axis.max < 1);
  QVERIFY(found.robust.max < 1);
}

void RegionStatisticsTest::shownRange_liesOnTheAxis() {
  const Image<float> map = numbered(3, 3);

  const auto found = region_statistics({map, {}, {}}, {0, 0, 3, 3}, {-40, 5}, 10);

  QVERIFY(found.histogram.axis.min < -40);
  QVERIFY(found.histogram.axis.max > 22);
}

void RegionStatisticsTest::constantMap_hasAnAxisWithLength() {
  const Image<float> map(3, 3, 1, 2.0F);

  const auto found = region_statistics({map, {}, {}}, {0, 0, 3, 3}, {}, 10);

  QVERIFY(found.histogram.axis.length() > 0);
  QCOMPARE(total(found.histogram), std::size_t{9});
}

void RegionStatisticsTest::nothingValid_givesNoCounts() {
  const Image<float> map(3, 3, 1, std::numeric_limits<float>::quiet_NaN());

  const auto found = region_statistics({map, {}, {}}, {0, 0, 3, 3}, {0, 1}, 10);

  QCOMPARE(found.count, std::size_t{0});
  QCOMPARE(found.invalid, std::size_t{9});
  QVERIFY(found.histogram.counts.empty());
}

void RegionStatisticsTest::regionBeyondTheMap_isClipped() {
  const Image<float> map = numbered(3, 3);

  QCOMPARE(region_statistics({map, {}, {}}, {-5, 1, 99, 99}, {}, 10).count, std::size_t{6});
  QCOMPARE(region_statistics({map, {}, {}}, {7, 7, 9, 9}, {}, 10).count, std::size_t{0});
}

}  // namespace episcope::in_region_statistics_test

EPISCOPE_CORE_TEST(region_statistics_test, RegionStatisticsTest)
#include "region_statistics_test.moc"
