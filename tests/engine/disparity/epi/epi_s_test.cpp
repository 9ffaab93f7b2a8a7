// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi_s.h"

#include "engine/disparity/denoise.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>

namespace episcope::in_epi_s_test {

using namespace episcope::test;

namespace {

EpiSParameters parameters() {
  EpiSParameters p;
  p.tensor.range = Interval{-1.2, 1.2};
  return p;
}

Estimate epi_l(const LightField& lf) {
  return estimate_epi_l(lf, parameters().tensor, ViewSelection::All, Progress());
}

Estimate epi_s(const LightField& lf, const EpiSParameters& p = parameters()) {
  return estimate_epi_s(lf, p, ViewSelection::All, Progress());
}

double mse(const Scene& scene, const Estimate& estimate, ViewIndex view) {
  return errors(estimate.field.disparity.view(view), scene.truth->field.view(view), 15).mse_100;
}

// Sum of |∇u| of a map, forward differences.
double variation(const ImageView<const float>& map) {
  double sum = 0;
  for (int y = 0; y + 1 < map.height; ++y) {
    for (int x = 0; x + 1 < map.width; ++x) {
      sum += std::hypot(map.at(y, x + 1) - map.at(y, x), map.at(y + 1, x) - map.at(y, x));
    }
  }
  return sum;
}

// A light field of one view, grey, left half dark and right half bright.
LightField step_light_field() {
  return make_light_field({1, 1}, 6, 8, 1,
                          [](ViewIndex, int, int x, int) { return x < 4 ? 0.25F : 0.75F; });
}

}  // namespace

class EpiSTest : public QObject {
  Q_OBJECT

 private slots:
  void noisyScene_isBetterThanLocal_data();
  void noisyScene_isBetterThanLocal();
  void frontoPlane_staysWithinLimit();
  void smoothing_growsWithLambda();
  void weights_areConfidencesRaisedAtLeastSoMuch();
  void gap_isTheLargestOfAllViews();
  void least_lambda_leavesLocalResult();
  void confidence_isThatOfLocalResult();
  void plainMethod_runs();
  void notes_holdTheGap();
  void edgeWeights_areLessAtEdges();
  void edgeWeights_withoutStrengthAreOne();
  void edgeWeights_sumChannels();
  void edgeWeights_leaveNoiseOut();
};

void EpiSTest::noisyScene_isBetterThanLocal_data() {
  QTest::addColumn<QString>("id");
  QTest::newRow("fronto") << "fronto";
  QTest::newRow("slant") << "slant";
  QTest::newRow("edge") << "edge";
  QTest::newRow("objects") << "objects";
}

void EpiSTest::noisyScene_isBetterThanLocal() {
  QFETCH(QString, id);
  const Scene scene = render(id.toStdString(), 96, 96, {7, 7}, 0.7, 5);
  const Estimate local = epi_l(*scene.light_field);
  const Estimate smooth = epi_s(*scene.light_field);
  for (const ViewIndex view : {ViewIndex{3, 3}, ViewIndex{0, 0}, ViewIndex{6, 2}}) {
    const double before = mse(scene, local, view);
    const double after = mse(scene, smooth, view);
    QVERIFY2(after < before, qPrintable(QString("%1 before, %2 after").arg(before).arg(after)));
  }
}

void EpiSTest::frontoPlane_staysWithinLimit() {
  const Scene scene = render("fronto", 80, 80);
  const Errors off = errors(epi_s(*scene.light_field).field.disparity.view({4, 4}),
                            scene.truth->field.view({4, 4}), 15);
  QVERIFY2(std::fabs(off.bias) < 0.005 && off.mse_100 < 0.01,
           qPrintable(QString("bias %1, MSE %2").arg(off.bias).arg(off.mse_100)));
}

void EpiSTest::weights_areConfidencesRaisedAtLeastSoMuch() {
  Image<float> confidence(1, 3), weights(1, 3);
  confidence.at(0, 0) = 0.9F;
  confidence.at(0, 1) = 0.1F;
  for (const double power : {6.0, 2.5, 0.0}) {
    fill_data_weights(confidence, {power, 0.02F}, weights);
    for (int x = 0; x < 3; ++x) {
      const double raised = std::pow(confidence.at(0, x), power);
      QVERIFY(std::fabs(weights.at(0, x) - std::max(raised, 0.02)) < 1e-6);
    }
  }
}

// The second view is flat: nothing is left to be done there.
void EpiSTest::gap_isTheLargestOfAllViews() {
  const LightField lf =
      make_light_field({1, 2}, 24, 30, 1, [](ViewIndex, int, int, int) { return 0.5F; });
  Estimate estimate;
  estimate.field.disparity = ViewStack<float>({1, 2}, 24, 30);
  estimate.confidence = ViewStack<float>({1, 2}, 24, 30);
  std::fill_n(estimate.confidence.data(), estimate.confidence.size(), 1.0F);
  for (std::size_t i = 0; i < estimate.confidence.size(); ++i) {
    estimate.field.disparity.data()[i] = i < 24 * 30 ? static_cast<float>(i * i % 7) : 0.25F;
  }
  EpiSParameters hasty = parameters();
  hasty.denoising.stop.max_iterations = 1;

  denoise(lf, hasty.denoising, estimate, Progress());

  const QString note = QString::fromStdString(estimate.notes.back());
  QVERIFY2(note.section(' ', -1).toDouble() > 1e-3, qPrintable(note));
}

void EpiSTest::smoothing_growsWithLambda() {
  const Scene scene = render("slant", 64, 64, {5, 5}, 1, 8);
  double before = variation(epi_l(*scene.light_field).field.disparity.view({2, 2}));
  for (const double lambda : {0.02, 0.1, 0.5}) {
    EpiSParameters p = parameters();
    p.denoising.lambda = lambda;
    const double now = variation(epi_s(*scene.light_field, p).field.disparity.view({2, 2}));
    QVERIFY2(now < before,
             qPrintable(QString("%1 at λ = %2, was %3").arg(now).arg(lambda).arg(before)));
    before = now;
  }
}

// λ = 0.001 with weights of 1 moves a pixel by at most 4 λ = 0.004 px.
void EpiSTest::least_lambda_leavesLocalResult() {
  const Scene scene = render("slant", 48, 64, {5, 5});
  EpiSParameters p = parameters();
  p.denoising.lambda = 0.001;
  p.denoising.weight_power = 0;
  p.denoising.edge_strength = 0;
  p.line_check.chooses_sides = false;
  const Estimate local = epi_l(*scene.light_field);
  const Estimate smooth = epi_s(*scene.light_field, p);
  QVERIFY(largest_difference(local.field.disparity.view({2, 2}),
                             smooth.field.disparity.view({2, 2})) < 0.0041);
}

void EpiSTest::confidence_isThatOfLocalResult() {
  const Scene scene = render("edge", 40, 50, {3, 3});
  EpiSParameters p = parameters();
  p.line_check = {.chooses_sides = false, .is_on = false};
  QVERIFY(
      same_bytes(epi_l(*scene.light_field).confidence, epi_s(*scene.light_field, p).confidence));
}

// Without weights it is the method of the paper; it must help on noise as well.
void EpiSTest::plainMethod_runs() {
  const Scene scene = render("slant", 80, 80, {7, 7}, 1, 5);
  EpiSParameters p = parameters();
  p.denoising.weight_power = 0;
  p.denoising.edge_strength = 0;
  p.denoising.lambda = 0.05;
  const double before = mse(scene, epi_l(*scene.light_field), {3, 3});
  const double after = mse(scene, epi_s(*scene.light_field, p), {3, 3});
  QVERIFY2(after < before, qPrintable(QString("%1 before, %2 after").arg(before).arg(after)));
}

void EpiSTest::notes_holdTheGap() {
  const Scene scene = render("edge", 40, 50, {3, 3});
  const Estimate estimate = epi_s(*scene.light_field);
  QCOMPARE(estimate.notes.size(), std::size_t{1});
  const QString note = QString::fromStdString(estimate.notes.front());
  QVERIFY(note.startsWith("largest relative duality gap "));
  const double gap = note.section(' ', -1).toDouble();
  // 30 iterations reach a few 10⁻³ of the energy, far below what the eye or MSE can tell.
  QVERIFY2(gap > 0 && gap < 0.05, qPrintable(note));
}

void EpiSTest::edgeWeights_areLessAtEdges() {
  const Image<float> weights = smoothness_weights(step_light_field(), {0, 0}, 10);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 8; ++x) {
      // One channel counts as three equal ones.
      const double expected = x == 3 ? std::exp(-10 * std::sqrt(3) * 0.5) : 1.0;
      QVERIFY(std::fabs(weights.at(y, x) - expected) < 1e-6);
    }
  }
}

