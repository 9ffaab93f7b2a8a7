// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/live_labeler.h"

#include "annotation/exchange.h"
#include "tests/app/session/tiny_scene.h"
#include "tests/app/session/turned_loop.h"
#include "tests/patience.h"
#include "tests/test_main.h"

#include <algorithm>
#include <set>

namespace episcope::in_live_labeler_test {

namespace {

struct Fixture {
  std::shared_ptr<const Scene> scene = tiny_scene("objects");
  test::TurnedLoop loop;
  std::vector<LiveState> told;
  LiveLabeler live{loop.post(), [this] { told.push_back(live.state()); }};
  ViewIndex center = scene->light_field->center();

  [[nodiscard]] LabelingInput input(Regularizer regularizer = Regularizer::Rayspace) const {
    LabelingInput input;
    input.light_field = scene->light_field;
    input.disparity = {scene->truth, &scene->truth->field};
    input.scribbles = painted(*scene);
    input.parameters.regularizer = regularizer;
    input.parameters.trees = 8;
    return input;
  }
  static std::shared_ptr<const ScribbleLayer> painted(const Scene& scene) {
    const LightField& lf = *scene.light_field;
    return std::make_shared<const ScribbleLayer>(
        document_from(scene.scribbles, lf.grid(), lf.height(), lf.width()).scribbles());
  }
  LiveState turn() {
    loop.turn();
    return live.state();
  }
  [[nodiscard]] bool heard(LiveState state) const {
    return std::find(told.begin(), told.end(), state) != told.end();
  }
  /// Share of pixels of the view with their true label.
  [[nodiscard]] double accuracy(ViewIndex view) const {
    const auto labels = live.labeling(view)->labels.view(view);
    const auto truth = scene->truth->labels.view(view);
    int right = 0;
    for (int y = 0; y < labels.height; ++y) {
      for (int x = 0; x < labels.width; ++x) right += labels.at(y, x) == truth.at(y, x);
    }
    return static_cast<double>(right) / (labels.height * labels.width);
  }
};

// The scribbles of one label alone.
std::shared_ptr<const ScribbleLayer> of_one_label(const ScribbleLayer& all) {
  auto one = std::make_shared<ScribbleLayer>(all.grid(), all.height(), all.width());
  const ViewIndex view = all.painted_views().front();
  const auto from = all.view(view);
  const auto to = one->writable_view(view);
  std::transform(from.data, from.data + from.size(), to.data,
                 [](int id) { return static_cast<std::uint8_t>(id == 1 ? 1 : 0); });
  return one;
}

}  // namespace

class LiveLabelerTest : public QObject {
  Q_OBJECT

