// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/core/light_field.h"
#include "tests/test_main.h"

#include <cmath>

namespace episcope::in_epi_test {

namespace {

constexpr int kHeight = 40;
constexpr int kWidth = 64;
constexpr GridShape kGrid{5, 7};

// A smooth texture on one plane of disparity `d`, as every view sees it.
LightField plane_of(double d) {
  ViewStack<float> stack(kGrid, kHeight, kWidth, 3);
  const ViewIndex center = kGrid.center();
  for (int v = 0; v < kGrid.v; ++v) {
    for (int u = 0; u < kGrid.u; ++u) {
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          const double at_x = x + d * (u - center.u);
          const double at_y = y + d * (v - center.v);
          for (int c = 0; c < 3; ++c) {
            stack.view({v, u}).at(y, x, c) = static_cast<float>(
                0.5 + 0.2 * std::sin(0.3 * at_x + c) + 0.2 * std::cos(0.2 * at_y));
          }
        }
      }
    }
  }
  return LightField(std::move(stack), {});
}

float value_at(const LightField& lf, ViewIndex view, int y, int x, int c) {
  return lf.view<float>(view).at(y, x, c);
}

}  // namespace

class EpiTest : public QObject {
  Q_OBJECT

 private slots:
  void horizontalEpi_stacksTheRowOfEveryColumn() {
    const LightField lf = plane_of(0.6);

    const Image<float> epi = horizontal_epi(lf, {1, 4}, 17);

    QCOMPARE(epi.height(), kGrid.u);
    QCOMPARE(epi.width(), kWidth);
    QCOMPARE(epi.channels(), 3);
    for (int u = 0; u < kGrid.u; ++u) {
      for (int x = 0; x < kWidth; ++x) {
        for (int c = 0; c < 3; ++c) QCOMPARE(epi.at(u, x, c), value_at(lf, {1, u}, 17, x, c));
      }
    }
  }

  void verticalEpi_stacksTheColumnOfEveryRow() {
    const LightField lf = plane_of(0.6);

    const Image<float> epi = vertical_epi(lf, {1, 4}, 30);

    QCOMPARE(epi.height(), kGrid.v);
    QCOMPARE(epi.width(), kHeight);
    for (int v = 0; v < kGrid.v; ++v) {
      for (int y = 0; y < kHeight; ++y) {
        for (int c = 0; c < 3; ++c) QCOMPARE(epi.at(v, y, c), value_at(lf, {v, 4}, y, 30, c));
      }
    }
  }

  void focus_putsItsDisparityUpright_data() {
    QTest::addColumn<double>("disparity");
    QTest::newRow("zero") << 0.0;
    QTest::newRow("near") << 1.0;
    QTest::newRow("far, between pixels") << -0.75;
  }
  void focus_putsItsDisparityUpright() {
    QFETCH(double, disparity);
    const LightField lf = plane_of(disparity);

    const Image<float> across = horizontal_epi(lf, {2, 3}, 20, disparity);
    const Image<float> down = vertical_epi(lf, {2, 3}, 20, disparity);

    // Away from the border, where samples are clamped; linear interpolation of a wave of 21 px is
    // good to 0.2·0.3²/8.
    for (int x = 4; x < kWidth - 4; ++x) {
      for (int u = 0; u < kGrid.u; ++u) {
        QVERIFY(std::abs(across.at(u, x) - across.at(3, x)) < 0.0025F);
      }
    }
    for (int y = 4; y < kHeight - 4; ++y) {
      for (int v = 0; v < kGrid.v; ++v) {
        QVERIFY(std::abs(down.at(v, y) - down.at(2, y)) < 0.0025F);
      }
    }
  }

  void wholeFocus_isExact() {
    const LightField lf = plane_of(0);

    const Image<float> epi = horizontal_epi(lf, {2, 3}, 20, 2);

    for (int u = 0; u < kGrid.u; ++u) {
      for (int x = 8; x < kWidth - 8; ++x) {
        QCOMPARE(epi.at(u, x, 1), value_at(lf, {2, u}, 20, x - 2 * (u - 3), 1));
      }
    }
  }

  void ownRow_isNeverSheared() {
    const LightField lf = plane_of(0.4);

    const Image<float> epi = horizontal_epi(lf, {2, 1}, 20, 1.3);

    for (int x = 0; x < kWidth; ++x) QCOMPARE(epi.at(1, x), value_at(lf, {2, 1}, 20, x, 0));
  }

  void outside_isRefused() {
    const LightField lf = plane_of(0);

    QVERIFY_THROWS_EXCEPTION(InvalidInput, static_cast<void>(horizontal_epi(lf, {2, 3}, kHeight)));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, static_cast<void>(horizontal_epi(lf, {5, 3}, 0)));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, static_cast<void>(vertical_epi(lf, {2, 3}, -1)));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, static_cast<void>(vertical_epi(lf, {2, 7}, 0)));
  }
};

}  // namespace episcope::in_epi_test

EPISCOPE_TEST(epi_test, EpiTest)
#include "epi_test.moc"
