// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/label_review.h"

#include "engine/core/error.h"
#include "tests/test_main.h"

namespace episcope::in_label_doubts_test {

namespace {

constexpr int kHeight = 60;
constexpr int kWidth = 80;
const std::vector<std::int32_t> kIds{3, 5, 8};

// A view that is surely 3, but for a rectangle of which 5 is nearly as probable as 3.
struct View {
  Volume<std::uint8_t> probabilities{kHeight, 3, kWidth};
  Image<std::int32_t> labels{kHeight, kWidth, 1, 3};

  View() { set({0, 0, kHeight, kWidth}, {250, 3, 2}); }
  void set(const PixelRect& rect, const std::array<std::uint8_t, 3>& values) {
    for (int y = rect.y0; y < rect.y1; ++y) {
      for (int layer = 0; layer < 3; ++layer) {
        std::uint8_t* row = probabilities.view().row(y, layer);
        std::fill(row + rect.x0, row + rect.x1, values[static_cast<std::size_t>(layer)]);
      }
    }
  }
  std::vector<LabelDoubt> doubts(ImageView<const std::uint8_t> painted = {},
                                 const DoubtChoice& choice = {}) {
    return label_doubts(probabilities.view(), kIds, labels, painted, choice);
  }
};

}  // namespace

class LabelDoubtsTest : public QObject {
  Q_OBJECT

 private slots:
  void largestTimesDoubt_comesFirst_withItsRival();
  void whatIsSure_orThin_isLeftOut();
  void painted_isBeyondDoubt();
  void labelAgainstTheVotes_isFullyInDoubt();
  void otherSizes_areRefused();
};

void LabelDoubtsTest::largestTimesDoubt_comesFirst_withItsRival() {
  View view;
  view.set({5, 5, 25, 25}, {120, 60, 75});     // 400 px, doubt 0.625
  view.set({30, 30, 45, 50}, {110, 105, 40});  // 300 px, doubt 0.955

  const auto doubts = view.doubts();

  QCOMPARE(doubts.size(), std::size_t{2});
  QCOMPARE(doubts[0].label, 3);
  QCOMPARE(doubts[0].rival, 5);
  QVERIFY(doubts[0].blob.contains({37, 40}));
  QVERIFY(doubts[0].gain > doubts[1].gain);
  QCOMPARE(doubts[1].rival, 8);
  QVERIFY(std::abs(doubts[0].gain - doubts[0].blob.pixels * 105.0 / 110) < 0.01);
  QVERIFY(std::abs(doubts[0].blob.inside.y - 37) < 3);
  QCOMPARE(view.doubts({}, {.count = 1}).size(), std::size_t{1});
}

void LabelDoubtsTest::whatIsSure_orThin_isLeftOut() {
  View view;
  view.set({0, 40, kHeight, 43}, {100, 99, 1});  // as thin as a boundary
  view.set({10, 10, 30, 30}, {220, 40, 10});

  QVERIFY(view.doubts().empty());
}

void LabelDoubtsTest::painted_isBeyondDoubt() {
  View view;
  view.set({10, 10, 30, 40}, {100, 99, 1});
  Image<std::uint8_t> painted(kHeight, kWidth);
  for (int y = 0; y < kHeight; ++y) painted.at(y, 24) = 1;

  const auto doubts = view.doubts(painted);

  QCOMPARE(doubts.size(), std::size_t{2});  // the stroke parts it
  for (int y = 0; y < kHeight; ++y) QVERIFY(!doubts[0].blob.contains({y, 24}));
}

void LabelDoubtsTest::labelAgainstTheVotes_isFullyInDoubt() {
  View view;
  for (int y = 20; y < 40; ++y) {
    for (int x = 20; x < 40; ++x) view.labels.at(y, x) = 8;  // smoothed over
  }

  const auto doubts = view.doubts();

  QCOMPARE(doubts.size(), std::size_t{1});
  QCOMPARE(doubts[0].label, 8);
  QCOMPARE(doubts[0].rival, 3);
  QCOMPARE(doubts[0].gain, static_cast<double>(doubts[0].blob.pixels));
}

void LabelDoubtsTest::otherSizes_areRefused() {
  View view;
  const Image<std::uint8_t> painted(kHeight, kWidth - 1);
  QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)view.doubts(painted));
}

}  // namespace episcope::in_label_doubts_test

EPISCOPE_TEST(label_doubts_test, LabelDoubtsTest)
#include "label_doubts_test.moc"
