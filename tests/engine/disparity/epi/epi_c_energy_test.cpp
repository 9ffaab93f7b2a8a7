// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi_c.h"
#include "engine/solvers/ordering_terms.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <cmath>
#include <limits>

namespace episcope::in_epi_c_energy_test {

using namespace episcope::test;

class EpiCEnergyTest : public QObject {
  Q_OBJECT

 private slots:
  void energy_fallsWithEverySweep();
  void energy_isThatOfTheDefinition();
};

void EpiCEnergyTest::energy_fallsWithEverySweep() {
  const Scene scene = render("objects", 64, 72, {5, 5}, 1, 6);
  const EpiLParameters tensor{.range = Interval{-1.2, 1.2}};
  const Estimate local =
      estimate_orientations(*scene.light_field, tensor, ViewSelection::All, Progress());
  double before = std::numeric_limits<double>::infinity();

  for (int sweeps = 1; sweeps <= 6; ++sweeps) {
    EpiCParameters p;
    p.sweeps = sweeps;
    Estimate estimate;
    estimate.field.disparity = local.field.disparity.clone();
    estimate.confidence = local.confidence.clone();
    denoise_with_ordering(*scene.light_field, p, local.field.disparity, estimate, Progress());
    const double energy =
        epi_c_energy(*scene.light_field, p, local.field.disparity, estimate, Progress());
    QVERIFY2(energy <= before * (1 + 1e-6),
             qPrintable(QString("sweep %1: %2 after %3").arg(sweeps).arg(energy).arg(before)));
    before = energy;
  }
}

// Two views of one row: a step of the right one from 0 to 1, and constant 0 in the left one.
void EpiCEnergyTest::energy_isThatOfTheDefinition() {
  constexpr int width = 10;
  const LightField plain =
      make_light_field({1, 2}, 1, width, 1, [](ViewIndex, int, int, int) { return 0.5F; });
  EpiCParameters p;
  p.denoising.lambda = 0.5;
  ViewStack<float> observed({1, 2}, 1, width);
  Estimate estimate;
  estimate.field.disparity = ViewStack<float>({1, 2}, 1, width);
  estimate.confidence = ViewStack<float>({1, 2}, 1, width);
  for (int i = 0; i < 2 * width; ++i) {
    observed.data()[i] = 0;
    estimate.confidence.data()[i] = 1;
    estimate.field.disparity.data()[i] = i >= 15 ? 1.0F : 0.0F;
  }
  const OrderingPenalty penalty{static_cast<float>(p.rise), static_cast<float>(p.fall),
                                static_cast<float>(p.softness)};
  // Lines from the left meet 5 pixels of 1; of those from the right, 4 that stay within the image
  // meet 0 in front of a 1.
  const double lines = 5 * double{penalty.value(1)} + 4 * double{penalty.value(-1)};

  const double energy = epi_c_energy(plain, p, observed, estimate, Progress());

  QVERIFY2(std::fabs(energy - (0.5 + 0.5 * 5 + lines)) < 1e-4,
           qPrintable(QString::number(energy - (0.5 + 0.5 * 5 + lines))));
}

}  // namespace episcope::in_epi_c_energy_test

EPISCOPE_TEST(epi_c_energy_test, EpiCEnergyTest)
#include "epi_c_energy_test.moc"
