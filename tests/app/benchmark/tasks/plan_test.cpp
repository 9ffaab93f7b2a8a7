// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/plan.h"

#include "app/benchmark/run_log.h"
#include "engine/core/error.h"
#include "engine/disparity/registry.h"
#include "tests/app/session/tiny_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <filesystem>
#include <fstream>
#include <numeric>
#include <set>
#include <sstream>

namespace episcope::in_plan_test {

namespace {

namespace fs = std::filesystem;

using Numbers = std::vector<std::size_t>;

BenchmarkRun run_of(const char* method) {
  BenchmarkRun run;
  run.method = method;
  return run;
}

}  // namespace

class PlanTest : public QObject {
  Q_OBJECT
 private slots:
  void init() {
    folder_ = std::make_unique<QTemporaryDir>();
    options_ = {};
    options_.inputs = {"edge", "slant"};
    options_.methods = {find_estimator("st_ch_l"), find_estimator("epi_l")};
    options_.folder = fs::path(folder_->path().toStdString()) / "out";
    options_.views = ViewSelection::Center;
    other_ = nullptr;
  }

  void bundles_reachTheLeastSeconds() {
    QCOMPARE(bundle_starts({}, 5), Numbers());
    QCOMPARE(bundle_starts({1, 1, 1, 1, 1}, 2), (Numbers{0, 2, 4}));
    QCOMPARE(bundle_starts({9, 1, 1, 9}, 2), (Numbers{0, 1, 3}));
    QCOMPARE(bundle_starts({1, 1, 1}, 0), (Numbers{0, 1, 2}));
    QCOMPARE(bundle_starts({1, 1, 1}, 99), Numbers{0});
  }

  void costs_growWithPixelsAndDifferByMethod() {
    const auto seconds = [](const char* method, std::size_t pixels) {
      return estimated_seconds(run_of(method), {81, pixels});
    };

    QVERIFY(seconds("epi_l", 512 * 512) > 3.5 * seconds("epi_l", 256 * 256));
    QVERIFY(seconds("plane_pm", 512 * 512) > 10 * seconds("st_ch_l", 512 * 512));
    QVERIFY(seconds("not known", 512 * 512) > 1);
  }

  void everyRun_isInOneTask() {
    options_.has_search = true;
    const BenchmarkPlan plan = made(0.05);

    std::set<std::pair<std::size_t, std::size_t>> all;
    for (const PlanTask& task : plan.tasks) {
      for (const PlanPoint& point : task.points) all.insert({point.scene, point.run});
    }
    QVERIFY(plan.tasks.size() > 2);
    QCOMPARE(all.size(), plan.point_count());
    const BenchmarkReport report = run_benchmark(options_, load(), Progress());
    QCOMPARE(all.size(), report.results.size() + report.searched.size());
  }

  void longTasks_beginFirst() {
    options_.methods = {find_estimator("st_ch_l"), find_estimator("plane_pm")};
    const BenchmarkPlan plan = made(0);

    QCOMPARE(plan.tasks.size(), std::size_t{4});
    QVERIFY(std::ranges::is_sorted(plan.tasks, std::greater(), &PlanTask::seconds));
    QCOMPARE(plan.tasks[0].points[0].run, std::size_t{1});
  }

  void plans_areTheSameEachTime() {
    const BenchmarkPlan first = made(0);
    const BenchmarkPlan second = made(0);

    QCOMPARE(plan_to_json(first, options_), plan_to_json(second, options_));
    install_plan(first, options_);
    QCOMPARE(plan_to_json(read_plan(options_.folder), options_), plan_to_json(first, options_));
  }

  void requests_differByAllThatIsAskedFor() {
    const auto request = [this] { return request_fingerprint(options_, "{}"); };
    std::set<std::string> seen{request(), request_fingerprint(options_, R"({"flip":"u"})")};

    options_.has_search = true;
    seen.insert(request());
    options_.methods[0].parameters[0].default_value = 0.4;
    seen.insert(request());
    options_.inputs.pop_back();
    seen.insert(request());
    options_.submissions = {"theirs"};
    seen.insert(request());

    QCOMPARE(seen.size(), std::size_t{6});
  }

  void otherPlan_takesWhatWasFinishedIntoTheLog() {
    const BenchmarkPlan plan = installed(0);
    QCOMPARE(run_task(plan, 0, options_, load(), Progress()).computed, std::size_t{1});

    const BenchmarkPlan other = installed(1000);

    QCOMPARE(RunLog(options_.folder).all().size(), std::size_t{1});
    QCOMPARE(plan_status(other, options_.folder).points.done, std::size_t{1});
    QCOMPARE(run_task(other, 0, options_, load(), Progress()).computed, std::size_t{3});
  }

