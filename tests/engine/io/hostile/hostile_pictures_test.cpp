// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/image_header.h"
#include "tests/test_main.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <QDir>
#include <QFile>
#include <QTemporaryDir>

#include <unistd.h>

#include <fstream>
#include <iostream>

namespace episcope::in_hostile_pictures_test {

/// A picture of few bytes that claims gigabytes is refused before memory is taken for it.
class HostilePicturesTest : public QObject {
  Q_OBJECT

 private:
  QTemporaryDir folder_;

  std::filesystem::path file(const QString& name, const std::string& bytes) const {
    const std::filesystem::path path = folder_.filePath(name).toStdString();
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }

 private slots:
  void pixels_areToldByTheHeader_data() {
    QTest::addColumn<QString>("suffix");
    for (const char* suffix : {"bmp", "ppm", "tif", "jpg", "jp2", "webp", "hdr"}) {
      QTest::newRow(suffix) << suffix;
    }
  }
  void pixels_areToldByTheHeader() {
    QFETCH(QString, suffix);
    const std::string path = folder_.filePath("a." + suffix).toStdString();
    const bool is_float = suffix == "hdr";
    const cv::Mat picture(64, 70, is_float ? CV_32FC3 : CV_8UC3, cv::Scalar(1, 0.5, 0.2));
    QVERIFY(cv::imwrite(path, picture));
    QCOMPARE(io::declared_pixels(path), std::optional<std::uint64_t>(64 * 70));
    QCOMPARE(std::visit([](const auto& image) { return image.width(); }, io::decode_image(path)),
             70);
  }

  void hugeClaims_areRefused_data() {
    QTest::addColumn<QByteArray>("bytes");
    QTest::newRow("WebP, lossless") << QByteArray::fromHex(
        "524946460400000057454250"
        "5650384c10000000"
        "2fffffff0f"
        "0000");
    QTest::newRow("WebP, extended") << QByteArray::fromHex(
        "524946460400000057454250"
        "565038580a000000"
        "00000000"
        "ffff00"
        "ffff00");
    QTest::newRow("BMP") << QByteArray::fromHex(
                                "424d"
                                "00000000"
                                "00000000"
                                "36000000"
                                "28000000"
                                "00000100"
                                "00000100"
                                "0100"
                                "1800") +
                                QByteArray(40, 0);
    QTest::newRow("PNM") << QByteArray("P5 100000 100000 255 abc");
    QTest::newRow("Radiance, other name") << QByteArray("#?RGBE\n\n-Y 100000 +X 100000\nabc");
    QTest::newRow("Radiance") << QByteArray("#?RADIANCE\n\n-Y 100000 +X 100000\nabc");
    QTest::newRow("OpenEXR") << QByteArray::fromHex("762f310102000000") +
                                    QByteArray("dataWindow\0box2i\0", 17) +
                                    QByteArray::fromHex(
                                        "10000000"
                                        "00000000"
                                        "00000000"
                                        "ffff0f00"
                                        "ffff0f00");
    QTest::newRow("JPEG 2000") << QByteArray::fromHex("0000000c6a502020") + QByteArray(8, 0) +
                                      QByteArray("ihdr") +
                                      QByteArray::fromHex(
                                          "000fffff"
                                          "000fffff");
  }
  void hugeClaims_areRefused() {
    QFETCH(QByteArray, bytes);
    const auto path = file("claim.png", bytes.toStdString());
    try {
      (void)io::decode_image(path);
      QFAIL("it was decoded");
    } catch (const IoError& error) {
      QVERIFY2(QString(error.what()).contains("million pixels"), error.what());
    }
  }

  // OpenEXR takes memory for what it claims, and fills it.
  void wrongExrAttribute_isRefused_data() {
    QTest::addColumn<QByteArray>("version");
    QTest::addColumn<QByteArray>("attribute");
    const QByteArray one = QByteArray::fromHex("02000000");
    const QByteArray many = QByteArray::fromHex("02100000");
    const QByteArray text("note\0string\0", 12);
    const QByteArray whole = text + QByteArray::fromHex("01000000") + "a";
    const QByteArray long_text = text + QByteArray::fromHex("ffffff3f");
    QTest::newRow("long") << one << long_text;
    QTest::newRow("long, second part") << many << whole + QByteArray(1, 0) + long_text;
    QTest::newRow("another size") << one
                                  << QByteArray("a\0box2i\0", 8) + QByteArray::fromHex("08000000");
    QTest::newRow("large preview")
        << one << QByteArray("a\0preview\0", 10) + QByteArray::fromHex("080000000010000000100000");
    QTest::newRow("channels without end")
        << one << QByteArray("channels\0chlist\0", 16) + QByteArray::fromHex("02000000") + "RG";
  }
  void wrongExrAttribute_isRefused() {
    QFETCH(QByteArray, version);
    QFETCH(QByteArray, attribute);
    const QByteArray bytes =
        QByteArray::fromHex("762f3101") + version + attribute + QByteArray(200, 'a');
    const auto path = file("wrong.exr", bytes.toStdString());
    try {
      (void)io::decode_image(path);
      QFAIL("it was decoded");
    } catch (const IoError& error) {
      QVERIFY2(QString(error.what()).contains("header is damaged"), error.what());
    }
  }