void EpiSTest::edgeWeights_withoutStrengthAreOne() {
  const Image<float> weights = smoothness_weights(step_light_field(), {0, 0}, 0);
  QVERIFY(std::all_of(weights.begin(), weights.end(), [](float w) { return w == 1.0F; }));
}

// |∇I| over both directions and all channels: √(2 · 3 · 0.1²) at the corner of a bright square.
void EpiSTest::edgeWeights_sumChannels() {
  const LightField lf = make_light_field(
      {1, 1}, 4, 4, 3, [](ViewIndex, int y, int x, int) { return x <= 1 && y <= 1 ? 0.4F : 0.3F; });
  const Image<float> weights = smoothness_weights(lf, {0, 0}, 2);
  QVERIFY(std::fabs(weights.at(1, 1) - std::exp(-2 * std::sqrt(0.06))) < 1e-5);
  QVERIFY(std::fabs(weights.at(0, 1) - std::exp(-2 * std::sqrt(0.03))) < 1e-5);
  QCOMPARE(weights.at(3, 3), 1.0F);
}

// What noise adds to |∇I|² of one channel is 4σ²: 1 − 4·0.2² of the step is left, and nothing less
// than 0.
void EpiSTest::edgeWeights_leaveNoiseOut() {
  const Image<float> weights = smoothness_weights(step_light_field(), {0, 0}, 10, 0.2 * 0.2);
  QVERIFY(std::fabs(weights.at(2, 3) - std::exp(-10 * std::sqrt(3 * (0.25 - 0.16)))) < 1e-5);
  QCOMPARE(weights.at(2, 5), 1.0F);
  QCOMPARE(smoothness_weights(step_light_field(), {0, 0}, 10, 1).at(2, 3), 1.0F);
}

}  // namespace episcope::in_epi_s_test

EPISCOPE_TEST(epi_s_test, EpiSTest)
#include "epi_s_test.moc"
