// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi_g.h"

#include "engine/disparity/epi_s.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <utility>

namespace episcope::in_epi_g_test {

using namespace episcope::test;

namespace {

EpiGParameters parameters() {
  EpiGParameters p;
  p.tensor.range = Interval{-1.2, 1.2};
  p.labels = 32;
  return p;
}

double mse(const Scene& scene, const Estimate& estimate) {
  const ViewIndex view = scene.light_field->center();
  return errors(estimate.field.disparity.view(view), scene.truth->field.view(view), 5).mse_100;
}

}  // namespace

// Without smoothness, each pixel by itself.
EpiGParameters parameters_of_single_pixels() {
  EpiGParameters p = parameters();
  p.labeling.smoothness = 0;
  p.labeling.settling = 0;
  p.line_check = {.chooses_sides = false, .is_on = false};
  p.weight_power = 2;
  return p;
}

// What one direction says of a pixel.
struct Said {
  float disparity, weight;
};

std::array<Said, 2> said(const DirectionalOrientations& both, ViewIndex view, int y, int x) {
  const auto of = [&](const Estimate& e) {
    const float r = e.confidence.view(view).at(y, x);
    return Said{e.field.disparity.view(view).at(y, x), r * r};
  };
  return {of(both.horizontal), of(both.vertical)};
}

class EpiGTest : public QObject {
  Q_OBJECT

 private slots:
  void directions_agreeWithTheirMerger();
  void directions_areUnknownWithoutViews();
  void edges_areAsGoodAsDenoised();
  void slant_isPlacedBetweenLabels();
  void weakTexture_isNotSmoothedAway();
  void smoothness_doesNotDependOnLabelCount();
  void settlingZero_keepsLabels();
  void settling_movesByAStepAtMost();
  void labels_areCheapestByTheDefinition();
  void placement_isTheMeanOfWhatAgrees();
  void note_tellsGapAndEnergy();
  void finishing_givesAnEstimate();
};

void EpiGTest::directions_agreeWithTheirMerger() {
  const Scene scene = render("slant", 40, 48, {5, 5});
  const ViewIndex view = scene.light_field->center();

  const DirectionalOrientations both =
      estimate_directions(*scene.light_field, parameters().tensor, Progress());
  const Estimate merged = estimate_orientations(*scene.light_field, parameters().tensor,
                                                ViewSelection::Center, Progress());

  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 48; ++x) {
      const auto at = [&](const Estimate& e) { return e.field.disparity.view(view).at(y, x); };
      const auto trust = [&](const Estimate& e) { return e.confidence.view(view).at(y, x); };
      const auto [low, high] = std::minmax({at(both.horizontal), at(both.vertical)});
      QVERIFY(at(merged) >= low - 1e-5F && at(merged) <= high + 1e-5F);
      QVERIFY(trust(merged) == std::max(trust(both.horizontal), trust(both.vertical)));
    }
  }
}

void EpiGTest::directions_areUnknownWithoutViews() {
  const Scene scene = render("slant", 24, 28, {1, 5});

  const DirectionalOrientations both =
      estimate_directions(*scene.light_field, parameters().tensor, Progress());

  QVERIFY(mean(both.horizontal.confidence.view({0, 2})) > 0.5);
  QCOMPARE(mean(both.vertical.confidence.view({0, 2})), 0.0);
}

void EpiGTest::edges_areAsGoodAsDenoised() {
  const Scene scene = render("edge", 96, 96, {9, 9});
  EpiSParameters denoised;
  denoised.tensor.range = parameters().tensor.range;

  const double global = mse(scene, estimate_epi_g(*scene.light_field, parameters(), Progress()));
  const double smooth =
      mse(scene, estimate_epi_s(*scene.light_field, denoised, ViewSelection::Center, Progress()));

  QVERIFY2(global < 1.1 * smooth, qPrintable(QString("%1, EPI_S %2").arg(global).arg(smooth)));
}

