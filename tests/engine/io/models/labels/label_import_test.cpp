// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/labels/label_import.h"
#include "engine/core/error.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/hdf5_output.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/npy.h"
#include "engine/io/models/labels/color_table.h"
#include "tests/test_main.h"

#include <QRegularExpression>
#include <QTemporaryDir>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace episcope::in_label_import_test {

namespace {

constexpr int kHeight = 4;
constexpr int kWidth = 6;
const io::LabelPlaces kPlaces{{{3, 3}, kHeight, kWidth}};

std::filesystem::path tool_file(const QString& name) {
  return std::filesystem::path(EPISCOPE_LABEL_FILES) / name.toStdString();
}

/// Labels in row 2, "0 1 0 2 5 0".
QString row_of(const io::ImportedLabels& labels, std::size_t view = 0) {
  QStringList row;
  for (int x = 0; x < kWidth; ++x) {
    row << QString::number(labels.scribbles.views.at(view).labels.at(2, x));
  }
  return row.join(' ');
}

QString told(const io::ImportedLabels& labels) {
  QStringList notes;
  for (const std::string& note : labels.notes) notes << QString::fromStdString(note);
  return notes.join('\n');
}

QString refusal(const std::vector<std::filesystem::path>& paths) {
  try {
    (void)io::read_label_files(paths, kPlaces);
  } catch (const IoError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

/// Labels of other programs: files in the folder `files` were written by the tools' own libraries.
class LabelImportTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  std::filesystem::path path(const std::string& name) const {
    return std::filesystem::path(folder_->path().toStdString()) / name;
  }
  /// Column 1 in one color, column 3 in another.
  std::filesystem::path colored(const std::string& name, Rgb first, Rgb second) const {
    Image<std::uint8_t> picture(kHeight, kWidth, 3);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        std::ranges::copy(x == 1 ? first : x == 3 ? second : Rgb{}, &picture.at(y, x));
      }
    }
    io::write_png(path(name), picture.view());
    return path(name);
  }
  void write_array(const std::string& name, const std::vector<std::size_t>& shape) const {
    std::size_t count = 1;
    for (const std::size_t length : shape) count *= length;
    std::vector<std::int32_t> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<std::int32_t>(i % 6);
    io::write_npy<std::int32_t>(path(name), shape, values);
  }

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void filesOfTools_giveTheirIds_data() {
    QTest::addColumn<QString>("row");
    QTest::newRow("u32.tif") << "0 1 0 2 5 0";
    QTest::newRow("i64_zlib.tif") << "0 1 0 2 5 0";
    QTest::newRow("big_u64.tif") << "0 1 0 2 5 0";
    QTest::newRow("be_u16.tif") << "0 1 0 2 5 0";
    QTest::newRow("i8.tif") << "0 1 0 2 0 0";
    QTest::newRow("f32.tif") << "0 1 0 2 5 0";
    QTest::newRow("palette.tif") << "0 1 0 2 5 0";
    QTest::newRow("palette.png") << "0 1 0 2 5 0";
    QTest::newRow("onebit.png") << "0 1 0 0 0 0";
    QTest::newRow("onebit.tif") << "0 1 0 0 0 0";
    QTest::newRow("u16.png") << "0 1 0 2 40000 0";
    QTest::newRow("ignore.png") << "0 1 0 2 0 0";
    QTest::newRow("ilastik.h5") << "0 1 0 2 5 0";
  }
  void filesOfTools_giveTheirIds() {
    QFETCH(QString, row);

    const auto labels = io::read_label_files({tool_file(QTest::currentDataTag())}, kPlaces);

    QCOMPARE(labels.scribbles.views.size(), std::size_t{1});
    QCOMPARE(labels.scribbles.views[0].view, (ViewIndex{1, 1}));
    QCOMPARE(row_of(labels), row);
  }

  void palettesOfTiff_giveColors() {
    const auto labels = io::read_label_files({tool_file("palette.tif")}, kPlaces);

    QCOMPARE(labels.scribbles.labels.size(), std::size_t{3});
    QCOMPARE(labels.scribbles.labels[2].id, 5);
    QCOMPARE(labels.scribbles.labels[2].color, (Rgb{128, 0, 128}));
  }

