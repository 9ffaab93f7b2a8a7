// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/atomic_file.h"
#include "tests/test_main.h"

#include <QDir>
#include <QTemporaryDir>

#include <fstream>
#include <functional>
#include <optional>
#include <sys/wait.h>
#include <unistd.h>

namespace episcope::in_temporary_name_test {

using io::AtomicFile;
using io::AtomicFolder;

namespace {

namespace fs = std::filesystem;

// Another program that is killed while it writes.
void be_killed_after(const std::function<void()>& begin) {
  const pid_t child = ::fork();
  if (child == 0) {
    begin();
    ::_exit(0);  // without destructors
  }
  QVERIFY(child > 0);
  int status = 0;
  QCOMPARE(::waitpid(child, &status, 0), child);
}

void make_file(const fs::path& path) {
  std::ofstream(path) << "half";
}

}  // namespace

class TemporaryNameTest : public QObject {
  Q_OBJECT

 private:
  std::optional<QTemporaryDir> folder_;

  [[nodiscard]] fs::path path(const char* name) const {
    return folder_->filePath(name).toStdString();
  }
  // All that is in the folder, hidden or not.
  [[nodiscard]] QStringList names() const {
    return QDir(folder_->path()).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot);
  }

 private slots:
  void init() { folder_.emplace(); }

  void fileOfKilledProgram_isRemovedByTheNext() {
    be_killed_after([&] { new AtomicFile(path("a.h5")); });
    QCOMPARE(names().size(), 1);

    io::write_atomically(path("a.h5"), std::string_view("whole"));

    QCOMPARE(names(), QStringList{"a.h5"});
  }

  void folderOfKilledProgram_isRemovedByTheNext() {
    be_killed_after([&] { make_file((new AtomicFolder(path("views")))->temporary() / "0.png"); });
    QCOMPARE(names().size(), 1);

    AtomicFolder(path("views")).commit();

    QCOMPARE(names(), QStringList{"views"});
  }

  // In a container each program may have the number 1.
  void killedProgramOfTheSameNumber_isInNobodysWay() {
    const fs::path own = io::temporary_name("a.h5");
    std::string before = own.string();
    const std::size_t at = before.find('-', before.find('-') + 1) + 1;
    before[at] = before[at] == '0' ? '1' : '0';
    make_file(path(before.c_str()));

    io::write_atomically(path("a.h5"), std::string_view("whole"));

    QCOMPARE(names(), QStringList{"a.h5"});
  }

  void whatIsBeingWritten_stays() {
    const AtomicFile first(path("a.h5"));
    const AtomicFile second(path("a.h5"));

    QVERIFY(fs::exists(first.temporary()) && fs::exists(second.temporary()));
    QVERIFY(first.temporary() != second.temporary());
  }

  // Nobody here knows whether it still writes.
  void fileOfAnotherMachine_stays() {
    std::string other = io::temporary_name("a.h5");
    const std::size_t at = other.find('-') - 1;
    other[at] = other[at] == '0' ? '1' : '0';
    for (const std::string& name :
         {other, std::string(".a.h5.part"), std::string(".a.h5.x-1.part")})
      make_file(path(name.c_str()));

    io::write_atomically(path("a.h5"), std::string_view("whole"));

    QCOMPARE(names().size(), 4);
  }
};

}  // namespace episcope::in_temporary_name_test

EPISCOPE_TEST(temporary_name_test, TemporaryNameTest)
#include "temporary_name_test.moc"
