// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/solve_views.h"

#include "tests/test_main.h"

#include <algorithm>
#include <stop_token>

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
  void solve_knowsTheLastProblems();
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
}

void KeptSolverTest::solve_knowsTheLastProblems() {
  const LabelProbabilities some = of_size(8, 6, {1, 2});
  const auto problem_of = [](const Volume<float>& costs) {
    return SimplexProblem{costs.view(), {}, 2};
  };
  Volume<float> before(8, 2, 6), after(8, 2, 6);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 6; ++x) {
      before.view().row(y, 0)[x] = after.view().row(y, 0)[x] = static_cast<float>(y % 3);
      before.view().row(y, 1)[x] = after.view().row(y, 1)[x] = static_cast<float>(x % 2);
    }
  }
  after.view().row(3, 1)[4] = 20;
  KeptSolver kept;
  Image<int> first(8, 6), second(8, 6), again(8, 6);
  const SimplexOptions options{200, 1e-3, 5, {}};
  QVERIFY(!kept.prepare(some, {0, 0}));

  kept.solve(problem_of(before), options, Progress(1), first.view());
  kept.solve(problem_of(after), options, Progress(1), second.view());
  int reports = 0;
  const Progress told(std::stop_token(), [&](const ProgressState&) { ++reports; });
  const SimplexResult known = kept.solve(problem_of(before), options, told, again.view());

  QCOMPARE(reports, 0);
  QVERIFY(known.converged);
  QVERIFY(std::ranges::equal(again, first));
  QCOMPARE(second.at(3, 4), 0);
}

}  // namespace episcope::in_kept_solver_test

EPISCOPE_TEST(kept_solver_test, KeptSolverTest)
#include "kept_solver_test.moc"
