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
                           << "episcope-cli decode";
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

  void content_isTold_data() {
    QTest::addColumn<QByteArray>("content");
    QTest::addColumn<QString>("advice");
    QTest::newRow("pointer") << QByteArray(
                                    "version https://git-lfs.github.com/spec/v1\noid sha256:")
                             << "git lfs pull";
    QTest::newRow("web page") << QByteArray("<!DOCTYPE html><html><body>404") << "web page";
    QTest::newRow("HEIC") << QByteArray(
                                 "\0\0\0\x18"
                                 "ftypheic\0\0\0\0",
                                 16)
                          << "HEIC";
    QTest::newRow("AVIF") << QByteArray(
                                 "\0\0\0\x1c"
                                 "ftypavif\0\0\0\0",
                                 16)
                          << "AVIF";
    QTest::newRow("JPEG XL") << QByteArray("\0\0\0\x0cJXL \x0d\x0a\x87\x0a", 12) << "JPEG XL";
    QTest::newRow("nothing") << QByteArray() << "empty";
  }
  void content_isTold() {
    QFETCH(QByteArray, content);
    QFETCH(QString, advice);
    const QTemporaryDir folder;
    const fs::path place = folder.path().toStdString();
    for (int i = 0; i < 9; ++i) {
      const std::string name = std::to_string(i / 3) + "_" + std::to_string(i % 3) + ".png";
      std::ofstream(place / name, std::ios::binary) << content.toStdString();
    }

    QVERIFY2(refusal(place).contains(advice), qPrintable(refusal(place)));
  }

  void folderOfHeic_isTold() {
    const QTemporaryDir folder;
    const fs::path place = folder.path().toStdString();
    std::ofstream(place / "IMG_0_0.HEIC", std::ios::binary) << std::string(
        "\0\0\0\x18"
        "ftypheic\0\0\0\0",
        16);

    QVERIFY2(refusal(place).contains("IMG_0_0.HEIC: HEIC"), qPrintable(refusal(place)));
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
