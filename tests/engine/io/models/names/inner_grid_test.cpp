// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/models/names/view_folders.h"
#include "tests/engine/io/models/sidecar_maps/layered_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <algorithm>
#include <fstream>

namespace episcope::in_inner_grid_test {

using namespace episcope::test;

namespace fs = std::filesystem;

namespace {

bool has_views_of(const Scene& read, const LayeredScene& scene) {
  const auto& samples = std::get<ViewStack<std::uint8_t>>(read.light_field->samples());
  return samples.size() == scene.views.size() &&
         std::equal(samples.data(), samples.data() + samples.size(), scene.views.data());
}

}  // namespace

/// Views in a folder inside of the one that is opened, and numbered around 0.
class InnerGridTest : public QObject {
  Q_OBJECT

 private slots:
  void onlyGridInside_isOpenedAndNamed() {
    const LayeredFolder folder;
    folder.write_views(LayeredFolder::named("rendered/{}_{}.png"));
    std::ofstream(folder.path("readme.txt")) << "nothing";

    const Scene read = folder.open();

    QVERIFY(has_views_of(read, folder.scene));
    QCOMPARE(read.convention.format, std::string("image grid (rendered/{row}_{col}.png)"));
    QCOMPARE(read.light_field->info().source, folder.path().string());
    QCOMPARE(count_used(read, "views"), 9);
  }

  // As PlenoptiCam leaves them.
  void viewpointsBesideOtherPictures_areOpened() {
    const LayeredFolder folder;
    folder.write_views(LayeredFolder::named("viewpoints_3px/{}_{}.png"));
    folder.write_views(LayeredFolder::named("refocus/photo_{}{}.png"));

    const Scene read = folder.open();

    QVERIFY(has_views_of(read, folder.scene));
    QVERIFY(warns_of(read, "those of viewpoints_3px; pictures in refocus are left out"));
  }

  void mapsBesideTheFolder_areTruth() {
    const LayeredFolder folder;
    folder.write_views(LayeredFolder::named("rendered/{}_{}.png"));
    folder.write_npy(LayeredFolder::named("disparity/{}_{}.npy"), folder.scene.disparity);

    const Scene read = folder.open();

    QVERIFY(has_views_of(read, folder.scene));
    QVERIFY2(read.truth->has_disparity(), describe(read.convention).c_str());
  }

  void otherPassesOfARender_areNoViews_data() {
    QTest::addColumn<QString>("form");
    QTest::newRow("a folder each") << "%1/{}_{}.png";
    QTest::newRow("in one folder") << "{}_{}_%1.png";
    QTest::newRow("a folder each, numbered") << "%1/{}{}.png";
  }
  void otherPassesOfARender_areNoViews() {
    QFETCH(QString, form);
    const LayeredFolder folder;
    for (const char* pass : {"rgb", "normal", "albedo"}) {
      folder.write_views(LayeredFolder::named(form.arg(pass).toStdString()));
    }
    folder.write_npy(LayeredFolder::named(form.arg("depth").replace("png", "npy").toStdString()),
                     folder.scene.disparity);

    const Scene read = folder.open();

    QVERIFY(has_views_of(read, folder.scene));
    QVERIFY2(read.convention.format.find("rgb") != std::string::npos,
             read.convention.format.c_str());
  }

  void twoFolders_areNotOneLightField() {
    const LayeredFolder folder;
    folder.write_views(LayeredFolder::named("left/{}_{}.png"));
    folder.write_views(LayeredFolder::named("right/{}_{}.png"));

    QVERIFY(io::only_grid_inside(folder.path()).empty());
    QVERIFY_THROWS_EXCEPTION(IoError, (void)folder.open());
  }

  void photographsWithoutAGrid_areNoLightField() {
    const LayeredFolder folder;
    folder.write_views([](int row, int column) {
      return "holiday/IMG_" + std::to_string(4000 + 3 * row + column) + ".png";
    });

    QVERIFY(io::only_grid_inside(folder.path()).empty());
    QVERIFY_THROWS_EXCEPTION(IoError, (void)folder.open());
  }

  void numbersAroundZero_areAGridInTheirOrder_data() {
    QTest::addColumn<QString>("prefix");
    QTest::newRow("bare") << "";
    QTest::newRow("word") << "view_";
    QTest::newRow("constant number") << "scene3_";
  }
  void numbersAroundZero_areAGridInTheirOrder() {
    QFETCH(QString, prefix);
    const LayeredFolder folder({5, 5});
    folder.write_views([&](int row, int column) {
      return prefix.toStdString() + std::to_string(row - 3) + "_" + std::to_string(column - 3) +
             ".png";
    });

    const Scene read = folder.open();

    QVERIFY2(has_views_of(read, folder.scene), describe(read.convention).c_str());
    QCOMPARE(read.convention.format, "image grid (" + prefix.toStdString() + "{row}_{col}.png)");
    QVERIFY2(!read.convention.order_check.empty(), describe(read.convention).c_str());
  }

  void numbersAroundZeroWithGaps_areRefused() {
    const LayeredFolder folder({5, 5});
    folder.write_views([&](int row, int column) {
      return "v_" + std::to_string(row - 3) + "_" + std::to_string(column - 3) + ".png";
    });
    fs::remove(folder.path("v_-2_1.png"));

    QVERIFY_THROWS_EXCEPTION(IoError, (void)folder.open());
  }
};

}  // namespace episcope::in_inner_grid_test

EPISCOPE_TEST(inner_grid_test, InnerGridTest)
#include "inner_grid_test.moc"
