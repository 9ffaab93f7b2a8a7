// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/simplex_labeling.h"
#include "engine/core/error.h"
#include "engine/solvers/layered_sweep.h"
#include "tests/cpu_time.h"
#include "tests/engine/solvers/random_costs.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace episcope::in_simplex_labeling_test {

namespace {

using Potts = test::Costs<SimplexProblem>;

// Sectors of a disk, each pixel mistaken now and then.
Potts sectors(int height, int labels, int width, double smoothness = 0.5) {
  Potts potts = test::random_costs<SimplexProblem>(height, labels, width, smoothness);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double angle = std::atan2(y - height / 2 + 0.5, x - width / 2 + 0.5) / 6.2832 + 0.5;
      const int truth = static_cast<int>(angle * labels) % labels;
      for (int l = 0; l < labels; ++l) {
        float& cost = potts.cost.view().at(y, l, x);
        cost = (l == truth ? 0.3F : 0.9F) + 1.2F * cost;
      }
    }
  }
  return potts;
}

struct Solved {
  SimplexResult result;
  Image<int> labels;
};

Solved solve(const SimplexProblem& problem, int iterations, double gap = 0, int threads = 1,
             Isa isa = best_isa()) {
  const auto& cost = problem.cost;
  SimplexSolver solver(cost.height, cost.layers, cost.width, isa);
  Solved solved{{}, Image<int>(cost.height, cost.width)};
  solved.result =
      solver.solve(problem, {iterations, gap, 10, {}}, Progress(threads), solved.labels.view());
  return solved;
}

}  // namespace

class SimplexLabelingTest : public QObject {
  Q_OBJECT

 private slots:
  void solve_isWithinItsGapOfTheBest_data();
  void solve_isWithinItsGapOfTheBest();
  void solve_ofTwoLabelsIsBinaryVariation();
  void solve_takesCheapestLabelsWithoutSmoothness();
  void solve_keepsCertainLabels();
  void solve_treatsLabelsAlike();
  void bound_staysBelowEnergyAndGapFalls();
  void solve_isTheSameForAnyThreads();
  void solve_isTheSameForEveryIsa();
  void solve_isTheSameAfterOtherProblems();
  void solve_goesOnFromWhereItEnded();
  void solve_goesOnFromWhatHasMoved();
  void solve_keepsTheBestWhenAskedToFinish();
  void solve_stopsOnRequest();
  void solve_refusesBadInput();
  void energy_countsBoundariesOnce();
  void coarseLevels_keepConstantsAndTotals();
};

void SimplexLabelingTest::solve_isWithinItsGapOfTheBest_data() {
  QTest::addColumn<int>("height");
  QTest::addColumn<int>("width");
  QTest::addColumn<int>("labels");
  QTest::addColumn<double>("smoothness");
  QTest::newRow("3 by 3, little") << 3 << 3 << 3 << 0.05;
  QTest::newRow("3 by 3") << 3 << 3 << 3 << 0.3;
  QTest::newRow("3 by 3, much") << 3 << 3 << 3 << 2.0;
  QTest::newRow("row") << 1 << 8 << 3 << 0.3;
  QTest::newRow("column") << 8 << 1 << 3 << 0.3;
  QTest::newRow("single pixel") << 1 << 1 << 5 << 0.3;
}

void SimplexLabelingTest::solve_isWithinItsGapOfTheBest() {
  QFETCH(int, height);
  QFETCH(int, width);
  QFETCH(int, labels);
  QFETCH(double, smoothness);
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Potts potts = test::random_costs<SimplexProblem>(height, labels, width, smoothness, seed);

    const auto [result, found] = solve(potts.problem(), 3000, 1e-6);

    // With three labels the relaxation may lie below the best labeling, but nothing lies below it.
    const double least = test::least_energy(potts.problem(), test::potts_energy);
    QVERIFY(result.bound <= least * (1 + 1e-5));
    QVERIFY(result.energy >= least * (1 - 1e-5));
    QVERIFY2(result.energy <= least * 1.02,
             qPrintable(QString("%1 and not %2").arg(result.energy).arg(least)));
    QVERIFY(result.relaxed <= result.energy && result.relaxed >= result.bound * (1 - 1e-5));
    QVERIFY2(result.converged, qPrintable(QString::number(result.relative_gap())));
    QVERIFY(std::fabs(test::potts_energy(potts.problem(), found) - result.energy) < 1e-5);
  }
}

