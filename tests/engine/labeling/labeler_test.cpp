// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/labeler.h"

#include "engine/core/error.h"
#include "engine/cuda/device.h"
#include "engine/scenes/builtin.h"
#include "tests/test_main.h"

#include <algorithm>
#include <stop_token>
#include <variant>

namespace episcope::in_labeler_test {

namespace {

constexpr int kSize = 96;

const Scene& scene() {
  static const Scene kept = [] {
    scenes::RenderOptions options;
    options.grid = {3, 3};
    options.height = kSize;
    options.width = kSize;
    return scenes::render_builtin("objects", options, Progress());
  }();
  return kept;
}

std::shared_ptr<const DisparityField> true_disparity() {
  return {scene().truth, &scene().truth->field};
}

Labeler new_labeler() {
  return {scene().light_field, true_disparity()};
}

LabelerParameters parameters(FeatureSet features, Regularizer regularizer) {
  return {.features = features, .regularizer = regularizer};
}

const ViewRectangle kAll{{0, 0}, {3, 3}};

double accuracy(const Labeling& labeling) {
  const auto& truth = scene().truth->labels;
  std::size_t right = 0;
  std::size_t all = 0;
  for (int i = 0; i < labeling.labels.grid().count(); ++i) {
    const ViewIndex first = labeling.labels.first();
    const ViewIndex view{first.v + i / labeling.labels.grid().u,
                         first.u + i % labeling.labels.grid().u};
    const auto given = labeling.labels.view(view);
    const auto expected = truth.view(view);
    for (std::size_t k = 0; k < given.size(); ++k) right += given.data[k] == expected.data[k];
    all += given.size();
  }
  return static_cast<double>(right) / static_cast<double>(all);
}

}  // namespace

class LabelerTest : public QObject {
  Q_OBJECT

 private slots:
  void objects_areSegmentedInAllViews_data();
  void objects_areSegmentedInAllViews();
  void oneView_comesAsADraftFirst();
  void nextStroke_goesOnFromTheLastLabels();
  void strokesOnAnotherView_count();
  void paintedPixels_keepTheirLabels_data();
  void paintedPixels_keepTheirLabels();
  void correctedPixels_keepTheirLabels();
  void result_dependsNeitherOnThreads_norOnEarlierCalls();
  void forest_isGrownAgainOnlyForOtherStrokesOrOptions();
  void badInput_isToldInASentence();
  void missingGpu_isToldOnlyIfDemanded();
  void stop_cancels();
  void stroke_correctsAllViews();
  void newLabel_correctsAllViews();
  void invalidPixels_haveNoLabel();
};

void LabelerTest::objects_areSegmentedInAllViews_data() {
  QTest::addColumn<FeatureSet>("features");
  QTest::addColumn<Regularizer>("regularizer");
  for (const FeatureSet features : {FeatureSet::Image, FeatureSet::ImageTruth}) {
    for (const auto& regularizer : names_of(Regularizer{})) {
      QTest::addRow("%s %s", name_of(features).c_str(), regularizer.name)
          << features << regularizer.value;
    }
  }
}

void LabelerTest::objects_areSegmentedInAllViews() {
  QFETCH(FeatureSet, features);
  QFETCH(Regularizer, regularizer);

  const Labeling labeling =
      new_labeler().label(scene().scribbles, parameters(features, regularizer), kAll, Progress());

  QCOMPARE(labeling.labels.grid(), kAll.grid);
  QCOMPARE(labeling.probabilities.ids, (std::vector<std::int32_t>{1, 2, 3}));
  // 97 to 99.5 % were measured.
  QVERIFY2(accuracy(labeling) > 0.95, qPrintable(QString::number(accuracy(labeling))));
}

void LabelerTest::oneView_comesAsADraftFirst() {
  Labeler labeler = new_labeler();
  int drafts = 0;

  const Labeling refined =
      labeler.label(scene().scribbles, parameters(FeatureSet::ImageTruth, Regularizer::Rayspace),
                    {{1, 1}, {1, 1}}, Progress(), [&](const Labeling& draft) {
                      ++drafts;
                      QVERIFY(draft.is_draft);
                      QCOMPARE(draft.labels.first(), (ViewIndex{1, 1}));
                      QVERIFY(draft.probabilities.contains({1, 1}));
                    });

  QCOMPARE(drafts, 1);
  QVERIFY(!refined.is_draft);
  QVERIFY(refined.probabilities.contains({1, 1}));
  QVERIFY(accuracy(refined) > 0.95);
}

void LabelerTest::nextStroke_goesOnFromTheLastLabels() {
  const LabelerParameters chosen = parameters(FeatureSet::ImageTruth, Regularizer::Rayspace);
  const ViewRectangle center{{1, 1}, {1, 1}};
  const auto no_drafts = [](const Labeling&) {};
  Scribbles more = scene().scribbles;
  for (int x = 10; x < 20; ++x)
    more.views[0].labels.at(90, x) = scene().truth->labels.view({1, 1}).at(90, x);
  Labeler painting = new_labeler();
  (void)painting.label(scene().scribbles, chosen, center, Progress(), no_drafts);

  const Labeling next = painting.label(more, chosen, center, Progress(), no_drafts);
  const Labeling once = painting.label(more, chosen, center, Progress());
  const Labeling anew = new_labeler().label(more, chosen, center, Progress());

  QVERIFY(accuracy(next) > 0.95);
  QVERIFY(next.gap < 1e-2);
  // Asked for once, they do not depend on what came before.
  QVERIFY(
      std::equal(once.labels.data(), once.labels.data() + once.labels.size(), anew.labels.data()));
}

void LabelerTest::strokesOnAnotherView_count() {
  // The same strokes as if painted on a corner view, carried there by the truth of the labels.
  Scribbles moved = scene().scribbles;
  moved.views[0].view = {0, 0};
  const auto truth = scene().truth->labels.view({0, 0});
  auto& labels = moved.views[0].labels;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels.data()[i] != truth.data[i]) labels.data()[i] = 0;
  }

  const Labeling labeling = new_labeler().label(
      moved, parameters(FeatureSet::ImageTruth, Regularizer::None), kAll, Progress());

  QVERIFY(accuracy(labeling) > 0.95);
}

