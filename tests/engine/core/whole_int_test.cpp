// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/numbers.h"
#include "tests/test_main.h"

namespace episcope::in_whole_int_test {

class WholeIntTest : public QObject {
  Q_OBJECT

 private slots:
  void wholeNumbers_areTaken() {
    QCOMPARE(whole_int(-7), std::optional(-7));
    QCOMPARE(whole_int(2147483647.0), std::optional(2147483647));
    QCOMPARE(whole_int(-2147483648.0), std::optional(-2147483647 - 1));
  }
  void others_areNot_data() {
    QTest::addColumn<double>("number");
    QTest::newRow("fraction") << 0.5;
    QTest::newRow("just too large") << 2147483648.0;
    QTest::newRow("just too small") << -2147483649.0;
    QTest::newRow("huge") << 1e300;
    QTest::newRow("infinite") << -std::numeric_limits<double>::infinity();
    QTest::newRow("NaN") << std::numeric_limits<double>::quiet_NaN();
  }
  void others_areNot() {
    QFETCH(double, number);
    QVERIFY(!whole_int(number));
  }
};

}  // namespace episcope::in_whole_int_test

EPISCOPE_TEST(whole_int_test, WholeIntTest)
#include "whole_int_test.moc"
