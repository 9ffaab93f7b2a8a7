// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/denoise.h"

#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace episcope::in_islands_test {

/// Flat, farther on the left than on the right.
Image<float> step_map() {
  Image<float> map(8, 12);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) map.at(y, x) = x < 6 ? -1.0F : 1.0F;
  }
  return map;
}

struct Place {
  int y = 0, x = 0;
};

Image<float> with(const std::vector<Place>& places, float value) {
  Image<float> map = step_map();
  for (const Place& place : places) map.at(place.y, place.x) = value;
  return map;
}

bool is_equal(const Image<float>& a, const Image<float>& b) {
  return std::equal(a.begin(), a.end(), b.begin());
}

class IslandsTest : public QObject {
  Q_OBJECT

 private slots:
  void oneOrTwoPixels_takeTheMedianAround_data() {
    QTest::addColumn<int>("kind");
    QTest::addColumn<float>("value");
    QTest::newRow("one, nearer") << 0 << 3.0F;
    QTest::newRow("one, farther") << 0 << -4.0F;
    QTest::newRow("two, side by side") << 1 << 3.0F;
    QTest::newRow("two, diagonally") << 2 << 3.0F;
    QTest::newRow("in a corner") << 3 << 3.0F;
    QTest::newRow("beside the step") << 4 << 3.0F;
  }
  void oneOrTwoPixels_takeTheMedianAround() {
    QFETCH(int, kind);
    QFETCH(float, value);
    const std::vector<Place> places[] = {
        {{3, 2}}, {{3, 2}, {3, 3}}, {{3, 2}, {4, 3}}, {{0, 0}}, {{3, 4}}};
    Image<float> map = with(places[kind], value);

    fill_islands(Progress(), map.view());

    QVERIFY(is_equal(map, step_map()));
  }

  void threePixels_areASurface() {
    const Image<float> before = with({{3, 2}, {3, 3}, {3, 4}}, 3);
    Image<float> map = before;

    fill_islands(Progress(), map.view());

    QVERIFY(is_equal(map, before));
  }

  void blurOfASilhouette_stays() {
    const Image<float> before = with({{3, 5}}, 0.2F);
    Image<float> map = before;

    fill_islands(Progress(), map.view());

    QVERIFY(is_equal(map, before));
  }

  void notFinite_neitherCountsNorChanges() {
    Image<float> map = with({{3, 2}}, 3);
    map.at(3, 3) = std::numeric_limits<float>::quiet_NaN();

    fill_islands(Progress(), map.view());

    QCOMPARE(map.at(3, 2), -1.0F);
    QVERIFY(std::isnan(map.at(3, 3)));
  }

  void smallMaps_areLeft() {
    Image<float> map(1, 2);
    map.at(0, 1) = 9;

    fill_islands(Progress(), map.view());

    QCOMPARE(map.at(0, 1), 9.0F);
    QCOMPARE(map.at(0, 0), 0.0F);
  }
};

}  // namespace episcope::in_islands_test

EPISCOPE_TEST(islands_test, IslandsTest)
#include "islands_test.moc"
