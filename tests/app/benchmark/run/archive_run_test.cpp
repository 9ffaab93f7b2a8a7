// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/benchmark.h"
#include "app/benchmark/report.h"
#include "engine/disparity/registry.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/open.h"
#include "tests/app/session/tiny_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

namespace episcope::in_archive_run_test {

namespace {

namespace fs = std::filesystem;

QString text_of(const fs::path& file) {
  std::ifstream stream(file);
  return QString::fromStdString({std::istreambuf_iterator<char>(stream), {}});
}

// The default alone and a second point.
Estimator with_short_search(const char* id, const char* key, const ParameterValue& other) {
  Estimator method = find_estimator(id);
  for (ParameterDescription& parameter : method.parameters) parameter.searched.clear();
  std::ranges::find(method.parameters, key, &ParameterDescription::key)->searched = {other};
  return method;
}

}  // namespace

// Benchmarks of scenes on disk, from the file to the tables.
class ArchiveRunTest : public QObject {
  Q_OBJECT

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void sceneOfThePaper_standsBesideFigure7() {
    const fs::path scene = write_scene("buddha", *tiny_scene("edge", {5, 5}));

    const BenchmarkReport report = run(scene, with_short_search("st_ch_l", "labels", 16));

    QCOMPARE(report.failures(), std::vector<std::string>());
    const double mse = *find_metric(report.results.at(0).vmv2013, "mse_100");
    const double best = std::min(*report.searched.at(0).mse_100, *report.searched.at(1).mse_100);
    const QString row = QString("buddha,st_ch_l,1.010,%1,%2,%3,%4")
                            .arg(mse, 0, 'f', 3)
                            .arg(mse / 1.01, 0, 'f', 2)
                            .arg(best, 0, 'f', 3)
                            .arg(best / 1.01, 0, 'f', 2);
    const QString tables = text_of(out() / "tables.csv");
    QVERIFY2(tables.contains(row), qPrintable(row + " is not in\n" + tables));
    QVERIFY(text_of(out() / "results.json").contains("\"figure_7\": 1.01"));
    QVERIFY(text_of(out() / "index.html").contains("figure 7 of the paper"));
  }

  // The truth reaches to 0.8 px, what the file promises to 0.4: a search that looked at the truth
  // would find more.
  void search_takesTheRangeFromTheFile() {
    const auto edge = tiny_scene("edge", {5, 5});
    LightFieldInfo info = edge->light_field->info();
    info.disparity_range = Interval{-0.6, 0.4};
    Scene promising = *edge;
    promising.light_field = std::make_shared<const LightField>(
        std::get<ViewStack<std::uint8_t>>(edge->light_field->samples()).clone(), std::move(info));
    const fs::path scene = write_scene("promising", promising);
    Interval searched{9, -9};
    Estimator method = with_short_search("st_ch_l", "labels", 16);
    method.estimate = [&searched, run = method.estimate](const auto&... arguments) {
      Estimate estimate = run(arguments...);
      searched = {std::min(searched.min, estimate.range.min),
                  std::max(searched.max, estimate.range.max)};
      return estimate;
    };

    const BenchmarkReport report = run(scene, method);

    QCOMPARE(report.searched.size(), std::size_t{2});
    QVERIFY(std::abs(searched.min + 0.6) < 1e-6 && std::abs(searched.max - 0.4) < 1e-6);
  }

 private:
  [[nodiscard]] fs::path path() const { return folder_->path().toStdString(); }
  [[nodiscard]] fs::path out() const { return path() / "out"; }

  [[nodiscard]] fs::path write_scene(const char* name, const Scene& scene) const {
    fs::create_directories(path() / name);
    io::write_archive(path() / name / "lf.h5", scene, Progress());
    return path() / name;
  }

  [[nodiscard]] BenchmarkReport run(const fs::path& scene, Estimator method) const {
    BenchmarkOptions options;
    options.inputs = {scene.string()};
    options.methods = {std::move(method)};
    options.folder = out();
    options.views = ViewSelection::Center;
    options.has_search = true;
    const SceneLoader load = [](const std::string& input, const Progress& progress) {
      return io::open_scene(input, {}, progress);
    };
    return run_benchmark(options, load, Progress());
  }

  std::unique_ptr<QTemporaryDir> folder_;
};

}  // namespace episcope::in_archive_run_test

EPISCOPE_TEST(archive_run_test, ArchiveRunTest)
#include "archive_run_test.moc"
