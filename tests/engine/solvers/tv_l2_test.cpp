// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/tv_l2.h"
#include "engine/core/error.h"
#include "tests/cpu_time.h"
#include "tests/engine/solvers/tv_l2_reference.h"
#include "tests/test_main.h"

#include <cmath>
#include <limits>
#include <random>
#include <thread>

namespace episcope::in_tv_l2_test {

namespace {

struct Images {
  Image<float> f, w, g;
  double lambda = 0.3;
  [[nodiscard]] TvL2Problem problem() const { return {f.view(), w.view(), g.view(), lambda}; }
};

// A tilted plane with a step, noise, outliers of little weight and weak edges along the step.
Images noisy_step(int height, int width, float min_weight = 0.02F) {
  Images images{Image<float>(height, width), Image<float>(height, width),
                Image<float>(height, width)};
  std::mt19937 random(7);
  std::normal_distribution<float> noise(0.0F, 0.05F);
  std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool outlier = uniform(random) < 0.1F;
      images.f.at(y, x) = 0.01F * static_cast<float>(x) + (2 * x + y > width ? 1.0F : 0.0F) +
                          noise(random) + (outlier ? 2.0F : 0.0F);
      images.w.at(y, x) = outlier ? min_weight : 0.3F + 0.7F * uniform(random);
      images.g.at(y, x) = 0.2F + 0.8F * uniform(random);
    }
  }
  return images;
}

TvL2Result solve(const TvL2Problem& problem, Image<float>& u, int iterations = 2000,
                 Isa isa = best_isa()) {
  u = Image<float>(problem.f.height, problem.f.width);
  TvL2Solver solver(problem.f.height, problem.f.width, isa);
  return solver.solve(problem, {iterations, 1e-6, 20}, Progress(1), u.view());
}

double largest_difference(const Image<float>& a, const Image<float>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::fabs(static_cast<double>(a.data()[i]) - b.data()[i]));
  }
  return largest;
}

}  // namespace

class TvL2Test : public QObject {
  Q_OBJECT

 private slots:
  void solve_agreesWithReference_data();
  void solve_agreesWithReference();
  void solve_isTheSameForEveryIsa();
  void solve_leavesConstantAlone();
  void solve_movesStepByLambdaOverLength_data();
  void solve_movesStepByLambdaOverLength();
  void solve_tendsToWeightedMean();
  void solve_scalesWithData();
  void solve_ignoresOldContentAndEarlierCalls();
  void solve_takesObservationInPlace();
  void solve_fillsUnknownPixels();
  void gap_isPositiveAndFalls();
  void gap_boundsTheEnergy();
  void measure_usesAdjointOperators();
  void solve_endsEarlyWhenAskedToFinish();
  void solve_stopsOnRequest();
  void solve_refusesBadInput();
};

void TvL2Test::solve_agreesWithReference_data() {
  QTest::addColumn<int>("height");
  QTest::addColumn<int>("width");
  const int sizes[][2] = {{1, 1},  {1, 2}, {2, 1},   {2, 2},  {1, 37},
                          {23, 1}, {3, 5}, {17, 33}, {31, 20}};
  for (const auto& size : sizes) {
    QTest::addRow("%d by %d", size[1], size[0]) << size[0] << size[1];
  }
}

void TvL2Test::solve_agreesWithReference() {
  QFETCH(int, height);
  QFETCH(int, width);
  const Images images = noisy_step(height, width);
  TvL2Reference reference(images.problem());
  reference.run(20000);

  Image<float> u;
  const TvL2Result result = solve(images.problem(), u);

  QVERIFY2(reference.largest_difference(u) < 1e-3,
           qPrintable(QString::number(reference.largest_difference(u))));
  QVERIFY(std::fabs(result.energy - reference.energy(u)) <= 1e-5 * result.energy + 1e-6);
}

void TvL2Test::solve_isTheSameForEveryIsa() {
  const Images images = noisy_step(45, 70);
  Image<float> baseline;
  solve(images.problem(), baseline, 60, Isa::Baseline);

  for (const Isa isa : {Isa::Avx2, Isa::Avx512}) {
    if (best_isa() < isa) continue;
    Image<float> u;
    solve(images.problem(), u, 60, isa);
    QVERIFY2(largest_difference(u, baseline) < 1e-4, isa_name(isa));
  }
}

