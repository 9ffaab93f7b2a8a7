// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi_c.h"
#include "engine/solvers/ordering_terms.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <cmath>
#include <limits>

namespace episcope::in_epi_c_energy_test {

using namespace episcope::test;

namespace {

float penalty(const EpiCParameters& p, float a) {
  const auto fall = static_cast<float>(p.fall), softness = static_cast<float>(p.softness);
  const float slope = std::clamp(a * fall / softness, -fall, static_cast<float>(p.rise));
  return slope * a - 0.5F * slope * slope * softness / fall;
}

// λ Σ g |∇u| + ½ Σ w (u − f)² of one view, and Σ ψ(D u) of its lines.
double energy_of(const LightField& lf, const EpiCParameters& p, const ViewStack<float>& observed,
                 const Estimate& estimate, ViewIndex view) {
  const ImageView<const float> u = estimate.field.view(view).disparity, f = observed.view(view);
  const Image<float> edges = smoothness_weights(lf, view, p.denoising.edge_strength);
  Image<float> weights(u.height, u.width), lines(u.height, u.width);
  fill_data_weights(estimate.confidence.view(view), {p.denoising.weight_power, 0.001F}, weights);
  double sum = 0;
  for (int y = 0; y < u.height; ++y) {
    for (int x = 0; x < u.width; ++x) {
      const float right = u.at(y, std::min(x + 1, u.width - 1)) - u.at(y, x);
      const float down = u.at(std::min(y + 1, u.height - 1), x) - u.at(y, x);
      const float off = u.at(y, x) - f.at(y, x);
      sum += p.denoising.lambda * edges.at(y, x) * std::hypot(right, down) +
             0.5 * weights.at(y, x) * off * off;
    }
  }
  for (const ViewIndex way : {ViewIndex{0, 1}, {0, -1}, {1, 0}, {-1, 0}}) {
    const ViewIndex other{view.v + way.v, view.u + way.u};
    if (!estimate.field.contains(other)) continue;
    const LineStep step{way.v != 0, static_cast<float>(-(way.u + way.v))};
    line_differences(u, u, estimate.field.view(other).disparity, step, lines.view());
    for (const float a : lines) sum += std::isnan(a) ? 0 : penalty(p, a);
  }
  return sum;
}

double energy_of(const LightField& lf, const EpiCParameters& p, const ViewStack<float>& observed,
                 const Estimate& estimate) {
  double sum = 0;
  for (int i = 0; i < lf.grid().count(); ++i) {
    sum += energy_of(lf, p, observed, estimate, lf.grid().view_at(i));
  }
  return sum;
}

}  // namespace

class EpiCEnergyTest : public QObject {
  Q_OBJECT

 private slots:
  void energy_fallsWithEverySweep();
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
    const double energy = energy_of(*scene.light_field, p, local.field.disparity, estimate);
    QVERIFY2(energy <= before * (1 + 1e-6),
             qPrintable(QString("sweep %1: %2 after %3").arg(sweeps).arg(energy).arg(before)));
    before = energy;
  }
}

}  // namespace episcope::in_epi_c_energy_test

EPISCOPE_TEST(epi_c_energy_test, EpiCEnergyTest)
#include "epi_c_energy_test.moc"
