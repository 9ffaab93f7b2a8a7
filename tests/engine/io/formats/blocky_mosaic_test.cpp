// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/open_options.h"
#include "engine/io/open.h"
#include "engine/io/write.h"
#include "tests/engine/io/archive_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <opencv2/imgcodecs.hpp>

// Blocks of 8 px, as JPEG leaves them, are neither lenslets nor views.

namespace episcope::in_blocky_mosaic_test {

using namespace episcope::test;

namespace fs = std::filesystem;

namespace {

Scene plane(GridShape grid) {
  PlaneOptions options;
  options.grid = grid;
  return plane_scene(options);
}

/// A view in blocks of 8 px with levels of their own, as strong compression leaves them.
Image<std::uint8_t> blocky_photograph() {
  PlaneOptions options;
  options.grid = {1, 1};
  options.height = 160;
  options.width = 240;
  const Scene scene = plane_scene(options);
  unsigned noise = 1;
  Image<int> levels(options.height / 8, options.width / 8);
  for (int& level : levels) {
    noise = noise * 1664525U + 1013904223U;
    level = static_cast<int>(noise >> 24) % 5;
  }
  Image<std::uint8_t> picture(options.height, options.width);
  for (int y = 0; y < options.height; ++y) {
    for (int x = 0; x < options.width; ++x) {
      const int sample = bytes_of(scene).view({0, 0}).at(y, x) / 4 + 30 * levels.at(y / 8, x / 8);
      picture.at(y, x) = static_cast<std::uint8_t>(sample);
    }
  }
  return picture;
}

}  // namespace

class BlockyMosaicTest : public QObject, private test::PictureFolder {
  Q_OBJECT

 private slots:
  void init() { renew(); }

  void photograph_isNoLightField_data() {
    QTest::addColumn<bool>("is_blocky");
    QTest::addColumn<QString>("name");
    QTest::newRow("plain") << false << "photo.png";
    QTest::newRow("in blocks of 8 px, as JPEG leaves them") << true << "photo.png";
    QTest::newRow("such blocks under a name of mosaics") << true << "lf.png";
  }
  void photograph_isNoLightField() {
    QFETCH(bool, is_blocky);
    QFETCH(QString, name);
    const Scene scene = plane({1, 1});
    const Image<std::uint8_t> blocky = blocky_photograph();
    io::write_png(path(name.toStdString()),
                  is_blocky ? blocky.view() : bytes_of(scene).view({0, 0}));

    const QString sentence = refusal_of(name.toStdString());

    QVERIFY2(sentence.contains("single picture") && sentence.contains("--mosaic views --grid RxC"),
             qPrintable(sentence));
  }

  void lensletsInAJpeg_areNotItsBlocks_data() {
    QTest::addColumn<bool>("is_blocky");
    QTest::addColumn<int>("side");
    QTest::newRow("7 px") << false << 7;
    QTest::newRow("14 px") << false << 14;
    QTest::newRow("blocks of 8 px") << true << 0;
  }
  void lensletsInAJpeg_areNotItsBlocks() {
    QFETCH(bool, is_blocky);
    QFETCH(int, side);
    io::write_eslf(path("a_macpi.png"), plane({std::max(side, 1), std::max(side, 1)}), Progress(2));
    const Image<std::uint8_t> blocks = blocky_photograph();
    const cv::Mat blocky(blocks.height(), blocks.width(), CV_8UC1,
                         const_cast<std::uint8_t*>(blocks.data()));
    cv::imwrite(path("a_macpi.jpg").string(),
                is_blocky ? blocky : cv::imread(path("a_macpi.png").string()));

    if (is_blocky) {
      QVERIFY_THROWS_EXCEPTION(io::Undecided, (void)open("a_macpi.jpg"));
    } else {
      QCOMPARE(open("a_macpi.jpg").light_field->grid(), (GridShape{side, side}));
    }
  }

  void viewsSideBySide_areFoundInSpiteOfBlocks() {
    const Image<std::uint8_t> view = blocky_photograph();
    Image<std::uint8_t> picture(2 * view.height(), 3 * view.width());
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        picture.at(y, x) = view.at(y % view.height(), x % view.width());
      }
    }
    io::write_png(path("lf.png"), picture.view());

    QCOMPARE(open("lf.png").light_field->grid(), (GridShape{2, 3}));
  }
};

}  // namespace episcope::in_blocky_mosaic_test

EPISCOPE_CORE_TEST(blocky_mosaic_test, BlockyMosaicTest)
#include "blocky_mosaic_test.moc"
