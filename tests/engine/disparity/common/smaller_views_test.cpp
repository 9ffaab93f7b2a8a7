// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/block_disparities.h"

#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace episcope::in_smaller_views_test {

using namespace episcope::test;

class SmallerViewsTest : public QObject {
  Q_OBJECT

 private slots:
  void samples_areMeansOfBlocks() {
    const LightField lf =
        make_light_field({3, 3}, 6, 9, 3, [](ViewIndex view, int y, int x, int c) {
          return 0.01F * static_cast<float>(9 * y + x) + 0.1F * static_cast<float>(view.u + c);
        });

    const LightField smaller = smaller_views(lf, 2, Progress());

    QCOMPARE(smaller.height(), 3);
    QCOMPARE(smaller.width(), 4);
    // Pixels (2, 4), (2, 5), (3, 4) and (3, 5) of view (1, 2), channel 1.
    const float mean = 0.01F * (22 + 23 + 31 + 32) / 4 + 0.1F * 3;
    QVERIFY(std::fabs(smaller.view_as_float({1, 2}).at(1, 2, 1) - mean) < 1e-4F);
  }

  void viewsBesideTheCross_areBlack() {
    const LightField lf =
        make_light_field({3, 3}, 4, 4, 1, [](ViewIndex, int, int, int) { return 0.5F; });

    const LightField smaller = smaller_views(lf, 2, Progress());

    QCOMPARE(smaller.view_as_float({0, 0}).at(1, 1), 0.0F);
    QVERIFY(smaller.view_as_float({0, 1}).at(1, 1) > 0.49F);
    QVERIFY(smaller.view_as_float({1, 0}).at(1, 1) > 0.49F);
  }

  void allViews_areThereOnRequest() {
    const LightField lf = make_light_field({3, 3}, 4, 4, 1, [](ViewIndex view, int, int, int) {
      return 0.1F * static_cast<float>(3 * view.v + view.u);
    });

    const LightField smaller = smaller_views(lf, 2, Progress(), ReducedViews::All);

    QVERIFY(std::fabs(smaller.view_as_float({2, 0}).at(1, 1) - 0.6F) < 1e-4F);
    QVERIFY(std::fabs(smaller.view_as_float({1, 1}).at(0, 1) - 0.4F) < 1e-4F);
  }

  void blocksWithAnInvalidPixel_areNotValid() {
    ViewStack<float> samples({1, 2}, 4, 4);
    std::fill_n(samples.data(), samples.size(), 0.5F);
    ViewStack<std::uint8_t> valid({1, 2}, 4, 4);
    std::fill_n(valid.data(), valid.size(), std::uint8_t{1});
    valid.view({0, 1}).at(3, 1) = 0;
    const LightField lf(std::move(samples), LightFieldInfo(), std::move(valid));

    const LightField smaller = smaller_views(lf, 2, Progress());

    QVERIFY(!smaller.is_valid({0, 1}, 1, 0));
    QVERIFY(smaller.is_valid({0, 1}, 0, 0));
    QVERIFY(smaller.is_valid({0, 0}, 1, 0));
  }
};

}  // namespace episcope::in_smaller_views_test

EPISCOPE_TEST(smaller_views_test, SmallerViewsTest)
#include "smaller_views_test.moc"
