// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/planes/plane_labeling.h"

#include "engine/core/error.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace episcope::in_plane_labeling_test {

namespace {

constexpr int kSize = 48, kLabels = 41;
constexpr float kFirst = -1, kStep = 0.05F;

// Two slanted planes that meet in a jump at the middle column.
float truth(int y, int x) {
  const auto across = static_cast<float>(x), down = static_cast<float>(y);
  return x < kSize / 2 ? -0.6F + 0.01F * across : 0.2F + 0.005F * across - 0.004F * down;
}

// Costs |value − truth|, up to 0.3; every `missing`th pixel knows nothing.
Volume<float> costs(int missing) {
  Volume<float> volume(kSize, kLabels, kSize);
  std::mt19937 random(3);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const bool knows = missing == 0 || random() % missing != 0;
      for (int label = 0; label < kLabels; ++label) {
        const float value = kFirst + kStep * static_cast<float>(label);
        volume.view().at(y, label, x) =
            knows ? std::min(std::abs(value - truth(y, x)), 0.3F) : 0.15F;
      }
    }
  }
  return volume;
}

PlaneProblem problem(const Volume<float>& volume) {
  return {.cost = volume.view(),
          .first = kFirst,
          .step = kStep,
          .g = {},
          .smoothness = 0.3F,
          .truncation = 0.3F};
}

Image<Plane> cheapest(const Volume<float>& volume) {
  Image<Plane> planes(kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      int best = 0;
      for (int label = 1; label < kLabels; ++label) {
        if (volume.view().at(y, label, x) < volume.view().at(y, best, x)) best = label;
      }
      planes.at(y, x).value = kFirst + kStep * static_cast<float>(best);
    }
  }
  return planes;
}

double share_off(const Image<Plane>& planes, float limit) {
  int off = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) off += std::abs(planes.at(y, x).value - truth(y, x)) > limit;
  }
  return static_cast<double>(off) / (kSize * kSize);
}

}  // namespace

class PlaneLabelingTest : public QObject {
  Q_OBJECT

 private slots:
  void valuesOfTwoPlanes_areFound();
  void energy_neverRises();
  void planesThatContinue_costNothing();
  void threads_changeNothing();
  void wrongShapes_areRefused();
};

void PlaneLabelingTest::valuesOfTwoPlanes_areFound() {
  const Volume<float> volume = costs(4);
  Image<Plane> planes = cheapest(volume);
  QVERIFY(share_off(planes, 0.1F) > 0.2);

  improve_planes(problem(volume), {.sweeps = 6}, Progress(), planes.view());

  QVERIFY2(share_off(planes, 0.05F) < 0.01, qPrintable(QString::number(share_off(planes, 0.05F))));
}

void PlaneLabelingTest::energy_neverRises() {
  const Volume<float> volume = costs(3);
  Image<Plane> planes = cheapest(volume);
  double before = plane_energy(problem(volume), planes);

  for (unsigned seed = 1; seed < 6; ++seed) {
    const double after =
        improve_planes(problem(volume), {.sweeps = 1, .seed = seed}, Progress(), planes.view());

    // Float sums of single pixels against double sums of all.
    QVERIFY(after <= before * (1 + 1e-6));
    before = after;
  }
}

void PlaneLabelingTest::planesThatContinue_costNothing() {
  const Volume<float> volume = costs(0);
  Image<Plane> planes(kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      planes.at(y, x) = {0.01F * static_cast<float>(x) - 0.3F, 0.01F, 0};
    }
  }
  PlaneProblem without = problem(volume);
  without.smoothness = 0;

  QVERIFY(std::abs(plane_energy(problem(volume), planes) - plane_energy(without, planes)) < 1e-2);
}

void PlaneLabelingTest::threads_changeNothing() {
  const Volume<float> volume = costs(3);
  Image<Plane> one = cheapest(volume), three = cheapest(volume);

  improve_planes(problem(volume), {}, Progress(1), one.view());
  improve_planes(problem(volume), {}, Progress(3), three.view());

  QVERIFY(std::equal(one.begin(), one.end(), three.begin()));
}

void PlaneLabelingTest::wrongShapes_areRefused() {
  const Volume<float> volume = costs(0);
  Image<Plane> planes(kSize, kSize + 1);

  QVERIFY_THROWS_EXCEPTION(InvalidInput,
                           improve_planes(problem(volume), {}, Progress(), planes.view()));
}

}  // namespace episcope::in_plane_labeling_test

EPISCOPE_TEST(plane_labeling_test, PlaneLabelingTest)
#include "plane_labeling_test.moc"
