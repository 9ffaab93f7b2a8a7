// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/solvers/layered_kernel.h"
#include "engine/solvers/simplex_labeling.h"
#include "engine/solvers/tv_l2.h"
#include "tests/cpu_time.h"
#include "tests/engine/solvers/random_costs.h"
#include "tests/test_main.h"

#include <cmath>
#include <limits>
#include <random>
#include <thread>
#include <vector>

namespace episcope::in_lifted_labeling_test {

namespace {

using Labeling = test::Costs<LiftedProblem>;

// A disk before a slope, as a stereo method sees them: noisy, truncated costs, repeated texture.
Labeling disk_costs(int height, int labels, int width) {
  Labeling labeling = test::random_costs<LiftedProblem>(height, labels, width, 0.04);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool inside = std::hypot(x - width / 2, y - height / 2) < height / 4;
      const int truth = inside ? labels * 3 / 4 : x * labels / (2 * width);
      for (int l = 0; l < labels; ++l) {
        const auto apart = static_cast<float>(std::abs(l - truth));
        const auto alias = 0.3F + static_cast<float>(std::abs(l - (truth + 9) % labels));
        float& cost = labeling.cost.view().at(y, l, x);
        cost = std::min(1.0F, 0.2F * std::min(apart, alias)) + 0.6F * cost;
      }
    }
  }
  return labeling;
}

LiftedResult solve(const LiftedProblem& problem, int iterations, double gap = 0, int threads = 1,
                   Isa isa = best_isa()) {
  return solve_lifted_labeling(problem, {iterations, gap, 10}, Progress(threads), isa);
}

}  // namespace

class LiftedLabelingTest : public QObject {
  Q_OBJECT

 private slots:
  void solve_findsTheLeastOfAllLabelings_data();
  void solve_findsTheLeastOfAllLabelings();
  void solve_takesCheapestLabelsWithoutSmoothness();
  void solve_agreesWithTvL2OnConvexCosts();
  void solve_closesTheGap_data();
  void solve_closesTheGap();
  void bound_staysBelowEnergyAndGapFalls();
  void solve_keepsTheBestOfAllLooks();
  void solve_ignoresConstantsPerPixel();
  void solve_ignoresScaleOfCosts();
  void solve_mirrorsWithTheLabels();
  void solve_isTheSameForAnyThreads();
  void solve_isTheSameForEveryIsa();
  void solve_keepsTheBestWhenAskedToFinish();
  void solve_stopsOnRequest();
  void solve_refusesBadInput();
  void energy_countsBoundaryByItsLength();
  void kernel_usesAdjointOperators();
};

void LiftedLabelingTest::solve_findsTheLeastOfAllLabelings_data() {
  QTest::addColumn<int>("height");
  QTest::addColumn<int>("width");
  QTest::addColumn<double>("smoothness");
  QTest::newRow("3 by 3, little") << 3 << 3 << 0.02;
  QTest::newRow("3 by 3") << 3 << 3 << 0.1;
  QTest::newRow("3 by 3, much") << 3 << 3 << 0.5;
  QTest::newRow("row") << 1 << 8 << 0.1;
  QTest::newRow("column") << 8 << 1 << 0.1;
  QTest::newRow("single pixel") << 1 << 1 << 0.1;
}

void LiftedLabelingTest::solve_findsTheLeastOfAllLabelings() {
  QFETCH(int, height);
  QFETCH(int, width);
  QFETCH(double, smoothness);
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Labeling labeling = test::random_costs<LiftedProblem>(height, 4, width, smoothness, seed);

    const LiftedResult result = solve(labeling.problem(), 2000, 1e-6);

    const double least = test::least_energy(labeling.problem(), test::labeling_energy);
    QVERIFY2(result.energy <= least * (1 + 1e-5),
             qPrintable(QString("%1 and not %2").arg(result.energy).arg(least)));
    QVERIFY(result.bound <= least * (1 + 1e-5));
    QVERIFY(std::fabs(test::labeling_energy(labeling.problem(), result.labels) - result.energy) <
            1e-5);
  }
}

