// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/formats/frames_reader.h"
#include "engine/io/formats/movie.h"
#include "engine/io/formats/tiff_pages.h"
#include "engine/io/models/load_views.h"
#include "engine/io/open.h"
#include "tests/engine/io/formats/described_tiff.h"
#include "tests/engine/io/models/order/layered_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>
#include <opencv2/imgcodecs.hpp>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace episcope::in_frames_test {

using namespace episcope::test;

namespace fs = std::filesystem;

namespace {

/// 4×5 views of 128×96 px.
ViewStack<std::uint8_t> some_views() {
  return layered_views({.grid = {4, 5}});
}

void write_pages(const fs::path& path, const ViewStack<std::uint8_t>& views) {
  std::vector<cv::Mat> pages;
  for (int i = 0; i < views.grid().count(); ++i) {
    const auto view = views.view(views.view_at(i));
    cv::Mat page(view.height, view.width, CV_8UC(view.channels));
    for (std::size_t n = 0; n < view.size(); ++n) {  // pages are written from BGR
      const auto channels = static_cast<std::size_t>(view.channels);
      page.data[n] = view.data[n / channels * channels + (channels - 1 - n % channels)];
    }
    pages.push_back(page);
  }
  QVERIFY(cv::imwrite(path.string(), pages));
}

void write_film(const fs::path& path, const ViewStack<std::uint8_t>& views) {
  io::MovieFile film(path, {views.height(), views.width(), 25, 0});
  for (int i = 0; i < views.grid().count(); ++i) {
    const auto view = views.view(views.view_at(i));
    Image<std::uint8_t> picture(view.height, view.width, 4, 255);
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        for (int c = 0; c < 3; ++c) picture.at(y, x, c) = view.at(y, x, c % view.channels);
      }
    }
    film.add(picture.view());
  }
  film.commit();
}

/// A page for each channel of a view, as ImageJ stores colors of more than 8 bits, or all views in
/// a channel first.
void write_channel_pages(const fs::path& path, const ViewStack<std::uint8_t>& views,
                         bool is_channel_first, int channels = 3) {
  const int count = views.grid().count();
  std::vector<cv::Mat> pages;
  for (int i = 0; i < channels * count; ++i) {
    const int channel = is_channel_first ? i / count : i % channels;
    const auto view = views.view(views.view_at(is_channel_first ? i % count : i / channels));
    cv::Mat page(view.height, view.width, CV_8UC1);
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        page.at<std::uint8_t>(y, x) =
            static_cast<std::uint8_t>(view.at(y, x, 0) * (2 + channel) / 4);
      }
    }
    pages.push_back(page);
  }
  QVERIFY(cv::imwrite(path.string(), pages));
}

/// A BigTIFF file of so many pages without samples.
void write_big_tiff(const fs::path& path, std::uint8_t pages) {
  std::vector<char> bytes{'I', 'I', '+', 0, 8, 0, 0, 0, 16, 0, 0, 0, 0, 0, 0, 0};
  for (int i = 1; i <= pages; ++i) {
    std::vector<char> directory(36, 0);
    directory[0] = 1;  // entry
    if (i < pages) directory[28] = static_cast<char>(16 + 36 * i);
    bytes.insert(bytes.end(), directory.begin(), directory.end());
  }
  std::ofstream(path, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

using Bytes = std::vector<std::uint8_t>;

/// The red channel of views in 16 bits, the pages behind the only directory, as ImageJ writes more
/// than 4 GB.
void write_imagej_stack(const fs::path& path, const ViewStack<std::uint8_t>& views) {
  const std::string text = "ImageJ=1.53t\nimages=" + std::to_string(views.grid().count()) + "\n";
  const auto number = [](std::size_t value, int bytes) {
    std::string written;
    for (int i = bytes; i-- > 0;) written += static_cast<char>(value >> (8 * i));
    return written;
  };
  constexpr std::size_t kTags = 8, kText = 8 + 2 + 12 * kTags + 4;
  const std::size_t samples = kText + text.size() + 1;
  const auto height = static_cast<std::size_t>(views.height());
  const auto width = static_cast<std::size_t>(views.width());
  const auto word = [&](std::size_t tag, std::size_t value) {
    return number(tag, 2) + number(3, 2) + number(1, 4) + number(value, 2) + number(0, 2);
  };
  std::string file = std::string("MM\0*", 4) + number(8, 4) + number(kTags, 2);
  file += word(256, width) + word(257, height) + word(258, 16) + word(262, 1);
  file += number(270, 2) + number(2, 2) + number(text.size() + 1, 4) + number(kText, 4);
  file += word(273, samples) + word(277, 1) + word(278, height) + number(0, 4) + text + '\0';
  for (int i = 0; i < views.grid().count(); ++i) {
    const auto view = views.view(views.view_at(i));
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) file += number(100 * view.at(y, x, 0), 2);
    }
  }
  std::ofstream(path, std::ios::binary) << file;
}

