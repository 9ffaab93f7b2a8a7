// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/render/shade.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace episcope::in_color_map_test {

using namespace episcope::render;

class ColorMapTest : public QObject {
  Q_OBJECT
 private slots:
  // Values of matplotlib at 256 entries; blue-orange is ours.
  void colors_areThoseOfMatplotlib_data() {
    QTest::addColumn<QString>("map");
    QTest::addColumn<int>("index");
    QTest::addColumn<int>("red");
    QTest::addColumn<int>("green");
    QTest::addColumn<int>("blue");
    const auto row = [](const char* map, int index, int red, int green, int blue) {
      QTest::addRow("%s %d", map, index) << map << index << red << green << blue;
    };
    row("viridis", 0, 68, 1, 84);
    row("viridis", 64, 59, 82, 139);
    row("viridis", 128, 33, 145, 140);
    row("viridis", 192, 94, 201, 98);
    row("viridis", 255, 253, 231, 37);
    row("magma", 0, 0, 0, 4);
    row("magma", 64, 81, 18, 124);
    row("magma", 128, 183, 55, 121);
    row("magma", 192, 252, 137, 97);
    row("magma", 255, 252, 253, 191);
    row("seismic", 0, 0, 0, 76);
    row("seismic", 64, 0, 0, 255);
    row("seismic", 128, 255, 255, 255);
    row("seismic", 255, 127, 0, 0);
    row("ylorrd", 0, 255, 255, 204);
    row("ylorrd", 255, 128, 0, 38);
    row("rdylgn_r", 0, 0, 104, 55);
    row("rdylgn_r", 255, 165, 0, 38);
    row("turbo", 0, 48, 18, 59);
    row("turbo", 128, 164, 252, 60);
    row("turbo", 255, 122, 4, 3);
    row("grey", 100, 100, 100, 100);
  }
  void colors_areThoseOfMatplotlib() {
    QFETCH(QString, map);
    QFETCH(int, index);
    QFETCH(int, red);
    QFETCH(int, green);
    QFETCH(int, blue);

    const Rgb color = color_map(map.toStdString()).colors[index];

    // Three levels of 255 for the interpolation between stored colors; seismic's middle lies
    // between two of its 256 entries and is up to four off.
    QVERIFY(std::abs(color[0] - red) <= 4);
    QVERIFY(std::abs(color[1] - green) <= 4);
    QVERIFY(std::abs(color[2] - blue) <= 4);
  }

  void sequentialMaps_growBrighterSteadily() {
    for (const char* name : {"viridis", "magma", "grey"}) {
      const auto map = color_map(name);
      double last = -1;
      for (const Rgb& color : map.colors) {
        const double luma = 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2];
        QVERIFY2(luma >= last - 0.5, name);
        last = luma;
      }
    }
  }

  void invalidColor_isNoneOfTheMap() {
    for (const auto& name : color_map_names()) {
      const auto map = color_map(name);
      for (const Rgb& color : map.colors) {
        int distance = 0;
        for (int c = 0; c < 3; ++c) distance += std::abs(color[c] - map.invalid[c]);
        QVERIFY2(distance > 40, name.c_str());
      }
    }
  }

  void value_isClampedToItsRange() {
    const auto map = color_map("viridis");
    QCOMPARE(map.color(-5, 0, 1), map.colors.front());
    QCOMPARE(map.color(7, 0, 1), map.colors.back());
    QCOMPARE(map.color(0.5, 0, 1), map.colors[128]);
    QCOMPARE(map.color(std::numeric_limits<double>::infinity(), 0, 1), map.colors.back());
    QCOMPARE(map.color(std::nan(""), 0, 1), map.invalid);
    QCOMPARE(map.color(2, 3, 3), map.colors.front());
    QCOMPARE(map.color(3, 3, 3), map.colors.back());
  }

  void unknownName_namesTheNearest() {
    try {
      (void)color_map("viridsi");
      QFAIL("no exception");
    } catch (const InvalidInput& error) {
      QVERIFY(std::string(error.what()).find("'viridis'") != std::string::npos);
    }
  }
};

}  // namespace episcope::in_color_map_test

EPISCOPE_TEST(color_map_test, ColorMapTest)
#include "color_map_test.moc"
