// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/collection.h"
#include "engine/core/error.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/image_header.h"
#include "engine/io/formats/write_arrays.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/models/result_file.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <fstream>

namespace episcope::in_collection_test {

namespace fs = std::filesystem;
using namespace episcope::test;

class CollectionTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  Scene scene_ = plane_scene({.grid = {3, 3}, .height = 24, .width = 32});

  fs::path root() const { return fs::path(folder_->path().toStdString()) / "root"; }
  fs::path made(const std::string& name) const {
    fs::create_directories(root() / name);
    return root() / name;
  }
  void write_archive(const std::string& name) const {
    io::write_archive(made(name) / "lf.h5", scene_, Progress(1));
  }
  void write_grid(const std::string& name, GridShape grid = {3, 3}) const {
    const fs::path folder = made(name);
    for (int i = 0; i < grid.count(); ++i) {
      const ViewIndex view = grid.view_at(i);
      io::write_png(
          folder / ("v_" + std::to_string(view.v) + "_" + std::to_string(view.u) + ".png"),
          bytes_of(scene_).view({0, 0}));
    }
  }
  static void write_text(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
  }
  void write_result(const fs::path& path, const std::string& source) const {
    Estimate estimate;
    estimate.method = "epi_l";
    estimate.source = source;
    estimate.field.disparity = ViewStack<float>({1, 1}, 24, 32, 1, {1, 1});
    estimate.field.valid = ViewStack<std::uint8_t>({1, 1}, 24, 32, 1, {1, 1});
    std::fill_n(estimate.field.disparity.data(), 24 * 32, 0.5F);
    std::fill_n(estimate.field.valid.data(), 24 * 32, std::uint8_t{1});
    io::write_result(path, estimate, Progress(1));
  }
  std::vector<io::CollectionEntry> found() const {
    return io::find_light_fields(root(), {}, Progress(1));
  }
  /// "a/b:archive", by path; "!" for what cannot be opened.
  static QStringList summary(const std::vector<io::CollectionEntry>& entries,
                             const fs::path& root) {
    QStringList texts;
    for (const auto& entry : entries) {
      const std::string path = entry.path.lexically_relative(root).string();
      texts += QString::fromStdString(path + ":" + (entry.problem.empty() ? entry.reader : "!"));
    }
    texts.sort();
    return texts;
  }
  QStringList summary() const { return summary(found(), root()); }

 private slots:
  void init() {
    folder_ = std::make_unique<QTemporaryDir>();
    fs::create_directories(root());
  }

