// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/npy.h"
#include "engine/io/formats/multi_field_file.h"
#include "engine/io/open.h"
#include "tests/engine/io/archive_files.h"
#include "tests/engine/io/formats/array_files.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <algorithm>
#include <numeric>
#include <random>

namespace episcope::in_several_fields_test {

using namespace episcope::test;

namespace fs = std::filesystem;

/// Files that hold several light fields: two of the same size, the second nearer.
class SeveralFieldsTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  std::vector<Scene> scenes_;

  fs::path path(const std::string& name) const {
    return fs::path(folder_->path().toStdString()) / name;
  }
  static Scene open(const fs::path& path, int frame, const std::string& dataset = {}) {
    io::OpenOptions options;
    options.frame = frame;
    options.dataset = dataset;
    return io::open_scene(path, options, Progress(1));
  }
  static std::vector<std::size_t> lengths(const Scene& scene, bool is_stack) {
    auto all = lengths_of(bytes_of(scene), "vuyxc");
    if (is_stack) all.insert(all.begin(), 2);
    return all;
  }
  /// Samples and disparity in groups, each or along the first axis.
  void write_hdf5(const fs::path& path, bool is_stack) const {
    io::AtomicFile target(path);
    io::Hdf5Output file(target);
    for (std::size_t i = 0; i < scenes_.size(); ++i) {
      const ViewStack<float>& disparity = scenes_[i].truth->field.disparity;
      const std::string group = is_stack ? "" : (i == 0 ? "boxes/" : "cotton/");
      auto views = lengths(scenes_[i], is_stack);
      auto maps = views;
      maps.pop_back();
      if (i == 0 || !is_stack) {
        if (!is_stack) file.add_group(group.substr(0, group.size() - 1));
        file.add_dataset<std::uint8_t>(group + "LF", views, "", "");
        file.add_dataset<float>(group + "disparity", maps, "", "");
      }
      io::Hdf5Shape start(views.size(), 0);
      if (is_stack) start.front() = i;
      if (is_stack) views.front() = maps.front() = 1;
      file.write(group + "LF", {start, views}, bytes_of(scenes_[i]).data());
      start.pop_back();
      file.write(group + "disparity", {start, maps}, disparity.data());
    }
    file.close();
    target.commit();
  }
  void check(const Scene& read, std::size_t index) const {
    QVERIFY2(has_same_samples(read, scenes_[index]), describe(read.convention).c_str());
    QVERIFY(largest_difference(read.truth->field, scenes_[index].truth->field) < 1e-6);
  }

