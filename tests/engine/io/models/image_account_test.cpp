// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/files.h"
#include "engine/io/base/image_file.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/models/assemble_scene.h"
#include "engine/io/models/open_options.h"
#include "engine/io/open.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <fmt/format.h>
#include <QTemporaryDir>
#include <opencv2/imgcodecs.hpp>

#include <fstream>

namespace episcope::in_image_account_test {

using namespace episcope::test;

namespace fs = std::filesystem;

/// What becomes of the files of a folder of images, and lists of views.
class ImageAccountTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;

  fs::path path(const std::string& name = "") const {
    return fs::path(folder_->path().toStdString()) / name;
  }
  /// Writes the views of a grid under names with row and column, or with a number for `{2}`.
  Scene write_views(GridShape grid, const std::string& form, double slope = 0.04) const {
    PlaneOptions plane;
    plane.grid = grid;
    plane.slope_x = slope;
    Scene scene = plane_scene(plane);
    for (int i = 0; i < grid.count(); ++i) {
      const ViewIndex view = grid.view_at(i);
      const std::string name =
          fmt::format(fmt::runtime(form), fmt::arg("r", view.v), fmt::arg("c", view.u),
                      fmt::arg("i", i), fmt::arg("y", -1.5 * view.v), fmt::arg("x", 2.25 * view.u));
      fs::create_directories(path(name).parent_path());
      io::write_png(path(name), scene.light_field->view<std::uint8_t>(view));
    }
    return scene;
  }
  /// "9 views; unused: 2 *.txt", of the report.
  static QString account(const Scene& scene) {
    QStringList used;
    QStringList unused;
    for (const FileUse& use : scene.convention.files) {
      (use.is_used ? used : unused)
          << QString("%1 %2").arg(use.count).arg(QString::fromStdString(use.kind));
    }
    return used.join(", ") + "; " + unused.join(", ");
  }
  Scene open(const io::OpenOptions& options = {}) const {
    return io::open_scene(path(), options, Progress(2));
  }

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void everyFile_isAccountedFor();
  void folderInside_isAccountedForWithTheOneAround();
  void benchmarkFolder_isAccountedFor();
  void archive_isAccountedFor();
  void manyKinds_areToldApartLessFinely();
  void imagesLikeViews_areWarnedOf();
  void positionsInNames_reachTheLightField();
  void list_takesTheGridThatIsGiven_data();
  void list_takesTheGridThatIsGiven();
  void listOfAnotherCount_isRefused();
  void listThatTellsNothing_isAsked();
  void links_thatLeadToThemselves_doNoHarm();
  void linearFloats_stay();
  void formatsOfImages_areDecoded_data();
  void formatsOfImages_areDecoded();
};

void ImageAccountTest::everyFile_isAccountedFor() {
  write_views({3, 3}, "{r}_{c}.png");
  for (const char* name :
       {"license.txt", "map.h5", "shot_1.raw", "shot_22.raw", "points3D.txt", ".hidden"}) {
    std::ofstream(path(name)) << "x";
  }

  QCOMPARE(account(open()),
           QString("9 views; 1 license.txt, 1 map.h5, 1 points3D.txt, 2 shot_#.raw"));
}

void ImageAccountTest::folderInside_isAccountedForWithTheOneAround() {
  write_views({3, 3}, "lf/{r}_{c}.png");
  std::ofstream(path("lf/note.txt")) << "x";
  std::ofstream(path("readme.md")) << "x";

  const Scene scene = open();

  QCOMPARE(account(scene), QString("9 views; 1 note.txt, 1 readme.md"));
  QCOMPARE(scene.light_field->info().source, path().string());
}

void ImageAccountTest::benchmarkFolder_isAccountedFor() {
  PlaneOptions plane;
  plane.grid = {3, 3};
  io::write_benchmark_folder(path("scene"), plane_scene(plane), Progress(1));
  std::ofstream(path("scene/license.txt")) << "x";

  const QString text = account(io::open_scene(path("scene"), {}, Progress(1)));

  QVERIFY2(text.startsWith(
               "9 views, 1 parameter files, 9 disparity maps, 1 label maps of the center view") &&
               text.endsWith("1 license.txt"),
           qPrintable(text));
}

void ImageAccountTest::archive_isAccountedFor() {
  io::write_archive(path("lf.h5"), plane_scene(), Progress(1));
  std::ofstream(path("note.txt")) << "x";

  const Scene scene = open();

  QVERIFY2(account(scene).startsWith("1 light field") && account(scene).endsWith("1 note.txt"),
           qPrintable(account(scene)));
}

void ImageAccountTest::manyKinds_areToldApartLessFinely() {
  for (char c = 'a'; c <= 'z'; ++c) {
    std::ofstream(path(std::string(1, c) + ".txt")) << "x";
    std::ofstream(path(std::string(1, c) + ".csv")) << "x";
  }

  const std::vector<FileUse> uses = io::FileUsage(path()).uses();

  QCOMPARE(uses.size(), std::size_t{2});
  QCOMPARE(uses[1].kind, std::string("*.txt"));
  QCOMPARE(uses[1].count, 26);
}

void ImageAccountTest::imagesLikeViews_areWarnedOf() {
  const Scene scene = write_views({3, 3}, "{r}_{c}.png");
  for (const char* name : {"old", "new", "test", "best", "rest"}) {
    io::write_png(path(std::string(name) + ".png"), scene.light_field->view<std::uint8_t>({0, 0}));
  }

  const Scene read = open();

  QVERIFY(std::ranges::any_of(read.convention.warnings, [](const std::string& warning) {
    return warning.starts_with("5 images look like views");
  }));
}

