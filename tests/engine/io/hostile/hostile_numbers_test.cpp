// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/hdf5_output.h"
#include "engine/io/base/json.h"
#include "engine/io/base/npy.h"
#include "engine/io/models/result_file.h"
#include "engine/io/models/scribble_file.h"
#include "engine/io/models/sidecar_maps/map_file.h"
#include "engine/io/open.h"
#include "tests/engine/io/archive_files.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <functional>
#include <limits>

namespace episcope::in_hostile_numbers_test {

using namespace episcope::test;

namespace fs = std::filesystem;

/// Numbers in files that fit no int: where a cast would be undefined, there is a sentence.
class HostileNumbersTest : public QObject {
  Q_OBJECT

 private:
  QTemporaryDir folder_;

  fs::path path(const char* name) const { return folder_.filePath(name).toStdString(); }

  using Add = std::function<void(io::Hdf5Output&)>;
  fs::path hdf5(const char* name, const Add& add) const {
    io::AtomicFile target(path(name));
    io::Hdf5Output file(target);
    add(file);
    file.close();
    target.commit();
    return path(name);
  }
  template <class Read>
  static QString problem(const Read& read) {
    try {
      read();
    } catch (const IoError& error) {
      return QString::fromUtf8(error.what());
    }
    return {};
  }

 private slots:
  void viewOfAResult() {
    const fs::path file = hdf5("view.h5", [](io::Hdf5Output& out) {
      out.add_group("estimate");
      add_bytes(out, "estimate/disparity", {4, 5}, std::vector<std::uint8_t>(20, 1));
      out.set_numbers("estimate", "view", {1e300, std::numeric_limits<double>::quiet_NaN()});
    });
    QVERIFY(problem([&] { (void)io::read_result(file, {3, 3}, {}); }).contains("does not fit"));
  }
  void borderOfAResult_isLeftOut() {
    const fs::path file = hdf5("border.h5", [](io::Hdf5Output& out) {
      out.add_group("estimate");
      add_bytes(out, "estimate/disparity", {4, 5}, std::vector<std::uint8_t>(20, 1));
      out.set_number("estimate", "border_px", std::numeric_limits<double>::quiet_NaN());
    });
    QCOMPARE(io::read_result(file, {3, 3}, {}).border_px, 0);
  }
  void firstViewOfLabels() {
    const fs::path file = hdf5("first.h5", [](io::Hdf5Output& out) {
      add_bytes(out, "LABELS", {4, 5}, std::vector<std::uint8_t>(20, 1));
      out.set_numbers("LABELS", "first_view", {-1e12, 0});
    });
    QVERIFY(problem([&] { const io::SegmentationFile read(file); }).contains("names no view"));
  }
  void sidesOfLabels() {
    const fs::path file = hdf5("sides.h5", [](io::Hdf5Output& out) {
      add_bytes(out, "LABELS", {70000, 1, 1, 1}, std::vector<std::uint8_t>(70000, 1));
    });
    QVERIFY(problem([&] { const io::SegmentationFile read(file); }).contains("70000"));
  }
  void listOfLabels_isLeftOut() {
    const fs::path file = hdf5("list.h5", [](io::Hdf5Output& out) {
      add_bytes(out, "LABELS", {1, 1}, {1});
      out.set_numbers("LABELS", "label_ids", {1e20});
      out.set_numbers("LABELS", "label_colors", {0, 0, 1e20});
      out.set_text("LABELS", "label_names", "sky");
    });
    QVERIFY(io::read_label_list(io::Hdf5Input(file), "LABELS").empty());
  }
  void viewOfScribbles() {
    const Scene scene = plane_scene({.grid = {3, 3}, .height = 4, .width = 5});
    const fs::path file = hdf5("scribbles.h5", [](io::Hdf5Output& out) {
      std::vector<std::uint8_t> painted(20, 0);
      painted[3] = 1;
      add_bytes(out, "SCRIBBLES", {4, 5}, painted);
      out.set_numbers("/", "scribble_view", {3e9, 0});
    });
    const auto read = [&] { (void)io::read_scribbles(file, scene, Progress(1)); };
    QVERIFY(problem(read).contains("scribble_view"));
  }
  void labelsOfAnArray() {
    const std::vector<float> numbers{1, 2, 3, 1e30F};
    io::write_npy<float>(path("labels.npy"), {2, 2}, numbers);
    const auto read = [&] { (void)io::read_npy_labels(path("labels.npy")); };
    QVERIFY(problem(read).contains("whole numbers"));
  }
  void largestLabel_isNotRaised() {
    std::int32_t largest = std::numeric_limits<std::int32_t>::max();
    io::raise_label(largest);
    QCOMPARE(largest, std::numeric_limits<std::int32_t>::max());
    std::int32_t none = 0;
    io::raise_label(none);
    QCOMPARE(none, 1);
  }
  void deepParameters_areLeftOut() {
    const std::string deep = std::string(1000000, '[') + std::string(1000000, ']');
    QVERIFY(io::parameters_from_json("{\"a\": " + deep + "}").empty());
    QCOMPARE(io::parameters_from_json("{\"a\": [[1]]}").size(), std::size_t{1});
  }
  void regionInAGroup_isLeftOut() {
    RawArchive form;
    form.more = [](io::Hdf5Output& out) {
      add_bytes(out, "REGION_sky", {4, 5}, std::vector<std::uint8_t>(20, 1));
      out.add_group("REGION_a");
      add_bytes(out, "REGION_a/b", {4, 5}, std::vector<std::uint8_t>(20, 1));
    };
    write_raw_archive(path("lf.h5"), plane_scene({.grid = {3, 3}, .height = 4, .width = 5}), form);
    const Scene scene = io::open_scene(path("lf.h5"), {}, Progress(1));
    QCOMPARE(scene.truth->regions.size(), std::size_t{1});
    QVERIFY(scene.truth->regions.contains("sky"));
  }
};

}  // namespace episcope::in_hostile_numbers_test

EPISCOPE_TEST(hostile_numbers_test, HostileNumbersTest)
#include "hostile_numbers_test.moc"
