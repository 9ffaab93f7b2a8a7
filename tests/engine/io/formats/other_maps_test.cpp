// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/hdf5_output.h"
#include "engine/io/open.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <algorithm>
#include <cmath>

namespace episcope::in_other_maps_test {

using namespace episcope::test;

namespace fs = std::filesystem;

namespace {

template <class T>
void add(io::Hdf5Output& file, const std::string& name, const ViewStack<T>& stack) {
  io::Hdf5Shape shape{
      static_cast<std::size_t>(stack.grid().v), static_cast<std::size_t>(stack.grid().u),
      static_cast<std::size_t>(stack.height()), static_cast<std::size_t>(stack.width())};
  if (stack.channels() > 1) shape.push_back(static_cast<std::size_t>(stack.channels()));
  file.add_dataset<T>(name, shape, "", "");
  file.write(name, {io::Hdf5Shape(shape.size(), 0), shape}, stack.data());
}

/// LF beside which others put theirs.
Scene opened_with(const fs::path& path, const Scene& scene, const auto& add_others) {
  {
    io::AtomicFile target(path);
    io::Hdf5Output file(target);
    add(file, "LF", bytes_of(scene));
    add_others(file);
    file.close();
    target.commit();
  }
  return io::open_scene(path, {}, Progress(1));
}

}  // namespace

/// Files whose views are called as in the archive, and their truth is not.
class OtherMapsTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  Scene scene_ = plane_scene();
  fs::path path() const { return fs::path(folder_->path().toStdString()) / "lf.h5"; }

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void disparity_isRead() {
    const Scene read = opened_with(path(), scene_, [&](io::Hdf5Output& file) {
      add(file, "disparity", scene_.truth->field.disparity);
    });

    QVERIFY(has_same_samples(read, scene_));
    QCOMPARE(largest_difference(read.truth->field, scene_.truth->field), 0.0);
    QVERIFY2(read.convention.units.find("disparity of disparity") != std::string::npos,
             read.convention.units.c_str());
  }

  void disparityOnItsSide_isTurnedWithAWarning() {
    const ViewStack<float>& maps = scene_.truth->field.disparity;
    ViewStack<float> turned(maps.grid(), maps.width(), maps.height());
    for (int i = 0; i < maps.grid().count(); ++i) {
      const ViewIndex view = maps.view_at(i);
      for (int y = 0; y < maps.height(); ++y) {
        for (int x = 0; x < maps.width(); ++x) {
          turned.view(view).at(x, y) = maps.view(view).at(y, x);
        }
      }
    }
    const Scene read =
        opened_with(path(), scene_, [&](io::Hdf5Output& file) { add(file, "disparity", turned); });

    QCOMPARE(largest_difference(read.truth->field, scene_.truth->field), 0.0);
    QVERIFY2(describe(read.convention).find("lie on their side") != std::string::npos,
             describe(read.convention).c_str());
  }

  void labels_areRead() {
    const Scene read = opened_with(path(), scene_, [&](io::Hdf5Output& file) {
      add(file, "semantic_labels", scene_.truth->labels);
    });

    const ViewStack<std::int32_t>& labels = scene_.truth->labels;
    QVERIFY(std::equal(labels.data(), labels.data() + labels.size(), read.truth->labels.data()));
  }

