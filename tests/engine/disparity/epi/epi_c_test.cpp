// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi_c.h"

#include "engine/disparity/epi_s.h"
#include "engine/solvers/ordering_terms.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace episcope::in_epi_c_test {

using namespace episcope::test;

namespace {

EpiCParameters parameters() {
  EpiCParameters p;
  p.tensor.range = Interval{-1.2, 1.2};
  return p;
}

Estimate epi_c(const Scene& scene, const EpiCParameters& p = parameters(),
               const Progress& progress = Progress()) {
  return estimate_epi_c(*scene.light_field, p, ViewSelection::All, progress);
}

Estimate epi_s(const Scene& scene) {
  return estimate_epi_s(*scene.light_field, {.tensor = parameters().tensor}, ViewSelection::All,
                        Progress());
}

double mse(const Scene& scene, const Estimate& estimate, ViewIndex view) {
  return errors(estimate.field.disparity.view(view), scene.truth->field.view(view), 0).mse_100;
}

constexpr GridShape kGrid{5, 5};
constexpr int kSize = 40;

// A near half plane (d = 1) left of a far one (d = 0); its edge moves by −`slope` px per column of
// the grid, as the surface it belongs to would.
ViewStack<float> half_planes(int slope) {
  ViewStack<float> stack(kGrid, kSize, kSize);
  for (int v = 0; v < kGrid.v; ++v) {
    for (int u = 0; u < kGrid.u; ++u) {
      const ImageView<float> view = stack.view({v, u});
      for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) view.at(y, x) = x < 20 - slope * (u - 2) ? 1.0F : 0.0F;
      }
    }
  }
  return stack;
}

ViewStack<float> filled(float value) {
  ViewStack<float> stack(kGrid, kSize, kSize);
  std::fill_n(stack.data(), stack.size(), value);
  return stack;
}

// Confidence that fails around the edge of `half_planes`, as that of a structure tensor does.
ViewStack<float> doubtful_edge() {
  ViewStack<float> stack = filled(1);
  for (std::size_t i = 0; i < stack.size(); ++i) {
    if (i % kSize >= 15 && i % kSize < 25) stack.data()[i] = 0.05F;
  }
  return stack;
}

LightField plain_views() {
  return make_light_field(kGrid, kSize, kSize, 1, [](ViewIndex, int, int, int) { return 0.5F; });
}

}  // namespace

class EpiCTest : public QObject {
  Q_OBJECT

 private slots:
  void plane_staysAsObserved();
  void observation_isWhatRaysReturnTo();
  void oneSweep_isThatOfTheDefinition();
  void gap_isTheLargestOfAllViews();
  void truth_violatesNothing();
  void edgeOfTheBackground_isMovedBack();
  void ordering_isViolatedLess_data();
  void ordering_isViolatedLess();
  void sweeps_lowerViolations();
  void occludedScene_isBetterThanBySmoothing_data();
  void occludedScene_isBetterThanBySmoothing();
  void noise_isWornDown();
  void notes_tellViolationsAndGap();
  void finishing_givesWhatThereIs_data();
  void finishing_givesWhatThereIs();
  void centerAlone_isThatOfAllViews();
  void anyThreadCount_givesTheSame();
  void singleRowOrColumn_runs_data();
  void singleRowOrColumn_runs();
  void range_clampsTheResult();
};

void EpiCTest::plane_staysAsObserved() {
  Estimate estimate;
  estimate.field.disparity = filled(0.37F);
  estimate.confidence = filled(1);
  denoise_with_ordering(plain_views(), parameters(), filled(0.37F), estimate, Progress());
  for (const ViewIndex view : {ViewIndex{0, 0}, ViewIndex{2, 2}, ViewIndex{4, 1}}) {
    QVERIFY(largest_difference(estimate.field.disparity.view(view), filled(0.37F).view(view)) <
            1e-3);
  }
}

