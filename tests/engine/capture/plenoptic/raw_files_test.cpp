// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/plenoptic/decode_files.h"
#include "engine/capture/plenoptic/processed_container.h"
#include "engine/capture/plenoptic/raw_picture.h"
#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/base/image_file.h"

#include "tests/test_main.h"

#include <QTemporaryDir>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>

namespace episcope::in_raw_files_test {

using namespace capture;

namespace {

namespace fs = std::filesystem;

std::vector<std::uint8_t> bytes_of(const std::string& text) {
  return {text.begin(), text.end()};
}

/// JSON written with single quotes.
std::string json_of(std::string text) {
  std::ranges::replace(text, '\'', '"');
  return text;
}

/// A picture whose samples count up.
RawPicture counting(int bits, Mosaic mosaic, const std::string& serial = "A1") {
  RawPicture raw;
  raw.samples = Image<std::uint16_t>(16, 20);
  for (std::size_t i = 0; i < raw.samples.size(); ++i) {
    raw.samples.data()[i] = static_cast<std::uint16_t>((i * 37) & ((1 << bits) - 1));
  }
  raw.white = (1 << bits) - 1;
  raw.black = 64;
  raw.mosaic = mosaic;
  raw.facts.model = "F01";
  raw.facts.serial = serial;
  raw.facts.zoom_step = 100;
  raw.facts.focus_step = 50;
  raw.colors.balance = {1.5, 1, 1.25};
  raw.colors.to_srgb = {2, -1, 0, 0, 1, 0, 0.5, -0.5, 1};
  raw.colors.gamma = 0.4166;
  return raw;
}

LfpContainer container_of(const RawPicture& raw, bool has_white) {
  LfpContainer container;
  const auto add = [&](const std::vector<std::uint8_t>& data) {
    container.sections.push_back({false, lfp_reference(data), data});
    return container.sections.back().reference;
  };
  const std::string image = add(pack(raw.samples, Packing::Bits10));
  const std::string metadata = add(bytes_of(illum_metadata(raw)));
  std::string table = "{'frames':[{'frame':{'imageRef':'" + image + "','metadataRef':'" + metadata;
  if (has_white) table += "','modulationDataRef':'" + image;
  table = json_of(table + "'}}]}");
  container.sections.insert(container.sections.begin(), {true, {}, bytes_of(table)});
  return container;
}

}  // namespace

class RawFilesTest : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;

