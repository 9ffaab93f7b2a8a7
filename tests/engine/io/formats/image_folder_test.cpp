// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/base/image_file.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/models/order/view_axes.h"
#include "engine/io/open.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <cstdio>
#include <fstream>

namespace episcope::in_image_folder_test {

using namespace episcope::test;

class ImageFolderTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  std::filesystem::path path(const std::string& name = "") const {
    return std::filesystem::path(folder_->path().toStdString()) / name;
  }
  Scene open(const io::OpenOptions& options = {}) const {
    return io::open_scene(path(), options, Progress(2));
  }
  static PlaneOptions grid(int rows, int columns) {
    PlaneOptions options;
    options.grid = {rows, columns};
    options.slope_x = 0.04;
    return options;
  }
  /// Writes each view under the name that `name(row, column, index)` gives.
  template <class Name>
  void write_views(const Scene& scene, const Name& name, io::ViewFlip flip = {}) const {
    const GridShape shape = scene.light_field->grid();
    for (int i = 0; i < shape.count(); ++i) {
      const ViewIndex stored{i / shape.u, i % shape.u};
      io::write_png(path(name(stored.v, stored.u, i)),
                    scene.light_field->view<std::uint8_t>(io::flipped(stored, shape, flip)));
    }
  }
  static std::string name_in_form(const std::string& form, int row, int column, int index) {
    char text[128];
    const auto print = [&](auto... values) {
      std::snprintf(text, sizeof text, form.c_str(), values...);
    };
    if (form.starts_with("out")) {
      print(row, column, -380.5 - 8 * row, 1100.25 - 9 * column);
    } else if (form.starts_with("flat")) {
      print(index + 1);
    } else {
      print(row, column);
    }
    return text;
  }

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void greyView_amongColouredOnesIsTakenForColourless() {
    const Scene scene = plane_scene(grid(3, 3));
    write_views(scene, [](int row, int column, int) {
      return "v_" + std::to_string(row) + "_" + std::to_string(column) + ".png";
    });
    const auto view = scene.light_field->view<std::uint8_t>({0, 2});
    Image<std::uint8_t> grey(view.height, view.width);
    for (std::size_t i = 0; i < grey.size(); ++i) grey.data()[i] = view.data[3 * i + 1];
    io::write_png(path("v_0_2.png"), grey.view());

    const Scene read = open();

    const auto found = read.light_field->view<std::uint8_t>({0, 2});
    QCOMPARE(found.channels, 3);
    for (int c = 0; c < 3; ++c) QCOMPARE(found.at(7, 9, c), view.at(7, 9, 1));
  }

  void names_tellRowAndColumn_data() {
    QTest::addColumn<QString>("form");
    QTest::addColumn<int>("rows");
    QTest::addColumn<int>("columns");
    QTest::newRow("Stanford") << "out_%02d_%02d_%f_%f.png" << 3 << 4;
    QTest::newRow("Stanford, empty tokens") << "out_%02d_%02d__%lf_%lf_.png" << 3 << 3;
    QTest::newRow("RR_CC") << "%02d_%02d.png" << 3 << 5;
    QTest::newRow("R_C") << "%d_%d.png" << 5 << 3;
    QTest::newRow("prefix") << "scene7_view_%03d-%d.png" << 3 << 3;
    QTest::newRow("more than nine") << "%d_%d.png" << 1 + 2 << 12;
    QTest::newRow("flat") << "flat%d.png" << 4 << 4;
    QTest::newRow("flat, padded") << "flat_%04d.png" << 3 << 3;
  }
  void names_tellRowAndColumn() {
    QFETCH(QString, form);
    QFETCH(int, rows);
    QFETCH(int, columns);
    const Scene scene = plane_scene(grid(rows, columns));
    write_views(scene, [&](int row, int column, int index) {
      return name_in_form(form.toStdString(), row, column, index);
    });

    io::OpenOptions options;
    if (form.startsWith("flat"))
      options.grid = std::to_string(rows) + "x" + std::to_string(columns);
    const Scene read = open(options);

    QCOMPARE(read.light_field->grid(), (GridShape{rows, columns}));
    QVERIFY2(has_same_samples(scene, read), describe(read.convention).c_str());
    QVERIFY(!read.truth->has_disparity());
  }

  void oneBasedNames_areAccepted() {
    const Scene scene = plane_scene(grid(3, 3));
    write_views(scene, [](int row, int column, int) {
      return std::to_string(row + 1) + "_" + std::to_string(column + 1) + ".png";
    });

    QVERIFY(has_same_samples(scene, open()));
  }