// The lifted solver measures the same octagonal variation, and of two labels there is but one jump.
void SimplexLabelingTest::solve_ofTwoLabelsIsBinaryVariation() {
  const Potts potts = sectors(40, 2, 53, 0.8);

  const auto [result, labels] = solve(potts.problem(), 3000, 1e-5);
  const LiftedResult lifted = solve_lifted_labeling({potts.cost.view(), potts.g, potts.smoothness},
                                                    {3000, 1e-5, 10}, Progress(1));

  QVERIFY(result.converged && lifted.converged);
  QVERIFY2(labeling_gap(result.energy, result.bound) < 1e-4,
           qPrintable(QString::number(labeling_gap(result.energy, result.bound))));
  QVERIFY(std::fabs(result.energy - lifted.energy) < 2e-4 * lifted.energy);
}

void SimplexLabelingTest::solve_takesCheapestLabelsWithoutSmoothness() {
  const Potts potts = test::random_costs<SimplexProblem>(9, 5, 11, 0);

  const auto [result, labels] = solve(potts.problem(), 10);

  QVERIFY(result.converged);
  QCOMPARE(result.relative_gap(), 0.0);
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 11; ++x) {
      for (int l = 0; l < 5; ++l) {
        QVERIFY(potts.cost.view().at(y, labels.at(y, x), x) <= potts.cost.view().at(y, l, x));
      }
    }
  }
}

void SimplexLabelingTest::solve_keepsCertainLabels() {
  Potts potts = sectors(48, 6, 48, 0.2);
  const Image<int> truth = solve({sectors(48, 6, 48).cost.view(), {}, 3.0}, 500, 1e-3).labels;
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 48; ++x) {
      for (int l = 0; l < 6; ++l) {
        potts.cost.view().at(y, l, x) = l == truth.at(y, x) ? 0.0F : 5.0F;
      }
    }
  }

  const Image<int> labels = solve(potts.problem(), 300, 1e-4).labels;

  QVERIFY(test::same_labels(labels, truth));
}

// Renaming the labels renames the result: they have no order.
void SimplexLabelingTest::solve_treatsLabelsAlike() {
  const Potts potts = sectors(33, 4, 41);
  Potts turned = sectors(33, 4, 41);
  for (int y = 0; y < 33; ++y) {
    for (int l = 0; l < 4; ++l) {
      std::copy_n(potts.cost.view().row(y, l), 41, turned.cost.view().row(y, (l + 1) % 4));
    }
  }

  const auto [result, labels] = solve(potts.problem(), 2000, 1e-5);
  const auto [other, renamed] = solve(turned.problem(), 2000, 1e-5);

  QVERIFY(result.converged && other.converged);
  QVERIFY(std::fabs(result.relaxed - other.relaxed) < 3e-5 * result.relaxed);
}

void SimplexLabelingTest::bound_staysBelowEnergyAndGapFalls() {
  const Potts potts = sectors(64, 8, 70);
  double gap = std::numeric_limits<double>::infinity();

  for (const int iterations : {5, 20, 80, 320}) {
    const SimplexResult result = solve(potts.problem(), iterations).result;
    QVERIFY(result.bound <= result.relaxed * (1 + 1e-6));
    QVERIFY(result.relaxed <= result.energy);
    QVERIFY(result.relative_gap() < gap);
    gap = result.relative_gap();
  }
  QVERIFY2(gap < 1e-3, qPrintable(QString::number(gap)));
}

void SimplexLabelingTest::solve_isTheSameForAnyThreads() {
  const Potts potts = sectors(101, 7, 67);

  const auto one = solve(potts.problem(), 30, 0, 1);
  // Few threads divide iterations, many divide rows.
  for (const int threads : {2, 3, 5}) {
    const auto many = solve(potts.problem(), 30, 0, threads);

    QVERIFY(test::same_labels(one.labels, many.labels));
    QCOMPARE(many.result.energy, one.result.energy);
    QCOMPARE(many.result.bound, one.result.bound);
  }
}