// Labels alone would leave step²/12 = 0.05 (MSE × 100).
void EpiGTest::slant_isPlacedBetweenLabels() {
  const Scene scene = render("slant", 80, 80, {9, 9});

  const double error = mse(scene, estimate_epi_g(*scene.light_field, parameters(), Progress()));

  QVERIFY2(error < 0.03, qPrintable(QString::number(error)));
}

// A near square, of which noise leaves little to be trusted, before a far plane.
void EpiGTest::weakTexture_isNotSmoothedAway() {
  std::mt19937 random(7);
  std::normal_distribution<float> noise(0, 0.015F);
  const auto is_near = [](double y, double x) {
    return std::max(std::fabs(y - 40), std::fabs(x - 40)) < 9;
  };
  const LightField lf =
      make_light_field({9, 9}, 80, 80, 3, [&](ViewIndex view, int y, int x, int c) {
        const auto at = [&](double d) {
          return std::pair(y + d * (view.v - 4), x + d * (view.u - 4));
        };
        const auto near = at(0.8), far = at(-0.5);
        const auto [py, px] = is_near(near.first, near.second) ? near : far;
        const double texture =
            std::sin(0.6 * px + c) + std::sin(0.5 * py) + std::sin(0.4 * (px - py));
        return static_cast<float>(0.5 + 0.015 * texture) + noise(random);
      });

  const Estimate estimate = estimate_epi_g(lf, parameters(), Progress());

  double sum = 0;
  for (int y = 35; y < 46; ++y) {
    for (int x = 35; x < 46; ++x) sum += estimate.field.disparity.view({4, 4}).at(y, x) / 121;
  }
  QVERIFY2(sum > 0.6, qPrintable(QString::number(sum)));
}

void EpiGTest::smoothness_doesNotDependOnLabelCount() {
  const Scene scene = render("objects", 64, 72, {7, 7});
  EpiGParameters few = parameters(), many = parameters();
  few.labeling.settling = many.labeling.settling = 0;
  few.labels = 25;
  many.labels = 97;
  const ViewIndex view = scene.light_field->center();

  const Estimate rough = estimate_epi_g(*scene.light_field, few, Progress());
  const Estimate fine = estimate_epi_g(*scene.light_field, many, Progress());

  int apart = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 72; ++x) {
      const float difference =
          rough.field.disparity.view(view).at(y, x) - fine.field.disparity.view(view).at(y, x);
      apart += std::fabs(difference) > 0.11F ? 1 : 0;  // a step of the few
    }
  }
  QVERIFY2(apart < 64 * 72 / 50, qPrintable(QString::number(apart)));
}

void EpiGTest::settlingZero_keepsLabels() {
  const Scene scene = render("slant", 40, 40, {5, 5});
  EpiGParameters p = parameters();
  p.labeling.settling = 0;

  const Estimate estimate = estimate_epi_g(*scene.light_field, p, Progress());

  const float* const map = estimate.field.disparity.data();
  const std::set<float> values(map, map + estimate.field.disparity.size());
  QVERIFY(values.size() > 5 && values.size() <= 32);
}

void EpiGTest::settling_movesByAStepAtMost() {
  const Scene scene = render("objects", 48, 56, {5, 5}, 1, 5);
  EpiGParameters labels = parameters(), settled = parameters();
  labels.labeling.settling = 0;
  settled.labeling.settling = 20;

  const Estimate rough = estimate_epi_g(*scene.light_field, labels, Progress());
  const Estimate smooth = estimate_epi_g(*scene.light_field, settled, Progress());

  const float* const a = rough.field.disparity.data();
  const float* const b = smooth.field.disparity.data();
  float farthest = 0;
  for (int i = 0; i < 48 * 56; ++i) farthest = std::max(farthest, std::fabs(a[i] - b[i]));
  const float step = 2.4F / 31;
  QVERIFY2(farthest < 1.0001F * step && farthest > 0.9F * step,
           qPrintable(QString("%1 steps").arg(farthest / step)));
}

