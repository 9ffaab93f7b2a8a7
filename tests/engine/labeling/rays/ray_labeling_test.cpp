// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/regularizer.h"
#include "engine/labeling/solve_views.h"

#include "engine/core/error.h"
#include "engine/labeling/label_review.h"
#include "engine/labeling/pixel_features.h"
#include "engine/labeling/ray_labeling.h"
#include "engine/scenes/builtin.h"
#include "tests/cpu_time.h"
#include "tests/engine/labeling/rays/noisy_case.h"
#include "tests/test_main.h"

#include <cmath>

namespace episcope::in_ray_labeling_test {

using namespace episcope::test;

namespace {

// Each pixel takes the largest disparity within `radius`.
DisparityField widened(const DisparityField& field, int radius) {
  DisparityField wide{field.disparity.clone(), {}};
  for (int i = 0; i < wide.disparity.grid().count(); ++i) {
    const auto from = field.disparity.view(wide.disparity.view_at(i));
    const auto to = wide.disparity.view(wide.disparity.view_at(i));
    for (int y = 0; y < to.height; ++y) {
      for (int x = 0; x < to.width; ++x) {
        for (int k = std::max(y - radius, 0); k <= std::min(y + radius, to.height - 1); ++k) {
          const float* const row = from.row(k);
          const float most = *std::max_element(row + std::max(x - radius, 0),
                                               row + std::min(x + radius + 1, to.width));
          to.at(y, x) = std::max(to.at(y, x), most);
        }
      }
    }
  }
  return wide;
}

}  // namespace

class RayLabelingTest : public QObject {
  Q_OBJECT

