// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/image_file.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <array>
#include <fstream>
#include <string>

namespace episcope::in_picture_levels_test {

namespace fs = std::filesystem;

/// Black and white of pictures whose header says which values they have.
class PictureLevelsTest : public QObject {
  Q_OBJECT

 private:
  QTemporaryDir folder_;

  fs::path written(const std::string& name, const std::string& bytes) const {
    const fs::path path = fs::path(folder_.path().toStdString()) / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  template <class T>
  static std::vector<int> samples_of(const fs::path& path) {
    const io::SeenImage read = io::decode_seen(path);
    const auto& image = std::get<Image<T>>(read.image);
    return {image.begin(), image.end()};
  }

 private slots:
  void whiteOfPnm_isWhite() {
    const fs::path bytes = written("a.pgm", "P5 3 1 100\n" + std::string{'\0', 50, 100});
    const fs::path words = written("b.pgm", "P5 2 1 1000\n" + std::string{3, '\xe8', '\0', '\0'});
    QCOMPARE(samples_of<std::uint8_t>(bytes), (std::vector<int>{0, 128, 255}));
    QCOMPARE(samples_of<std::uint16_t>(words), (std::vector<int>{65535, 0}));
  }

  void whiteOfPlainPnm_isWhite() {
    const fs::path bytes = written("plain.pgm", "P2 3 1 100\n0 50 100\n");
    const fs::path words = written("plain_words.pgm", "P2 2 1 1000\n1000 0\n");
    const std::vector<int> levels = samples_of<std::uint8_t>(bytes);
    QCOMPARE(levels.front(), 0);
    QVERIFY(levels[1] == 127 || levels[1] == 128);
    QCOMPARE(levels.back(), 255);
    QCOMPARE(samples_of<std::uint16_t>(words), (std::vector<int>{65535, 0}));
  }

  void labelsOfPnm_keepTheirNumbers() {
    const fs::path labels = written("labels.pgm", "P5 3 1 5\n" + std::string{'\0', 3, 5});
    const Image<std::int32_t> numbers = io::decode_numbers(labels);
    QCOMPARE(std::vector<int>(numbers.begin(), numbers.end()), (std::vector<int>{0, 3, 5}));
  }

  void plainPnm_mayEndWithItsLastNumber() {
    const fs::path plain = written("a.ppm", "P3 2 1 255\n1 2 3\n40 50 60");
    QCOMPARE(samples_of<std::uint8_t>(plain), (std::vector<int>{1, 2, 3, 40, 50, 60}));
  }

  void tiffWhoseZeroIsWhite_isInverted() {
    const auto word = [](int number) {
      return std::string{static_cast<char>(number & 0xFF), static_cast<char>(number >> 8)};
    };
    const auto entry = [&](int tag, int value) {
      return word(tag) + word(3) + word(1) + word(0) + word(value) + word(0);
    };
    constexpr int kStrip = 8 + 2 + 9 * 12 + 4;
    const std::string tiff = std::string("II*\0", 4) + word(8) + word(0) + word(9) + entry(256, 2) +
                             entry(257, 1) + entry(258, 16) + entry(259, 1) + entry(262, 0) +
                             entry(273, kStrip) + entry(277, 1) + entry(278, 1) + entry(279, 4) +
                             word(0) + word(0) + word(65535) + word(1000);
    QCOMPARE(samples_of<std::uint16_t>(written("a.tif", tiff)), (std::vector<int>{0, 64535}));
  }
};

}  // namespace episcope::in_picture_levels_test

EPISCOPE_TEST(picture_levels_test, PictureLevelsTest)
#include "picture_levels_test.moc"