void EpiCTest::observation_isWhatRaysReturnTo() {
  Estimate estimate;
  estimate.field.disparity = filled(0.5F);
  estimate.confidence = filled(1);
  EpiCParameters p = parameters();
  p.fall = 1e-3;  // else it takes many sweeps
  p.sweeps = 4;
  denoise_with_ordering(plain_views(), p, filled(0.37F), estimate, Progress());
  QVERIFY(largest_difference(estimate.field.disparity.view({2, 2}), filled(0.37F).view({2, 2})) <
          1e-3);
}

// Two views of one row each and hardly any smoothing: each pixel minimizes ½ w (u − f)² and the
// majorizers of the lines that begin and end there, the left view before the right one.
void EpiCTest::oneSweep_isThatOfTheDefinition() {
  constexpr int width = 40;
  const EpiCParameters p = [] {
    EpiCParameters made = parameters();
    made.denoising.lambda = 1e-6;
    made.sweeps = 1;
    made.denoising.stop.max_iterations = 200;
    return made;
  }();
  const OrderingPenalty penalty{static_cast<float>(p.rise), static_cast<float>(p.fall),
                                static_cast<float>(p.softness)};
  std::mt19937 random(9);
  std::uniform_real_distribution<float> uniform;
  ViewStack<float> f({1, 2}, 1, width);
  Estimate estimate;
  estimate.field.disparity = ViewStack<float>({1, 2}, 1, width);
  estimate.confidence = ViewStack<float>({1, 2}, 1, width);
  std::vector<double> u[2];
  for (int i = 0; i < 2 * width; ++i) {
    f.data()[i] = 3 * uniform(random) - 1;
    estimate.field.disparity.data()[i] = f.data()[i] + 0.2F * uniform(random);
    estimate.confidence.data()[i] = uniform(random);
    u[i / width].push_back(estimate.field.disparity.data()[i]);
  }
  const LightField plain =
      make_light_field({1, 2}, 1, width, 1, [](ViewIndex, int, int, int) { return 0.5F; });

  // A point moves by −d from the left view to the right one.
  for (int view = 0; view < 2; ++view) {
    std::vector<double> pull(width), bend(width);
    for (int from = 0; from < 2; ++from) {
      for (int x = 0; x < width; ++x) {
        const double at = x + (from == 0 ? -1 : 1) * u[from][x];
        if (at < 0 || at > width - 1) continue;
        const int tap = std::min(static_cast<int>(at), width - 2);
        const double share = at - tap;
        const auto& to = u[1 - from];
        const auto a = static_cast<float>((1 - share) * to[tap] + share * to[tap + 1] - u[from][x]);
        const double slope =
            std::clamp(a * penalty.fall / penalty.softness, -penalty.fall, penalty.rise);
        const double curvature = penalty.fall / std::max(std::fabs(a), penalty.softness);
        if (from == view) {
          pull[x] += slope;
          bend[x] += curvature;
        } else {
          pull[tap] -= (1 - share) * slope;
          pull[tap + 1] -= share * slope;
          bend[tap] += (1 - share) * curvature;
          bend[tap + 1] += share * curvature;
        }
      }
    }
    for (int x = 0; x < width; ++x) {
      const double w = std::max(
          1e-3, std::pow(estimate.confidence.view({0, view}).at(0, x), p.denoising.weight_power));
      u[view][x] =
          (w * f.view({0, view}).at(0, x) + bend[x] * u[view][x] + pull[x]) / (w + bend[x]);
    }
  }
  denoise_with_ordering(plain, p, f, estimate, Progress());

  for (int i = 0; i < 2 * width; ++i) {
    const double off = estimate.field.disparity.data()[i] - u[i / width][i % width];
    // λ moves a pixel by 2λ/(w + bend), 2e-3 at the least weight.
    QVERIFY2(std::fabs(off) < 3e-3, qPrintable(QString("%1 at %2").arg(off).arg(i)));
  }
}

