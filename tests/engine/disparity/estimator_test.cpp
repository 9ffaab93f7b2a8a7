// SPDX-License-Identifier: BSD-3-Clause
// What every estimator must guarantee to callers that run it by name: data-driven over the
// registry.
#include "engine/disparity/estimator.h"

#include "engine/core/error.h"
#include "engine/core/version.h"
#include "engine/cuda/device.h"
#include "engine/disparity/registry.h"
#include "tests/cpu_time.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <set>
#include <stop_token>
#include <vector>

namespace episcope::in_estimator_test {

using namespace episcope::test;

namespace {

using Clock = std::chrono::steady_clock;

const LightField& tiny() {
  static const Scene scene = render("edge", 48, 56, {5, 5});
  return *scene.light_field;
}

void add_methods() {
  QTest::addColumn<QString>("id");
  for (const Estimator& estimator : registered_estimators()) {
    QTest::newRow(estimator.info.id.c_str()) << QString::fromStdString(estimator.info.id);
  }
}

const RunOptions kCenter{.views = ViewSelection::Center};

RunOptions widest(const Estimator& estimator) {
  return {.views = estimator.info.all_views ? ViewSelection::All : ViewSelection::Center};
}

Estimator fetched() {
  QFETCH(QString, id);
  return find_estimator(id.toStdString());
}

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

class EstimatorTest : public QObject {
  Q_OBJECT

