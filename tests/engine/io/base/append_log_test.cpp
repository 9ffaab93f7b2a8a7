// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/atomic_file.h"
#include "tests/test_main.h"

#include <QFile>
#include <QTemporaryDir>

#include <sys/resource.h>
#include <csignal>

namespace episcope::in_append_log_test {

using io::AppendLog;
using io::LogFlush;
using io::LogFraming;

namespace {

using Texts = std::vector<std::string>;

Texts texts(const std::vector<io::LogRecord>& records) {
  Texts all;
  for (const io::LogRecord& record : records) all.emplace_back(record.begin(), record.end());
  return all;
}

std::vector<io::LogRecord> records_of(const Texts& all) {
  std::vector<io::LogRecord> records;
  for (const std::string& text : all) records.emplace_back(text.begin(), text.end());
  return records;
}

}  // namespace

class AppendLogTest : public QObject {
  Q_OBJECT

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void records_stayForTheNextTime_data() { everyLog(); }
  void records_stayForTheNextTime() {
    {
      AppendLog log = open();
      QVERIFY(log.records().empty());
      log.append("one");
      log.append("");
    }
    {
      AppendLog log = open();
      QCOMPARE(texts(log.records()), (Texts{"one", ""}));
      log.append("three");
    }
    QCOMPARE(texts(open().records()), (Texts{"one", "", "three"}));
  }

  void recordsToBeginWith_replaceTheLog_data() { everyLog(); }
  void recordsToBeginWith_replaceTheLog() {
    open().append("old");
    QFETCH(LogFraming, framing);
    QFETCH(LogFlush, flush);
    {
      AppendLog log(path(), framing, flush, records_of({"one", "two"}));
      log.append("three");
      log.flush();
      QCOMPARE(log.byte_size(), std::filesystem::file_size(path()));
    }

    QCOMPARE(texts(open().records()), (Texts{"one", "two", "three"}));
  }

  // What a crashed program leaves: any part of the file.
  void halfWrittenRecord_isDroppedForGood_data() { everyLog(); }
  void halfWrittenRecord_isDroppedForGood() {
    std::vector<qint64> sizes;  // with so many records
    {
      AppendLog log = open();
      sizes.push_back(static_cast<qint64>(log.byte_size()));
      for (const char* text : {"one", "two", "three"}) {
        log.append(text);
        sizes.push_back(static_cast<qint64>(log.byte_size()));
      }
    }
    const QByteArray whole = read();

    for (qint64 size = 0; size <= whole.size(); ++size) {
      write(whole.left(size));
      Texts kept{"one", "two", "three"};
      while (!kept.empty() && sizes[kept.size()] > size) kept.pop_back();
      {
        AppendLog log = open();
        QCOMPARE(texts(log.records()), kept);
        log.append("next");
      }
      kept.emplace_back("next");
      QCOMPARE(texts(open().records()), kept);
    }
  }

  void reading_leavesTheFileAsItIs_data() { everyLog(); }
  void reading_leavesTheFileAsItIs() {
    QFETCH(LogFraming, framing);
    AppendLog log = open();
    log.append("one");
    log.append("two");
    log.flush();
    const QByteArray whole = read();
    write(whole.chopped(1));

    const auto records = io::read_log(path(), framing);

    QCOMPARE(texts(records), Texts{"one"});
    QCOMPARE(read(), whole.chopped(1));
  }

  void secondHolder_isRefused_data() { everyLog(); }
  void secondHolder_isRefused() {
    QVERIFY(!io::is_held(path()));
    {
      const AppendLog log = open();

      QVERIFY(io::is_held(path()));
      QVERIFY_THROWS_EXCEPTION(IoError, open());
    }
    QVERIFY(!io::is_held(path()));
  }

