// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/disparity_range.h"

#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <cmath>

namespace episcope::in_orientation_histogram_test {

using namespace episcope::test;

class OrientationHistogramTest : public QObject {
  Q_OBJECT

 private slots:
  // Two planes, at −0.5 and 0.8 px.
  void ends_encloseWhatIsSeen() {
    const Scene scene = render("edge", 64, 80, {5, 5});
    const OrientationHistogram seen(*scene.light_field, 4, Progress());

    const std::optional<Interval> ends = seen.ends(0.002);

    QVERIFY(seen.total() > 1000);
    QVERIFY(ends && std::fabs(ends->min + 0.5) < 0.4 && std::fabs(ends->max - 0.8) < 0.4);
  }

  void clearedCells_countNoMore() {
    const Scene scene = render("edge", 64, 80, {5, 5});
    OrientationHistogram seen(*scene.light_field, 4, Progress());
    const double total = seen.total();

    for (int cell = 0; cell < seen.size(); ++cell) {
      if (seen.middle(cell) < 0.2) seen.clear(cell);
    }

    const std::optional<Interval> ends = seen.ends(0.002);
    QCOMPARE(seen.total(), total);
    QVERIFY(ends && ends->min > 0.1 && ends->max > 0.8);
    for (int cell = 0; cell < seen.size(); ++cell) seen.clear(cell);
    QVERIFY(!seen.ends(0.002));
  }
};

}  // namespace episcope::in_orientation_histogram_test

EPISCOPE_TEST(orientation_histogram_test, OrientationHistogramTest)
#include "orientation_histogram_test.moc"
