// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/net.h"

#include "engine/core/error.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/engine/disparity/net/net_vectors.h"
#include "tests/test_main.h"

#include <atomic>
#include <chrono>
#include <cmath>

namespace episcope::in_net_test {

using namespace episcope::test;

namespace {

// Each layer rounds sums of up to 1728 products; the logits of the volume, up to 20, then differ
// by up to 2·10⁻⁵, disparities by a millionth of the range.
constexpr double kMapTolerance = 1e-5;
constexpr double kProbabilityTolerance = 5e-5;

NetMaps vector_maps(const NetParameters& parameters, const Progress& progress = Progress()) {
  const LightField light_field = vector_light_field();
  return estimate_net(light_field, light_field.center(), released_weights(), parameters, progress);
}

bool same(const Image<float>& a, const Image<float>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

bool all_finite(const Image<float>& map) {
  return std::all_of(map.begin(), map.end(), [](float value) { return std::isfinite(value); });
}

}  // namespace

class NetTest : public QObject {
  Q_OBJECT

 private slots:
  void maps_areThoseOfTheVectors();
  void secondRound_isThatOfTheVectors();
  void polishedMap_isThatOfTheVectors();
  void threads_changeNothing();
  void mean_differsAtSilhouettesAlone();
  void labels_followTheRange_data();
  void labels_followTheRange();
  void grids_areTaken_data();
  void grids_areTaken();
  void shear_movesTheMap();
  void stop_endsSoon();
  void wrongInput_isRefused();
};

void NetTest::maps_areThoseOfTheVectors() {
  const NetMaps maps = vector_maps({.range = vector_range(), .rounds = 1});

  QVERIFY(largest_difference(maps.disparity, "map") < kMapTolerance);
  QVERIFY(largest_difference(maps.confidence, "confidence") < kProbabilityTolerance);
  QVERIFY(largest_difference(maps.second, "second") < kMapTolerance);
  QVERIFY(largest_difference(maps.second_probability, "second_probability") <
          kProbabilityTolerance);
}

void NetTest::secondRound_isThatOfTheVectors() {
  const NetMaps maps = vector_maps({.range = vector_range(), .rounds = 2});

  QVERIFY(largest_difference(maps.disparity, "map_two_rounds") < kMapTolerance);
}

void NetTest::polishedMap_isThatOfTheVectors() {
  const LightField light_field = vector_light_field();
  Image<float> map = net_vector_map("truth");
  for (float& disparity : map) disparity += 0.03F;

  const NetMaps maps =
      polish_by_net(light_field, light_field.center(), map, released_weights(), {}, Progress());

  QVERIFY(largest_difference(maps.disparity, "polished") < kMapTolerance);
}

void NetTest::threads_changeNothing() {
  const NetMaps one = vector_maps({.range = vector_range()}, Progress(1));
  const NetMaps three = vector_maps({.range = vector_range()}, Progress(3));

  QVERIFY(same(one.disparity, three.disparity));
  QVERIFY(same(one.confidence, three.confidence));
}

void NetTest::mean_differsAtSilhouettesAlone() {
  const NetMaps mode = vector_maps({.range = vector_range()});
  const NetMaps mean = vector_maps({.range = vector_range(), .silhouettes = Silhouettes::Mean});

  QVERIFY(same(mode.confidence, mean.confidence));
  QVERIFY(!same(mode.disparity, mean.disparity));
  for (std::size_t i = 0; i < mode.disparity.size(); ++i) {
    if (mode.second_probability.data()[i] > 0.001F) continue;
    // What is left are hypotheses nearer than 0.3 px.
    QVERIFY(std::abs(mode.disparity.data()[i] - mean.disparity.data()[i]) < 0.3F);
  }
}

void NetTest::labels_followTheRange_data() {
  QTest::addColumn<double>("length");
  QTest::addColumn<int>("count");
  QTest::newRow("least") << 0.5 << 32;
  QTest::newRow("exact") << 3.1 << 32;
  QTest::newRow("more") << 3.2 << 40;
  QTest::newRow("usual") << 3.9 << 40;
  QTest::newRow("most") << 100.0 << 64;
}

void NetTest::labels_followTheRange() {
  QFETCH(const double, length);
  QFETCH(const int, count);

  QCOMPARE(net_label_count({-1, length - 1}), count);
}

void NetTest::grids_areTaken_data() {
  QTest::addColumn<int>("rows");
  QTest::addColumn<int>("columns");
  QTest::addColumn<int>("channels");
  QTest::newRow("line") << 1 << 5 << 3;
  QTest::newRow("column") << 5 << 1 << 1;
  QTest::newRow("pair") << 1 << 2 << 1;
  QTest::newRow("even") << 4 << 4 << 3;
}

void NetTest::grids_areTaken() {
  QFETCH(const int, rows);
  QFETCH(const int, columns);
  QFETCH(const int, channels);
  const LightField light_field =
      make_light_field({rows, columns}, 9, 13, channels, [](ViewIndex view, int y, int x, int) {
        return 0.5F + 0.4F * std::sin(1.3F * (x + view.u) + 0.7F * (y + view.v));
      });

  for (const ViewIndex view : {light_field.center(), ViewIndex{0, 0}}) {
    const NetMaps maps =
        estimate_net(light_field, view, released_weights(), {.range = {-2, 1}}, Progress());
    QVERIFY(all_finite(maps.disparity) && all_finite(maps.confidence));
    QVERIFY(all_finite(maps.second) && all_finite(maps.second_probability));
  }
}

// A light field of disparities larger by a whole pixel has maps larger by that.
void NetTest::shear_movesTheMap() {
  const Scene scene = render("objects", 40, 48, {5, 5});
  const LightField moved = sheared(*scene.light_field, 1);
  const auto map_of = [](const LightField& light_field, Interval range) {
    return estimate_net(light_field, light_field.center(), released_weights(), {.range = range},
                        Progress())
        .disparity;
  };

  const Image<float> map = map_of(*scene.light_field, {-2, 2});
  const Image<float> other = map_of(moved, {-1, 3});

  int alike = 0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    alike += std::abs(other.data()[i] - map.data()[i] - 1) < 0.05F;
  }
  // Views that are sheared repeat their border, where evidence differs.
  QVERIFY(alike > 0.8 * static_cast<double>(map.size()));
}

void NetTest::stop_endsSoon() {
  const LightField light_field = make_light_field(
      {3, 3}, 96, 96, 1, [](ViewIndex, int y, int x, int) { return ((x ^ y) & 7) / 8.0F; });
  std::stop_source stop;
  std::chrono::steady_clock::time_point asked;
  std::atomic<bool> has_asked = false;
  const auto listener = [&](const ProgressState& state) {
    if (state.fraction < 0.1 || has_asked.exchange(true)) return;
    asked = std::chrono::steady_clock::now();
    stop.request_stop();
  };

  QVERIFY_THROWS_EXCEPTION(
      Cancelled, (void)estimate_net(light_field, {1, 1}, released_weights(), {.range = {-2, 2}},
                                    Progress(stop.get_token(), listener)));

  QVERIFY(has_asked);
  QVERIFY(std::chrono::steady_clock::now() - asked < std::chrono::seconds(2));  // busy machines
}

void NetTest::wrongInput_isRefused() {
  const LightField light_field = vector_light_field();
  const auto run = [&](ViewIndex view, const NetParameters& parameters) {
    (void)estimate_net(light_field, view, released_weights(), parameters, Progress());
  };

  QVERIFY_THROWS_EXCEPTION(InvalidInput, run({5, 0}, {.range = {-1, 1}}));
  QVERIFY_THROWS_EXCEPTION(InvalidInput, run({2, 2}, {.range = {1, 1}}));
  QVERIFY_THROWS_EXCEPTION(InvalidInput, run({2, 2}, {.range = {-1, 1}, .rounds = 0}));
  QVERIFY_THROWS_EXCEPTION(
      InvalidInput, (void)polish_by_net(light_field, {2, 2}, Image<float>(3, 3), released_weights(),
                                        {}, Progress()));
}

}  // namespace episcope::in_net_test

EPISCOPE_TEST(net_test, NetTest)
#include "net_test.moc"
