// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/hdf5_output.h"
#include "engine/io/open.h"
#include "tests/test_main.h"

#include <hdf5.h>
#include <QTemporaryDir>

#include <malloc.h>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

// Groups of many datasets, as new versions of HDF5 store them, are refused when they are damaged:
// in order of names the library released a table of them that it had not filled.

namespace episcope::in_damaged_group_test {

namespace {

namespace fs = std::filesystem;

/// Memory that is taken begins with garbage, so that what uses it unfilled is seen.
class GarbageInMemory {
 public:
  GarbageInMemory() { mallopt(M_PERTURB, 0x5A); }
  ~GarbageInMemory() { mallopt(M_PERTURB, 0); }
  GarbageInMemory(const GarbageInMemory&) = delete;
  GarbageInMemory& operator=(const GarbageInMemory&) = delete;
};

/// A dozen datasets in the root, in the form that the library takes from nine on.
void write_many_datasets(const fs::path& path) {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  const hid_t space = H5Screate(H5S_SCALAR);
  for (char last = 'a'; last < 'm'; ++last) {
    const std::string name = std::string("view_") + last;
    H5Dclose(
        H5Dcreate2(file, name.c_str(), H5T_STD_U8LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  }
  H5Sclose(space);
  H5Fclose(file);
  H5Pclose(access);
}

/// Turns the bits of a byte behind the first block of this kind over.
void damage(const fs::path& path, const std::string& signature, std::size_t behind) {
  std::stringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  std::string text = bytes.str();
  const std::size_t at = text.find(signature);
  QVERIFY2(at != std::string::npos, signature.c_str());
  text[at + behind] = static_cast<char>(~text[at + behind]);
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace

class DamagedGroupTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    write_many_datasets(path());
    QCOMPARE(io::Hdf5Input(path()).datasets().size(), std::size_t{12});
  }
  void datasets_areRefused_data() { add_blocks(); }
  void datasets_areRefused();
  void copies_areRefused_data() { add_blocks(); }
  void copies_areRefused();

 private:
  static void add_blocks() {
    QTest::addColumn<QString>("signature");
    QTest::addColumn<int>("behind");
    QTest::newRow("header of the heap of links") << "FRHP" << 20;
    QTest::newRow("heap of links") << "FHDB" << 30;
    QTest::newRow("header of their tree") << "BTHD" << 20;
    QTest::newRow("leaf of their tree") << "BTLF" << 30;
  }
  void damage_fetched() const {
    QFETCH(QString, signature);
    QFETCH(int, behind);
    damage(path(), signature.toStdString(), static_cast<std::size_t>(behind));
  }
  [[nodiscard]] fs::path path() const { return folder_.filePath("lf.h5").toStdString(); }

  QTemporaryDir folder_;
};

void DamagedGroupTest::datasets_areRefused() {
  damage_fetched();
  const GarbageInMemory garbage;

  QVERIFY(io::Hdf5Input(path()).datasets().empty());
  QVERIFY_THROWS_EXCEPTION(IoError, static_cast<void>(io::open_scene(path(), {}, Progress(1))));
}

void DamagedGroupTest::copies_areRefused() {
  damage_fetched();
  const io::Hdf5Input from(path());
  io::AtomicFile target(folder_.filePath("copy.h5").toStdString());
  io::Hdf5Output copy(target);
  const GarbageInMemory garbage;

  QVERIFY_THROWS_EXCEPTION(IoError, copy.copy_all(from, {}));
}

}  // namespace episcope::in_damaged_group_test

EPISCOPE_TEST(damaged_group_test, DamagedGroupTest)
#include "damaged_group_test.moc"
