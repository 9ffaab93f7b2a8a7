// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/labels/label_export.h"
#include "engine/core/error.h"
#include "engine/io/models/labels/label_import.h"
#include "engine/io/models/labels/label_json.h"
#include "engine/io/models/labels/label_shapes.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <algorithm>
#include <fstream>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace episcope::in_label_export_test {

namespace {

constexpr int kHeight = 14;
constexpr int kWidth = 18;
const io::LabelPlaces kPlaces{{{2, 3}, kHeight, kWidth}};

/// Noise of labels 0, 1, 4 and `largest`, with regions that touch at corners and have holes.
ViewStack<std::int32_t> noise(std::int32_t largest) {
  ViewStack<std::int32_t> maps(kPlaces.shape.grid, kHeight, kWidth);
  std::mt19937 random(7);
  const std::int32_t ids[] = {0, 1, 1, 1, 4, largest};
  std::generate_n(maps.data(), maps.size(), [&] { return ids[random() % 6]; });
  return maps;
}

const std::vector<LabelInfo> kInfos{
    {1, "wall", {10, 20, 30}}, {4, "a tree", {0, 200, 0}}, {7, "roof: red", {200, 0, 0}}};

LightFieldPtr gray_field() {
  ViewStack<float> samples(kPlaces.shape.grid, kHeight, kWidth, 3);
  std::fill_n(samples.data(), samples.size(), 0.5F);
  return std::make_shared<const LightField>(LightField::Samples(std::move(samples)),
                                            LightFieldInfo{});
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

/// Rows of digits, with `.` for 0.
QString picture(const Image<std::int32_t>& map) {
  QString text;
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      text += map.at(y, x) == 0 ? QString(".") : QString::number(map.at(y, x));
    }
    text += '/';
  }
  return text;
}

}  // namespace