  void samePlan_staysWhileATaskRuns_anotherIsRefused() {
    const BenchmarkPlan plan = installed(0);
    const RunLog running(options_.folder, task_log(options_.folder, 0));

    install_plan(plan, options_);

    QVERIFY_THROWS_EXCEPTION(IoError, installed(1000));
    QCOMPARE(read_plan(options_.folder).tasks.size(), plan.tasks.size());
    QCOMPARE(plan_status(plan, options_.folder).running, Numbers{0});
    QVERIFY_THROWS_EXCEPTION(IoError, (void)run_task(plan, 0, options_, load(), Progress()));
  }

  void failedRuns_areTriedAgain_andThenCollected() {
    options_.inputs = {"edge"};
    bool fails = true;
    options_.methods[0].estimate =
        [&fails, estimate = options_.methods[0].estimate](const auto&... arguments) {
          if (fails) throw InvalidInput("out of order");
          return estimate(arguments...);
        };
    const BenchmarkPlan plan = installed(1000);

    const TaskReport first = run_task(plan, 0, options_, load(), Progress());
    const PlanStatus after = plan_status(plan, options_.folder);
    const BenchmarkReport early = collect_plan(plan, options_, load(), Progress());
    fails = false;
    const TaskReport second = run_task(plan, 0, options_, load(), Progress());
    const BenchmarkReport late = collect_plan(plan, options_, load(), Progress());

    QCOMPARE(first.failures, std::vector<std::string>{"st_ch_l on edge: out of order"});
    QCOMPARE(after.points.failed, std::size_t{1});
    QCOMPARE(after.tasks.failed, std::size_t{1});
    QCOMPARE(early.failures(), first.failures);
    QCOMPARE(second.computed, std::size_t{1});
    QCOMPARE(late.failures(), std::vector<std::string>());
    QCOMPARE(late.reused, 2);
  }

  void changedScenes_areRefused() {
    const BenchmarkPlan plan = installed(1000);
    other_ = "bars";

    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)run_task(plan, 0, options_, load(), Progress()));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)collect_plan(plan, options_, load(), Progress()));
    QCOMPARE(plan_status(plan, options_.folder).points.done, std::size_t{0});
  }

  void scenesElsewhere_areRefused() {
    (void)installed(1000);
    const fs::path file = options_.folder / BenchmarkPlan::kFileName;
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    for (const char* name : {"../../elsewhere", "/elsewhere", "..", ""}) {
      std::string changed = text.str();
      const std::string old = "\"name\": \"edge\"";
      const auto at = changed.find(old);
      QVERIFY(at != std::string::npos);
      changed.replace(at, old.size(), std::string("\"name\": \"") + name + '"');
      std::ofstream(file) << changed;

      QVERIFY_THROWS_EXCEPTION(IoError, (void)read_plan(options_.folder));
    }
    std::ofstream(file) << text.str();
    QCOMPARE(read_plan(options_.folder).scenes[0].name, std::string("edge"));
  }

  void collecting_computesNothing() {
    const BenchmarkPlan plan = installed(1000);
    for (Estimator& method : options_.methods) {
      method.estimate = [](const auto&...) -> Estimate { throw InvalidInput("was run"); };
    }

    const BenchmarkReport report = collect_plan(plan, options_, load(), Progress());

    QCOMPARE(report.failures().size(), std::size_t{4});
    QCOMPARE(report.failures()[0], std::string("st_ch_l on edge: not computed yet"));
    QCOMPARE(RunLog(options_.folder).all().size(), std::size_t{0});
  }

 private:
  [[nodiscard]] SceneLoader load() const {
    return [this](const std::string& input, const Progress&) {
      return *tiny_scene(other_ ? other_ : input.c_str(), {3, 3});
    };
  }
  [[nodiscard]] BenchmarkPlan made(double task_seconds) const {
    return make_plan(options_, load(), task_seconds, Progress());
  }
  BenchmarkPlan installed(double task_seconds) const {
    BenchmarkPlan plan = made(task_seconds);
    install_plan(plan, options_);
    return plan;
  }

  std::unique_ptr<QTemporaryDir> folder_;
  BenchmarkOptions options_;
  const char* other_ = nullptr;  ///< The scene behind every input, if it has changed.
};

}  // namespace episcope::in_plan_test

EPISCOPE_TEST(plan_test, PlanTest)
#include "plan_test.moc"