  void unwritableFolder_isAnIoError_data() { everyLog(); }
  void unwritableFolder_isAnIoError() {
    QFETCH(LogFraming, framing);
    QFETCH(LogFlush, flush);
    for (const char* name : {"/proc/log", "/missing/log"}) {
      QVERIFY_THROWS_EXCEPTION(IoError, AppendLog(name, framing, flush));
      QVERIFY_THROWS_EXCEPTION(IoError, AppendLog(name, framing, flush, records_of({"one"})));
    }
  }

  void fullDisk_leavesTheLogAsItWas_data() { everyLog(); }
  void fullDisk_leavesTheLogAsItWas() {
    {
      AppendLog log = open();
      log.append("one");
      rlimit old{};
      getrlimit(RLIMIT_FSIZE, &old);
      const rlimit tight{log.byte_size() + 2, old.rlim_max};
      std::signal(SIGXFSZ, SIG_IGN);
      setrlimit(RLIMIT_FSIZE, &tight);

      QVERIFY_THROWS_EXCEPTION(IoError, log.append("two"));

      setrlimit(RLIMIT_FSIZE, &old);
      log.append("three");
    }
    QCOMPARE(texts(open().records()), (Texts{"one", "three"}));
  }

  // Logs that earlier programs wrote.
  void format_staysTheSame_data() {
    QTest::addColumn<LogFraming>("framing");
    QTest::addColumn<QByteArray>("file");
    QTest::addColumn<QByteArray>("last");
    QTest::newRow("lines") << LogFraming::Lines << QByteArray("one\n\ntwo\n") << QByteArray("two");
    QTest::newRow("checked") << LogFraming::Checked
                             << QByteArray::fromHex(
                                    "4550494c4f47310a"
                                    "03000000"
                                    "5723c9df"
                                    "6f6e65"
                                    "00000000"
                                    "a5a5a5a5"
                                    "03000000"
                                    "b37b098d"
                                    "000aff")
                             << QByteArray::fromHex("000aff");
  }
  void format_staysTheSame() {
    QFETCH(LogFraming, framing);
    QFETCH(QByteArray, file);
    QFETCH(QByteArray, last);
    {
      AppendLog log(path(), framing, LogFlush::AtOnce, records_of({"one", ""}));
      log.append(last.toStdString());
    }
    QCOMPARE(read(), file);

    const AppendLog log(path(), framing, LogFlush::AtOnce);

    QCOMPARE(texts(log.records()), (Texts{"one", "", last.toStdString()}));
  }

  void anotherFile_isNoCheckedLog() {
    write("years of work\n");

    QVERIFY_THROWS_EXCEPTION(IoError, AppendLog(path(), LogFraming::Checked, LogFlush::AtOnce));
    QVERIFY_THROWS_EXCEPTION(IoError, (void)io::read_log(path(), LogFraming::Checked));
    QCOMPARE(read(), QByteArray("years of work\n"));
  }

 private:
  static void everyLog() {
    QTest::addColumn<LogFraming>("framing");
    QTest::addColumn<LogFlush>("flush");
    QTest::newRow("lines, at once") << LogFraming::Lines << LogFlush::AtOnce;
    QTest::newRow("lines, in the background") << LogFraming::Lines << LogFlush::InBackground;
    QTest::newRow("checked, at once") << LogFraming::Checked << LogFlush::AtOnce;
    QTest::newRow("checked, in the background") << LogFraming::Checked << LogFlush::InBackground;
  }
  // The log of this row of the table.
  AppendLog open() const {
    QFETCH(const LogFraming, framing);
    QFETCH(const LogFlush, flush);
    return AppendLog(path(), framing, flush);
  }
  std::filesystem::path path() const {
    return std::filesystem::path(folder_->path().toStdString()) / "log";
  }
  void write(const QByteArray& bytes) const {
    QFile file(QString::fromStdString(path().string()));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(bytes);
  }
  QByteArray read() const {
    QFile file(QString::fromStdString(path().string()));
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
  }

  std::unique_ptr<QTemporaryDir> folder_;
};

}  // namespace episcope::in_append_log_test

EPISCOPE_TEST(append_log_test, AppendLogTest)
#include "append_log_test.moc"