/// Labels for other tools: what was written comes back to the last pixel.
class LabelExportTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  std::filesystem::path path(const std::string& name) const {
    return std::filesystem::path(folder_->path().toStdString()) / name;
  }

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void everyForm_comesBack_data() {
    QTest::addColumn<int>("form");
    QTest::addColumn<int>("largest");
    for (const auto& form : io::names_of(io::LabelForm{})) {
      for (const int largest : {7, 300}) {
        QTest::addRow("%s, %d", form.name, largest) << static_cast<int>(form.value) << largest;
      }
    }
  }
  void everyForm_comesBack() {
    QFETCH(int, form);
    QFETCH(int, largest);
    const auto maps = noise(largest);

    io::write_label_folder(path("out"), static_cast<io::LabelForm>(form),
                           {maps, kInfos, gray_field()}, Progress());
    const io::ImportedLabels read = io::read_label_files({path("out")}, kPlaces);

    const auto back = io::stack_of(read.scribbles, kPlaces.shape);
    QVERIFY(std::equal(maps.data(), maps.data() + maps.size(), back.data()));
    const auto label = std::ranges::find(read.scribbles.labels, 4, &LabelInfo::id);
    if (form != static_cast<int>(io::LabelForm::Indexed) &&
        form != static_cast<int>(io::LabelForm::Voc)) {
      QVERIFY(label != read.scribbles.labels.end());
    }
    if (label == read.scribbles.labels.end()) return;  // gray pictures have no names
    QCOMPARE(label->name, std::string("a tree"));
    QCOMPARE(label->color, (Rgb{0, 200, 0}));
  }

  // Files of views count from 1, or columns from the right.
  void viewsOfOtherNames_comeBack_data() { everyForm_comesBack_data(); }
  void viewsOfOtherNames_comeBack() {
    QFETCH(int, form);
    QFETCH(int, largest);
    const auto maps = noise(largest);
    for (const std::vector<std::string>& names :
         {std::vector<std::string>{"01_01", "01_02", "01_03", "02_01", "02_02", "02_03"},
          std::vector<std::string>{"00_02", "00_01", "00_00", "01_02", "01_01", "01_00"}}) {
      const io::LabelPlaces places{kPlaces.shape, names};
      const std::filesystem::path folder = path(names.front());

      io::write_label_folder(folder, static_cast<io::LabelForm>(form),
                             {maps, kInfos, gray_field(), places}, Progress());
      const io::ImportedLabels read = io::read_label_files({folder}, places);

      const auto back = io::stack_of(read.scribbles, places.shape);
      QVERIFY(std::equal(maps.data(), maps.data() + maps.size(), back.data()));
    }
  }

  // A form that knows labels by name or color alone once took several for one.
  void labelsOfOneNameAndColor_comeBack_data() {
    QTest::addColumn<int>("form");
    for (const auto& form : io::names_of(io::LabelForm{})) {
      QTest::newRow(form.name) << static_cast<int>(form.value);
    }
  }
  void labelsOfOneNameAndColor_comeBack() {
    QFETCH(int, form);
    const auto maps = noise(7);
    const Rgb red{255, 0, 0};
    const std::vector<LabelInfo> infos{{1, "dog", red}, {4, "dog", red}, {7, "cat", {}}};

    const std::string told = io::write_label_folder(path("out"), static_cast<io::LabelForm>(form),
                                                    {maps, infos}, Progress());
    const io::ImportedLabels read = io::read_label_files({path("out")}, kPlaces);

    const auto back = io::stack_of(read.scribbles, kPlaces.shape);
    QVERIFY(std::equal(maps.data(), maps.data() + maps.size(), back.data()));
    for (const LabelInfo& info : infos) {
      const auto label = std::ranges::find(read.scribbles.labels, info.id, &LabelInfo::id);
      QVERIFY(label != read.scribbles.labels.end());
      QCOMPARE(label->name, info.name);
    }
    QCOMPARE(told.empty(), form == static_cast<int>(io::LabelForm::Coco));
  }

  void idsTooLargeForPictures_nameTheFolder() {
    const auto maps = noise(70000);

    try {
      (void)io::write_label_folder(path("out"), io::LabelForm::Voc, {maps, kInfos}, Progress());
      QFAIL("it was written");
    } catch (const IoError& error) {
      const QString sentence = error.what();
      QVERIFY2(sentence.contains("out") && !sentence.contains(".part"), qPrintable(sentence));
    }
  }

  void labelsWithoutAName_getOne() {
    const auto maps = noise(7);

    io::write_label_folder(path("out"), io::LabelForm::Indexed, {maps, {{1, "", {9, 9, 9}}}},
                           Progress());

    const auto read = io::read_label_files({path("out")}, kPlaces);
    const auto label = std::ranges::find(read.scribbles.labels, 1, &LabelInfo::id);
    QVERIFY(label != read.scribbles.labels.end());
    QCOMPARE(label->name, default_label(1).name);
  }

  void shapesOutsideOfThePicture_areNamed() {
    write_text(path("view.json"), R"({"shapes": [
      {"label": "seen", "points": [[1, 1], [5, 1], [5, 4]], "shape_type": "polygon"},
      {"label": "gone", "points": [[90, 90], [95, 90], [95, 95]], "shape_type": "polygon"}],
      "imagePath": "00_00.png", "imageHeight": 14, "imageWidth": 18})");

    const auto read = io::read_label_files({path("view.json")}, kPlaces);

    const auto is_named = [](const std::string& note) {
      return note.find("belongs to gone in view.json") != std::string::npos;
    };
    QCOMPARE(std::ranges::count_if(read.notes, is_named), 1);
  }

  void filesInAFolder_areNotReplaced() {
    std::filesystem::create_directory(path("out"));
    write_text(path("out/mine.txt"), "mine");
    const auto maps = noise(7);

    QVERIFY_THROWS_EXCEPTION(IoError, io::write_label_folder(path("out"), io::LabelForm::Coco,
                                                             {maps, kInfos}, Progress()));
  }

  void shapesOfLabelme_areDrawnInOrder() {
    write_text(path("view.json"), R"({"version": "5.0.1", "flags": {}, "shapes": [
      {"label": "disc", "points": [[1, 1], [5, 1], [5, 4], [1, 4]], "shape_type": "polygon"},
      {"label": "box", "points": [[2, 2], [4, 3]], "shape_type": "rectangle", "group_id": null},
      {"label": "disc", "points": [[0, 0], [1, 0]], "shape_type": "mask",
       "mask": "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABAQAAAADcWUInAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg=="}],
      "imagePath": "view.png", "imageData": null, "imageHeight": 5, "imageWidth": 7})");
    io::LabelNames names({{3, "box", {1, 2, 3}}});

    const io::LabelJson labels = io::read_label_json(path("view.json"), names);
    const auto& read = std::get<io::JsonPicture>(labels);

    QCOMPARE(picture(read.labels), QString("1....../.1111../.1331../.1111../......./"));
    QCOMPARE(names.labels().size(), std::size_t{2});
    QCOMPARE(names.labels()[1].color, (Rgb{1, 2, 3}));
  }

  void shapesThatLabelmeDoesNotKnow_areLeftOutAndNamed() {
    write_text(path("view.json"), R"({"shapes": [
      {"label": "a", "points": [[2, 2], [4, 4]], "shape_type": "ellipse"},
      {"label": "b", "points": [[0, 0], [0, 2], [2, 2], [2, 0]]}],
      "imagePath": "", "imageHeight": 5, "imageWidth": 5})");
    io::LabelNames names({});

    const io::LabelJson labels = io::read_label_json(path("view.json"), names);

    const auto& read = std::get<io::JsonPicture>(labels);
    QCOMPARE(read.unknown, std::set<std::string>{"ellipse"});
    QVERIFY(read.unseen.empty());
  }

  void linesAndPointsOfLabelme_areTenPixelsWide() {
    write_text(path("view.json"), R"({"shapes": [
      {"label": "a", "points": [[10, 10]], "shape_type": "point"},
      {"label": "a", "points": [[30, 0], [30, 20]], "shape_type": "line"},
      {"label": "a", "points": [[10, 30], [10, 33]], "shape_type": "circle"}],
      "imagePath": "", "imageHeight": 40, "imageWidth": 40})");
    io::LabelNames names({});

    const io::LabelJson labels = io::read_label_json(path("view.json"), names);
    const Image<std::int32_t>& map = std::get<io::JsonPicture>(labels).labels;

    const auto width = [&](int y, int x0, int x1) {
      return std::count(map.row(y) + x0, map.row(y) + x1, 1);
    };
    QCOMPARE(width(9, 0, 20), std::ptrdiff_t{10});
    QCOMPARE(width(12, 20, 40), std::ptrdiff_t{10});
    QCOMPARE(width(29, 0, 20), std::ptrdiff_t{6});
  }

  void polygonsAndRunsOfCoco_areOfTheViewOfTheirPicture() {
    write_text(path("instances.json"), R"({"images": [
        {"id": 8, "file_name": "dir/01_02.png", "height": 14, "width": 18},
        {"id": 9, "file_name": "00_00.png", "height": 14, "width": 18}],
      "annotations": [
        {"id": 1, "image_id": 9, "category_id": 5, "iscrowd": 0,
         "segmentation": [[0, 0, 3, 0, 3, 2, 0, 2], [10, 0, 12, 0, 12, 1, 10, 1]]},
        {"id": 2, "image_id": 8, "category_id": 2, "iscrowd": 1,
         "segmentation": {"size": [14, 18], "counts": [14, 2, 236]}},
        {"id": 3, "image_id": 8, "category_id": 2, "bbox": [0, 0, 2, 2]}],
      "categories": [{"id": 5, "name": "cat"}, {"id": 2, "name": "dog"}]})");

    const io::ImportedLabels read = io::read_label_files({path("instances.json")}, kPlaces);

    QCOMPARE(read.scribbles.views.size(), std::size_t{2});
    QCOMPARE(read.scribbles.views[1].view, (ViewIndex{1, 2}));
    QVERIFY(picture(read.scribbles.views[0].labels).startsWith("555.......55....../555.........."));
    QVERIFY(picture(read.scribbles.views[1].labels).startsWith(".2................/.2......"));
    QCOMPARE(read.notes.back(), std::string("1 annotations have no outline and are left out"));
    QCOMPARE(read.scribbles.labels.size(), std::size_t{2});
    QCOMPARE(read.scribbles.labels[0].name, std::string("dog"));
  }

  void packedRuns_areThoseOfPycocotools() {
    // As pycocotools.mask.encode writes a full mask of 2×2 px: b"04".
    QCOMPARE(io::packed_runs({0, 4}), std::string("04"));
    QCOMPARE(io::packed_runs({100, 3, 97}), std::string("T33Q3"));
    const io::Runs runs{5, 1000, 3, 2, 70000, 1, 1};
    QCOMPARE(io::unpacked_runs(io::packed_runs(runs)), runs);
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)io::unpacked_runs("T"));
  }

  void damagedJson_isRefusedInWords_data() {
    QTest::addColumn<QString>("text");
    QTest::newRow("no JSON") << "{";
    QTest::newRow("other JSON") << "[1, 2]";
    QTest::newRow("a huge picture") << R"({"shapes": [], "imageHeight": 1e9, "imageWidth": 3})";
    QTest::newRow("an unknown shape") << R"({"shapes": [{"label": "a", "points": [[0, 0]],
      "shape_type": "heart"}], "imageHeight": 14, "imageWidth": 18})";
    QTest::newRow("runs of another size")
        << R"({"images": [{"id": 1, "file_name": "", "height": 14, "width": 18}],
               "categories": [{"id": 1, "name": "a"}], "annotations": [{"image_id": 1,
               "category_id": 1, "segmentation": {"size": [14, 18], "counts": [3]}}]})";
    QTest::newRow("an unknown picture")
        << R"({"images": [], "categories": [], "annotations": [{"image_id": 1, "category_id": 1}]})";
  }
  void damagedJson_isRefusedInWords() {
    QFETCH(QString, text);
    write_text(path("labels.json"), text.toStdString());

    QVERIFY_THROWS_EXCEPTION(IoError, (void)io::read_label_files({path("labels.json")}, kPlaces));
  }
};

}  // namespace episcope::in_label_export_test

EPISCOPE_TEST(label_export_test, LabelExportTest)

#include "label_export_test.moc"
