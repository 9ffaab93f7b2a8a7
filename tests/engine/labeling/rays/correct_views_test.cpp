// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/correct_views.h"

#include "engine/labeling/labeler.h"
#include "engine/labeling/regularizer.h"
#include "engine/solvers/layered_sweep.h"
#include "tests/engine/labeling/rays/noisy_case.h"
#include "tests/test_main.h"

#include <algorithm>
#include <mutex>
#include <vector>

namespace episcope::in_correct_views_test {

namespace {

using test::Case;
using test::kGrid;

constexpr ViewIndex kCenter{2, 2};
constexpr PixelRect kNews{30, 30, 50, 54};

// News: all of a rectangle of the center view has the first label.
struct Corrected {
  Case of{"objects", 0.3};
  RayLabelingParameters parameters{.gap_all_views = 1e-3};
  RayLabeling before = of.label(Regularizer::Rayspace, parameters);
  ChangedRays changed{kGrid, 96, 96, 1, {0, 0}, allocate_large_zeros};
  RayColors colors{*of.scene.light_field, kGrid, {0, 0}, Progress()};

  Corrected() {
    LabelProbabilities& p = of.probabilities;
    ProbabilityMap told(96, p.views[0].layers(), 96);
    Image<std::uint8_t> news(96, 96);
    for (int y = 0; y < 96; ++y) {
      for (int x = 0; x < 96; ++x) {
        for (int l = 0; l < told.layers(); ++l) told.view().at(y, l, x) = l == 0 ? 255 : 0;
        news.at(y, x) = y >= kNews.y0 && y < kNews.y1 && x >= kNews.x0 && x < kNews.x1;
      }
    }
    for (int i = 0; i < kGrid.count(); ++i) {
      carry_news({kCenter, news, told.view()}, of.scene.truth->field, colors, kGrid.view_at(i), p,
                 changed);
    }
  }
  [[nodiscard]] RayLabeling correct(int threads = 0) const {
    return correct_rays(of.input(), parameters, {before.labels, changed, kCenter, colors},
                        Progress(threads));
  }
  /// Of ids, with the costs of smooth_rays.
  [[nodiscard]] double energy(const ViewStack<std::int32_t>& labels, ViewIndex view) const {
    const LabelProbabilities& p = of.probabilities;
    Volume<float> costs(96, p.views[0].layers(), 96);
    fill_track_costs({p, of.scene.truth->field, view, TrackViews::Near, &colors},
                     cost_table(parameters.floor), Progress(), costs.view());
    Image<int> layers(96, 96);
    const auto ids = labels.view(view);
    std::transform(ids.data, ids.data + ids.size(), layers.begin(), [&](std::int32_t id) {
      return static_cast<int>(std::ranges::find(p.ids, id) - p.ids.begin());
    });
    const Image<float> g = boundary_weights(of.edges.view(view));
    const PairLimits limits(96, 96, parameters.smoothness / 2, g);
    double sum = 0;
    for (int y = 0; y < 96; ++y) {
      sum += pair_row_energy(costs.view(), limits, layers, y, potts_jump);
    }
    return sum;
  }
};

}  // namespace

class CorrectViewsTest : public QObject {
  Q_OBJECT

