// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/formats/movie.h"
#include "tests/engine/io/formats/read_movie.h"
#include "tests/test_main.h"

#include <QTemporaryDir>
#include <opencv2/imgcodecs.hpp>

#include <filesystem>

namespace episcope::in_movie_file_test {

using io::MovieFile;
using io::MovieShape;

namespace {

constexpr int kPictures = 5;
constexpr int kHeight = 31, kWidth = 45;  // odd: 4:2:0 needs even sizes

/// Its own color in each picture, and another on the right.
Image<std::uint8_t> picture_number(int i) {
  Image<std::uint8_t> picture(kHeight, kWidth, 4, 255);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      picture.at(y, x, 0) = static_cast<std::uint8_t>(x < kWidth / 2 ? 50 * i : 200);
      picture.at(y, x, 1) = 90;
      picture.at(y, x, 2) = static_cast<std::uint8_t>(x < kWidth / 2 ? 100 : 20);
    }
  }
  return picture;
}

class Folder {
 public:
  [[nodiscard]] std::filesystem::path operator/(const char* name) const {
    return std::filesystem::path(folder_.path().toStdString()) / name;
  }
  [[nodiscard]] bool is_empty() const {
    return std::filesystem::is_empty(folder_.path().toStdString());
  }

 private:
  QTemporaryDir folder_;
};

void write(const std::filesystem::path& path, int width_shown = 0) {
  MovieFile file(path, {kHeight, kWidth, 8, width_shown});
  for (int i = 0; i < kPictures; ++i) file.add(picture_number(i).view());
  file.commit();
}

}  // namespace

class MovieFileTest : public QObject {
  Q_OBJECT

 private slots:
  void movie_isPlayedAsItWasWritten_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<int>("width");
    QTest::addColumn<int>("height");
    QTest::newRow("mp4") << "a.mp4" << 46 << 32;
    QTest::newRow("webm") << "a.webm" << 46 << 32;
    QTest::newRow("gif") << "a.GIF" << kWidth << kHeight;
  }
  void movie_isPlayedAsItWasWritten() {
    QFETCH(const QString, name);
    QFETCH(const int, width);
    QFETCH(const int, height);
    const Folder folder;
    write(folder / qPrintable(name));

    const PlayedMovie movie = read_movie(folder / qPrintable(name));

    QCOMPARE(static_cast<int>(movie.pictures.size()), kPictures);
    QVERIFY2(std::abs(movie.seconds - kPictures / 8.0) < 0.03,
             qPrintable(QString::number(movie.seconds)));
    for (int i = 0; i < kPictures; ++i) {
      const Image<std::uint8_t>& picture = movie.pictures[i];
      QCOMPARE(picture.width(), width);
      QCOMPARE(picture.height(), height);
      QVERIFY(std::abs(picture.at(15, 8, 0) - 50 * i) < 12);
      QVERIFY(std::abs(picture.at(15, 8, 2) - 100) < 12);
      QVERIFY(std::abs(picture.at(15, 38, 0) - 200) < 12);
    }
  }

  void width_scalesBothSides() {
    const Folder folder;
    write(folder / "wide.gif", 2 * kWidth);

    const PlayedMovie movie = read_movie(folder / "wide.gif");

    QCOMPARE(static_cast<int>(movie.pictures.size()), kPictures);
    QCOMPARE(movie.pictures[0].width(), 2 * kWidth);
    QCOMPARE(movie.pictures[0].height(), 2 * kHeight);
  }

  void folder_holdsNumberedImages() {
    const Folder folder;
    write(folder / "frames");

    for (int i = 0; i < kPictures; ++i) {
      const auto file = folder / "frames" / ("frame_000" + std::to_string(i) + ".png");
      const cv::Mat image = cv::imread(file.string());
      QCOMPARE(image.cols, kWidth);
      QCOMPARE(image.rows, kHeight);
      QCOMPARE(image.at<cv::Vec3b>(15, 8), cv::Vec3b(100, 90, static_cast<std::uint8_t>(50 * i)));
    }
    QVERIFY(!std::filesystem::exists(folder / "frames" / "frame_0005.png"));
  }

  void transparentPixels_areWhite() {
    const Folder folder;
    Image<std::uint8_t> picture(8, 8, 4, 0);
    {
      MovieFile file(folder / "frames", {8, 8, 5});
      file.add(picture.view());
      file.commit();
    }
    const cv::Mat image = cv::imread((folder / "frames" / "frame_0000.png").string());
    QCOMPARE(image.at<cv::Vec3b>(3, 3), cv::Vec3b(255, 255, 255));
  }

  void halfAMovie_leavesNothing() {
    const Folder folder;
    for (const char* name : {"a.mp4", "a.gif", "frames"}) {
      MovieFile file(folder / name, {kHeight, kWidth, 8});
      file.add(picture_number(0).view());
    }
    QVERIFY(folder.is_empty());
  }

  void wrongMovies_areRefused() {
    const Folder folder;
    const MovieShape shape{kHeight, kWidth, 8};
    QVERIFY_THROWS_EXCEPTION(InvalidInput, MovieFile(folder / "a.mkv", shape));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, MovieFile(folder / "a.mp4", MovieShape{0, 5, 8}));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, MovieFile(folder / "a.mp4", MovieShape{5, 5, 0}));
    QVERIFY_THROWS_EXCEPTION(IoError, MovieFile("/nowhere/a.mp4", shape));
    MovieFile file(folder / "a.gif", shape);
    QVERIFY_THROWS_EXCEPTION(InvalidInput, file.add(Image<std::uint8_t>(4, 4, 4).view()));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, file.commit());
  }

  void pathThatLooksLikeAnAddress_isAFile() {
    const Folder folder;
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::create_directory(folder / "http:");
    std::filesystem::create_directory(folder / "http:" / "localhost");

    std::filesystem::current_path(folder / ".");
    write("http://localhost/movie.gif");
    std::filesystem::current_path(before);

    QVERIFY(std::filesystem::file_size(folder / "http:" / "localhost" / "movie.gif") > 0);
  }
};

}  // namespace episcope::in_movie_file_test

EPISCOPE_TEST(movie_file_test, MovieFileTest)
#include "movie_file_test.moc"
