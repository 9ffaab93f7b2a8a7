// SPDX-License-Identifier: BSD-3-Clause
// What the confidence of EPI_L says, and that a result depends on nothing but its input.
#include "engine/disparity/epi_l.h"
#include "engine/disparity/epi_s.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace episcope::in_confidence_test {

using namespace episcope::test;

namespace {

LightField noise(GridShape grid, int height, int width) {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> byte(0, 255);
  ViewStack<std::uint8_t> samples(grid, height, width, 3);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples.data()[i] = static_cast<std::uint8_t>(byte(random));
  }
  return {std::move(samples), {}};
}

Estimate epi_l(const LightField& lf, ViewSelection views = ViewSelection::All, int threads = 0) {
  return estimate_epi_l(lf, {.range = Interval{-1.2, 1.2}}, views, Progress(threads));
}

Estimate epi_s(const LightField& lf, ViewSelection views = ViewSelection::All, int threads = 0) {
  return estimate_epi_s(lf, {.tensor = {.range = Interval{-1.2, 1.2}}}, views, Progress(threads));
}

}  // namespace

class ConfidenceTest : public QObject {
  Q_OBJECT

 private slots:
  void constantLightField_hasNoConfidence();
  void noise_hasLittleConfidence();
  void cleanTexture_hasConfidence();
  void disparityBeyondRange_hasNoConfidence();
  void range_isNeverLeft();
  void faintTexture_losesConfidence();
  void confidence_liesInUnitInterval();
  void epiL_isTheSameForAnyThreadCount();
  void epiS_isTheSameForAnyThreadCount();
  void centerOnly_equalsCenterOfAllViews();
  void epiS_ofCenterEqualsCenterOfAllViews();
};

void ConfidenceTest::constantLightField_hasNoConfidence() {
  const LightField lf =
      make_light_field({5, 5}, 40, 50, 3, [](ViewIndex, int, int, int) { return 0.4F; });
  for (const Estimate& estimate : {epi_l(lf), epi_s(lf)}) {
    QVERIFY(all_finite(estimate.field.disparity));
    for (std::size_t i = 0; i < estimate.confidence.size(); ++i) {
      // Filters of a constant leave differences of the last place, far below the noise floor.
      QVERIFY(estimate.confidence.data()[i] < 1e-6F);
    }
  }
}

// Lines in all directions: the most coherent of several shears is still far from a clean line.
void ConfidenceTest::noise_hasLittleConfidence() {
  const LightField lf = noise({9, 9}, 64, 64);
  const Estimate estimate = epi_l(lf, ViewSelection::Center);
  const double r = mean(estimate.confidence.view({4, 4}));
  QVERIFY2(r < 0.6, qPrintable(QString::number(r)));
  QVERIFY(all_finite(estimate.field.disparity));
}

void ConfidenceTest::cleanTexture_hasConfidence() {
  const Scene scene = render("fronto", 64, 64);
  const double r = mean(epi_l(*scene.light_field).confidence.view({4, 4}), 10);
  QVERIFY2(r > 0.98, qPrintable(QString::number(r)));
}

void ConfidenceTest::disparityBeyondRange_hasNoConfidence() {
  const Scene scene = render("fronto", 64, 64);
  const Interval range{-1.5, -0.5};
  const Estimate estimate =
      estimate_epi_l(*scene.light_field, {.range = range}, ViewSelection::Center, Progress());
  const ImageView<const float> map = estimate.field.disparity.view({4, 4});
  const ImageView<const float> r = estimate.confidence.view({4, 4});
  QVERIFY(mean(r, 10) < 0.2);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const bool in_range = map.at(y, x) >= range.min && map.at(y, x) <= range.max;
      QVERIFY(in_range || r.at(y, x) == 0);
    }
  }
}

