// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/hdf5_repack.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/open.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <hdf5.h>
#include <QTemporaryDir>

#include <array>
#include <vector>

namespace episcope::in_repacked_archive_test {

using namespace episcope::test;

namespace fs = std::filesystem;

namespace {

constexpr std::array<hsize_t, 5> kShape{3, 3, 64, 80, 3};

/// Stores the views of a scene as the dataset `name`, in chunks, as another program does.
void write_views(const fs::path& path, const char* name, const Scene& scene,
                 std::array<hsize_t, 5> chunk) {
  const hid_t file = fs::exists(path)
                         ? H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT)
                         : H5Fcreate(path.c_str(), H5F_ACC_EXCL, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t space = H5Screate_simple(5, kShape.data(), nullptr);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_chunk(creation, 5, chunk.data());
  H5Pset_shuffle(creation);
  H5Pset_deflate(creation, 4);
  const hid_t dataset =
      H5Dcreate2(file, name, H5T_NATIVE_UINT8, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  H5Dwrite(dataset, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes_of(scene).data());
  H5Dclose(dataset);
  H5Pclose(creation);
  H5Sclose(space);
  H5Fclose(file);
}

/// LF, made of the dataset "views" of another file, or "." for the same one.
void write_virtual(const fs::path& path, const char* source) {
  const hid_t file = fs::exists(path)
                         ? H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT)
                         : H5Fcreate(path.c_str(), H5F_ACC_EXCL, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t space = H5Screate_simple(5, kShape.data(), nullptr);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_virtual(creation, space, source, "/views", space);
  const hid_t dataset =
      H5Dcreate2(file, "LF", H5T_NATIVE_UINT8, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  H5Dclose(dataset);
  H5Pclose(creation);
  H5Sclose(space);
  H5Fclose(file);
}

QString refusal_of(const fs::path& path) {
  try {
    (void)io::open_scene(path, {}, Progress(2));
  } catch (const IoError& error) {
    return error.what();
  }
  return {};
}

H5D_layout_t layout_of(const fs::path& path, const char* name) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT);
  const hid_t creation = H5Dget_create_plist(dataset);
  const H5D_layout_t layout = H5Pget_layout(creation);
  H5Pclose(creation);
  H5Dclose(dataset);
  H5Fclose(file);
  return layout;
}

}  // namespace

class RepackedArchiveTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  const Scene scene_ = plane_scene({.grid = {3, 3}});

  fs::path path(const std::string& name) const {
    return fs::path(folder_->path().toStdString()) / name;
  }

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void virtualLightFieldOfOneFile_opens() {
    write_views(path("lf.h5"), "views", scene_, {1, 1, 64, 80, 3});
    write_virtual(path("lf.h5"), ".");

    QVERIFY(
        has_same_samples(scene_, io::open_scene(path("lf.h5"), {.dataset = "LF"}, Progress(2))));
  }

  void virtualLightFieldOfOtherFiles_opensOnceRepacked() {
    write_views(path("part.h5"), "views", scene_, {1, 1, 64, 80, 3});
    write_virtual(path("lf.h5"), "part.h5");

    const QString refusal = refusal_of(path("lf.h5"));
    io::repack_hdf5(path("lf.h5"), path("whole.h5"), Progress(2));
    fs::remove(path("part.h5"));

    QVERIFY2(refusal.contains("episcope-cli convert --repack"), qPrintable(refusal));
    QVERIFY(has_same_samples(scene_, io::open_scene(path("whole.h5"), {}, Progress(2))));
  }

  void missingPart_isNamed() {
    write_virtual(path("lf.h5"), "part.h5");

    try {
      io::repack_hdf5(path("lf.h5"), path("whole.h5"), Progress(2));
      QFAIL("zeros were written");
    } catch (const IoError& error) {
      QVERIFY2(QString(error.what()).contains("LF has samples in the file part.h5"), error.what());
    }
    QVERIFY(!fs::exists(path("whole.h5")));
  }

  void smallChunks_becomeOneArray_data() {
    QTest::addColumn<int>("side");
    QTest::newRow("whole views") << 64;
    QTest::newRow("small") << 7;
  }
  void smallChunks_becomeOneArray() {
    QFETCH(int, side);
    const auto length = static_cast<hsize_t>(side);
    write_views(path("lf.h5"), "LF", scene_, {1, 3, length, length, 3});

    io::repack_hdf5(path("lf.h5"), path("whole.h5"), Progress(2));

    QCOMPARE(layout_of(path("lf.h5"), "LF"), H5D_CHUNKED);
    QCOMPARE(layout_of(path("whole.h5"), "LF"), H5D_CONTIGUOUS);
    QVERIFY(has_same_samples(scene_, io::open_scene(path("whole.h5"), {}, Progress(2))));
  }

  void whatIsBesideTheViews_isKept() {
    io::write_archive(path("lf.h5"), scene_, Progress(2), {});

    io::repack_hdf5(path("lf.h5"), path("whole.h5"), Progress(2));

    const Scene read = io::open_scene(path("whole.h5"), {}, Progress(2));
    QVERIFY(has_same_samples(scene_, read));
    QCOMPARE(read.light_field->info().camera.shift, scene_.light_field->info().camera.shift);
    QVERIFY(largest_difference(scene_.truth->field, read.truth->field) < 1e-5);
  }
};

}  // namespace episcope::in_repacked_archive_test

EPISCOPE_TEST(repacked_archive_test, RepackedArchiveTest)
#include "repacked_archive_test.moc"
