// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/sweep.h"
#include "tests/test_main.h"

#include "app/session/judge.h"
#include "engine/core/error.h"
#include "engine/disparity/registry.h"
#include "tests/app/session/tiny_scene.h"

namespace episcope::in_sweep_test {

namespace {

ParameterDescription real(double min, double max, bool logarithmic = false) {
  return {.key = "lambda",
          .label = "Smoothing",
          .help = {},
          .unit = {},
          .default_value = 1.0,
          .min = min,
          .max = max,
          .logarithmic = logarithmic};
}

std::vector<double> numbers(const std::vector<ParameterValue>& values) {
  std::vector<double> result;
  for (const ParameterValue& value : values) result.push_back(number_of(value));
  return result;
}

SweptParameter swept(const char* key, std::initializer_list<double> values) {
  return {key, {values.begin(), values.end()}};
}

}  // namespace

class SweepTest : public QObject {
  Q_OBJECT

 private slots:
  void values_areReadAsAListOrARange() {
    const ParameterDescription even = real(0, 10), powers = real(0.01, 100, true);
    QCOMPARE(numbers(parse_sweep_values(even, "2, 1;0.5 2")), (std::vector{0.5, 1.0, 2.0}));
    QCOMPARE(numbers(parse_sweep_values(even, "0:10:5")), (std::vector{0.0, 2.5, 5.0, 7.5, 10.0}));
    QCOMPARE(numbers(parse_sweep_values(powers, "0.1 : 10 : 3")), (std::vector{0.1, 1.0, 10.0}));
  }

