// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "tests/engine/io/base/one_dataset.h"
#include "tests/test_main.h"

#include <QTemporaryDir>
#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

// Samples may be stored in the header of a dataset. If its shape is damaged, the library reads what
// lies behind them in memory; if its type is, too.

namespace episcope::in_compact_dataset_test {

using namespace episcope::test;

namespace {

namespace fs = std::filesystem;

constexpr hsize_t kLength = 1237;

void write_compact(const fs::path& path, hsize_t length) {
  write_row(
      path, length, [](hid_t creation) { H5Pset_layout(creation, H5D_COMPACT); },
      [&](hid_t dataset) { fill_row(dataset, length); });
}

std::string number(hsize_t value) {
  std::string bytes;
  for (int i = 0; i < 8; ++i) bytes += static_cast<char>(value >> (8 * i));
  return bytes;
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

    QCOMPARE(read_row(path, 0, kLength), std::vector<std::uint8_t>(kLength, 170));
  }

  void emptyDataset_isRead() {
    const fs::path path = folder_.filePath("empty.h5").toStdString();
    write_compact(path, 0);

    QCOMPARE(read_row(path, 0, 0).size(), std::size_t{0});
  }

  void shapeOfMore_isRefused() {
    const fs::path path = folder_.filePath("long.h5").toStdString();
    write_compact(path, kLength);
    replace_bytes(path, number(kLength), number(9 * kLength));

    QVERIFY_THROWS_EXCEPTION(IoError, (void)read_row(path, 0, 9 * kLength));
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

    QVERIFY_THROWS_EXCEPTION(IoError, (void)read_row(path, 0, 10));
  }
};

}  // namespace episcope::in_compact_dataset_test

EPISCOPE_TEST(compact_dataset_test, CompactDatasetTest)
#include "compact_dataset_test.moc"
