// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/linked_labeling.h"
#include "engine/core/error.h"
#include "engine/solvers/simplex_labeling.h"
#include "tests/cpu_time.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

namespace episcope::in_linked_labeling_test {

namespace {

using Labels = std::vector<Image<int>>;

struct Shape {
  int rows = 1, columns = 2;  // of images
  int height = 2, labels = 3, width = 2;
};

// Images in a grid, each linked to its right and lower neighbor, `shift` pixels to the left and
// upwards; their costs are random, or an image of stripes that moves likewise, with errors.
class Problem {
 public:
  Problem(const Shape& shape, double smoothness, double coherence, unsigned seed = 5)
      : shape_(shape), random_(seed) {
    problem_.smoothness = smoothness;
    problem_.coherence = coherence;
    for (int i = 0; i < 256; ++i) problem_.table[i] = static_cast<float>(i) / 255;
    for (int i = 0; i < images(); ++i) {
      codes_.emplace_back(shape.height, shape.labels, shape.width);
      weights_.emplace_back(shape.height, shape.width);
      for (auto& code : span_of(codes_.back())) code = static_cast<std::uint8_t>(random_() % 256);
      for (float& g : weights_.back()) g = 0.2F + 0.8F * uniform_(random_);
    }
    link(0);
    borrow();
  }

  /// Costs of stripes that move with the lines, each pixel mistaken now and then.
  void draw_stripes(double mistakes) {
    for (int i = 0; i < images(); ++i) {
      const int moved = i % shape_.columns * shift_;
      for (int y = 0; y < shape_.height; ++y) {
        for (int x = 0; x < shape_.width; ++x) {
          int told = (x + moved) / 8 % shape_.labels;
          if (uniform_(random_) < mistakes) told = static_cast<int>(random_() % shape_.labels);
          for (int l = 0; l < shape_.labels; ++l) {
            codes_[i].view().at(y, l, x) = static_cast<std::uint8_t>(l == told ? 20 : 220);
          }
        }
      }
    }
  }

  void link(int shift) {
    shift_ = shift;
    targets_.clear();
    for (int i = 0; i < images(); ++i) {
      for (const bool down : {false, true}) {
        Image<std::int32_t>& target = targets_.emplace_back(shape_.height, shape_.width);
        for (int y = 0; y < shape_.height; ++y) {
          for (int x = 0; x < shape_.width; ++x) {
            const int to_x = down ? x : x - shift, to_y = down ? y - shift : y;
            target.at(y, x) = to_x < 0 || to_y < 0 ? -1 : to_y * shape_.width + to_x;
          }
        }
      }
    }
    borrow();
  }

  [[nodiscard]] LinkedProblem& operator*() { return problem_; }
  [[nodiscard]] int images() const { return shape_.rows * shape_.columns; }
  [[nodiscard]] Labels labels() const {
    Labels labels;
    for (int i = 0; i < images(); ++i) labels.emplace_back(shape_.height, shape_.width);
    return labels;
  }
  /// The costs and boundaries of one image by themselves.
  [[nodiscard]] Volume<float> costs(int image) const {
    Volume<float> costs(shape_.height, shape_.labels, shape_.width);
    const auto codes = codes_[image].view();
    for (std::size_t i = 0; i < codes.size(); ++i) {
      costs.view().data[i] = problem_.table[codes.data[i]];
    }
    return costs;
  }

 private:
  static std::span<std::uint8_t> span_of(Volume<std::uint8_t>& codes) {
    return {codes.view().data, codes.view().size()};
  }
  void borrow() {
    problem_.images.clear();
    for (int i = 0; i < images(); ++i) {
      LinkedImage image{codes_[i].view(), weights_[i], {}};
      if (i % shape_.columns + 1 < shape_.columns) image.links[0] = {i + 1, targets_[2 * i], {}};
      if (i + shape_.columns < images()) {
        image.links[1] = {i + shape_.columns, targets_[2 * i + 1], {}};
      }
      problem_.images.push_back(image);
    }
  }

