// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/formats/collection.h"
#include "engine/io/formats/write_scene.h"
#include "tests/engine/io/formats/rendered_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope::in_blender_reader_test {

using namespace episcope::test;

namespace fs = std::filesystem;

/// What the add-on writes, read and converted.
class BlenderReaderTest : public QObject {
  Q_OBJECT

 private:
  /// Largest difference from the truth; infinite where a pixel lacks. `first`: the view of the
  /// folder that is the first one of the scene.
  static double error_of(const DisparityField& field, const ViewStack<float>& truth,
                         ViewIndex first = {}) {
    double largest = field.empty() ? HUGE_VAL : 0;
    for (int i = 0; !field.empty() && i < field.disparity.grid().count(); ++i) {
      const ViewIndex view = field.disparity.view_at(i);
      const DisparityView map = field.view(view);
      const auto expected = truth.view({view.v + first.v, view.u + first.u});
      for (int y = 0; y < map.disparity.height; ++y) {
        for (int x = 0; x < map.disparity.width; ++x) {
          if (!map.is_valid(y, x)) return HUGE_VAL;
          const double difference = map.disparity.at(y, x) - expected.at(y, x);
          largest = std::max(largest, std::abs(difference));
        }
      }
    }
    return largest;
  }

  static std::string failure_of(const RenderedFolder& folder) {
    try {
      static_cast<void>(folder.open());
    } catch (const IoError& error) {
      return error.what();
    }
    return {};
  }

 private slots:
  void wholeFolder_hasViewsTruthLabelsAndCamera() {
    const RenderedFolder folder;

    const Scene scene = folder.open();

    QCOMPARE(scene.light_field->grid(), RenderedFolder::kGrid);
    QVERIFY(error_of(scene.truth->field, folder.scene.disparity) < 1e-5);
    const ViewStack<std::int32_t>& labels = scene.truth->labels;
    QCOMPARE(labels.size(), folder.scene.labels.size());
    QVERIFY(std::equal(labels.data(), labels.data() + labels.size(), folder.scene.labels.data()));
    const LightFieldInfo& info = scene.light_field->info();
    QCOMPARE(info.camera.shift, static_cast<double>(LayeredScene::kB));
    QCOMPARE(info.camera.cam_distance.value_or(0), RenderedFolder::kZeroPlane);
    QVERIFY((info.disparity_range == Interval{-0.5, 1.5}));
    QCOMPARE(count_used(scene, "depth maps"), RenderedFolder::kGrid.count());
    QVERIFY(!warns_of(scene, "rendered so far"));
    QVERIFY(!scene.convention.reversed_u && !scene.convention.reversed_v);
  }

  void viewAndManifest_openTheFolderThatTheyLieIn() {
    const RenderedFolder folder;
    for (const char* name : {"light_field.json", "views/view_01_03.png"}) {
      QCOMPARE(folder.open(name).light_field->grid(), RenderedFolder::kGrid);
    }
  }

  void unfinishedRendering_showsTheRingsThatAreComplete() {
    const RenderedFolder folder;
    std::vector<ViewIndex> complete;
    for (int v = 1; v <= 3; ++v) {
      for (int u = 1; u <= 3; ++u) complete.push_back({v, u});
    }
    complete.push_back({0, 0});
    folder.write_manifest(complete);
    fs::remove(folder.path("views/view_04_04.png"));

    const Scene scene = folder.open();

    QCOMPARE(scene.light_field->grid(), (GridShape{3, 3}));
    QVERIFY(error_of(scene.truth->field, folder.scene.disparity, {1, 1}) < 1e-5);
    QVERIFY(warns_of(scene, "10 of 25 views are rendered so far; shown are the 3×3"));
    const auto view = scene.light_field->view<std::uint8_t>({0, 2});
    const auto expected = folder.scene.views.view({1, 3});
    QVERIFY(std::equal(view.data, view.data + view.size(), expected.data));
  }

  void nothingRendered_isASentence() {
    const RenderedFolder folder;
    folder.write_manifest({{0, 0}});
    const std::string failure = failure_of(folder);
    QVERIFY2(failure.find("no view is rendered yet") != std::string::npos, failure.c_str());
  }

  void depthBehind_makesTwoLayersWhereItIsKnown() {
    const RenderedFolder folder;
    constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
    ViewStack<float> behind(RenderedFolder::kGrid, folder.scene.depth.height(),
                            folder.scene.depth.width());
    for (std::size_t i = 0; i < behind.size(); ++i) {
      const bool is_square = folder.scene.labels.data()[i] == 2;
      behind.data()[i] =
          is_square ? LayeredScene::kA / (LayeredScene::kFar + LayeredScene::kB) : kNone;
    }
    folder.write_npy(RenderedFolder::part("depth_behind/behind_{:02}_{:02}.npy"), behind);
    folder.write_manifest(
        RenderedFolder::whole(),
        {"'labels': 'labels",
         "'depth_behind': 'depth_behind/behind_{row:02}_{column:02}.npy', 'labels': 'labels"});

    const Scene scene = folder.open();

    const ViewIndex view{1, 3};
    const auto labels = folder.scene.labels.view(view);
    const GroundTruth& truth = *scene.truth;
    QVERIFY(truth.has_layers());
    for (int y = 0; y < labels.height; ++y) {
      for (int x = 0; x < labels.width; ++x) {
        const bool is_square = labels.at(y, x) == 2;
        QCOMPARE(truth.field.view(view).is_valid(y, x), !is_square);
        QCOMPARE(truth.foreground.view(view).is_valid(y, x), is_square);
        QCOMPARE(truth.background.view(view).is_valid(y, x), is_square);
        if (!is_square) continue;
        QVERIFY(std::abs(truth.foreground.disparity.view(view).at(y, x) - 1.5F) < 1e-5F);
        QVERIFY(std::abs(truth.background.disparity.view(view).at(y, x) + 0.5F) < 1e-5F);
      }
    }
  }

