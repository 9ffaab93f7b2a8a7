// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/hdf5_output.h"
#include "engine/io/base/npy.h"
#include "engine/io/open.h"
#include "tests/engine/io/formats/array_files.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <fmt/format.h>
#include <QTemporaryDir>

#include <algorithm>
#include <functional>
#include <set>

namespace episcope::in_joined_arrays_test {

using namespace episcope::test;

namespace fs = std::filesystem;

namespace {

using Name = std::function<std::string(ViewIndex view, int index)>;

Scene reference(GridShape grid) {
  PlaneOptions options;
  options.grid = grid;
  options.d0 = 1.3;
  return plane_scene(options);
}

io::Hdf5Shape view_shape(const ViewStack<std::uint8_t>& views) {
  return {static_cast<std::size_t>(views.height()), static_cast<std::size_t>(views.width()),
          static_cast<std::size_t>(views.channels())};
}

/// An HDF5 file with a dataset for each view, but one, and others.
void write_views(const fs::path& path, const Scene& scene, const Name& name, int without = -1,
                 const std::function<void(io::Hdf5Output&)>& others = {}) {
  const ViewStack<std::uint8_t>& views = bytes_of(scene);
  io::AtomicFile target(path);
  io::Hdf5Output file(target);
  std::set<std::string> groups;
  for (int i = 0; i < views.grid().count(); ++i) {
    if (i == without) continue;
    const std::string dataset = name(views.view_at(i), i);
    const std::size_t slash = dataset.rfind('/');
    if (slash != std::string::npos && groups.insert(dataset.substr(0, slash)).second) {
      file.add_group(dataset.substr(0, slash));
    }
    file.add_dataset<std::uint8_t>(dataset, view_shape(views), "", "");
    file.write(dataset, {{0, 0, 0}, view_shape(views)}, views.view(views.view_at(i)).data);
  }
  if (others) others(file);
  file.close();
  target.commit();
}

std::string refusal_of(const fs::path& path) {
  try {
    (void)io::open_scene(path, {}, Progress(1));
  } catch (const IoError& error) {
    return error.what();
  }
  return "it was read";
}

}  // namespace

/// Files in which views or channels are arrays of their own.
class JoinedArraysTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  fs::path path(const std::string& name) const {
    return fs::path(folder_->path().toStdString()) / name;
  }

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void datasetsOfViews_areOneLightField_data() {
    QTest::addColumn<QString>("name");
    for (const char* name : {"view_{0:02}_{1:02}", "{0}/{1}", "views/cam_{1}_{0}", "v{2:03}"}) {
      QTest::newRow(name) << name;
    }
  }
  void datasetsOfViews_areOneLightField() {
    QFETCH(QString, name);
    const std::string form = name.toStdString();
    const Scene scene = reference({5, 5});
    write_views(path("lf.h5"), scene, [&](ViewIndex view, int index) {
      return fmt::format(fmt::runtime(form), view.v, view.u, index);
    });

    io::OpenOptions options;
    // What a plane shows does not tell the rows of a list.
    if (name.contains("{2")) options.grid = "5x5";
    const Scene read = io::open_scene(path("lf.h5"), options, Progress(1));

    QVERIFY2(has_same_samples(read, scene), describe(read.convention).c_str());
  }

  void mapsOfViews_areTruth() {
    const Scene scene = reference({5, 7});
    const ViewStack<float>& disparity = scene.truth->field.disparity;
    const auto add_maps = [&](io::Hdf5Output& file) {
      file.add_group("disparity");
      for (int i = 0; i < disparity.grid().count(); ++i) {
        const ViewIndex view = disparity.view_at(i);
        const std::string name = fmt::format("disparity/{}_{}", view.v + 1, view.u + 1);
        file.add_dataset<float>(name, {64, 80}, "", "");
        file.write(name, {{0, 0}, {64, 80}}, disparity.view(view).data);
      }
    };
    write_views(
        path("lf.h5"), scene,
        [](ViewIndex view, int) { return fmt::format("views/{}_{}", view.v + 1, view.u + 1); }, -1,
        add_maps);

    const Scene read = io::open_scene(path("lf.h5"), {}, Progress(1));

    QVERIFY2(has_same_samples(read, scene), describe(read.convention).c_str());
    QCOMPARE(largest_difference(read.truth->field, scene.truth->field), 0.0);
  }

  void missingView_leavesTheLargestPart() {
    const Scene scene = reference({5, 5});
    const auto name = [](ViewIndex view, int) { return fmt::format("v_{}_{}", view.v, view.u); };
    write_views(path("lf.h5"), scene, name, 7);

    const Scene read = io::open_scene(path("lf.h5"), {}, Progress(1));

    QCOMPARE(read.light_field->grid(), (GridShape{3, 5}));
    const auto& views = bytes_of(read);
    QVERIFY(
        std::equal(views.data(), views.data() + views.size(), bytes_of(scene).view({2, 0}).data));
    const auto is_told = [](const std::string& text) {
      return text.starts_with("Of a grid of 5×5 view 1,2 is missing");
    };
    QVERIFY2(std::ranges::any_of(read.convention.warnings, is_told),
             describe(read.convention).c_str());
  }

  void missingViewOfFour_isNamed() {
    const auto name = [](ViewIndex view, int) { return fmt::format("v_{}_{}", view.v, view.u); };
    write_views(path("lf.h5"), reference({2, 2}), name, 2);

    const std::string why = refusal_of(path("lf.h5"));

    QVERIFY2(why.find("view 1,0 is missing") != std::string::npos, why.c_str());
  }