void SimplexLabelingTest::solve_isTheSameForEveryIsa() {
  const Potts potts = sectors(67, 9, 75);
  const SimplexResult baseline = solve(potts.problem(), 40, 0, 1, Isa::Baseline).result;

  for (const Isa isa : {Isa::Avx2, Isa::Avx512}) {
    if (best_isa() < isa) continue;
    const SimplexResult result = solve(potts.problem(), 40, 0, 1, isa).result;
    QVERIFY2(std::fabs(result.energy - baseline.energy) < 1e-4 * baseline.energy, isa_name(isa));
    QVERIFY2(std::fabs(result.bound - baseline.bound) < 1e-4 * baseline.energy, isa_name(isa));
  }
}

void SimplexLabelingTest::solve_isTheSameAfterOtherProblems() {
  const Potts potts = sectors(50, 5, 45), other = test::random_costs<SimplexProblem>(50, 5, 45, 3);
  SimplexSolver solver(50, 5, 45);
  Image<int> first(50, 45), again(50, 45), ignored(50, 45);

  solver.solve(potts.problem(), {}, Progress(1), first.view());
  solver.solve(other.problem(), {}, Progress(1), ignored.view());
  solver.solve(potts.problem(), {}, Progress(1), again.view());

  QVERIFY(test::same_labels(first, again));
}

void SimplexLabelingTest::solve_goesOnFromWhereItEnded() {
  const Potts potts = sectors(64, 8, 64);
  SimplexSolver solver(64, 8, 64);
  Image<int> labels(64, 64);

  Image<std::int32_t> same_place(64, 64);
  std::fill(same_place.begin(), same_place.end(), -1);

  const auto cold = solver.solve(potts.problem(), {300, 1e-4, 5, {}}, Progress(1), labels.view());
  const auto warm =
      solver.solve(potts.problem(), {300, 1e-4, 5, same_place}, Progress(1), labels.view());

  QVERIFY(cold.converged && warm.converged);
  QVERIFY(cold.iterations > 5);
  QCOMPARE(warm.iterations, 5);

  SimplexSolver kept(64, 8, 64);
  SimplexOptions options{300, 1e-4, 5, {}};
  options.goes_on = true;
  const auto first = kept.solve(potts.problem(), options, Progress(1), labels.view());
  const auto next = kept.solve(potts.problem(), options, Progress(1), labels.view());

  QCOMPARE(first.iterations, cold.iterations);
  QCOMPARE(next.iterations, 5);
  QVERIFY(next.converged);
}

// The image has moved two pixels to the right since.
void SimplexLabelingTest::solve_goesOnFromWhatHasMoved() {
  const Potts whole = sectors(64, 8, 66);
  const auto part = [&](int from) {
    Volume<float> cost(64, 8, 64);
    for (int y = 0; y < 64; ++y) {
      for (int l = 0; l < 8; ++l) {
        std::copy_n(whole.problem().cost.row(y, l) + from, 64, cost.view().row(y, l));
      }
    }
    return cost;
  };
  const Volume<float> before = part(2), after = part(0);
  Image<std::int32_t> places(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) places.at(y, x) = x < 2 ? -1 : y * 64 + x - 2;
  }
  const double smoothness = whole.problem().smoothness;
  SimplexSolver solver(64, 8, 64), other(64, 8, 64);
  Image<int> labels(64, 64);

  solver.solve({before.view(), {}, smoothness}, {300, 1e-4, 5, {}}, Progress(1), labels.view());
  const auto moved = solver.solve({after.view(), {}, smoothness}, {300, 1e-4, 5, places},
                                  Progress(1), labels.view());
  const auto anew =
      other.solve({after.view(), {}, smoothness}, {300, 1e-4, 5, {}}, Progress(1), labels.view());

  QVERIFY(moved.converged && anew.converged);
  QVERIFY(std::fabs(moved.energy - anew.energy) <= 2e-4 * std::fabs(anew.energy));
  QVERIFY(moved.iterations < anew.iterations);
  places.at(0, 0) = 64 * 64;
  QVERIFY_THROWS_EXCEPTION(InvalidInput,
                           solver.solve({after.view(), {}, smoothness}, {300, 1e-4, 5, places},
                                        Progress(1), labels.view()));
}

