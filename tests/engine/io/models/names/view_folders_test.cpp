// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/names/view_folders.h"
#include "engine/core/error.h"
#include "engine/io/base/image_file.h"
#include "tests/engine/io/models/sidecar_maps/layered_folder.h"
#include "tests/test_main.h"

#include <fmt/format.h>

#include <algorithm>

namespace episcope::in_view_folders_test {

using namespace episcope::test;

/// A folder for each view, as renderers write them: a square before a wall in 3×3 views.
class ViewFoldersTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<LayeredFolder> folder_;

  bool has_views(const Scene& scene) const {
    const auto& found = std::get<ViewStack<std::uint8_t>>(scene.light_field->samples());
    const auto& wanted = folder_->scene.views;
    return std::equal(wanted.data(), wanted.data() + wanted.size(), found.data(),
                      found.data() + found.size());
  }

 private slots:
  void init() { folder_ = std::make_unique<LayeredFolder>(); }

  void folderOfEachView_isAGridWithItsMaps() {
    folder_->write_views(LayeredFolder::named("view_{:02}_{:02}/rgb.png"));
    folder_->write_npy(LayeredFolder::named("view_{:02}_{:02}/disparity.npy"),
                       folder_->scene.disparity);
    io::write_png(folder_->place("view_01_01/depth.png"), folder_->scene.views.view({0, 0}));

    const Scene scene = folder_->open();

    QVERIFY2(scene.convention.format.find("view_{row}_{col}/rgb.png") != std::string::npos,
             scene.convention.format.c_str());
    QVERIFY(has_views(scene));
    const ViewStack<float>& maps = scene.truth->field.disparity;
    QVERIFY(std::equal(maps.data(), maps.data() + maps.size(), folder_->scene.disparity.data()));
    QCOMPARE(count_used(scene, "disparity maps"), 9);
  }

  void foldersOfMapsBesideThem_areTruth() {
    folder_->write_views(LayeredFolder::named("{:02}_{:02}/000.png"));
    folder_->write_npy(LayeredFolder::named("disparity/{:02}_{:02}/000.npy"),
                       folder_->scene.disparity);

    const Scene scene = folder_->open();

    QVERIFY(has_views(scene));
    QCOMPARE(count_used(scene, "disparity maps"), 9);
  }

  void countedFoldersOfViews_areAList() {
    folder_->write_views(
        [](int row, int column) { return fmt::format("cam_{}/image.png", 3 * row + column); });

    QVERIFY(has_views(folder_->open({}, {.grid = "3x3"})));
  }

  void foldersOfScenes_areNoViews_data() {
    QTest::addColumn<QString>("form");
    QTest::newRow("mosaics") << "view_{}_{}/lf.png";
    QTest::newRow("counted") << "scene_{}{}/image.png";
  }
  void foldersOfScenes_areNoViews() {
    QFETCH(QString, form);
    folder_->write_views(LayeredFolder::named(form.toStdString()));

    QVERIFY(!io::find_view_folders(folder_->path()));
  }
};

}  // namespace episcope::in_view_folders_test

EPISCOPE_TEST(view_folders_test, ViewFoldersTest)
#include "view_folders_test.moc"
