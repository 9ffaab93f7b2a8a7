// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/kept_solver.h"

#include "engine/solvers/lifted/layered_sweep.h"
#include "tests/test_main.h"

namespace episcope::in_kept_solver_test {

namespace {

LabelProbabilities of_size(int height, int width, const std::vector<std::int32_t>& ids) {
  LabelProbabilities probabilities = empty_probabilities(ids, {{0, 0}, {1, 2}});
  for (ProbabilityMap& map : probabilities.views) {
    map = ProbabilityMap(height, static_cast<int>(ids.size()), width);
  }
  return probabilities;
}

}  // namespace

class KeptSolverTest : public QObject {
  Q_OBJECT

 private slots:
  void prepare_goesOnOnlyForTheSameProblem();
};

void KeptSolverTest::prepare_goesOnOnlyForTheSameProblem() {
  const LabelProbabilities some = of_size(8, 6, {1, 2}), larger = of_size(8, 7, {1, 2});
  const LabelProbabilities other = of_size(8, 7, {1, 3}), more = of_size(8, 7, {1, 3, 4});
  KeptSolver kept;

  QVERIFY(!kept.prepare(some, {0, 0}));
  QVERIFY(kept.prepare(some, {0, 0}));
  QVERIFY(!kept.prepare(some, {0, 1}));
  QVERIFY(!kept.prepare(larger, {0, 1}));
  QVERIFY(!kept.prepare(other, {0, 1}));
  QVERIFY(!kept.prepare(more, {0, 1}));
  QVERIFY(kept.prepare(more, {0, 1}));
  kept.drop();
  QVERIFY(!kept.prepare(more, {0, 1}));
  QCOMPARE(kept.solver().unknowns().shape().steps, 3);
}

}  // namespace episcope::in_kept_solver_test

EPISCOPE_TEST(kept_solver_test, KeptSolverTest)
#include "kept_solver_test.moc"