  fs::path path(const std::string& name) {
    return folder_.filePath(QString::fromStdString(name)).toStdString();
  }
  fs::path write(const std::string& name, const std::vector<std::uint8_t>& bytes) {
    fs::create_directories(path(name).parent_path());
    std::ofstream file(path(name), std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    return path(name);
  }
  std::vector<std::uint8_t> good_container() {
    write_lfp(path("good.lfr"), container_of(counting(10, Mosaic::Grbg), true));
    std::ifstream file(path("good.lfr"), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  static QString problem(const std::function<void()>& action) {
    try {
      action();
    } catch (const Error& error) {
      return QString::fromUtf8(error.what());
    }
    return "nothing is wrong";
  }
  QString problem_of(const std::string& name, const std::vector<std::uint8_t>& bytes) {
    const fs::path file = write(name, bytes);
    return problem([&] { (void)read_raw(file); });
  }
  /// A depth map of 3×2 px with values 0 to 5, with or without a stack of two pictures.
  fs::path write_processed_container(bool has_pictures) {
    LfpContainer container;
    container.sections.push_back({});
    const auto add = [&](const std::vector<std::uint8_t>& data) {
      container.sections.push_back({false, {}, data});
      return "'imageRef':'" + lfp_reference(data) + "'";
    };
    const std::vector<float> depth{0, 1, 2, 3, 4, 5};
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(depth.data());
    std::string table =
        "{'picture':{'frameArray':[{'frame':{'imageRef':'sha1-0'}}],'accelerationArray':[{"
        "'vendorContent':{'width':3,'height':2,'defaultLambda':-3,'depthMap':{" +
        add({bytes, bytes + depth.size() * sizeof(float)}) + "},'imageArray':[";
    const auto add_picture = [&](std::uint8_t value, const std::string& lambda) {
      io::write_png(path("picture.png"), Image<std::uint8_t>(4, 4, 3, value).view());
      std::ifstream file(path("picture.png"), std::ios::binary);
      table += "{'lambda':" + lambda + "," + add({std::istreambuf_iterator<char>(file), {}}) + "}";
    };
    if (has_pictures) {
      add_picture(20, "4");
      table += ",";
      add_picture(90, "-2.5");
    }
    container.sections.front() = {true, {}, bytes_of(json_of(table + "]}}]}}"))};
    write_lfp(path("processed.lfp"), container);
    return path("processed.lfp");
  }
  /// MOD_nnnn.RAW and .TXT, each with a zoom.
  void write_whites(const std::string& folder, const std::string& serial) {
    for (int i = 0; i < 3; ++i) {
      RawPicture white = counting(10, Mosaic::Grbg, serial);
      white.facts.zoom_step = 90 + 8 * i;
      const std::string stem = folder + "/MOD_000" + std::to_string(i);
      write(stem + ".RAW", pack(white.samples, Packing::Bits10));
      write(stem + ".TXT", bytes_of(illum_metadata(white)));
    }
  }

 private slots:
  void packedSamples_areReadAsWritten_data() {
    QTest::addColumn<int>("packing");
    QTest::addColumn<int>("bits");
    QTest::newRow("10 bit") << int(Packing::Bits10) << 10;
    QTest::newRow("12 bit") << int(Packing::Bits12) << 12;
    QTest::newRow("16 bit") << int(Packing::Bits16) << 16;
  }
  void packedSamples_areReadAsWritten() {
    QFETCH(int, packing);
    QFETCH(int, bits);
    const RawPicture raw = counting(bits, Mosaic::Bggr);
    const auto read = unpack(pack(raw.samples, Packing(packing)), Packing(packing), 16, 20);
    QVERIFY(std::ranges::equal(read, raw.samples));
  }

  // Bytes as public readers take them apart.
  void bits_lieAsCamerasWriteThem() {
    const std::vector<std::uint8_t> twelve{0xAB, 0xCD, 0xEF, 0x12, 0x34, 0x56};
    const auto f01 = unpack(twelve, Packing::Bits12, 1, 4);
    QCOMPARE(int(f01.at(0, 0)), 0xABC);
    QCOMPARE(int(f01.at(0, 1)), 0xDEF);
    const std::vector<std::uint8_t> ten{0xFF, 0x00, 0x80, 0x01, 0b11100100};
    const auto illum = unpack(ten, Packing::Bits10, 1, 4);
    QCOMPARE(int(illum.at(0, 0)), 0x3FC);
    QCOMPARE(int(illum.at(0, 1)), 1);
    QCOMPARE(int(illum.at(0, 2)), 0x202);
    QCOMPARE(int(illum.at(0, 3)), 7);
  }

  void metadata_ofBothGenerations_areRead() {
    const RawPicture f01 = counting(12, Mosaic::Bggr), illum = counting(10, Mosaic::Grbg);
    for (const bool is_first : {true, false}) {
      const RawPicture& raw = is_first ? f01 : illum;
      const RawPicture read =
          raw_from_json(pack(raw.samples, is_first ? Packing::Bits12 : Packing::Bits10),
                        is_first ? f01_metadata(raw) : illum_metadata(raw),
                        json_of("{'camera':{'serialNumber':'B2'}}"));
      QVERIFY(std::ranges::equal(read.samples, raw.samples));
      QCOMPARE(read.mosaic, raw.mosaic);
      QCOMPARE(read.black, 64.0);
      QCOMPARE(read.white, raw.white);
      QCOMPARE(read.facts.serial, std::string("B2"));
      QCOMPARE(*read.facts.zoom_step, 100.0);
      QVERIFY(read.colors.balance == raw.colors.balance);
      QVERIFY(read.colors.to_srgb == raw.colors.to_srgb);
      QCOMPARE(read.colors.gamma, 0.4166);
    }
  }

  // As the camera writes MOD_nnnn.TXT.
  void metadata_ofCalibrationData_areReadWithinTheirFrame() {
    const RawPicture f01 = counting(12, Mosaic::Bggr, "A7");
    const std::string json = calibration_metadata(f01);
    const RawPicture read = raw_from_json(pack(f01.samples, Packing::Bits12), json, {});
    QVERIFY(std::ranges::equal(read.samples, f01.samples));
    QCOMPARE(facts_from_json(json).serial, std::string("A7"));
    QCOMPARE(*facts_from_json(json).zoom_step, 100.0);
    QVERIFY(QString::fromStdString(json).contains("privateMetadata"));
  }

  void container_bringsItsWhitePicture() {
    good_container();
    const RawFile file = read_raw(path("good.lfr"));
    QVERIFY(file.white.has_value());
    QVERIFY(std::ranges::equal(file.raw.samples, counting(10, Mosaic::Grbg).samples));
    QCOMPARE(file.raw.name, std::string("good.lfr"));
  }

  void damagedContainers_areToldInASentence() {
    const std::vector<std::uint8_t> good = good_container();
    QVERIFY(problem_of("empty.lfp", {}).contains("no container of a Lytro camera"));
    QVERIFY(problem_of("text.lfp", bytes_of("hello")).contains("no container"));
    auto cut = good;
    cut.resize(good.size() - 40);
    QVERIFY(problem_of("cut.lfp", cut).contains("the file is cut off"));
    cut.resize(16 + 50);
    QVERIFY(problem_of("header.lfp", cut).contains("is cut off in its header"));
    cut.resize(16);
    QVERIFY(problem_of("nothing.lfp", cut).contains("is missing"));
    auto changed = good;
    changed[16 + 96 + 3] ^= 1;
    QVERIFY(problem_of("changed.lfp", changed).contains("does not match its hash"));
    auto huge = good;
    huge[16 + 12] = 0xFF;
    QVERIFY(problem_of("huge.lfp", huge).contains("claims 42"));
    auto odd = good;
    odd[16] = 0;
    QVERIFY(problem_of("odd.lfp", odd).contains("does not begin with its signature"));
  }

  void impossibleMetadata_areToldInASentence_data() {
    QTest::addColumn<QString>("from");
    QTest::addColumn<QString>("to");
    QTest::addColumn<QString>("expected");
    QTest::newRow("no size") << "\"width\": 20"
                             << "\"width\": 2e9"
                             << "no image width between";
    QTest::newRow("negative") << "\"height\": 16"
                              << "\"height\": -3"
                              << "no image height";
    QTest::newRow("other size") << "\"height\": 16"
                                << "\"height\": 32"
                                << "take 800 bytes, but";
    QTest::newRow("bits") << "\"bitsPerPixel\": 10"
                          << "\"bitsPerPixel\": 11"
                          << "of 11 bits";
    QTest::newRow("no bits") << "\"bitsPerPixel\": 10"
                             << "\"bitsPerPixel\": \"x\""
                             << "unknown bits";
    QTest::newRow("mosaic") << "\"upperLeftPixel\": \"gr\""
                            << "\"upperLeftPixel\": 1"
                            << "upper left pixel";
    QTest::newRow("levels") << "\"gr\": 1023.0"
                            << "\"gr\": 3"
                            << "make no picture";
    QTest::newRow("no JSON") << "{"
                             << ""
                             << "cannot be read as JSON";
    QTest::newRow("no image") << "\"image\""
                              << "\"picture\""
                              << "lack 'image'";
  }
  void impossibleMetadata_areToldInASentence() {
    QFETCH(QString, from);
    QFETCH(QString, to);
    QFETCH(QString, expected);
    const RawPicture raw = counting(10, Mosaic::Grbg);
    QString json = QString::fromStdString(illum_metadata(raw));
    QVERIFY(json.contains(from));
    json.replace(from, to);
    const QString told = problem(
        [&] { (void)raw_from_json(pack(raw.samples, Packing::Bits10), json.toStdString(), {}); });
    QVERIFY2(told.contains(expected), qPrintable(told));
  }

  void processedContainer_isNamedAsSuch() {
    const QString told = problem([&] { (void)read_raw(write_processed_container(true)); });
    QVERIFY2(told.contains("holds a processed picture"), qPrintable(told));
    good_container();
    QVERIFY(!read_processed(path("good.lfr")));
    LfpContainer empty;
    empty.sections.push_back({true, {}, bytes_of(json_of("{'frames':[{'frame':{}}]}"))});
    write_lfp(path("empty-stk.lfp"), empty);
    QVERIFY(
        problem([&] { (void)read_processed(path("empty-stk.lfp")); }).contains("holds neither"));
  }

  void processedPictures_areShownAndWritten() {
    const auto container = read_processed(write_processed_container(true));
    QVERIFY(container.has_value());
    QCOMPARE(container->text(), std::string("2 pictures in focus at λ -2.5 … 4, depthMap of 3×2 px "
                                            "from 0 to 5"));
    const Scene scene = scene_of(*container);
    QCOMPARE(scene.light_field->grid(), (GridShape{1, 1}));
    QCOMPARE(int(*scene.light_field->view<std::uint8_t>({0, 0}).row(0)), 90);  // of λ -2.5
    QVERIFY(is_note(scene.convention.warnings.front()));
    write_processed(path("out"), *container, Progress(1));
    QVERIFY(fs::exists(path("out/picture_00_lambda_-2.5.png")));
    QVERIFY(fs::exists(path("out/picture_01_lambda_4.png")));
    QCOMPARE(io::read_pfm(path("out/depthMap.pfm")).at(1, 2), 5.0F);
  }

  void depthMap_alone_isShownAsGray() {
    const auto container = read_processed(write_processed_container(false));
    const LightFieldPtr field = scene_of(*container).light_field;
    QCOMPARE(field->width(), 3);
    QCOMPARE(field->view<float>({0, 0}).at(0, 0), 0.0F);
    QCOMPARE(field->view<float>({0, 0}).at(1, 2), 1.0F);
  }

  void bareRaw_needsItsJson() {
    const RawPicture raw = counting(10, Mosaic::Grbg);
    write("bare.raw", pack(raw.samples, Packing::Bits10));
    QVERIFY(problem([&] { (void)read_raw(path("bare.raw")); }).contains("with .txt or .json"));
    for (const char* name : {"bare_metadata.json", "bare.txt"}) {
      write(name, bytes_of(illum_metadata(raw)));
      QVERIFY(std::ranges::equal(read_raw(path("bare.raw")).raw.samples, raw.samples));
      fs::remove(path(name));
    }
  }

  void colorPicture_isNoRawPicture() {
    io::write_png(path("color.png"), Image<std::uint8_t>(16, 16, 3).view());
    const QString told = problem([&] { (void)read_raw(path("color.png")); });
    QVERIFY2(told.contains("has one channel, but this has 3"), qPrintable(told));
  }

  void nearestWhite_isTakenFromFolderAndTar() {
    write_whites("calibration", "A1");
    const RawPicture raw = counting(10, Mosaic::Grbg);  // zoom 100; there are 90, 98, 106
    const ChosenWhite chosen = read_white(path("calibration"), raw);
    QCOMPARE(chosen.picture.name, std::string("MOD_0001.RAW"));
    QVERIFY(
        QString::fromStdString(chosen.reason).contains("(zoom 98, focus 50) is the nearest of 3"));
    const std::string tar = "tar -C '" + folder_.path().toStdString() + "' --format=ustar -cf '" +
                            path("caldata-A1.tar").string() + "' calibration";
    if (std::system(tar.c_str()) != 0) QSKIP("there is no tar");
    QCOMPARE(read_white(path("caldata-A1.tar"), raw).picture.name, std::string("MOD_0001.RAW"));
    fs::resize_file(path("caldata-A1.tar"), 1800);
    const QString told = problem([&] { (void)read_white(path("caldata-A1.tar"), raw); });
    QVERIFY2(told.contains("tar archive is cut off"), qPrintable(told));
  }

  // The camera takes two exposures of each zoom and focus; dark ones do not count.
  void betterExposedWhite_isTaken() {
    const RawPicture raw = counting(10, Mosaic::Grbg);
    const auto add = [&](const std::string& stem, double zoom, int divisor) {
      RawPicture white = raw;
      white.facts.zoom_step = zoom;
      for (auto& sample : white.samples) sample = static_cast<std::uint16_t>(sample / divisor);
      write(stem + ".RAW", pack(white.samples, Packing::Bits10));
      write(stem + ".TXT", bytes_of(illum_metadata(white)));
    };
    const std::string stem = "pairs/unit/T1CALIB/data.C.0__C__T1CALIB__MOD_000";
    add(stem + "0", 100, 2);
    add(stem + "1", 100, 1);
    add(stem + "2", 101, 1);
    ChosenWhite chosen = read_white(path("pairs"), raw);
    QCOMPARE(chosen.picture.name, std::string("MOD_0001.RAW"));
    const QString told = QString::fromStdString(chosen.reason);
    QVERIFY2(told.contains("nearest of 3") && told.contains("better exposed than MOD_0000.RAW"),
             qPrintable(told));
    add(stem + "0", 100, 50);
    add(stem + "1", 100, 50);
    QCOMPARE(read_white(path("pairs"), raw).picture.name, std::string("MOD_0002.RAW"));
    add(stem + "2", 101, 50);
    const QString dark = problem([&] { (void)read_white(path("pairs"), raw); });
    QVERIFY2(dark.contains("there is no light in the white pictures"), qPrintable(dark));
  }

  void fewerBits_fillTheRange() {
    fs::create_directories(path("bits"));
    Image<std::uint16_t> samples(64, 80, 1, 700);
    io::write_png(path("bits/a.png"), samples.view());
    samples.at(3, 3) = 900;
    io::write_png(path("bits/white.png"), samples.view());
    io::write_png(path("bits/dark.png"), Image<std::uint8_t>(64, 80, 1, 3).view());
    const FoundPictures found = read_pictures({path("bits/a.png")});
    QCOMPARE(found.pictures.raw.white, 1023.0);
    QCOMPARE(found.pictures.white->white, 1023.0);
    QCOMPARE(found.pictures.dark->white, 255.0);
    QCOMPARE(found.notes.back(), std::string("samples of 10 bits, according to the largest one"));
  }

  void storageContainer_holdsWhitePictures() {
    const RawPicture raw = counting(10, Mosaic::Grbg);
    LfpContainer container;
    container.sections.push_back({});
    std::string files;
    const auto add = [&](const std::string& name, const std::vector<std::uint8_t>& data) {
      container.sections.push_back({false, {}, data});
      files += std::string(files.empty() ? "" : ",") + "{'name':'C:\\\\CALIB\\\\" + name +
               "','dataRef':'" + lfp_reference(data) + "'}";
    };
    add("MOD_0004.RAW", pack(raw.samples, Packing::Bits10));
    add("MOD_0004.TXT", bytes_of(illum_metadata(raw)));
    container.sections.front() = {true, {}, bytes_of(json_of("{'files':[" + files + "]}"))};
    fs::create_directories(path("card"));
    write_lfp(path("card/data.C.0"), container);
    QCOMPARE(read_white(path("card"), raw).picture.name, std::string("MOD_0004.RAW"));
    QCOMPARE(read_white(path("card/data.C.0"), raw).picture.name, std::string("MOD_0004.RAW"));
    QCOMPARE(find_beside(path("card/IMG_0001.lfp"), "white"), path("card"));
  }

  void whiteOfAnotherCamera_isRefusedByNumber() {
    write_whites("other", "B7");
    const RawPicture raw = counting(10, Mosaic::Grbg);
    const QString told = problem([&] { (void)read_white(path("other"), raw); });
    QVERIFY2(told.contains("the raw picture is of A1, they are of B7"), qPrintable(told));
    const QString one = problem([&] { (void)read_white(path("other/MOD_0001.RAW"), raw); });
    QVERIFY2(one.contains("it is of B7, the raw picture of A1"), qPrintable(one));
  }

  void picturesBeside_areFound() {
    fs::create_directories(path("lab"));
    std::uint8_t level = 100;
    for (const char* name : {"lab/a.png", "lab/white.png", "lab/A_dark.png"}) {
      io::write_png(path(name), Image<std::uint8_t>(64, 80, 1, level++).view());
    }
    QCOMPARE(find_beside(path("lab/a.png"), "white"), path("lab/white.png"));
    QCOMPARE(find_beside(path("lab/a.png"), "dark"), path("lab/A_dark.png"));
    const FoundPictures found = read_pictures({path("lab/a.png")});
    QVERIFY(found.pictures.white.has_value() && found.pictures.dark.has_value());
    QCOMPARE(found.notes.size(), std::size_t{2});
    const QString twice = problem(
        [&] { (void)read_pictures({.raw = path("lab/a.png"), .dark = path("lab/white.png")}); });
    QVERIFY2(twice.contains("the dark picture white.png is the same picture as white.png"),
             qPrintable(twice));
    io::write_png(path("lab/a_white.png"), Image<std::uint8_t>(64, 64).view());
    const QString told = problem([&] { (void)read_pictures({path("lab/a.png")}); });
    QVERIFY2(told.contains("a_white.png has 64×64 px, but the raw picture a.png has 80×64"),
             qPrintable(told));
  }

  void optics_areReadInMillimeters() {
    write("a.ini", bytes_of("[sensor]\nmodel=F-145\npixel_size_x=6.45e-3\n[micro_lens]\n"
                            "physical_size_s = 300e-3\n"));
    const RawFacts facts = read_optics(path("a.ini"));
    QCOMPARE(*facts.pixel_pitch_um, 6.45);
    QCOMPARE(*facts.lens_pitch_um, 300.0);
    write("b.ini", bytes_of("nothing"));
    QVERIFY(problem([&] { (void)read_optics(path("b.ini")); }).contains("describes no camera"));
  }
};

}  // namespace episcope::in_raw_files_test

EPISCOPE_TEST(raw_files_test, RawFilesTest)
#include "raw_files_test.moc"
