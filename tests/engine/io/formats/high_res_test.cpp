// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/core/shear.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/base/image_file.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/open.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <algorithm>
#include <fstream>

namespace episcope::in_high_res_test {

using namespace episcope::test;

namespace fs = std::filesystem;

/// A folder of the benchmark whose views have 20×12 px.
class HighResTest : public QObject {
  Q_OBJECT
 private slots:
  void init() {
    folder_ = std::make_unique<QTemporaryDir>();
    io::write_benchmark_folder(path(), plane_scene({.grid = {3, 3}, .height = 12, .width = 20}),
                               Progress(1));
  }

  void highResolution_isFoundAndReadWhenAsked() {
    write_truth(120, 200);
    Image<std::uint8_t> boxes(120, 200);
    boxes.at(119, 7) = 6;
    io::write_png(path("mask_boxes_highres.png"), boxes.view());

    const Scene scene = open();

    const HighResTruthPtr truth = scene.truth->high_res;
    QVERIFY(truth != nullptr);
    QCOMPARE(truth->regions(), std::vector<std::string>{"boxes"});
    QCOMPARE(truth->read_disparity().at(3, 199), 0.25F);
    QCOMPARE(int{truth->read_region("boxes").at(119, 7)}, 6);
    QVERIFY(scene.truth->regions.empty());
    QVERIFY(std::ranges::none_of(scene.convention.files, [](const FileUse& use) {
      return !use.is_used && use.example.find("highres") != std::string::npos;
    }));
  }

  void withoutDisparity_thereIsNoHighResolution() {
    io::write_png(path("mask_boxes_highres.png"), Image<std::uint8_t>(120, 200).view());

    QVERIFY(open().truth->high_res == nullptr);
  }

  void damagedFiles_areRefusedWhenTheyAreAskedFor_data() {
    QTest::addColumn<QString>("file");
    QTest::addColumn<QString>("sentence");
    QTest::newRow("smaller") << "small"
                             << "10 times the size of the views is 200×120";
    QTest::newRow("truncated") << "truncated"
                               << "truncated";
    QTest::newRow("no PFM") << "text"
                            << "not a PFM";
    QTest::newRow("mask of another size") << "mask"
                                          << "200×120";
    QTest::newRow("damaged mask") << "no mask"
                                  << "mask_fine_highres.png";
  }
  void damagedFiles_areRefusedWhenTheyAreAskedFor() {
    QFETCH(QString, file);
    QFETCH(QString, sentence);
    write_truth(120, 200);
    const fs::path map = path("gt_disp_highres.pfm"), mask = path("mask_fine_highres.png");
    io::write_png(mask, Image<std::uint8_t>(119, 200).view());
    if (file == "small") write_truth(120, 199);
    if (file == "truncated") fs::resize_file(map, fs::file_size(map) - 1);
    if (file == "text") std::ofstream(map) << "no map";
    if (file == "no mask") fs::resize_file(mask, fs::file_size(mask) / 2);

    const Scene scene = open();

    try {
      if (file.contains("mask")) (void)scene.truth->high_res->read_region("fine");
      if (!file.contains("mask")) (void)scene.truth->high_res->read_disparity();
      QFAIL("nothing was refused");
    } catch (const IoError& error) {
      QVERIFY2(QString(error.what()).contains(sentence), error.what());
    }
  }

  // A map beyond what is granted is not even opened.
  void memory_isLimited() {
    Scene scene = plane_scene({.grid = {1, 1}, .height = 1200, .width = 1200});
    io::write_benchmark_folder(path("large"), scene, Progress(1));
    std::ofstream(path("large/gt_disp_highres.pfm")) << "Pf\n12000 12000\n-1\n";

    scene = io::open_scene(path("large"), {.grid = "1x1"}, Progress(1));

    try {
      (void)scene.truth->high_res->read_disparity();
      QFAIL("nothing was refused");
    } catch (const IoError& error) {
      QVERIFY2(QString(error.what()).contains("549 MiB"), error.what());
    }
  }

  void focusPlane_movesTheDisparity() {
    write_truth(120, 200);

    const Scene moved = sheared(open(), 0.5, Progress(1));

    QCOMPARE(moved.truth->high_res->read_disparity().at(3, 199), -0.25F);
    QVERIFY(moved.truth->high_res->identity() != open().truth->high_res->identity());
  }

  void sceneOfTheBenchmark_isNamedByItsParameters() {
    QCOMPARE(int(open().truth->stratified), int(StratifiedScene::None));
    std::ofstream(path("parameters.cfg"), std::ios::app) << "\n[more]\nscene = stripes\n";

    QCOMPARE(int(open().truth->stratified), int(StratifiedScene::Stripes));
  }

  void numberedMasks_keepTheirNumbers() {
    Image<std::uint8_t> numbers(12, 20);
    numbers.at(2, 3) = 200;
    io::write_png(path("mask_dots_by_size_lowres.png"), numbers.view());
    io::write_png(path("mask_planes_lowres.png"), numbers.view());

    const Scene scene = open();
    io::write_benchmark_folder(path("again"), scene, Progress(1));
    const Scene again = io::open_scene(path("again"), {}, Progress(1));

    QCOMPARE(int(scene.truth->regions.at("dots_by_size").at(2, 3)), 200);
    QCOMPARE(int(scene.truth->regions.at("planes").at(2, 3)), 1);
    QCOMPARE(int(again.truth->regions.at("dots_by_size").at(2, 3)), 200);
  }

 private:
  [[nodiscard]] fs::path path(const char* name = "") const {
    return fs::path(folder_->path().toStdString()) / "scene" / name;
  }
  [[nodiscard]] Scene open() const { return io::open_scene(path(), {}, Progress(1)); }
  void write_truth(int height, int width) const {
    Image<float> map(height, width);
    map.at(3, width - 1) = 0.25F;
    io::write_pfm(path("gt_disp_highres.pfm"), map.view());
  }

  std::unique_ptr<QTemporaryDir> folder_;
};

}  // namespace episcope::in_high_res_test

EPISCOPE_TEST(high_res_test, HighResTest)
#include "high_res_test.moc"
