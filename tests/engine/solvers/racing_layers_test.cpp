// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/layered_sweep.h"
#include "engine/solvers/simplex_labeling.h"
#include "tests/engine/solvers/random_costs.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace episcope::in_racing_layers_test {

namespace {

using Potts = test::Costs<SimplexProblem>;

constexpr int kTile = RacingLayers::kTileRows;

// Stripes of columns, each of a label that costs 0, all others 3; each pixel mistaken now and then.
Potts stripes(int height, int labels, int width, int mistakes_of_10, double smoothness = 4) {
  Potts potts = test::random_costs<SimplexProblem>(height, labels, width, smoothness);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int truth = x * labels / width;
      const bool is_wrong = potts.cost.view().at(y, 0, x) * 10 < static_cast<float>(mistakes_of_10);
      const int cheapest = is_wrong ? (truth + 1) % labels : truth;
      for (int l = 0; l < labels; ++l) {
        potts.cost.view().at(y, l, x) = l == cheapest ? 0.0F : 3.0F;
      }
    }
  }
  return potts;
}

std::vector<int> numbers_of(const LayerList& list) {
  return {list.layers, list.layers + list.count};
}

}  // namespace

class RacingLayersTest : public QObject {
  Q_OBJECT

 private slots:
  void allTakePartAtFirst() { QVERIFY(RacingLayers(20, 5, 300).row(7) == nullptr); }

  // Four tiles across of a label each, and a label elsewhere that is given.
  void choose_takesThoseThatAreNearAndGiven() {
    constexpr int kHeight = 4 * kTile, kWidth = 4 * kLayerColumns;
    const Potts potts = stripes(kHeight, 4, kWidth, 0);
    Image<int> labels(kHeight, kWidth);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) labels.at(y, x) = x / kLayerColumns;
    }
    labels.at(0, 0) = 3;
    RacingLayers racing(kHeight, 4, kWidth);

    racing.choose(potts.cost.view(), 1, labels, Progress());

    using Numbers = std::vector<int>;
    QCOMPARE(numbers_of(racing.row(0)[0].moving), (Numbers{0, 3}));
    QCOMPARE(numbers_of(racing.row(kTile)[0].moving), (Numbers{0, 3}));  // below it
    QCOMPARE(numbers_of(racing.row(2 * kTile)[0].moving), (Numbers{0}));
    QCOMPARE(numbers_of(racing.row(2 * kTile)[0].paired), (Numbers{0, 1}));
    QCOMPARE(numbers_of(racing.row(2 * kTile)[0].still), (Numbers{1, 3}));  // beside and above it
    QCOMPARE(numbers_of(racing.row(0)[3].moving), (Numbers{3}));
    QCOMPARE(numbers_of(racing.row(0)[3].paired), (Numbers{3}));
    QCOMPARE(numbers_of(racing.row(0)[3].still), (Numbers{2}));
  }

  void choose_takesAllWithinReach() {
    const Potts potts = stripes(kTile, 4, 4 * kLayerColumns, 0);
    const Image<int> labels(kTile, 4 * kLayerColumns);
    RacingLayers racing(kTile, 4, 4 * kLayerColumns);

    racing.choose(potts.cost.view(), 3.5F, labels, Progress());

    QCOMPARE(racing.row(0)[1].moving.count, 4);
    QCOMPARE(racing.row(0)[1].still.count, 0);
  }

  // The gap is that of the whole problem.
  void solver_reachesTheSameGap_data() {
    QTest::addColumn<int>("height");
    QTest::addColumn<int>("width");
    QTest::addColumn<int>("racing");
    QTest::addColumn<int>("threads");
    QTest::newRow("one thread") << 70 << 300 << 20 << 1;
    QTest::newRow("threads") << 70 << 300 << 20 << 2;
    QTest::newRow("bands") << 70 << 300 << 20 << 5;
    QTest::newRow("one tile") << kTile - 1 << 90 << 10 << 1;
    QTest::newRow("an odd number") << 41 << 141 << 13 << 1;
  }
  void solver_reachesTheSameGap() {
    QFETCH(int, height);
    QFETCH(int, width);
    QFETCH(int, racing);
    QFETCH(int, threads);
    const Potts potts = stripes(height, 7, width, 3);
    SimplexOptions options{500, 1e-3, 5, {}};
    SimplexSolver solver(height, 7, width), other(height, 7, width);
    Image<int> labels(height, width), wanted(height, width);

    const auto whole = other.solve(potts.problem(), options, Progress(threads), wanted.view());
    options.racing_iterations = racing;
    const auto raced = solver.solve(potts.problem(), options, Progress(threads), labels.view());

    QVERIFY(whole.converged && raced.converged);
    QVERIFY(raced.iterations > racing);
    QVERIFY(std::fabs(raced.relaxed - whole.relaxed) <= 2e-3 * whole.relaxed);
    QVERIFY(raced.bound <= whole.energy && whole.bound <= raced.energy);
    QVERIFY(std::fabs(test::potts_energy(potts.problem(), labels) - raced.energy) < 1e-3);
  }

  void solver_isTheSameForAnyThreads() {
    const Potts potts = stripes(75, 6, 270, 3);
    const auto solve = [&](int threads) {
      SimplexSolver solver(75, 6, 270);
      SimplexOptions options{35, 0, 5, {}};
      options.racing_iterations = 20;
      Image<int> labels(75, 270);
      solver.solve(potts.problem(), options, Progress(threads), labels.view());
      return labels;
    };

    const Image<int> one = solve(1);

    QVERIFY(test::same_labels(one, solve(2)));
    QVERIFY(test::same_labels(one, solve(6)));
  }

  // Asked to finish while far labels are left out: theirs is 0, also of what came from elsewhere.
  void solver_keepsWhatIsLeftOutAtZero() {
    constexpr int kHeight = 3 * kTile, kWidth = 3 * kLayerColumns;
    Potts before = stripes(kHeight, 5, kWidth, 0, 30);
    const Potts after = stripes(kHeight, 5, kWidth, 0, 30);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = y % 3; x < kWidth; x += 3) {
        for (int l = 0; l < 5; ++l) before.cost.view().at(y, l, x) = l == 4 ? 0.0F : 3.0F;
      }
    }
    Image<std::int32_t> same_place(kHeight, kWidth);
    std::fill(same_place.begin(), same_place.end(), -1);
    SimplexSolver solver(kHeight, 5, kWidth);
    Image<int> labels(kHeight, kWidth);
    const auto amount_on_left_of_last = [&] {
      LayeredSweep& sweep = solver.unknowns();
      const long last = 4 * sweep.shape().pitch;
      double sum = 0;
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kLayerColumns; ++x) {
          sum += std::fabs(sweep.phi(y)[last + x]);
          for (const float* pair : sweep.duals(y).pair) sum += std::fabs(pair[last + x]);
        }
      }
      return sum;
    };

    solver.solve(before.problem(), {40, 0, 5, {}}, Progress(), labels.view());
    QVERIFY(amount_on_left_of_last() > 0);
    SimplexOptions options{5, 0, 5, same_place};
    options.racing_iterations = 10;
    solver.solve(after.problem(), options, Progress(), labels.view());

    QCOMPARE(amount_on_left_of_last(), 0.0);
  }
};

}  // namespace episcope::in_racing_layers_test

EPISCOPE_TEST(racing_layers_test, RacingLayersTest)
#include "racing_layers_test.moc"