  void folderOfArrays_isOneLightField() {
    const Scene scene = reference({5, 7});
    const ViewStack<std::uint8_t>& views = bytes_of(scene);
    const ViewStack<float>& disparity = scene.truth->field.disparity;
    for (int i = 0; i < views.grid().count(); ++i) {
      const ViewIndex view = views.view_at(i);
      const std::string name = fmt::format("{:02}_{:02}.npy", view.v, view.u);
      const auto* samples = views.view(view).data;
      const auto* map = disparity.view(view).data;
      io::write_npy<std::uint8_t>(path("view_" + name), {64, 80, 3},
                                  std::vector(samples, samples + views.view_size()));
      io::write_npy<float>(path("disparity_" + name), {64, 80},
                           std::vector(map, map + disparity.view_size()));
    }

    const Scene read = io::open_scene(path(""), {}, Progress(1));

    QVERIFY2(has_same_samples(read, scene), describe(read.convention).c_str());
    QCOMPARE(largest_difference(read.truth->field, scene.truth->field), 0.0);
  }

  void folderOfMaps_isNoLightField() {
    for (int i = 0; i < 9; ++i) {
      io::write_npy<float>(path(fmt::format("{}_{}.npy", i / 3, i % 3)), {8, 9},
                           std::vector<float>(72));
    }

    QVERIFY_THROWS_EXCEPTION(Error, (void)io::open_scene(path(""), {}, Progress(1)));
  }

  void mapBesideViewsOfAnotherForm_isNoLightField() {
    {
      io::AtomicFile target(path("lf.h5"));
      io::Hdf5Output file(target);
      file.add_dataset<std::uint8_t>("x", {5, 5, 40, 48, 2}, "", "");
      file.add_dataset<float>("disp", {5, 5, 40, 48}, "", "");
      file.close();
      target.commit();
    }

    const std::string why = refusal_of(path("lf.h5"));

    QVERIFY2(why.find("which holds disp, x") != std::string::npos, why.c_str());
  }

  void planesAtTheTop_areOneLightField_data() {
    QTest::addColumn<QString>("names");
    QTest::newRow("r") << "r g b";
    QTest::newRow("R") << "R G B";
    QTest::newRow("red") << "lf_red lf_green lf_blue";
    QTest::newRow("run together") << "lfr lfg lfb";
  }
  void planesAtTheTop_areOneLightField() {
    QFETCH(QString, names);
    const Scene scene = reference({5, 7});
    const auto planes = in_axes(bytes_of(scene), "cvuyx");
    const auto shape = lengths_of(bytes_of(scene), "vuyx");
    {
      io::AtomicFile target(path("lf.h5"));
      io::Hdf5Output file(target);
      std::size_t first = 0;
      for (const QString& name : names.split(' ')) {
        file.add_dataset<std::uint8_t>(name.toStdString(), shape, "", "");
        file.write(name.toStdString(), {{0, 0, 0, 0}, shape}, planes.data() + first);
        first += planes.size() / 3;
      }
      file.close();
      target.commit();
    }

    const Scene read = io::open_scene(path("lf.h5"), {}, Progress(1));

    QVERIFY2(has_same_samples(read, scene), describe(read.convention).c_str());
  }

  void archiveOfViews_isOneLightField() {
    const Scene scene = reference({5, 7});
    const ViewStack<std::uint8_t>& views = bytes_of(scene);
    std::vector<ZippedFile> files;
    for (int i = 0; i < views.grid().count(); ++i) {
      const ViewIndex view = views.view_at(i);
      io::write_npy<std::uint8_t>(path("view.npy"), view_shape(views),
                                  {views.view(view).data, views.view_size()});
      files.push_back({fmt::format("{}_{}.npy", view.v, view.u), bytes_of_file(path("view.npy"))});
    }
    write_deflated_zip(path("lf.npz"), files);

    QVERIFY(has_same_samples(io::open_scene(path("lf.npz"), {}, Progress(1)), scene));
  }

  void cellsOfMatlab_areOneLightField_data() {
    QTest::addColumn<bool>("compressed");
    QTest::addColumn<bool>("are_structs");
    QTest::newRow("plain") << false << false;
    QTest::newRow("compressed") << true << false;
    QTest::newRow("array of structs") << false << true;
  }
  void cellsOfMatlab_areOneLightField() {
    QFETCH(bool, compressed);
    QFETCH(bool, are_structs);
    const Scene scene = reference({5, 7});
    write_mat5_cells(path("lf.mat"), bytes_of(scene), compressed,
                     are_structs ? Mat5Views::Structs : Mat5Views::Cells);

    const Scene read = io::open_scene(path("lf.mat"), {}, Progress(1));

    QVERIFY2(has_same_samples(read, scene), describe(read.convention).c_str());
  }

  void furtherAxesOfLengthOne_meanNothing() {
    const Scene scene = reference({5, 7});
    auto shape = lengths_of(bytes_of(scene), "vucyx");
    shape.insert(shape.begin(), 1);
    io::write_npy<std::uint8_t>(path("lf.npy"), shape, in_axes(bytes_of(scene), "vucyx"));

    const ViewStack<float>& disparity = scene.truth->field.disparity;
    io::write_npy<float>(path("disparity.npy"), {1, 5, 7, 64, 80},
                         {disparity.data(), disparity.size()});

    const Scene read = io::open_scene(path("lf.npy"), {}, Progress(1));

    QVERIFY2(has_same_samples(read, scene), describe(read.convention).c_str());
    QCOMPARE(largest_difference(read.truth->field, scene.truth->field), 0.0);
  }
};

}  // namespace episcope::in_joined_arrays_test

EPISCOPE_TEST(joined_arrays_test, JoinedArraysTest)
#include "joined_arrays_test.moc"
