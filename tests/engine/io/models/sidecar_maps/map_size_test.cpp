// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/image_file.h"
#include "engine/io/formats/mosaic_layout.h"
#include "engine/io/models/sidecar_maps/map_file.h"
#include "tests/engine/io/models/sidecar_maps/layered_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <cmath>
#include <fstream>

namespace episcope::in_map_size_test {

using namespace episcope::test;

/// Maps of another size than the views, and maps that are matrices of text.
class MapSizeTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<LayeredFolder> folder_;

  ImageView<const float> center() const { return folder_->scene.disparity.view({1, 1}); }
  /// Each value in `times` rows and columns.
  Image<float> enlarged(int times) const {
    Image<float> map(times * center().height, times * center().width);
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) map.at(y, x) = center().at(y / times, x / times);
    }
    return map;
  }
  /// Share of the pixels of the center view that are right.
  double right(const Scene& scene) const {
    if (scene.truth->field.empty()) return 0;
    const DisparityView found = scene.truth->field.view({1, 1});
    double count = 0;
    for (int y = 0; y < center().height; ++y) {
      for (int x = 0; x < center().width; ++x) {
        count += std::abs(found.disparity.at(y, x) - center().at(y, x)) < 1e-4 ? 1 : 0;
      }
    }
    return count / static_cast<double>(center().size());
  }
  void write_text(const std::string& name, const char* separator, const char* head = "") const {
    std::ofstream out(folder_->path(name));
    out << head;
    for (int y = 0; y < center().height; ++y) {
      for (int x = 0; x < center().width; ++x) out << (x > 0 ? separator : "") << center().at(y, x);
      out << "\n";
    }
  }

 private slots:
  void init() {
    folder_ = std::make_unique<LayeredFolder>();
    folder_->write_views(LayeredFolder::named("{}_{}.png"));
  }

  void mapOfTwiceTheSize_countsItsPixelsOrThoseOfTheViews_data() {
    QTest::addColumn<double>("factor");
    QTest::addColumn<bool>("is_own");
    QTest::newRow("its own pixels") << 2.0 << true;
    QTest::newRow("pixels of the views") << 1.0 << false;
  }
  void mapOfTwiceTheSize_countsItsPixelsOrThoseOfTheViews() {
    QFETCH(double, factor);
    QFETCH(bool, is_own);
    const Image<float> map = enlarged(2);
    folder_->write_npy("disparity.npy", map.view(), factor);

    const Scene scene = folder_->open();

    QVERIFY2(right(scene) == 1, describe(scene.convention).c_str());
    QVERIFY(warns_of(scene, "144×120 px, 2 times the size of the views"));
    const bool says_own =
        scene.convention.units.find("px of the map as stored") != std::string::npos;
    QCOMPARE(says_own, is_own);
  }

  void mapOnItsSide_isTurned() {
    Image<float> map(center().width, center().height);
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) map.at(y, x) = center().at(x, y);
    }
    folder_->write_npy("disparity.npy", map.view());

    const Scene scene = folder_->open();

    QVERIFY2(right(scene) == 1, describe(scene.convention).c_str());
    QVERIFY(warns_of(scene, "60×72 px lie on their side beside views of 72×60 px"));
  }

  void mapOfHalfTheSize_isEnlarged() {
    Image<float> map(center().height / 2, center().width / 2);
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) map.at(y, x) = center().at(2 * y, 2 * x);
    }
    folder_->write_npy("disparity.npy", map.view(), 0.5);

    const Scene scene = folder_->open();

    QVERIFY(right(scene) > 0.95);  // all but pixels at the edges of the square
    QVERIFY(warns_of(scene, "36×30 px, a part of 1/2 of the size of the views"));
  }

  void mapOfNoSuchSize_isLeftOut() {
    folder_->write_npy("disparity.npy", Image<float>(41, 97).view());

    QVERIFY(folder_->open().truth->field.empty());
  }

  void medianOfAPixel_leavesInvalidValuesOut() {
    DisparityField field{ViewStack<float>({1, 1}, 2, 4), {}};
    const float values[] = {1, 2, NAN, NAN, 3, 9, NAN, NAN};
    std::copy(std::begin(values), std::end(values), field.disparity.data());

    QCOMPARE(io::resample_to(field, 1, 2).scale, 2.0);

    QCOMPARE(field.disparity.data()[0], 3.0F);
    QVERIFY(field.valid.data()[0] == 1 && field.valid.data()[1] == 0);
  }

  void matrixOfText_isAMap_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<QString>("separator");
    QTest::addColumn<QString>("head");
    QTest::newRow("NumPy") << "disparity.txt"
                           << " "
                           << "# disparity\n";
    QTest::newRow("spreadsheet") << "gt_disp.csv"
                                 << ","
                                 << "";
    QTest::newRow("semicolons") << "disparity.dat"
                                << "; "
                                << "% MATLAB\n\n";
  }
  void matrixOfText_isAMap() {
    QFETCH(QString, name);
    QFETCH(QString, separator);
    QFETCH(QString, head);
    write_text(name.toStdString(), qPrintable(separator), qPrintable(head));

    QCOMPARE(right(folder_->open()), 1.0);
  }

  void otherText_isNoMap() {
    std::ofstream(folder_->path("disparity_info.txt")) << "disp_min -2\ndisp_max 3\n";

    const Scene scene = folder_->open();

    QVERIFY(scene.truth->field.empty() && !warns_of(scene, "disparity_info"));
    QCOMPARE(count_unused(scene, "disparity_info.txt") + count_unused(scene, "*.txt"), 1);
  }

  void raggedText_isLeftOutWithItsRow() {
    write_text("disparity.txt", " ");
    std::ofstream(folder_->path("disparity.txt"), std::ios::app) << "1 2 3\n";

    const Scene scene = folder_->open();

    QVERIFY(scene.truth->field.empty());
    QVERIFY(warns_of(scene, "line 61 has 3 values, but the first row has 72"));
  }

  void fileCalledGroundTruth_isDisparity() {
    folder_->write_npy("gt.npy", center());

    QCOMPARE(right(folder_->open()), 1.0);
  }

  void truthBesideAMosaic_isRead() {
    for (int i = 0; i < 9; ++i) {
      std::filesystem::remove(
          folder_->path(std::to_string(i / 3 + 1) + "_" + std::to_string(i % 3 + 1) + ".png"));
    }
    const Image<std::uint8_t> picture = io::join_lenslets(folder_->scene.views, Progress(1));
    io::write_png(folder_->path("scene_macpi.png"), picture.view());
    folder_->write_npy("disparity.npy", center());
    folder_->write_npy("labels.npy", folder_->scene.labels.view({1, 1}));

    const Scene scene = folder_->open({}, {.grid = "3x3"});

    QCOMPARE(scene.light_field->info().reading.reader, std::string("mosaic"));
    QCOMPARE(right(scene), 1.0);
    const ImageView<const std::int32_t> labels = scene.truth->labels.view({1, 1});
    const ImageView<const std::int32_t> wanted = folder_->scene.labels.view({1, 1});
    for (int y = 0; y < wanted.height; ++y) {
      QVERIFY(std::equal(labels.row(y), labels.row(y) + labels.width, wanted.row(y)));
    }
  }

  void truthBesideSeveralMosaics_isThatOfItsName() {
    const Image<std::uint8_t> picture = io::join_lenslets(folder_->scene.views, Progress(1));
    for (const char* name : {"set/rose_macpi.png", "set/rose_2_macpi.png", "set/oak_macpi.png"}) {
      io::write_png(folder_->place(name), picture.view());
    }
    folder_->write_npy("set/rose_2_disparity.npy", center());
    folder_->write_npy("set/rose_2_labels.npy", folder_->scene.labels.view({1, 1}));
    folder_->write_npy("set/disparity.npy", center());

    QCOMPARE(right(folder_->open("set/rose_2_macpi.png", {.grid = "3x3"})), 1.0);
    for (const char* name : {"set/rose_macpi.png", "set/oak_macpi.png"}) {
      const Scene scene = folder_->open(name, {.grid = "3x3"});
      QVERIFY(!scene.truth || scene.truth->field.empty());
    }
  }
};

}  // namespace episcope::in_map_size_test

EPISCOPE_TEST(map_size_test, MapSizeTest)
#include "map_size_test.moc"
