// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/predict_from_strokes.h"

#include "tests/test_main.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace episcope::in_thin_gaps_test {

namespace {

constexpr int kHeight = 60;
constexpr int kWidth = 96;
constexpr int kWall = 0;
constexpr int kThing = 1;
constexpr int kThingEnds = 60;  // Columns from here on show the wall, at its own depth.

// A wall at disparity 0, and before it at 1 a thing of columns `bar` px wide, `period` apart, whose
// disparity the estimate has in all the gaps. Forest and strokes know both by their color.
struct Fence {
  Volume<float> features{kHeight, 1, kWidth};
  Image<float> disparity{kHeight, kWidth};
  Image<std::int32_t> strokes{kHeight, kWidth};
  ForestSamples samples{1, 2, {}, {}};

  Fence(int bar, int period, float of_thing = 1) {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const int label = x < kThingEnds && x % period < bar ? kThing : kWall;
        features.view().at(y, 0, x) = static_cast<float>(label);
        disparity.at(y, x) = x < kThingEnds ? of_thing : 0;
        if (y > 40 || (label == kWall && x < kThingEnds + 12)) continue;
        strokes.at(y, x) = label + 1;
        samples.features.push_back(static_cast<float>(label));
        samples.labels.push_back(label);
      }
    }
  }
  [[nodiscard]] Image<std::int32_t> gaps(int threads = 2) const {
    const Forest forest = Forest::train(samples, {.trees = 8}, Progress());
    const LabelSurfaces surfaces(strokes.view(), 2, disparity.view(), {}, Progress());
    return labels_in_thin_gaps({forest, features.view(), Progress()}, surfaces, Progress(threads));
  }
};

std::ptrdiff_t count_of(const Image<std::int32_t>& gaps, std::int32_t value) {
  return std::count(gaps.begin(), gaps.end(), value);
}

}  // namespace

class ThinGapsTest : public QObject {
  Q_OBJECT

 private slots:
  void wallBetweenBars_isFound() {
    const Image<std::int32_t> gaps = Fence(3, 10).gaps();

    for (int x = 0; x < kWidth; ++x) {
      const bool is_gap = x < kThingEnds && x % 10 >= 3;
      QCOMPARE(gaps.at(30, x), is_gap ? kWall + 1 : 0);
    }
  }

  void besideSomethingWide_disparityIsBelieved() {
    QCOMPARE(count_of(Fence(20, 30).gaps(), 0), std::ptrdiff_t{kHeight} * kWidth);
  }

  void farFromTheBars_disparityIsBelieved() {
    const Image<std::int32_t> gaps = Fence(3, 60).gaps();

    QCOMPARE(gaps.at(30, 6), kWall + 1);
    QCOMPARE(gaps.at(30, 30), 0);
  }

  void whatLiesBefore_showsInNoGap() {
    QCOMPARE(count_of(Fence(3, 10, -1).gaps(), 0), std::ptrdiff_t{kHeight} * kWidth);
  }

  void gaps_keepTheirLabel() {
    const Fence fence(3, 10);
    LabelSurfaces surfaces(fence.strokes.view(), 2, fence.disparity.view(), {}, Progress());
    const auto of_wall = [&](int x) { return surfaces.misfits(30)[x * surfaces.pitch() + kWall]; };
    QVERIFY(of_wall(5) > 2);

    surfaces.set_gaps(fence.gaps().view());

    QCOMPARE(of_wall(5), 0.0F);
    QVERIFY(of_wall(1) > 2);
  }

  void threads_doNotMatter() {
    const Fence fence(3, 10);
    const Image<std::int32_t> one = fence.gaps(1), two = fence.gaps(2);

    QVERIFY(std::equal(one.begin(), one.end(), two.begin()));
  }
};

}  // namespace episcope::in_thin_gaps_test

EPISCOPE_TEST(thin_gaps_test, ThinGapsTest)
#include "thin_gaps_test.moc"
