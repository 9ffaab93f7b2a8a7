// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/io/base/hdf5_output.h"
#include "engine/io/models/reader.h"
#include "engine/io/open.h"
#include "tests/engine/io/archive_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <algorithm>
#include <functional>

namespace episcope::in_mosaic_dataset_test {

using namespace episcope::test;

namespace fs = std::filesystem;

namespace {

/// Luminance in 0 … 1 of a plane.
ViewStack<float> luminance() {
  const Scene scene = plane_scene({.grid = {3, 5}, .channels = 1});
  const ViewStack<std::uint8_t>& bytes = bytes_of(scene);
  ViewStack<float> views(bytes.grid(), bytes.height(), bytes.width());
  std::transform(bytes.data(), bytes.data() + bytes.size(), views.data(),
                 [](std::uint8_t sample) { return static_cast<float>(sample) / 255; });
  return views;
}

/// Views side by side.
Image<float> side_by_side(const ViewStack<float>& views) {
  const GridShape grid = views.grid();
  Image<float> picture(grid.v * views.height(), grid.u * views.width());
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const ViewIndex view{y / views.height(), x / views.width()};
      picture.at(y, x) = views.view(view).at(y % views.height(), x % views.width());
    }
  }
  return picture;
}

void add(io::Hdf5Output& file, const std::string& name, const Image<float>& picture) {
  const io::Hdf5Shape shape{static_cast<std::size_t>(picture.height()),
                            static_cast<std::size_t>(picture.width())};
  file.add_dataset<float>(name, shape, "", "");
  file.write(name, {{0, 0}, shape}, picture.data());
}

void write(const fs::path& path, const std::function<void(io::Hdf5Output&)>& fill) {
  io::AtomicFile target(path);
  io::Hdf5Output file(target);
  fill(file);
  file.close();
  target.commit();
}

bool is_same(const Scene& read, const ViewStack<float>& views) {
  const LightField& field = *read.light_field;
  if (!(field.grid() == views.grid()) || field.channels() != 1) return false;
  const auto& samples = std::get<ViewStack<float>>(field.samples());
  return std::equal(views.data(), views.data() + views.size(), samples.data(),
                    [](float a, float b) { return std::abs(a - b) < 1e-6F; });
}

}  // namespace

/// HDF5 files of which a dataset of two axes holds all views, as data for super-resolution do.
class MosaicDatasetTest : public QObject, private ArchiveFolder {
  Q_OBJECT

 private:
  ViewStack<float> views_ = luminance();
  Image<float> picture_ = side_by_side(views_);

  /// As the scripts of BasicLFSR write it: by columns, with a small one beside it.
  void write_pair(const std::function<void(io::Hdf5Output&)>& more = [](auto&) {}) const {
    write(path("pair.h5"), [&](io::Hdf5Output& file) {
      add(file, "Lr_SAI_y", Image<float>(160, 96));
      add(file, "Hr_SAI_y", transposed(picture_));
      more(file);
    });
  }
  std::string refusal(const char* name, const io::OpenOptions& options = {}) const {
    try {
      (void)open(path(name), options);
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  }

 private slots:
  void init() { renew(); }

  void superResolutionPair_isReadWithAGivenGrid() {
    write_pair();

    const Scene read = open(path("pair.h5"), {.grid = "3x5"});

    QVERIFY2(is_same(read, views_), describe(read.convention).c_str());
    const std::string& format = read.convention.format;
    QVERIFY2(format.find("Hr_SAI_y, stored by columns") != std::string::npos, format.c_str());
    QCOMPARE(read.convention.files.size(), std::size_t{2});
    QCOMPARE(read.convention.files[1].example, std::string("Lr_SAI_y"));
    QVERIFY(!read.convention.files[1].is_used);
  }

  void grid_isFoundByTheLikenessOfTheViews() {
    write_pair();

    QVERIFY(is_same(open(path("pair.h5")), views_));
  }

  void grid_isTakenFromAnAttribute() {
    write_pair([](io::Hdf5Output& file) { file.set_numbers("/", "grid", {3, 5}); });

    const Scene read = open(path("pair.h5"));

    QVERIFY(is_same(read, views_));
    const std::string& format = read.convention.format;
    QVERIFY2(format.find("as an attribute says") != std::string::npos, format.c_str());
    const io::FoundReader found = io::find_reader(path("pair.h5"), {});
    QCOMPARE(found.reader->probe(found.path, {}).grid, (GridShape{3, 5}));
  }

  void unknownGrid_isAskedForByItsOption() {
    write(path("flat.h5"),
          [&](io::Hdf5Output& file) { add(file, "Lr_SAI_y", Image<float>(160, 96, 1, 0.5F)); });

    const std::string said = refusal("flat.h5");

    QVERIFY2(said.find("the dataset Lr_SAI_y of 160×96 px") != std::string::npos, said.c_str());
    QVERIFY2(said.find("--grid") != std::string::npos, said.c_str());
  }

  void datasetOfAnotherName_isReadIfAskedFor() {
    write(path("data.h5"), [&](io::Hdf5Output& file) {
      add(file, "data", picture_);
      add(file, "other", Image<float>(9, 9));
    });

    const std::string said = refusal("data.h5");
    const Scene read =
        open(path("data.h5"), {.grid = "3x5", .mosaic = io::Mosaic::Views, .dataset = "data"});

    QVERIFY2(said.find("--mosaic views and --grid") != std::string::npos, said.c_str());
    QVERIFY2(is_same(read, views_), describe(read.convention).c_str());
  }
};

}  // namespace episcope::in_mosaic_dataset_test

EPISCOPE_TEST(mosaic_dataset_test, MosaicDatasetTest)
#include "mosaic_dataset_test.moc"