  void conversion_keepsDepthLabelsAndTheirNames() {
    const RenderedFolder folder;
    const Scene scene = folder.open();
    io::write_archive(folder.place("out/lf.h5"), scene, Progress(1));

    const Scene archive = folder.open("out/lf.h5");

    QVERIFY(has_same_samples(scene, archive));
    QVERIFY(largest_difference(scene.truth->field, archive.truth->field) < 1e-5);
    QCOMPARE(archive.scribbles.labels.size(), std::size_t{2});
    QVERIFY(archive.scribbles.labels == scene.scribbles.labels);
    QCOMPARE(archive.scribbles.labels[1].name, std::string("wall"));
    QCOMPARE(archive.truth->labels.size(), scene.truth->labels.size());
    QVERIFY(std::equal(archive.truth->labels.data(),
                       archive.truth->labels.data() + archive.truth->labels.size(),
                       scene.truth->labels.data()));
  }

  void collection_countsTheFolderAsOne() {
    const RenderedFolder folder;
    const auto record = io::scan_folder(io::list_folder(folder.path()));
    QCOMPARE(record.entries.size(), std::size_t{1});
    QCOMPARE(record.entries[0].reader, std::string("blender"));
    QCOMPARE(record.entries[0].probe.grid, RenderedFolder::kGrid);
    QCOMPARE(record.entries[0].probe.labels, std::string("labels of all views"));
  }

  void damage_isNamed_data() {
    QTest::addColumn<std::string>("from");
    QTest::addColumn<std::string>("to");
    QTest::addColumn<std::string>("expected");
    const auto row = [](const char* name, const char* from, const std::string& to,
                        const char* expected) {
      QTest::newRow(name) << std::string(from) << to << std::string(expected);
    };
    row("truncated", "'complete': [", "'complete", "the manifest is damaged");
    row("newer", "'version': 1", "'version': 7", "a newer add-on");
    row("no grid", "'rows'", "'lines'", "the manifest is damaged");
    row("grid of nothing", "'rows': 5", "'rows': 0", "states 0×5 views");
    row("grid too large", "'rows': 5", "'rows': 100000", "states 100000×5 views");
    row("no baseline", "'baseline': 0.5", "'baseline': 0", "parameter b is 0");
    row("view outside", "'complete': [[0, 0]", "'complete': [[9, 0]", "view 9,0 is outside");
    row("other size", "'width': 72", "'width': 70", "states 70×60 px");
    row("names without numbers", "label_{row:02}", "label_", "must lie in the folder");
    row("names elsewhere", "labels/label", "../label", "must lie in the folder");
    row("names at the root", "labels/label", "/label", "must lie in the folder");
    row("number that fits no int", "'rows': 5", "'rows': 1e300", "where a whole number belongs");
    row("fraction", "'rows': 5", "'rows': 4.5", "where a whole number belongs");
    row("nested deeply", "'complete': [",
        "'x': " + std::string(100, '[') + std::string(100, ']') + ", 'complete': [",
        "more than 64 levels");
    row("missing files", "depth/depth_", "depth/d_", "d_");
  }
  void damage_isNamed() {
    QFETCH(std::string, from);
    QFETCH(std::string, to);
    QFETCH(std::string, expected);
    const RenderedFolder folder;
    folder.write_manifest(RenderedFolder::whole(), {from, to});
    const std::string failure = failure_of(folder);
    QVERIFY2(failure.find(expected) != std::string::npos, failure.c_str());
  }

  void linkToAnotherFolder_isRefused() {
    const RenderedFolder folder;
    const QTemporaryDir elsewhere;
    fs::rename(folder.path("views"), fs::path(elsewhere.path().toStdString()) / "views");
    fs::create_directory_symlink(fs::path(elsewhere.path().toStdString()) / "views",
                                 folder.path("views"));

    const std::string failure = failure_of(folder);

    QVERIFY2(failure.find("must lie in the folder") != std::string::npos, failure.c_str());
  }

  void missingView_isNamed() {
    const RenderedFolder folder;
    fs::remove(folder.path("views/view_04_04.png"));
    const std::string failure = failure_of(folder);
    QVERIFY2(failure.find("view_04_04.png") != std::string::npos &&
                 failure.find("it is missing") != std::string::npos,
             failure.c_str());
  }

  void mapOfAnotherSize_isNamed() {
    const RenderedFolder folder;
    const Image<float> small(4, 5, 1, 12.0F);
    folder.LayeredFolder::write_npy("depth/depth_00_00.npy", small.view());
    const std::string failure = failure_of(folder);
    QVERIFY2(failure.find("this map has 5×4 px") != std::string::npos, failure.c_str());
  }
};

}  // namespace episcope::in_blender_reader_test

EPISCOPE_TEST(blender_reader_test, BlenderReaderTest)
#include "blender_reader_test.moc"
