// SPDX-License-Identifier: BSD-3-Clause
// Samples may be stored in the header of a dataset. If its shape is damaged, the library reads what
// lies behind them in memory; if its type is, too.
#include "engine/core/error.h"
#include "engine/io/hdf5/hdf5_file.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace episcope::in_compact_dataset_test {

namespace {

namespace fs = std::filesystem;

constexpr hsize_t kLength = 1237;

void write_compact(const fs::path& path, hsize_t length) {
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t space = H5Screate_simple(1, &length, nullptr);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_layout(creation, H5D_COMPACT);
  const hid_t dataset =
      H5Dcreate2(file, "lf", H5T_STD_U8LE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  const std::vector<std::uint8_t> samples(length, 170);
  H5Dwrite(dataset, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, samples.data());
  H5Dclose(dataset);
  H5Pclose(creation);
  H5Sclose(space);
  H5Fclose(file);
}

std::string number(hsize_t value) {
  std::string bytes;
  for (int i = 0; i < 8; ++i) bytes += static_cast<char>(value >> (8 * i));
  return bytes;
}

/// Of the length that the shape tells.
void lengthen(const fs::path& path) {
  std::stringstream read;
  read << std::ifstream(path, std::ios::binary).rdbuf();
  std::string bytes = read.str();
  std::size_t at = bytes.find(number(kLength));
  QVERIFY(at != std::string::npos);
  for (; at != std::string::npos; at = bytes.find(number(kLength), at)) {
    bytes.replace(at, 8, number(9 * kLength));
  }
  std::ofstream(path, std::ios::binary) << bytes;
}

std::vector<std::uint8_t> read(const fs::path& path, std::size_t length) {
  std::vector<std::uint8_t> samples(length);
  io::Hdf5Input(path).read<std::uint8_t>("lf", {{0}, {length}}, samples.data());
  return samples;
}

}  // namespace

class CompactDatasetTest : public QObject {
  Q_OBJECT

 private:
  QTemporaryDir folder_;

 private slots:
  void samples_areRead() {
    const fs::path path = folder_.filePath("whole.h5").toStdString();
    write_compact(path, kLength);

    QCOMPARE(read(path, kLength), std::vector<std::uint8_t>(kLength, 170));
  }

  void emptyDataset_isRead() {
    const fs::path path = folder_.filePath("empty.h5").toStdString();
    write_compact(path, 0);

    QCOMPARE(read(path, 0).size(), std::size_t{0});
  }

  void shapeOfMore_isRefused() {
    const fs::path path = folder_.filePath("long.h5").toStdString();
    write_compact(path, kLength);
    lengthen(path);

    QVERIFY_THROWS_EXCEPTION(IoError, (void)read(path, 9 * kLength));
  }

  // Which the library cannot convert without reading beyond its memory.
  void numbersOfManyBytes_areRefused() {
    const fs::path path = folder_.filePath("wide.h5").toStdString();
    const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t space = H5Screate_simple(1, &kLength, nullptr);
    const hid_t type = H5Tcopy(H5T_STD_U8LE);
    H5Tset_size(type, 100);
    H5Dclose(H5Dcreate2(file, "lf", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    H5Tclose(type);
    H5Sclose(space);
    H5Fclose(file);

    QVERIFY_THROWS_EXCEPTION(IoError, (void)read(path, 10));
  }
};

}  // namespace episcope::in_compact_dataset_test

EPISCOPE_TEST(compact_dataset_test, CompactDatasetTest)
#include "compact_dataset_test.moc"