void EpiCTest::gap_isTheLargestOfAllViews() {
  const Scene scene = render("objects", 48, 60, {3, 3}, 0.6, 8);
  EpiCParameters hasty = parameters(), patient = parameters();
  hasty.denoising.stop.max_iterations = 1;
  patient.denoising.stop.max_iterations = 200;
  const auto gap = [&](const EpiCParameters& p) {
    Estimate estimate = epi_s(scene);
    const ViewStack<float> observed = estimate.field.disparity.clone();
    return denoise_with_ordering(*scene.light_field, p, observed, estimate, Progress());
  };
  const double large = gap(hasty), small = gap(patient);
  QVERIFY2(large > 1e-2, qPrintable(QString::number(large)));
  QVERIFY2(small < 1e-3 && small > 0, qPrintable(QString::number(small)));
}

void EpiCTest::truth_violatesNothing() {
  QCOMPARE(ordering_violations(half_planes(1), Progress()), 0.0);
}

// An edge that stands still belongs to the background: the foreground's lines end behind it.
void EpiCTest::edgeOfTheBackground_isMovedBack() {
  Estimate estimate;
  estimate.field.disparity = half_planes(0);
  estimate.confidence = doubtful_edge();
  const double before = ordering_violations(estimate.field.disparity, Progress());
  QVERIFY(before > 0.005);
  EpiCParameters p;
  p.fall = 1;
  p.sweeps = 10;
  denoise_with_ordering(plain_views(), p, half_planes(0), estimate, Progress());
  const double after = ordering_violations(estimate.field.disparity, Progress());
  QVERIFY2(after < 0.5 * before, qPrintable(QString("%1, was %2").arg(after).arg(before)));
}

void EpiCTest::ordering_isViolatedLess_data() {
  QTest::addColumn<QString>("id");
  for (const char* id : {"edge", "bars"}) QTest::newRow(id) << id;
}

void EpiCTest::ordering_isViolatedLess() {
  QFETCH(QString, id);
  const Scene scene = render(id.toStdString(), 96, 96, {7, 7}, 0.6);
  const double smooth = ordering_violations(epi_s(scene).field.disparity, Progress());
  const double ordered = ordering_violations(epi_c(scene).field.disparity, Progress());
  QVERIFY2(ordered < smooth, qPrintable(QString("%1, was %2").arg(ordered).arg(smooth)));
}

void EpiCTest::sweeps_lowerViolations() {
  const Scene scene = render("objects", 96, 96, {7, 7}, 0.6);
  EpiCParameters none = parameters();
  none.sweeps = 0;
  const double before = ordering_violations(epi_c(scene, none).field.disparity, Progress());
  const double after = ordering_violations(epi_c(scene).field.disparity, Progress());
  QVERIFY2(after < 0.9 * before, qPrintable(QString("%1, was %2").arg(after).arg(before)));
}

void EpiCTest::occludedScene_isBetterThanBySmoothing_data() {
  QTest::addColumn<QString>("id");
  QTest::addColumn<double>("noise");
  for (const char* id : {"objects", "demo"}) {
    QTest::newRow(id) << id << 0.0;
    QTest::addRow("%s with noise", id) << id << 5.0;
  }
}

void EpiCTest::occludedScene_isBetterThanBySmoothing() {
  QFETCH(QString, id);
  QFETCH(double, noise);
  const Scene scene = render(id.toStdString(), 96, 96, {7, 7}, 0.6, noise);
  const Estimate smooth = epi_s(scene);
  const Estimate ordered = epi_c(scene);
  bool better = true;
  QString numbers;
  for (const ViewIndex view : {ViewIndex{3, 3}, ViewIndex{0, 0}, ViewIndex{6, 2}}) {
    const double before = mse(scene, smooth, view);
    const double after = mse(scene, ordered, view);
    better = better && after < before;
    numbers += QString("%1, EPI_S %2; ").arg(after).arg(before);
  }
  QVERIFY2(better, qPrintable(numbers));
}

// Views that see the same point average their noise.
void EpiCTest::noise_isWornDown() {
  const Scene scene = render("slant", 96, 96, {7, 7}, 0.6, 8);
  const double before = mse(scene, epi_s(scene), {3, 3});
  const double after = mse(scene, epi_c(scene), {3, 3});
  QVERIFY2(after < before, qPrintable(QString("%1, EPI_S %2").arg(after).arg(before)));
}

