// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/session.h"

#include "tests/app/session/tiny_scene.h"
#include "tests/app/session/turned_loop.h"
#include "tests/test_main.h"

namespace episcope::in_session_test {

namespace {

struct Fixture {
  test::TurnedLoop loop;
  Session session{loop.post()};
  std::vector<Parts> told;

  Fixture() {
    session.on_changed([this](Parts parts) { told.push_back(parts); });
  }
  void open() {
    session.open(tiny_scene(), "demo:edge");
    loop.turn();
    told.clear();
  }
};

}  // namespace

class SessionTest : public QObject {
  Q_OBJECT

 private slots:
  void changes_areGatheredAndToldOnce();
  void setters_thatChangeNothing_tellNothing();
  void place_isClampedToTheLightField();
  void estimate_ofFormerLightField_isDropped();
  void estimates_haveUniqueNamesAndIds();
  void removal_showsTheNeighbour();
  void evaluation_isComputedOnceInTheBackground();
  void evaluation_ofRemovedEstimate_isForgotten();
  void evaluation_withoutTruth_isNotBegun();
  void disparityRange_doesNotFollowTheShownEstimate();
  void disparityRange_ignoresTruthThatCannotBe();
  void scenes_keepWhatWasDoneOnThem();
  void estimateOfASceneSetAside_goesThere();
  void unloadedScene_takesBackWhatFilesKeep();
  void closedScene_isForgotten();
};

void SessionTest::changes_areGatheredAndToldOnce() {
  Fixture f;
  f.open();

  f.session.set_view({0, 1});
  f.session.set_view({0, 2});
  f.session.set_cross_hair({3, 4});
  QVERIFY(f.told.empty());
  f.loop.turn();

  QCOMPARE(f.told.size(), 1U);
  QVERIFY(f.told[0] == (Part::View | Part::CrossHair));
}

void SessionTest::setters_thatChangeNothing_tellNothing() {
  Fixture f;
  f.open();

  f.session.set_view(f.session.view());
  f.session.set_cross_hair(f.session.cross_hair());
  f.session.set_focus(f.session.focus_px());
  f.session.show_estimate(7);
  f.session.remove_estimate(7);
  f.loop.turn();

  QVERIFY(f.told.empty());
}

void SessionTest::place_isClampedToTheLightField() {
  Fixture f;
  f.open();

  f.session.set_view({-1, 99});
  f.session.set_cross_hair({99, -5});

  QVERIFY(f.session.view() == (ViewIndex{0, 2}));
  QVERIFY(f.session.cross_hair() == (PixelIndex{63, 0}));
}

void SessionTest::estimate_ofFormerLightField_isDropped() {
  Fixture f;
  f.open();
  const EstimatePtr late = shifted_truth(*f.session.scene(), 0);
  const std::uint64_t former = f.session.generation();
  f.session.open(tiny_scene("slant"), "demo:slant");

  const int id = f.session.add_estimate(late, {}, former);

  QCOMPARE(id, 0);
  QVERIFY(f.session.estimates().empty());
  QVERIFY(f.session.add_estimate(late, {}, f.session.generation()) != 0);
}

void SessionTest::estimates_haveUniqueNamesAndIds() {
  Fixture f;
  f.open();
  const EstimatePtr estimate = shifted_truth(*f.session.scene(), 0);

  const int first = f.session.add_estimate(estimate, {}, f.session.generation());
  f.session.remove_estimate(first);
  const int second = f.session.add_estimate(estimate, {}, f.session.generation());
  const int third = f.session.add_estimate(estimate, {}, f.session.generation());

  QVERIFY(first != second && second != third);
  QCOMPARE(f.session.find_estimate(second)->name, std::string("EPI_L"));
  QCOMPARE(f.session.find_estimate(third)->name, std::string("EPI_L 2"));
}

void SessionTest::removal_showsTheNeighbour() {
  Fixture f;
  f.open();
  const EstimatePtr estimate = shifted_truth(*f.session.scene(), 0);
  const int first = f.session.add_estimate(estimate, {}, f.session.generation());
  const int second = f.session.add_estimate(estimate, {}, f.session.generation());
  QCOMPARE(f.session.shown()->id, second);
  QCOMPARE(f.session.compared()->id, first);

  f.session.remove_estimate(second);
  QCOMPARE(f.session.shown()->id, first);
  QVERIFY(f.session.compared() == nullptr);
  f.session.remove_estimate(first);

  QVERIFY(f.session.shown() == nullptr);
}

void SessionTest::evaluation_isComputedOnceInTheBackground() {
  Fixture f;
  f.open();
  const int id =
      f.session.add_estimate(shifted_truth(*f.session.scene(), 0.5F), {}, f.session.generation());
  const EvaluationKey key{id, {1, 1}, Protocol::Vmv2013};
  f.loop.turn();
  f.told.clear();

  QVERIFY(!f.session.evaluation(key));
  QVERIFY(!f.session.evaluation(key));
  QTRY_VERIFY((f.loop.turn(), f.session.evaluation(key) != nullptr));
  f.loop.turn();

  // 100 · 0.5²
  const auto mse = find_metric(f.session.evaluation(key)->metrics, "mse_100");
  QVERIFY(mse.has_value());
  QVERIFY(std::abs(*mse - 25) < 1e-3);
  QVERIFY(f.session.evaluation(key) == f.session.evaluation(key));
  QCOMPARE(f.told.size(), 1U);
  QVERIFY(f.told[0] == Parts(Part::Evaluations));
}

void SessionTest::evaluation_ofRemovedEstimate_isForgotten() {
  Fixture f;
  f.open();
  const int id =
      f.session.add_estimate(shifted_truth(*f.session.scene(), 0.5F), {}, f.session.generation());
  const EvaluationKey key{id, {1, 1}, Protocol::Vmv2013};
  QVERIFY(!f.session.evaluation(key));

  f.session.remove_estimate(id);
  QTRY_VERIFY((f.loop.turn(), !f.session.is_evaluating()));
  f.loop.turn();

  QVERIFY(!f.session.evaluation(key));
  QVERIFY(!f.session.is_evaluating());
}

void SessionTest::evaluation_withoutTruth_isNotBegun() {
  Fixture f;
  auto scene = std::make_shared<Scene>(*tiny_scene());
  const EstimatePtr estimate = shifted_truth(*scene, 0);
  scene->truth = std::make_shared<const GroundTruth>();
  f.session.open(scene, "x");
  const int id = f.session.add_estimate(estimate, {}, f.session.generation());

  QVERIFY(!f.session.has_truth({1, 1}));
  QVERIFY(!f.session.evaluation({id, {1, 1}, Protocol::Vmv2013}));
  QVERIFY(!f.session.is_evaluating());
}

void SessionTest::disparityRange_doesNotFollowTheShownEstimate() {
  Fixture f;
  auto scene = std::make_shared<Scene>(*tiny_scene());
  const EstimatePtr estimate = shifted_truth(*scene, 0);
  scene->truth = std::make_shared<const GroundTruth>();
  f.session.open(scene, "x");

  f.session.add_estimate(estimate, {-2, 3}, f.session.generation());
  f.session.add_estimate(estimate, {-9, 9}, f.session.generation());

  QVERIFY(f.session.disparity_range() == (Interval{-2, 3}));
}

// 1e30 for "nothing" would make one color of all disparities.
void SessionTest::disparityRange_ignoresTruthThatCannotBe() {
  Fixture f;
  auto scene = std::make_shared<Scene>(*tiny_scene());
  auto truth = std::make_shared<GroundTruth>();
  truth->field.disparity = scene->truth->field.disparity.clone();
  truth->field.disparity.view({1, 1}).at(0, 0) = 1e30F;
  scene->truth = truth;

  f.session.open(scene, "x");
  f.session.add_estimate(shifted_truth(*scene, 0), {-2, 3}, f.session.generation());

  QVERIFY(f.session.disparity_range() == (Interval{-2, 3}));
}

void SessionTest::scenes_keepWhatWasDoneOnThem() {
  Fixture f;
  f.open();
  const std::uint64_t first = f.session.generation();
  f.session.add_estimate(shifted_truth(*f.session.scene(), 0), {}, first);
  f.session.set_view({0, 1});
  f.session.set_focus(0.5);

  f.session.add(tiny_scene("slant"), "demo:slant");
  QCOMPARE(f.session.scenes().size(), 2U);
  QVERIFY(f.session.estimates().empty());
  QVERIFY(f.session.view() == f.session.light_field()->center());
  QCOMPARE(f.session.focus_px(), 0.0);
  f.session.choose(first);

  QCOMPARE(f.session.input(), std::string("demo:edge"));
  QCOMPARE(f.session.estimates().size(), 1U);
  QVERIFY(f.session.shown() != nullptr);
  QVERIFY(f.session.view() == (ViewIndex{0, 1}));
  QCOMPARE(f.session.focus_px(), 0.5);
  QCOMPARE(f.session.scene_of("demo:slant"), f.session.scenes()[1]->id);
}

void SessionTest::estimateOfASceneSetAside_goesThere() {
  Fixture f;
  f.open();
  const std::uint64_t first = f.session.generation();
  const EstimatePtr late = shifted_truth(*f.session.scene(), 0);
  f.session.add(tiny_scene("slant"), "demo:slant");

  const int id = f.session.add_estimate(late, {}, first);

  QVERIFY(id != 0 && f.session.estimates().empty());
  f.session.choose(first);
  QCOMPARE(f.session.shown()->id, id);
}

void SessionTest::unloadedScene_takesBackWhatFilesKeep() {
  Fixture f;
  f.open();
  const std::uint64_t first = f.session.generation();
  const auto scene = f.session.scene();
  const EstimatePtr estimate = shifted_truth(*scene, 0);
  const int kept = f.session.add_estimate(estimate, {}, first);
  const int lost = f.session.add_estimate(estimate, {}, first);
  f.session.set_kept(kept, "kept.h5");
  f.session.set_kept(lost, "lost.h5");
  f.session.add(tiny_scene("slant"), "demo:slant");

  f.session.unload(first);
  QVERIFY(byte_size(*f.session.find_scene(first)) == 0);
  f.session.choose(first);  // not in memory
  QVERIFY(f.session.generation() != first);
  f.session.load(first, scene, {{kept, estimate}});
  f.session.choose(first);

  QCOMPARE(f.session.estimates().size(), 1U);
  QCOMPARE(f.session.shown()->estimate, estimate);
}

void SessionTest::closedScene_isForgotten() {
  Fixture f;
  f.open();
  const std::uint64_t first = f.session.generation();
  f.session.add(tiny_scene("slant"), "demo:slant");
  f.session.close();

  QVERIFY(!f.session.scene());
  QCOMPARE(f.session.scenes().size(), 1U);
  f.session.add(tiny_scene("slant"), "demo:slant");
  f.session.choose(first);
  f.session.open(tiny_scene(), "demo:edge");  // read in another way: at its place of the list
  QCOMPARE(f.session.scenes()[0]->id, f.session.generation());
  f.session.remove(f.session.scenes()[1]->id);
  f.session.close();
  QVERIFY(f.session.scenes().empty());
}

}  // namespace episcope::in_session_test

EPISCOPE_CORE_TEST(session_test, SessionTest)
#include "session_test.moc"
