// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/live_estimator.h"

#include "app/session/session.h"
#include "engine/disparity/registry.h"
#include "engine/scenes/builtin.h"
#include "tests/app/session/turned_loop.h"
#include "tests/patience.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace episcope::in_live_estimator_test {

namespace {

constexpr PixelRect kPart{40, 72, 72, 104};

std::shared_ptr<const Scene> small_scene() {
  scenes::RenderOptions options;
  options.grid = {5, 5};
  options.height = options.width = 144;
  return std::make_shared<const Scene>(scenes::render_builtin("edge", options, Progress()));
}

struct Fixture {
  std::shared_ptr<const Scene> scene = small_scene();
  test::TurnedLoop loop;
  std::vector<LiveMap> maps;  // in the order in which they came
  LiveEstimator live{loop.post(), [this] { note(); }};
  ViewIndex center = scene->light_field->center();

  void note() {
    const auto& map = live.map();
    if (map && (maps.empty() || maps.back().estimate != map->estimate)) maps.push_back(*map);
  }
  [[nodiscard]] LiveRequest request(const std::string& method = "epi_l") const {
    return {scene->light_field, method, {}, center, {}};
  }
  LiveStage turn() {
    loop.turn();
    return live.stage();
  }
  void wait() { QTRY_COMPARE_WITH_TIMEOUT(turn(), LiveStage::Idle, kScenePatience); }
  [[nodiscard]] Estimate run(const std::string& method, const ParameterSet& values = {}) const {
    return find_estimator(method).run(*scene->light_field, values, {.views = ViewSelection::Center},
                                      Progress());
  }
};

// Share of the pixels of `part` in which both maps have values that differ by less than `near_px`.
double agreement(const DisparityView& a, const DisparityView& b, const PixelRect& part,
                 double near_px) {
  int same = 0;
  for (int y = part.y0; y < part.y1; ++y) {
    for (int x = part.x0; x < part.x1; ++x) {
      same += a.is_valid(y, x) && b.is_valid(y, x) &&
              std::abs(a.disparity.at(y, x) - b.disparity.at(y, x)) < near_px;
    }
  }
  return static_cast<double>(same) / ((part.y1 - part.y0) * (part.x1 - part.x0));
}

}  // namespace

class LiveEstimatorTest : public QObject {
  Q_OBJECT

 private slots:
  void request_givesACoarseMapAndThenWhatRunGives_data();
  void request_givesACoarseMapAndThenWhatRunGives();
  void partInSight_isThatPartOfTheWholeMap();
  void otherView_isEstimated_data();
  void otherView_isEstimated();
  void newRequest_dropsTheFormer();
  void knownRequest_isNotRepeated();
  void wrongParameter_failsWithASentence();
  void clear_forgetsTheMap();
  void destructor_whileRunning_isHarmless();
  void session_looksAtTheLiveMap_butDoesNotKeepIt();
  void evaluation_isOfThePartAlone();
};

void LiveEstimatorTest::request_givesACoarseMapAndThenWhatRunGives_data() {
  QTest::addColumn<QString>("method");
  for (const char* method : {"epi_l", "epi_s", "st_ch_l", "st_av_l", "st_ch_g", "net"}) {
    QTest::newRow(method) << method;
  }
}

void LiveEstimatorTest::request_givesACoarseMapAndThenWhatRunGives() {
  QFETCH(QString, method);
  Fixture f;

  f.live.request(f.request(method.toStdString()));
  QCOMPARE(f.live.stage(), LiveStage::Coarse);
  f.wait();

  QCOMPARE(f.maps.size(), 2U);
  QVERIFY(f.maps[0].is_coarse && !f.maps[1].is_coarse);
  QVERIFY(f.live.coarse_seconds() && f.live.full_seconds());
  const PixelRect all{0, 0, 144, 144};
  const Estimate run = f.run(method.toStdString());
  QCOMPARE(agreement(f.maps[1].estimate->field.view(f.center), run.field.view(f.center), all, 1e-3),
           1.0);
  // Half a pixel of the small views is two of these at the edge; the planes are right.
  const auto coarse = f.maps[0].estimate->field.view(f.center);
  const double near = agreement(coarse, f.scene->truth->field.view(f.center), all, 0.4);
  QVERIFY2(near > 0.7, qPrintable(QString::number(near)));
}

void LiveEstimatorTest::partInSight_isThatPartOfTheWholeMap() {
  Fixture f;
  LiveRequest request = f.request();
  request.in_sight = kPart;

  f.live.request(request);
  f.wait();

  const LiveMap& map = *f.live.map();
  QVERIFY(map.part == kPart);
  const auto part = map.estimate->field.view(f.center);
  const Estimate run = f.run("epi_l");
  QCOMPARE(agreement(part, run.field.view(f.center), kPart, 1e-3), 1.0);
  QVERIFY(!part.is_valid(kPart.y0 - 1, kPart.x0));
  QVERIFY(!part.is_valid(kPart.y1, kPart.x0));
  QVERIFY(!part.is_valid(kPart.y0, kPart.x1));
}

void LiveEstimatorTest::otherView_isEstimated_data() {
  QTest::addColumn<QString>("method");
  QTest::newRow("of all views") << "epi_l";
  QTest::newRow("of a chosen view") << "st_ch_l";
}

