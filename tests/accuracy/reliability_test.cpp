// SPDX-License-Identifier: BSD-3-Clause
#include "tests/accuracy/reliability.h"
#include "tests/test_main.h"

#include "engine/core/image.h"

#include <algorithm>

namespace episcope::in_reliability_test {

using accuracy::Reliability;

namespace {

constexpr int kSide = 50;  // 20×20 px without the border
constexpr int kBorder = 15;

// Maps that are right to 0.05 px in the first `right` of the 20 columns that are judged, else off
// by 0.1 px.
Reliability measured(int right, float confidence) {
  const Image<float> truth(kSide, kSide);
  Image<float> estimate(kSide, kSide), sure(kSide, kSide);
  std::fill(sure.begin(), sure.end(), confidence);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) estimate.at(y, x) = x < kBorder + right ? 0.05F : 0.1F;
  }
  Reliability reliability;
  reliability.add({estimate.view(), {}}, sure.view(), {truth.view(), {}});
  return reliability;
}

}  // namespace

class ReliabilityTest : public QObject {
  Q_OBJECT

 private slots:
  void share_isThatOfTheJudgedPixels();
  void confidence_thatIsTheShare_hasNoError();
  void confidence_thatIsTooHigh_isTold();
  void unknownEstimate_isWrong();
  void fewPixels_doNotMakeTheLargestError();
};

void ReliabilityTest::share_isThatOfTheJudgedPixels() {
  const Reliability found = measured(5, 0.25F);

  QCOMPARE(found.count(), std::size_t{400});
  QCOMPARE(found.bins()[2].share_right(), 0.25);
  QCOMPARE(found.bins()[1].count, std::size_t{0});
}

void ReliabilityTest::confidence_thatIsTheShare_hasNoError() {
  const Reliability found = measured(15, 0.75F);

  QCOMPARE(found.mean_error(), 0.0);
  QCOMPARE(found.largest_error(), 0.0);
}

void ReliabilityTest::confidence_thatIsTooHigh_isTold() {
  const Reliability found = measured(10, 1);

  QCOMPARE(found.bins()[9].error(), 50.0);
  QCOMPARE(found.mean_error(), 50.0);
  QVERIFY(accuracy::reliability_table("X", found).find("50.0 at most") != std::string::npos);
}

void ReliabilityTest::unknownEstimate_isWrong() {
  const Image<float> zero(kSide, kSide);
  Image<float> sure(kSide, kSide);
  std::fill(sure.begin(), sure.end(), 1.0F);
  const Image<std::uint8_t> unknown(kSide, kSide);
  Reliability found;

  found.add({zero.view(), unknown.view()}, sure.view(), {zero.view(), {}});

  QCOMPARE(found.bins()[9].right, std::size_t{0});
}

void ReliabilityTest::fewPixels_doNotMakeTheLargestError() {
  const Image<float> truth(kSide, kSide);
  Image<float> sure(kSide, kSide);
  std::fill(sure.begin(), sure.end(), 1.0F);
  sure.at(kBorder, kBorder) = 0;  // right all the same: 1 of 400
  Reliability found;

  found.add({truth.view(), {}}, sure.view(), {truth.view(), {}});

  QCOMPARE(found.bins()[0].error(), 100.0);
  QCOMPARE(found.largest_error(), 0.0);
}

}  // namespace episcope::in_reliability_test

EPISCOPE_TEST(reliability_test, ReliabilityTest)
#include "reliability_test.moc"