 private slots:
  void registry_listsDistinctMethods();
  void mainParameters_areTwoOrThreeThatExist_data() { add_methods(); }
  void mainParameters_areTwoOrThreeThatExist();
  void unknownMethod_namesTheNearest();
  void parameters_haveDistinctKeys_data() { add_methods(); }
  void parameters_haveDistinctKeys();
  void foreignDevice_isUnavailable_data() { add_methods(); }
  void foreignDevice_isUnavailable();
  void method_runsAndFillsProvenance_data() { add_methods(); }
  void method_runsAndFillsProvenance();
  void givenParameters_areUsedAndRecorded_data() { add_methods(); }
  void givenParameters_areUsedAndRecorded();
  void badParameters_areRefused_data() { add_methods(); }
  void badParameters_areRefused();
  void everyParameterAtItsEnds_runs_data();
  void everyParameterAtItsEnds_runs();
  void singleView_isRefused_data() { add_methods(); }
  void singleView_isRefused();
  void progress_risesToOne_data();
  void progress_risesToOne();
  void unevenViews_takeTheirShareOfTheProgress();
  void stop_endsWithinLimit_data() { add_methods(); }
  void stop_endsWithinLimit();
  void stopBeforeStart_throwsCancelled_data() { add_methods(); }
  void stopBeforeStart_throwsCancelled();
};

void EstimatorTest::registry_listsDistinctMethods() {
  std::set<std::string> ids;
  for (const Estimator& estimator : registered_estimators()) {
    QVERIFY(ids.insert(estimator.info.id).second);
    QVERIFY(!estimator.info.name.empty() && !estimator.info.summary.empty());
    QVERIFY(!estimator.info.reference.empty());
    QVERIFY(!estimator.parameters.empty());
    for (const ParameterDescription& parameter : estimator.parameters) {
      QVERIFY2(!parameter.label.empty() && !parameter.help.empty(), parameter.key.c_str());
    }
  }
  QVERIFY(ids.contains("epi_l") && ids.contains("epi_s"));
}

void EstimatorTest::mainParameters_areTwoOrThreeThatExist() {
  const Estimator estimator = fetched();
  const std::vector<std::string>& keys = estimator.info.main_parameters;

  QVERIFY(keys.size() == 2 || keys.size() == 3);
  QCOMPARE(keys.front(), std::string("range"));
  for (const std::string& key : keys) {
    QVERIFY2(std::ranges::count(estimator.parameters, key, &ParameterDescription::key) == 1,
             key.c_str());
  }
}

void EstimatorTest::unknownMethod_namesTheNearest() {
  QVERIFY_THROWS_EXCEPTION(Unavailable, (void)find_estimator("epi_t"));
  const std::string text = message_of([] { (void)find_estimator("epi_sl"); });
  QVERIFY2(mentions(text, "'epi_sl'") && mentions(text, "did you mean 'epi_"), text.c_str());
  const std::string far = message_of([] { (void)find_estimator("zzzzzzzzzzzz"); });
  QVERIFY2(!far.empty() && !mentions(far, "did you mean"), far.c_str());
}

// Parts of a schema might bring the same key.
void EstimatorTest::parameters_haveDistinctKeys() {
  std::set<std::string> keys;
  for (const ParameterDescription& parameter : fetched().parameters) {
    QVERIFY2(keys.insert(parameter.key).second, parameter.key.c_str());
  }
}

void EstimatorTest::foreignDevice_isUnavailable() {
  const Estimator estimator = fetched();

  require_device(Device::Auto, estimator.info);
  require_device(Device::Cpu, estimator.info);
  const bool can = std::ranges::count(estimator.info.devices, Device::Cuda) > 0;
  if (can && has_cuda_device()) QSKIP("there is a GPU, which tests/cuda is for");
  QVERIFY_THROWS_EXCEPTION(Unavailable, require_device(Device::Cuda, estimator.info));
  QCOMPARE(chosen_device(Device::Auto, estimator.info), Device::Cpu);

  const std::string text =
      message_of([&] { (void)estimator.run(tiny(), {}, {.device = Device::Cuda}, Progress()); });
  QCOMPARE(text,
           can ? "there is no GPU to use: " + cuda_device().why_not + "; use --device cpu or auto"
               : estimator.info.name + " runs on the CPU only; use --device cpu or auto");
}

void EstimatorTest::method_runsAndFillsProvenance() {
  const Estimator estimator = fetched();
  const auto start = Clock::now();
  const Estimate estimate = estimator.run(tiny(), {}, widest(estimator), Progress());
  const double elapsed = std::chrono::duration<double>(Clock::now() - start).count();
  QCOMPARE(estimate.method, estimator.info.id);
  QCOMPARE(estimate.version, std::string(kVersion));
  QCOMPARE(estimate.source, tiny().info().source);
  QVERIFY(estimate.seconds > 0 && estimate.seconds <= elapsed);
  QVERIFY(estimate.range.min < -0.4 && estimate.range.max > 0.7);
  QCOMPARE(estimate.parameters.size(), estimator.parameters.size());
  for (std::size_t i = 0; i < estimate.parameters.size(); ++i) {
    QCOMPARE(estimate.parameters[i].first, estimator.parameters[i].key);
    QVERIFY(estimate.parameters[i].second == estimator.parameters[i].default_value);
  }
  const ViewStack<float>& map = estimate.field.disparity;
  QVERIFY(estimator.info.all_views ? map.grid() == tiny().grid() : map.grid().count() == 1);
  QVERIFY(map.height() == tiny().height() && map.width() == tiny().width());
  QVERIFY(all_finite(map));
  if (!estimate.confidence.empty()) {
    QCOMPARE(estimate.confidence.size(), map.size());
    QVERIFY(all_finite(estimate.confidence));
  }
}

void EstimatorTest::givenParameters_areUsedAndRecorded() {
  const Estimator estimator = fetched();
  const Interval wanted{-0.7, 1.1};
  const Estimate estimate =
      estimator.run(tiny(), {{"range", IntervalOrAuto(wanted)}}, kCenter, Progress());
  QCOMPARE(estimate.range, wanted);
  const auto given = std::find_if(estimate.parameters.begin(), estimate.parameters.end(),
                                  [](const auto& entry) { return entry.first == "range"; });
  QVERIFY(given != estimate.parameters.end());
  QVERIFY(given->second == ParameterValue(IntervalOrAuto(wanted)));
}

void EstimatorTest::badParameters_areRefused() {
  const Estimator estimator = fetched();
  const std::vector<ParameterSet> bad = {
      {{"rnage", IntervalOrAuto{}}},
      {{"range", 1.0}},
      {{"range", IntervalOrAuto(Interval{2, 1})}},
      {{"range", IntervalOrAuto(Interval{-1e6, 1})}},
      {{"inner_scale", -1.0}},
      {{"inner_scale", std::numeric_limits<double>::quiet_NaN()}},
      {{"outer_scale", std::string("wide")}},
  };
  for (const ParameterSet& values : bad) {
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             (void)estimator.run(tiny(), values, kCenter, Progress()));
  }
  const std::string text =
      message_of([&] { (void)estimator.run(tiny(), bad.front(), kCenter, Progress()); });
  QVERIFY2(mentions(text, "did you mean 'range'"), text.c_str());
}

void EstimatorTest::everyParameterAtItsEnds_runs_data() {
  QTest::addColumn<QString>("id");
  QTest::addColumn<QString>("key");
  QTest::addColumn<bool>("largest");
  for (const Estimator& estimator : registered_estimators()) {
    for (const ParameterDescription& parameter : estimator.parameters) {
      const bool is_text = std::holds_alternative<std::string>(parameter.default_value);
      if (is_text && parameter.choices.empty()) continue;  // has no ends
      for (const bool largest : {false, true}) {
        QTest::addRow("%s %s %s", estimator.info.id.c_str(), parameter.key.c_str(),
                      largest ? "max" : "min")
            << QString::fromStdString(estimator.info.id) << QString::fromStdString(parameter.key)
            << largest;
      }
    }
  }
}

// A slider may be drawn to either end.
void EstimatorTest::everyParameterAtItsEnds_runs() {
  QFETCH(QString, key);
  QFETCH(bool, largest);
  const Estimator estimator = fetched();
  const auto parameter =
      std::find_if(estimator.parameters.begin(), estimator.parameters.end(),
                   [&](const ParameterDescription& one) { return one.key == key.toStdString(); });
  QVERIFY(parameter != estimator.parameters.end());
  const double end = largest ? parameter->max : parameter->min;
  ParameterSet values{{"range", IntervalOrAuto(Interval{-1, 1})}};
  const ParameterValue& sample = parameter->default_value;
  ParameterValue value = sample;
  if (std::holds_alternative<double>(sample)) value = end;
  if (std::holds_alternative<int>(sample)) value = static_cast<int>(end);
  if (std::holds_alternative<bool>(sample)) value = largest;
  if (std::holds_alternative<std::string>(sample)) {
    value = largest ? parameter->choices.back() : parameter->choices.front();
  }
  if (std::holds_alternative<ViewOrAuto>(sample)) {
    value = ViewOrAuto(largest ? ViewIndex{4, 4} : ViewIndex{0, 0});
  }
  if (std::holds_alternative<IntervalOrAuto>(sample)) {
    // The widest interval that begins or ends there.
    value = IntervalOrAuto(largest ? Interval{0, end} : Interval{end, 0});
    values.clear();
  }
  values.emplace_back(parameter->key, value);
  const Estimate estimate = estimator.run(tiny(), values, kCenter, Progress());
  QVERIFY(all_finite(estimate.field.disparity));
}

void EstimatorTest::singleView_isRefused() {
  const Estimator estimator = fetched();
  const LightField lf = make_light_field({1, 1}, 20, 20, 3, [](ViewIndex, int y, int x, int) {
    return 0.1F * static_cast<float>((x + y) % 10);
  });
  const std::string text = message_of([&] { (void)estimator.run(lf, {}, kCenter, Progress()); });
  QVERIFY2(mentions(text, "view"), text.c_str());
}

void EstimatorTest::progress_risesToOne_data() {
  QTest::addColumn<QString>("id");
  QTest::addColumn<int>("rows");
  QTest::addColumn<int>("columns");
  for (const Estimator& estimator : registered_estimators()) {
    const QString id = QString::fromStdString(estimator.info.id);
    QTest::addRow("%s 5x5", estimator.info.id.c_str()) << id << 5 << 5;
    QTest::addRow("%s 1x5", estimator.info.id.c_str()) << id << 1 << 5;
    QTest::addRow("%s 5x1", estimator.info.id.c_str()) << id << 5 << 1;
  }
}

void EstimatorTest::progress_risesToOne() {
  QFETCH(int, rows);
  QFETCH(int, columns);
  const Estimator estimator = fetched();
  const Scene scene = render("edge", 136, 144, {rows, columns});
  std::vector<double> fractions;
  std::set<std::string> steps;
  const Progress progress({}, [&](const ProgressState& state) {
    fractions.push_back(state.fraction);
    steps.insert(state.step);
  });
  (void)estimator.run(*scene.light_field, {}, widest(estimator), progress);
  QVERIFY(fractions.size() > 5);
  QVERIFY(std::is_sorted(fractions.begin(), fractions.end()));
  QCOMPARE(fractions.back(), 1.0);
  // A bar that stands still and jumps is uninformative.
  double gap = 0;
  for (std::size_t i = 1; i < fractions.size(); ++i) {
    gap = std::max(gap, fractions[i] - fractions[i - 1]);
  }
  QVERIFY2(gap < 0.25, qPrintable(QString::number(gap)));
  QVERIFY(steps.size() >= 2);
}

void EstimatorTest::unevenViews_takeTheirShareOfTheProgress() {
  const Scene scene = render("edge", 96, 96, {5, 5});
  const LightField uneven = like(*scene.light_field, [&](ViewIndex view, int y, int x, int c) {
    return (0.6F + 0.08F * static_cast<float>(view.u)) *
           static_cast<float>(scene.light_field->view<std::uint8_t>(view).at(y, x, c)) / 255;
  });
  double at_first_epis = -1;
  const Progress progress({}, [&](const ProgressState& state) {
    if (state.step == "horizontal EPIs" && at_first_epis < 0) at_first_epis = state.fraction;
  });

  EvenViews even;
  const Estimate estimate =
      find_estimator("epi_l").run(uneven, even, {}, {.views = ViewSelection::All}, progress);

  QVERIFY(std::ranges::any_of(estimate.notes, [](const std::string& note) {
    return note.find("evened out") != note.npos;
  }));
  QVERIFY2(at_first_epis >= 0 && at_first_epis < 0.3, qPrintable(QString::number(at_first_epis)));
}

// How late a stop is by the clock is measured by tests/bench/cancel_bench.
void EstimatorTest::stop_endsWithinLimit() {
  const Estimator estimator = fetched();
  static const Scene scene = render("edge", 160, 176, {7, 7});
  for (const double stop_at : {0.02, 0.5, 0.9}) {
    std::stop_source source;
    double stopped = 0;
    const Progress progress(source.get_token(), [&](const ProgressState& state) {
      if (state.fraction < stop_at || source.stop_requested()) return;
      stopped = cpu_time_ms();
      source.request_stop();
    });
    QVERIFY_THROWS_EXCEPTION(
        Cancelled, (void)estimator.run(*scene.light_field, {}, widest(estimator), progress));
    const double late = cpu_time_ms() - stopped;
    QVERIFY2(late < cpu_limit_of_a_stop_ms(),
             qPrintable(QString("%1 ms at %2").arg(late).arg(stop_at)));
  }
}

void EstimatorTest::stopBeforeStart_throwsCancelled() {
  const Estimator estimator = fetched();
  std::stop_source source;
  source.request_stop();
  const Progress progress(source.get_token(), nullptr);
  const ParameterSet given{{"range", IntervalOrAuto(Interval{-1, 1})}};
  QVERIFY_THROWS_EXCEPTION(Cancelled, (void)estimator.run(tiny(), given, kCenter, progress));
}

}  // namespace episcope::in_estimator_test

EPISCOPE_TEST(estimator_test, EstimatorTest)
#include "estimator_test.moc"
