// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/reweight_by_color.h"

#include "tests/test_main.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>

namespace episcope::in_judge_colors_test {

namespace {

constexpr int kHeight = 32, kWidth = 256;
constexpr int kBar = 24, kBarEnd = 36;  // The bar in the left view; 3 px further left in the other.
constexpr float kDisparity = 3;
constexpr int kDoubt_px = 3;
const ViewIndex kLeft{0, 0}, kRight{0, 1};

int bar_at(ViewIndex view) {
  return kBar - static_cast<int>(kDisparity) * view.u;
}

bool is_bar(ViewIndex view, int x) {
  return x >= bar_at(view) && x < bar_at(view) + kBarEnd - kBar;
}

// A dark bar, label 5, before something light, label 2, in two views; beside the bar, where it
// might be wider, its probability is 0.6, as that of its own outer pixels.
struct Bar {
  std::shared_ptr<const LightField> light_field;
  DisparityField disparity;
  LabelProbabilities probabilities = empty_probabilities({2, 5}, {kLeft, {1, 2}});

  explicit Bar(int channels) {
    ViewStack<std::uint8_t> samples({1, 2}, kHeight, kWidth, channels);
    disparity.disparity = ViewStack<float>({1, 2}, kHeight, kWidth);
    for (const ViewIndex view : {kLeft, kRight}) {
      ProbabilityMap& p = probabilities.view(view) = ProbabilityMap(kHeight, 2, kWidth);
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          std::fill_n(&samples.view(view).at(y, x), channels, is_bar(view, x) ? 40 : 200);
          disparity.disparity.view(view).at(y, x) = kDisparity;
          p.view().at(y, 1, x) = given(view, x);
          p.view().at(y, 0, x) = static_cast<std::uint8_t>(255 - given(view, x));
        }
      }
    }
    light_field = std::make_shared<const LightField>(std::move(samples), LightFieldInfo{});
  }
  static std::uint8_t given(ViewIndex view, int x) {
    const int beside = bar_at(view) - kDoubt_px, end = bar_at(view) + kBarEnd - kBar + kDoubt_px;
    if (x < beside || x >= end) return 0;
    return x < bar_at(view) + 2 || x >= end - kDoubt_px - 2 ? 153 : 255;
  }
  void judge(bool knows_disparity = true) {
    const RayLabelingInput input{nullptr, knows_disparity ? &disparity : nullptr, nullptr,
                                 light_field.get()};
    // Nothing is smoothed: the labels of the left view are too wide.
    reweight_by_color(input, kLeft, {.smoothness = 0.01}, Progress(), probabilities);
  }
  [[nodiscard]] std::uint8_t of_bar(ViewIndex view, int x) const {
    return probabilities.view(view).view().at(kHeight / 2, 1, x);
  }
};

}  // namespace

class JudgeColorsTest : public QObject {
  Q_OBJECT

 private slots:
  void besideAThing_colorsOfWhatIsNearbyDecide_data() {
    QTest::addColumn<int>("channels");
    QTest::newRow("grey") << 1;
    QTest::newRow("RGB") << 3;
  }
  void besideAThing_colorsOfWhatIsNearbyDecide() {
    QFETCH(int, channels);
    Bar bar(channels);

    bar.judge();

    for (const ViewIndex view : {kLeft, kRight}) {
      QVERIFY(bar.of_bar(view, bar_at(view) - kDoubt_px) < 127);
      QVERIFY(bar.of_bar(view, bar_at(view)) > 153);
    }
  }

  void surePixels_stayAsTheyAre() {
    Bar bar(3);

    bar.judge();

    for (const ViewIndex view : {kLeft, kRight}) {
      QCOMPARE(bar.of_bar(view, bar_at(view) + 5), std::uint8_t{255});
      QCOMPARE(bar.of_bar(view, 2), std::uint8_t{0});
    }
  }

  void withoutDisparity_otherViewsStayAsTheyAre() {
    Bar bar(3);

    bar.judge(false);

    for (int x = 0; x < kWidth; ++x) QCOMPARE(bar.of_bar(kRight, x), Bar::given(kRight, x));
    QVERIFY(bar.of_bar(kLeft, kBar - kDoubt_px) < 127);
  }
};

}  // namespace episcope::in_judge_colors_test

EPISCOPE_TEST(judge_colors_test, JudgeColorsTest)
#include "judge_colors_test.moc"