 private slots:
  void news_areLargeChanges_andWhatIsPainted();
  void news_reachAllViews();
  void energy_isThatOfARunFromNothing();
  void farRays_keepTheirLabels();
  void viewInSight_comesFirst();
  void threads_changeNothing();
};

void CorrectViewsTest::news_areLargeChanges_andWhatIsPainted() {
  ProbabilityMap before(20, 2, 20), after(20, 2, 20);
  std::fill_n(before.view().data, before.view().size(), std::uint8_t{100});
  std::copy_n(before.view().data, before.view().size(), after.view().data);
  const auto change = [&](int y, int x, int by) {
    after.view().at(y, 1, x) = static_cast<std::uint8_t>(100 + by);
  };
  for (int y = 2; y < 6; ++y) {
    for (int x = 2; x < 6; ++x) change(y, x, kNewsOfCode);
    for (int x = 8; x < 12; ++x) change(y, x, kNewsOfCode - 1);
  }
  change(10, 10, 100);
  Image<std::uint8_t> painted(20, 20);
  painted.at(15, 15) = 1;

  const Image<std::uint8_t> news = news_of(before.view(), after.view(), painted);

  QCOMPARE(std::count(news.begin(), news.end(), 1), 17);
  QCOMPARE(news.at(3, 3), 1);
  QCOMPARE(news.at(15, 15), 1);
}

void CorrectViewsTest::news_reachAllViews() {
  const Corrected f;
  const RayLabeling corrected = f.correct();

  for (const ViewIndex view : {kCenter, ViewIndex{0, 0}, ViewIndex{4, 1}}) {
    const auto marks = f.changed.view(view);
    const auto count = std::count(marks.data, marks.data + marks.size(), 1);
    QVERIFY2(count > 300, qPrintable(QString::number(count)));
    const auto labels = corrected.labels.view(view);
    std::int64_t right = 0;
    for (std::size_t i = 0; i < marks.size(); ++i) {
      right += marks.data[i] != 0 && labels.data[i] == f.of.probabilities.ids[0];
    }
    QVERIFY2(static_cast<double>(right) > 0.8 * static_cast<double>(count),
             qPrintable(QString::number(right)));
  }
}

// Of the views as they are shown, after the votes, and within the gap to which both are solved.
void CorrectViewsTest::energy_isThatOfARunFromNothing() {
  const Corrected f;

  const RayLabeling corrected = f.correct();
  const RayLabeling anew = f.of.label(Regularizer::Rayspace, f.parameters);

  double of_corrected = 0, of_anew = 0, of_before = 0;
  for (int i = 0; i < kGrid.count(); ++i) {
    const ViewIndex view = kGrid.view_at(i);
    of_corrected += f.energy(corrected.labels, view);
    of_anew += f.energy(anew.labels, view);
    of_before += f.energy(f.before.labels, view);
  }
  QVERIFY2(of_before > 1.008 * of_anew, qPrintable(QString::number(of_before / of_anew)));
  QVERIFY2(of_corrected <= (1 + 2 * f.parameters.gap_all_views) * of_anew,
           qPrintable(QString::number(of_corrected / of_anew)));
  QVERIFY2(corrected.relative_gap() <= 2 * f.parameters.gap_all_views,
           qPrintable(QString::number(corrected.relative_gap())));
}

void CorrectViewsTest::farRays_keepTheirLabels() {
  const Corrected f;
  const RayLabeling corrected = f.correct();

  int far = 0;
  for (int i = 0; i < kGrid.count(); ++i) {
    const ViewIndex view = kGrid.view_at(i);
    const auto was = f.before.labels.view(view), is = corrected.labels.view(view);
    for (int y = 0; y < 96; ++y) {
      for (int x = 0; x < 96; ++x) {
        // Disparities are below 2 px in this scene.
        constexpr int kFar = kReach_px + 2 * 2 + 4;
        if (y >= kNews.y0 - kFar && y < kNews.y1 + kFar && x >= kNews.x0 - kFar &&
            x < kNews.x1 + kFar) {
          continue;
        }
        ++far;
        QCOMPARE(is.at(y, x), was.at(y, x));
      }
    }
  }
  QVERIFY(far > 1000);
}

void CorrectViewsTest::viewInSight_comesFirst() {
  const Corrected f;
  std::mutex mutex;
  std::vector<ViewIndex> told;

  static_cast<void>(correct_rays(f.of.input(), f.parameters,
                                 {f.before.labels,
                                  f.changed,
                                  {1, 3},
                                  f.colors,
                                  [&](ViewIndex view, ImageView<const std::int32_t>) {
                                    const std::lock_guard lock(mutex);
                                    told.push_back(view);
                                  }},
                                 Progress()));

  QCOMPARE(told.size(), 25U);
  QCOMPARE(told.front(), (ViewIndex{1, 3}));
}

void CorrectViewsTest::threads_changeNothing() {
  const Corrected f;

  QVERIFY(test::same(f.correct(1).labels, f.correct(3).labels));
}

}  // namespace episcope::in_correct_views_test

EPISCOPE_CORE_TEST(correct_views_test, CorrectViewsTest)
#include "correct_views_test.moc"