void SimplexLabelingTest::solve_keepsTheBestWhenAskedToFinish() {
  const Potts potts = sectors(60, 5, 60);
  std::stop_source finish;
  finish.request_stop();
  SimplexSolver solver(60, 5, 60);
  Image<int> labels(60, 60);

  const auto result = solver.solve(potts.problem(), {100000, 0, 10, {}},
                                   Progress({}, finish.get_token(), {}, 1), labels.view());

  QCOMPARE(result.iterations, 1);
  QVERIFY(!result.converged);
  QVERIFY(std::fabs(test::potts_energy(potts.problem(), labels) - result.energy) < 1e-6);
}

void SimplexLabelingTest::solve_stopsOnRequest() {
  const Potts potts = sectors(256, 13, 256);
  std::stop_source stop;
  double asked = 0;
  const Progress progress(stop.get_token(), [&](const ProgressState&) {
    if (stop.stop_requested()) return;
    asked = cpu_time_ms();
    stop.request_stop();
  });
  SimplexSolver solver(256, 13, 256);
  Image<int> labels(256, 256);

  QVERIFY_THROWS_EXCEPTION(
      Cancelled, solver.solve(potts.problem(), {100000, 0, 1, {}}, progress, labels.view()));

  QVERIFY(stop.stop_requested());
  QVERIFY(cpu_time_ms() - asked < cpu_limit_of_a_stop_ms());
}

void SimplexLabelingTest::solve_refusesBadInput() {
  const Potts potts = test::random_costs<SimplexProblem>(6, 4, 7, 0.1);
  const Image<float> wrong(7, 6);
  Image<int> few(3, 3), labels(6, 7);
  SimplexSolver solver(6, 4, 7);
  SimplexProblem problem = potts.problem();

  QVERIFY_THROWS_EXCEPTION(InvalidInput, SimplexSolver(0, 4, 7));
  QVERIFY_THROWS_EXCEPTION(InvalidInput, SimplexSolver(6, kMaxSimplexLayers + 1, 7));
  QVERIFY_THROWS_EXCEPTION(InvalidInput, solver.solve({}, {}, Progress(1), labels.view()));
  QVERIFY_THROWS_EXCEPTION(InvalidInput, solver.solve(problem, {}, Progress(1), few.view()));
  problem.smoothness = -1;
  QVERIFY_THROWS_EXCEPTION(InvalidInput, solver.solve(problem, {}, Progress(1), labels.view()));
  problem = potts.problem();
  problem.g = wrong;
  QVERIFY_THROWS_EXCEPTION(InvalidInput, solver.solve(problem, {}, Progress(1), labels.view()));
}

void SimplexLabelingTest::energy_countsBoundariesOnce() {
  constexpr int kSize = 30;
  Volume<float> cost(kSize, 3, kSize);
  std::fill_n(cost.view().data, cost.view().size(), 0.0F);
  Image<int> halves(kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) halves.at(y, x) = x < 7 ? 0 : 2;
  }

  QVERIFY(std::fabs(test::potts_energy({cost.view(), {}, 1}, halves) - kSize) < 1e-4);
}

void SimplexLabelingTest::coarseLevels_keepConstantsAndTotals() {
  Volume<float> fine(5, 2, 7), coarse(3, 2, 4);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 7; ++x) {
      fine.view().at(y, 0, x) = 3;
      fine.view().at(y, 1, x) = static_cast<float>(x / 2);
    }
  }

  halve(fine.view(), Progress(1), coarse.view());

  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 4; ++x) {
      QCOMPARE(coarse.view().at(y, 0, x), 3.0F);
      QCOMPARE(coarse.view().at(y, 1, x), static_cast<float>(x));
    }
  }
}

}  // namespace episcope::in_simplex_labeling_test

EPISCOPE_TEST(simplex_labeling_test, SimplexLabelingTest)
#include "simplex_labeling_test.moc"
