// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/benchmark.h"

#include "app/benchmark/report.h"
#include "app/benchmark/run_log.h"
#include "app/session/judge.h"
#include "engine/core/error.h"
#include "engine/disparity/registry.h"
#include "engine/evaluation/parameter_search.h"
#include "engine/io/models/result_file.h"
#include "tests/app/session/tiny_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <filesystem>
#include <fstream>

namespace episcope::in_benchmark_test {

namespace {

namespace fs = std::filesystem;

struct ShiftParameters {
  double shift = 0.3;
  int fails_from = 9;
};

/// Counts its runs; answers with `shift` everywhere, fails from `fails_from` tenths on.
Estimator counting_method(const char* id, int& runs, int revision = 1) {
  Schema<ShiftParameters> schema;
  schema.real("shift", &ShiftParameters::shift, {"Shift", "The answer."}, {-5, 5})
      .integer("fails_from", &ShiftParameters::fails_from, {"Fails", "From there."}, {0, 9})
      .search("shift", {-0.5, 0.3, 0.8});
  return make_estimator<ShiftParameters>(
      {.id = id,
       .name = id,
       .summary = "",
       .reference = "",
       .all_views = true,
       .revision = revision},
      schema,
      [&runs](const LightField& lf, const ShiftParameters& p, ViewSelection views,
              const Progress& progress) {
        progress.check();
        ++runs;
        if (p.shift * 10 >= p.fails_from) throw InvalidInput("too large a shift");
        Estimate estimate;
        const bool all = views == ViewSelection::All;
        estimate.field.disparity = ViewStack<float>(all ? lf.grid() : GridShape{1, 1}, lf.height(),
                                                    lf.width(), 1, all ? ViewIndex{} : lf.center());
        std::fill_n(estimate.field.disparity.data(), estimate.field.disparity.size(),
                    static_cast<float>(p.shift));
        return estimate;
      });
}

}  // namespace

class BenchmarkTest : public QObject {
  Q_OBJECT
 private slots:
  void init() {
    folder_ = std::make_unique<QTemporaryDir>();
    runs_ = 0;
    options_ = {};
    options_.inputs = {"edge"};
    options_.methods = {counting_method("counting", runs_)};
    options_.folder = fs::path(folder_->path().toStdString()) / "out";
  }

  void finishedRuns_areNotRunAgain() {
    options_.has_search = true;
    const BenchmarkReport first = run();
    const BenchmarkReport second = run();

    QCOMPARE(runs_, 4);  // the default for the tables, three points of the search
    QCOMPARE(second.reused, 4);
    QCOMPARE(second.results[0].vmv2013, first.results[0].vmv2013);
    QCOMPARE(*second.searched[2].mse_100, *first.searched[2].mse_100);
    QVERIFY(first.results[0].has_all_views);
  }

  void anyChange_isRunAgain_data() {
    QTest::addColumn<QString>("change");
    for (const char* change : {"samples", "truth", "camera", "range", "region", "revision",
                               "default", "views", "map", "method"}) {
      QTest::newRow(change) << change;
    }
  }
  void anyChange_isRunAgain() {
    QFETCH(QString, change);
    run();

    if (change == "samples") scene_ = "slant";
    edited_ = change;
    if (change == "revision") options_.methods = {counting_method("counting", runs_, 2)};
    if (change == "default") options_.methods[0].parameters[0].default_value = 0.4;
    if (change == "views") options_.views = ViewSelection::Center;
    if (change == "map") fs::remove(options_.folder / "scenes/edge/counting.h5");
    if (change == "method") options_.methods = {counting_method("other", runs_)};
    run();
    scene_ = "edge";
    edited_.clear();

    QCOMPARE(runs_, 2);
  }

  void changeAndBack_doesNotTrustFilesOfTheOther() {
    run();
    scene_ = "slant";
    run();
    scene_ = "edge";

    // The second scene of this name has written over the files of the first.
    QCOMPARE(run().reused, 0);
  }

  void failures_areToldAndTriedAgain() {
    options_.has_search = true;
    options_.methods[0].parameters[1].default_value = 5;  // 0.8 is too much

    const BenchmarkReport first = run();
    run();

    QCOMPARE(first.failures().size(), std::size_t{1});
    QVERIFY(QString::fromStdString(first.failures()[0]).contains("too large a shift"));
    QVERIFY(!first.searched[2].mse_100);
    QCOMPARE(runs_, 5);
  }