  static constexpr GridShape kGreyGrid{3, 5};
  /// A wall of grain of its own, which moves by so many pixels from view to view.
  static ViewStack<std::uint8_t> grey_views(unsigned seed) {
    std::mt19937 random(seed);
    Image<float> grain(60, 80);
    for (float& value : grain) value = static_cast<float>(random() % 256);
    ViewStack<std::uint8_t> views(kGreyGrid, 40, 48, 1);
    for (int i = 0; i < kGreyGrid.count(); ++i) {
      const ViewIndex view = kGreyGrid.view_at(i);
      for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 48; ++x) {
          const int at = y + view.v * static_cast<int>(seed),
                    across = x + view.u * static_cast<int>(seed);
          const float four = grain.at(at, across) + grain.at(at + 1, across) +
                             grain.at(at, across + 1) + grain.at(at + 1, across + 1);
          views.view(view).at(y, x) = static_cast<std::uint8_t>(four / 4);
        }
      }
    }
    return views;
  }
  /// Along the first axis of an array.
  static void write_grey(const fs::path& path, const std::vector<unsigned>& seeds) {
    std::vector<std::uint8_t> all;
    for (const unsigned seed : seeds) {
      const ViewStack<std::uint8_t> views = grey_views(seed);
      all.insert(all.end(), views.data(), views.data() + views.size());
    }
    io::write_npy<std::uint8_t>(path, {seeds.size(), 3, 5, 40, 48}, all);
  }

 private slots:
  void initTestCase() {
    for (const double d : {0.3, 1.3}) {
      scenes_.push_back(plane_scene({.grid = {3, 5}, .height = 40, .width = 48, .d0 = d}));
    }
  }
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void numbersOfNames_pairViewsWithMaps_data() {
    QTest::addColumn<int>("first");
    QTest::addColumn<int>("count");
    QTest::newRow("two from 0") << 0 << 2;
    QTest::newRow("two from 1") << 1 << 2;
    QTest::newRow("three") << 0 << 3;  // whose maps alone would be joined to a list
    QTest::newRow("over ten") << 9 << 3;
  }
  void numbersOfNames_pairViewsWithMaps() {
    QFETCH(int, first);
    QFETCH(int, count);
    {
      io::AtomicFile target(path("numbered.h5"));
      io::Hdf5Output file(target);
      for (int i = 0; i < count; ++i) {
        const Scene& scene = scenes_[static_cast<std::size_t>(i % 2)];
        const std::string number = std::to_string(first + i);
        const auto views = lengths(scene, false);
        file.add_dataset<std::uint8_t>("LF" + number, views, "", "");
        file.write("LF" + number, {io::Hdf5Shape(5, 0), views}, bytes_of(scene).data());
        const io::Hdf5Shape map{views[2], views[3]};
        file.add_dataset<float>("disparity" + number, map, "", "");
        file.write("disparity" + number, {{0, 0}, map},
                   scene.truth->field.disparity.view({1, 2}).data);
      }
      file.close();
      target.commit();
    }

    // HDF5 lists LF10 before LF9.
    for (int frame = 0; frame < count; ++frame) {
      const Scene read = open(path("numbered.h5"), frame);
      const std::size_t index = has_same_samples(read, scenes_[0]) ? 0 : 1;
      QVERIFY2(read.truth->field.contains({1, 2}), describe(read.convention).c_str());
      const float* expected = scenes_[index].truth->field.disparity.view({1, 2}).data;
      const auto map = read.truth->field.disparity.view({1, 2});
      QVERIFY(std::equal(map.data, map.data + map.size(), expected));
    }
  }

  void fileOfSeveral_opensTheFirstOrTheOneNumbered_data() {
    QTest::addColumn<bool>("is_stack");
    QTest::newRow("stack") << true;
    QTest::newRow("groups") << false;
  }
  void fileOfSeveral_opensTheFirstOrTheOneNumbered() {
    QFETCH(bool, is_stack);
    write_hdf5(path("several.h5"), is_stack);

    for (const int frame : {0, 1}) {
      const Scene read = open(path("several.h5"), frame);
      check(read, static_cast<std::size_t>(frame));
      QCOMPARE(read.sequence.frame, frame);
      QCOMPARE(read.sequence.count, 2);
      QVERIFY(read.convention.warnings.front().find("holds 2 light fields") != std::string::npos);
      QCOMPARE(read.light_field->info().reading.options.empty(), frame == 0);
    }
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)open(path("several.h5"), 2));
  }

  void group_canBeNamed() {
    write_hdf5(path("several.h5"), false);

    const Scene read = open(path("several.h5"), 0, "cotton/LF");

    check(read, 1);
    QCOMPARE(read.sequence.count, 0);
  }

  void greyLightFields_areStatedByTheirAxes_data() {
    QTest::addColumn<int>("count");
    for (const int count : {2, 3, 4, 5}) QTest::addRow("%d", count) << count;
  }
  void greyLightFields_areStatedByTheirAxes() {
    QFETCH(int, count);
    std::vector<unsigned> seeds(static_cast<std::size_t>(count));
    std::iota(seeds.begin(), seeds.end(), 1);
    write_grey(path("grey.npy"), seeds);

    for (int i = 0; i < count; ++i) {
      io::OpenOptions options{.axes = "vuyx"};
      options.frame = i;
      const Scene read = io::open_scene(path("grey.npy"), options, Progress(1));
      const ViewStack<std::uint8_t> views = grey_views(seeds[static_cast<std::size_t>(i)]);
      QCOMPARE(read.light_field->channels(), 1);
      QVERIFY(std::equal(views.data(), views.data() + views.size(), bytes_of(read).data()));
      QCOMPARE(read.sequence.count, count);
    }
  }

  void channelsOfOneScene_stayChannels() {
    write_grey(path("rgb.npy"), {1, 1, 1});

    QCOMPARE(open(path("rgb.npy"), 0).light_field->channels(), 3);
  }

  void stackOfNumpy_isReadByItsParts() {
    std::vector<std::uint8_t> all;
    for (const Scene& scene : scenes_) {
      all.insert(all.end(), bytes_of(scene).data(),
                 bytes_of(scene).data() + bytes_of(scene).size());
    }
    io::write_npy<std::uint8_t>(path("s.npy"), lengths(scenes_.front(), true), all);

    QVERIFY(has_same_samples(open(path("s.npy"), 1), scenes_[1]));
  }

  void maps_areNoStacks() {
    io::ArrayEntry entry{.name = "lf", .shape = {4, 9, 9, 40, 48, 3}};
    QVERIFY(io::can_be_stack(entry));
    entry.shape = {9, 9, 40, 48, 3};
    QVERIFY(!io::can_be_stack(entry));
    entry.shape = {1, 9, 9, 40, 48, 3};
    QVERIFY(!io::can_be_stack(entry));
  }
};

}  // namespace episcope::in_several_fields_test

EPISCOPE_TEST(several_fields_test, SeveralFieldsTest)
#include "several_fields_test.moc"
