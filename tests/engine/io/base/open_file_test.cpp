// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/hdf5_output.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

// Inputs of one HDF5 file share its opening and the list of what it holds, but never those of a
// file that has taken its place.

namespace episcope::in_open_file_test {

namespace fs = std::filesystem;

class OpenFileTest : public QObject {
  Q_OBJECT

 private slots:
  void inputsOfOneFile_endOneByOne() {
    write("a", 3);
    auto first = std::make_unique<io::Hdf5Input>(path());
    const io::Hdf5Input second(path());
    QCOMPARE(value_in(*first, "a"), 3);
    first.reset();

    QCOMPARE(value_in(second, "a"), 3);
    QCOMPARE(second.datasets().size(), std::size_t{1});
  }

  void fileInItsPlace_isReadAnew() {
    write("a", 3);
    const io::Hdf5Input former(path());
    QCOMPARE(former.datasets().front().name, std::string("a"));
    write("b", 4);

    const io::Hdf5Input now(path());

    QCOMPARE(now.datasets().front().name, std::string("b"));
    QCOMPARE(value_in(now, "b"), 4);
    QCOMPARE(value_in(former, "a"), 3);
  }

 private:
  [[nodiscard]] fs::path path() const { return folder_.filePath("one.h5").toStdString(); }
  void write(const std::string& name, std::int32_t value) const {
    io::AtomicFile target(path());
    io::Hdf5Output file(target);
    file.add_dataset<std::int32_t>(name, {1}, "x", "");
    file.write(name, {{0}, {1}}, &value);
    file.close();
    target.commit();
  }
  static int value_in(const io::Hdf5Input& file, const std::string& name) {
    std::int32_t value = 0;
    file.read(name, {{0}, {1}}, &value);
    return value;
  }

  QTemporaryDir folder_;
};

}  // namespace episcope::in_open_file_test

EPISCOPE_TEST(open_file_test, OpenFileTest)

#include "open_file_test.moc"