void TvL2Test::solve_leavesConstantAlone() {
  Images images = noisy_step(19, 26);
  std::fill(images.f.begin(), images.f.end(), -1.25F);

  Image<float> u;
  const TvL2Result result = solve(images.problem(), u, 20);

  for (const float value : u) QVERIFY(std::fabs(value + 1.25F) < 1e-6F);
  QVERIFY(result.energy < 1e-9);
}

void TvL2Test::solve_movesStepByLambdaOverLength_data() {
  QTest::addColumn<bool>("vertical");
  QTest::addColumn<double>("lambda");
  QTest::newRow("row") << false << 2.0;
  QTest::newRow("column") << true << 2.0;
  QTest::newRow("row, until equal") << false << 40.0;
}

void TvL2Test::solve_movesStepByLambdaOverLength() {
  QFETCH(bool, vertical);
  QFETCH(double, lambda);
  constexpr int kHalf = 20;
  Image<float> f(vertical ? 2 * kHalf : 1, vertical ? 1 : 2 * kHalf);
  for (int i = kHalf; i < 2 * kHalf; ++i) f.data()[i] = 1.0F;

  Image<float> u;
  solve({f.view(), {}, {}, lambda}, u);

  const double shift = std::min(0.5, lambda / kHalf);
  for (int i = 0; i < 2 * kHalf; ++i) {
    const double expected = i < kHalf ? shift : 1 - shift;
    QVERIFY(std::fabs(u.data()[i] - expected) < 1e-4);
  }
}

void TvL2Test::solve_tendsToWeightedMean() {
  Images images = noisy_step(21, 30);
  images.lambda = 1e4;
  double sum = 0, weight = 0;
  for (std::size_t i = 0; i < images.f.size(); ++i) {
    sum += static_cast<double>(images.w.data()[i]) * images.f.data()[i];
    weight += images.w.data()[i];
  }

  Image<float> u;
  solve(images.problem(), u);

  for (const float value : u) QVERIFY(std::fabs(value - sum / weight) < 1e-3);
}

void TvL2Test::solve_scalesWithData() {
  const Images images = noisy_step(24, 24);
  Images large = images;
  for (float& value : large.f) value = 100 * value + 7;
  large.lambda *= 100;
  Image<float> u, large_u;

  solve(images.problem(), u, 40);
  solve(large.problem(), large_u, 40);

  for (std::size_t i = 0; i < u.size(); ++i) {
    QVERIFY(std::fabs(large_u.data()[i] - (100 * u.data()[i] + 7)) < 2e-2F);
  }
}

void TvL2Test::solve_ignoresOldContentAndEarlierCalls() {
  const Images first = noisy_step(24, 37);
  Images second = first;
  for (float& value : second.f) value = -3 * value;
  Image<float> fresh;
  solve(first.problem(), fresh, 25);
  TvL2Solver solver(24, 37);
  Image<float> u(24, 37, 1, 1e6F);

  solver.solve(second.problem(), {25, 1e-6, 20}, Progress(1), u.view());
  solver.solve(first.problem(), {25, 1e-6, 20}, Progress(1), u.view());

  QCOMPARE(largest_difference(u, fresh), 0.0);
}

void TvL2Test::solve_takesObservationInPlace() {
  Images images = noisy_step(24, 37);
  Image<float> expected;
  solve(images.problem(), expected, 25);
  TvL2Solver solver(24, 37);

  solver.solve(images.problem(), {25, 1e-6, 20}, Progress(1), images.f.view());

  QCOMPARE(largest_difference(images.f, expected), 0.0);
}

void TvL2Test::solve_fillsUnknownPixels() {
  Image<float> f(33, 33, 1, 0.5F);
  for (int y = 8; y < 24; ++y) {
    for (int x = 8; x < 24; ++x) {
      f.at(y, x) = (x & 1) != 0 ? std::numeric_limits<float>::quiet_NaN()
                                : std::numeric_limits<float>::infinity();
    }
  }

  Image<float> u;
  solve({f.view(), {}, {}, 0.1}, u, 300);

  // Unknown pixels are taken as 0 with the least weight, 1e-4: they pull by less than 1e-2.
  for (const float value : u) QVERIFY(std::fabs(value - 0.5F) < 1e-2F);
}

