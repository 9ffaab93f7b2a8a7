// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane_pm.h"

#include "engine/disparity/stereo.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

namespace episcope::in_plane_pm_test {

using namespace episcope::test;

namespace {

Estimate estimated(const Scene& scene, const PlaneParameters& parameters = {},
                   const Progress& progress = Progress()) {
  return estimate_planes(*scene.light_field, parameters, ViewSelection::Center, progress);
}

double mse(const Scene& scene, const Estimate& estimate) {
  const ViewIndex view = scene.light_field->center();
  return errors(estimate.field.disparity.view(view), scene.truth->field.view(view), 5).mse_100;
}

}  // namespace

class PlanePmTest : public QObject {
  Q_OBJECT

 private slots:
  void errors_stayWithinLimits_data();
  void errors_stayWithinLimits();
  void noisyScene_isBetterThanGlobalStereo();
  void anyView_isEstimated();
  void threads_changeNothing();
  void surfaceInFront_hidesWhatIsBehind();
};

void PlanePmTest::errors_stayWithinLimits_data() {
  QTest::addColumn<QString>("id");
  QTest::addColumn<double>("limit");
  // A half above what was measured.
  QTest::newRow("edge") << "edge" << 0.05;
  QTest::newRow("bars") << "bars" << 0.2;
  QTest::newRow("slant") << "slant" << 0.01;
}

void PlanePmTest::errors_stayWithinLimits() {
  QFETCH(QString, id);
  QFETCH(double, limit);
  const Scene scene = render(id.toStdString(), 96, 112);

  const double error = mse(scene, estimated(scene));

  QVERIFY2(error < limit, qPrintable(QString::number(error)));
}

void PlanePmTest::noisyScene_isBetterThanGlobalStereo() {
  const Scene scene = render("demo", 144, 144, {9, 9}, 1, 5);

  const double error = mse(scene, estimated(scene));
  const double global =
      mse(scene, estimate_stereo_global(*scene.light_field, MatchedViews::All, {}, Progress()));

  QVERIFY2(error < 0.95 * global, qPrintable(QString("%1, global %2").arg(error).arg(global)));
}

void PlanePmTest::anyView_isEstimated() {
  const Scene scene = render("edge", 64, 80, {5, 5});
  PlaneParameters parameters;
  parameters.matching.view = ViewIndex{1, 4};

  const Estimate estimate = estimated(scene, parameters);

  const Errors off =
      errors(estimate.field.disparity.view({1, 4}), scene.truth->field.view(ViewIndex{1, 4}), 5);
  QVERIFY2(off.mse_100 < 0.5, qPrintable(QString::number(off.mse_100)));
}

void PlanePmTest::threads_changeNothing() {
  const Scene scene = render("bars", 64, 80, {5, 5});

  const Estimate one = estimated(scene, {}, Progress(1));
  const Estimate three = estimated(scene, {}, Progress(3));

  QVERIFY(same_bytes(one.field.disparity, three.field.disparity));
  QVERIFY(same_bytes(one.confidence, three.confidence));
}

void PlanePmTest::surfaceInFront_hidesWhatIsBehind() {
  Image<float> map(8, 12, 1, 0.0F);
  for (int y = 0; y < 8; ++y) map.at(y, 6) = 2;

  const ViewStack<float> surfaces = surfaces_in_views(map, {0, 1}, {1, 3}, Progress());

  QCOMPARE(surfaces.view({0, 1}).at(4, 6), 2.0F);  // The view itself.
  QCOMPARE(surfaces.view({0, 2}).at(4, 4), 2.0F);  // Two px to the left, one step to the right:
  QCOMPARE(surfaces.view({0, 2}).at(4, 6), kNothingNear);  // nothing is known of what it bares.
  QCOMPARE(surfaces.view({0, 0}).at(4, 8), 2.0F);
  QCOMPARE(surfaces.view({0, 0}).at(4, 4), 0.0F);
}

}  // namespace episcope::in_plane_pm_test

EPISCOPE_TEST(plane_pm_test, PlanePmTest)
#include "plane_pm_test.moc"