void LiftedLabelingTest::solve_takesCheapestLabelsWithoutSmoothness() {
  const Labeling exact = test::random_costs<LiftedProblem>(17, 9, 21, 0);
  const Labeling nearly = test::random_costs<LiftedProblem>(17, 9, 21, 1e-4);

  const LiftedResult cheapest = solve(exact.problem(), 10);
  const LiftedResult iterated = solve(nearly.problem(), 200);

  QVERIFY(cheapest.converged);
  for (int y = 0; y < 17; ++y) {
    for (int x = 0; x < 21; ++x) {
      for (int l = 0; l < 9; ++l) {
        QVERIFY(exact.cost.view().at(y, cheapest.labels.at(y, x), x) <=
                exact.cost.view().at(y, l, x));
      }
    }
  }
  QVERIFY(iterated.energy <= cheapest.energy + 0.2);
  QVERIFY(test::labeling_energy(exact.problem(), iterated.labels) <= cheapest.energy + 0.2);
}

// Convex costs are those of denoising. TV-L2 measures slopes by the Euclidean norm, which agrees
// with the octagon where the image changes along an axis only.
void LiftedLabelingTest::solve_agreesWithTvL2OnConvexCosts() {
  constexpr int kLabels = 32, kHeight = 24, kWidth = 40;
  constexpr double kLambda = 12;
  Image<float> f(kHeight, kWidth), u(kHeight, kWidth);
  std::mt19937 random(2);
  std::normal_distribution<float> noise(0.0F, 2.0F);
  Labeling labeling{Volume<float>(kHeight, kLabels, kWidth), Image<float>(kHeight, kWidth, 1, 1.0F),
                    kLambda};
  for (int x = 0; x < kWidth; ++x) {
    const float value = (x < kWidth / 2 ? 6.0F : 24.0F) + noise(random);
    for (int y = 0; y < kHeight; ++y) {
      f.at(y, x) = value;
      for (int l = 0; l < kLabels; ++l) {
        const float off = static_cast<float>(l) - value;
        labeling.cost.view().at(y, l, x) = 0.5F * off * off;
      }
    }
  }
  TvL2Solver denoiser(kHeight, kWidth);

  const LiftedResult result = solve(labeling.problem(), 2000, 1e-5);
  denoiser.solve({f, {}, {}, kLambda}, {1000, 1e-6}, Progress(1), u.view());

  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const float off = static_cast<float>(result.labels.at(y, x)) - u.at(y, x);
      QVERIFY2(std::fabs(off) < 1, qPrintable(QString::number(off)));
    }
  }
}

void LiftedLabelingTest::solve_closesTheGap_data() {
  QTest::addColumn<double>("smoothness");
  QTest::newRow("little") << 0.01;
  QTest::newRow("as usual") << 0.04;
  QTest::newRow("much") << 0.2;
}

void LiftedLabelingTest::solve_closesTheGap() {
  QFETCH(double, smoothness);
  Labeling labeling = disk_costs(70, 20, 90);
  labeling.smoothness = smoothness;

  const LiftedResult result = solve(labeling.problem(), 1000, 1e-4);

  const double gap = result.relative_gap();
  QVERIFY2(result.converged && gap <= 1e-4, qPrintable(QString::number(gap)));
}

void LiftedLabelingTest::bound_staysBelowEnergyAndGapFalls() {
  const Labeling labeling = disk_costs(40, 16, 50);
  double gap = std::numeric_limits<double>::infinity();

  for (const int iterations : {5, 20, 80, 320}) {
    const LiftedResult result = solve(labeling.problem(), iterations);
    QVERIFY(result.bound <= result.energy * (1 + 1e-6));
    QVERIFY(result.relative_gap() < gap);
    gap = result.relative_gap();
  }
}

// Over-relaxed, neither energy nor bound improves with every iteration.
void LiftedLabelingTest::solve_keepsTheBestOfAllLooks() {
  Labeling labeling = disk_costs(40, 16, 50);
  labeling.smoothness = 0.3;
  LiftedResult before;
  before.energy = std::numeric_limits<double>::infinity();
  before.bound = -before.energy;

  for (int iterations = 1; iterations <= 60; ++iterations) {
    const LiftedResult result =
        solve_lifted_labeling(labeling.problem(), {iterations, 0, 1}, Progress(1));
    QVERIFY(result.energy <= before.energy && result.bound >= before.bound);
    QCOMPARE(test::labeling_energy(labeling.problem(), result.labels), result.energy);
    before.energy = result.energy;
    before.bound = result.bound;
  }
}

