// SPDX-License-Identifier: BSD-3-Clause

#include "engine/disparity/multi_camera_energy.h"
#include "engine/disparity/kz02.h"
#include "engine/disparity/matching_cost.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <random>

namespace episcope::in_multi_camera_energy_test {

using namespace episcope::test;

namespace {

LightField random_light_field(GridShape grid, int height, int width, unsigned seed) {
  std::mt19937 random(seed);
  return make_light_field(grid, height, width, 1, [&](ViewIndex, int, int, int) {
    return static_cast<float>(random() % 40) / 255;
  });
}

Interactions interactions_of(const LightField& lf, const std::vector<float>& labels,
                             PixelComparison comparison = PixelComparison::WholePixels) {
  return {lf,
          lf.center(),
          side_views(lf.grid(), lf.center(), 1, labels),
          {comparison, 200},
          Progress(1)};
}

// Two views of a row of three pixels and two labels.
constexpr GridShape kPair{1, 2};
constexpr int kPixels = 3;

CameraLabels labels_from(unsigned bits) {
  CameraLabels labels(2, Image<std::int16_t>(1, kPixels));
  for (int i = 0; i < 2 * kPixels; ++i) {
    labels[i / kPixels].at(0, i % kPixels) = static_cast<std::int16_t>(bits >> i & 1U);
  }
  return labels;
}

}  // namespace

class MultiCameraEnergyTest : public QObject {
  Q_OBJECT

 private slots:
  void energy_isThatOfItsTermsByHand();
  void lookingThroughAPoint_isForbidden();
  void twoLabels_areExpandedToTheOptimum();
  void expansions_neverRaiseTheEnergy_data();
  void expansions_neverRaiseTheEnergy();
  void finish_leavesLabelsAsTheyWere();
};

// Pixels 20, 30, 40 in the reference view (u = 1) and 10, 20, 30 in the other: the same scene one
// pixel on, so that label 1 (disparity 1) matches exactly.
void MultiCameraEnergyTest::energy_isThatOfItsTermsByHand() {
  const LightField lf = make_light_field(kPair, 1, kPixels, 1, [](ViewIndex view, int, int x, int) {
    return static_cast<float>(10 * (x + 1 + (view.u == 0 ? -1 : 0)) + 10) / 255;
  });
  const Interactions interactions = interactions_of(lf, {0, 1});
  const MultiCameraEnergy energy(interactions, {100, 1});

  // Label 0: differences of 10, K = 200: three gains of ½ K. Jumps: none.
  QCOMPARE(energy.of(labels_from(0)).value(), -1500);
  // Label 1 shifts by one: two pixels see each other and gain K; every pixel has label 1.
  QCOMPARE(energy.of(labels_from(0b111111)).value(), -2000);
  // The first pixel of the reference and the middle one of the other at label 1, which gain K; the
  // last ones still see each other at label 0. Neighbors differ by 10, more than 8: each of the
  // three jumps costs λ.
  QCOMPARE(energy.of(labels_from(0b010001)).value(), -1000 - 500 + 3 * 100);
}

void MultiCameraEnergyTest::lookingThroughAPoint_isForbidden() {
  const LightField lf = random_light_field(kPair, 1, kPixels, 1);
  const Interactions interactions = interactions_of(lf, {0, 1});
  const MultiCameraEnergy energy(interactions, {100, 1});

  // The middle pixel of the reference view at the nearer label falls on the other's last pixel,
  // which must not be farther.
  QVERIFY(!energy.of(labels_from(0b000010)).has_value());
  QVERIFY(energy.of(labels_from(0b100010)).has_value());
}

// From the farthest label one expansion can reach every labeling, so it must find the best.
void MultiCameraEnergyTest::twoLabels_areExpandedToTheOptimum() {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const LightField lf = random_light_field(kPair, 1, kPixels, seed);
    const Interactions interactions = interactions_of(lf, {0, 1});
    const MultiCameraEnergy energy(interactions, {60, 1});
    std::int64_t best = 0;
    for (unsigned bits = 0; bits < 1U << (2 * kPixels); ++bits) {
      best = std::min(best, energy.of(labels_from(bits)).value_or(0));
    }
    LabelExpansion expansion(energy, energy.farthest());

    const std::int64_t change = expansion.expand(1, Progress(1)).value();

    QCOMPARE(energy.of(expansion.labels()).value(), best);
    QCOMPARE(energy.of(energy.farthest()).value() + change, best);
  }
}

void MultiCameraEnergyTest::expansions_neverRaiseTheEnergy_data() {
  QTest::addColumn<int>("comparison");
  QTest::addColumn<int>("rows");
  QTest::addColumn<int>("columns");
  for (const PixelComparison comparison :
       {PixelComparison::WholePixels, PixelComparison::BetweenPixels}) {
    const std::string name = name_of(comparison);
    QTest::addRow("%s 3x3", name.c_str()) << static_cast<int>(comparison) << 3 << 3;
    QTest::addRow("%s 1x3", name.c_str()) << static_cast<int>(comparison) << 1 << 3;
  }
}

// The change that a cut promises is that of the energy computed anew; and visibility is kept.
void MultiCameraEnergyTest::expansions_neverRaiseTheEnergy() {
  QFETCH(int, comparison);
  QFETCH(int, rows);
  QFETCH(int, columns);
  const Scene scene = render("objects", 40, 44, {rows, columns}, 4);
  const std::vector<float> labels = equidistant_labels({-4, 4}, 9);
  const Interactions interactions =
      interactions_of(*scene.light_field, labels, static_cast<PixelComparison>(comparison));
  const MultiCameraEnergy energy(interactions, {50, 3});
  LabelExpansion expansion(energy, energy.farthest());
  std::int64_t before = energy.of(expansion.labels()).value();
  const std::int64_t start = before;
  for (int step = 0; step < 27; ++step) {
    const std::int64_t change = expansion.expand(4 * step % 9, Progress(1)).value();
    const auto after = energy.of(expansion.labels());
    QVERIFY(after.has_value());
    QVERIFY(change <= 0);
    QCOMPARE(*after, before + change);
    before = *after;
  }
  QVERIFY(before < start);
}

void MultiCameraEnergyTest::finish_leavesLabelsAsTheyWere() {
  const Scene scene = render("objects", 96, 96, {3, 3}, 4);
  const Interactions interactions =
      interactions_of(*scene.light_field, equidistant_labels({-4, 4}, 9));
  const MultiCameraEnergy energy(interactions, {50, 3});
  LabelExpansion expansion(energy, energy.farthest());
  std::stop_source finish;
  finish.request_stop();

  const auto change = expansion.expand(4, Progress({}, finish.get_token(), nullptr));

  QVERIFY(!change.has_value());
  QCOMPARE(energy.of(expansion.labels()), energy.of(energy.farthest()));
}

}  // namespace episcope::in_multi_camera_energy_test

EPISCOPE_TEST(multi_camera_energy_test, MultiCameraEnergyTest)
#include "multi_camera_energy_test.moc"
