// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/npy.h"
#include "engine/io/models/sidecar_maps/map_file.h"
#include "tests/engine/io/formats/array_files.h"
#include "tests/engine/io/models/sidecar_maps/layered_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <algorithm>
#include <string>

namespace episcope::in_archived_map_test {

using namespace episcope::test;

namespace fs = std::filesystem;

/// Maps beside views in files that hold arrays with names.
class ArchivedMapTest : public QObject {
  Q_OBJECT

 private:
  static ZippedFile zipped(const LayeredFolder& folder, const std::string& name,
                           ImageView<const float> map) {
    folder.write_npy("part", map);
    ZippedFile file{name + ".npy", bytes_of_file(folder.path("part"))};
    fs::remove(folder.path("part"));
    return file;
  }
  static bool is_truth(const Scene& read, const LayeredScene& scene) {
    const ViewStack<float>& maps = read.truth->field.disparity;
    if (maps.grid().count() != scene.disparity.grid().count()) return false;
    return std::equal(maps.data(), maps.data() + maps.size(), scene.disparity.data());
  }
  static std::string error_for(const fs::path& path) {
    try {
      (void)io::read_archived_values(path, {3, 3});
    } catch (const IoError& error) {
      return error.what();
    }
    return {};
  }

 private slots:
  void mapsOfViews_areTruth_data() {
    QTest::addColumn<QString>("suffix");
    QTest::newRow("MATLAB") << ".mat";
    QTest::newRow("NumPy") << ".npz";
  }
  void mapsOfViews_areTruth() {
    QFETCH(QString, suffix);
    const LayeredFolder folder;
    folder.write_views(LayeredFolder::named("{}_{}.png"));
    const auto name = LayeredFolder::named("{}_{}_disparity" + suffix.toStdString());
    folder.for_views(name, [&](const fs::path& file, ViewIndex view) {
      const auto map = folder.scene.disparity.view(view);
      if (suffix == ".mat") {
        write_mat5_map(file, "anything", map);
      } else {
        write_deflated_zip(file, {zipped(folder, "arr_0", map)});
      }
    });

    const Scene read = folder.open();

    QVERIFY2(is_truth(read, folder.scene), describe(read.convention).c_str());
    QCOMPARE(count_used(read, "disparity maps"), 9);
  }

  void ofSeveralMaps_theNamedOneCounts() {
    const LayeredFolder folder;
    const auto disparity = folder.scene.disparity.view({1, 1});
    const auto depth = folder.scene.depth.view({1, 1});
    write_deflated_zip(folder.path("maps.npz"), {zipped(folder, "confidence", depth),
                                                 zipped(folder, "gt_disparity", disparity)});

    const ViewStack<float> read = io::read_archived_values(folder.path("maps.npz"), {3, 3});

    QCOMPARE(read.height(), disparity.height);
    QVERIFY(std::equal(read.data(), read.data() + read.size(), disparity.data));
  }

  void severalWithoutAName_areAsked() {
    const LayeredFolder folder;
    const auto map = folder.scene.disparity.view({1, 1});
    write_deflated_zip(folder.path("maps.npz"),
                       {zipped(folder, "a", map), zipped(folder, "b", map)});

    const std::string error = error_for(folder.path("maps.npz"));

    QVERIFY2(error.find("a (60×72), b (60×72)") != std::string::npos, error.c_str());
    QVERIFY2(error.find("several maps") != std::string::npos, error.c_str());
  }

  // Of damaged files: 9 × 954437177 is 1 more than 2³², and the length 2³² + 1 is not 1.
  void moreViewsThanAnIntCounts_areNoMap_data() {
    QTest::addColumn<qulonglong>("rows");
    QTest::addColumn<qulonglong>("columns");
    QTest::newRow("product") << qulonglong{9} << qulonglong{954437177};
    QTest::newRow("length") << (qulonglong{1} << 32) + 1 << qulonglong{1};
  }
  void moreViewsThanAnIntCounts_areNoMap() {
    QFETCH(qulonglong, rows);
    QFETCH(qulonglong, columns);
    const LayeredFolder folder;
    const std::string header = io::npy_header({rows, columns, 6, 8}, io::NumberType::Float32);
    write_deflated_zip(folder.path("maps.npz"), {{"a.npy", header}});

    const std::string error = error_for(folder.path("maps.npz"));

    QVERIFY2(error.find("no map") != std::string::npos, error.c_str());
  }

  void noMap_isSaid() {
    const LayeredFolder folder;
    const ViewStack<float> row({1, 1}, 1, 72);
    write_mat5_map(folder.path("maps.mat"), "row", row.view({0, 0}));

    const std::string error = error_for(folder.path("maps.mat"));

    QVERIFY2(error.find("row (1×72)") != std::string::npos, error.c_str());
    QVERIFY2(error.find("no map") != std::string::npos, error.c_str());
  }
};

}  // namespace episcope::in_archived_map_test

EPISCOPE_TEST(archived_map_test, ArchivedMapTest)

#include "archived_map_test.moc"
