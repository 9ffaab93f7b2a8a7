// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/solvers/message_labeling.h"
#include "tests/engine/solvers/random_costs.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>

namespace episcope::in_message_labeling_test {

using namespace episcope::test;

namespace {

// MessageProblem with weights from one image; `smoothness` is the cost of one label of difference.
struct Problem {
  VolumeView<const float> cost;
  ImageView<const float> g;
  double smoothness = 1;
};

MessageProblem stated(const Problem& problem) {
  return {problem.cost, problem.g, problem.g, static_cast<float>(problem.smoothness),
          static_cast<float>(1.5 * problem.smoothness)};
}

double energy(const Problem& problem, ImageView<const int> labels) {
  double sum = 0;
  const auto jump = [&](int a, int b) {
    return problem.smoothness * std::min(1.5, static_cast<double>(std::abs(a - b)));
  };
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      const int here = labels.at(y, x);
      sum += problem.cost.at(y, here, x);
      if (x + 1 < labels.width) sum += problem.g.at(y, x) * jump(here, labels.at(y, x + 1));
      if (y + 1 < labels.height) sum += problem.g.at(y, x) * jump(here, labels.at(y + 1, x));
    }
  }
  return sum;
}

}  // namespace

class MessageLabelingTest : public QObject {
  Q_OBJECT

 private slots:
  void chain_isSolvedAtOnce_data();
  void chain_isSolvedAtOnce();
  void bound_isBelowTheLeastEnergy_data();
  void bound_isBelowTheLeastEnergy();
  void gap_closesOnImages();
  void thinLine_survivesWhateverItsHeight();
  void threads_changeNothing();
  void wrongProblems_areRefused();
};

void MessageLabelingTest::chain_isSolvedAtOnce_data() {
  QTest::addColumn<int>("height");
  QTest::addColumn<int>("width");
  QTest::newRow("row") << 1 << 8;
  QTest::newRow("column") << 8 << 1;
}

void MessageLabelingTest::chain_isSolvedAtOnce() {
  QFETCH(int, height);
  QFETCH(int, width);
  const auto costs = random_costs<Problem>(height, 4, width, 0.4);

  const MessageResult result = solve_by_messages(stated(costs.problem()), 1, Progress());

  const double least = least_energy<Problem>(costs.problem(), energy);
  QVERIFY2(std::abs(result.energy - least) < 1e-4, qPrintable(QString::number(result.energy)));
  QVERIFY2(std::abs(result.bound - least) < 1e-4, qPrintable(QString::number(result.bound)));
}

void MessageLabelingTest::bound_isBelowTheLeastEnergy_data() {
  QTest::addColumn<unsigned>("seed");
  for (unsigned seed = 1; seed <= 6; ++seed) QTest::addRow("seed %u", seed) << seed;
}

void MessageLabelingTest::bound_isBelowTheLeastEnergy() {
  QFETCH(unsigned, seed);
  const auto costs = random_costs<Problem>(3, 3, 4, 0.3, seed);

  const MessageResult result = solve_by_messages(stated(costs.problem()), 30, Progress());

  const double least = least_energy<Problem>(costs.problem(), energy);
  QVERIFY2(result.bound <= least + 1e-4, qPrintable(QString::number(result.bound)));
  QVERIFY(result.energy >= least - 1e-4);
  QVERIFY2(result.energy <= 1.02 * least, qPrintable(QString::number(result.energy / least)));
  QVERIFY(std::abs(energy(costs.problem(), result.labels) - result.energy) < 1e-4);
}

void MessageLabelingTest::gap_closesOnImages() {
  const auto costs = random_costs<Problem>(50, 20, 70, 0.05);

  const MessageResult first = solve_by_messages(stated(costs.problem()), 1, Progress());
  const MessageResult later = solve_by_messages(stated(costs.problem()), 10, Progress());

  QVERIFY(later.bound >= first.bound);
  const double gap = (later.energy - later.bound) / later.energy;
  QVERIFY2(gap >= 0 && gap < 0.02, qPrintable(QString::number(gap)));
}

void MessageLabelingTest::thinLine_survivesWhateverItsHeight() {
  Volume<float> volume(20, 64, 30);
  for (int y = 0; y < 20; ++y) {
    for (int label = 0; label < 64; ++label) {
      for (int x = 0; x < 30; ++x) {
        const int truth = x == 12 ? 60 : 3;
        volume.view().at(y, label, x) = label == truth ? 0.0F : 1.0F;
      }
    }
  }

  const MessageResult result = solve_by_messages(
      {.cost = volume.view(), .across = {}, .down = {}, .slope = 0.1F, .most = 0.4F}, 4,
      Progress());

  for (int y = 0; y < 20; ++y) {
    QCOMPARE(result.labels.at(y, 12), 60);
    QCOMPARE(result.labels.at(y, 13), 3);
  }
}

void MessageLabelingTest::threads_changeNothing() {
  const auto costs = random_costs<Problem>(70, 21, 90, 0.1);

  const MessageResult one = solve_by_messages(stated(costs.problem()), 3, Progress(1));
  const MessageResult three = solve_by_messages(stated(costs.problem()), 3, Progress(3));

  QVERIFY(same_labels(one.labels, three.labels));
  QCOMPARE(one.bound, three.bound);
}

void MessageLabelingTest::wrongProblems_areRefused() {
  const auto costs = random_costs<Problem>(4, 3, 5, 0.1);
  MessageProblem problem = stated(costs.problem());
  const Image<float> other(4, 4);

  problem.across = other;
  QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)solve_by_messages(problem, 1, Progress()));
  problem = stated(costs.problem());
  problem.slope = 0;
  QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)solve_by_messages(problem, 1, Progress()));
}

}  // namespace episcope::in_message_labeling_test

EPISCOPE_TEST(message_labeling_test, MessageLabelingTest)
#include "message_labeling_test.moc"
