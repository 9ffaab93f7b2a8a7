// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/open.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <fstream>

namespace episcope::in_unsupported_format_test {

namespace fs = std::filesystem;

class UnsupportedFormatTest : public QObject {
  Q_OBJECT

 private:
  /// Why it is not opened; empty if it is.
  static QString refusal(const fs::path& path) {
    try {
      (void)io::open_scene(path, {}, Progress(1));
    } catch (const IoError& error) {
      return error.what();
    }
    return {};
  }

 private slots:
  void refusal_saysWhatToDo_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<QString>("advice");
    QTest::newRow("ZIP") << "lf.zip"
                         << "unpack it";
    QTest::newRow("packed TAR") << "lf.tar.gz"
                                << "unpack it";
    QTest::newRow("Lytro") << "IMG_0001.LFP"
                           << "LFToolbox";
    QTest::newRow("tensor") << "lf.pt"
                            << ".npy";
    QTest::newRow("other") << "lf.doc"
                           << "an lf.h5, a scene folder";
  }
  void refusal_saysWhatToDo() {
    QFETCH(QString, name);
    QFETCH(QString, advice);
    const QTemporaryDir folder;
    const fs::path file = fs::path(folder.path().toStdString()) / name.toStdString();
    std::ofstream(file) << "something";

    QVERIFY2(refusal(file).contains(advice), qPrintable(refusal(file)));
  }

  void refusalOfAFolder_namesSuchFiles_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<QString>("advice");
    QTest::newRow("ZIP") << "rectified.zip"
                         << "rectified.zip: this is an archive of files; unpack it";
    QTest::newRow("GIF") << "1_1.gif"
                         << "convert them to PNG";
    QTest::newRow("other") << "lf.doc"
                           << "expected an lf.h5";
  }
  void refusalOfAFolder_namesSuchFiles() {
    QFETCH(QString, name);
    QFETCH(QString, advice);
    const QTemporaryDir folder;
    const fs::path place = folder.path().toStdString();
    std::ofstream(place / name.toStdString()) << "something";

    QVERIFY2(refusal(place).contains(advice), qPrintable(refusal(place)));
  }
};

}  // namespace episcope::in_unsupported_format_test

EPISCOPE_TEST(unsupported_format_test, UnsupportedFormatTest)
#include "unsupported_format_test.moc"
