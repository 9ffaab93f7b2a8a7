// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/hdf5_output.h"
#include "engine/io/models/reader.h"
#include "tests/engine/io/archive_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <algorithm>
#include <functional>

namespace episcope::in_grouped_archive_test {

using namespace episcope::test;

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

ViewStack<float> depth_of(const Scene& scene) {
  const CameraGrid& camera = scene.light_field->info().camera;
  ViewStack<float> depth = scene.truth->field.disparity.clone();
  std::transform(depth.data(), depth.data() + depth.size(), depth.data(),
                 [&](float d) { return static_cast<float>(camera.depth_from_disparity(d)); });
  return depth;
}

}  // namespace

/// Files of the archive whose datasets lie in a group.
class GroupedArchiveTest : public QObject, private ArchiveFolder {
  Q_OBJECT

 private:
  Scene scene_ = plane_scene();

  void write(const std::string& attributes, const std::function<void(io::Hdf5Output&)>& more) {
    io::AtomicFile target(path("scene.h5"));
    io::Hdf5Output file(target);
    file.add_group("scene");
    add(file, "scene/LF", bytes_of(scene_));
    const CameraGrid& camera = scene_.light_field->info().camera;
    file.set_number(attributes, "dH", camera.baseline);
    file.set_number(attributes, "focalLength", camera.focal_length);
    file.set_number(attributes, "shift", camera.shift);
    more(file);
    file.close();
    target.commit();
  }

 private slots:
  void init() { renew(); }

  void depthInTheGroup_isReadAsThatOfTheArchive_data() {
    QTest::addColumn<QString>("attributes");
    QTest::newRow("attributes of the group") << "scene";
    QTest::newRow("attributes of the root") << "/";
    QTest::newRow("attributes of LF") << "scene/LF";
  }
  void depthInTheGroup_isReadAsThatOfTheArchive() {
    QFETCH(QString, attributes);
    write(attributes.toStdString(), [&](io::Hdf5Output& file) {
      add(file, "scene/GT_DEPTH", depth_of(scene_));
      add(file, "scene/GT_LABELS", scene_.truth->labels);
    });

    const Scene read = open(path("scene.h5"));

    QVERIFY(has_same_samples(read, scene_));
    QVERIFY2(largest_difference(read.truth->field, scene_.truth->field) < kDepthRounding,
             describe(read.convention).c_str());
    QVERIFY(std::equal(read.truth->labels.data(),
                       read.truth->labels.data() + read.truth->labels.size(),
                       scene_.truth->labels.data()));
    const std::string& format = read.convention.format;
    QVERIFY2(format.find("scene.h5, group scene") != std::string::npos, format.c_str());
  }

  void headers_tellTheDepth() {
    write("/", [&](io::Hdf5Output& file) { add(file, "scene/GT_DEPTH", depth_of(scene_)); });

    const io::FoundReader found = io::find_reader(path("scene.h5"), {});

    QCOMPARE(found.reader->probe(found.path, {}).truth, std::string("depth of all views"));
  }

  void folderWithTheFile_opensIt() {
    write("/", [&](io::Hdf5Output& file) { add(file, "scene/GT_DEPTH", depth_of(scene_)); });

    QVERIFY(open(path()).truth->has_disparity());
  }

  void lightFieldsInSeveralGroups_openOneByOne() {
    write("/", [&](io::Hdf5Output& file) {
      add(file, "scene/GT_DEPTH", depth_of(scene_));
      file.add_group("other");
      add(file, "other/LF", bytes_of(scene_));
    });

    QCOMPARE(open(path("scene.h5")).sequence.count, 2);
  }
};

}  // namespace episcope::in_grouped_archive_test

EPISCOPE_TEST(grouped_archive_test, GroupedArchiveTest)
#include "grouped_archive_test.moc"
