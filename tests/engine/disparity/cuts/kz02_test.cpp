// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/kz02.h"

#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>

namespace episcope::in_kz02_test {

using namespace episcope::test;

class Kz02Test : public QObject {
  Q_OBJECT

 private slots:
  void twoPlanes_areFound_data();
  void twoPlanes_areFound();
  void finish_givesTheLabelsSoFar();
};

void Kz02Test::twoPlanes_areFound_data() {
  QTest::addColumn<QString>("profile");
  QTest::addColumn<double>("noise");
  QTest::addColumn<double>("limit");
  // Labels are 0.1 px apart; 4 view steps away whole pixels are 0.25 px.
  QTest::newRow("tuned") << "tuned" << 0.0 << 0.3;
  QTest::newRow("tuned noise 5") << "tuned" << 5.0 << 1.0;
  QTest::newRow("paper") << "paper" << 0.0 << 6.0;
}

void Kz02Test::twoPlanes_areFound() {
  QFETCH(QString, profile);
  QFETCH(double, noise);
  QFETCH(double, limit);
  const Scene scene = render("edge", 64, 72, {9, 9}, 1, noise);
  const ParameterSet values{{"profile", profile.toStdString()},
                            {"labels", 21},
                            {"range", IntervalOrAuto(Interval{-1, 1})}};

  const Estimate estimate = kz02_estimator().run(*scene.light_field, values, {}, Progress());

  const ViewIndex view = scene.light_field->center();
  const Errors found =
      errors(estimate.field.disparity.view(view), scene.truth->field.view(view), 0);
  QVERIFY2(found.mse_100 < limit, qPrintable(QString::number(found.mse_100)));
}

void Kz02Test::finish_givesTheLabelsSoFar() {
  const Scene scene = render("edge", 64, 72);
  std::stop_source finish;
  const Progress progress({}, finish.get_token(), [&](const ProgressState& state) {
    if (state.fraction > 0.5) finish.request_stop();
  });

  const Estimate estimate = kz02_estimator().run(*scene.light_field, {}, {}, progress);

  QVERIFY(all_finite(estimate.field.disparity));
  QVERIFY(std::ranges::any_of(estimate.notes, [](const std::string& note) {
    return note.find("in 0 cycles") != std::string::npos;
  }));
}

}  // namespace episcope::in_kz02_test

EPISCOPE_TEST(kz02_test, Kz02Test)
#include "kz02_test.moc"