  Shape shape_;
  int shift_ = 0;
  std::mt19937 random_;
  std::uniform_real_distribution<float> uniform_;
  std::vector<Volume<std::uint8_t>> codes_;
  std::vector<Image<float>> weights_;
  std::vector<Image<std::int32_t>> targets_;
  LinkedProblem problem_;
};

std::vector<ImageView<int>> views_of(Labels& labels) {
  std::vector<ImageView<int>> views;
  for (Image<int>& image : labels) views.push_back(image.view());
  return views;
}
double energy_of(const LinkedProblem& problem, const Labels& labels) {
  return linked_energy(problem, {labels.begin(), labels.end()});
}

struct Solved {
  LinkedResult result;
  Labels labels;
};

Solved solve(Problem& problem, LinkedOptions options = {}, int threads = 1) {
  Solved solved{{}, problem.labels()};
  solved.result =
      solve_linked_labeling(*problem, options, Progress(threads), views_of(solved.labels));
  return solved;
}

// One labeling after the other.
double least_energy(Problem& problem, int layers) {
  Labels labels = problem.labels();
  std::vector<int*> pixels;
  for (Image<int>& image : labels) {
    for (int& label : image) {
      label = 0;
      pixels.push_back(&label);
    }
  }
  double least = std::numeric_limits<double>::infinity();
  while (true) {
    least = std::min(least, energy_of(*problem, labels));
    std::size_t i = 0;
    while (i < pixels.size() && ++*pixels[i] == layers) *pixels[i++] = 0;
    if (i == pixels.size()) return least;
  }
}

bool are_same(const Labels& a, const Labels& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!std::equal(a[i].begin(), a[i].end(), b[i].begin())) return false;
  }
  return a.size() == b.size();
}

}  // namespace

class LinkedLabelingTest : public QObject {
  Q_OBJECT

 private slots:
  void solve_isWithinItsGapOfTheBest_data();
  void solve_isWithinItsGapOfTheBest();
  void solve_withoutCoherenceSolvesEachImage();
  void solve_ofMuchCoherenceGivesOneLabelToALine();
  void solve_isNoWorseThanAVoteOfTheLines();
  void energy_countsLinksOnce();
  void bound_staysBelowEnergyAndGapFalls();
  void solve_isTheSameForAnyThreads();
  void solve_isTheSameForEveryIsa();
  void solve_keepsTheBestWhenAskedToFinish();
  void solve_stopsOnRequest();
  void solve_refusesBadInput();
};

void LinkedLabelingTest::solve_isWithinItsGapOfTheBest_data() {
  QTest::addColumn<int>("rows");
  QTest::addColumn<int>("columns");
  QTest::addColumn<double>("smoothness");
  QTest::addColumn<double>("coherence");
  QTest::newRow("a row") << 1 << 3 << 0.2 << 0.3;
  QTest::newRow("a column") << 3 << 1 << 0.2 << 0.3;
  QTest::newRow("lines only") << 1 << 3 << 0.0 << 0.5;
  QTest::newRow("much of both") << 1 << 3 << 1.5 << 2.0;
  QTest::newRow("a grid") << 2 << 2 << 0.3 << 0.3;
}

void LinkedLabelingTest::solve_isWithinItsGapOfTheBest() {
  QFETCH(int, rows);
  QFETCH(int, columns);
  QFETCH(double, smoothness);
  QFETCH(double, coherence);
  const Shape shape{rows, columns, 1, 3, 10 / (rows * columns)};
  for (unsigned seed = 1; seed <= 3; ++seed) {
    Problem problem(shape, smoothness, coherence, seed);
    problem.link(columns > 1 ? 1 : 0);
    const double least = least_energy(problem, shape.labels);

    const auto [result, labels] = solve(problem, {3000, 1e-4, 10});

    // With three labels the relaxation may lie below the best labeling, but nothing lies below it.
    QVERIFY2(result.bound <= least * (1 + 1e-5),
             qPrintable(QString("%1 and not %2").arg(result.bound).arg(least)));
    QVERIFY(result.energy >= least * (1 - 1e-5));
    QVERIFY2(result.energy <= least * 1.02,
             qPrintable(QString("%1 and not %2").arg(result.energy).arg(least)));
    QVERIFY2(result.relative_gap() < 0.02, qPrintable(QString::number(result.relative_gap())));
    QVERIFY(std::fabs(energy_of(*problem, labels) - result.energy) < 1e-5);
  }
}

