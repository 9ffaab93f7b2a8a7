// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/image_file.h"
#include "tests/engine/io/base/exr_file.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <cmath>

namespace episcope::in_exr_channels_test {

using namespace episcope::test;

namespace fs = std::filesystem;

/// Files of renderers, whose channels are not called R, G and B.
class ExrChannelsTest : public QObject {
  Q_OBJECT

 private:
  static constexpr int kHeight = 5;
  static constexpr int kWidth = 7;

  QTemporaryDir folder_;

  fs::path path() const { return fs::path(folder_.path().toStdString()) / "a.exr"; }
  /// Each pixel differs, and each channel.
  static Image<float> channel(float number) {
    Image<float> image(kHeight, kWidth);
    for (std::size_t i = 0; i < image.size(); ++i) {
      image.data()[i] = number + 0.01F * static_cast<float>(i);
    }
    return image;
  }
  /// With the channel 0 for the first name, 1 for the second, and so on.
  void write(const QStringList& names) const {
    std::vector<Image<float>> images;
    for (int i = 0; i < names.size(); ++i) images.push_back(channel(static_cast<float>(i)));
    ExrChannels channels;
    for (int i = 0; i < names.size(); ++i) {
      channels.emplace(names[i].toStdString(), images[static_cast<std::size_t>(i)].view());
    }
    write_exr(path(), channels);
  }

 private slots:
  void storedPixels_lieInTheDisplayWindow() {
    const Image<float> stored = channel(1);
    write_exr(path(), {{"Y", stored.view()}}, DisplayWindow{-2, 1, 8, 9});

    const auto colors = std::get<Image<float>>(io::decode_image(path()));
    const auto depth = std::get<Image<float>>(io::decode_image(path(), io::PicturePart::Depth));

    QCOMPARE(colors.width(), 11);
    QCOMPARE(colors.height(), 9);
    QCOMPARE(colors.at(0, 2), stored.at(1, 0));
    QCOMPARE(colors.at(3, 8), stored.at(4, 6));
    QCOMPARE(colors.at(0, 1), 0.0F);
    QVERIFY(std::isnan(depth.at(4, 2)));
    QCOMPARE(depth.at(3, 2), stored.at(4, 0));
  }

  void channels_areFound_data() {
    QTest::addColumn<QStringList>("names");
    QTest::addColumn<bool>("depth");
    QTest::addColumn<QList<int>>("found");
    const QList<int> one{0};
    const QList<int> colours{0, 1, 2};
    const QString pass = "View Layer.Combined.";
    QTest::newRow("colours") << QStringList{"R", "G", "B", "A"} << false << colours;
    QTest::newRow("depth alone") << QStringList{"Z"} << true << one;
    QTest::newRow("a value alone") << QStringList{"V"} << true << one;
    QTest::newRow("grey") << QStringList{"Y"} << true << one;
    QTest::newRow("depth with a long name") << QStringList{"View Layer.Depth.Z"} << false << one;
    QTest::newRow("depth beside colors") << QStringList{"Z", "R", "G", "B"} << true << one;
    QTest::newRow("colors beside depth")
        << QStringList{"R", "G", "B", "Z", "depth.V"} << false << colours;
    QTest::newRow("colors for depth") << QStringList{"R", "G", "B"} << true << colours;
    QTest::newRow("layers") << QStringList{pass + "R",
                                           pass + "G",
                                           pass + "B",
                                           pass + "A",
                                           "View Layer.Depth.Z",
                                           "View Layer.Albedo.R",
                                           "View Layer.Albedo.G",
                                           "View Layer.Albedo.B"}
                            << false << colours;
    QTest::newRow("depth among layers")
        << QStringList{"View Layer.Depth.Z", pass + "R", pass + "G", pass + "B", pass + "A"} << true
        << one;
  }
  void channels_areFound() {
    QFETCH(QStringList, names);
    QFETCH(bool, depth);
    QFETCH(QList<int>, found);
    write(names);

    const io::AnyImage decoded =
        io::decode_image(path(), depth ? io::PicturePart::Depth : io::PicturePart::Colors);

    const auto& image = std::get<Image<float>>(decoded);
    QCOMPARE(image.height(), kHeight);
    QCOMPARE(image.width(), kWidth);
    QCOMPARE(image.channels(), static_cast<int>(found.size()));
    for (int c = 0; c < image.channels(); ++c) {
      const Image<float> wanted = channel(static_cast<float>(found[c]));
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) QCOMPARE(image.at(y, x, c), wanted.at(y, x));
      }
    }
  }

  void damagedFile_isRefused() {
    write({"View Layer.Depth.Z"});
    for (const std::uintmax_t size : {60, 330, 400}) {
      fs::resize_file(path(), size);
      QVERIFY_THROWS_EXCEPTION(IoError, (void)io::decode_image(path()));
    }
  }
};

}  // namespace episcope::in_exr_channels_test

EPISCOPE_TEST(exr_channels_test, ExrChannelsTest)
#include "exr_channels_test.moc"
