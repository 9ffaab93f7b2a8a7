// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/global_labeling.h"
#include "tests/test_main.h"

#include <cmath>

namespace episcope::in_sub_label_test {

class SubLabelTest : public QObject {
  Q_OBJECT

 private slots:
  void offset_isExactForItsShape_data() {
    QTest::addColumn<Refinement>("shape");
    QTest::addColumn<double>("place");
    for (const Refinement shape : {Refinement::Parabola, Refinement::Equiangular}) {
      for (const double place : {-0.5, -0.3, 0.0, 0.2, 0.5}) {
        QTest::addRow("%s %g", name_of(shape).c_str(), place) << shape << place;
      }
    }
  }

  // Costs of the labels −1, 0 and 1 whose least lies at `place`: x² or |x|, any scale and height.
  void offset_isExactForItsShape() {
    QFETCH(Refinement, shape);
    QFETCH(double, place);
    const auto cost = [&](double label) {
      const double x = label - place;
      return static_cast<float>(0.3 + 0.7 * (shape == Refinement::Parabola ? x * x : std::fabs(x)));
    };

    const float found = sub_label_offset(cost(-1), cost(0), cost(1), shape);

    QVERIFY2(std::fabs(found - place) < 1e-6, qPrintable(QString::number(found)));
  }

  void offset_isAtMostHalfALabel() {
    QCOMPARE(sub_label_offset(9, 1, 0.9F, Refinement::Parabola), 0.5F);
    QCOMPARE(sub_label_offset(0.9F, 1, 9, Refinement::Equiangular), -0.5F);
  }

  void flatOrHollowCosts_stayAtTheLabel() {
    for (const Refinement each : {Refinement::Parabola, Refinement::Equiangular}) {
      QCOMPARE(sub_label_offset(1, 1, 1, each), 0.0F);
      QCOMPARE(sub_label_offset(0.5F, 1, 0.7F, each), 0.0F);
    }
    QCOMPARE(sub_label_offset(3, 1, 2, Refinement::None), 0.0F);
  }
};

}  // namespace episcope::in_sub_label_test

EPISCOPE_TEST(sub_label_test, SubLabelTest)
#include "sub_label_test.moc"