void EpiGTest::labels_areCheapestByTheDefinition() {
  const Scene scene = render("objects", 40, 48, {5, 5}, 1, 8);
  const ViewIndex view = scene.light_field->center();
  const EpiGParameters p = parameters_of_single_pixels();

  const Estimate estimate = estimate_epi_g(*scene.light_field, p, Progress());

  const DirectionalOrientations both =
      estimate_directions(*scene.light_field, p.tensor, Progress());
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 48; ++x) {
      const auto directions = said(both, view, y, x);
      const auto cost = [&](double label) {
        double sum = 0;
        for (const Said& d : directions) {
          sum += d.weight * std::min(std::fabs(label - d.disparity), p.truncation);
        }
        return sum;
      };
      double least = 1e9;
      for (int l = 0; l < p.labels; ++l) least = std::min(least, cost(-1.2 + 2.4 * l / 31));
      const double found = cost(std::as_const(estimate).field.disparity.view(view).at(y, x));
      QVERIFY2(found < least + 1e-5, qPrintable(QString("%1, least %2").arg(found).arg(least)));
      QCOMPARE(estimate.confidence.view(view).at(y, x),
               std::max(both.horizontal.confidence.view(view).at(y, x),
                        both.vertical.confidence.view(view).at(y, x)));
    }
  }
}

void EpiGTest::placement_isTheMeanOfWhatAgrees() {
  const Scene scene = render("objects", 40, 48, {5, 5}, 1, 8);
  const ViewIndex view = scene.light_field->center();
  EpiGParameters p = parameters_of_single_pixels();
  const Estimate labels = estimate_epi_g(*scene.light_field, p, Progress());
  p.labeling.settling = 1e-3;  // hardly any smoothing

  const Estimate placed = estimate_epi_g(*scene.light_field, p, Progress());

  const DirectionalOrientations both =
      estimate_directions(*scene.light_field, p.tensor, Progress());
  const float step = 2.4F / 31;
  int judged = 0, outliers = 0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 48; ++x) {
      const float label = labels.field.disparity.view(view).at(y, x);
      float sum = 0, weight = 0;
      for (const Said& d : said(both, view, y, x)) {
        if (std::fabs(d.disparity - label) > step) {
          outliers += d.weight > 0.3F ? 1 : 0;
          continue;
        }
        sum += d.weight * d.disparity;
        weight += d.weight;
      }
      if (weight < 0.3F || std::fabs(sum / weight) > 1.19F) continue;  // doubtful, or cut off
      const float off = placed.field.disparity.view(view).at(y, x) - sum / weight;
      // The label itself counts a hundredth; smoothing moves by less than 4·λ/weight.
      QVERIFY2(std::fabs(off) < 5e-3F, qPrintable(QString::number(off)));
      ++judged;
    }
  }
  QVERIFY2(judged > 800 && outliers > 50, qPrintable(QString("%1 %2").arg(judged).arg(outliers)));
}

void EpiGTest::note_tellsGapAndEnergy() {
  const Scene scene = render("edge", 40, 40, {5, 5});

  const Estimate estimate = estimate_epi_g(*scene.light_field, parameters(), Progress());

  const QString note = QString::fromStdString(estimate.notes.back());
  const auto match =
      QRegularExpression("energy ([0-9.e+]+), gap ([0-9.e+-]+) after ([0-9]+)").match(note);
  QVERIFY2(match.hasMatch(), qPrintable(note));
  QVERIFY(match.captured(2).toDouble() <= parameters().labeling.gap);
}

void EpiGTest::finishing_givesAnEstimate() {
  const Scene scene = render("edge", 40, 40, {5, 5});
  std::stop_source finish;
  finish.request_stop();
  EpiGParameters p = parameters();
  p.labeling.gap = 1e-6;

  const Estimate estimate =
      estimate_epi_g(*scene.light_field, p, Progress({}, finish.get_token(), {}));

  QVERIFY(all_finite(estimate.field.disparity));
  QVERIFY(QString::fromStdString(estimate.notes.back()).contains("ended early"));
}

}  // namespace episcope::in_epi_g_test

EPISCOPE_TEST(epi_g_test, EpiGTest)
#include "epi_g_test.moc"
