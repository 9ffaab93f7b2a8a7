// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/sidecar_maps/find_maps.h"
#include "tests/test_main.h"

#include <fmt/format.h>
#include <QTemporaryDir>

#include <fstream>

namespace episcope::in_find_maps_test {

namespace fs = std::filesystem;

class FindMapsTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  fs::path path(const std::string& name = {}) const {
    const fs::path folder = folder_->path().toStdString();
    return name.empty() ? folder : folder / name;
  }
  /// Files are found by their names alone.
  void touch(const std::string& name) const {
    fs::create_directories(path(name).parent_path());
    std::ofstream(path(name)) << "x";
  }
  io::ViewFiles views(GridShape grid, const std::string& form, int base = 1) const {
    io::ViewFiles files{grid, {}};
    for (int i = 0; i < grid.count(); ++i) {
      const ViewIndex view = grid.view_at(i);
      files.files.push_back(
          path(form.find("{}") == form.rfind("{}")
                   ? fmt::format(fmt::runtime(form), base + i)
                   : fmt::format(fmt::runtime(form), base + view.v, base + view.u)));
    }
    return files;
  }
  static const io::MapSet* set_of(const io::FoundMapSets& maps, const std::string& pattern) {
    for (const io::MapSet& set : maps.sets) {
      if (set.pattern == pattern) return &set;
    }
    return nullptr;
  }

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void numbersOfNames_tellTheView_data() {
    QTest::addColumn<QString>("view");
    QTest::addColumn<QString>("map");
    QTest::addColumn<int>("base");  // of the maps; views begin at 1
    QTest::addColumn<QString>("pattern");
    QTest::newRow("UrbanLF") << "{}_{}.png"
                             << "{}_{}_disparity.npy" << 1 << "#_#_disparity.npy";
    QTest::newRow("INRIA") << "lf_{}_{}.png"
                           << "disparity_{}_{}.npy" << 1 << "disparity_#_#.npy";
    QTest::newRow("padded") << "{}_{}.png"
                            << "disparity_0{}_0{}.npy" << 1 << "disparity_#_#.npy";
    QTest::newRow("from 0") << "{}_{}.png"
                            << "{}_{}_disp.npy" << 0 << "#_#_disp.npy";
    QTest::newRow("upper case") << "{}_{}.png"
                                << "Disparity_{}_{}.NPY" << 1 << "disparity_#_#.npy";
    QTest::newRow("folder") << "{}_{}.png"
                            << "disparity/{}_{}.npy" << 1 << "disparity/#_#.npy";
    QTest::newRow("two folders") << "{}_{}.png"
                                 << "gt/disp/{}_{}.npy" << 1 << "gt/disp/#_#.npy";
    QTest::newRow("counted") << "view{}.png"
                             << "view{}_disp.pfm" << 1 << "view#_disp.pfm";
    QTest::newRow("counted maps") << "{}_{}.png"
                                  << "disp_{}.pfm" << 0 << "disp_#.pfm";
    QTest::newRow("counted views") << "view{}.png"
                                   << "disp_{}_{}.pfm" << 1 << "disp_#_#.pfm";
    QTest::newRow("frames are views") << "frame_{}.png"
                                      << "gt_disp_frame_{}.pfm" << 1 << "gt_disp_frame_#.pfm";
    QTest::newRow("frames are views, folder") << "frame_{}.png"
                                              << "depth/frame_{}.npy" << 1 << "depth/frame_#.npy";
    QTest::newRow("rows") << "{}/{}.png"
                          << "{}/{}_disparity.npy" << 1 << "*/*_disparity.npy";
    QTest::newRow("rows, name behind") << "row_{}/view_{}.png"
                                       << "row_{}/gt_depth_view_{}.npy" << 1 << "*/gt_depth_*.npy";
    QTest::newRow("rows of maps") << "{}/{}.png"
                                  << "disparity/{}/{}.npy" << 1 << "disparity/*/*.npy";
    QTest::newRow("a folder a view") << "{}_{}/000.png"
                                     << "{}_{}/depth.npy" << 1 << "*/depth.npy";
    QTest::newRow("folders of maps") << "{}_{}/000.png"
                                     << "disparity/{}_{}/000.npy" << 1 << "disparity/*/000.npy";
  }
  void numbersOfNames_tellTheView() {
    QFETCH(QString, view);
    QFETCH(QString, map);
    QFETCH(int, base);
    QFETCH(QString, pattern);
    const GridShape grid{3, 4};
    const io::ViewFiles maps = views(grid, map.toStdString(), base);
    for (const fs::path& file : maps.files) touch(fs::relative(file, path()).string());

    const io::FoundMapSets found = io::find_maps(views(grid, view.toStdString()), path());

    QCOMPARE(found.sets.size(), std::size_t{1});
    QCOMPARE(QString::fromStdString(found.sets.front().pattern), pattern);
    QVERIFY(found.sets.front().strays.empty());
    for (int i = 0; i < grid.count(); ++i) {
      QCOMPARE(found.sets.front().file_of(i), maps.files[static_cast<std::size_t>(i)]);
    }
  }

