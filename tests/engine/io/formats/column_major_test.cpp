// SPDX-License-Identifier: BSD-3-Clause
#include "tests/engine/io/archive_files.h"
#include "tests/engine/io/archive_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>

namespace episcope::in_column_major_test {

using namespace episcope::test;

/// Archive files of other writers: MATLAB stores the axes of its arrays in the opposite order.
class ColumnMajorTest : public QObject, private ArchiveFolder {
  Q_OBJECT

 private:
  static std::size_t length(int value) { return static_cast<std::size_t>(value); }

  /// Depth of all views as `[x][y][h][v]`, of views that are stored in another order.
  static std::vector<float> depth_by_columns(const Scene& scene, io::ViewFlip flip = {}) {
    const LightField& field = *scene.light_field;
    std::vector<float> depth;
    for (int x = 0; x < field.width(); ++x) {
      for (int y = 0; y < field.height(); ++y) {
        for (int u = 0; u < field.grid().u; ++u) {
          for (int v = 0; v < field.grid().v; ++v) {
            depth.push_back(depth_at(scene, io::flipped({v, u}, field.grid(), flip), y, x));
          }
        }
      }
    }
    return depth;
  }
  static float depth_at(const Scene& scene, ViewIndex view, int y, int x) {
    const float d = scene.truth->field.disparity.view(view).at(y, x);
    return static_cast<float>(scene.light_field->info().camera.depth_from_disparity(d));
  }
  static std::vector<float> center_depth(const Scene& scene, bool by_columns) {
    const LightField& field = *scene.light_field;
    std::vector<float> depth;
    const int outer = by_columns ? field.width() : field.height();
    const int inner = by_columns ? field.height() : field.width();
    for (int i = 0; i < outer; ++i) {
      for (int j = 0; j < inner; ++j) {
        depth.push_back(by_columns ? depth_at(scene, field.grid().center(), j, i)
                                   : depth_at(scene, field.grid().center(), i, j));
      }
    }
    return depth;
  }
  static void add_depth(io::Hdf5Output& file, const io::Hdf5Shape& shape,
                        const std::vector<float>& depth) {
    file.add_dataset<float>("GT_DEPTH", shape, "", "");
    file.write("GT_DEPTH", {io::Hdf5Shape(shape.size(), 0), shape}, depth.data());
  }
  /// LF in the order of the archive, depth as given.
  Scene open_with(const Scene& scene, const io::Hdf5Shape& shape,
                  const std::vector<float>& depth) const {
    RawArchive form;
    form.flip = {true, false};
    form.has_depth = false;
    form.more = [&](io::Hdf5Output& file) { add_depth(file, shape, depth); };
    write_raw_archive(path("lf.h5"), scene, form);
    return open(path("lf.h5"));
  }
  static bool warns(const Scene& scene, const char* words) {
    return std::ranges::any_of(scene.convention.warnings, [&](const std::string& warning) {
      return warning.find(words) != std::string::npos;
    });
  }
  static double center_difference(const Scene& scene, const Scene& read) {
    const ViewIndex center = scene.light_field->grid().center();
    const auto wanted = scene.truth->field.disparity.view(center);
    const auto found = read.truth->field.disparity.view(center);
    double largest = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      largest = std::max<double>(largest, std::abs(wanted.data[i] - found.data[i]));
    }
    return largest;
  }

 private slots:
  void init() { renew(); }

  void depthOfAllViews_isReadByColumns() {
    const Scene scene = plane_scene();

    const Scene read = open_with(scene, {80, 64, 5, 5}, depth_by_columns(scene, {true, false}));

    QVERIFY2(has_same_samples(scene, read), describe(read.convention).c_str());
    QVERIFY(largest_difference(scene.truth->field, read.truth->field) < kDepthRounding);
    QVERIFY2(read.convention.units.find("opposite order") != std::string::npos,
             read.convention.units.c_str());
  }

  void depthOfTheCenter_isReadByColumns() {
    const Scene scene = plane_scene();

    const Scene read = open_with(scene, {80, 64}, center_depth(scene, true));

    QVERIFY2(has_same_samples(scene, read), describe(read.convention).c_str());
    QVERIFY(center_difference(scene, read) < kDepthRounding);
  }

  void depthOfASquareCenter_isTurnedByTheViews() {
    PlaneOptions square;
    square.width = square.height;
    square.slope_x = 0.03;
    const Scene scene = plane_scene(square);

    const Scene read = open_with(scene, {64, 64}, center_depth(scene, true));

    QVERIFY2(has_same_samples(scene, read), describe(read.convention).c_str());
    QVERIFY(center_difference(scene, read) < kDepthRounding);
    QVERIFY2(warns(read, "rows and columns exchanged"), describe(read.convention).c_str());
  }

  void channelAxisOfDepth_isLeftOut() {
    const Scene scene = plane_scene();

    const Scene read = open_with(scene, {64, 80, 1}, center_depth(scene, false));

    QVERIFY(center_difference(scene, read) < kDepthRounding);
  }

  void wholeFileByColumns_keepsItsDepth_data() {
    QTest::addColumn<int>("width");
    QTest::newRow("wide") << 80;
    QTest::newRow("square") << 64;
  }
  void wholeFileByColumns_keepsItsDepth() {
    QFETCH(int, width);
    PlaneOptions options;
    options.width = width;
    const Scene scene = plane_scene(options);
    const auto& views = bytes_of(scene);
    std::vector<std::uint8_t> samples;
    for (int c = 0; c < 3; ++c) {
      for (int x = 0; x < width; ++x) {
        for (int y = 0; y < views.height(); ++y) {
          for (int i = 0; i < 25; ++i) samples.push_back(views.view({i % 5, i / 5}).at(y, x, c));
        }
      }
    }
    io::AtomicFile target(path("lf.h5"));
    io::Hdf5Output file(target);
    add_bytes(file, "LF", {3, length(width), length(views.height()), 5, 5}, samples);
    add_depth(file, {length(width), length(views.height()), 5, 5}, depth_by_columns(scene));
    const CameraGrid& camera = scene.light_field->info().camera;
    file.set_number("/", "dH", camera.baseline);
    file.set_number("/", "focalLength", camera.focal_length);
    file.set_number("/", "shift", camera.shift);
    file.close();
    target.commit();

    const Scene read = open(path("lf.h5"));

    QVERIFY2(has_same_samples(scene, read), describe(read.convention).c_str());
    QVERIFY(!read.truth->field.empty());
    QVERIFY(largest_difference(scene.truth->field, read.truth->field) < kDepthRounding);
    QCOMPARE(read.light_field->info().camera.shift, camera.shift);
  }
};

}  // namespace episcope::in_column_major_test

EPISCOPE_TEST(column_major_test, ColumnMajorTest)
#include "column_major_test.moc"