  // With pixels as they are (narrow), in runs, and in both.
  void radiancePictures_areThoseOfOpenCv_data() {
    QTest::addColumn<int>("width");
    for (const int width : {3, 8, 70, 200}) QTest::addRow("%d", width) << width;
  }
  void radiancePictures_areThoseOfOpenCv() {
    QFETCH(int, width);
    const std::string path = folder_.filePath("b.hdr").toStdString();
    cv::Mat picture(20, width, CV_32FC3);
    cv::theRNG().state = 7;
    cv::randu(picture, 0, 30);
    picture.colRange(width / 2, width) = cv::Scalar(0.25, 0, 1e-3);
    QVERIFY(cv::imwrite(path, picture));
    const cv::Mat wanted = cv::imread(path, cv::IMREAD_UNCHANGED);

    const auto decoded = std::get<Image<float>>(io::decode_image(path));

    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < width; ++x) {
        const auto& bgr = wanted.at<cv::Vec3f>(y, x);
        for (int c = 0; c < 3; ++c) QCOMPARE(decoded.at(y, x, c), bgr[2 - c]);
      }
    }
  }

  void damagedRadiancePictures_areRefused_data() {
    QTest::addColumn<QByteArray>("bytes");
    const QByteArray head("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 9\n");
    const QByteArray mark = QByteArray::fromHex("02020009");
    QTest::newRow("no pixels") << head;
    QTest::newRow("another width") << head + QByteArray::fromHex("0202000a");
    QTest::newRow("a run of none") << head + mark + QByteArray::fromHex("0000");
    QTest::newRow("a long run") << head + mark + QByteArray::fromHex("8a01");
    QTest::newRow("few literals") << head + mark + QByteArray::fromHex("090102");
    QTest::newRow("no end of line") << QByteArray("#?RADIANCE\nFORMAT=32-bit_rle_rgbe");
    QTest::newRow("other pixels") << QByteArray(
        "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd");
    QTest::newRow("other rows") << QByteArray("#?RADIANCE\n\n+Y 1 +X 1\nabcd");
    QTest::newRow("a small size in a comment")
        << QByteArray("#?RADIANCE\n# Y 2 X 9\n\n-Y 100000 +X 100000\nabcd");
    QTest::newRow("no size") << QByteArray("#?RADIANCE\n\n-Y 0 +X 1\nabcd");
  }
  // They left their files open.
  void damagedRadiancePictures_areRefused() {
    QFETCH(QByteArray, bytes);
    const auto path = file("damaged.hdr", bytes.toStdString());
    const auto open_files = [] { return QDir("/proc/self/fd").count(); };
    const auto before = open_files();

    for (int i = 0; i < 5; ++i) {
      QVERIFY_THROWS_EXCEPTION(IoError, static_cast<void>(io::decode_image(path)));
    }

    QCOMPARE(open_files(), before);
  }

  // OpenCV wrote why to standard error, too.
  void cutPictures_areRefusedSilently_data() {
    QTest::addColumn<QString>("suffix");
    for (const char* suffix : {"bmp", "ppm", "tif", "jp2"}) QTest::newRow(suffix) << suffix;
  }
  void cutPictures_areRefusedSilently() {
    QFETCH(QString, suffix);
    const std::filesystem::path path = folder_.filePath("cut." + suffix).toStdString();
    cv::Mat picture(64, 70, CV_8UC3);
    cv::randu(picture, 0, 255);
    QVERIFY(cv::imwrite(path.string(), picture));
    std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
    QFile errors(folder_.filePath("errors"));
    QVERIFY(errors.open(QIODevice::ReadWrite | QIODevice::Truncate));
    const int before = dup(STDERR_FILENO);
    dup2(errors.handle(), STDERR_FILENO);

    QVERIFY_THROWS_EXCEPTION(IoError, static_cast<void>(io::decode_image(path)));
    std::cerr << "heard" << std::flush;

    dup2(before, STDERR_FILENO);
    close(before);
    QVERIFY(errors.seek(0));
    QCOMPARE(errors.readAll(), QByteArray("heard"));
  }
};

}  // namespace episcope::in_hostile_pictures_test

EPISCOPE_TEST(hostile_pictures_test, HostilePicturesTest)
#include "hostile_pictures_test.moc"
