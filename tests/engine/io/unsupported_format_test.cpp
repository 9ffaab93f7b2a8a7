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
    QTest::newRow("export") << "lf.lfi"
                            << "export its views";
    QTest::newRow("raw photograph") << "IMG_0_0.DNG"
                                    << "develop all views alike";
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
    QTest::newRow("ZIP") << QByteArray("PK\x03\x04\x14\0\0\0", 8) << "an archive of files; unpack";
    QTest::newRow("TAR") << QByteArray(257, 'a') + QByteArray("ustar\0", 6)
                         << "an archive of files; unpack";
    QTest::newRow("7z") << QByteArray("7z\xBC\xAF\x27\x1C") << "an archive of files; unpack";
    QTest::newRow("gzip") << QByteArray("\x1F\x8B\x08\0", 4) << "is compressed; unpack";
    QTest::newRow("Zstandard") << QByteArray("\x28\xB5\x2F\xFD") << "is compressed; unpack";
    QTest::newRow("Lytro") << QByteArray("\x89LFP\x0D\x0A\x1A\x0A\0\0\0\1", 12)
                           << "a raw picture of a Lytro camera";
    QTest::newRow("pickle") << QByteArray("\x80\x04\x95\x10", 4) << "save the array as .npy";
    QTest::newRow("PyTorch") << QByteArray("PK\x03\x04", 4) + QByteArray(26, '\0') +
                                    QByteArray("lf/data.pkl")
                             << "save the array as .npy";
    QTest::newRow("web page after a blank line") << QByteArray("\r\n <html><head>") << "web page";
    QTest::newRow("answer of a server")
        << QByteArray("<?xml version=\"1.0\" encoding=\"UTF-8\"?><Error><Code>AccessDenied")
        << "the answer of a server";
    QTest::newRow("PDF") << QByteArray("%PDF-1.5") << "a document";
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

  void contentOfEveryName_isTold_data() {
    QTest::addColumn<QString>("name");
    for (const char* name :
         {"lf.h5", "scene.hdf5", "lf.mat", "lf.npy", "lf.mp4", "lf.tif", "lf.exr", "lf.zip",
          "lf.lfr", "lf.bin", "lf_eslf.png", "gt_qs8x6a0.75.jpg"}) {
      QTest::newRow(name) << name;
    }
  }
  void contentOfEveryName_isTold() {
    QFETCH(QString, name);
    const QTemporaryDir folder;
    const fs::path place = folder.path().toStdString();
    std::ofstream(place / name.toStdString(), std::ios::binary)
        << "version https://git-lfs.github.com/spec/v1\noid sha256:";

    const QString of_file = refusal(place / name.toStdString());
    const QString of_folder = refusal(place);

    QVERIFY2(of_file.contains("git lfs pull"), qPrintable(of_file));
    QVERIFY2(of_folder.contains("git lfs pull"), qPrintable(of_folder));
  }

  void archiveOfArrays_isNone() {
    const QTemporaryDir folder;
    const fs::path place = folder.path().toStdString();
    std::ofstream(place / "lf.npz", std::ios::binary) << std::string("PK\x03\x04\0\0", 6);

    QVERIFY2(!refusal(place / "lf.npz").contains("unpack"), qPrintable(refusal(place / "lf.npz")));
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
    QTest::newRow("ZIP of another name") << "rectified.dat"
                                         << "rectified.dat: this is an archive of files; unpack it";
    QTest::newRow("GIF") << "1_1.gif"
                         << "convert them to PNG";
  }
  void refusalOfAFolder_namesSuchFiles() {
    QFETCH(QString, name);
    QFETCH(QString, advice);
    const QTemporaryDir folder;
    const fs::path place = folder.path().toStdString();
    std::ofstream(place / name.toStdString(), std::ios::binary) << "PK\x03\x04 and so on";

    QVERIFY2(refusal(place).contains(advice), qPrintable(refusal(place)));
  }
};

}  // namespace episcope::in_unsupported_format_test

EPISCOPE_TEST(unsupported_format_test, UnsupportedFormatTest)
#include "unsupported_format_test.moc"