void LinkedLabelingTest::solve_withoutCoherenceSolvesEachImage() {
  Problem problem({1, 3, 24, 4, 31}, 0.5, 0);
  problem.link(2);

  const auto [result, labels] = solve(problem, {1000, 1e-3, 10});

  double alone = 0;
  for (int i = 0; i < 3; ++i) {
    const Volume<float> costs = problem.costs(i);
    Image<int> ignored(24, 31);
    SimplexSolver solver(24, 4, 31);
    alone += solver
                 .solve({costs.view(), (*problem).images[i].g, 0.5}, {1000, 1e-4, 10, {}},
                        Progress(1), ignored.view())
                 .energy;
  }
  QVERIFY2(result.converged, qPrintable(QString::number(result.relative_gap())));
  QVERIFY(std::fabs(result.energy - alone) < 2e-3 * alone);
}

void LinkedLabelingTest::solve_ofMuchCoherenceGivesOneLabelToALine() {
  Problem problem({1, 5, 16, 3, 40}, 0.05, 50);
  problem.link(2);
  problem.draw_stripes(0.4);

  const Labels labels = solve(problem, {2000, 1e-3, 10}).labels;

  int differing = 0;
  for (int i = 0; i + 1 < 5; ++i) {
    for (int y = 0; y < 16; ++y) {
      for (int x = 2; x < 40; ++x) differing += labels[i].at(y, x) != labels[i + 1].at(y, x - 2);
    }
  }
  QCOMPARE(differing, 0);
}

// What it replaces: images solved alone, then the majority of each line.
void LinkedLabelingTest::solve_isNoWorseThanAVoteOfTheLines() {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    Problem problem({1, 5, 20, 3, 40}, 0.3, 0.3, seed);
    problem.link(1);
    problem.draw_stripes(0.5);
    Problem apart({1, 5, 20, 3, 40}, 0.3, 0, seed);
    apart.draw_stripes(0.5);
    Labels voted = solve(apart, {1000, 1e-3, 10}).labels;
    for (int y = 0; y < 20; ++y) {
      for (int x = 4; x < 40; ++x) {
        int votes[3] = {};
        for (int i = 0; i < 5; ++i) ++votes[voted[i].at(y, x - i)];
        const int most = static_cast<int>(std::max_element(votes, votes + 3) - votes);
        for (int i = 0; i < 5; ++i) voted[i].at(y, x - i) = most;
      }
    }

    const LinkedResult together = solve(problem, {1000, 1e-3, 10}).result;

    QVERIFY(together.energy <= energy_of(*problem, voted));
  }
}

void LinkedLabelingTest::energy_countsLinksOnce() {
  Problem problem({2, 2, 4, 2, 5}, 0, 0.25);
  (*problem).table.fill(0);
  Labels labels = problem.labels();
  for (Image<int>& image : labels) std::fill(image.begin(), image.end(), 0);
  labels[0].at(2, 3) = 1;  // linked to the right and downwards
  QCOMPARE(energy_of(*problem, labels), 0.5);

  const std::vector<std::uint8_t> half(20, 51);  // of 255
  (*problem).images[0].links[0].weight = {half.data(), 4, 5, 1, 5};
  QVERIFY(std::fabs(energy_of(*problem, labels) - 0.3) < 1e-6);
}

void LinkedLabelingTest::bound_staysBelowEnergyAndGapFalls() {
  Problem problem({2, 3, 32, 5, 40}, 0.5, 0.5);
  problem.link(1);
  problem.draw_stripes(0.4);
  double gap = std::numeric_limits<double>::infinity();

  for (const int iterations : {5, 20, 80, 320}) {
    const LinkedResult result = solve(problem, {iterations, 0, 10}).result;
    QVERIFY(result.bound <= result.energy);
    QVERIFY(result.relative_gap() <= gap);
    gap = result.relative_gap();
  }
  QVERIFY2(gap < 2e-3, qPrintable(QString::number(gap)));
}

