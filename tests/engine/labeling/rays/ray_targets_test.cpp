// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/ray_labeling.h"

#include "tests/test_main.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace episcope::in_ray_targets_test {

namespace {

constexpr int kHeight = 12;
constexpr int kWidth = 21;
constexpr int kRow = 6;

// Two views of a plane of disparity 1.
struct Plane {
  Image<float> from{kHeight, kWidth}, to{kHeight, kWidth};
  Image<std::uint8_t> from_valid{kHeight, kWidth}, to_valid{kHeight, kWidth};

  Plane() {
    std::fill(from.begin(), from.end(), 1.0F);
    std::fill(to.begin(), to.end(), 1.0F);
    std::fill(from_valid.begin(), from_valid.end(), 1);
    std::fill(to_valid.begin(), to_valid.end(), 1);
  }
  [[nodiscard]] std::vector<std::int32_t> targets(ViewIndex step) const {
    std::vector<std::int32_t> found(kWidth);
    find_ray_targets({from.view(), from_valid.view()}, {to.view(), to_valid.view()}, step, kRow,
                     found.data());
    return found;
  }
};

}  // namespace

class RayTargetsTest : public QObject {
  Q_OBJECT

 private slots:
  void rays_moveByTheirDisparityAndEndAtTheBorder() {
    const auto found = Plane().targets({-2, 3});

    for (int x = 0; x < kWidth; ++x) {
      QCOMPARE(found[static_cast<std::size_t>(x)], x < 3 ? -1 : (kRow + 2) * kWidth + x - 3);
    }
  }

  void places_areRoundedToTheNearestPixel() {
    Plane plane;
    plane.from.at(kRow, 10) = 1.2F;
    plane.from.at(kRow, 11) = 0.8F;

    const auto found = plane.targets({0, 2});

    QCOMPARE(found[10], kRow * kWidth + 8);
    QCOMPARE(found[11], kRow * kWidth + 9);
  }

  void hiddenPoints_haveNone() {
    Plane plane;
    plane.to.at(kRow, 9) = 1 + 1.1F * kSamePointTolerance_px;

    const auto found = plane.targets({0, 1});

    QCOMPARE(found[10], -1);
    QCOMPARE(found[11], kRow * kWidth + 10);
  }

  void invalidPixels_haveNone_data() {
    QTest::addColumn<float>("value");
    QTest::newRow("masked") << 1.0F;
    QTest::newRow("no number") << std::numeric_limits<float>::quiet_NaN();
    QTest::newRow("infinite") << std::numeric_limits<float>::infinity();
    QTest::newRow("no int") << -1e30F;
  }
  void invalidPixels_haveNone() {
    QFETCH(float, value);
    Plane plane;
    plane.from.at(kRow, 15) = value;
    plane.to.at(kRow, 9) = value;
    if (value == 1) plane.from_valid.at(kRow, 15) = plane.to_valid.at(kRow, 9) = 0;

    const auto found = plane.targets({0, 1});

    QCOMPARE(found[15], -1);
    QCOMPARE(found[10], -1);
    QCOMPARE(std::ranges::count(found, -1), 3);  // And the first, which leaves the image.
  }
};

}  // namespace episcope::in_ray_targets_test

EPISCOPE_TEST(ray_targets_test, RayTargetsTest)
#include "ray_targets_test.moc"