  void twoLayers_areJudgedWithTheOthersAndByThemselves() {
    scene_ = "transparent";
    options_.methods = {find_estimator("epi_l"), find_estimator("epi_two_layer")};
    const BenchmarkReport report = run();
    scene_ = "edge";

    // No gap: where one surface is seen, both are judged by the same pixels.
    const auto tables = report_tables(report);
    const auto row = [&tables](const char* title, const char* line) {
      for (const TitledTable& titled : tables) {
        if (titled.title.find(title) == std::string::npos) continue;
        for (const auto& cells : titled.table.rows) {
          if (cells[0] == line) return cells;
        }
      }
      return std::vector<std::string>();
    };
    QCOMPARE(row("as in figure 7", "average").size(), std::size_t{3});
    QVERIFY(!row("as in figure 7", "average")[1].starts_with("–"));
    for (const char* layer : {"foreground", "background"}) {
      QCOMPARE(row(layer, "edge").size(), std::size_t{2});
      QVERIFY(row(layer, "edge")[1] != "–");
      QVERIFY(html_page(report, {}).find(std::string(layer) + " MSE×100") != std::string::npos);
    }
  }

  void sceneThatCannotBeRead_doesNotStopTheOthers() {
    options_.inputs = {"missing", "edge"};

    const BenchmarkReport report = run();

    QCOMPARE(report.scenes.size(), std::size_t{2});
    QVERIFY(!report.scenes[0].problem.empty());
    QCOMPARE(report.results.size(), std::size_t{1});
  }

  void equalNames_getFoldersOfTheirOwn() {
    options_.inputs = {"edge", "edge"};

    const BenchmarkReport report = run();

    QCOMPARE(report.scenes[1].name, std::string("edge-2"));
    QVERIFY(fs::exists(options_.folder / "scenes/edge-2/counting-error.png"));
  }

  void submissionOfOtherSamples_isNoted() {
    const fs::path theirs = fs::path(folder_->path().toStdString()) / "theirs";
    fs::create_directories(theirs);
    options_.submissions = {theirs};
    const auto scene = tiny_scene();
    for (const bool same : {true, false}) {
      const EstimatePtr map = shifted_truth(*scene, 0.1F);
      auto estimate = std::make_shared<Estimate>();
      estimate->field.disparity = map->field.disparity.clone();
      estimate->method = "theirs";
      estimate->source_hash = same ? scene->light_field->sample_hash() : 1;
      io::write_result(theirs / "edge.h5", *estimate, Progress());

      const BenchmarkReport report = run();

      QCOMPARE(report.results.size(), std::size_t{2});
      QVERIFY(std::abs(*find_metric(report.results[1].vmv2013, "mse_100") - 1) < 1e-3);
      QCOMPARE(report.results[1].notes.empty(), same);
    }
  }

  void foldersOfOtherThings_areRefused() {
    fs::create_directories(options_.folder);
    std::ofstream(options_.folder / "thesis.tex") << "years of work";

    QVERIFY_THROWS_EXCEPTION(IoError, run());
    QCOMPARE(runs_, 0);
  }

  void log_passesOverWhatItDoesNotKnow() {
    run();
    std::ofstream(options_.folder / RunLog::kFileName, std::ios::app)
        << "no JSON\n{\"key\": 3}\n[]\n{\"key\":\"0\",\"kind\":\"run\"}\n";

    QCOMPARE(run().reused, 1);
    QCOMPARE(RunLog(options_.folder).all().size(), std::size_t{1});
  }

  void records_surviveJson() {
    run();
    const RunLog log(options_.folder);
    const BenchmarkRecord& record = log.all().at(0);

    const auto copy = record_from_json(record_to_json(record));

    QVERIFY(copy && copy->key == record.key && copy->files == record.files);
    QVERIFY(copy->run.parameters == record.run.parameters);
    QVERIFY(copy->result.benchmark2016 == record.result.benchmark2016);
  }

  void page_escapesNames() {
    BenchmarkReport report;
    report.scenes.push_back({"<a&b> ü", "in", "1×1", {}, true, {}});
    const std::string page = html_page(report, {});

    QVERIFY(page.find("<h2>&lt;a&amp;b&gt; ü</h2>") != std::string::npos);
    QVERIFY(page.find("src=\"scenes/%3Ca%26b%3E%20%C3%BC/view.png\"") != std::string::npos);
    QVERIFY(page.find("http") == std::string::npos);  // nothing from elsewhere
  }