void LiftedLabelingTest::solve_ignoresConstantsPerPixel() {
  const Labeling labeling = disk_costs(33, 16, 41);
  Labeling raised = disk_costs(33, 16, 41);
  for (int y = 0; y < 33; ++y) {
    for (int l = 0; l < 16; ++l) {
      for (int x = 0; x < 41; ++x) raised.cost.view().at(y, l, x) += 0.25F * ((x + y) % 5);
    }
  }

  const LiftedResult plain = solve(labeling.problem(), 60);
  const LiftedResult other = solve(raised.problem(), 60);

  // Rounded differently, a tie here and there may be broken the other way.
  int apart = 0;
  for (std::size_t i = 0; i < plain.labels.size(); ++i) {
    apart += plain.labels.data()[i] != other.labels.data()[i];
  }
  QVERIFY2(apart <= 2, qPrintable(QString::number(apart)));
  QVERIFY(std::fabs((plain.energy - plain.bound) - (other.energy - other.bound)) <
          1e-4 * plain.energy);
}

void LiftedLabelingTest::solve_ignoresScaleOfCosts() {
  const Labeling labeling = disk_costs(33, 16, 41);
  Labeling scaled = disk_costs(33, 16, 41);
  for (std::size_t i = 0; i < scaled.cost.view().size(); ++i) scaled.cost.view().data[i] *= 1024;
  scaled.smoothness *= 1024;

  const LiftedResult result = solve(labeling.problem(), 40);
  const LiftedResult large = solve(scaled.problem(), 40);

  QVERIFY(test::same_labels(result.labels, large.labels));  // a power of two: rounded alike
}

// Turning the order of the labels round mirrors the labeling.
void LiftedLabelingTest::solve_mirrorsWithTheLabels() {
  const Labeling labeling = disk_costs(33, 16, 41);
  Labeling mirrored = disk_costs(33, 16, 41);
  for (int y = 0; y < 33; ++y) {
    for (int l = 0; l < 16; ++l) {
      std::copy_n(labeling.cost.view().row(y, l), 41, mirrored.cost.view().row(y, 15 - l));
    }
  }

  const LiftedResult result = solve(labeling.problem(), 400, 1e-5);
  const LiftedResult other = solve(mirrored.problem(), 400, 1e-5);

  QVERIFY(result.converged && other.converged);
  QVERIFY(std::fabs(result.energy - other.energy) < 2e-5 * result.energy);
}

void LiftedLabelingTest::solve_isTheSameForAnyThreads() {
  const Labeling labeling = disk_costs(101, 12, 67);

  const LiftedResult one = solve(labeling.problem(), 30, 0, 1);
  const LiftedResult five = solve(labeling.problem(), 30, 0, 5);

  QVERIFY(test::same_labels(one.labels, five.labels));
  QCOMPARE(five.energy, one.energy);
  QCOMPARE(five.bound, one.bound);
}

void LiftedLabelingTest::solve_isTheSameForEveryIsa() {
  const Labeling labeling = disk_costs(67, 14, 75);
  const LiftedResult baseline = solve(labeling.problem(), 40, 0, 1, Isa::Baseline);

  for (const Isa isa : {Isa::Avx2, Isa::Avx512}) {
    if (best_isa() < isa) continue;
    const LiftedResult result = solve(labeling.problem(), 40, 0, 1, isa);
    QVERIFY2(std::fabs(result.energy - baseline.energy) < 1e-4 * baseline.energy, isa_name(isa));
    QVERIFY2(std::fabs(result.bound - baseline.bound) < 1e-4 * baseline.energy, isa_name(isa));
  }
}

void LiftedLabelingTest::solve_keepsTheBestWhenAskedToFinish() {
  const Labeling labeling = disk_costs(60, 16, 60);
  std::stop_source finish;
  finish.request_stop();

  const LiftedResult result = solve_lifted_labeling(labeling.problem(), {100000, 0, 10},
                                                    Progress({}, finish.get_token(), {}, 1));

  QCOMPARE(result.iterations, 1);
  QVERIFY(!result.converged);
  QCOMPARE(test::labeling_energy(labeling.problem(), result.labels), result.energy);
}

void LiftedLabelingTest::solve_stopsOnRequest() {
  const Labeling labeling = disk_costs(256, 64, 256);
  std::stop_source stop;
  double asked = 0;
  const Progress progress(stop.get_token(), [&](const ProgressState&) {
    if (stop.stop_requested()) return;
    asked = cpu_time_ms();
    stop.request_stop();
  });

  QVERIFY_THROWS_EXCEPTION(
      Cancelled, (void)solve_lifted_labeling(labeling.problem(), {100000, 0, 1}, progress));

  QVERIFY(stop.stop_requested());
  QVERIFY(cpu_time_ms() - asked < cpu_limit_of_a_stop_ms());
}