  void pages_areTheViewsRowByRow() {
    const auto labels = io::read_label_files({tool_file("pages.tif")}, kPlaces);

    QCOMPARE(labels.scribbles.views.size(), std::size_t{9});
    QCOMPARE(labels.scribbles.views[5].view, (ViewIndex{1, 2}));
    QCOMPARE(labels.scribbles.views[5].labels.at(0, 0), 6);
  }

  void aChosenId_isUnlabeled() {
    io::LabelReading reading;
    reading.ignored = std::vector<std::int32_t>{};
    QCOMPARE(row_of(io::read_label_files({tool_file("ignore.png")}, kPlaces, reading)),
             QString("0 1 0 2 255 0"));
    reading.ignored = std::vector<std::int32_t>{2};
    const auto labels = io::read_label_files({tool_file("ignore.png")}, kPlaces, reading);
    QCOMPARE(row_of(labels), QString("0 1 0 0 255 0"));
    QVERIFY2(told(labels).contains("2 (16.67 % of the pixels) is taken for unlabeled"),
             qPrintable(told(labels)));
  }

  void ignoredPixels_areNotUnpaintedAsWell() {
    io::LabelReading reading;
    reading.ignored = std::vector<std::int32_t>{2};

    const QString notes = told(io::read_label_files({tool_file("ignore.png")}, kPlaces, reading));

    QVERIFY2(notes.contains("0 (50 % of the pixels) is unpainted"), qPrintable(notes));
  }

  void arrays_areOfOneViewOrAll_data() {
    QTest::addColumn<QList<int>>("shape");
    QTest::addColumn<int>("views");
    QTest::newRow("one") << QList<int>{4, 6} << 1;
    QTest::newRow("one, with single axes") << QList<int>{1, 4, 6, 1} << 1;
    QTest::newRow("list") << QList<int>{9, 4, 6} << 9;
    QTest::newRow("grid") << QList<int>{3, 3, 4, 6} << 9;
  }
  void arrays_areOfOneViewOrAll() {
    QFETCH(QList<int>, shape);
    QFETCH(int, views);
    write_array("labels.npy", {shape.begin(), shape.end()});

    const auto labels = io::read_label_files({path("labels.npy")}, kPlaces);

    QCOMPARE(labels.scribbles.views.size(), static_cast<std::size_t>(views));
    QCOMPARE(row_of(labels, labels.scribbles.views.size() - 1), QString("0 1 2 3 4 5"));
  }

  void arraysOnTheirSide_areTurnedWithANote() {
    write_array("labels.npy", {6, 4});

    const auto labels = io::read_label_files({path("labels.npy")}, kPlaces);

    QCOMPARE(row_of(labels), QString("2 0 4 2 0 4"));
    QVERIFY2(told(labels).contains("4×6 px for views of 6×4 px: rows and columns were exchanged"),
             qPrintable(told(labels)));
  }