namespace {

std::int64_t count_of(const ViewStack<std::int32_t>& labels, std::int32_t label) {
  return std::count(labels.data(), labels.data() + labels.size(), label);
}

// A short stroke of the box in the midst of the ground, in two views: nobody but the user can know
// why. And a single pixel.
Scribbles with_island() {
  Scribbles scribbles = scene().scribbles;
  auto& painted = scribbles.views[0].labels;
  for (int x = 40; x < 60; ++x) painted.at(88, x) = painted.at(89, x) = 3;
  painted.at(80, 20) = 3;
  Image<std::int32_t> corner(kSize, kSize);
  for (int x = 30; x < 40; ++x) corner.at(70, x) = 3;
  scribbles.views.push_back({{0, 0}, std::move(corner)});
  return scribbles;
}

// Painted pixels of another label.
int lost_pixels(const Scribbles& scribbles, const Labeling& labeling) {
  int lost = 0;
  for (const ViewScribbles& painted : scribbles.views) {
    if (!labeling.labels.contains(painted.view)) continue;
    const auto labels = labeling.labels.view(painted.view);
    for (std::size_t i = 0; i < painted.labels.size(); ++i) {
      const std::int32_t id = painted.labels.data()[i];
      lost += id > 0 && labels.data[i] != id ? 1 : 0;
    }
  }
  return lost;
}

}  // namespace

void LabelerTest::paintedPixels_keepTheirLabels_data() {
  QTest::addColumn<Regularizer>("regularizer");
  QTest::addColumn<ViewRectangle>("views");
  for (const auto& regularizer : names_of(Regularizer{})) {
    QTest::addRow("%s, all views", regularizer.name) << regularizer.value << kAll;
    QTest::addRow("%s, one view", regularizer.name)
        << regularizer.value << ViewRectangle{{1, 1}, {1, 1}};
  }
}

void LabelerTest::paintedPixels_keepTheirLabels() {
  QFETCH(Regularizer, regularizer);
  QFETCH(ViewRectangle, views);
  const Scribbles scribbles = with_island();

  const Labeling labeling = new_labeler().label(
      scribbles, parameters(FeatureSet::ImageTruth, regularizer), views, Progress());

  QCOMPARE(lost_pixels(scribbles, labeling), 0);
}

