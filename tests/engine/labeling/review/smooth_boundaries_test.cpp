// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/label_review.h"

#include "engine/core/error.h"
#include "tests/test_main.h"

#include <algorithm>
#include <random>

namespace episcope::in_smooth_boundaries_test {

namespace {

// Left of x = 30 label 4, right of it 9, with a boundary that is off by up to three pixels.
Image<std::int32_t> ragged() {
  std::mt19937 random(3);
  Image<std::int32_t> labels(60, 60, 1, 9);
  for (int y = 0; y < 60; ++y) {
    const int end = 27 + static_cast<int>(random() % 7);
    std::fill_n(labels.row(y), end, 4);
  }
  return labels;
}

// Pixels of vertical neighbors with different labels.
int raggedness(const Image<std::int32_t>& labels) {
  int count = 0;
  for (int y = 1; y < labels.height(); ++y) {
    for (int x = 0; x < labels.width(); ++x) count += labels.at(y, x) != labels.at(y - 1, x);
  }
  return count;
}

bool same(const Image<std::int32_t>& a, const Image<std::int32_t>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace

class SmoothBoundariesTest : public QObject {
  Q_OBJECT

 private slots:
  void zero_changesNothing();
  void raggedBoundary_becomesStraight_whereItIs();
  void specks_vanish_andPaintedPixelsStay();
  void straightBoundaries_stay();
  void pixelsWithoutLabel_stay();
  void negativeSmoothing_isRefused();
};

void SmoothBoundariesTest::zero_changesNothing() {
  const auto labels = ragged();
  QVERIFY(same(smooth_boundaries(labels, {}, 0), labels));
}

void SmoothBoundariesTest::raggedBoundary_becomesStraight_whereItIs() {
  const auto labels = ragged();

  const auto smooth = smooth_boundaries(labels, {}, 3);

  QVERIFY2(raggedness(smooth) * 4 < raggedness(labels),
           qPrintable(QString::number(raggedness(smooth))));
  const auto left = std::count(smooth.begin(), smooth.end(), 4);
  QVERIFY(std::abs(left - 60 * 30) < 60);
}

void SmoothBoundariesTest::specks_vanish_andPaintedPixelsStay() {
  Image<std::int32_t> labels(40, 40, 1, 2);
  labels.at(10, 10) = labels.at(30, 30) = 7;
  Image<std::uint8_t> painted(40, 40);
  painted.at(30, 30) = 7;

  const auto smooth = smooth_boundaries(labels, painted, 1.5);

  QCOMPARE(smooth.at(10, 10), 2);
  QCOMPARE(smooth.at(30, 30), 7);
  QCOMPARE(std::count(smooth.begin(), smooth.end(), 7), 1);
}

void SmoothBoundariesTest::straightBoundaries_stay() {
  Image<std::int32_t> labels(40, 40, 1, 2);
  for (int y = 0; y < 40; ++y) std::fill_n(labels.row(y), 17, 5);
  Image<std::int32_t> lying(40, 40, 1, 2);
  for (int y = 0; y < 9; ++y) std::fill_n(lying.row(y), 40, 5);

  QVERIFY(same(smooth_boundaries(labels, {}, 2.3), labels));
  QVERIFY(same(smooth_boundaries(lying, {}, 6), lying));
}

void SmoothBoundariesTest::pixelsWithoutLabel_stay() {
  Image<std::int32_t> labels(40, 40, 1, 2);
  for (int y = 0; y < 20; ++y) std::fill_n(labels.row(y), 20 - y, 0);
  labels.at(30, 30) = 0;

  QVERIFY(same(smooth_boundaries(labels, {}, 3), labels));
}

void SmoothBoundariesTest::negativeSmoothing_isRefused() {
  QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)smooth_boundaries(ragged(), {}, -1));
}

}  // namespace episcope::in_smooth_boundaries_test

EPISCOPE_TEST(smooth_boundaries_test, SmoothBoundariesTest)
#include "smooth_boundaries_test.moc"
