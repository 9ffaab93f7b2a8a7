// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/durable/append_log.h"

#include "engine/core/error.h"
#include "tests/test_main.h"

#include <QFile>
#include <QTemporaryDir>

#include <sys/resource.h>
#include <csignal>

namespace episcope::in_append_log_test {

using Lines = std::vector<std::string>;

class AppendLogTest : public QObject {
  Q_OBJECT
 private slots:
  void init() { QVERIFY(!path("x").empty()); }

  void lines_stayForTheNextTime() {
    {
      io::AppendLog log(path("kept"));
      QVERIFY(log.lines().empty());
      log.append("one");
      log.append("");
    }
    {
      io::AppendLog log(path("kept"));
      QCOMPARE(log.lines(), (Lines{"one", ""}));
      log.append("three");
    }
    QCOMPARE(io::AppendLog(path("kept")).lines(), (Lines{"one", "", "three"}));
  }

  void halfWrittenLine_isDroppedForGood() {
    write("half", "one\ntwo\n{\"key\": \"4");

    {
      io::AppendLog log(path("half"));
      QCOMPARE(log.lines(), (Lines{"one", "two"}));
      log.append("three");
    }

    QFile file(QString::fromStdString(path("half").string()));
    QVERIFY(file.open(QIODevice::ReadOnly));
    QCOMPARE(file.readAll(), QByteArray("one\ntwo\nthree\n"));
  }

  void onlyHalfALine_isAnEmptyLog() {
    write("first", "{");

    QVERIFY(io::AppendLog(path("first")).lines().empty());
  }

  void secondHolder_isRefused() {
    const io::AppendLog log(path("held"));

    QVERIFY_EXCEPTION_THROWN(io::AppendLog(path("held")), IoError);
  }

  void unwritableFolder_isAnIoError() {
    QVERIFY_EXCEPTION_THROWN(io::AppendLog(path("missing/log")), IoError);
    QVERIFY_EXCEPTION_THROWN(io::AppendLog("/proc/log"), IoError);
  }

  void fullDisk_leavesTheLogAsItWas() {
    io::AppendLog log(path("full"));
    log.append("one");
    rlimit old{};
    getrlimit(RLIMIT_FSIZE, &old);
    const rlimit tight{6, old.rlim_max};  // two bytes more
    std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &tight);

    QVERIFY_EXCEPTION_THROWN(log.append("two"), IoError);

    setrlimit(RLIMIT_FSIZE, &old);
    log.append("three");
    QFile file(QString::fromStdString(path("full").string()));
    QVERIFY(file.open(QIODevice::ReadOnly));
    QCOMPARE(file.readAll(), QByteArray("one\nthree\n"));
  }

 private:
  std::filesystem::path path(const char* name) {
    return folder_.isValid() ? std::filesystem::path(folder_.path().toStdString()) / name
                             : std::filesystem::path();
  }
  void write(const char* name, const char* text) {
    QFile file(QString::fromStdString(path(name).string()));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(text);
  }

  QTemporaryDir folder_;
};

}  // namespace episcope::in_append_log_test

EPISCOPE_TEST(append_log_test, AppendLogTest)
#include "append_log_test.moc"
