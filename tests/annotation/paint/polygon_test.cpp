// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/brush.h"

#include "engine/core/error.h"
#include "tests/annotation/drawn_region.h"
#include "tests/test_main.h"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace episcope::in_polygon_test {

using episcope::test::drawn;

namespace {

constexpr int kHeight = 30;
constexpr int kWidth = 40;

// How often a polygon goes around a point: the angles under which its edges are seen.
int winding_of(const std::vector<StrokePoint>& corners, double y, double x) {
  double turned = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const StrokePoint& a = corners[i];
    const StrokePoint& b = corners[(i + 1) % corners.size()];
    const double cross = (a.x - x) * (b.y - y) - (a.y - y) * (b.x - x);
    const double dot = (a.x - x) * (b.x - x) + (a.y - y) * (b.y - y);
    turned += std::atan2(cross, dot);
  }
  return static_cast<int>(std::lround(turned / (2 * std::acos(-1.0))));
}

}  // namespace

class PolygonTest : public QObject {
  Q_OBJECT

 private slots:
  void pixels_areThoseItGoesAround() {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-10, 50);
    for (int round = 0; round < 200; ++round) {
      std::vector<StrokePoint> corners(3 + round % 7);
      for (StrokePoint& each : corners) each = {place(random), place(random)};

      const auto picture = drawn(pixels_in_polygon(corners, kHeight, kWidth), kHeight, kWidth);

      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          const int expected = winding_of(corners, y + 0.5, x + 0.5) != 0 ? 1 : 0;
          QCOMPARE(static_cast<int>(picture.at(y, x)), expected);
        }
      }
    }
  }

  void neighbours_shareNoPixelAndLeaveNone() {
    const std::vector<StrokePoint> left{{0, 0}, {0, 13.37}, {30, 21.5}, {30, 0}};
    const std::vector<StrokePoint> right{{0, 13.37}, {0, 40}, {30, 40}, {30, 21.5}};

    PixelRegion both = pixels_in_polygon(left, kHeight, kWidth);
    const PixelRegion other = pixels_in_polygon(right, kHeight, kWidth);
    both.insert(both.end(), other.begin(), other.end());

    const auto picture = drawn(both, kHeight, kWidth);
    QVERIFY(std::all_of(picture.begin(), picture.end(), [](auto times) { return times == 1; }));
  }

  void fewCorners_encloseNothing() {
    const std::vector<StrokePoint> line{{3, 3}, {20, 20}};
    QVERIFY(pixels_in_polygon(line, kHeight, kWidth).empty());
    QVERIFY(pixels_in_polygon({}, kHeight, kWidth).empty());
  }

  void cornerThatIsNoNumber_isRefused() {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<StrokePoint> corners{{3, 3}, {20, nan}, {20, 3}};
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)pixels_in_polygon(corners, kHeight, kWidth));
  }
};

}  // namespace episcope::in_polygon_test

EPISCOPE_TEST(polygon_test, PolygonTest)
#include "polygon_test.moc"
