// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/labels/color_table.h"
#include "engine/io/models/labels/label_import.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <zlib.h>
#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace episcope::in_label_pictures_test {

namespace {

constexpr int kHeight = 12;
constexpr int kWidth = 16;
const io::FieldShape kShape{{5, 5}, kHeight, kWidth};

using Rgba = std::array<std::uint8_t, 4>;
constexpr Rgba kWhite{255, 255, 255, 255};
constexpr Rgba kGreen{0, 255, 0, 255};
constexpr Rgba kBlue{0, 0, 200, 255};
constexpr Rgba kNothing{0, 0, 0, 0};

/// Two strokes on a ground: columns 3 and 9.
Image<std::uint8_t> drawing(const Rgba& ground, const Rgba& first, const Rgba& second,
                            int channels) {
  Image<std::uint8_t> picture(kHeight, kWidth, channels);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Rgba& color = x == 3 ? first : x == 9 ? second : ground;
      std::copy_n(color.begin(), channels, &picture.at(y, x));
    }
  }
  return picture;
}

std::string word(std::uint32_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift);
  return bytes;
}

std::string chunk(const std::string& type, const std::string& content) {
  const std::string both = type + content;
  const auto sum =
      crc32(0, reinterpret_cast<const Bytef*>(both.data()), static_cast<uInt>(both.size()));
  return word(static_cast<std::uint32_t>(content.size())) + both +
         word(static_cast<std::uint32_t>(sum));
}

/// A PNG of 8-bit indices: 0, but columns 3 and 9, with a palette, of which entry 3 is transparent
/// if that is wanted.
void write_indices(const std::filesystem::path& path, int first, int second, bool is_3_clear) {
  std::string rows;
  for (int y = 0; y < kHeight; ++y) {
    rows += '\0';
    for (int x = 0; x < kWidth; ++x) {
      rows += static_cast<char>(x == 3 ? first : x == 9 ? second : 0);
    }
  }
  uLongf size = compressBound(static_cast<uLong>(rows.size()));
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(rows.data()), static_cast<uLong>(rows.size()));
  packed.resize(size);
  const std::string header = word(kWidth) + word(kHeight) + std::string("\x08\x03\0\0\0", 5);
  const std::string palette("\xff\xff\xff\x00\xff\x00\x00\x00\xff\x00\x80\x00", 12);
  std::ofstream file(path, std::ios::binary);
  file << "\x89PNG\r\n\x1a\n" << chunk("IHDR", header) << chunk("PLTE", palette);
  if (is_3_clear) file << chunk("tRNS", std::string("\xff\xff\xff\x00", 4));
  file << chunk("IDAT", packed) << chunk("IEND", "");
}

int id_at(const io::ImportedLabels& strokes, int x) {
  return strokes.scribbles.views.at(0).labels.at(5, x);
}

std::string told(const io::ImportedLabels& strokes) {
  std::string all;
  for (const std::string& note : strokes.notes) all += note + "\n";
  return all;
}

ViewScribbles painted_view(ViewIndex view, PixelIndex pixel, int id) {
  ViewScribbles painted{view, Image<std::int32_t>(kHeight, kWidth)};
  painted.labels.at(pixel.y, pixel.x) = id;
  return painted;
}

void compare(const Scribbles& a, const Scribbles& b) {
  QCOMPARE(a.views.size(), b.views.size());
  for (std::size_t i = 0; i < a.views.size(); ++i) {
    QCOMPARE(a.views[i].view, b.views[i].view);
    QVERIFY(std::ranges::equal(a.views[i].labels, b.views[i].labels));
  }
}

}  // namespace

class LabelPicturesTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  std::filesystem::path path(const char* name) const {
    return std::filesystem::path(folder_->path().toStdString()) / name;
  }
  std::filesystem::path write(const Image<std::uint8_t>& picture) const {
    io::write_png(path("drawn.png"), picture.view());
    return path("drawn.png");
  }
  std::filesystem::path table(const std::string& text) const {
    std::ofstream(path("colors.csv")) << text;
    return path("colors.csv");
  }

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void pictures_comeBack() {
    Scribbles scribbles;
    scribbles.views = {painted_view({0, 3}, {5, 6}, 255), painted_view({2, 2}, {7, 8}, 1),
                       painted_view({4, 4}, {1, 2}, 700)};

    const auto files = io::write_scribble_pictures(path(""), scribbles);

    QCOMPARE(files.size(), std::size_t{6});
    const io::ImportedLabels read = io::read_label_files({path("")}, {kShape});
    compare(read.scribbles, scribbles);
    QVERIFY(read.notes.empty());
    QVERIFY_THROWS_EXCEPTION(IoError,
                             (void)io::read_label_files({path("")}, {{{2, 5}, kHeight, kWidth}}));
    QVERIFY_THROWS_EXCEPTION(IoError,
                             (void)io::read_label_files({path("")}, {{{5, 5}, kHeight, 3}}));
    QVERIFY_THROWS_EXCEPTION(IoError, (void)io::read_label_files({path("none")}, {kShape}));
  }

  void smoothedStrokes_areDoubted() {
    Image<std::uint8_t> picture = drawing(kWhite, kGreen, kBlue, 3);
    QVERIFY(told(io::read_label_files({write(picture)}, {kShape})).find("smoothed") ==
            std::string::npos);
    for (int y = 0; y < kHeight; ++y) {
      for (const int x : {2, 4, 8, 10}) {
        for (int c = 0; c < 3; ++c) {
          const int stroke = (x < 6 ? kGreen : kBlue)[static_cast<std::size_t>(c)];
          const int of_ground = 8 + x;  // of 20
          picture.at(y, x, c) =
              static_cast<std::uint8_t>((of_ground * 255 + (20 - of_ground) * stroke) / 20);
        }
      }
    }
    const std::string notes = told(io::read_label_files({write(picture)}, {kShape}));

    QVERIFY2(notes.find("of the 6 labels lie only between others") != std::string::npos,
             notes.c_str());
  }

  void onePicture_isOfTheCentreViewUnlessItsNameSaysAnother() {
    Scribbles scribbles;
    scribbles.views.push_back(painted_view({4, 3}, {1, 2}, 7));
    const auto file = io::write_scribble_pictures(path(""), scribbles).front();
    const auto renamed = path("strokes.png");
    std::filesystem::copy_file(file, renamed);

    compare(io::read_label_files({file}, {kShape}).scribbles, scribbles);
    scribbles.views.front().view = {2, 2};
    compare(io::read_label_files({renamed}, {kShape}).scribbles, scribbles);
  }

  void previews_areReadAsTheirIds() {
    Scribbles scribbles;
    scribbles.views.push_back(painted_view({2, 2}, {1, 2}, 7));
    scribbles.views.front().labels.at(3, 3) = 2;
    const auto preview = io::write_scribble_pictures(path(""), scribbles).back();

    compare(io::read_label_files({preview}, {kShape}).scribbles, scribbles);
  }

  void indices_areLabels() {
    write_indices(path("indexed.png"), 1, 2, false);

    const io::ImportedLabels strokes = io::read_label_files({path("indexed.png")}, {kShape});

    QCOMPARE(id_at(strokes, 3), 1);
    QCOMPARE(id_at(strokes, 9), 2);
    QCOMPARE(id_at(strokes, 0), 0);
    QCOMPARE(strokes.scribbles.labels.size(), std::size_t{2});
    QCOMPARE(strokes.scribbles.labels[0].color, (Rgb{0, 255, 0}));
    QVERIFY2(told(strokes).find("index 0 (87.5 % of the pixels) is unpainted") != std::string::npos,
             told(strokes).c_str());
  }

  void transparentIndices_areUnpainted() {
    write_indices(path("indexed.png"), 1, 3, true);

    const io::ImportedLabels strokes = io::read_label_files({path("indexed.png")}, {kShape});

    QCOMPARE(id_at(strokes, 3), 1);
    QCOMPARE(id_at(strokes, 9), 0);
    QVERIFY2(told(strokes).find("transparent pixels (6.25 % of the pixels)") != std::string::npos,
             told(strokes).c_str());
  }

  void aTable_saysWhatThePaletteMeans() {
    write_indices(path("indexed.png"), 1, 2, false);
    const auto colors = table("r,g,b,id,name\n255,255,255,0,paper\n0,255,0,7,a tree\n0;0;255;4\n");

    const io::ImportedLabels strokes = io::read_label_files(
        {path("indexed.png")}, {kShape}, {.table = io::read_color_table(colors)});

    QCOMPARE(id_at(strokes, 3), 7);
    QCOMPARE(id_at(strokes, 9), 4);
    QCOMPARE(id_at(strokes, 0), 0);
    QCOMPARE(strokes.scribbles.labels[1].name, std::string("a tree"));
  }

  void colors_areLabels_data() {
    QTest::addColumn<int>("channels");
    QTest::addColumn<bool>("is_clear");
    QTest::newRow("on white") << 3 << false;
    QTest::newRow("on white, with alpha") << 4 << false;
    QTest::newRow("on nothing") << 4 << true;
  }

  void colors_areLabels() {
    QFETCH(int, channels);
    QFETCH(bool, is_clear);
    const auto file = write(drawing(is_clear ? kNothing : kWhite, kGreen, kBlue, channels));

    const io::ImportedLabels strokes = io::read_label_files({file}, {kShape});

    QCOMPARE(id_at(strokes, 3), 2);
    QCOMPARE(id_at(strokes, 9), 1);
    QCOMPARE(id_at(strokes, 0), 0);
    const std::string notes = told(strokes);
    QVERIFY2(notes.find("1 = #0000c8, 2 = #00ff00") != std::string::npos, notes.c_str());
    QVERIFY2(notes.find("a table of colors states them") != std::string::npos, notes.c_str());
    QVERIFY2(notes.find(is_clear ? "transparent pixels (87.5 %" : "#ffffff (87.5 %") !=
                 std::string::npos,
             notes.c_str());
  }

  void knownColors_haveTheirIds() {
    const auto file = write(drawing(kWhite, kGreen, kBlue, 3));
    const std::vector<LabelInfo> known{{3, "wall", {0, 0, 200}}, {5, "plant", {0, 255, 0}}};

    const io::ImportedLabels strokes = io::read_label_files({file}, {kShape}, {.known = known});

    QCOMPARE(id_at(strokes, 3), 5);
    QCOMPARE(id_at(strokes, 9), 3);
    QVERIFY(strokes.scribbles.labels == known);
    QVERIFY2(told(strokes).find("a table of colors") == std::string::npos, told(strokes).c_str());
  }

  void aDrawingOfKnownColorsAlone_hasNoGround() {
    const auto file = write(drawing(kWhite, kGreen, kBlue, 3));
    const std::vector<LabelInfo> known{
        {1, "paper", {255, 255, 255}}, {3, "wall", {0, 0, 200}}, {5, "plant", {0, 255, 0}}};

    const io::ImportedLabels strokes = io::read_label_files({file}, {kShape}, {.known = known});

    QCOMPARE(id_at(strokes, 0), 1);
    QVERIFY2(told(strokes).find("every pixel is painted") != std::string::npos,
             told(strokes).c_str());
  }

  void aColorThatTheTableLacks_isNamed() {
    const auto file = write(drawing(kWhite, kGreen, kBlue, 3));
    const auto colors = io::read_color_table(table("0 255 0 1 tree\n"));

    try {
      (void)io::read_label_files({file}, {kShape}, {.table = colors});
      QFAIL("a color without a label was read");
    } catch (const IoError& error) {
      QVERIFY2(std::string(error.what()).find("12 px of the color #0000c8 (0,0,200)") !=
                   std::string::npos,
               error.what());
    }
  }

  void photographs_areRefused() {
    Image<std::uint8_t> photograph(kHeight, kWidth, 3);
    for (std::size_t i = 0; i < photograph.size(); ++i) {
      photograph.data()[i] = static_cast<std::uint8_t>(i * 37 + i / 7);
    }
    const auto file = write(photograph);

    QVERIFY_THROWS_EXCEPTION(IoError, (void)io::read_label_files({file}, {kShape}));
  }

  void jpeg_isRefused() {
    for (const char* name : {"strokes.jpg", "strokes.png"}) {
      const std::filesystem::path file = folder_->filePath(name).toStdString();
      std::ofstream(file, std::ios::binary) << "\xFF\xD8\xFF\xE0 and so on";
      try {
        (void)io::read_label_files({file}, {kShape});
        QFAIL("a JPEG picture is read");
      } catch (const IoError& error) {
        QVERIFY(QString(error.what()).contains("JPEG") && QString(error.what()).contains("PNG"));
      }
    }
  }

  void grayInColor_isOfNumbers() {
    const auto file = write(drawing({0, 0, 0, 255}, {1, 1, 1, 255}, {2, 2, 2, 255}, 3));

    const io::ImportedLabels strokes = io::read_label_files({file}, {kShape});

    QCOMPARE(id_at(strokes, 3), 1);
    QCOMPARE(id_at(strokes, 9), 2);
  }

  void nothingPainted_isRefused() {
    const auto file = write(drawing(kNothing, kNothing, kNothing, 4));

    QVERIFY_THROWS_EXCEPTION(IoError, (void)io::read_label_files({file}, {kShape}));
  }

  void badTables_nameTheLine_data() {
    QTest::addColumn<QString>("text");
    QTest::newRow("a word for a level") << "0,255,0,1,a\n0,x,0,2,b\n";
    QTest::newRow("a level too high") << "0,255,0,1,a\n0,256,0,2,b\n";
    QTest::newRow("no id") << "0,255,0,1,a\n0,0,255\n";
    QTest::newRow("a color twice") << "0,255,0,1,a\n0,255,0,2,b\n";
  }

  void badTables_nameTheLine() {
    QFETCH(QString, text);
    try {
      (void)io::read_color_table(table(text.toStdString()));
      QFAIL("the table was read");
    } catch (const IoError& error) {
      QVERIFY2(std::string(error.what()).find("line 2") != std::string::npos, error.what());
    }
  }
};

}  // namespace episcope::in_label_pictures_test

EPISCOPE_TEST(label_pictures_test, LabelPicturesTest)
#include "label_pictures_test.moc"