void LabelerTest::correctedPixels_keepTheirLabels() {
  const LabelerParameters how = parameters(FeatureSet::ImageTruth, Regularizer::Rayspace);
  Labeler labeler = new_labeler();
  const Scribbles scribbles = with_island();
  const Labeling before = labeler.label(scene().scribbles, how, kAll, Progress());

  const auto corrected =
      labeler.correct(scribbles, how, {before, scene().scribbles, {1, 1}}, Progress());

  QVERIFY(corrected);
  QCOMPARE(lost_pixels(scribbles, *corrected), 0);
}

void LabelerTest::result_dependsNeitherOnThreads_norOnEarlierCalls() {
  const LabelerParameters chosen = parameters(FeatureSet::ImageTruth, Regularizer::View);
  Labeler used = new_labeler();
  (void)used.label(scene().scribbles, parameters(FeatureSet::Image, Regularizer::None), kAll,
                   Progress());

  const Labeling one = new_labeler().label(scene().scribbles, chosen, kAll, Progress(1));
  const Labeling three = used.label(scene().scribbles, chosen, kAll, Progress(3));

  QVERIFY(
      std::equal(one.labels.data(), one.labels.data() + one.labels.size(), three.labels.data()));
}

void LabelerTest::forest_isGrownAgainOnlyForOtherStrokesOrOptions() {
  Labeler labeler = new_labeler();
  const auto grows_forest = [&](const Scribbles& scribbles, ViewIndex view, int seed) {
    LabelerParameters chosen = parameters(FeatureSet::Image, Regularizer::None);
    chosen.seed = seed;
    bool grows = false;
    const auto listen = [&](const ProgressState& state) {
      grows = grows || state.step == Labeler::kTrainingStep;
    };
    (void)labeler.label(scribbles, chosen, {view, {1, 1}}, Progress(std::stop_token(), listen));
    return grows;
  };
  Scribbles more = scene().scribbles;
  more.views[0].labels.at(0, 0) = 1;

  QVERIFY(grows_forest(scene().scribbles, {1, 1}, 1));
  QVERIFY(!grows_forest(scene().scribbles, {1, 1}, 1));
  QVERIFY(!grows_forest(scene().scribbles, {0, 1}, 1));
  QVERIFY(grows_forest(more, {0, 1}, 1));
  QVERIFY(grows_forest(more, {0, 1}, 2));
}

void LabelerTest::badInput_isToldInASentence() {
  Scribbles one_label = scene().scribbles;
  for (std::int32_t& label : one_label.views[0].labels) label = label == 2 ? 2 : 0;
  Scribbles foreign = scene().scribbles;
  foreign.views[0].view = {7, 7};
  const LabelerParameters chosen = parameters(FeatureSet::Image, Regularizer::None);
  const auto message = [&](const Scribbles& scribbles, ViewRectangle views) {
    try {
      (void)new_labeler().label(scribbles, chosen, views, Progress());
    } catch (const InvalidInput& error) {
      return QString(error.what());
    }
    return QString();
  };

  QVERIFY(message({}, kAll).contains("nothing is painted"));
  QVERIFY(message(one_label, kAll).contains("paint a second one"));
  QVERIFY(message(foreign, kAll).contains("do not fit"));
  QVERIFY(message(scene().scribbles, {{2, 2}, {2, 2}}).contains("were requested"));
  Labeler without(scene().light_field, nullptr);
  QVERIFY_THROWS_EXCEPTION(
      InvalidInput,
      (void)without.label(scene().scribbles, parameters(FeatureSet::Image, Regularizer::Rayspace),
                          kAll, Progress()));
}

void LabelerTest::missingGpu_isToldOnlyIfDemanded() {
  if (has_cuda_device()) QSKIP("there is a GPU, which tests/cuda is for");
  scenes::RenderOptions options;
  options.grid = {4, 3};
  options.height = options.width = kSize;
  const Scene larger = scenes::render_builtin("objects", options, Progress());
  Labeler labeler(larger.light_field, {larger.truth, &larger.truth->field});
  const ViewRectangle all{{0, 0}, options.grid};

  labeler.compute_on(Device::Cuda);
  QVERIFY_THROWS_EXCEPTION(Unavailable, (void)labeler.label(larger.scribbles, {}, all, Progress()));
  labeler.compute_on(Device::Auto);
  const Labeling labeling = labeler.label(larger.scribbles, {}, all, Progress());
  QCOMPARE(labeling.labels.grid().count(), 12);
  QVERIFY(labeling.note.empty());
}

