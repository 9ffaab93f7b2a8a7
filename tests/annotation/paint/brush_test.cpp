// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/brush.h"
#include "engine/core/error.h"
#include "engine/core/image.h"
#include "tests/annotation/drawn_region.h"
#include "tests/test_main.h"

#include <cmath>
#include <limits>
#include <random>

namespace episcope::in_brush_test {

using episcope::test::drawn;

namespace {

// The definition, pixel by pixel: distance of its middle from the segment by golden-section search
// would be slow, so the nearest point comes from the projection.
bool is_covered(const BrushPath& path, int y, int x) {
  for (const StrokePoint& end : {path.from, path.to}) {
    if (std::floor(end.y) == y && std::floor(end.x) == x) return true;
  }
  const double dy = path.to.y - path.from.y;
  const double dx = path.to.x - path.from.x;
  const double py = y + 0.5 - path.from.y;
  const double px = x + 0.5 - path.from.x;
  const double length2 = dy * dy + dx * dx;
  const double along = length2 > 0 ? std::clamp((py * dy + px * dx) / length2, 0.0, 1.0) : 0;
  const double ey = py - along * dy;
  const double ex = px - along * dx;
  return ey * ey + ex * ex <= path.diameter_px * path.diameter_px / 4;
}

QByteArray text_of(const BrushPath& path) {
  return QString("(%1, %2) → (%3, %4), %5 px")
      .arg(path.from.y, 0, 'g', 17)
      .arg(path.from.x, 0, 'g', 17)
      .arg(path.to.y, 0, 'g', 17)
      .arg(path.to.x, 0, 'g', 17)
      .arg(path.diameter_px, 0, 'g', 17)
      .toUtf8();
}

void compare(const BrushPath& path, int height, int width) {
  const auto picture = drawn(covered_pixels(path, height, width), height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (picture.at(y, x) != (is_covered(path, y, x) ? 1 : 0)) {
        const QByteArray at = " at (" + QByteArray::number(y) + ", " + QByteArray::number(x) + ")";
        QFAIL((text_of(path) + at).constData());
      }
    }
  }
}

}  // namespace

class BrushTest : public QObject {
  Q_OBJECT

 private slots:
  void brush_coversWhatTheDefinitionSays_data() {
    QTest::addColumn<bool>("is_on_halves");
    QTest::newRow("anywhere") << false;
    QTest::newRow("on middles and corners, where ties occur") << true;
  }
  void brush_coversWhatTheDefinitionSays() {
    QFETCH(bool, is_on_halves);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-15, 55);
    std::uniform_real_distribution<double> size(0, 1);
    const auto coordinate = [&] {
      return is_on_halves ? std::round(2 * place(random)) / 2 : place(random);
    };

    for (int i = 0; i < 1500; ++i) {
      BrushPath path{{coordinate(), coordinate()}, {coordinate(), coordinate()}, 1};
      if (i % 5 == 0) path.to = path.from;
      if (i % 5 == 1) path.to.y = path.from.y;
      if (i % 5 == 2) path.to.x = path.from.x;
      path.diameter_px = 1 + 99 * std::pow(size(random), 3);
      if (is_on_halves) path.diameter_px = std::round(path.diameter_px);
      compare(path, 37, 41);
      if (QTest::currentTestFailed()) return;
    }
  }

  void thinnestBrush_leavesAMarkAtACornerOfPixels() {
    const auto region = covered_pixels({{4, 6}, {4, 6}, 1}, 10, 10);

    QCOMPARE(region, (PixelRegion{{4, 6, 7}}));
  }

  void thinnestBrush_drawsWithoutGaps() {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(0, 60);
    for (int i = 0; i < 300; ++i) {
      const BrushPath path{{place(random), place(random)}, {place(random), place(random)}, 1};

      const PixelRegion region = covered_pixels(path, 60, 60);

      for (std::size_t row = 1; row < region.size(); ++row) {
        const PixelSpan& a = region[row - 1];
        const PixelSpan& b = region[row];
        QVERIFY2(b.y == a.y + 1 && b.x0 <= a.x1 && a.x0 <= b.x1, text_of(path));
      }
    }
  }

  void pathsEndToEnd_coverWhatTheWholeCovers() {
    const StrokePoint a{3.25, 4.5};
    const StrokePoint b{30.75, 50.25};
    const StrokePoint middle{(a.y + b.y) / 2, (a.x + b.x) / 2};

    auto halves = covered_pixels({a, middle, 9}, 60, 60);
    const auto rest = covered_pixels({middle, b, 9}, 60, 60);
    halves.insert(halves.end(), rest.begin(), rest.end());
    const auto pieces = drawn(halves, 60, 60);
    const auto whole = drawn(covered_pixels({a, b, 9}, 60, 60), 60, 60);

    for (int i = 0; i < 3600; ++i) QCOMPARE(pieces.data()[i] > 0, whole.data()[i] > 0);
  }

  void mirroredAndTransposedPaths_coverMirroredAndTransposedPixels() {
    const BrushPath path{{5.3, 7.1}, {20.9, 33.4}, 6.5};
    const auto picture = drawn(covered_pixels(path, 40, 40), 40, 40);

    const auto transposed = drawn(
        covered_pixels({{path.from.x, path.from.y}, {path.to.x, path.to.y}, 6.5}, 40, 40), 40, 40);
    const auto reversed = drawn(covered_pixels({path.to, path.from, 6.5}, 40, 40), 40, 40);

    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 40; ++x) {
        QCOMPARE(transposed.at(x, y), picture.at(y, x));
        QCOMPARE(reversed.at(y, x), picture.at(y, x));
      }
    }
  }

  void pathsFarOutside_coverNothing() {
    QVERIFY(covered_pixels({{-1e9, 3}, {-1e8, 5}, 100}, 20, 20).empty());
    QVERIFY(covered_pixels({{3, 1e12}, {5, 1e300}, 1}, 20, 20).empty());
    QCOMPARE(covered_pixels({{10.5, -1e9}, {10.5, 1e9}, 1}, 20, 20), (PixelRegion{{10, 0, 20}}));
  }

  void badPaths_areRefused() {
    const double nan = std::numeric_limits<double>::quiet_NaN();

    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)covered_pixels({{1, 1}, {1, 1}, 0.5}, 20, 20));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)covered_pixels({{1, 1}, {1, 1}, 101}, 20, 20));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)covered_pixels({{1, 1}, {1, 1}, nan}, 20, 20));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)covered_pixels({{1, nan}, {1, 1}, 5}, 20, 20));
  }
};

}  // namespace episcope::in_brush_test

EPISCOPE_TEST(brush_test, BrushTest)
#include "brush_test.moc"