  void whatIsNoValue_isRefused() {
    for (const char* text : {"", " , ", "x", "11", "1:2", "1:2:0", "1:2:3:4"}) {
      QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)parse_sweep_values(real(0, 10), text));
    }
  }

  void proposals_canBeReadBackForEveryMethod() {
    for (const Estimator& method : registered_estimators()) {
      for (const ParameterDescription& each : method.parameters) {
        if (!can_sweep(each)) continue;
        const auto values = parse_sweep_values(each, proposed_sweep_values(each));
        QVERIFY2(!values.empty(), (method.info.id + " " + each.key).c_str());
        if (!each.searched.empty()) QCOMPARE(values.size(), each.searched.size());
      }
    }
  }

  void points_beginWithTheBase() {
    ParameterDescription a = real(0, 10), b = real(0, 10);
    b.key = "scale";
    const ParameterSet base{{"lambda", 3.0}, {"scale", 2.0}};
    const auto points =
        sweep_points({a, b}, base, {swept("lambda", {1, 2}), swept("scale", {2, 4})});
    QCOMPARE(points.size(), 5U);
    QVERIFY(points[0] == base);
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             (void)sweep_points({a, b}, base,
                                                {{"lambda", parse_sweep_values(a, "0:10:8")},
                                                 {"scale", parse_sweep_values(b, "0:10:8")}}));
  }

  void point_isTheRunOfTheMethodWithItsValues() {
    const auto scene = tiny_scene();
    const EstimateRequest base{"epi_l", {}, {}};
    const SweepPoint first = run_sweep_point(*scene, base, {}, nullptr, Progress());
    const SweepPoint other =
        run_sweep_point(*scene, base, {{"inner_scale", 1.2}}, first.estimate.get(), Progress());
    QCOMPARE(first.problem, std::string());
    QCOMPARE(first.change_px, 0.0);
    QVERIFY(other.change_px > 0);
    QCOMPARE(other.estimate->field.disparity.grid().count(), 1);
    const FinishedEstimate again =
        run_estimator(*scene, find_estimator("epi_l"), {{"inner_scale", 1.2}}, {}, Progress());
    const auto judged = judge(*again.estimate, *scene, {});
    QCOMPARE(measure_of(other, SweepMeasure::MseTimes100), find_metric(judged.metrics, "mse_100"));
    QVERIFY(measure_of(other, SweepMeasure::BadPix007).has_value());
  }

  void point_thatFailsSaysWhy() {
    const SweepPoint point = run_sweep_point(*tiny_scene(), {"epi_l", {}, {}},
                                             {{"inner_scale", -1.0}}, nullptr, Progress());
    QVERIFY(!point.estimate);
    QVERIFY(point.problem.find("inner_scale") != std::string::npos);
  }

  void lines_areOfOneValueOfTheSecondParameter() {
    std::vector<SweepPoint> points;
    for (const auto& [a, b] : {std::pair{3.0, 2.0}, {2.0, 2.0}, {1.0, 2.0}, {1.0, 4.0}}) {
      points.push_back({.point = {{"lambda", a}, {"scale", b}}, .estimate = {}});
    }
    const auto lines = lines_of(points, {swept("lambda", {1, 2}), swept("scale", {2, 4})});
    QCOMPARE(lines.size(), 2U);
    QVERIFY(lines[0].second == ParameterValue(2.0));
    QCOMPARE(lines[0].places.size(), 2U);  // without the base, which is beside the grid
    QCOMPARE(lines[0].places[0].point, 2U);
    QCOMPARE(lines[1].places[0].x, 1.0);
  }

  void mean_isOfAllLightFieldsThatHaveThePoint() {
    SweepPoint one{.point = {{"lambda", 1.0}}, .estimate = {}}, other = one;
    one.vmv2013 = {{"mse_100", 0.5}};
    other.vmv2013 = {{"mse_100", 1.5}};
    const std::vector<SweepScene> scenes{{1, "edge", {one, one}}, {2, "slant", {other}}};

    QCOMPARE(mean_of(scenes, 0, SweepMeasure::MseTimes100), std::optional(1.0));
    QVERIFY(!mean_of(scenes, 1, SweepMeasure::MseTimes100));  // of one only
    QVERIFY(!mean_of(scenes, 0, SweepMeasure::Seconds));
    QCOMPARE(common_count(scenes), 1U);
    const TextTable table = sweep_table(scenes, {{"method", "epi_s"}});
    QCOMPARE(table.rows.size(), 3U);
    QCOMPARE(table.rows[2][0], std::string("slant"));
  }

  void list_givesBackWhatItWasGiven_andForgetsClosedScenes() {
    int changes = 0;
    SweepList list;
    list.on_changed([&changes] { ++changes; });
    Sweep sweep;
    sweep.scenes = {{7, "edge"}, {8, "slant"}};
    const std::uint64_t id = list.add(sweep);
    list.add_point(id, 8, {.point = {{"lambda", 1.0}}, .estimate = {}});
    list.add_point(id, 9, {.point = {{"lambda", 1.0}}, .estimate = {}});  // of no scene of it
    QVERIFY(list.find(id, {1, 0}));
    QVERIFY(!list.find(id, {1, 1}) && !list.find(id, {0, 0}));
    QCOMPARE(changes, 2);

    const Sweep written = *list.find(id);
    list.mark_saved(written);
    QVERIFY(list.find(id)->is_saved);
    list.add_point(id, 7, {.point = {{"lambda", 1.0}}, .estimate = {}});
    list.mark_saved(written);  // which lacks a point
    QVERIFY(!list.find(id)->is_saved);

    list.keep_scenes({8, 20});
    QCOMPARE(list.find(id)->scenes.size(), 1U);
    QCOMPARE(list.find(id)->scenes[0].scene, 8U);
    list.keep_scenes({});
    QVERIFY(list.all().empty());
  }

  void table_hasARowForEachPoint() {
    SweepPoint judged{.point = {{"lambda", 1.0}}, .estimate = {}};
    judged.seconds = 2;
    judged.vmv2013 = {{"mse_100", 0.5}};
    SweepPoint failed{.point = {{"lambda", 2.0}}, .estimate = {}};
    failed.problem = "not enough memory";
    const TextTable table = sweep_table({{1, "edge", {judged, failed}}}, {});
    QVERIFY(table.header == std::vector<std::string>({"scene", "lambda", "vmv2013.mse_100",
                                                      "seconds", "change_px", "problem"}));
    QVERIFY(table.rows[0] == std::vector<std::string>({"edge", "1", "0.5", "2", "", ""}));
    QCOMPARE(table.rows[1][2], std::string());
    QCOMPARE(table.rows[1][5], std::string("not enough memory"));
  }
};

}  // namespace episcope::in_sweep_test

EPISCOPE_TEST(sweep_test, SweepTest)
#include "sweep_test.moc"
