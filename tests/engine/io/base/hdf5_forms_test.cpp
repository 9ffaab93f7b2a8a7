// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/hdf5_file.h"
#include "engine/io/open.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <hdf5.h>
#include <lzf.h>
#include <QTemporaryDir>

#include <array>
#include <cmath>
#include <thread>

namespace episcope::in_hdf5_forms_test {

using namespace episcope::test;

namespace {

/// A file made by the library itself, in the ways in which other programs make them.
class HandMadeFile {
 public:
  explicit HandMadeFile(const std::filesystem::path& path)
      : file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)) {}
  ~HandMadeFile() { H5Fclose(file_); }
  HandMadeFile(const HandMadeFile&) = delete;
  HandMadeFile& operator=(const HandMadeFile&) = delete;

  void attribute(const char* name, hid_t type, const void* value, bool is_array) const {
    const hsize_t one = 1;
    const hid_t space = is_array ? H5Screate_simple(1, &one, nullptr) : H5Screate(H5S_SCALAR);
    const hid_t id = H5Acreate2(file_, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(id, type, value);
    H5Aclose(id);
    H5Sclose(space);
  }

  void dataset(const char* name, hid_t type, hid_t memory_type, const std::vector<hsize_t>& shape,
               const std::vector<hsize_t>& chunk, const void* samples) const {
    const int rank = static_cast<int>(shape.size());
    const hid_t space = H5Screate_simple(rank, shape.data(), nullptr);
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    if (!chunk.empty()) {
      H5Pset_chunk(creation, rank, chunk.data());
      H5Pset_deflate(creation, 4);
    }
    const hid_t id = H5Dcreate2(file_, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    H5Dwrite(id, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, samples);
    H5Dclose(id);
    H5Pclose(creation);
    H5Sclose(space);
  }

 private:
  hid_t file_;
};

/// LF as h5py stores it with compression="lzf": a chunk a view, compressed where that gains
/// something.
void write_lzf(const std::filesystem::path& path, const ViewStack<std::uint8_t>& views) {
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const std::array<hsize_t, 5> shape{5, 5, 64, 80, 3};
  const std::array<hsize_t, 5> chunk{1, 1, 64, 80, 3};
  const auto bytes = static_cast<unsigned>(views.view_size());
  const std::array<unsigned, 3> values{4, 0x0105, bytes};
  const hid_t space = H5Screate_simple(5, shape.data(), nullptr);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_chunk(creation, 5, chunk.data());
  H5Pset_filter(creation, 32000, H5Z_FLAG_OPTIONAL, values.size(), values.data());
  const hid_t set =
      H5Dcreate2(file, "LF", H5T_NATIVE_UINT8, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  for (int i = 0; i < views.grid().count(); ++i) {
    const ViewIndex view = views.view_at(i);
    const std::uint8_t* samples = views.view(view).data;
    std::vector<std::uint8_t> packed(bytes);
    const unsigned size = lzf_compress(samples, bytes, packed.data(), bytes - 1);
    const std::array<hsize_t, 5> at{static_cast<hsize_t>(view.v), static_cast<hsize_t>(view.u)};
    H5Dwrite_chunk(set, H5P_DEFAULT, size > 0 ? 0 : 1, at.data(), size > 0 ? size : bytes,
                   size > 0 ? packed.data() : samples);
  }
  H5Dclose(set);
  H5Pclose(creation);
  H5Sclose(space);
  H5Fclose(file);
}

/// The enumeration by which other programs store booleans.
hid_t boolean_type() {
  const hid_t type = H5Tenum_create(H5T_NATIVE_INT8);
  std::int8_t value = 0;
  H5Tenum_insert(type, "FALSE", &value);
  value = 1;
  H5Tenum_insert(type, "TRUE", &value);
  return type;
}

std::vector<double> depth_of(const Scene& scene) {
  const ViewStack<float>& disparity = scene.truth->field.disparity;
  std::vector<double> depth;
  for (std::size_t i = 0; i < disparity.size(); ++i) {
    depth.push_back(scene.light_field->info().camera.depth_from_disparity(disparity.data()[i]));
  }
  return depth;
}

}  // namespace

/// Files as h5py, MATLAB and the tools of the archive write them.
class Hdf5FormsTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  std::filesystem::path path() const {
    return std::filesystem::path(folder_->path().toStdString()) / "lf.h5";
  }

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void attributes_areReadInAnyScalarType_data() {
    QTest::addColumn<int>("kind");
    QTest::addColumn<bool>("is_array");
    const char* names[] = {"int8", "uint16", "int64", "float32", "float64", "big-endian float"};
    for (int kind = 0; kind < 6; ++kind) {
      for (const bool is_array : {false, true}) {
        QTest::addRow("%s, %s", names[kind], is_array ? "length 1" : "scalar") << kind << is_array;
      }
    }
  }
  void attributes_areReadInAnyScalarType() {
    QFETCH(int, kind);
    QFETCH(bool, is_array);
    const std::int8_t int8 = 42;
    const std::uint16_t uint16 = 42;
    const std::int64_t int64 = 42;
    const float float32 = 42;
    const double float64 = 42;
    const std::uint32_t big_endian = __builtin_bswap32(0x42280000U);  // 42.0F
    {
      const std::pair<hid_t, const void*> forms[] = {
          {H5T_NATIVE_INT8, &int8},      {H5T_NATIVE_UINT16, &uint16},
          {H5T_NATIVE_INT64, &int64},    {H5T_NATIVE_FLOAT, &float32},
          {H5T_NATIVE_DOUBLE, &float64}, {H5T_IEEE_F32BE, &big_endian}};
      const HandMadeFile file(path());
      file.attribute("dH", forms[kind].first, forms[kind].second, is_array);
    }

    QCOMPARE(io::Hdf5Input(path()).number("/", "dH"), std::optional(42.0));
    QCOMPARE(io::Hdf5Input(path()).number("/", "none"), std::optional<double>());
  }

  void lightField_opensInAnyLayout_data() {
    QTest::addColumn<bool>("is_wide");
    QTest::addColumn<std::vector<hsize_t>>("chunk");
    QTest::newRow("contiguous") << false << std::vector<hsize_t>{};
    QTest::newRow("a view a chunk") << false << std::vector<hsize_t>{1, 1, 64, 80, 3};
    QTest::newRow("chunks over views") << false << std::vector<hsize_t>{2, 3, 30, 40, 1};
    QTest::newRow("64-bit samples") << true << std::vector<hsize_t>{};
  }
  void lightField_opensInAnyLayout() {
    QFETCH(bool, is_wide);
    QFETCH(std::vector<hsize_t>, chunk);
    const Scene scene = plane_scene();
    {
      const HandMadeFile file(path());
      file.dataset("LF", is_wide ? H5T_NATIVE_INT64 : H5T_NATIVE_UINT8, H5T_NATIVE_UINT8,
                   {5, 5, 64, 80, 3}, chunk, bytes_of(scene).data());
    }

    QVERIFY(has_same_samples(scene, io::open_scene(path(), {}, Progress(1))));
  }

  void samplesPackedByLzf_areRead() {
    // Stripes, which LZF finds, and a texture, which it does not.
    const Scene scene = plane_scene();
    ViewStack<std::uint8_t> views = bytes_of(scene).clone();
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 80 * 3; ++x) views.view({2, 2}).row(y)[x] = static_cast<std::uint8_t>(y);
    }
    write_lzf(path(), views);