void LiveEstimatorTest::otherView_isEstimated() {
  QFETCH(QString, method);
  Fixture f;
  LiveRequest request = f.request(method.toStdString());
  request.view = {1, 3};

  f.live.request(request);
  f.wait();

  QCOMPARE(f.maps.size(), 2U);
  for (const LiveMap& map : f.maps) {
    QVERIFY(map.estimate->contains({1, 3}));
    const double near = agreement(map.estimate->field.view({1, 3}),
                                  f.scene->truth->field.view({1, 3}), {0, 0, 144, 144}, 0.4);
    QVERIFY2(near > 0.7, qPrintable(QString::number(near)));
  }
}

void LiveEstimatorTest::newRequest_dropsTheFormer() {
  Fixture f;
  f.live.request(f.request("st_av_g"));
  f.live.request(f.request("epi_l"));
  f.wait();

  QCOMPARE(f.maps.size(), 2U);
  for (const LiveMap& map : f.maps) QCOMPARE(map.estimate->method, std::string("epi_l"));
}

void LiveEstimatorTest::knownRequest_isNotRepeated() {
  Fixture f;
  LiveRequest request = f.request();
  request.view = {0, 0};
  f.live.request(request);
  f.wait();
  const EstimatePtr known = f.live.map()->estimate;

  request.view = {4, 2};  // all views are known
  f.live.request(request);
  QCOMPARE(f.live.stage(), LiveStage::Idle);
  request.in_sight = kPart;
  f.live.request(request);
  QCOMPARE(f.live.stage(), LiveStage::Idle);
  QCOMPARE(f.live.map()->estimate, known);

  request.parameters = {{"inner_scale", 1.2}};
  f.live.request(request);
  QCOMPARE(f.live.stage(), LiveStage::Coarse);
  f.wait();
  QVERIFY(f.live.map()->estimate != known);
}

void LiveEstimatorTest::wrongParameter_failsWithASentence() {
  Fixture f;
  LiveRequest request = f.request();
  request.parameters = {{"inner_scale", -5.0}};

  f.live.request(request);
  QTRY_COMPARE_WITH_TIMEOUT(f.turn(), LiveStage::Failed, kPatience);

  QVERIFY(QString::fromStdString(f.live.sentence()).contains("inner_scale"));
  QVERIFY(!f.live.map());
  f.live.request(f.request());
  f.wait();
  QVERIFY(f.live.map());
}

void LiveEstimatorTest::clear_forgetsTheMap() {
  Fixture f;
  f.live.request(f.request());
  f.wait();

  f.live.clear();

  QVERIFY(!f.live.map());
  QCOMPARE(f.live.stage(), LiveStage::Idle);
}

void LiveEstimatorTest::destructor_whileRunning_isHarmless() {
  test::TurnedLoop loop;
  int told = 0;
  {
    Fixture f;
    LiveEstimator live(loop.post(), [&told] { ++told; });
    live.request(f.request("st_av_g"));
  }
  loop.turn();
  QCOMPARE(told, 0);
}

void LiveEstimatorTest::session_looksAtTheLiveMap_butDoesNotKeepIt() {
  Fixture f;
  f.live.request(f.request());
  f.wait();
  Session session(f.loop.post());
  session.open(f.scene, "edge");
  const int kept = session.add_estimate(std::make_shared<const Estimate>(f.run("epi_l")), {},
                                        session.generation());

  session.set_live({0, "Live", f.live.map()->estimate, {}}, session.generation());

  QCOMPARE(session.estimates().size(), 1U);
  QCOMPARE(session.side_a(), session.live());
  QCOMPARE(session.side_b()->id, kept);
  QCOMPARE(session.shown()->id, kept);
  session.remove_estimate(session.live()->id);
  session.show_estimate(session.live()->id);
  QCOMPARE(session.shown()->id, kept);
  session.clear_live();
  QCOMPARE(session.side_a()->id, kept);
  session.set_live({0, "Live", f.live.map()->estimate, {}}, session.generation());
  session.close();
  QVERIFY(!session.side_a());
}

void LiveEstimatorTest::evaluation_isOfThePartAlone() {
  Fixture f;
  LiveRequest request = f.request();
  request.in_sight = kPart;
  f.live.request(request);
  f.wait();
  Session session(f.loop.post());
  session.open(f.scene, "edge");
  EstimateEntry entry{0, "Live", f.live.map()->estimate, {}};
  entry.part = f.live.map()->part;
  session.set_live(entry, session.generation());

  EvaluationPtr evaluation;
  const EvaluationKey key{session.live()->id, f.center, Protocol::Vmv2013};
  QTRY_VERIFY_WITH_TIMEOUT((f.loop.turn(), evaluation = session.evaluation(key)), kPatience);

  const Image<std::uint8_t>& judged = evaluation->judged;
  const auto count = std::ranges::count_if(std::span(judged.data(), judged.size()),
                                           [](std::uint8_t each) { return each != 0; });
  QCOMPARE(count, 32L * 32);
  QVERIFY(judged.at(kPart.y0, kPart.x0) != 0);
}

}  // namespace episcope::in_live_estimator_test

EPISCOPE_TEST(live_estimator_test, LiveEstimatorTest)
#include "live_estimator_test.moc"