  void workload_endsWhereItShould() {
    std::vector<double> seen;
    const Progress progress(std::stop_token{},
                            [&](const ProgressState& state) { seen.push_back(state.fraction); });
    Workload workload(progress);
    for (const double seconds : {1.0, 6.0, 3.0}) workload.expect(seconds);

    workload.next("first").report(1);
    workload.skip(1);
    workload.next("last").report(1);

    QCOMPARE(seen.size(), std::size_t{3});
    QCOMPARE(seen[0], 0.1);
    QCOMPARE(seen[1], 0.7);
    QCOMPARE(seen[2], 1.0);
  }

  void workload_ofNothingKnownIsDividedEvenly() {
    double seen = -1;
    const Progress progress(std::stop_token{},
                            [&](const ProgressState& state) { seen = state.fraction; });
    Workload workload(progress);
    for (int i = 0; i < 2; ++i) workload.expect(0);

    workload.next("first").report(1);

    QCOMPARE(seen, 0.5);
  }

  void submissionsOfOneName_areToldApart() {
    for (const char* folder : {"a/theirs", "b/theirs", "c/counting"}) {
      const fs::path path = fs::path(folder_->path().toStdString()) / folder;
      fs::create_directories(path);
      options_.submissions.push_back(path);
    }

    const BenchmarkReport report = run();

    std::vector<std::string> entries;
    for (const auto& result : report.results) entries.push_back(result.entry);
    QCOMPARE(entries, (std::vector<std::string>{"counting", "theirs", "theirs-2", "counting-2"}));
  }

  // All of it is the border that the protocol of 2016 ignores: that is no problem of the scene.
  void viewsOfTwoBorders_areJudgedByOneProtocol() {
    size_ = 2 * kBenchmarkBorder;
    const BenchmarkReport report = run();
    size_ = 0;

    QVERIFY(report.results[0].problem.empty());
    QVERIFY(!report.results[0].vmv2013.empty() && report.results[0].benchmark2016.empty());
  }

  void everyMethod_searchesAtMostSixtyPoints() {
    for (const Estimator& method : registered_estimators()) {
      QVERIFY2(search_grid(method.parameters).size() <= kMaxSearchPoints, method.info.id.c_str());
    }
  }

 private:
  BenchmarkReport run() {
    const SceneLoader load = [this](const std::string& input, const Progress&) {
      if (input == "missing") throw IoError(input, "is not there");
      Scene scene = size_ == 0 ? *tiny_scene(scene_) : small_scene();
      LightFieldInfo info = scene.light_field->info();
      info.name = input;
      if (edited_ == "camera") info.camera.baseline += 1;
      if (edited_ == "range") info.disparity_range = Interval{-2, 2};
      auto samples = std::get<ViewStack<std::uint8_t>>(scene.light_field->samples()).clone();
      scene.light_field = std::make_shared<const LightField>(std::move(samples), std::move(info));
      if (edited_ == "truth" || edited_ == "region") {
        auto truth = std::make_shared<GroundTruth>();
        truth->field.disparity = scene.truth->field.disparity.clone();
        truth->field.valid = scene.truth->field.valid.clone();
        truth->regions = scene.truth->regions;
        const ViewIndex center = scene.light_field->center();
        if (edited_ == "truth") truth->field.disparity.view(center).at(3, 4) += 1;
        if (edited_ == "region") truth->regions.at("planes").at(3, 4) ^= 1;
        scene.truth = truth;
      }
      return scene;
    };
    return run_benchmark(options_, load, Progress());
  }

  [[nodiscard]] Scene small_scene() const {
    scenes::RenderOptions options;
    options.grid = {3, 3};
    options.height = options.width = size_;
    return scenes::render_builtin(scene_, options, Progress());
  }

  std::unique_ptr<QTemporaryDir> folder_;
  BenchmarkOptions options_;
  std::string scene_ = "edge";
  int size_ = 0;    // of views; 0 = as in tiny_scene
  QString edited_;  // what the scene is loaded with another value of
  int runs_ = 0;
};

}  // namespace episcope::in_benchmark_test

EPISCOPE_TEST(benchmark_test, BenchmarkTest)
#include "benchmark_test.moc"
