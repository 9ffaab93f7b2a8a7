// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/structure_tensor.h"
#include "tests/test_main.h"

#include <numeric>

namespace episcope::in_tensor_filters_test {

class TensorFiltersTest : public QObject {
  Q_OBJECT

 private slots:
  void average_halfASampleFurther_isWholeAndSymmetric_data() {
    QTest::addColumn<double>("outer");
    for (const double outer : {0.0, 0.5, 1.0, 1.75, 2.5, 3.0}) {
      QTest::newRow(std::to_string(outer).c_str()) << outer;
    }
  }
  void average_halfASampleFurther_isWholeAndSymmetric() {
    QFETCH(double, outer);
    TensorScales scales;
    scales.outer = outer;
    const TensorFilterSet set = make_tensor_filters(9, 3, scales);
    const Taps& half = set.filters.integrate_half;
    const int count = 2 * set.filters.integrate.radius + 2;
    QVERIFY(count <= kMaxTaps + 1);

    const float sum = std::accumulate(half.values, half.values + count, 0.0F);

    QVERIFY2(std::abs(sum - 1) < 1e-5F, qPrintable(QString::number(sum)));
    for (int i = 0; i < count / 2; ++i) QCOMPARE(half.values[i], half.values[count - 1 - i]);
    QVERIFY(half.values[0] > 0);
  }
};

}  // namespace episcope::in_tensor_filters_test

EPISCOPE_CORE_TEST(tensor_filters_test, TensorFiltersTest)
#include "tensor_filters_test.moc"
