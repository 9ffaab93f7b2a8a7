// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/propagate_planes.h"

#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

namespace episcope::in_carried_sides_test {

using namespace episcope::test;

namespace {

constexpr float kCap = 0.05F;

// The truth of all views, every row of it `shift` px to the right.
Estimate shifted_truth(const Scene& scene, int shift) {
  const LightField& lf = *scene.light_field;
  Estimate estimate;
  estimate.field.disparity = ViewStack<float>(lf.grid(), lf.height(), lf.width());
  for (int i = 0; i < lf.grid().count(); ++i) {
    const ViewIndex view = lf.grid().view_at(i);
    const ImageView<const float> truth = scene.truth->field.view(view).disparity;
    const ImageView<float> map = estimate.field.disparity.view(view);
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) map.at(y, x) = truth.at(y, std::max(x - shift, 0));
    }
  }
  return estimate;
}

double mean_error(const Scene& scene, const Estimate& estimate) {
  double sum = 0;
  const GridShape grid = scene.light_field->grid();
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = grid.view_at(i);
    sum += errors(estimate.field.disparity.view(view), scene.truth->field.view(view), 5).mse_100;
  }
  return sum / grid.count();
}

Estimate chosen(const Scene& scene, int shift, const Progress& progress = Progress()) {
  Estimate estimate = shifted_truth(scene, shift);
  choose_propagated_sides(pack_views(*scene.light_field, progress), kCap, estimate, progress);
  return estimate;
}

}  // namespace

class CarriedSidesTest : public QObject {
  Q_OBJECT

 private slots:
  void misplacedSilhouettes_moveBack();
  void rightSilhouettes_stay();
  void threads_changeNothing();
};

void CarriedSidesTest::misplacedSilhouettes_moveBack() {
  const Scene scene = render("edge", 64, 80, {5, 5});
  const double before = mean_error(scene, shifted_truth(scene, 1));

  const double after = mean_error(scene, chosen(scene, 1));

  QVERIFY2(after < 0.3 * before, qPrintable(QString("%1, was %2").arg(after).arg(before)));
}

void CarriedSidesTest::rightSilhouettes_stay() {
  const Scene scene = render("edge", 64, 80, {5, 5});
  const double wrong = mean_error(scene, shifted_truth(scene, 1));

  const double error = mean_error(scene, chosen(scene, 0));

  QVERIFY2(error < 0.3 * wrong, qPrintable(QString("%1, by a px %2").arg(error).arg(wrong)));
}

void CarriedSidesTest::threads_changeNothing() {
  const Scene scene = render("bars", 48, 64, {3, 3});

  const Estimate one = chosen(scene, 1, Progress(1));
  const Estimate three = chosen(scene, 1, Progress(3));

  QVERIFY(same_bytes(one.field.disparity, three.field.disparity));
}

}  // namespace episcope::in_carried_sides_test

EPISCOPE_TEST(carried_sides_test, CarriedSidesTest)
#include "carried_sides_test.moc"
