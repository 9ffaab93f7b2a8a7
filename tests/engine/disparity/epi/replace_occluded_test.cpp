// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi_c.h"

#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>

namespace episcope::in_replace_occluded_test {

using namespace episcope::test;

namespace {

constexpr GridShape kGrid{1, 9};
constexpr int kHeight = 3;
constexpr int kWidth = 40;

ViewStack<float> filled(float value) {
  ViewStack<float> stack(kGrid, kHeight, kWidth);
  std::fill_n(stack.data(), stack.size(), value);
  return stack;
}

// Views that contradict nothing.
PackedViews blank() {
  return {ViewStack<std::uint32_t>(kGrid, kHeight, kWidth)};
}

// A near half plane (d = 1) left of a far one (d = 0), whose edge moves by −`slope` px per view.
ViewStack<float> half_planes(int slope) {
  ViewStack<float> stack(kGrid, kHeight, kWidth);
  for (int u = 0; u < kGrid.u; ++u) {
    const ImageView<float> view = stack.view({0, u});
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) view.at(y, x) = x < 20 - slope * (u - 4) ? 1.0F : 0.0F;
    }
  }
  return stack;
}

// Columns of the near half plane in the middle row.
int near_columns(const ViewStack<float>& stack, int u) {
  const ImageView<const float> view = stack.view({0, u});
  return static_cast<int>(std::count(view.row(1), view.row(1) + kWidth, 1.0F));
}

}  // namespace

class ReplaceOccludedTest : public QObject {
  Q_OBJECT

 private slots:
  void truth_stays();
  void raysSeenThrough_areReplaced();
  void surerRays_stay();
  void oneView_isNotEnough();
  void replacedRays_takeTheMedian();
  void anyThreadCount_givesTheSame();
};

void ReplaceOccludedTest::truth_stays() {
  ViewStack<float> stack = half_planes(1);

  const long changed = replace_occluded(blank(), stack, filled(1), Progress());

  QCOMPARE(changed, 0L);
  QVERIFY(same_bytes(stack, half_planes(1)));
}

// An edge that stands still: the k-th column before it is seen through by all views to the left
// but k − 1.
void ReplaceOccludedTest::raysSeenThrough_areReplaced() {
  ViewStack<float> stack = half_planes(0);

  const long changed = replace_occluded(blank(), stack, filled(1), Progress());

  const int near[] = {20, 20, 19, 18, 17, 17, 17, 17, 17};
  long expected = 0;
  for (int u = 0; u < kGrid.u; ++u) {
    QCOMPARE(near_columns(stack, u), near[u]);
    expected += kHeight * (20 - near[u]);
  }
  QCOMPARE(changed, expected);
}

void ReplaceOccludedTest::surerRays_stay() {
  ViewStack<float> stack = half_planes(0);
  ViewStack<float> confidence = filled(1);
  for (std::size_t i = 0; i < confidence.size(); ++i) {
    if (i % kWidth >= 20) confidence.data()[i] = 0.9F;
  }

  QCOMPARE(replace_occluded(blank(), stack, confidence, Progress()), 0L);
}

void ReplaceOccludedTest::oneView_isNotEnough() {
  ViewStack<float> stack = filled(1);
  stack.view({0, 4}).at(1, 20) = 0;

  QCOMPARE(replace_occluded(blank(), stack, filled(1), Progress()), 0L);
}

// Three views show something farther where the line of the ray ends.
void ReplaceOccludedTest::replacedRays_takeTheMedian() {
  ViewStack<float> stack = filled(1);
  stack.view({0, 0}).at(1, 24) = -0.9F;
  stack.view({0, 1}).at(1, 23) = 0.5F;
  stack.view({0, 6}).at(1, 18) = 0.2F;

  replace_occluded(blank(), stack, filled(1), Progress());

  QCOMPARE(stack.view({0, 4}).at(1, 20), 0.2F);
}

void ReplaceOccludedTest::anyThreadCount_givesTheSame() {
  ViewStack<float> one = half_planes(0), three = half_planes(0);

  replace_occluded(blank(), one, filled(1), Progress(1));
  replace_occluded(blank(), three, filled(1), Progress(3));

  QVERIFY(same_bytes(one, three));
}

}  // namespace episcope::in_replace_occluded_test

EPISCOPE_TEST(replace_occluded_test, ReplaceOccludedTest)
#include "replace_occluded_test.moc"