  void reversedAxis_isFoundBySlopes_data() {
    QTest::addColumn<bool>("u");
    QTest::addColumn<bool>("v");
    QTest::newRow("u") << true << false;
    QTest::newRow("v") << false << true;
  }
  void reversedAxis_isFoundBySlopes() {
    QFETCH(bool, u);
    QFETCH(bool, v);
    const Scene scene = plane_scene(grid(5, 5));
    write_views(scene,
                [](int row, int column, int) {
                  return std::to_string(row) + "_" + std::to_string(column) + ".png";
                },
                {u, v});

    const Scene read = open();

    QVERIFY2(read.convention.reversed_u != read.convention.reversed_v,
             describe(read.convention).c_str());
    QVERIFY(QString::fromStdString(read.convention.order_check).contains("correlation -"));
  }

  void pattern_choosesTheFiles() {
    const Scene scene = plane_scene(grid(3, 4));
    write_views(scene, [](int row, int column, int) {
      return name_in_form("c%2$dr%1$d_t17.png", row, column, 0);
    });
    io::write_png(path("thumbnail.png"), Image<std::uint8_t>(4, 4).view());
    io::OpenOptions options;
    options.pattern = "c{col}r{row}_*.png";

    const Scene read = open(options);

    QVERIFY(has_same_samples(scene, read));
    QCOMPARE(read.convention.files.back().example, std::string("thumbnail.png"));
    QVERIFY(!read.convention.files.back().is_used);
    options.pattern = "view.png";
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)open(options));
  }

  void snakeOrder_turnsEverySecondRow() {
    const Scene scene = plane_scene(grid(3, 3));
    write_views(scene, [](int row, int column, int) {
      const int place = row % 2 == 0 ? column : 2 - column;
      return "shot" + std::to_string(100 + 3 * row + place) + ".png";
    });
    io::OpenOptions options;
    options.snake = true;
    options.grid = "3x3";

    QVERIFY(has_same_samples(scene, open(options)));
  }

  void sixteenBitViews_stay() {
    for (int i = 0; i < 4; ++i) {
      Image<std::uint16_t> view(5, 6, 3);
      view.at(1, 2, 0) = static_cast<std::uint16_t>(40000 + i);
      io::write_png(path(std::to_string(i / 2) + "_" + std::to_string(i % 2) + ".png"),
                    view.view());
    }

    const Scene read = open();

    QCOMPARE(read.light_field->sample_type(), SampleType::UInt16);
    QCOMPARE(read.light_field->view<std::uint16_t>({1, 1}).at(1, 2, 0), std::uint16_t{40003});
    QCOMPARE(read.light_field->view<std::uint16_t>({1, 1}).at(1, 2, 2), std::uint16_t{0});
  }

  void viewInsideAFolder_opensTheFolder() {
    const Scene scene = plane_scene(grid(3, 3));
    write_views(scene, [](int row, int column, int) {
      return std::to_string(row) + "_" + std::to_string(column) + ".png";
    });

    QVERIFY(has_same_samples(scene, io::open_scene(path("1_1.png"), {}, Progress(1))));
  }

  void benchmarkFolder_readsWhatWasWritten() {
    Scene scene = plane_scene(grid(3, 5));
    GroundTruth truth;
    truth.field.disparity = scene.truth->field.disparity.clone();
    truth.labels = scene.truth->labels.clone();
    truth.regions.emplace("planes", Image<std::uint8_t>(64, 80));
    truth.regions.at("planes").at(2, 3) = 1;
    scene.truth = std::make_shared<GroundTruth>(std::move(truth));
    const std::filesystem::path target = path("scene");

    io::write_benchmark_folder(target, scene, Progress(2));
    const Scene read = io::open_scene(target, {}, Progress(2));

    QVERIFY(has_same_samples(scene, read));
    for (std::size_t i = 0; i < scene.truth->field.disparity.size(); ++i) {
      QCOMPARE(read.truth->field.disparity.data()[i], scene.truth->field.disparity.data()[i]);
    }
    QCOMPARE(*read.light_field->info().disparity_range, (Interval{-3, 3}));
    QCOMPARE(read.truth->labels.view({1, 2}).at(1, 1), 1);
    QCOMPARE(int(read.truth->regions.at("planes").at(2, 3)), 1);
    QCOMPARE(int(read.truth->regions.at("planes").at(2, 4)), 0);
    const CameraGrid& camera = read.light_field->info().camera;
    QVERIFY(std::abs(camera.shift - 5) < 1e-9);
    QVERIFY(std::abs(camera.baseline * camera.focal_length - 60) < 1e-9);
  }

  void viewsOfTheBenchmark_mayBeNumberedOtherwise_data() {
    QTest::addColumn<QString>("form");
    QTest::addColumn<int>("first");
    QTest::newRow("two digits") << "input_Cam%02d.png" << 0;
    QTest::newRow("no padding") << "input_Cam%d.png" << 0;
    QTest::newRow("from 1") << "input_Cam%03d.png" << 1;
    QTest::newRow("another case") << "input_cam%03d.PNG" << 0;
  }
  void viewsOfTheBenchmark_mayBeNumberedOtherwise() {
    QFETCH(QString, form);
    QFETCH(int, first);
    const Scene scene = plane_scene(grid(4, 4));
    write_views(scene, [&](int, int, int index) {
      return QString::asprintf(form.toLatin1(), index + first).toStdString();
    });
    const DisparityView truth = scene.truth->field.view(scene.light_field->center());
    io::write_pfm(path("gt_disp_lowres.pfm"), truth.disparity);

    const Scene read = open();

    QCOMPARE(read.light_field->info().reading.reader, std::string("benchmark2016"));
    QVERIFY2(has_same_samples(scene, read), describe(read.convention).c_str());
  }

  void missingConfig_isMadeUpForByTheCount() {
    const Scene scene = plane_scene(grid(3, 3));
    io::write_benchmark_folder(path("scene"), scene, Progress(2));
    std::filesystem::remove(path("scene/parameters.cfg"));

    const Scene read = io::open_scene(path("scene"), {}, Progress(2));

    QVERIFY(has_same_samples(scene, read));
    QVERIFY(QString::fromStdString(describe(read.convention)).contains("inferred"));
  }

  void truthOfTheCenterOnly_isOneView() {
    const Scene scene = plane_scene(grid(3, 3));
    io::write_benchmark_folder(path("scene"), scene, Progress(2));
    std::filesystem::remove(path("scene/gt_disp_lowres_Cam003.pfm"));

    const Scene read = io::open_scene(path("scene"), {}, Progress(2));

    QCOMPARE(read.truth->field.disparity.grid(), (GridShape{1, 1}));
    QCOMPARE(read.truth->field.disparity.first(), (ViewIndex{1, 1}));
  }

  // Everything that needs it is unchanged: the order of views.
  void truthNotNeeded_isNotRead() {
    const Scene scene = plane_scene(grid(3, 3));
    io::write_benchmark_folder(path("scene"), scene, Progress(2));
    const Scene whole = io::open_scene(path("scene"), {}, Progress(2));
    std::ofstream(path("scene/gt_disp_lowres_Cam003.pfm")) << "no map";
    std::ofstream(path("scene/objectids_lowres.png")) << "no picture";

    io::OpenOptions options;
    options.needs_truth = false;
    const Scene read = io::open_scene(path("scene"), options, Progress(2));

    QVERIFY(has_same_samples(scene, read));
    QCOMPARE(read.convention.order_check, whole.convention.order_check);
    QCOMPARE(read.convention.units, whole.convention.units);
    QVERIFY(read.truth->field.empty() && read.truth->labels.empty());
    QCOMPARE(read.convention.warnings, whole.convention.warnings);
  }

  void depthOfTheBenchmark_becomesDisparity() {
    const Scene scene = plane_scene(grid(3, 3));
    io::write_benchmark_folder(path("scene"), scene, Progress(2));
    Image<float> depth(64, 80);
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 80; ++x) {
        const float d = scene.truth->field.disparity.view({1, 1}).at(y, x);
        depth.at(y, x) =
            static_cast<float>(scene.light_field->info().camera.depth_from_disparity(d));
      }
    }
    for (const auto& entry : std::filesystem::directory_iterator(path("scene"))) {
      if (entry.path().filename().string().starts_with("gt_disp")) {
        std::filesystem::remove(entry.path());
      }
    }
    io::write_pfm(path("scene/gt_depth_lowres.pfm"), depth.view());

    const Scene read = io::open_scene(path("scene"), {}, Progress(2));

    // Depth is rounded to float: see archive_test.
    QVERIFY(std::abs(read.truth->field.disparity.view({1, 1}).at(7, 9) -
                     scene.truth->field.disparity.view({1, 1}).at(7, 9)) < 2e-6);
  }

  void folderWithOtherFiles_isNotWrittenInto() {
    std::ofstream(path("note.txt")) << "mine";

    QVERIFY_THROWS_EXCEPTION(
        IoError, io::write_benchmark_folder(path(), plane_scene(grid(3, 3)), Progress(1)));
    QCOMPARE(std::distance(std::filesystem::directory_iterator(path()),
                           std::filesystem::directory_iterator()),
             1);
  }
};

}  // namespace episcope::in_image_folder_test

EPISCOPE_TEST(image_folder_test, ImageFolderTest)
#include "image_folder_test.moc"