void put_number(Bytes& out, std::uint32_t number) {
  for (int shift = 24; shift >= 0; shift -= 8)
    out.push_back(static_cast<std::uint8_t>(number >> shift));
}

void put_chunk(Bytes& out, const std::string& type, const Bytes& content) {
  put_number(out, static_cast<std::uint32_t>(content.size()));
  Bytes summed(type.begin(), type.end());
  summed.insert(summed.end(), content.begin(), content.end());
  out.insert(out.end(), summed.begin(), summed.end());
  put_number(out, io::checksum(summed));
}

/// The samples of a PNG file, as they are stored.
Bytes samples_of_png(const Bytes& png) {
  Bytes samples;
  for (std::size_t at = 8; at + 12 <= png.size();) {
    const auto length = static_cast<std::size_t>(png[at]) << 24 | png[at + 1] << 16 |
                        png[at + 2] << 8 | png[at + 3];
    const std::string type(png.begin() + static_cast<std::ptrdiff_t>(at) + 4,
                           png.begin() + static_cast<std::ptrdiff_t>(at) + 8);
    const auto begin = png.begin() + static_cast<std::ptrdiff_t>(at) + 8;
    if (type == "IDAT") {
      samples.insert(samples.end(), begin, begin + static_cast<std::ptrdiff_t>(length));
    }
    at += 12 + length;
  }
  return samples;
}

/// An animated PNG of grey views.
void write_animated_png(const fs::path& path, ViewStack<std::uint8_t>& views) {
  Bytes out{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  const auto count = static_cast<std::uint32_t>(views.grid().count());
  const auto size = [&](Bytes& to) {
    put_number(to, static_cast<std::uint32_t>(views.width()));
    put_number(to, static_cast<std::uint32_t>(views.height()));
  };
  Bytes header;
  size(header);
  header.insert(header.end(), {8, 0, 0, 0, 0});
  put_chunk(out, "IHDR", header);
  Bytes animation;
  put_number(animation, count);
  put_number(animation, 0);
  put_chunk(out, "acTL", animation);
  std::uint32_t number = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto view = views.view(views.view_at(static_cast<int>(i)));
    Bytes png;
    cv::imencode(".png", cv::Mat(view.height, view.width, CV_8UC1, view.data), png);
    Bytes control;
    put_number(control, number++);
    size(control);
    put_number(control, 0);
    put_number(control, 0);
    control.insert(control.end(), {0, 1, 0, 25, 0, 0});
    put_chunk(out, "fcTL", control);
    Bytes samples;
    if (i > 0) put_number(samples, number++);
    const Bytes stored = samples_of_png(png);
    samples.insert(samples.end(), stored.begin(), stored.end());
    put_chunk(out, i > 0 ? "fdAT" : "IDAT", samples);
  }
  put_chunk(out, "IEND", {});
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(out.data()), static_cast<std::streamsize>(out.size()));
}

/// States in the track of an MP4 how its pictures are turned: a, b, c, d of an ISO matrix, in
/// 1/65536.
void state_turn(const fs::path& path, std::array<std::int32_t, 4> turn) {
  std::ifstream in(path, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(in), {});
  in.close();
  constexpr std::size_t kMatrix = 44, kNext = 12;  // from the name of the box; from a to c
  const std::size_t track = bytes.find("tkhd");
  QVERIFY(track != std::string::npos);
  for (std::size_t i = 0; i < turn.size(); ++i) {
    const std::size_t at = track + kMatrix + kNext * (i / 2) + 4 * (i % 2);
    const auto number = static_cast<std::uint32_t>(turn[i]);
    for (std::size_t k = 0; k < 4; ++k) bytes[at + k] = static_cast<char>(number >> (24 - 8 * k));
  }
  std::ofstream(path, std::ios::binary) << bytes;
}

