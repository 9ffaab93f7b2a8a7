// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/numbers.h"
#include "tests/test_main.h"

#include <algorithm>
#include <vector>

namespace episcope::in_quantile_test {

class QuantileTest : public QObject {
  Q_OBJECT

 private slots:
  void share_choosesByRank_data();
  void share_choosesByRank();
  void values_areKept();
  void median_isTheUpperOfTwo();
};

void QuantileTest::share_choosesByRank_data() {
  QTest::addColumn<QList<float>>("values");
  QTest::addColumn<double>("share");
  QTest::addColumn<float>("expected");
  QTest::newRow("least") << QList<float>{3, 1, 2, 5, 4} << 0.0 << 1.0F;
  QTest::newRow("greatest") << QList<float>{3, 1, 2, 5, 4} << 1.0 << 5.0F;
  QTest::newRow("median, odd") << QList<float>{3, 1, 2, 5, 4} << 0.5 << 3.0F;
  QTest::newRow("median, even") << QList<float>{4, 1, 3, 2} << 0.5 << 3.0F;
  QTest::newRow("nearest rank below") << QList<float>{3, 1, 2, 5, 4} << 0.3 << 2.0F;
  QTest::newRow("nearest rank above") << QList<float>{3, 1, 2, 5, 4} << 0.4 << 3.0F;
  QTest::newRow("one value") << QList<float>{7} << 0.9 << 7.0F;
  QTest::newRow("equal values") << QList<float>{2, 2, 2} << 0.2 << 2.0F;
  QTest::newRow("share below 0") << QList<float>{2, 1} << -1.0 << 1.0F;
  QTest::newRow("share above 1") << QList<float>{2, 1} << 7.0 << 2.0F;
}

void QuantileTest::share_choosesByRank() {
  QFETCH(QList<float>, values);
  QFETCH(double, share);
  QFETCH(float, expected);

  QCOMPARE(quantile(values, share), expected);
}

void QuantileTest::values_areKept() {
  std::vector<float> values{3, 1, 2, 5, 4};

  [[maybe_unused]] const float middle = quantile(values, 0.5);

  std::sort(values.begin(), values.end());
  QCOMPARE(values, (std::vector<float>{1, 2, 3, 4, 5}));
}

void QuantileTest::median_isTheUpperOfTwo() {
  QCOMPARE(median({4, 1, 3, 2}), 3.0);
  QCOMPARE(median({5, 1, 3}), 3.0);
  QCOMPARE(median({}), 0.0);
}

}  // namespace episcope::in_quantile_test

EPISCOPE_TEST(quantile_test, QuantileTest)
#include "quantile_test.moc"
