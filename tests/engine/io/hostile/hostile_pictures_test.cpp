// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/grid/claimed_pixels.h"
#include "engine/io/grid/decode_image.h"
#include "tests/test_main.h"

#include <opencv2/imgcodecs.hpp>

#include <QTemporaryDir>

#include <fstream>

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
    QCOMPARE(io::claimed_pixels(path), std::optional<std::uint64_t>(64 * 70));
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
};

}  // namespace episcope::in_hostile_pictures_test

EPISCOPE_TEST(hostile_pictures_test, HostilePicturesTest)
#include "hostile_pictures_test.moc"
