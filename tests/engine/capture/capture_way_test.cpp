// SPDX-License-Identifier: BSD-3-Clause
#include "tests/engine/capture/capture_way.h"

#include "tests/test_main.h"

namespace episcope::in_capture_way_test {

using namespace accuracy;

namespace {

/// From photographs to truth, once for all tests.
const CaptureErrors& errors() {
  static const CaptureErrors the_errors = [] {
    capture::DemoOptions options;
    options.height = 300;
    options.width = 400;
    options.detail = 50;
    options.seed = 6;
    return capture_errors(go_capture_way(options, Progress(2)), 800);
  }();
  return the_errors;
}

}  // namespace

class CaptureWayTest : public QObject {
  Q_OBJECT

 private slots:
  void rows_areAligned() {
    QVERIFY(errors().rows_before.percentile_95 > 0.3);
    QVERIFY2(errors().rows_after.percentile_95 <= 0.1,
             qPrintable(QString::number(errors().rows_after.percentile_95)));
  }

  void gains_areMeasured() { QVERIFY(errors().gain < 0.01); }

  void disparity_isThatOfTheScene() {
    qInfo("|disparity − exact|: median %.4f, 99 %% %.4f px", errors().disparity_median,
          errors().disparity_99);
    QVERIFY(errors().disparity_median <= 0.01);
    QVERIFY(errors().disparity_99 <= 0.05);
  }

  void discontinuities_areMasked() {
    qInfo("%d of %d discontinuities are not masked where they are", errors().missed,
          errors().jumps);
    QVERIFY(errors().jumps > 30);
    QCOMPARE(errors().missed, 0);
  }

  void distance_isAsUncertainAsTold() {
    QVERIFY(errors().delta_tz > 0);
    QVERIFY2(errors().tz <= 2 * errors().delta_tz, qPrintable(QString::number(errors().tz)));
  }
};

}  // namespace episcope::in_capture_way_test

EPISCOPE_TEST(capture_way_test, CaptureWayTest)
#include "capture_way_test.moc"