  void aCategory0OfCoco_raisesAllWithANote() {
    std::ofstream(path("coco.json"))
        << R"({"images": [{"id": 1, "file_name": "01_01.png", "height": 4, "width": 6}],
              "categories": [{"id": 0, "name": "sky"}, {"id": 3, "name": "sea"}],
              "annotations": [{"image_id": 1, "category_id": 3, "segmentation":
                {"size": [4, 6], "counts": [4, 4, 16]}}]})";

    const auto labels = io::read_label_files({path("coco.json")}, kPlaces);

    QCOMPARE(row_of(labels), QString("0 4 0 0 0 0"));
    QVERIFY2(told(labels).contains("raised by one"), qPrintable(told(labels)));
  }

  void otherShapes_areNamed() {
    write_array("labels.npy", {5, 4, 6});

    const QString sentence = refusal({path("labels.npy")});

    QVERIFY2(sentence.contains("5×4×6") && sentence.contains("3×3 views"), qPrintable(sentence));
  }

  void names_tellViews() {
    colored("mask_02_01.png", {1, 1, 1}, {2, 2, 2});
    colored("photo.png", {1, 1, 1}, {2, 2, 2});
    QCOMPARE(io::read_label_files({path("mask_02_01.png")}, kPlaces).scribbles.views[0].view,
             (ViewIndex{2, 1}));
    QCOMPARE(io::read_label_files({path("photo.png")}, kPlaces).scribbles.views[0].view,
             (ViewIndex{1, 1}));
    const io::LabelPlaces named{kPlaces.shape, {"a", "b", "photo", "d", "e", "f", "g", "h", "i"}};
    QCOMPARE(io::read_label_files({path("photo.png")}, named).scribbles.views[0].view,
             (ViewIndex{0, 2}));
    QVERIFY(!told(io::read_label_files({path("photo.png")}, kPlaces)).contains("names none"));
    colored("07_09.png", {1, 1, 1}, {2, 2, 2});
    const QString note = told(io::read_label_files({path("07_09.png")}, kPlaces));
    QVERIFY2(note.contains("07_09.png names none of the 3×3 views"), qPrintable(note));
    const QString sentence = refusal({path("mask_02_01.png"), path("photo.png")});
    QVERIFY2(sentence.contains("photo.png") && sentence.contains("03_04.png"),
             qPrintable(sentence));
  }

  void runningNumbers_countAllViews() {
    std::vector<std::filesystem::path> files;
    for (int i = 1; i <= 9; ++i) {
      const auto level = static_cast<std::uint8_t>(i);
      files.push_back(colored("cam" + std::to_string(i) + ".png", {level, level, level}, {}));
    }
    std::ranges::reverse(files);

    const auto labels = io::read_label_files(files, kPlaces);

    QCOMPARE(labels.scribbles.views.size(), std::size_t{9});
    QCOMPARE(row_of(labels, 3), QString("0 4 0 0 0 0"));
  }

  void rowsAndColumns_mayBeginWithOne() {
    std::vector<std::filesystem::path> files;
    for (int i = 0; i < 9; ++i) {
      const auto level = static_cast<std::uint8_t>(i + 1);
      files.push_back(
          colored("lf_" + std::to_string(i / 3 + 1) + "_" + std::to_string(i % 3 + 1) + ".png",
                  {level, level, level}, {}));
    }

    const auto labels = io::read_label_files(files, kPlaces);

    QCOMPARE(labels.scribbles.views.size(), std::size_t{9});
    QCOMPARE(labels.scribbles.views[5].view, (ViewIndex{1, 2}));
    QCOMPARE(row_of(labels, 5), QString("0 6 0 0 0 0"));
  }

  void twoFilesOfOneView_areRefused() {
    colored("a_01_01.png", {1, 1, 1}, {});
    colored("b_01_01.png", {1, 1, 1}, {});

    const QString sentence = refusal({path("a_01_01.png"), path("b_01_01.png")});

    QVERIFY2(sentence.contains("b_01_01.png") && sentence.contains("1,1"), qPrintable(sentence));
  }

  void colorsOfVocAndCityscapes_haveTheirIds() {
    const auto voc = io::read_label_files({colored("m.png", {0, 128, 0}, {128, 0, 0})}, kPlaces);
    QCOMPARE(row_of(voc), QString("0 2 0 1 0 0"));
    QVERIFY2(told(voc).contains("the numbers of the colors of PASCAL VOC"), qPrintable(told(voc)));

    const io::LabelReading cityscapes{.table = io::shared_colors()[1].labels};
    const auto city =
        io::read_label_files({colored("m.png", {128, 64, 128}, {0, 0, 142})}, kPlaces, cityscapes);
    QCOMPARE(row_of(city), QString("0 7 0 26 0 0"));
    QCOMPARE(city.scribbles.labels[1].name, std::string("car"));
  }

  void aLabelMapBesidePictures_namesColors() {
    std::ofstream(path("labelmap.txt")) << "# label:color_rgb:parts:actions\nbackground:0,0,0::\n"
                                           "cat:220,20,60::\ndog:48,112,32::\n";
    const auto labels =
        io::read_label_files({colored("m.png", {48, 112, 32}, {220, 20, 60})}, kPlaces);

    QCOMPARE(row_of(labels), QString("0 2 0 1 0 0"));
    QCOMPARE(labels.scribbles.labels[1].name, std::string("dog"));
  }

  void otherFiles_areRefusedInWords() {
    colored("small.png", {1, 1, 1}, {});
    Image<std::uint8_t> large(8, 8);
    io::write_png(path("large.png"), large.view());
    QVERIFY(refusal({path("large.png")}).contains("8×8 px, but views have 6×4 px"));
    std::ofstream(path("notes.txt")) << "1 2 3\n";
    QVERIFY(refusal({path("notes.txt")}).contains("no file of labels"));
    std::vector<float> halves(24, 0.5F);
    io::write_npy<float>(path("halves.npy"), {4, 6}, halves);
    QVERIFY(refusal({path("halves.npy")}).contains("whole numbers"));
    io::write_npy<float>(path("huge.npy"), {4, 6}, std::vector<float>(24, 4294967296.0F));
    QVERIFY(refusal({path("huge.npy")}).contains("at most 2147483646"));
    QVERIFY(refusal({path("nothing.png")}).contains("no such file"));
    std::ofstream(path("damaged.tif"), std::ios::binary) << std::string("II*\0\x08\0\0\0", 8);
    QVERIFY(refusal({path("damaged.tif")}).contains("damaged"));
  }

  void namesOfMoreNumbers_tellViewsByThoseThatVary() {
    std::vector<std::filesystem::path> files;
    for (const char* name : {"00_01_v1.png", "02_01_v1.png", "02_02_v1.png"}) {
      files.push_back(colored(name, {1, 1, 1}, {2, 2, 2}));
    }

    const auto labels = io::read_label_files(files, kPlaces);

    QCOMPARE(labels.scribbles.views[0].view, (ViewIndex{0, 1}));
    QCOMPARE(labels.scribbles.views[2].view, (ViewIndex{2, 2}));
    QVERIFY(!told(labels).contains("as well"));
    const auto alone = io::read_label_files({files[1]}, kPlaces);
    QCOMPARE(alone.scribbles.views[0].view, (ViewIndex{1, 1}));
    QVERIFY2(
        told(alone).contains("02_01_v1.png is taken for view (1,1), but its name may mean view "
                             "(2,1) as well"),
        qPrintable(told(alone)));
    const auto all_vary = io::read_label_files({colored("00_01_v1.png", {1, 1, 1}, {2, 2, 2}),
                                                colored("02_00_v2.png", {1, 1, 1}, {2, 2, 2})},
                                               kPlaces);
    QVERIFY2(told(all_vary).contains("as well"), qPrintable(told(all_vary)));
  }

  void picturesOfCocoThatAreNoViews_areLeftOut() {
    const auto write = [&](const std::string& first) {
      std::string text = R"({"images": [{"id": 1, "file_name": "FIRST"},
                                        {"id": 2, "file_name": "beach.png"}],
              "annotations": [{"image_id": 1, "category_id": 3, "segmentation":
                {"size": [4, 6], "counts": [4, 4, 16]}}]})";
      text.replace(text.find("FIRST"), 5, first);
      std::ofstream(path("coco.json")) << text;
    };
    write("01_02.png");

    const auto labels = io::read_label_files({path("coco.json")}, kPlaces);

    QCOMPARE(row_of(labels), QString("0 3 0 0 0 0"));
    QCOMPARE(labels.scribbles.views[0].view, (ViewIndex{1, 2}));
    QCOMPARE(labels.scribbles.labels[0].name, std::string("label 3"));
    QVERIFY2(told(labels).contains("left out: beach.png"), qPrintable(told(labels)));
    write("town.png");
    const QString sentence = refusal({path("coco.json")});
    QVERIFY2(sentence.contains("coco.json") && sentence.contains("town.png, beach.png"),
             qPrintable(sentence));
  }

  void faultsOfJson_areSentences() {
    std::ofstream(path("a.json")) << R"([{"image_id": 1, "category_id": 3}])";
    QVERIFY(refusal({path("a.json")}).contains("results of COCO without their pictures"));
    std::ofstream(path("a.json")) << R"({"shapes": [{"points": []}], "imagePath": ""})";
    const QString sentence = refusal({path("a.json")});
    QVERIFY2(sentence.contains("'label' is missing") && !sentence.contains("json.exception"),
             qPrintable(sentence));
  }

  void unlabeledShapesOfLabelme_areNoLabels() {
    std::ofstream(path("view.json")) << R"({"shapes": [
      {"label": "all", "points": [[0, 0], [6, 4]], "shape_type": "rectangle"},
      {"label": "__ignore__", "points": [[1, 0], [2, 4]], "shape_type": "rectangle"},
      {"label": "_background_", "points": [[3, 0], [4, 4]], "shape_type": "rectangle"}],
      "imagePath": "", "imageHeight": null, "imageWidth": null})";

    const auto labels = io::read_label_files({path("view.json")}, kPlaces);

    QCOMPARE(row_of(labels), QString("1 0 1 0 1 1"));
    QCOMPARE(labels.scribbles.labels.size(), std::size_t{1});
  }

  void timeAndDepthOfIlastik_areRowsAndColumns() {
    io::AtomicFile target(path("grid.h5"));
    io::Hdf5Output out(target);
    out.add_dataset<std::uint8_t>("exported_data", {3, 3, kHeight, kWidth, 1}, "", "");
    std::vector<std::uint8_t> values(std::size_t{9} * kHeight * kWidth);
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = static_cast<std::uint8_t>(i / (kHeight * kWidth) + 1);
    }
    out.write("exported_data", {{0, 0, 0, 0, 0}, {3, 3, kHeight, kWidth, 1}}, values.data());
    out.set_text(
        "exported_data", "axistags",
        R"({"axes": [{"key": "t"}, {"key": "z"}, {"key": "y"}, {"key": "x"}, {"key": "c"}]})");
    out.close();
    target.commit();

    const auto labels = io::read_label_files({path("grid.h5")}, kPlaces);

    QCOMPARE(labels.scribbles.views.size(), std::size_t{9});
    QCOMPARE(labels.scribbles.views[5].view, (ViewIndex{1, 2}));
    QCOMPARE(row_of(labels, 5), QString("6 6 6 6 6 6"));
  }

  void foldersOfArrays_areRead() {
    std::filesystem::create_directory(path("arrays"));
    std::filesystem::copy(tool_file("ilastik.h5"), path("arrays/00_02.h5"));

    const auto labels = io::read_label_files({path("arrays")}, kPlaces);

    QCOMPARE(labels.scribbles.views[0].view, (ViewIndex{0, 2}));
  }

  void zero_isALabelIfAsked() {
    io::LabelReading reading{.ignored = std::vector<std::int32_t>{255}};
    const auto usual = io::read_label_files({tool_file("ignore.png")}, kPlaces, reading);
    QVERIFY2(told(usual).contains("--first-label 0"), qPrintable(told(usual)));
    reading.zero_is_label = true;

    const auto labels = io::read_label_files({tool_file("ignore.png")}, kPlaces, reading);

    QCOMPARE(row_of(labels), QString("1 2 1 3 0 1"));
    QVERIFY2(told(labels).contains("raised by one"), qPrintable(told(labels)));
  }

  void sharesOfUnlabeledPixels_addUpToAll() {
    const auto labels = io::read_label_files({tool_file("ignore.png")}, kPlaces);

    double sum = 0;
    static const QRegularExpression share("([0-9.]+) % of the pixels");
    for (auto each = share.globalMatch(told(labels)); each.hasNext();) {
      sum += each.next().captured(1).toDouble();
    }
    QVERIFY2(sum < 100, qPrintable(told(labels)));
  }

  void idsOfOtherLabels_becomeFreeOnes() {
    const std::vector<LabelInfo> taken{{10, "apple", {}}, {11, "dog", {}}};
    Scribbles labels;
    labels.labels = {{10, "person", {1, 2, 3}}, {20, "dog", {}}, {30, "tree", {}}};
    Image<std::int32_t> map(1, 5);
    std::ranges::copy(std::vector<std::int32_t>{0, 10, 20, 30, 11}, map.begin());
    labels.views.push_back({{0, 0}, std::move(map)});

    const std::string sentence = io::renumber_labels(labels, 255, taken);

    const Image<std::int32_t>& now = labels.views[0].labels;
    QCOMPARE(std::vector(now.begin(), now.end()), (std::vector<std::int32_t>{0, 1, 11, 30, 2}));
    QVERIFY2(sentence.find("10 (person) is 1, 11 is 2, 20 (dog) is 11") != std::string::npos,
             sentence.c_str());
    QCOMPARE(labels.labels[0].name, std::string("person"));
    QCOMPARE(labels.labels[0].color, (Rgb{1, 2, 3}));
    QVERIFY(io::renumber_labels(labels, 255, {{1, "person", {}}, {11, "dog", {}}}).empty());
  }

  void quotesInNames_stay() {
    std::ofstream(path("t.csv")) << "1,2,3,4,19\" rack\"\n4,5,6,7,\"a, b\"\n";

    const auto table = io::read_color_table(path("t.csv"));

    QCOMPARE(table[0].name, std::string("19\" rack\""));
    QCOMPARE(table[1].name, std::string("a, b"));
  }

  void foldersAndArraysOfLabels_areKnown() {
    const auto& shape = kPlaces.shape;
    std::filesystem::create_directories(path("voc/SegmentationClass"));
    std::filesystem::create_directory(path("views"));
    colored("views/00_00.png", {1, 1, 1}, {2, 2, 2});
    QVERIFY(io::holds_labels_only(path("voc"), &shape));
    QVERIFY(!io::holds_labels_only(path("views"), &shape));
    std::ofstream(path("views/labelmap.txt")) << "a:1,1,1::\n";
    QVERIFY(io::holds_labels_only(path("views"), &shape));
    io::AtomicFile target(path("own.h5"));
    io::Hdf5Output out(target);
    out.add_dataset<std::int32_t>("classes", {kHeight, kWidth}, "", "");
    out.close();
    target.commit();
    QVERIFY(io::holds_labels_only(path("own.h5"), &shape));
    QVERIFY(!io::holds_labels_only(path("own.h5")));
  }

  void floatArrays_areLabelsByTheirNameAlone() {
    const auto& shape = kPlaces.shape;
    for (const char* name : {"values", "labels"}) {
      const std::filesystem::path file = path(std::string(name) + ".h5");
      io::AtomicFile target(file);
      io::Hdf5Output out(target);
      out.add_dataset<float>(name, {kHeight, kWidth}, "", "");
      out.close();
      target.commit();
      QCOMPARE(io::holds_labels_only(file, &shape), std::string(name) == "labels");
    }
  }

  void largeIds_becomeFreeOnes() {
    auto labels = io::read_label_files({tool_file("u16.png")}, kPlaces);

    const std::string sentence = io::renumber_labels(labels.scribbles, 255);

    QCOMPARE(row_of(labels), QString("0 1 0 2 3 0"));
    QCOMPARE(labels.scribbles.labels.at(0).name, std::string("label 40000"));
    QVERIFY(sentence.find("40000 is 3") != std::string::npos);

    auto beside = io::read_label_files({tool_file("u16.png")}, kPlaces);
    (void)io::renumber_labels(beside.scribbles, 255, {{3, "painted before", {}}});
    QCOMPARE(row_of(beside), QString("0 1 0 2 4 0"));
  }
};

}  // namespace episcope::in_label_import_test

EPISCOPE_TEST(label_import_test, LabelImportTest)

#include "label_import_test.moc"
