// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/quilt.h"

#include "engine/core/error.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/open_options.h"
#include "engine/io/open.h"
#include "engine/io/write.h"
#include "tests/engine/io/archive_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <opencv2/imgcodecs.hpp>

namespace episcope::in_quilt_test {

using namespace episcope::test;

namespace fs = std::filesystem;

namespace {

Scene line_of(int views) {
  return plane_scene({.grid = {1, views}});
}

cv::Mat picture_of(const Scene& scene, ViewIndex view) {
  const auto image = bytes_of(scene).view(view);
  const cv::Mat rgb(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.data));
  cv::Mat bgr(rgb.size(), rgb.type());
  cv::mixChannels(rgb, bgr, {0, 2, 1, 1, 2, 0});
  return bgr;
}

/// As OpenCV joins views, rows of tiles from the bottom.
void write_from_bottom(const fs::path& path, const Scene& scene, GridShape tiles) {
  const bool is_line = scene.light_field->grid().v == 1;
  cv::Mat all;
  for (int row = tiles.v - 1; row >= 0; --row) {
    std::vector<cv::Mat> line;
    for (int column = 0; column < tiles.u; ++column) {
      line.push_back(picture_of(
          scene, is_line ? ViewIndex{0, row * tiles.u + column} : ViewIndex{row, column}));
    }
    cv::Mat joined;
    cv::hconcat(line, joined);
    if (all.empty()) {
      all = joined;
    } else {
      cv::vconcat(all, joined, all);
    }
  }
  QVERIFY(cv::imwrite(path.string(), all));
}

}  // namespace

class QuiltTest : public QObject, private test::PictureFolder {
  Q_OBJECT

 private slots:
  void init() { renew(); }

  void name_statesTheTiles_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<int>("columns");
    QTest::addColumn<int>("rows");
    QTest::newRow("usual") << "flower_qs8x6a0.75.png" << 8 << 6;
    QTest::newRow("JPEG, capitals") << "Flower_QS5x9A1.77.JPG" << 5 << 9;
    QTest::newRow("nothing else") << "qs11x6a.56.webp" << 11 << 6;
    QTest::newRow("no aspect") << "flower_qs8x6.png" << 0 << 0;
    QTest::newRow("inside a word") << "iraqs8x6a1.png" << 0 << 0;
    QTest::newRow("no tiles") << "flower_qs0x6a1.png" << 0 << 0;
    QTest::newRow("no picture") << "flower_qs8x6a0.75.h5" << 0 << 0;
  }
  void name_statesTheTiles() {
    QFETCH(QString, name);
    QFETCH(int, columns);
    QFETCH(int, rows);

    const auto tiles = io::quilt_tiles_of_name(name.toStdString());

    QCOMPARE(tiles.value_or(GridShape{0, 0}), (GridShape{rows, columns}));
  }

  void quilt_isOneLineFromTheBottomLeft() {
    const Scene scene = line_of(12);
    write_from_bottom(path("flower_qs4x3a1.25.png"), scene, {3, 4});

    const Scene read = open("flower_qs4x3a1.25.png");

    QCOMPARE(read.light_field->grid(), (GridShape{1, 12}));
    QVERIFY2(has_same_samples(scene, read), describe(read.convention).c_str());
    QVERIFY(QString::fromStdString(read.convention.format).contains("quilt of 3×4 tiles"));
  }

  void quiltWithoutName_followsTheOption() {
    const Scene scene = line_of(12);
    write_from_bottom(path("flower.png"), scene, {3, 4});

    const Scene stated = open("flower.png", {.grid = "3x4", .mosaic = io::Mosaic::Quilt});
    const Scene found = open("flower.png", {.mosaic = io::Mosaic::Quilt});

    QVERIFY(has_same_samples(scene, stated));
    QVERIFY(has_same_samples(scene, found));
  }

  void rowsFromTheBottom_areAnOption() {
    const Scene scene = plane_scene({.grid = {3, 4}});
    write_from_bottom(path("array.png"), scene, {3, 4});

    const Scene read = open("array.png", {.mosaic = io::Mosaic::ViewsUp});

    QVERIFY2(has_same_samples(scene, read), describe(read.convention).c_str());
  }

  void optionForAnotherMosaic_goesBeforeTheName() {
    const Scene scene = plane_scene({.grid = {3, 4}});
    write_from_bottom(path("flower_qs4x3a1.25.png"), scene, {3, 4});

    const Scene read = open("flower_qs4x3a1.25.png", {.mosaic = io::Mosaic::ViewsUp});

    QVERIFY2(has_same_samples(scene, read), describe(read.convention).c_str());
  }

  void tilesThatDoNotFillThePicture_areRefused() {
    write_from_bottom(path("flower_qs4x5a1.25.png"), line_of(12), {3, 4});

    const QString refusal = refusal_of("flower_qs4x5a1.25.png");

    QVERIFY2(refusal.contains("5×4 tiles of a quilt do not divide"), qPrintable(refusal));
  }

  void cutThroughViews_isRefused_data() {
    QTest::addColumn<QString>("grid");
    QTest::addColumn<bool>("has_kind");
    QTest::newRow("rows and columns exchanged") << "4x3" << true;
    QTest::newRow("fewer") << "2x2" << true;
    QTest::newRow("one row") << "1x4" << true;
    QTest::newRow("without --mosaic") << "4x3" << false;
  }
  void cutThroughViews_isRefused() {
    QFETCH(QString, grid);
    QFETCH(bool, has_kind);
    write_from_bottom(path("array.png"), plane_scene({.grid = {3, 4}}), {3, 4});
    io::OpenOptions options{.grid = grid.toStdString()};
    if (has_kind) options.mosaic = io::Mosaic::Views;

    const QString refusal = refusal_of("array.png", options);

    QVERIFY2(refusal.contains("cuts through the views of this picture, whose tiles are 3x4"),
             qPrintable(refusal));
  }

  void writtenQuilt_holdsTheMiddleRow() {
    const Scene scene = plane_scene({.grid = {3, 6}});
    const fs::path named = io::quilt_path(path("flower.png"), *scene.light_field);

    io::write_quilt(named, scene, Progress(2));

    QCOMPARE(named.filename().string(), std::string("flower_qs2x3a1.25.png"));
    const cv::Mat stored = cv::imread(named.string());
    QCOMPARE(stored.size(), cv::Size(2 * 80, 3 * 64));
    const cv::Rect bottom_right(80, 2 * 64, 80, 64);
    QCOMPARE(cv::norm(stored(bottom_right), picture_of(scene, {1, 1}), cv::NORM_INF), 0.0);
    QCOMPARE(open(named.filename().string()).light_field->grid(), (GridShape{1, 6}));
    QCOMPARE(io::unsupported_parts(*io::writer_of(named), scene).front(),
             std::string("A quilt holds one row of views; row 1 is written, the others are left "
                         "out."));
  }

  void nameWithOtherTiles_isRefused() {
    const Scene scene = line_of(6);

    QVERIFY_THROWS_EXCEPTION(IoError,
                             io::write_quilt(path("flower_qs8x6a0.75.png"), scene, Progress(2)));
    QVERIFY_THROWS_EXCEPTION(
        IoError, io::write_quilt(path("a.png"), plane_scene({.grid = {5, 1}}), Progress(2)));
  }
};

}  // namespace episcope::in_quilt_test

EPISCOPE_TEST(quilt_test, QuiltTest)
#include "quilt_test.moc"