void LinkedLabelingTest::solve_isTheSameForAnyThreads() {
  Problem problem({2, 3, 33, 5, 41}, 0.5, 0.5);
  problem.link(1);
  problem.draw_stripes(0.4);

  const auto one = solve(problem, {30, 0, 10}, 1);
  const auto five = solve(problem, {30, 0, 10}, 5);

  QVERIFY(are_same(one.labels, five.labels));
  QCOMPARE(five.result.energy, one.result.energy);
  QCOMPARE(five.result.bound, one.result.bound);
}

void LinkedLabelingTest::solve_isTheSameForEveryIsa() {
  Problem problem({2, 2, 33, 9, 41}, 0.5, 0.5);
  problem.link(1);
  problem.draw_stripes(0.4);
  const LinkedResult baseline = solve(problem, {40, 0, 10, Isa::Baseline}).result;

  for (const Isa isa : {Isa::Avx2, Isa::Avx512}) {
    if (best_isa() < isa) continue;
    const LinkedResult result = solve(problem, {40, 0, 10, isa}).result;
    QVERIFY2(std::fabs(result.energy - baseline.energy) < 1e-3 * baseline.energy, isa_name(isa));
    QVERIFY2(std::fabs(result.bound - baseline.bound) < 1e-3 * baseline.energy, isa_name(isa));
  }
}

void LinkedLabelingTest::solve_keepsTheBestWhenAskedToFinish() {
  Problem problem({1, 2, 20, 5, 20}, 0.5, 0.5);
  std::stop_source finish;
  finish.request_stop();
  Labels labels = problem.labels();

  const auto result = solve_linked_labeling(
      *problem, {100000, 0, 10}, Progress({}, finish.get_token(), {}, 1), views_of(labels));

  QCOMPARE(result.iterations, 1);
  QVERIFY(!result.converged);
  QVERIFY(std::fabs(energy_of(*problem, labels) - result.energy) < 1e-5);
}

void LinkedLabelingTest::solve_stopsOnRequest() {
  Problem problem({1, 4, 200, 13, 200}, 8, 1);
  problem.draw_stripes(0.4);
  std::stop_source stop;
  double asked = 0;
  const Progress progress(stop.get_token(), [&](const ProgressState& state) {
    if (stop.stop_requested() || state.fraction < 0.3) return;
    asked = cpu_time_ms();
    stop.request_stop();
  });
  Labels labels = problem.labels();

  QVERIFY_THROWS_EXCEPTION(
      Cancelled, solve_linked_labeling(*problem, {100000, 0, 1}, progress, views_of(labels)));

  QVERIFY(stop.stop_requested());
  QVERIFY(cpu_time_ms() - asked < cpu_limit_of_a_stop_ms());
}

void LinkedLabelingTest::solve_refusesBadInput() {
  Labels few;
  const auto refused = [](const auto& change) {
    Problem problem({1, 3, 4, 3, 5}, 0.3, 0.3);
    change(*problem);
    QVERIFY_THROWS_EXCEPTION(InvalidInput, solve(problem));
  };
  const std::vector<std::int32_t> twice(20, 7), outside(20, 20);
  Problem problem({1, 3, 4, 3, 5}, 0.3, 0.3);

  QVERIFY_THROWS_EXCEPTION(InvalidInput,
                           solve_linked_labeling(*problem, {}, Progress(1), views_of(few)));
  refused([](LinkedProblem& p) { p.smoothness = -1; });
  refused([](LinkedProblem& p) { p.coherence = -1; });
  refused([](LinkedProblem& p) { p.images[1].codes.width = 4; });
  refused([](LinkedProblem& p) { p.images[0].links[0].to = 3; });
  refused([](LinkedProblem& p) { p.images[0].links[0].to = 0; });
  refused([](LinkedProblem& p) { p.images[0].links[0].to = 2; });
  refused([](LinkedProblem& p) { p.images[0].links[0].target.width = 4; });
  refused([&](LinkedProblem& p) { p.images[0].links[0].target.data = twice.data(); });
  refused([&](LinkedProblem& p) { p.images[0].links[0].target.data = outside.data(); });
}

}  // namespace episcope::in_linked_labeling_test

EPISCOPE_TEST(linked_labeling_test, LinkedLabelingTest)
#include "linked_labeling_test.moc"