double mean_error(const ViewStack<std::uint8_t>& wanted, const LightField& found) {
  const auto& views = std::get<ViewStack<std::uint8_t>>(found.samples());
  double sum = 0;
  for (int i = 0; i < wanted.grid().count(); ++i) {
    const auto a = wanted.view(wanted.view_at(i));
    const auto b = views.view(views.view_at(i));
    for (int y = 0; y < a.height; ++y) {
      for (int x = 0; x < a.width; ++x) {
        sum += std::abs(int{a.at(y, x, 0)} - int{b.at(y, x, 0)});
      }
    }
  }
  return sum / static_cast<double>(wanted.grid().count() * wanted.height() * wanted.width());
}

}  // namespace

class FramesTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  fs::path path(const char* name) const { return fs::path(folder_->path().toStdString()) / name; }
  Scene open(const fs::path& file, const io::OpenOptions& options = {}) const {
    return io::open_scene(file, options, Progress(2));
  }

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void pagesOfATiffFile_areViews() {
    const ViewStack<std::uint8_t> views = some_views();
    write_pages(path("stack.tif"), views);

    const Scene scene = open(path("stack.tif"));

    QCOMPARE(io::count_tiff_pages(path("stack.tif"), 1000), 20);
    QCOMPARE(io::count_tiff_pages(path("stack.tif"), 7), 8);
    QCOMPARE(scene.light_field->grid(), (GridShape{4, 5}));
    QCOMPARE(mean_error(views, *scene.light_field), 0.0);
    QCOMPARE(open(path("")).light_field->grid(), (GridShape{4, 5}));
  }

  void pagesWithoutDirectories_areViews() {
    const ViewStack<std::uint8_t> views = some_views();
    write_imagej_stack(path("stack.tif"), views);

    const Scene scene = open(path("stack.tif"));

    QCOMPARE(io::count_tiff_pages(path("stack.tif"), 1000), 20);
    QCOMPARE(scene.light_field->grid(), (GridShape{4, 5}));
    const auto& read = std::get<ViewStack<std::uint16_t>>(scene.light_field->samples());
    for (std::size_t i = 0; i < read.size(); ++i) {
      QCOMPARE(int{read.data()[i]},
               100 * views.data()[i * static_cast<std::size_t>(views.channels())]);
    }
  }

  void channelsThatTheFileStates_makeColouredViews_data() {
    QTest::addColumn<int>("channels");
    QTest::addColumn<bool>("is_channel_first");
    QTest::addColumn<QByteArray>("description");
    QTest::newRow("ImageJ") << 2 << false
                            << QByteArray("ImageJ=1.53t\nimages=40\nchannels=2\nslices=20\n");
    QTest::newRow("ImageJ, four")
        << 4 << false << QByteArray("ImageJ=1.53t\nimages=80\nchannels=4\nslices=5\nframes=4\n");
    QTest::newRow("OME")
        << 2 << true
        << QByteArray(
               "<?xml version=\"1.0\"?><OME><Pixels DimensionOrder=\"XYZCT\" SizeX=\"128\""
               " SizeY=\"96\" SizeC=\"2\" SizeZ=\"20\" SizeT=\"1\"></Pixels></OME>");
    QTest::newRow("tifffile") << 2 << true << QByteArray(R"({"shape": [2, 4, 5, 96, 128]})");
  }
  void channelsThatTheFileStates_makeColouredViews() {
    QFETCH(int, channels);
    QFETCH(bool, is_channel_first);
    QFETCH(QByteArray, description);
    const ViewStack<std::uint8_t> views = some_views();
    write_channel_pages(path("stack.tif"), views, is_channel_first, channels);
    describe_tiff(path("stack.tif"), description.toStdString());

    const Scene scene = open(path("stack.tif"));

    QCOMPARE(io::tiff_description(path("stack.tif")), description.toStdString());
    QCOMPARE(scene.light_field->grid(), (GridShape{4, 5}));
    const auto& read = std::get<ViewStack<std::uint8_t>>(scene.light_field->samples());
    for (const int channel : {0, 1, 2}) {
      const int wanted =
          channel < channels ? views.view({2, 3}).at(17, 40, 0) * (2 + channel) / 4 : 0;
      QCOMPARE(int{read.view({2, 3}).at(17, 40, channel)}, std::min(wanted, 255));
    }
    QCOMPARE(scene.convention.warnings.size(), channels > 3 ? 1U : 0U);
  }

  // All alike: the views do not tell.
  void gridThatTheFileStates_isTakenIfViewsDoNotTell() {
    write_pages(path("stack.tif"),
                ViewStack<std::uint8_t>({2, 6}, 40, 50, 1, {}, allocate_large_zeros));
    describe_tiff(path("stack.tif"), R"({"shape": [2, 6, 40, 50]})");

    QCOMPARE(open(path("stack.tif")).light_field->grid(), (GridShape{2, 6}));
  }

  // A third of the pages are as many rows of views apart as motion cannot be followed.
  void greyPagesOfManyRows_stayViews() {
    const ViewStack<std::uint8_t> views =
        layered_views({.grid = {9, 5}, .background_px = -2.5, .foreground_px = 3.5});
    write_pages(path("stack.tif"), views);

    QCOMPARE(open(path("stack.tif")).light_field->grid(), (GridShape{9, 5}));
  }

  void pagesOfBigTiff_areCounted() {
    write_big_tiff(path("big.tif"), 3);

    QCOMPARE(io::count_tiff_pages(path("big.tif"), 1000), 3);
  }

  void picturesOfAnAnimatedPng_areViews() {
    ViewStack<std::uint8_t> views = some_views();
    write_animated_png(path("views.png"), views);

    const Scene scene = open(path("views.png"));

    QCOMPARE(scene.light_field->grid(), (GridShape{4, 5}));
    QCOMPARE(mean_error(views, *scene.light_field), 0.0);
    QCOMPARE(open(path("")).light_field->grid(), (GridShape{4, 5}));
  }

  void animatedWebP_isRefusedByName() {
    Bytes bytes{'R', 'I', 'F', 'F', 30,  0,  0, 0, 'W', 'E', 'B',
                'P', 'V', 'P', '8', 'X', 10, 0, 0, 0,   2};
    bytes.resize(64);
    std::ofstream(path("views.webp"), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), 64);

    try {
      (void)open(path("views.webp"));
      QFAIL("it was read");
    } catch (const IoError& error) {
      QVERIFY2(std::string(error.what()).find("animated WebP") != std::string::npos, error.what());
    }
  }

  void picturesOfAFilm_areViews_data() {
    QTest::addColumn<QString>("name");
    QTest::newRow("MP4") << "views.mp4";
    QTest::newRow("WebM") << "views.webm";
    QTest::newRow("GIF") << "views.gif";
  }
  void picturesOfAFilm_areViews() {
    QFETCH(QString, name);
    const ViewStack<std::uint8_t> views = some_views();
    const fs::path file = path(name.toUtf8());
    write_film(file, views);

    const Scene scene = open(file);

    QVERIFY(io::is_film_name(file));
    QCOMPARE(scene.light_field->grid(), (GridShape{4, 5}));
    // Compression and, of GIF, a palette of 256 colors; another view is off by more than 15.
    const double error = mean_error(views, *scene.light_field);
    QVERIFY2(error < 6, qPrintable(QString::number(error)));
  }

  void filmOfATurnedCamera_isUpright_data() {
    QTest::addColumn<std::array<std::int32_t, 4>>("turn");
    QTest::addColumn<int>("orientation");
    constexpr std::int32_t kOne = 1 << 16;
    using Turn = std::array<std::int32_t, 4>;
    QTest::newRow("mirrored") << Turn{-kOne, 0, 0, kOne} << 2;
    QTest::newRow("by half") << Turn{-kOne, 0, 0, -kOne} << 3;
    QTest::newRow("to the right") << Turn{0, kOne, -kOne, 0} << 6;
    QTest::newRow("to the left") << Turn{0, -kOne, kOne, 0} << 8;
  }
  void filmOfATurnedCamera_isUpright() {
    using Turn = std::array<std::int32_t, 4>;
    QFETCH(Turn, turn);
    QFETCH(int, orientation);
    write_film(path("views.mp4"), some_views());
    const io::Film plain = io::read_film(path("views.mp4"), 100, Progress(1));
    state_turn(path("views.mp4"), turn);

    const io::Film turned = io::read_film(path("views.mp4"), 100, Progress(1));

    QCOMPARE(turned.orientation, orientation);
    const auto wanted =
        std::get<Image<std::uint8_t>>(io::upright(plain.pictures.front(), orientation));
    const auto& found = std::get<Image<std::uint8_t>>(turned.pictures.front());
    QCOMPARE(found.height(), wanted.height());
    QCOMPARE(found.width(), wanted.width());
    QVERIFY(std::equal(found.begin(), found.end(), wanted.begin(), wanted.end()));
    const Scene scene = open(path("views.mp4"));
    QCOMPARE(scene.light_field->height(), wanted.height());
    QVERIFY(scene.convention.warnings.front().starts_with("The film states"));
  }

  void filmTurnedByNoQuarter_isRefused() {
    write_film(path("views.mp4"), some_views());
    state_turn(path("views.mp4"), {46341, 46341, -46341, 46341});

    try {
      (void)open(path("views.mp4"));
      QFAIL("it was read");
    } catch (const IoError& error) {
      QVERIFY2(std::string(error.what()).find("turned by 45.0°") != std::string::npos,
               error.what());
    }
  }

  void statedGrid_isTaken() {
    write_pages(path("stack.tif"), some_views());

    QCOMPARE(open(path("stack.tif"), {.grid = "2x10"}).light_field->grid(), (GridShape{2, 10}));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)open(path("stack.tif"), {.grid = "3x7"}));
  }

  void damagedFiles_areRefused() {
    write_film(path("views.mp4"), some_views());
    fs::resize_file(path("views.mp4"), 2000);
    std::ofstream(path("text.avi")) << "no film";
    std::ofstream(path("list.mkv")) << "#EXTM3U\nfile:///etc/hostname\n";
    write_pages(path("stack.tif"), some_views());
    fs::resize_file(path("stack.tif"), fs::file_size(path("stack.tif")) / 2);

    for (const char* name : {"views.mp4", "text.avi", "list.mkv", "stack.tif"}) {
      QVERIFY_THROWS_EXCEPTION(IoError, (void)open(path(name)));
    }
  }

  // Of 1.2 kB, FFmpeg and we took 2.9 GB: of one picture, or of all.
  void filmThatClaimsManyPixels_isRefused_data() {
    QTest::addColumn<QByteArray>("size");
    QTest::newRow("14872×12079") << QByteArray::fromHex("183a2f2f");
    QTest::newRow("4000×4000") << QByteArray::fromHex("a00fa00f");
  }
  void filmThatClaimsManyPixels_isRefused() {
    QFETCH(QByteArray, size);
    const fs::path film = path("views.gif");
    write_film(film, ViewStack<std::uint8_t>({2, 6}, 40, 50, 1, {}, allocate_large_zeros));
    std::fstream file(film, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(6).write(size.constData(), size.size());
    file.close();

    QVERIFY(fs::file_size(film) < 3200);
    try {
      (void)open(film);
      QFAIL("it was read");
    } catch (const IoError& error) {
      QVERIFY2(QString(error.what()).contains("million pixels"), error.what());
    }
  }

  void tiffOfLoops_endsCounting() {
    // A directory without entries that count, and one that leads to itself.
    const std::string loop("II*\0\x08\0\0\0\x01\0\0\x01\x04\0\x01\0\0\0\x01\0\0\0\x08\0\0\0", 26);
    std::ofstream(path("loop.tif"), std::ios::binary) << loop;

    QCOMPARE(io::count_tiff_pages(path("loop.tif"), 50), 51);
    QVERIFY_THROWS_EXCEPTION(IoError, (void)open(path("loop.tif")));
  }
};

}  // namespace episcope::in_frames_test

EPISCOPE_TEST(frames_test, FramesTest)
#include "frames_test.moc"