  void everyForm_isFoundAtAnyDepthAndDescribedByItsHeaders() {
    write_archive("a/deep/down/one");
    io::write_benchmark_folder(made("b"), scene_, Progress(1));
    write_grid("c/d", {2, 4});
    made("nothing/here");

    const auto entries = found();

    QCOMPARE(summary(entries, root()),
             QStringList({"a/deep/down/one:archive", "b:benchmark2016", "c/d:image_grid"}));
    const io::SceneProbe& archive = entries[0].probe;
    QCOMPARE(archive.grid, (GridShape{3, 3}));
    QCOMPARE(archive.height, 24);
    QCOMPARE(archive.width, 32);
    QCOMPARE(archive.channels, 3);
    QVERIFY(archive.sample_type == SampleType::UInt8);
    QCOMPARE(archive.truth, std::string("depth of all views"));
    QCOMPARE(archive.labels, std::string("labels of all views, scribbles"));
    QCOMPARE(entries[0].name, std::string("one"));
    QCOMPARE(entries[0].bytes, fs::file_size(root() / "a/deep/down/one/lf.h5") +
                                   fs::file_size(root() / "a/deep/down/one/labels.h5"));
    QVERIFY(entries[0].modified > 1'500'000'000);
    QCOMPARE(entries[1].probe.truth, std::string("disparity of all views"));
    QCOMPARE(entries[1].probe.labels, std::string("labels of the center view"));
    QCOMPARE(entries[2].probe.grid, (GridShape{2, 4}));
  }

  void mapsBesideTheViews_areKnownByTheNamesOfArrays() {
    Scene scene = scene_;
    auto truth = std::make_shared<GroundTruth>();
    truth->field.disparity = ViewStack<float>({3, 3}, 24, 32, 1);
    truth->labels = ViewStack<std::int32_t>({1, 1}, 24, 32, 1, {1, 1});
    scene.truth = truth;
    io::write_npz(made("with") / "lf.npz", scene, Progress(1));
    scene.truth = std::make_shared<GroundTruth>();
    io::write_npz(made("without") / "lf.npz", scene, Progress(1));

    const auto entries = found();

    QCOMPARE(summary(entries, root()), QStringList({"with/lf.npz:numpy", "without/lf.npz:numpy"}));
    QCOMPARE(entries[0].probe.truth, std::string("disparity of all views"));
    QCOMPARE(entries[0].probe.labels, std::string("labels of one view"));
    QCOMPARE(entries[1].probe.truth, std::string());
    QCOMPARE(entries[1].probe.labels, std::string());
  }

  void files_inOneFolderAreOneLightFieldEach() {
    io::write_archive(made("two") / "one.h5", scene_, Progress(1));
    io::write_archive(made("two") / "other.h5", scene_, Progress(1));
    fs::remove(root() / "two/labels.h5");

    QCOMPARE(summary(), QStringList({"two/one.h5:archive", "two/other.h5:archive"}));
  }

  void sceneFolder_isNotSearchedFurther() {
    write_archive("scene");
    write_archive("scene/old_version");
    write_grid("views");
    write_grid("views/disparity");

    QCOMPARE(summary(), QStringList({"scene:archive", "views:image_grid"}));
  }

  void viewsInSeveralFolders_areOneLightField() {
    const auto view = bytes_of(scene_).view({0, 0});
    for (int i = 0; i < 9; ++i) {
      const std::string row = std::to_string(i / 3), column = std::to_string(i % 3);
      io::write_png(made("lines/row_" + row) / ("view_" + column + ".png"), view);
      io::write_png(made("render/cam_" + row + "_" + column) / "rgb.png", view);
    }

    QCOMPARE(summary(), QStringList({"lines:image_grid", "render:image_grid"}));
  }

  void ownPictures_areNoLightField() {
    write_archive("scene");
    for (const char* name : {"disparity", "error", "confidence", "view", "labels"}) {
      io::write_picture(made("pictures") / (std::string(name) + ".png"),
                        bytes_of(scene_).view({0, 0}));
    }
    write_grid("grid");

    QCOMPARE(summary(), (QStringList{"grid:image_grid", "scene:archive"}));
  }

  void exportsOfLabels_areNoLightField() {
    write_archive("scene");
    write_grid("out/SegmentationClass");
    write_grid("out/JPEGImages");
    write_text(root() / "out" / "labelmap.txt", "# label:color_rgb:parts:actions\n");

    QCOMPARE(summary(), QStringList{"scene:archive"});
  }

  void drawingsOfLabels_areNoLightField() {
    write_archive("scene");
    Image<std::uint8_t> strokes(400, 400, 3, 255);
    for (int i = 100; i < 300; ++i) {
      for (int c = 0; c < 3; ++c) strokes.at(i, i, c) = c == 0 ? 255 : 0;
    }
    io::write_png(made("drawn") / "strokes.png", strokes.view());

    QCOMPARE(summary(), QStringList{"scene:archive"});
  }

  void picturesBesideScenes_areNoLightField() {
    write_grid("a");
    write_grid("b");
    write_grid("", {2, 2});

    QCOMPARE(summary(), QStringList({"a:image_grid", "b:image_grid"}));
  }

  void damagedFiles_areListedWithASentence() {
    write_archive("good");
    write_text(made("bad") / "lf.h5", "\x89HDF\r\n\x1a\n");
    io::write_benchmark_folder(made("gap"), scene_, Progress(1));
    for (const char* view : {"000", "002", "004", "006"}) {
      fs::remove(root() / "gap" / (std::string("input_Cam") + view + ".png"));
    }

    const auto entries = found();

    QCOMPARE(summary(entries, root()), QStringList({"bad:!", "gap:!", "good:archive"}));
    QVERIFY2(entries[0].problem.find("truncated or damaged") != std::string::npos,
             entries[0].problem.c_str());
    QVERIFY2(entries[1].problem.find("missing") != std::string::npos, entries[1].problem.c_str());
  }

  void linksInALoop_andHiddenFolders_areLeftOut() {
    write_archive("a/scene");
    write_archive(".hidden");
    fs::create_directory_symlink(root(), root() / "a/back");
    fs::create_directory_symlink(root() / "a/scene", root() / "same");

    QCOMPARE(found().size(), std::size_t{1});
  }

  void results_goToTheSceneThatTheyName() {
    write_archive("one");
    write_archive("two");
    write_result(root() / "one/anything.h5", "");
    write_result(made("results") / "x.h5", "../two/lf.h5");
    write_result(root() / "two_smooth.h5", "");
    write_result(root() / "unrelated.h5", "gone");

    const auto entries = found();

    QCOMPARE(entries.size(), std::size_t{2});
    QCOMPARE(entries[0].results.size(), std::size_t{1});
    QCOMPARE(entries[0].results[0].method, std::string("epi_l"));
    QCOMPARE(entries[1].results.size(), std::size_t{2});
  }

  void search_isCancelledAndProgressive() {
    write_archive("a");
    write_archive("b");
    std::stop_source stop;
    int count = 0;
    const auto on_entry = [&](const io::CollectionEntry&) {
      ++count;
      stop.request_stop();
    };

    QVERIFY_THROWS_EXCEPTION(
        Cancelled,
        (void)io::find_light_fields(root(), on_entry, Progress(stop.get_token(), nullptr, 1)));
    QCOMPARE(count, 1);
  }

  void missingFolder_isAnError() {
    QVERIFY_THROWS_EXCEPTION(IoError,
                             (void)io::find_light_fields(root() / "gone", {}, Progress(1)));
  }

  void imageHeader_isThatOfTheDecodedImage_data() {
    QTest::addColumn<QString>("suffix");
    QTest::addColumn<int>("type");
    for (const char* suffix : {".png", ".jpg", ".tif", ".bmp", ".ppm"}) {
      QTest::newRow(suffix) << suffix << CV_8UC3;
    }
    QTest::newRow("png 16") << ".png" << CV_16UC3;
    QTest::newRow("png grey") << ".png" << CV_8UC1;
    QTest::newRow("png alpha") << ".png" << CV_8UC4;
    QTest::newRow("jpg grey") << ".jpg" << CV_8UC1;
    QTest::newRow("bmp grey") << ".bmp" << CV_8UC1;
    QTest::newRow("pgm 16") << ".pgm" << CV_16UC1;
    QTest::newRow("tif float") << ".tif" << CV_32FC1;
    QTest::newRow("tif 16") << ".tif" << CV_16UC3;
  }
  void imageHeader_isThatOfTheDecodedImage() {
    QFETCH(QString, suffix);
    QFETCH(int, type);
    const fs::path path = root() / ("image" + suffix.toStdString());
    QVERIFY(cv::imwrite(path.string(), cv::Mat(17, 23, type, cv::Scalar(9, 8, 7, 6))));

    const io::ImageHeader header = io::read_image_header(path);

    const io::AnyImage decoded = io::decode_image(path);
    std::visit(
        [&](const auto& image) {
          QCOMPARE(header.height, image.height());
          QCOMPARE(header.width, image.width());
          QCOMPARE(header.channels, image.channels());
        },
        decoded);
    QCOMPARE(static_cast<std::size_t>(header.sample_type), decoded.index());
  }

  void truncatedHeader_isAnError() {
    write_text(root() / "x.png", "\x89PNG\r\n\x1a\n12345");
    write_text(root() / "x.tif", std::string("II*\0\xff\xff\xff\x7f", 8));

    for (const char* name : {"x.png", "x.tif"}) {
      QVERIFY_THROWS_EXCEPTION(IoError, (void)io::read_image_header(root() / name));
    }
  }
};

}  // namespace episcope::in_collection_test

EPISCOPE_TEST(collection_test, CollectionTest)

#include "collection_test.moc"
