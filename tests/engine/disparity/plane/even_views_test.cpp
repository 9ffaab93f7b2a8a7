// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane_pm.h"

#include "engine/core/view_gain.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <cmath>

namespace episcope::in_even_views_test {

using namespace episcope::test;

namespace {

constexpr double kFallOff = 0.35;

double gain_of(ViewIndex view) {
  return 1 + 0.02 * (view.u - 2) - 0.03 * (view.v - 2);
}

double light_at(const LightField& lf, int y, int x) {
  const double cy = 0.5 * (lf.height() - 1), cx = 0.5 * (lf.width() - 1);
  return 1 - kFallOff * ((y - cy) * (y - cy) + (x - cx) * (x - cx)) / (cy * cy + cx * cx);
}

// The scene's samples, halved, of views that are unlike each other.
LightField uneven(const Scene& scene) {
  const LightField& lf = *scene.light_field;
  const ViewStack<float> samples = float_samples(lf);
  return like(lf, [&](ViewIndex view, int y, int x, int c) {
    const double sample = 0.6 * samples.view(view).at(y, x, c);
    return static_cast<float>(sample * gain_of(view) * light_at(lf, y, x));
  });
}

}  // namespace

class EvenViewsTest : public QObject {
  Q_OBJECT

 private slots:
  void gainsAndFallOff_areFound();
  void evenLightField_isKnownAsSuch();
  void evenedViews_areAlike();
};

void EvenViewsTest::gainsAndFallOff_areFound() {
  const Scene scene = render("objects", 128, 128, {5, 5});
  const LightField lf = uneven(scene);
  const DisparityView truth = scene.truth->field.view(lf.center());

  const PhotometricCorrection found =
      correction_of_points(lf, lf.center(), truth.disparity, Progress());

  QVERIFY(found.is_uneven());
  QVERIFY2(std::abs(found.fall_off - kFallOff) < 0.05, qPrintable(QString::number(found.fall_off)));
  for (int i = 0; i < lf.grid().count(); ++i) {
    const double off = found.gains[i][1] / gain_of(lf.grid().view_at(i)) - 1;
    QVERIFY2(std::abs(off) < 0.004, qPrintable(QString::number(off)));
  }
}

void EvenViewsTest::evenLightField_isKnownAsSuch() {
  const Scene scene = render("objects", 96, 96, {5, 5}, 1, 5);
  const LightField& lf = *scene.light_field;
  const DisparityView truth = scene.truth->field.view(lf.center());

  QVERIFY(!gains_of_means(lf, lf.center(), Progress()).is_uneven());
  QVERIFY(!correction_of_points(lf, lf.center(), truth.disparity, Progress()).is_uneven());
}

void EvenViewsTest::evenedViews_areAlike() {
  const Scene scene = render("fronto", 48, 48, {3, 3});
  const ViewStack<float> samples = float_samples(*scene.light_field);
  PhotometricCorrection correction;
  correction.gains.assign(9, {0.5, 0.5, 0.5});
  const LightField dim = like(*scene.light_field, [&](ViewIndex view, int y, int x, int c) {
    return 0.5F * samples.view(view).at(y, x, c);
  });

  const LightField evened = corrected(dim, correction, Progress());

  QVERIFY(largest_difference(evened.view_as_float({0, 2}).view(), samples.view({0, 2})) < 1e-4);
}

}  // namespace episcope::in_even_views_test

EPISCOPE_TEST(even_views_test, EvenViewsTest)
#include "even_views_test.moc"