void LabelerTest::stop_cancels() {
  std::stop_source stop;
  stop.request_stop();

  QVERIFY_THROWS_EXCEPTION(
      Cancelled,
      (void)new_labeler().label(scene().scribbles, parameters(FeatureSet::Image, Regularizer::None),
                                kAll, Progress(stop.get_token(), nullptr)));
}

namespace {

// Strokes of the scene, but what is below the middle of the thing in the center has another label.
Scribbles with_mistake(std::int32_t label) {
  Scribbles painted = scene().scribbles;
  for (ViewScribbles& view : painted.views) {
    if (!(view.view == ViewIndex{1, 1})) continue;
    for (int y = 60; y < 66; ++y) {
      for (int x = 40; x < 60; ++x) view.labels.at(y, x) = label;
    }
  }
  return painted;
}

}  // namespace

void LabelerTest::stroke_correctsAllViews() {
  const LabelerParameters how = parameters(FeatureSet::ImageTruth, Regularizer::Rayspace);
  Labeler labeler = new_labeler();
  const Scribbles mistaken = with_mistake(scene().truth->labels.view({1, 1}).at(62, 50) % 3 + 1);
  const Labeling before = labeler.label(mistaken, how, kAll, Progress());
  const Labeling anew = labeler.label(scene().scribbles, how, kAll, Progress());

  const auto corrected =
      labeler.correct(scene().scribbles, how, {before, mistaken, {1, 1}}, Progress());

  QVERIFY(corrected);
  QVERIFY2(accuracy(before) < accuracy(anew) - 0.005,
           qPrintable(QString::number(accuracy(before))));
  QVERIFY2(accuracy(*corrected) > accuracy(anew) - 0.004,
           qPrintable(QString("%1 %2").arg(accuracy(*corrected)).arg(accuracy(anew))));
  QVERIFY(corrected->probabilities.views.size() == 9);
  QVERIFY(!labeler.correct(scene().scribbles, parameters(FeatureSet::ImageTruth, Regularizer::View),
                           {before, mistaken, {1, 1}}, Progress()));
}

void LabelerTest::newLabel_correctsAllViews() {
  const LabelerParameters how = parameters(FeatureSet::ImageTruth, Regularizer::Rayspace);
  Labeler labeler = new_labeler();
  const Labeling before = labeler.label(scene().scribbles, how, kAll, Progress());

  const auto corrected =
      labeler.correct(with_mistake(9), how, {before, scene().scribbles, {1, 1}}, Progress());

  QVERIFY(corrected);
  QCOMPARE(corrected->probabilities.ids, (std::vector<std::int32_t>{1, 2, 3, 9}));
  QCOMPARE(count_of(before.labels, 9), 0);
  QVERIFY2(count_of(corrected->labels, 9) > 9 * 60,
           qPrintable(QString::number(count_of(corrected->labels, 9))));
}

void LabelerTest::invalidPixels_haveNoLabel() {
  const LightField& whole = *scene().light_field;
  ViewStack<std::uint8_t> valid(whole.grid(), whole.height(), whole.width(), 1);
  std::fill_n(valid.data(), valid.size(), std::uint8_t{1});
  std::fill_n(valid.view({0, 1}).row(3), 20, std::uint8_t{0});
  const auto part = std::visit(
      [&](const auto& samples) {
        return std::make_shared<const LightField>(samples.clone(), whole.info(), std::move(valid));
      },
      whole.samples());

  for (const Regularizer regularizer : {Regularizer::None, Regularizer::Rayspace}) {
    const Labeling labeling =
        Labeler(part, true_disparity())
            .label(scene().scribbles, parameters(FeatureSet::ImageTruth, regularizer), kAll,
                   Progress());

    QCOMPARE(count_of(labeling.labels, 0), 20);
    QCOMPARE(labeling.labels.view({0, 1}).at(3, 19), 0);
  }
}

}  // namespace episcope::in_labeler_test

EPISCOPE_TEST(labeler_test, LabelerTest)
#include "labeler_test.moc"