void LiftedLabelingTest::solve_refusesBadInput() {
  const Labeling labeling = test::random_costs<LiftedProblem>(6, 4, 7, 0.1);
  const Labeling many = test::random_costs<LiftedProblem>(1, kMaxLiftedLayers + 1, 1, 0.1);
  const Image<float> wrong(7, 6);
  LiftedProblem problem = labeling.problem();

  QVERIFY_THROWS_EXCEPTION(InvalidInput, solve({}, 10));
  QVERIFY_THROWS_EXCEPTION(InvalidInput, solve(many.problem(), 10));
  problem.smoothness = -1;
  QVERIFY_THROWS_EXCEPTION(InvalidInput, solve(problem, 10));
  problem = labeling.problem();
  problem.g = wrong;
  QVERIFY_THROWS_EXCEPTION(InvalidInput, solve(problem, 10));
}

void LiftedLabelingTest::energy_countsBoundaryByItsLength() {
  constexpr int kSize = 30;
  Volume<float> cost(kSize, 3, kSize);
  std::fill_n(cost.view().data, cost.view().size(), 0.0F);
  const LiftedProblem problem{cost.view(), {}, 1};
  Image<int> halves(kSize, kSize), corner(kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      halves.at(y, x) = x < 7 ? 0 : 2;
      corner.at(y, x) = x + y < 20 ? 1 : 0;
    }
  }

  QVERIFY(std::fabs(test::labeling_energy(problem, halves) - 2 * kSize) < 1e-4);
  // From the left border to the upper one; how it meets them is worth less than a pixel.
  QVERIFY(std::fabs(test::labeling_energy(problem, corner) - 20 * std::sqrt(2.0)) < 1);
}

// Costs that force a labeling make the bound −⟨div p, φ⟩ of its φ, which must be ⟨p, ∇φ⟩.
void LiftedLabelingTest::kernel_usesAdjointOperators() {
  constexpr int kWidth = 21;
  constexpr long kPitch = 32;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-0.5F, 0.5F);
  const LayeredShape shape{1, kWidth, kPitch, 1, 1, 1};
  // Two rows: φ of each, duals of the first; those of the second are 0.
  std::vector<float> memory(16 * kPitch + 16), limits(kPitch + 32, 1.0F);
  const auto row = [&](int i) { return memory.data() + 16 + i * kPitch; };
  PairDuals first, none;
  for (int k = 0; k < kPairKinds; ++k) {
    first.pair[k] = row(k);
    none.pair[k] = row(4);
    first.limit[k] = none.limit[k] = limits.data() + 16;
    const bool crosses = k != 1;
    for (int x = 0; x < kWidth - (crosses ? 1 : 0); ++x) row(k)[x] = uniform(random);
  }
  float *const phi = row(5), *const below = row(6);
  std::vector<int> chosen(2 * kWidth);
  for (int& label : chosen) label = uniform(random) > 0 ? 1 : 0;
  double product = 0, bounds = 0;
  for (int x = 0; x < kWidth; ++x) {
    phi[x] = static_cast<float>(chosen[x]);
    below[x] = static_cast<float>(chosen[kWidth + x]);
  }
  for (int x = 0; x < kWidth; ++x) {
    product += row(0)[x] * (phi[x + 1] - phi[x]) + row(1)[x] * (below[x] - phi[x]) +
               row(2)[x] * (below[x + 1] - phi[x]) + row(3)[x] * (below[x] - phi[x + 1]);
  }

  for (int y = 0; y < 2; ++y) {
    std::vector<float> cost(2 * kWidth, 1e3F);  // 0 at the chosen label
    for (int x = 0; x < kWidth; ++x) cost[chosen[y * kWidth + x] * kWidth + x] = 0;
    const PairDuals& here = y == 0 ? first : none;
    bounds += baseline::kLiftedKernel.bound(shape, cost.data(), here, y == 0 ? none : first);
  }

  QVERIFY(std::fabs(bounds - product) < 1e-4);
}

}  // namespace episcope::in_lifted_labeling_test

EPISCOPE_TEST(lifted_labeling_test, LiftedLabelingTest)
#include "lifted_labeling_test.moc"