void TvL2Test::gap_isPositiveAndFalls() {
  const Images images = noisy_step(64, 90, 1e-3F);
  double before = std::numeric_limits<double>::infinity();

  for (const int iterations : {1, 5, 20, 80, 320}) {
    Image<float> u;
    const TvL2Result result = solve(images.problem(), u, iterations);
    QVERIFY(result.gap >= -1e-6 * result.energy);
    QVERIFY(result.gap < before);
    before = result.gap;
  }
}

void TvL2Test::gap_boundsTheEnergy() {
  const Images images = noisy_step(40, 51);
  Image<float> rough, fine;

  const TvL2Result early = solve(images.problem(), rough, 10);
  const TvL2Result late = solve(images.problem(), fine, 2000);

  QVERIFY(late.converged);
  QVERIFY(late.gap <= 1e-6 * late.energy);
  QVERIFY(early.energy - late.energy <= early.gap);
  QVERIFY(early.energy >= late.energy * (1 - 1e-6));
}

void TvL2Test::measure_usesAdjointOperators() {
  constexpr int kHeight = 13, kWidth = 29;
  TvL2Grid grid(kHeight, kWidth);
  TvL2Level& level = grid.level;
  Image<float> f(kHeight, kWidth);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-0.5F, 0.5F);
  double product = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const long i = level.at(y, x);
      f.at(y, x) = uniform(random);
      level.g[i] = 1;      // |p| < 1: the projection leaves p alone
      level.c[i] = 1e12F;  // D(p) = −⟨f, div p⟩
      level.cf[i] = 1e12F * f.at(y, x);
      level.zx[i] = x + 1 < kWidth ? uniform(random) : 0.0F;
      level.zy[i] = y + 1 < kHeight ? uniform(random) : 0.0F;
    }
  }
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const long i = level.at(y, x);
      const float right = f.at(y, std::min(x + 1, kWidth - 1));
      const float below = f.at(std::min(y + 1, kHeight - 1), x);
      product += static_cast<double>(level.zx[i]) * (right - f.at(y, x));
      product += static_cast<double>(level.zy[i]) * (below - f.at(y, x));
    }
  }

  const TvL2Sums sums = baseline::kTvL2PenaltyKernel.measure(level, grid.row);

  QVERIFY(std::fabs(sums.dual - product) < 1e-5 * std::fabs(product));
}

void TvL2Test::solve_endsEarlyWhenAskedToFinish() {
  const Images images = noisy_step(40, 50);
  std::stop_source finish;
  finish.request_stop();
  Image<float> u(40, 50);

  const TvL2Result result = TvL2Solver(40, 50).solve(
      images.problem(), {100000, 0, 10}, Progress({}, finish.get_token(), {}, 1), u.view());

  QCOMPARE(result.iterations, 1);
  QVERIFY(result.gap > 0);
}

void TvL2Test::solve_stopsOnRequest() {
  const Images images = noisy_step(512, 512);
  Image<float> u(512, 512);
  TvL2Solver solver(512, 512);
  std::stop_source stop;
  double asked = 0;
  std::jthread asker([&] {
    Image<float> other;
    solve(images.problem(), other, 10);  // about as long as the coarse levels of the solve below
    asked = cpu_time_ms();
    stop.request_stop();
  });

  QVERIFY_THROWS_EXCEPTION(Cancelled, solver.solve(images.problem(), {1000000, 0, 20},
                                                   Progress(stop.get_token(), {}, 1), u.view()));

  asker.join();
  QVERIFY(cpu_time_ms() - asked < cpu_limit_of_a_stop_ms());
}

void TvL2Test::solve_refusesBadInput() {
  const Images images = noisy_step(8, 9);
  Image<float> u(8, 9), wrong(9, 8);
  TvL2Solver solver(8, 9);
  TvL2Problem problem = images.problem();

  QVERIFY_THROWS_EXCEPTION(InvalidInput, TvL2Solver(0, 9));
  QVERIFY_THROWS_EXCEPTION(InvalidInput, solver.solve(problem, {}, Progress(1), wrong.view()));
  problem.lambda = 0;
  QVERIFY_THROWS_EXCEPTION(InvalidInput, solver.solve(problem, {}, Progress(1), u.view()));
  problem = images.problem();
  problem.w = wrong.view();
  QVERIFY_THROWS_EXCEPTION(InvalidInput, solver.solve(problem, {}, Progress(1), u.view()));
}

}  // namespace episcope::in_tv_l2_test

EPISCOPE_TEST(tv_l2_test, TvL2Test)
#include "tv_l2_test.moc"
