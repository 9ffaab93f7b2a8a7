// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/benchmark.h"
#include "app/benchmark/report.h"
#include "tests/app/session/tiny_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <filesystem>

namespace episcope::in_label_benchmark_test {

namespace {

namespace fs = std::filesystem;

LabelerParameters way(Regularizer regularizer) {
  LabelerParameters parameters;
  parameters.features = FeatureSet::Image;
  parameters.regularizer = regularizer;
  parameters.trees = 8;
  return parameters;
}

}  // namespace

class LabelBenchmarkTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    folder_ = std::make_unique<QTemporaryDir>();
    edited_.clear();
    options_ = {};
    options_.inputs = {"objects"};
    options_.labels = {way(Regularizer::View)};
    options_.folder = fs::path(folder_->path().toStdString()) / "out";
  }

  void labels_areFoundAgainUntilSomethingChanges_data() {
    QTest::addColumn<QString>("change");
    QTest::addColumn<int>("reused");
    QTest::newRow("nothing") << "" << 1;
    for (const char* change : {"strokes", "true labels", "true rays", "parameter", "picture"}) {
      QTest::newRow(change) << change << 0;
    }
  }
  void labels_areFoundAgainUntilSomethingChanges() {
    QFETCH(QString, change);
    QFETCH(int, reused);
    const BenchmarkReport first = run();

    edited_ = change;
    if (change == "parameter") options_.labels[0].smoothness = 3;
    if (change == "picture") fs::remove(options_.folder / "scenes/objects/image-view-wrong.png");
    const BenchmarkReport second = run();

    QCOMPARE(second.reused, reused);
    QVERIFY(*find_metric(first.results[0].labels, "accuracy_all_views") > 0.9);
    QVERIFY(*find_metric(first.results[0].labels, "iou_label_1") > 0.8);
    if (reused == 1) QCOMPARE(second.results[0].labels, first.results[0].labels);
  }

  void ways_areRanked() {
    options_.labels.push_back(way(Regularizer::None));

    const std::vector<TitledTable> tables = report_tables(run());

    QVERIFY(tables[0].title.starts_with("Labels ranked"));
    QCOMPARE(tables[0].table.rows[0][0], std::string("image-view"));
    QCOMPARE(tables[0].table.rows[1][0], std::string("image-none"));
    QVERIFY(tables.back().title.starts_with("objects: "));
  }

  void page_showsWhatIsWrong() {
    const BenchmarkReport report = run();

    const std::string page = html_page(report, report_tables(report));
    for (const char* part : {"<title>Label benchmark", "objects/image-view-wrong.png",
                             "objects/labels.png", "label 1", "Boundary accuracy"}) {
      QVERIFY2(page.find(part) != std::string::npos, part);
    }
    QVERIFY(page.find("MSE") == std::string::npos);
  }

  void sceneWithoutStrokes_doesNotStopTheOthers() {
    options_.inputs = {"edge", "objects"};
    edited_ = "no strokes of the first";

    const BenchmarkReport report = run();

    QCOMPARE(report.failures().size(), std::size_t{1});
    QVERIFY(report.failures()[0].find("no strokes") != std::string::npos);
    QVERIFY(!report.results[1].labels.empty());
  }

 private:
  BenchmarkReport run() {
    const SceneLoader load = [this](const std::string& input, const Progress&) {
      Scene scene = *tiny_scene(input);
      auto samples = std::get<ViewStack<std::uint8_t>>(scene.light_field->samples()).clone();
      LightFieldInfo info = scene.light_field->info();
      info.name = input;
      scene.light_field = std::make_shared<const LightField>(std::move(samples), std::move(info));
      if (edited_ == "strokes") scene.scribbles.views[0].labels.at(0, 0) = 1;
      if (edited_.startsWith("no strokes") && input == "edge") scene.scribbles = {};
      if (edited_.startsWith("true")) scene.truth = edited_truth(*scene.truth);
      return scene;
    };
    return run_benchmark(options_, load, Progress());
  }

  // Outside the center view, which the fingerprint of disparities knows.
  [[nodiscard]] GroundTruthPtr edited_truth(const GroundTruth& truth) const {
    auto other = std::make_shared<GroundTruth>();
    other->field.disparity = truth.field.disparity.clone();
    other->labels = truth.labels.clone();
    if (edited_ == "true labels") other->labels.data()[0] = 2;
    if (edited_ == "true rays") other->field.disparity.data()[0] += 1;
    return other;
  }

  std::unique_ptr<QTemporaryDir> folder_;
  BenchmarkOptions options_;
  QString edited_;
};

}  // namespace episcope::in_label_benchmark_test

EPISCOPE_TEST(label_benchmark_test, LabelBenchmarkTest)
#include "label_benchmark_test.moc"
