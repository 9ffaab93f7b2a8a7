// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/job.h"
#include "tests/test_main.h"

namespace episcope::in_progress_bar_test {

using namespace episcope::cli;

class ProgressBarTest : public QObject {
  Q_OBJECT
 private slots:
  void progressLine_tellsStageAndTimeLeft() {
    const auto line = [](double fraction, double seconds, int columns) {
      return QString::fromStdString(progress_line({fraction, "vertical EPIs"}, seconds, columns));
    };
    QCOMPARE(line(0.5, 3, 120),
             QString("[############............]  50 %  vertical EPIs, 3 s left"));
    QVERIFY(line(0.25, 60, 120).endsWith(", 3 min 0 s left"));
    QVERIFY(!line(0.5, 0.5, 120).contains("left"));
    QVERIFY(line(1, 3, 120).startsWith("[########################] 100 %"));
    QCOMPARE(line(0.5, 3, 40).size(), 39);
  }
};

}  // namespace episcope::in_progress_bar_test

EPISCOPE_TEST(progress_bar_test, ProgressBarTest)
#include "progress_bar_test.moc"