 private slots:
  void label_givesADraftThenRefinedLabels();
  void label_withoutRegularizer_needsNoRefining();
  void label_withoutDisparity_goesByImages();
  void newRequest_dropsTheFormer();
  void newInput_outdatesWhatIsKnown();
  void sameInput_changesNothing();
  void cancel_leavesWhatWasKnown();
  void oneLabel_isAHint();
  void otherLightField_forgetsEverything();
  void view_thatIsKnown_isThereAtOnce();
  void allViews_answerForEveryView();
  void relabeled_stayUpToDate_andComeBack();
  void mergedLabels_haveBothProbabilities();
  void destructor_whileRunning_isHarmless();
};

void LiveLabelerTest::label_givesADraftThenRefinedLabels() {
  Fixture f;
  f.live.set_input(f.input());

  f.live.label(f.center);
  QCOMPARE(f.live.state(), LiveState::Training);
  QTRY_VERIFY_WITH_TIMEOUT((f.turn(), f.live.labeling(f.center) != nullptr), kPatience);
  QTRY_COMPARE_WITH_TIMEOUT(f.turn(), LiveState::Idle, kPatience);

  QVERIFY(f.heard(LiveState::Refining));  // stages that end before the owner looks are dropped
  const LabelingPtr refined = f.live.labeling(f.center);
  QVERIFY(!refined->is_draft);
  QVERIFY(f.live.is_up_to_date(f.center));
  QVERIFY(refined->labels.grid() == (GridShape{1, 1}));
  QVERIFY(refined->probabilities.contains(f.center));
  QVERIFY2(f.accuracy(f.center) > 0.8, qPrintable(QString::number(f.accuracy(f.center))));
}

void LiveLabelerTest::label_withoutRegularizer_needsNoRefining() {
  Fixture f;
  f.live.set_input(f.input(Regularizer::None));

  f.live.label(f.center);
  QTRY_COMPARE_WITH_TIMEOUT(f.turn(), LiveState::Idle, kPatience);

  QVERIFY(!f.heard(LiveState::Refining));
  QVERIFY(!f.live.labeling(f.center)->is_draft);
}

void LiveLabelerTest::label_withoutDisparity_goesByImages() {
  Fixture f;
  LabelingInput input = f.input();
  input.disparity = nullptr;
  f.live.set_input(std::move(input));

  f.live.label({0, 0});
  QTRY_COMPARE_WITH_TIMEOUT(f.turn(), LiveState::Idle, kPatience);

  QVERIFY(!f.live.labeling({0, 0})->is_draft);
}

void LiveLabelerTest::newRequest_dropsTheFormer() {
  Fixture f;
  f.live.set_input(f.input());

  f.live.label({0, 0});
  f.live.label({0, 1});
  f.live.label({2, 2});
  QTRY_COMPARE_WITH_TIMEOUT(f.turn(), LiveState::Idle, kPatience);

  QVERIFY(f.live.labeling({2, 2}));
  QVERIFY(!f.live.labeling({0, 0}));
  QVERIFY(!f.live.labeling({0, 1}));
}

void LiveLabelerTest::newInput_outdatesWhatIsKnown() {
  Fixture f;
  f.live.set_input(f.input());
  f.live.label(f.center);
  QTRY_COMPARE_WITH_TIMEOUT(f.turn(), LiveState::Idle, kPatience);
  const LabelingPtr former = f.live.labeling(f.center);

  f.live.set_input(f.input(Regularizer::View));
  QCOMPARE(f.live.state(), LiveState::OutOfDate);
  QCOMPARE(f.live.labeling(f.center), former);
  QVERIFY(!f.live.is_up_to_date(f.center));
  f.live.label(f.center);
  QTRY_COMPARE_WITH_TIMEOUT(f.turn(), LiveState::Idle, kPatience);

  QVERIFY(f.live.labeling(f.center) != former);
  QVERIFY(f.live.is_up_to_date(f.center));
}

void LiveLabelerTest::sameInput_changesNothing() {
  Fixture f;
  f.live.set_input(f.input());
  f.live.label(f.center);
  QTRY_COMPARE_WITH_TIMEOUT(f.turn(), LiveState::Idle, kPatience);

  f.live.set_input(f.input());

  QVERIFY(f.live.is_up_to_date(f.center));
}

void LiveLabelerTest::cancel_leavesWhatWasKnown() {
  Fixture f;
  f.live.set_input(f.input());
  f.live.label(f.center);

  f.live.cancel();

  QCOMPARE(f.live.state(), LiveState::OutOfDate);
  QVERIFY(!f.live.is_running());
  f.live.label(f.center);
  QTRY_COMPARE_WITH_TIMEOUT(f.turn(), LiveState::Idle, kPatience);
  QVERIFY(f.live.labeling(f.center));
}

void LiveLabelerTest::oneLabel_isAHint() {
  Fixture f;
  LabelingInput input = f.input();
  input.scribbles = of_one_label(*input.scribbles);
  f.live.set_input(std::move(input));

  f.live.label(f.center);
  QTRY_COMPARE_WITH_TIMEOUT(f.turn(), LiveState::Hint, kPatience);

  QVERIFY(!f.live.sentence().empty());
  QVERIFY(!f.live.labeling(f.center));
}

void LiveLabelerTest::otherLightField_forgetsEverything() {
  Fixture f;
  f.live.set_input(f.input());
  f.live.label(f.center);
  QTRY_COMPARE_WITH_TIMEOUT(f.turn(), LiveState::Idle, kPatience);
  const auto former = f.live.input();
  const LabelingPtr late = f.live.labeling(f.center);

  f.scene = tiny_scene("objects");
  f.live.set_input(f.input());
  f.live.take(late, former);

  QCOMPARE(f.live.state(), LiveState::Idle);
  QVERIFY(!f.live.labeling(f.center));
}

void LiveLabelerTest::view_thatIsKnown_isThereAtOnce() {
  Fixture f;
  f.live.set_input(f.input());
  for (const ViewIndex view : {ViewIndex{1, 1}, ViewIndex{1, 2}}) {
    f.live.label(view);
    QTRY_COMPARE_WITH_TIMEOUT(f.turn(), LiveState::Idle, kPatience);
  }

  f.live.label({1, 1});

  QCOMPARE(f.live.state(), LiveState::Idle);
  QVERIFY(f.live.is_up_to_date({1, 1}));
}

void LiveLabelerTest::allViews_answerForEveryView() {
  Fixture f;
  f.live.set_input(f.input());
  const LabelingPtr all = label_all_views(*f.live.input(), Progress());

  f.live.take(all, f.live.input());

  QCOMPARE(f.live.state(), LiveState::Idle);
  QCOMPARE(f.live.labeling({0, 2}), all);
  QVERIFY(f.live.is_up_to_date({0, 2}));
  QVERIFY2(f.accuracy({0, 0}) > 0.8, qPrintable(QString::number(f.accuracy({0, 0}))));
}

namespace {

// The same strokes, in which label 1 has another number.
LabelingInput renumbered(LabelingInput input, std::uint8_t to) {
  auto strokes = std::make_shared<ScribbleLayer>(*input.scribbles);
  for (const ViewIndex view : strokes->painted_views()) {
    const auto own = strokes->writable_view(view);
    std::replace(own.data, own.data + own.size(), std::uint8_t{1}, to);
  }
  input.scribbles = std::move(strokes);
  return input;
}

std::int64_t count_of(const LabelingPtr& labeling, std::int32_t id) {
  return std::count(labeling->labels.data(), labeling->labels.data() + labeling->labels.size(), id);
}

}  // namespace

void LiveLabelerTest::relabeled_stayUpToDate_andComeBack() {
  Fixture f;
  const LabelingInput before = f.input();
  f.live.set_input(before);
  const LabelingPtr all = label_all_views(*f.live.input(), Progress());
  f.live.take(all, f.live.input());
  const auto pixels = count_of(all, 1);
  QVERIFY(pixels > 0);

  f.live.set_input(renumbered(before, 40));
  QVERIFY(!f.live.is_up_to_date({0, 2}));
  f.live.relabel(1, 40);

  QVERIFY(f.live.is_widest_up_to_date({0, 2}));
  QCOMPARE(f.live.state(), LiveState::Idle);
  const LabelingPtr changed = f.live.labeling({0, 2});
  QCOMPARE(count_of(changed, 40), pixels);
  QCOMPARE(count_of(changed, 1), 0);
  QCOMPARE(changed->probabilities.ids.back(), 40);
  const auto was = all->probabilities.view({0, 2}).view();
  const auto is = changed->probabilities.view({0, 2}).view();
  QVERIFY(std::equal(was.row(20, 0), was.row(20, 0) + was.width, is.row(20, is.layers - 1)));

  f.live.set_input(before);
  QCOMPARE(f.live.labeling({0, 2}), all);
  QVERIFY(f.live.is_widest_up_to_date({0, 2}));
}

void LiveLabelerTest::mergedLabels_haveBothProbabilities() {
  Fixture f;
  f.live.set_input(f.input());
  f.live.label(f.center);
  QTRY_COMPARE_WITH_TIMEOUT(f.turn(), LiveState::Idle, kPatience);
  const LabelingPtr before = f.live.labeling(f.center);

  f.live.set_input(renumbered(f.input(), 2));
  f.live.relabel(1, 2);

  const LabelingPtr merged = f.live.labeling(f.center);
  QVERIFY(f.live.is_up_to_date(f.center));
  QCOMPARE(count_of(merged, 2), count_of(before, 1) + count_of(before, 2));
  QCOMPARE(merged->probabilities.ids.size(), before->probabilities.ids.size() - 1);
  const auto was = before->probabilities.views[0].view(),
             is = merged->probabilities.views[0].view();
  for (int x = 0; x < is.width; ++x) {
    QCOMPARE(int{is.row(20, 0)[x]}, std::min(was.row(20, 0)[x] + was.row(20, 1)[x], 255));
  }
}

void LiveLabelerTest::destructor_whileRunning_isHarmless() {
  test::TurnedLoop loop;
  {
    Fixture f;
    LiveLabeler live(loop.post(), [] { QFAIL("told after its end"); });
    live.set_input(f.input());
    live.label(f.center);
  }

  loop.turn();
}

}  // namespace episcope::in_live_labeler_test

EPISCOPE_CORE_TEST(live_labeler_test, LiveLabelerTest)
#include "live_labeler_test.moc"