void ConfidenceTest::range_isNeverLeft() {
  const Scene scene = render("objects", 48, 56, {5, 5}, 1, 5);
  const Interval range{-0.3, 0.4};
  for (const bool smooth : {false, true}) {
    const Estimate estimate =
        smooth
            ? estimate_epi_s(*scene.light_field, {.tensor = {.range = range}}, ViewSelection::All,
                             Progress())
            : estimate_epi_l(*scene.light_field, {.range = range}, ViewSelection::All, Progress());
    const ViewStack<float>& map = estimate.field.disparity;
    const auto [least, most] = std::minmax_element(map.data(), map.data() + map.size());
    QCOMPARE(*least, static_cast<float>(range.min));
    QCOMPARE(*most, static_cast<float>(range.max));
  }
}

// The same texture at a thousandth of its contrast, below the noise floor of 0.15/255.
void ConfidenceTest::faintTexture_losesConfidence() {
  const Scene scene = render("fronto", 48, 48, {5, 5});
  const ViewStack<float> samples = float_samples(*scene.light_field);
  const LightField faint = like(*scene.light_field, [&](ViewIndex view, int y, int x, int c) {
    return 0.5F + 1e-3F * samples.view(view).at(y, x, c);
  });
  const double r = mean(epi_l(faint).confidence.view({2, 2}), 8);
  QVERIFY2(r < 0.5, qPrintable(QString::number(r)));
}

void ConfidenceTest::confidence_liesInUnitInterval() {
  const Scene scene = render("objects", 60, 70, {5, 5}, 1, 5);
  const Estimate estimate = epi_l(*scene.light_field);
  for (std::size_t i = 0; i < estimate.confidence.size(); ++i) {
    QVERIFY(estimate.confidence.data()[i] >= 0 && estimate.confidence.data()[i] <= 1.00001F);
  }
}

void ConfidenceTest::epiL_isTheSameForAnyThreadCount() {
  const Scene scene = render("objects", 77, 91, {5, 5});
  const Estimate one = epi_l(*scene.light_field, ViewSelection::All, 1);
  for (const int threads : {2, 5}) {
    const Estimate many = epi_l(*scene.light_field, ViewSelection::All, threads);
    QVERIFY(same_bytes(one.field.disparity, many.field.disparity));
    QVERIFY(same_bytes(one.confidence, many.confidence));
  }
}

void ConfidenceTest::epiS_isTheSameForAnyThreadCount() {
  const Scene scene = render("objects", 77, 91, {3, 5});
  const Estimate one = epi_s(*scene.light_field, ViewSelection::All, 1);
  const Estimate many = epi_s(*scene.light_field, ViewSelection::All, 5);
  QVERIFY(same_bytes(one.field.disparity, many.field.disparity));
  QVERIFY(same_bytes(one.confidence, many.confidence));
}

// Bit for bit: the requested views decide what is computed, not how.
void ConfidenceTest::centerOnly_equalsCenterOfAllViews() {
  const Scene scene = render("objects", 77, 91, {7, 9});
  const ViewIndex center = scene.light_field->center();
  const Estimate all = epi_l(*scene.light_field);
  const Estimate one = epi_l(*scene.light_field, ViewSelection::Center);
  QVERIFY(one.field.disparity.grid() == (GridShape{1, 1}));
  QVERIFY(one.field.disparity.first() == center);
  QVERIFY(one.contains(center) && !one.contains({0, 0}));
  QCOMPARE(largest_difference(all.field.disparity.view(center), one.field.disparity.view(center)),
           0.0);
  QCOMPARE(largest_difference(all.confidence.view(center), one.confidence.view(center)), 0.0);
}

void ConfidenceTest::epiS_ofCenterEqualsCenterOfAllViews() {
  const Scene scene = render("objects", 50, 60, {5, 3});
  const ViewIndex center = scene.light_field->center();
  const Estimate all = epi_s(*scene.light_field);
  const Estimate one = epi_s(*scene.light_field, ViewSelection::Center);
  QCOMPARE(largest_difference(all.field.disparity.view(center), one.field.disparity.view(center)),
           0.0);
}

}  // namespace episcope::in_confidence_test

EPISCOPE_TEST(confidence_test, ConfidenceTest)
#include "confidence_test.moc"
