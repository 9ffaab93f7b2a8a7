// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/propagate_planes.h"

#include "engine/core/error.h"
#include "engine/disparity/epi_c.h"
#include "engine/disparity/plane_pm.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

namespace episcope::in_carry_test {

using namespace episcope::test;

namespace {

// A bar of disparity 2, columns 6 to 9, before a background of 0.
Estimate bar(ViewIndex view) {
  Estimate map;
  map.field.disparity = ViewStack<float>({1, 1}, 8, 16, 1, view);
  map.confidence = ViewStack<float>({1, 1}, 8, 16, 1, view);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      map.field.disparity.view(view).at(y, x) = x >= 6 && x < 10 ? 2.0F : 0.0F;
      map.confidence.view(view).at(y, x) = 1;
    }
  }
  return map;
}

double mean_error(const Scene& scene, const ViewStack<float>& disparity) {
  double sum = 0;
  const GridShape grid = disparity.grid();
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = grid.view_at(i);
    sum += errors(disparity.view(view), scene.truth->field.view(view), 5).mse_100;
  }
  return sum / grid.count();
}

}  // namespace

class CarryTest : public QObject {
  Q_OBJECT

 private slots:
  void surfaces_moveAndHide();
  void withoutMaps_isRefused();
  void allViews_areCloseAndInOrder();
  void finish_givesAllViews();
};

void CarryTest::surfaces_moveAndHide() {
  std::vector<Estimate> maps;
  maps.push_back(bar({0, 1}));

  const PropagatedMaps all = propagate_to_views(maps, {{}, {1, 3}}, Progress());

  const ImageView<const float> right = all.disparity.view({0, 2});
  QCOMPARE(right.at(3, 4), 2.0F);  // Two px to the left, one step to the right,
  QCOMPARE(right.at(3, 7), 2.0F);
  QCOMPARE(right.at(3, 8), 0.0F);  // and what it has uncovered continues the background,
  QCOMPARE(right.at(3, 3), 0.0F);
  QCOMPARE(all.confidence.view({0, 2}).at(3, 8), 0.0F);  // of which nothing is known.
  QCOMPARE(all.confidence.view({0, 2}).at(3, 5), 1.0F);
  QVERIFY(largest_difference(all.disparity.view({0, 1}), maps[0].field.disparity.view({0, 1})) ==
          0);
}

void CarryTest::withoutMaps_isRefused() {
  QVERIFY_THROWS_EXCEPTION(InvalidInput,
                           static_cast<void>(propagate_to_views({}, {{}, {1, 3}}, Progress())));
}

void CarryTest::allViews_areCloseAndInOrder() {
  const Scene scene = render("edge", 96, 112, {5, 5});
  const Estimate planes = estimate_planes(*scene.light_field, {}, ViewSelection::All, Progress());
  const Estimate ordered = estimate_epi_c(*scene.light_field, {}, ViewSelection::All, Progress());

  const double error = mean_error(scene, planes.field.disparity);
  const double violations = ordering_violations(planes.field.disparity, Progress());
  const double limit = ordering_violations(ordered.field.disparity, Progress());

  QVERIFY(planes.field.disparity.grid() == scene.light_field->grid());
  QVERIFY2(error < 0.07, qPrintable(QString::number(error)));
  QVERIFY2(violations <= limit, qPrintable(QString("%1, EPI_C %2").arg(violations).arg(limit)));
}

void CarryTest::finish_givesAllViews() {
  const Scene scene = render("edge", 64, 64, {3, 3});
  std::stop_source finish;
  finish.request_stop();
  const Progress progress({}, finish.get_token(), {});

  const Estimate planes = estimate_planes(*scene.light_field, {}, ViewSelection::All, progress);

  QCOMPARE(planes.field.disparity.grid().count(), 9);
  QVERIFY(all_finite(planes.field.disparity));
}

}  // namespace episcope::in_carry_test

EPISCOPE_TEST(carry_test, CarryTest)
#include "carry_test.moc"