void ImageAccountTest::positionsInNames_reachTheLightField() {
  write_views({3, 4}, "out_{r:02}_{c:02}_{y:f}_{x:f}.png");

  const Scene scene = open();

  const auto& positions = scene.light_field->info().positions;
  QCOMPARE(positions.size(), std::size_t{12});
  QCOMPARE(std::abs(positions[0].x - positions[1].x), 2.25);
  QCOMPARE(std::abs(positions[0].y - positions[4].y), 1.5);
}

void ImageAccountTest::list_takesTheGridThatIsGiven_data() {
  QTest::addColumn<QString>("given");
  QTest::addColumn<int>("rows");
  QTest::addColumn<int>("columns");
  QTest::newRow("grid") << "3x4" << 3 << 4;
  QTest::newRow("other grid") << "6x2" << 6 << 2;
  QTest::newRow("row") << "1x12" << 1 << 12;
  QTest::newRow("column") << "12×1" << 12 << 1;
}

void ImageAccountTest::list_takesTheGridThatIsGiven() {
  QFETCH(QString, given);
  QFETCH(int, rows);
  QFETCH(int, columns);
  write_views({3, 4}, "img_{i}.png");
  io::OpenOptions options;
  options.grid = given.toStdString();
  options.flip = io::Flip::None;

  const Scene read = open(options);

  QCOMPARE(read.light_field->grid(), (GridShape{rows, columns}));
}

void ImageAccountTest::listOfAnotherCount_isRefused() {
  write_views({3, 4}, "img_{i}.png");
  io::OpenOptions options;
  options.grid = "3x3";
  QVERIFY_THROWS_EXCEPTION(IoError, (void)open(options));
  options.grid = "three";
  QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)open(options));
}

// Views that are all alike tell nothing, and a list of nine is no square by itself.
void ImageAccountTest::listThatTellsNothing_isAsked() {
  for (int i = 0; i < 9; ++i) {
    io::write_png(path(fmt::format("{}.png", i)), Image<std::uint8_t>(16, 16).view());
  }

  try {
    (void)open();
    QFAIL("it was guessed");
  } catch (const io::Undecided& question) {
    QCOMPARE(question.option(), std::string("grid"));
    QCOMPARE(question.choices().size(), std::size_t{3});
    QCOMPARE(question.choices()[1].value, std::string("1x9"));
  }
}

void ImageAccountTest::links_thatLeadToThemselves_doNoHarm() {
  write_views({3, 3}, "{r}_{c}.png");
  for (const char* name : {"lf.h5", "parameters.cfg", "depth.bin", "views", "images", "3_3.png"}) {
    fs::create_symlink(name, path(name));
  }
  fs::create_directory_symlink(".", path("lf"));

  const Scene scene = open();

  QCOMPARE(scene.light_field->grid(), (GridShape{3, 3}));
  QCOMPARE(account(scene), QString("9 views; "));
}

void ImageAccountTest::linearFloats_stay() {
  for (const char* name : {"0_0", "0_1", "1_0", "1_1"}) {
    const cv::Mat view(4, 5, CV_32FC3, cv::Scalar(0.25, 0.5, 7.5));  // blue, green, red
    QVERIFY(cv::imwrite(path(std::string(name) + ".hdr").string(), view));
  }

  const Scene scene = open();

  QCOMPARE(scene.light_field->sample_type(), SampleType::Float32);
  QCOMPARE(scene.light_field->view<float>({0, 0}).at(1, 1, 0), 7.5F);
  QVERIFY(scene.convention.format.ends_with("linear float samples"));
}

void ImageAccountTest::formatsOfImages_areDecoded_data() {
  QTest::addColumn<QString>("suffix");
  QTest::addColumn<int>("type");
  for (const char* suffix : {".png", ".PNG", ".tif", ".TIFF", ".bmp", ".ppm", ".webp", ".jp2"}) {
    QTest::newRow(suffix) << suffix << CV_8UC3;
  }
  QTest::newRow(".png 16 bit") << ".png" << CV_16UC3;
  QTest::newRow(".tif float") << ".tif" << CV_32FC3;
  QTest::newRow(".png alpha") << ".png" << CV_8UC4;
  QTest::newRow(".exr") << ".exr" << CV_32FC3;
}

void ImageAccountTest::formatsOfImages_areDecoded() {
  QFETCH(QString, suffix);
  QFETCH(int, type);
  const fs::path file = path("a" + suffix.toStdString());
  // Decoding anything lets OpenCV write OpenEXR as well.
  io::write_png(path("first.png"), Image<std::uint8_t>(2, 2).view());
  (void)io::decode_image(path("first.png"));
  const cv::Mat view(64, 64, type, cv::Scalar(10, 20, 30, 255));
  const std::vector<int> lossless{cv::IMWRITE_WEBP_QUALITY, 101,
                                  cv::IMWRITE_JPEG2000_COMPRESSION_X1000, 1000};
  QVERIFY(cv::imwrite(file.string(), view,
                      suffix == ".webp" || suffix == ".jp2" ? lossless : std::vector<int>()));

  QVERIFY(io::is_image_name(file));
  const io::AnyImage image = io::decode_image(file);

  const std::size_t expected = type == CV_32FC3 ? 2 : type == CV_16UC3 ? 1 : 0;
  QCOMPARE(image.index(), expected);
  std::visit(
      [](const auto& pixels) {
        QCOMPARE(pixels.channels(), 3);
        QCOMPARE(static_cast<int>(pixels.at(2, 2, 0)), 30);
        QCOMPARE(static_cast<int>(pixels.at(2, 2, 2)), 10);
      },
      image);
}

}  // namespace episcope::in_image_account_test

EPISCOPE_TEST(image_account_test, ImageAccountTest)
#include "image_account_test.moc"
