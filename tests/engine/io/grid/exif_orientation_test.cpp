// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/exif_orientation.h"

#include "tests/engine/io/beside/layered_folder.h"
#include "tests/test_main.h"

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <fstream>

namespace episcope::in_exif_orientation_test {

using namespace episcope::test;

namespace fs = std::filesystem;

/// Views of a camera that was turned: a wider square before a wall, in JPEG files that state how
/// the camera was held.
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
  /// A JPEG file with an Exif segment of one entry, in either byte order.
  static void write_jpeg(const fs::path& path, const cv::Mat& picture, int orientation,
                         bool is_little) {
    std::vector<unsigned char> jpeg;
    cv::imencode(".jpg", picture, jpeg, {cv::IMWRITE_JPEG_QUALITY, 98});
    const char turn = static_cast<char>(orientation);
    std::string exif = is_little ? std::string("II*\0\10\0\0\0\1\0\x12\1\3\0\1\0\0\0", 18) +
                                       std::string({turn, 0, 0, 0, 0, 0, 0, 0})
                                 : std::string("MM\0*\0\0\0\10\0\1\1\x12\0\3\0\0\0\1", 18) +
                                       std::string({0, turn, 0, 0, 0, 0, 0, 0});
    exif = std::string("Exif\0\0", 6) + exif;
    std::ofstream out(path, std::ios::binary);
    out.write(reinterpret_cast<const char*>(jpeg.data()), 2);
    const std::size_t length = exif.size() + 2;
    out << '\xff' << '\xe1' << static_cast<char>(length >> 8) << static_cast<char>(length & 255)
        << exif;
    out.write(reinterpret_cast<const char*>(jpeg.data()) + 2,
              static_cast<std::streamsize>(jpeg.size() - 2));
  }
  template <class Orientation>
  void write_views(const Orientation& orientation) const {
    folder_->for_views(
        LayeredFolder::named("{}_{}.jpg"), [&](const fs::path& path, ViewIndex view) {
          const auto one = folder_->scene.views.view(view);
          cv::Mat rgb(one.height, one.width, CV_8UC3, const_cast<std::uint8_t*>(one.data));
          cv::Mat bgr(rgb.size(), rgb.type());
          cv::mixChannels(rgb, bgr, {0, 2, 1, 1, 2, 0});
          const int turn = orientation(view);
          write_jpeg(path, stored(bgr, turn), turn, view.u % 2 == 0);
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
    QTest::addColumn<int>("orientation");
    for (const int orientation : {3, 6, 8}) {
      QTest::newRow(qPrintable(QString::number(orientation))) << orientation;
    }
  }
  void viewsOfATurnedCamera_areShownUpright() {
    QFETCH(int, orientation);
    write_views([&](ViewIndex) { return orientation; });

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

  void damagedExif_isUpright() {
    std::ofstream(folder_->path("a.jpg")) << "\xff\xd8\xff\xe1";
    std::ofstream(folder_->path("b.jpg"), std::ios::binary) << std::string(
        "\xff\xd8\xff\xe1\xff\xff"
        "Exif\0\0II*\0\xff\xff\xff\xff",
        20);

    QCOMPARE(io::exif_orientation(folder_->path("a.jpg")), 1);
    QCOMPARE(io::exif_orientation(folder_->path("b.jpg")), 1);
    QCOMPARE(io::exif_orientation(folder_->path("none.jpg")), 1);
  }
};

}  // namespace episcope::in_exif_orientation_test

EPISCOPE_TEST(exif_orientation_test, ExifOrientationTest)
#include "exif_orientation_test.moc"