 private slots:
  void rays_beatViews_andViewsBeatNone_data();
  void rays_beatViews_andViewsBeatNone();
  void rays_areConstantAlongLinesOfPlanes();
  void rays_agreeOnObjects();
  void rays_leaveCertainLabelsAlone();
  void label_isTheSameForAnyThreads();
  void rays_beatViews_whereDisparityIsWrongAtOutlines_data();
  void rays_beatViews_whereDisparityIsWrongAtOutlines();
  void labelView_isNearlyThatOfAllViews();
  void labelView_takesWhatItsNeighboursKnow();
  void labelView_goesOnWhereItEnded();
  void label_keepsIds();
  void label_certifiesItself();
  void trackCosts_areMeansOverVisibleRays();
  void colors_doNotDependOnTheStoredType();
  void label_stopsOnRequest();
  void label_endsEarlyWhenAsked();
  void label_refusesBadInput();
};

void RayLabelingTest::rays_beatViews_andViewsBeatNone_data() {
  QTest::addColumn<QString>("scene");
  QTest::newRow("edge") << "edge";
  QTest::newRow("objects") << "objects";
  QTest::newRow("bars") << "bars";
}

// 40 % of all rays are mistaken at random: λ of the order of log(0.6/0.4).
void RayLabelingTest::rays_beatViews_andViewsBeatNone() {
  QFETCH(QString, scene);
  const Case noisy(scene.toStdString());
  RayLabelingParameters parameters;
  parameters.smoothness = 1;

  const double none = noisy.right(noisy.label(Regularizer::None));
  const double views = noisy.right(noisy.label(Regularizer::View, parameters));
  const double rays = noisy.right(noisy.label(Regularizer::Rayspace, parameters));

  const QByteArray told = QString("%1 %2 %3").arg(none).arg(views).arg(rays).toUtf8();
  QVERIFY2(std::fabs(none - 0.6) < 0.01, told);
  QVERIFY2(views > none + 0.1, told);
  QVERIFY2(rays > views + 0.01, told);
  QVERIFY2(rays > (scene == "bars" ? 0.97 : 0.985), told);  // thin, and 25 views only
}

void RayLabelingTest::rays_areConstantAlongLinesOfPlanes() {
  for (const char* const id : {"fronto", "slant", "edge"}) {
    const Case noisy(id);

    const RayLabeling labeling = noisy.label(Regularizer::Rayspace);

    const auto agreed = label_consistency(labeling.labels, noisy.scene.truth->field, Progress());
    QVERIFY(agreed.checked() > 0.9);
    QCOMPARE(agreed.agreeing, agreed.visible);
  }
}

void RayLabelingTest::rays_agreeOnObjects() {
  const Case noisy("objects");

  const RayLabeling labeling = noisy.label(Regularizer::Rayspace);

  const auto agreed = label_consistency(labeling.labels, noisy.scene.truth->field, Progress());
  // Rays that arrive between pixels: exact labels do not always agree.
  const double exact =
      label_consistency(noisy.scene.truth->labels, noisy.scene.truth->field, Progress()).share();
  QVERIFY2(agreed.share() > std::min(exact, 0.99) - 0.003,
           qPrintable(QString("%1, exact %2").arg(agreed.share()).arg(exact)));
}

void RayLabelingTest::rays_leaveCertainLabelsAlone() {
  const Case certain("objects", 0);
  RayLabelingParameters parameters;
  parameters.smoothness = 0.2;

  const RayLabeling labeling = certain.label(Regularizer::Rayspace, parameters);

  // Rays that arrive between pixels at a boundary take the nearest one's label.
  QVERIFY2(certain.right(labeling) > 0.995, qPrintable(QString::number(certain.right(labeling))));
}

void RayLabelingTest::label_isTheSameForAnyThreads() {
  const Case noisy("objects", 0.4, 48);

  for (const auto& [regularizer, name, label] : names_of(Regularizer{})) {
    const RayLabeling one = noisy.label(regularizer, {}, 1);
    const RayLabeling three = noisy.label(regularizer, {}, 3);
    QVERIFY(same(one.labels, three.labels));
    QCOMPARE(three.energy, one.energy);
  }
}

void RayLabelingTest::rays_beatViews_whereDisparityIsWrongAtOutlines_data() {
  QTest::addColumn<QString>("scene");
  QTest::newRow("objects") << "objects";
  QTest::newRow("bars") << "bars";
  QTest::newRow("demo") << "demo";
}

// Foreground disparities reach three pixels too far, as estimates do.
void RayLabelingTest::rays_beatViews_whereDisparityIsWrongAtOutlines() {
  QFETCH(QString, scene);
  const Case fair(scene.toStdString(), 0.1);
  const DisparityField wide = widened(fair.scene.truth->field, 3);
  RayLabelingInput input = fair.input();
  input.disparity = &wide;
  RayLabelingParameters parameters;
  parameters.smoothness = 1;

  const auto views = label_rays(input, Regularizer::View, parameters, Progress());
  const auto rays = label_rays(input, Regularizer::Rayspace, parameters, Progress());

  const DisparityField& truth = fair.scene.truth->field;
  const double alone = label_consistency(views.labels, truth, Progress()).share();
  const double agreed = label_consistency(rays.labels, truth, Progress()).share();
  const auto told = QString("%1 %2, %3 %4")
                        .arg(fair.right(views))
                        .arg(fair.right(rays))
                        .arg(alone)
                        .arg(agreed)
                        .toUtf8();
  QVERIFY2(fair.right(rays) >= fair.right(views), told);
  QVERIFY2(agreed >= alone, told);
  QVERIFY2(agreed > 0.97, told);
}

void RayLabelingTest::labelView_isNearlyThatOfAllViews() {
  const Case noisy("objects", 0.4, 48);
  const ViewIndex center = kGrid.center();

  const RayLabeling all = noisy.label(Regularizer::Rayspace);
  const RayLabeling one = label_view(noisy.input(), center, Regularizer::Rayspace, {}, Progress());

  // All rays have voted besides, and their problems were solved to a wider gap.
  const auto expected = all.labels.view(center), found = one.labels.view(center);
  QCOMPARE(one.labels.grid(), (GridShape{1, 1}));
  int equal = 0;
  for (std::size_t i = 0; i < found.size(); ++i) equal += found.data[i] == expected.data[i] ? 1 : 0;
  QVERIFY2(equal > 0.97 * 48 * 48, qPrintable(QString::number(equal)));
}

void RayLabelingTest::labelView_goesOnWhereItEnded() {
  Case noisy("objects");
  const ViewIndex center = kGrid.center();
  KeptSolver kept;
  RayLabelingInput input = noisy.input();
  const auto label = [&] { return label_view(input, center, Regularizer::View, {}, Progress()); };
  const RayLabeling cold = label();
  input.kept = &kept;
  const RayLabeling first = label();
  // A square is painted.
  ProbabilityMap& map = noisy.probabilities.view(center);
  for (int y = 20; y < 30; ++y) {
    for (int l = 0; l < map.layers(); ++l) {
      std::fill_n(map.view().row(y, l) + 20, 10, static_cast<std::uint8_t>(l == 0 ? 255 : 0));
    }
  }

  const RayLabeling next = label();
  input.kept = nullptr;
  const RayLabeling anew = label();

  QVERIFY(same(first.labels, cold.labels));
  QVERIFY2(next.iterations < anew.iterations,
           qPrintable(QString("%1, anew %2").arg(next.iterations).arg(anew.iterations)));
  QVERIFY(next.relative_gap() < 2e-2);
  QCOMPARE(next.labels.view(center).at(25, 25), noisy.probabilities.ids[0]);
}

void RayLabelingTest::labelView_takesWhatItsNeighboursKnow() {
  const Case noisy("edge");
  RayLabelingParameters parameters;
  parameters.smoothness = 1;
  const ViewIndex corner{0, 4};

  const auto alone = label_view(noisy.input(), corner, Regularizer::View, parameters, Progress());
  const auto together =
      label_view(noisy.input(), corner, Regularizer::Rayspace, parameters, Progress());

  QVERIFY(noisy.right(together) > noisy.right(alone));
  QVERIFY(together.labels.contains(corner));
}

void RayLabelingTest::label_keepsIds() {
  Case noisy("edge", 0.1, 48);
  for (std::int32_t& id : noisy.probabilities.ids) id = 10 * id + 7;

  for (const auto& [regularizer, name, label] : names_of(Regularizer{})) {
    const auto ids = label_ids(noisy.label(regularizer).labels);
    QVERIFY(std::ranges::includes(noisy.probabilities.ids, ids));
  }
}

void RayLabelingTest::label_certifiesItself() {
  const Case noisy("objects", 0.4, 64);

  for (const Regularizer regularizer :
       {Regularizer::View, Regularizer::Rayspace, Regularizer::Wsg13}) {
    const RayLabeling labeling = noisy.label(regularizer);
    QVERIFY(labeling.bound <= labeling.energy);
    QVERIFY2(labeling.relative_gap() < 1e-2, qPrintable(QString::number(labeling.relative_gap())));
    QVERIFY(labeling.iterations > 0);
  }
}

void RayLabelingTest::trackCosts_areMeansOverVisibleRays() {
  const Case noisy("fronto", 0.3, 32);
  const CostTable table = cost_table(0.01);
  const ViewIndex center = kGrid.center();
  Volume<float> costs(32, 2, 32);

  fill_track_costs({noisy.probabilities, noisy.scene.truth->field, center}, table, Progress(),
                   costs.view());

  // A plane of 0.37 px: by hand for a pixel far from the border.
  double sum = 0;
  for (int v = 0; v < 5; ++v) {
    for (int u = 0; u < 5; ++u) {
      const auto x = static_cast<int>(std::lround(14 - 0.37 * (u - 2)));
      const auto y = static_cast<int>(std::lround(17 - 0.37 * (v - 2)));
      sum += table[noisy.probabilities.view({v, u}).view().at(y, 1, x)];
    }
  }
  QVERIFY(std::fabs(costs.view().at(17, 1, 14) - sum / 25) < 1e-4);
}

// Samples of 8 bits are used directly, others are rounded to 8 bits.
void RayLabelingTest::colors_doNotDependOnTheStoredType() {
  const Case noisy("objects");
  const LightField& bytes = *noisy.scene.light_field;
  ViewStack<float> samples(bytes.grid(), bytes.height(), bytes.width(), bytes.channels());
  for (int i = 0; i < bytes.grid().count(); ++i) {
    const Image<float> view = bytes.view_as_float(bytes.grid().view_at(i));
    std::copy(view.begin(), view.end(), samples.view(bytes.grid().view_at(i)).data);
  }
  const LightField floats(std::move(samples), {});
  const RayColors looked_into(bytes, {2, 2}, {1, 1}, Progress());
  const RayColors rounded(floats, {2, 2}, {1, 1}, Progress());

  int told_apart = 0;
  for (int y = 0; y < bytes.height(); y += 3) {
    const auto a = looked_into.pair({1, 1}, y, {2, 2}), b = rounded.pair({1, 1}, y, {2, 2});
    for (int x = 0; x < bytes.width(); ++x) {
      const float trust = looked_into.trust(a, x, y * bytes.width() + x);
      QCOMPARE(rounded.trust(b, x, y * bytes.width() + x), trust);
      told_apart += trust < 0.5F ? 1 : 0;
    }
  }
  QVERIFY(told_apart > 0);
}

void RayLabelingTest::label_stopsOnRequest() {
  const Case noisy("objects", 0.4, 128);
  for (const Regularizer regularizer :
       {Regularizer::View, Regularizer::Rayspace, Regularizer::Wsg13}) {
    std::stop_source stop;
    double asked = 0;
    const Progress progress(stop.get_token(), [&](const ProgressState&) {
      if (stop.stop_requested()) return;
      asked = cpu_time_ms();
      stop.request_stop();
    });

    QVERIFY_THROWS_EXCEPTION(Cancelled, (void)label_rays(noisy.input(), regularizer, {}, progress));

    QVERIFY(cpu_time_ms() - asked < cpu_limit_of_a_stop_ms());
  }
}

void RayLabelingTest::label_endsEarlyWhenAsked() {
  const Case noisy("objects", 0.4, 48);
  std::stop_source finish;
  finish.request_stop();

  const RayLabeling labeling =
      label_rays(noisy.input(), Regularizer::Rayspace, {}, Progress({}, finish.get_token(), {}));

  QCOMPARE(labeling.iterations, 1);
  QVERIFY(noisy.right(labeling) > 0.6);
}

void RayLabelingTest::label_refusesBadInput() {
  const Case noisy("edge", 0.1, 16);
  const LabelProbabilities nothing;
  const auto refused = [](const RayLabelingInput& input, Regularizer regularizer,
                          RayLabelingParameters parameters = {}) {
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             (void)label_rays(input, regularizer, parameters, Progress()));
  };
  RayLabelingInput input = noisy.input();
  RayLabelingParameters parameters;

  refused({}, Regularizer::None);
  refused({&nothing, nullptr, nullptr, nullptr}, Regularizer::View);
  refused({&noisy.probabilities, nullptr, nullptr, nullptr}, Regularizer::Rayspace);
  parameters.smoothness = -1;
  refused(input, Regularizer::View, parameters);
  parameters = {};
  parameters.floor = 0;
  refused(input, Regularizer::View, parameters);
  const DisparityField small{ViewStack<float>({1, 1}, 16, 16, 1, {2, 2}), {}};
  input.disparity = &small;
  refused(input, Regularizer::Rayspace);
  const ViewStack<float> other({5, 5}, 8, 8);
  input = noisy.input();
  input.edges = &other;
  refused(input, Regularizer::View);
  const Case larger("edge", 0.1, 24);
  input = noisy.input();
  input.light_field = larger.scene.light_field.get();
  refused(input, Regularizer::Rayspace);
  QVERIFY_THROWS_EXCEPTION(
      InvalidInput, (void)label_view(noisy.input(), {9, 9}, Regularizer::View, {}, Progress()));
}

}  // namespace episcope::in_ray_labeling_test

EPISCOPE_TEST(ray_labeling_test, RayLabelingTest)
#include "ray_labeling_test.moc"
