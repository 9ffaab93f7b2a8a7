// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/visible_costs.h"

#include "engine/core/image.h"
#include "engine/disparity/registry.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <QRegularExpression>

#include <algorithm>
#include <cmath>

namespace episcope::in_cost_unit_test {

using namespace episcope::test;

namespace {

// The weight of the total variation per px, from the notes.
double weight_of(const Estimate& estimate) {
  for (const std::string& note : estimate.notes) {
    const auto match = QRegularExpression("λ ([0-9.e-]+) per px").match(note.c_str());
    if (match.hasMatch()) return match.captured(1).toDouble();
  }
  return std::nan("");
}

}  // namespace

class CostUnitTest : public QObject {
  Q_OBJECT

 private slots:
  void unit_isTheMeanAroundTheBestLabel();
  void unit_skipsInvalidPixels();
  void weight_doesNotDependOnTheRange_data();
  void weight_doesNotDependOnTheRange();
};

// Costs |l − 3| at one pixel, |l| at the other, labels a quarter of a pixel apart: two on each side
// of the best, where there are so many.
void CostUnitTest::unit_isTheMeanAroundTheBestLabel() {
  const LightField lf = make_light_field({1, 2}, 1, 2, 1, [](auto...) { return 0.5F; });
  Volume<float> costs(1, 9, 2);
  for (int l = 0; l < 9; ++l) {
    costs.view().row(0, l)[0] = static_cast<float>(std::abs(l - 3));
    costs.view().row(0, l)[1] = static_cast<float>(l);
  }

  QCOMPARE(cost_unit(lf, {0, 0}, costs.view(), 0.25, Progress()), (6.0 / 5 + 3.0 / 3) / 2);
  QCOMPARE(cost_unit(lf, {0, 0}, costs.view(), 3, Progress()), (2.0 / 3 + 1.0 / 2) / 2);
}

void CostUnitTest::unit_skipsInvalidPixels() {
  ViewStack<std::uint8_t> valid({1, 2}, 1, 2);
  std::fill_n(valid.data(), valid.size(), std::uint8_t{1});
  valid.view({0, 0}).at(0, 1) = 0;
  const LightField lf(ViewStack<float>({1, 2}, 1, 2), {}, std::move(valid));
  Volume<float> costs(1, 3, 2);
  for (int l = 0; l < 3; ++l) {
    costs.view().row(0, l)[0] = 1;
    costs.view().row(0, l)[1] = 100;
  }

  QCOMPARE(cost_unit(lf, {0, 0}, costs.view(), 0.25, Progress()), 1.0);
}

void CostUnitTest::weight_doesNotDependOnTheRange_data() {
  QTest::addColumn<QString>("method");
  QTest::addColumn<double>("noise");
  for (const char* method : {"st_av_g", "st_ch_g", "epi_g"}) {
    QTest::addRow("%s", method) << method << 0.0;
    QTest::addRow("%s, noise", method) << method << 5.0;
  }
}

// The scene with labels that nothing supports on both sides: the same weight and the same map.
void CostUnitTest::weight_doesNotDependOnTheRange() {
  QFETCH(QString, method);
  QFETCH(double, noise);
  const Scene scene = render("demo", 128, 144, {7, 7}, 1, noise);
  const Estimator estimator = find_estimator(method.toStdString());
  const ViewIndex view = scene.light_field->center();
  const auto estimate = [&](int factor) {
    return estimator.run(
        *scene.light_field,
        {{"range", Interval{-1.5 * factor, 1.5 * factor}}, {"labels", 30 * factor + 1}}, {},
        Progress());
  };

  const Estimate narrow = estimate(1);
  for (const int factor : {2, 4}) {
    const Estimate wide = estimate(factor);

    const double ratio = weight_of(wide) / weight_of(narrow);
    QVERIFY2(std::fabs(ratio - 1) < 0.01, qPrintable(QString::number(ratio)));
    const Errors off = errors(wide.field.disparity.view(view), narrow.field.view(view), 8);
    QVERIFY2(off.mse_100 < 0.35, qPrintable(QString::number(off.mse_100)));
  }
}

}  // namespace episcope::in_cost_unit_test

EPISCOPE_TEST(cost_unit_test, CostUnitTest)
#include "cost_unit_test.moc"
