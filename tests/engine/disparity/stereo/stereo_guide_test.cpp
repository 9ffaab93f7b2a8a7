// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/stereo_costs.h"

#include "engine/scenes/stage.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <cmath>
#include <memory>

namespace episcope::in_stereo_guide_test {

using namespace episcope::test;

namespace {

constexpr int kSize = 24;
constexpr int kEdge = 12;

// Two flat halves that differ little, and noise.
LightField halves(float contrast, float noise) {
  return make_light_field({3, 3}, kSize, kSize, 3, [=](ViewIndex view, int y, int x, int c) {
    const std::uint64_t ray = (std::uint64_t(view.v * 3 + view.u) * kSize + y) * kSize + x;
    return 0.2F + (x < kEdge ? 0 : contrast) + noise * scenes::sensor_noise(1, ray * 3 + c);
  });
}

StereoCostParameters parameters_of_test() {
  StereoCostParameters parameters;
  parameters.range = Interval{-0.1, 0.1};
  parameters.labels = 2;
  return parameters;
}

StereoCosts prepared(const LightField& lf) {
  return prepare_stereo(lf, MatchedViews::All, parameters_of_test(), Progress());
}

// Filters what is `left` beyond the edge and 1 on this side of it.
Volume<float> filtered_step(const GuideImage& guide) {
  Volume<float> step(kSize, 1, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) step.view().at(y, 0, x) = x < kEdge ? 0 : 1;
  }
  GuidedFilter(guide).apply(0, step.view(), Progress());
  return step;
}

// Of a value drawn with even odds.
double spread(const GuideImage& guide) {
  Volume<float> random(kSize, 1, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      random.view().at(y, 0, x) = scenes::sensor_noise(7, std::uint64_t(y) * kSize + x);
    }
  }
  GuidedFilter(guide).apply(0, random.view(), Progress());
  double squares = 0;
  for (int y = 4; y < kSize - 4; ++y) {
    for (int x = 4; x < kSize - 4; ++x) squares += std::pow(random.view().at(y, 0, x), 2);
  }
  return std::sqrt(squares / ((kSize - 8) * (kSize - 8)));
}

}  // namespace

class StereoGuideTest : public QObject {
  Q_OBJECT

 private slots:
  void weakEdge_isKept();
  void noise_isNoEdge();
  void withoutAggregation_isNone();
};

void StereoGuideTest::weakEdge_isKept() {
  const LightField lf = halves(0.03F, 0);

  const Volume<float> step = filtered_step(*prepared(lf).guide);

  const float beside = step.view().at(kSize / 2, 0, kEdge - 1);
  QVERIFY2(beside < 0.05F, qPrintable(QString::number(beside)));
}

// Beyond what the windows share: with a guide that follows its noise, costs keep theirs.
void StereoGuideTest::noise_isNoEdge() {
  constexpr float noise = 0.02F;
  const LightField lf = halves(0, noise);
  const StereoCosts costs = prepared(lf);

  const double own = spread(*costs.guide);

  const double least = spread(GuideImage(lf, costs.view, costs.guide->radius(), 1e-6, Progress()));
  QVERIFY2(own < 0.6 * least, qPrintable(QString("%1, %2").arg(own).arg(least)));
}

void StereoGuideTest::withoutAggregation_isNone() {
  StereoCostParameters parameters = parameters_of_test();
  parameters.aggregation = 0;

  QVERIFY(!prepare_stereo(halves(0.03F, 0), MatchedViews::All, parameters, Progress()).guide);
}

}  // namespace episcope::in_stereo_guide_test

EPISCOPE_TEST(stereo_guide_test, StereoGuideTest)
#include "stereo_guide_test.moc"
