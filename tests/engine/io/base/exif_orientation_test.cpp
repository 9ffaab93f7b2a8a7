// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/load_views.h"
#include "tests/engine/io/models/sidecar_maps/layered_folder.h"
#include "tests/test_main.h"

#include <fmt/format.h>
#include <zlib.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <fstream>

namespace episcope::in_exif_orientation_test {

using namespace episcope::test;

namespace fs = std::filesystem;

/// Views of a camera that was turned: a wider square before a wall, in files that state how the
/// camera was held.
class ExifOrientationTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<LayeredFolder> folder_;

  /// Turns an upright picture to how a camera held like that stores it.
  static cv::Mat stored(const cv::Mat& upright, int orientation) {
    cv::Mat turned;
    if (orientation == 3) cv::rotate(upright, turned, cv::ROTATE_180);
    if (orientation == 6) cv::rotate(upright, turned, cv::ROTATE_90_COUNTERCLOCKWISE);
    if (orientation == 8) cv::rotate(upright, turned, cv::ROTATE_90_CLOCKWISE);
    return turned.empty() ? upright : turned;
  }
  /// A TIFF structure of one entry, in either byte order.
  static std::string exif(int orientation, bool is_little) {
    const char turn = static_cast<char>(orientation);
    return is_little ? std::string("II*\0\10\0\0\0\1\0\x12\1\3\0\1\0\0\0", 18) +
                           std::string({turn, 0, 0, 0, 0, 0, 0, 0})
                     : std::string("MM\0*\0\0\0\10\0\1\1\x12\0\3\0\0\0\1", 18) +
                           std::string({0, turn, 0, 0, 0, 0, 0, 0});
  }
  static std::string number(std::size_t value, int bytes, bool is_little) {
    std::string text;
    for (int i = 0; i < bytes; ++i) {
      text += static_cast<char>(value >> 8 * (is_little ? i : bytes - 1 - i) & 255);
    }
    return text;
  }
  /// A picture of the form that the suffix names, with such a structure.
  static void write_picture(const fs::path& path, const cv::Mat& picture, int orientation,
                            bool is_little) {
    const std::string form = path.extension().string();
    std::vector<unsigned char> bytes;
    const int quality = form == ".webp" ? cv::IMWRITE_WEBP_QUALITY : cv::IMWRITE_JPEG_QUALITY;
    cv::imencode(form, picture, bytes, {quality, 98});
    std::string file(bytes.begin(), bytes.end());
    const std::string stated = exif(orientation, is_little);
    if (form == ".jpg") {
      const std::string segment = std::string("Exif\0\0", 6) + stated;
      file.insert(2, "\xff\xe1" + number(segment.size() + 2, 2, false) + segment);
    } else if (form == ".png") {
      const std::string chunk = "eXIf" + stated;
      const auto* begin = reinterpret_cast<const unsigned char*>(chunk.data());
      const auto check = crc32(0, begin, static_cast<unsigned>(chunk.size()));
      constexpr std::size_t kAfterHeader = 33;
      file.insert(kAfterHeader, number(stated.size(), 4, false) + chunk + number(check, 4, false));
    } else {
      file += "EXIF" + number(stated.size(), 4, true) + stated;
      file.replace(4, 4, number(file.size() - 8, 4, true));
    }
    std::ofstream(path, std::ios::binary) << file;
  }
  template <class Orientation>
  void write_views(const Orientation& orientation, const std::string& suffix = ".jpg") const {
    folder_->for_views(
        LayeredFolder::named("{}_{}" + suffix), [&](const fs::path& path, ViewIndex view) {
          const auto one = folder_->scene.views.view(view);
          cv::Mat rgb(one.height, one.width, CV_8UC3, const_cast<std::uint8_t*>(one.data));
          cv::Mat bgr(rgb.size(), rgb.type());
          cv::mixChannels(rgb, bgr, {0, 2, 1, 1, 2, 0});
          const int turn = orientation(view);
          write_picture(path, stored(bgr, turn), turn, view.u % 2 == 0);
        });
  }
  double mean_difference(const Scene& scene) const {
    const auto& found = std::get<ViewStack<std::uint8_t>>(scene.light_field->samples());
    const auto& wanted = folder_->scene.views;
    if (found.height() != wanted.height() || found.size() != wanted.size()) return HUGE_VAL;
    double sum = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      sum += std::abs(int{found.data()[i]} - int{wanted.data()[i]});
    }
    return sum / static_cast<double>(found.size());
  }

 private slots:
  void init() { folder_ = std::make_unique<LayeredFolder>(); }

  void viewsOfATurnedCamera_areShownUpright_data() {
    QTest::addColumn<QString>("suffix");
    QTest::addColumn<int>("orientation");
    for (const char* suffix : {".jpg", ".png", ".webp"}) {
      for (const int orientation : {3, 6, 8}) {
        QTest::addRow("%s %d", suffix, orientation) << suffix << orientation;
      }
    }
  }
  void viewsOfATurnedCamera_areShownUpright() {
    QFETCH(QString, suffix);
    QFETCH(int, orientation);
    write_views([&](ViewIndex) { return orientation; }, suffix.toStdString());

    const Scene scene = folder_->open();

    QVERIFY2(mean_difference(scene) < 8, QByteArray::number(mean_difference(scene)));
    QVERIFY(warns_of(scene, fmt::format("(Exif orientation {})", orientation)));
  }

  void viewsThatDiffer_areWarnedOf() {
    write_views([](ViewIndex view) { return view.v == 1 ? 3 : 1; });

    QVERIFY(warns_of(folder_->open(), "2 different orientations (Exif), 6 of 9 orientation 1"));
  }

  void everyOrientation_isUndone() {
    Image<std::uint8_t> picture(2, 3);
    for (int i = 0; i < 6; ++i) picture.data()[i] = static_cast<std::uint8_t>(i);
    const char* expected[] = {"012345", "210543", "543210", "345012",
                              "031425", "304152", "524130", "251403"};
    for (int orientation = 1; orientation <= 8; ++orientation) {
      const auto upright = std::get<Image<std::uint8_t>>(io::upright(picture, orientation));
      std::string text;
      for (const std::uint8_t value : upright) text += static_cast<char>('0' + value);
      QCOMPARE(text, std::string(expected[orientation - 1]));
    }
  }

  void tiffOfATurnedCamera_hasTheSizeOfWhatIsDecoded() {
    constexpr std::size_t kWidth = 30, kHeight = 20, kTags = 10, kSamples = 8 + 2 + 12 * kTags + 4;
    const std::pair<std::size_t, std::size_t> tags[kTags]{
        {256, kWidth},   {257, kHeight}, {258, 8}, {259, 1},       {262, 1},
        {273, kSamples}, {274, 6},       {277, 1}, {278, kHeight}, {279, kWidth * kHeight}};
    std::string file = std::string("II*\0\10\0\0\0", 8) + number(kTags, 2, true);
    for (const auto& [tag, value] : tags) {
      file +=
          number(tag, 2, true) + number(3, 2, true) + number(1, 4, true) + number(value, 4, true);
    }
    file += number(0, 4, true) + std::string(kWidth * kHeight, '\7');
    std::ofstream(folder_->path("a.tif"), std::ios::binary) << file;

    const auto decoded = std::get<Image<std::uint8_t>>(io::decode_image(folder_->path("a.tif")));
    const io::ImageHeader header = io::read_image_header(folder_->path("a.tif"));

    QCOMPARE(decoded.width(), 20);
    QCOMPARE(header.width, decoded.width());
    QCOMPARE(header.height, decoded.height());
  }

  // No parallax tells that from a shift of the cameras.
  void viewsCutOutAtDifferentPlaces_areRefused_data() {
    QTest::addColumn<int>("step");
    QTest::newRow("all at one place") << 0;
    QTest::newRow("each at its own") << 3;
  }
  void viewsCutOutAtDifferentPlaces_areRefused() {
    QFETCH(int, step);
    folder_->for_views(LayeredFolder::named("{}_{}.png"), [&](const fs::path& path,
                                                              ViewIndex view) {
      const auto one = folder_->scene.views.view(view);
      const cv::Mat picture(one.height, one.width, CV_8UC3, const_cast<std::uint8_t*>(one.data));
      std::vector<unsigned char> bytes;
      cv::imencode(".png", picture, bytes);
      std::string file(bytes.begin(), bytes.end());
      const auto x = static_cast<std::size_t>(10 + step * view.u);
      const std::string chunk =
          "oFFs" + number(x, 4, false) + number(20, 4, false) + std::string(1, '\0');
      const auto check = crc32(0, reinterpret_cast<const unsigned char*>(chunk.data()),
                               static_cast<unsigned>(chunk.size()));
      file.insert(33, number(9, 4, false) + chunk + number(check, 4, false));
      std::ofstream(path, std::ios::binary) << file;
    });

    if (step == 0) {
      QCOMPARE(folder_->open().light_field->grid(), (GridShape{3, 3}));
    } else {
      QVERIFY_THROWS_EXCEPTION(IoError, (void)folder_->open());
    }
  }

  void placeOfATiff_isCountedInPixels() {
    const std::pair<std::size_t, std::size_t> ratios[]{{300, 1}, {300, 1}, {1, 25}, {2, 25}};
    std::string file = std::string("II*\0\10\0\0\0", 8) + number(4, 2, true);
    std::string values;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t tag = (i < 2 ? 282 : 284) + i;  // resolution, then position
      file += number(tag, 2, true) + number(5, 2, true) + number(1, 4, true) +
              number(8 + 2 + 12 * 4 + 4 + values.size(), 4, true);
      values += number(ratios[i].first, 4, true) + number(ratios[i].second, 4, true);
    }
    std::ofstream(folder_->path("a.tif"), std::ios::binary) << file + number(0, 4, true) + values;

    QCOMPARE(io::stated_place(folder_->path("a.tif")), (io::PagePlace{12, 24}));
  }

  void damagedExif_isUpright() {
    std::ofstream(folder_->path("a.jpg")) << "\xff\xd8\xff\xe1";
    std::ofstream(folder_->path("b.jpg"), std::ios::binary) << std::string(
        "\xff\xd8\xff\xe1\xff\xff"
        "Exif\0\0II*\0\xff\xff\xff\xff",
        20);
    std::ofstream(folder_->path("c.png"), std::ios::binary)
        << std::string("\x89PNG\r\n\x1a\n\xff\xff\xff\xff", 12);
    std::ofstream(folder_->path("d.webp"), std::ios::binary) << "RIFF\x4\x4\x4\x4WEBPEXIF";

    QCOMPARE(io::exif_orientation(folder_->path("c.png")), 1);
    QCOMPARE(io::exif_orientation(folder_->path("d.webp")), 1);
    QCOMPARE(io::exif_orientation(folder_->path("a.jpg")), 1);
    QCOMPARE(io::exif_orientation(folder_->path("b.jpg")), 1);
    QCOMPARE(io::exif_orientation(folder_->path("none.jpg")), 1);
  }
};

}  // namespace episcope::in_exif_orientation_test

EPISCOPE_TEST(exif_orientation_test, ExifOrientationTest)
#include "exif_orientation_test.moc"