  void singleMap_belongsToTheCenterOrTheViewItNames_data() {
    QTest::addColumn<QString>("file");
    QTest::addColumn<int>("view");
    QTest::newRow("no number") << "disparity.npy" << 12;
    QTest::newRow("label") << "label.png" << 12;
    QTest::newRow("number of something else") << "scene17_depth.npy" << 12;
    QTest::newRow("of a view") << "2_1_disparity.npy" << 5;
    QTest::newRow("of a view, behind") << "gt_disparity_5_5.npy" << 24;
  }
  void singleMap_belongsToTheCenterOrTheViewItNames() {
    QFETCH(QString, file);
    QFETCH(int, view);
    touch(file.toStdString());

    const io::FoundMapSets found = io::find_maps(views({5, 5}, "{}_{}.png"), path());

    QCOMPARE(found.sets.size(), std::size_t{1});
    QCOMPARE(found.sets.front().entries.size(), std::size_t{1});
    QCOMPARE(found.sets.front().entries.front().view, view);
  }

  void singleMap_isOfTheViewWhoseCounterItHas() {
    touch("gt_disp_lowres_Cam007.pfm");

    const io::FoundMapSets found = io::find_maps(views({3, 3}, "input_Cam00{}.png", 0), path());

    QCOMPARE(found.sets.size(), std::size_t{1});
    QCOMPARE(found.sets.front().entries.front().view, 7);
  }

  void someMissingMaps_leaveTheOthersAtTheirViews() {
    const GridShape grid{5, 5};
    for (const char* name : {"2_2_disparity.npy", "2_4_disparity.npy", "5_5_disparity.npy"}) {
      touch(name);
    }

    const io::FoundMapSets found = io::find_maps(views(grid, "{}_{}.png"), path());

    QCOMPARE(found.sets.size(), std::size_t{1});
    QCOMPARE(found.sets.front().entries.size(), std::size_t{3});
    QCOMPARE(found.sets.front().file_of(6), path("2_2_disparity.npy"));
    QCOMPARE(found.sets.front().file_of(24), path("5_5_disparity.npy"));
    QVERIFY(found.sets.front().file_of(0).empty());
  }

  void mapsOfNoView_areStrays() {
    for (int i = 1; i <= 6; ++i) touch(fmt::format("7_{}_disparity.npy", i));

    const io::FoundMapSets found = io::find_maps(views({2, 2}, "{}_{}.png"), path());

    QCOMPARE(found.sets.size(), std::size_t{1});
    QVERIFY(found.sets.front().entries.empty());
    QCOMPARE(found.sets.front().strays.size(), std::size_t{6});
  }

  void kindsAndForms_areSetsOfTheirOwn() {
    const GridShape grid{2, 2};
    for (const char* form : {"{}_{}_label.npy", "{}_{}_label.png", "{}_{}_depth.npy"}) {
      for (const fs::path& file : views(grid, form).files) touch(file.filename().string());
    }
    touch("notes.txt");

    const io::FoundMapSets found = io::find_maps(views(grid, "{}_{}.png"), path());

    QCOMPARE(found.sets.size(), std::size_t{3});
    QVERIFY(set_of(found, "#_#_label.png") != nullptr);
    QCOMPARE(set_of(found, "#_#_label.npy")->kind, io::MapKind::Labels);
    QCOMPARE(set_of(found, "#_#_depth.npy")->kind, io::MapKind::Depth);
  }

  void masksOfViews_areNoRegions() {
    const GridShape grid{2, 2};
    for (const char* form : {"out_{}_{}_mask.png", "mask_net.png"}) {
      for (const fs::path& file : views(grid, form).files) touch(file.filename().string());
    }

    const io::FoundMapSets found = io::find_maps(views(grid, "out_{}_{}.png"), path());

    QCOMPARE(found.sets.size(), std::size_t{2});
    QCOMPARE(set_of(found, "out_#_#_mask.png")->kind, io::MapKind::Valid);
    QCOMPARE(set_of(found, "mask_net.png")->region, std::string("net"));
    QVERIFY(found.computed.empty());
  }

  void viewsAreNoMaps_whateverTheirNames() {
    const io::ViewFiles files = views({2, 2}, "depth_of_field_{}_{}.png");
    for (const fs::path& file : files.files) touch(file.filename().string());

    QVERIFY(io::find_maps(files, path()).sets.empty());
  }

  void mapsAroundAnInnerFolder_areFound() {
    touch("disparity.npy");
    touch("labels/1_1.png");
    touch("labels/1_2.png");
    const io::ViewFiles files = views({1, 2}, "lf/{}_{}.png");

    const io::FoundMapSets found = io::find_maps(files, path("lf"));

    QCOMPARE(found.sets.size(), std::size_t{2});
    QCOMPARE(found.folders.size(), std::size_t{2});
  }

  void mapsAroundAScene_belongToOthers() {
    touch("disparity.npy");
    touch("labels/1_1.png");

    QVERIFY(io::find_maps(views({1, 2}, "scene/{}_{}.png"), path("scene")).sets.empty());
  }

  void linksInCircles_areNotFollowed() {
    fs::create_directories(path("depth"));
    fs::create_directory_symlink(path(), path("depth/depth"));
    fs::create_directory_symlink(path(), path("gt"));
    touch("depth/disparity.npy");

    QCOMPARE(io::find_maps(views({2, 2}, "{}_{}.png"), path()).sets.size(), std::size_t{1});
  }
};

}  // namespace episcope::in_find_maps_test

EPISCOPE_TEST(find_maps_test, FindMapsTest)

#include "find_maps_test.moc"