    const Scene read = io::open_scene(path(), {}, Progress(1));

    const auto& samples = std::get<ViewStack<std::uint8_t>>(read.light_field->samples());
    QVERIFY(std::equal(views.data(), views.data() + views.size(), samples.data()));
  }

  void damagedLzf_isRefused() {
    write_lzf(path(), bytes_of(plane_scene()));
    {
      const hid_t file = H5Fopen(path().c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
      const hid_t set = H5Dopen2(file, "LF", H5P_DEFAULT);
      const std::array<hsize_t, 5> at{4, 4};
      // A reference to before the beginning.
      const std::vector<std::uint8_t> packed(100, 0xFF);
      H5Dwrite_chunk(set, H5P_DEFAULT, 0, at.data(), packed.size(), packed.data());
      H5Dclose(set);
      H5Fclose(file);
    }

    QVERIFY_THROWS_EXCEPTION(IoError, (void)io::open_scene(path(), {}, Progress(1)));
  }

  void alphaChannel_tellsInvalidPixels_data() {
    QTest::addColumn<int>("transparent");
    QTest::newRow("opaque") << 0;
    QTest::newRow("a corner of the first view") << 7;
  }
  void alphaChannel_tellsInvalidPixels() {
    QFETCH(int, transparent);
    const Scene scene = plane_scene();
    std::vector<std::uint8_t> rgba;
    for (std::size_t i = 0; i < bytes_of(scene).size(); i += 3) {
      const std::uint8_t* rgb = bytes_of(scene).data() + i;
      const bool is_seen = i / 3 >= static_cast<std::size_t>(transparent);
      rgba.insert(rgba.end(),
                  {rgb[0], rgb[1], rgb[2], static_cast<std::uint8_t>(is_seen ? 255 : 0)});
    }
    {
      const HandMadeFile file(path());
      file.dataset("LF", H5T_NATIVE_UINT8, H5T_NATIVE_UINT8, {5, 5, 64, 80, 4}, {}, rgba.data());
    }

    const Scene read = io::open_scene(path(), {.flip = io::Flip::None}, Progress(1));
    QVERIFY(has_same_samples(scene, read));
    const ViewStack<std::uint8_t>& valid = read.light_field->valid();
    QCOMPARE(valid.empty(), transparent == 0);
    if (valid.empty()) return;
    QCOMPARE(std::count(valid.data(), valid.data() + valid.size(), std::uint8_t{0}),
             std::ptrdiff_t{transparent});
    QCOMPARE(valid.view({0, 0}).at(0, transparent - 1), std::uint8_t{0});
  }

  void booleanMaskAndDoubleDepth_areRead() {
    const Scene scene = plane_scene();
    std::vector<std::int8_t> mask(std::size_t{5} * 5 * 64 * 80, 1);
    mask[11] = 0;
    const CameraGrid& camera = scene.light_field->info().camera;
    {
      const HandMadeFile file(path());
      const hid_t boolean = boolean_type();
      file.dataset("LF", H5T_NATIVE_UINT8, H5T_NATIVE_UINT8, {5, 5, 64, 80, 3}, {},
                   bytes_of(scene).data());
      file.dataset("GT_DEPTH", H5T_NATIVE_DOUBLE, H5T_NATIVE_DOUBLE, {5, 5, 64, 80}, {},
                   depth_of(scene).data());
      file.dataset("GT_DEPTH_MASK", boolean, boolean, {5, 5, 64, 80}, {}, mask.data());
      H5Tclose(boolean);
      file.attribute("dH", H5T_NATIVE_DOUBLE, &camera.baseline, true);
      file.attribute("focalLength", H5T_NATIVE_DOUBLE, &camera.focal_length, true);
      file.attribute("shift", H5T_NATIVE_DOUBLE, &camera.shift, true);
    }

    const Scene read = io::open_scene(path(), {}, Progress(1));

    const DisparityView map = read.truth->field.view({0, 0});
    QVERIFY(!map.is_valid(0, 11) && map.is_valid(0, 12));
    // Depth was rounded to float: see archive_test.
    QVERIFY(std::abs(map.disparity.at(5, 5) - scene.truth->field.disparity.view({0, 0}).at(5, 5)) <
            2e-6);
  }

  void recordsNamedLikeAMap_areTold() {
    const Scene scene = plane_scene();
    const hid_t record = H5Tcreate(H5T_COMPOUND, 8);
    H5Tinsert(record, "d", 0, H5T_NATIVE_FLOAT);
    H5Tinsert(record, "c", 4, H5T_NATIVE_FLOAT);
    const std::vector<float> samples(2 * 64 * 80, 1);
    {
      const HandMadeFile file(path());
      file.dataset("LF", H5T_NATIVE_UINT8, H5T_NATIVE_UINT8, {5, 5, 64, 80, 3}, {},
                   bytes_of(scene).data());
      file.dataset("disparity", record, record, {64, 80}, {}, samples.data());
    }
    H5Tclose(record);

    const Scene read = io::open_scene(path(), {}, Progress(1));

    QVERIFY2(describe(read.convention).find("disparity holds records of several fields") !=
                 std::string::npos,
             describe(read.convention).c_str());
  }

  void recordsOfSeveralFields_areNamed_data() {
    QTest::addColumn<QString>("name");
    QTest::newRow("LF") << "LF";
    QTest::newRow("another name") << "lightfield";
  }
  void recordsOfSeveralFields_areNamed() {
    QFETCH(QString, name);
    const hid_t record = H5Tcreate(H5T_COMPOUND, 2);
    H5Tinsert(record, "r", 0, H5T_NATIVE_UINT8);
    H5Tinsert(record, "g", 1, H5T_NATIVE_UINT8);
    const std::vector<std::uint8_t> samples(2 * 3 * 3 * 8 * 9, 1);
    HandMadeFile(path()).dataset(qPrintable(name), record, record, {3, 3, 8, 9}, {},
                                 samples.data());
    H5Tclose(record);
    std::string told;

    try {
      (void)io::open_scene(path(), {}, Progress(1));
    } catch (const IoError& error) {
      told = error.what();
    }

    QVERIFY2(told.find("holds records of several fields (compound)") != std::string::npos,
             told.c_str());
  }

  void readers_mayWorkAtTheSameTime() {
    const Scene scene = plane_scene();
    {
      const HandMadeFile file(path());
      file.dataset("LF", H5T_NATIVE_UINT8, H5T_NATIVE_UINT8, {5, 5, 64, 80, 3}, {1, 1, 64, 80, 3},
                   bytes_of(scene).data());
    }
    std::array<bool, 4> is_same{};
    {
      std::vector<std::jthread> threads;
      for (bool& same : is_same) {
        threads.emplace_back(
            [&] { same = has_same_samples(scene, io::open_scene(path(), {}, Progress(1))); });
      }
    }

    for (const bool same : is_same) QVERIFY(same);
  }
};

}  // namespace episcope::in_hdf5_forms_test

EPISCOPE_TEST(hdf5_forms_test, Hdf5FormsTest)
#include "hdf5_forms_test.moc"
