// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/disparity_range.h"

#include "tests/test_main.h"

#include <cmath>

namespace episcope::in_disparity_histogram_test {

namespace {

bool is_near(double a, double b) {
  return std::fabs(a - b) < 0.11;  // the margin, and a cell
}

DisparityHistogram two_planes() {
  DisparityHistogram histogram(4);
  for (int i = 0; i < 1000; ++i) histogram.add(i % 2 == 0 ? -0.5 : 0.8);
  return histogram;
}

}  // namespace

class DisparityHistogramTest : public QObject {
  Q_OBJECT

 private slots:
  void ends_encloseWhatIsSeen() {
    const std::optional<Interval> ends = two_planes().ends(0.002);

    QVERIFY(ends && is_near(ends->min, -0.6) && is_near(ends->max, 0.9));
    QVERIFY(ends->min < -0.5 && ends->max > 0.8);
  }

  void ends_ofOneDisparityAreNarrow() {
    DisparityHistogram histogram(4);
    for (int i = 0; i < 100; ++i) histogram.add(0.37);

    const std::optional<Interval> ends = histogram.ends(0.002);

    QVERIFY(ends && ends->min < 0.37 && ends->max > 0.37 && ends->length() <= 0.3);
  }

  void ends_leaveOutWhatIsSpreadThinly() {
    DisparityHistogram histogram = two_planes();
    for (double d = -3.9; d < 3.9; d += 0.2) histogram.add(d);

    const std::optional<Interval> ends = histogram.ends(0.004);

    QVERIFY(ends && is_near(ends->min, -0.6) && is_near(ends->max, 0.9));
  }

  void whatLiesBeyondTheLimit_countsThere() {
    DisparityHistogram histogram(2);
    for (int i = 0; i < 100; ++i) histogram.add(5);

    const std::optional<Interval> ends = histogram.ends(0.002);

    QCOMPARE(histogram.total(), 100.0);
    QVERIFY(ends && ends->max <= 2 && ends->min > 1.7);
  }

  void nothing_hasNoEnds() { QVERIFY(!DisparityHistogram(4).ends(0.002)); }
};

}  // namespace episcope::in_disparity_histogram_test

EPISCOPE_TEST(disparity_histogram_test, DisparityHistogramTest)
#include "disparity_histogram_test.moc"