  // The views are valid all the same: it tells nothing of the other views.
  void maskOfOneView_isThatOfItsDisparity_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<bool>("is_of_missing");
    QTest::newRow("of known values") << "valid_mask" << false;
    QTest::newRow("of missing values, as NumPy's") << "mask" << true;
  }
  void maskOfOneView_isThatOfItsDisparity() {
    QFETCH(QString, name);
    QFETCH(bool, is_of_missing);
    const ViewIndex center = scene_.light_field->grid().center();
    const ImageView<const float> disparity = scene_.truth->field.disparity.view(center);
    ViewStack<float> map({1, 1}, disparity.height, disparity.width);
    std::copy_n(disparity.data, disparity.size(), map.data());
    ViewStack<std::uint8_t> mask({1, 1}, disparity.height, disparity.width);
    std::fill_n(mask.data(), mask.size(), static_cast<std::uint8_t>(is_of_missing ? 0 : 1));
    std::fill_n(mask.data(), disparity.width, static_cast<std::uint8_t>(is_of_missing ? 1 : 0));
    if (is_of_missing) std::fill_n(map.data(), disparity.width, std::nanf(""));

    const Scene read = opened_with(path(), scene_, [&](io::Hdf5Output& file) {
      const io::Hdf5Shape shape{static_cast<std::size_t>(map.height()),
                                static_cast<std::size_t>(map.width())};
      file.add_dataset<float>("disparity", shape, "", "");
      file.write("disparity", {{0, 0}, shape}, map.data());
      file.add_dataset<std::uint8_t>(name.toStdString(), shape, "", "");
      file.write(name.toStdString(), {{0, 0}, shape}, mask.data());
    });

    const DisparityView found = read.truth->field.view(center);
    QVERIFY(!found.is_valid(0, 3));
    QVERIFY(found.is_valid(1, 3));
    QVERIFY(read.light_field->is_valid(center, 0, 3));
  }

  void maskOfMissingValuesOfAllViews_leavesTheViewsValid() {
    ViewStack<float> maps = scene_.truth->field.disparity.clone();
    ViewStack<std::uint8_t> mask(maps.grid(), maps.height(), maps.width());
    for (std::size_t i = 0; i < maps.size(); i += 7) {
      maps.data()[i] = std::nanf("");
      mask.data()[i] = 1;
    }

    const Scene read = opened_with(path(), scene_, [&](io::Hdf5Output& file) {
      add(file, "disparity", maps);
      add(file, "mask", mask);
    });

    QVERIFY(read.light_field->is_valid({}, 0, 0));
    QVERIFY(!read.truth->field.view({}).is_valid(0, 0));
    QVERIFY(read.truth->field.view({}).is_valid(0, 1));
  }

  void brighterViewsOfWideIntegers_areKept() {
    const ViewStack<std::uint8_t>& bytes = bytes_of(scene_);
    ViewStack<std::int32_t> wide(bytes.grid(), bytes.height(), bytes.width(), bytes.channels());
    std::copy_n(bytes.data(), bytes.size(), wide.data());
    wide.data()[wide.size() - 1] = 300;
    {
      io::AtomicFile target(path());
      io::Hdf5Output file(target);
      add(file, "LF", wide);
      file.close();
      target.commit();
    }

    const Scene read = io::open_scene(path(), {.levels = "0,65535"}, Progress(1));

    const auto& words = std::get<ViewStack<std::uint16_t>>(read.light_field->samples());
    QCOMPARE(words.data()[words.size() - 1], std::uint16_t{300});
  }

  void depthOfAnotherName_isDepth() {
    const CameraGrid& camera = scene_.light_field->info().camera;
    ViewStack<float> depth = scene_.truth->field.disparity.clone();
    std::transform(depth.data(), depth.data() + depth.size(), depth.data(),
                   [&](float d) { return static_cast<float>(camera.depth_from_disparity(d)); });
    const Scene read = opened_with(path(), scene_, [&](io::Hdf5Output& file) {
      add(file, "depth", depth);
      // As text, as some writers store all attributes.
      file.set_text("/", "dH", std::to_string(camera.baseline));
      file.set_text("/", "focalLength", std::to_string(camera.focal_length));
      file.set_text("/", "shift", std::to_string(camera.shift));
    });

    // Depth was rounded to float: see archive_test.
    QVERIFY(largest_difference(read.truth->field, scene_.truth->field) < 2e-6);
  }

  void whatIsNotUnderstood_isSaid() {
    const Scene read = opened_with(path(), scene_, [&](io::Hdf5Output& file) {
      add(file, "flow", scene_.truth->field.disparity);
    });

    const auto use = std::ranges::find(read.convention.files, "flow", &FileUse::example);
    QVERIFY(use != read.convention.files.end() && !use->is_used);
    QVERIFY(!read.truth->has_disparity());
  }
};

}  // namespace episcope::in_other_maps_test

EPISCOPE_TEST(other_maps_test, OtherMapsTest)
#include "other_maps_test.moc"