void EpiCTest::notes_tellViolationsAndGap() {
  const Estimate estimate = epi_c(render("edge", 40, 50, {3, 3}));
  QCOMPARE(estimate.notes.size(), std::size_t{2});
  QVERIFY(QString::fromStdString(estimate.notes[0]).startsWith("largest relative duality gap "));
  QVERIFY(QString::fromStdString(estimate.notes[1]).startsWith("ordering violated by "));
}

void EpiCTest::finishing_givesWhatThereIs_data() {
  QTest::addColumn<QString>("stage");
  QTest::addColumn<QString>("next");
  QTest::newRow("at once") << QString() << "checking lines";
  QTest::newRow("denoising") << "denoising"
                             << "ordering, sweep 1";
  QTest::newRow("ordering") << "ordering, sweep 1"
                            << "ordering, sweep 2";
}

// A request for the result so far does not wait for further stages.
void EpiCTest::finishing_givesWhatThereIs() {
  QFETCH(QString, stage);
  QFETCH(QString, next);
  const Scene scene = render("edge", 48, 48, {5, 5});
  std::stop_source finish;
  QStringList stages;
  const auto listener = [&](const ProgressState& state) {
    stages << QString::fromStdString(state.step);
    if (stages.back().startsWith(stage)) finish.request_stop();
  };
  if (stage.isEmpty()) finish.request_stop();

  const Estimate estimate = epi_c(scene, parameters(), Progress({}, finish.get_token(), listener));

  QVERIFY(all_finite(estimate.field.disparity));
  QVERIFY2(std::none_of(stages.begin(), stages.end(),
                        [&](const QString& each) { return each.startsWith(next); }),
           qPrintable(stages.join("; ")));
}

void EpiCTest::centerAlone_isThatOfAllViews() {
  const Scene scene = render("edge", 40, 50, {5, 5});
  const Estimate all = epi_c(scene);
  const Estimate center =
      estimate_epi_c(*scene.light_field, parameters(), ViewSelection::Center, Progress());
  QCOMPARE(center.field.disparity.grid().count(), 1);
  QCOMPARE(
      largest_difference(center.field.disparity.view({2, 2}), all.field.disparity.view({2, 2})),
      0.0);
}

void EpiCTest::anyThreadCount_givesTheSame() {
  const Scene scene = render("objects", 48, 60, {5, 5}, 0.6);
  const Estimate one = epi_c(scene, parameters(), Progress(1));
  const Estimate three = epi_c(scene, parameters(), Progress(3));
  QVERIFY(same_bytes(one.field.disparity, three.field.disparity));
  QVERIFY(same_bytes(one.confidence, three.confidence));
}

void EpiCTest::singleRowOrColumn_runs_data() {
  QTest::addColumn<int>("rows");
  QTest::addColumn<int>("columns");
  QTest::newRow("1x9") << 1 << 9;
  QTest::newRow("9x1") << 9 << 1;
  QTest::newRow("1x2") << 1 << 2;
}

void EpiCTest::singleRowOrColumn_runs() {
  QFETCH(int, rows);
  QFETCH(int, columns);
  const Scene scene = render("edge", 40, 50, {rows, columns});
  const Estimate estimate = epi_c(scene);
  QVERIFY(all_finite(estimate.field.disparity));
  QVERIFY(all_finite(estimate.confidence));
}

void EpiCTest::range_clampsTheResult() {
  EpiCParameters p = parameters();
  p.tensor.range = Interval{-0.2, 0.5};
  const Estimate estimate = epi_c(render("edge", 40, 50, {3, 3}), p);
  const float* const d = estimate.field.disparity.data();
  for (std::size_t i = 0; i < estimate.field.disparity.size(); ++i) {
    QVERIFY(d[i] >= -0.2F && d[i] <= 0.5F);
  }
}

}  // namespace episcope::in_epi_c_test

EPISCOPE_TEST(epi_c_test, EpiCTest)
#include "epi_c_test.moc"
