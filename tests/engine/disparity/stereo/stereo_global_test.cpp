// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/stereo.h"

#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <cmath>
#include <set>

namespace episcope::in_stereo_global_test {

using namespace episcope::test;

namespace {

StereoGlobalParameters parameters() {
  StereoGlobalParameters p;
  p.matching.range = Interval{-1.9, 1.9};
  return p;
}

double mse(const Scene& scene, const Estimate& estimate) {
  const ViewIndex view = scene.light_field->center();
  return errors(estimate.field.disparity.view(view), scene.truth->field.view(view), 5).mse_100;
}

void add_views() {
  QTest::addColumn<bool>("all");
  QTest::newRow("all views") << true;
  QTest::newRow("cross-hair") << false;
}

MatchedViews fetched() {
  QFETCH(bool, all);
  return all ? MatchedViews::All : MatchedViews::CrossHair;
}

}  // namespace

class StereoGlobalTest : public QObject {
  Q_OBJECT

 private slots:
  void noisyScene_isBetterThanLocal_data() { add_views(); }
  void noisyScene_isBetterThanLocal();
  void slant_isPlacedBetweenLabels_data() { add_views(); }
  void slant_isPlacedBetweenLabels();
  void flatPatch_isPlacedByItsSurroundings();
  void confidence_isThatOfTheLocalMethod_data() { add_views(); }
  void confidence_isThatOfTheLocalMethod();
  void paperProfile_keepsLabels_data() { add_views(); }
  void paperProfile_keepsLabels();
  void paperProfile_keepsThinBars_data() { add_views(); }
  void paperProfile_keepsThinBars();
  void anyView_isEstimated();
  void threads_changeNothing();
};

void StereoGlobalTest::noisyScene_isBetterThanLocal() {
  const Scene scene = render("objects", 160, 192, {5, 5}, 1, 5);
  StereoLocalParameters local;
  local.matching.range = parameters().matching.range;

  const double global =
      mse(scene, estimate_stereo_global(*scene.light_field, fetched(), parameters(), Progress()));
  const double without =
      mse(scene, estimate_stereo_local(*scene.light_field, fetched(), local, Progress()));

  QVERIFY2(global < 0.8 * without, qPrintable(QString("%1, local %2").arg(global).arg(without)));
}

// Labels alone would leave step²/12 = 0.03 (MSE × 100).
void StereoGlobalTest::slant_isPlacedBetweenLabels() {
  const Scene scene = render("slant", 64, 64, {5, 5});

  const double error =
      mse(scene, estimate_stereo_global(*scene.light_field, fetched(), parameters(), Progress()));

  QVERIFY2(error < 0.02, qPrintable(QString::number(error)));
}

// Costs of a patch without texture say nothing of places between labels: it must take that of the
// plane around it, a fifth of a label beside the nearest one, 0.06 px.
void StereoGlobalTest::flatPatch_isPlacedByItsSurroundings() {
  constexpr double d = 0.37;
  const LightField lf = make_light_field({5, 5}, 48, 48, 1, [](ViewIndex view, int y, int x, int) {
    const double py = y + d * (view.v - 2), px = x + d * (view.u - 2);
    const bool is_patch = std::fabs(py - 24) < 9 && std::fabs(px - 24) < 9;
    // One channel counts as three equal ones, whose difference is √3 times its own.
    const double texture = 0.2 / std::sqrt(3) * (std::sin(0.9 * px) + std::sin(0.8 * py));
    return static_cast<float>(0.5 + (is_patch ? 0 : texture));
  });
  StereoGlobalParameters p = parameters();
  p.matching.range = Interval{-1, 1};
  p.matching.labels = 8;

  const Estimate estimate = estimate_stereo_global(lf, MatchedViews::All, p, Progress());

  double sum = 0;
  for (int y = 18; y < 31; ++y) {
    for (int x = 18; x < 31; ++x) {
      sum += std::fabs(estimate.field.disparity.view({2, 2}).at(y, x) - d) / (13 * 13);
    }
  }
  QVERIFY2(sum < 0.06 / 2, qPrintable(QString::number(sum)));
}

void StereoGlobalTest::confidence_isThatOfTheLocalMethod() {
  const Scene scene = render("fronto", 64, 64, {5, 5}, 1, 2);
  StereoLocalParameters local;
  local.matching.range = parameters().matching.range;

  const ViewIndex view = scene.light_field->center();
  const Estimate global =
      estimate_stereo_global(*scene.light_field, fetched(), parameters(), Progress());
  const Estimate by_pixel = estimate_stereo_local(*scene.light_field, fetched(), local, Progress());

  // One plane: the labels are the same but for a few of neighboring ones.
  const double off = mean(global.confidence.view(view)) - mean(by_pixel.confidence.view(view));
  QVERIFY2(std::fabs(off) < 0.01, qPrintable(QString::number(off)));
}

void StereoGlobalTest::paperProfile_keepsLabels() {
  const Scene scene = render("edge", 40, 48, {5, 5});
  const Schema<StereoGlobalParameters> schema = stereo_global_schema(fetched());
  const StereoGlobalParameters paper =
      schema.parse({{"profile", std::string("paper")}, {"labels", 16}});

  const Estimate estimate =
      estimate_stereo_global(*scene.light_field, fetched(), paper, Progress());

  const float* const map = estimate.field.disparity.data();
  const std::set<float> values(map, map + estimate.field.disparity.size());
  QVERIFY(values.size() > 1 && values.size() <= 16);
}

// Uncapped costs ask for little smoothness.
void StereoGlobalTest::paperProfile_keepsThinBars() {
  const Scene scene = render("bars", 96, 96, {5, 5});
  const auto error = [&](const ParameterSet& values) {
    const auto paper = stereo_global_schema(fetched()).parse(values);
    return mse(scene, estimate_stereo_global(*scene.light_field, fetched(), paper, Progress()));
  };
  const std::pair<std::string, ParameterValue> profile{"profile", std::string("paper")};
  const std::pair<std::string, ParameterValue> range{"range", Interval{-0.55, 0.85}};

  const double paper = error({profile, range});
  const double smoother = error({profile, range, {"smoothness", 5 * kPaperSmoothness}});

  QVERIFY2(paper < 0.95 * smoother, qPrintable(QString("%1, %2").arg(paper).arg(smoother)));
}

void StereoGlobalTest::anyView_isEstimated() {
  const Scene scene = render("edge", 48, 56, {5, 5});
  StereoGlobalParameters p = parameters();
  const ViewIndex corner{0, 4};
  p.matching.view = corner;

  const Estimate estimate =
      estimate_stereo_global(*scene.light_field, MatchedViews::All, p, Progress());

  QVERIFY(estimate.field.contains(corner));
  QVERIFY(
      errors(estimate.field.disparity.view(corner), scene.truth->field.view(corner), 8).mse_100 <
      1);
}

void StereoGlobalTest::threads_changeNothing() {
  const Scene scene = render("objects", 70, 60, {5, 5});

  const Estimate one = estimate_stereo_global(*scene.light_field, MatchedViews::CrossHair,
                                              parameters(), Progress(1));
  const Estimate four = estimate_stereo_global(*scene.light_field, MatchedViews::CrossHair,
                                               parameters(), Progress(4));

  QVERIFY(same_bytes(one.field.disparity, four.field.disparity));
  QVERIFY(same_bytes(one.confidence, four.confidence));
}

}  // namespace episcope::in_stereo_global_test

EPISCOPE_TEST(stereo_global_test, StereoGlobalTest)
#include "stereo_global_test.moc"
