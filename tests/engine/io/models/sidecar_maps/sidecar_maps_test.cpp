// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/exchange_files.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/npy.h"
#include "engine/io/models/scribble_file.h"
#include "engine/io/models/sidecar_maps/sidecar_labels.h"
#include "engine/io/open.h"
#include "tests/engine/io/models/sidecar_maps/layered_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <fstream>

namespace episcope::in_sidecar_maps_test {

using namespace episcope::test;

namespace fs = std::filesystem;

/// Folders of views with truth beside them, in the forms in use.
class SidecarMapsTest : public QObject {
  Q_OBJECT

 private:
  static LayeredFolder::Name named(const std::string& form) { return LayeredFolder::named(form); }
  /// Largest difference from the truth in the views that `scene` covers; infinite if a pixel lacks.
  static double error_of(const Scene& scene, const LayeredScene& truth) {
    const DisparityField& field = scene.truth->field;
    if (field.empty()) return HUGE_VAL;
    double largest = 0;
    for (int i = 0; i < field.disparity.grid().count(); ++i) {
      const ViewIndex view = field.disparity.view_at(i);
      const DisparityView map = field.view(view);
      for (int y = 0; y < map.disparity.height; ++y) {
        for (int x = 0; x < map.disparity.width; ++x) {
          if (!map.is_valid(y, x)) return HUGE_VAL;
          const double expected = truth.disparity.view(view).at(y, x);
          largest = std::max(largest, std::abs(map.disparity.at(y, x) - expected));
        }
      }
    }
    return largest;
  }
  static bool has_labels(const Scene& scene, const LayeredScene& truth, int add = 0) {
    const ViewStack<std::int32_t>& labels = scene.truth->labels;
    if (labels.empty()) return false;
    for (int i = 0; i < labels.grid().count(); ++i) {
      const ViewIndex view = labels.view_at(i);
      const auto expected = truth.labels.view(view);
      for (std::size_t p = 0; p < labels.view_size(); ++p) {
        if (labels.view(view).data[p] != expected.data[p] + add) return false;
      }
    }
    return true;
  }
  static Rgb urban_color(int id) {
    return io::urban_classes()[static_cast<std::size_t>(id - 1)].color;
  }
  static bool is_in_order(const Scene& scene) {
    return !scene.convention.reversed_u && !scene.convention.reversed_v;
  }
  static bool units_say(const Scene& scene, const char* text) {
    return units_text(scene.convention).find(text) != std::string::npos;
  }
  static void write_text(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
  }

 private slots:
  void urbanSynthetic_isReadWhole() {
    const LayeredFolder folder;
    folder.write_views(named("{}_{}.png"));
    folder.write_npy(named("{}_{}_disparity.npy"), folder.scene.disparity);
    folder.write_npy(named("{}_{}_depth.npy"), folder.scene.depth);
    folder.write_npy(named("{}_{}_label.npy"), folder.scene.labels);
    folder.for_views(named("{}_{}_label.png"), [&](const fs::path& file, ViewIndex view) {
      folder.write_colors(file.filename().string(), folder.scene.labels.view(view), urban_color);
    });

    const Scene read = folder.open();

    QVERIFY2(error_of(read, folder.scene) == 0, describe(read.convention).c_str());
    QCOMPARE(read.truth->field.disparity.grid(), (GridShape{3, 3}));
    QVERIFY(is_in_order(read));
    QVERIFY(has_labels(read, folder.scene));
    QCOMPARE(read.scribbles.labels.size(), std::size_t{14});
    QVERIFY(read.scribbles.empty());
    // Depth is stored with 24 bits.
    QVERIFY(std::abs(read.light_field->info().camera.depth_from_disparity(0) - 12) < 1e-3);
    QCOMPARE(count_used(read, "views"), 9);
    QCOMPARE(count_used(read, "disparity maps"), 9);
    QCOMPARE(count_used(read, "depth maps"), 9);
    QCOMPARE(count_used(read, "UrbanLF label maps"), 9);
    QCOMPARE(count_used(read, "label pictures"), 9);
  }

  void urbanReal_hasLabelsOfTheCenter_data() {
    QTest::addColumn<bool>("has_numbers");
    QTest::addColumn<bool>("has_picture");
    QTest::newRow("both") << true << true;
    QTest::newRow("numbers") << true << false;
    QTest::newRow("picture") << false << true;
  }
  void urbanReal_hasLabelsOfTheCenter() {
    QFETCH(bool, has_numbers);
    QFETCH(bool, has_picture);
    const LayeredFolder folder;
    const auto labels = folder.scene.labels.view({1, 1});
    folder.write_views(named("{}_{}.png"));
    if (has_numbers) folder.write_npy("label.npy", labels);
    if (has_picture) folder.write_colors("label.png", labels, urban_color);

    const Scene read = folder.open();

    QCOMPARE(read.truth->labels.first(), (ViewIndex{1, 1}));
    QCOMPARE(read.truth->labels.grid(), (GridShape{1, 1}));
    QVERIFY(has_labels(read, folder.scene));
    QCOMPARE(read.scribbles.labels.empty(), !has_picture);
  }

  void urbanLabelsFromZero_areRaised() {
    const LayeredFolder folder;
    folder.write_views(named("{}_{}.png"));
    folder.write_npy(named("{}_{}_label.npy"), folder.scene.labels, -2);

    const Scene read = folder.open();

    QVERIFY(has_labels(read, folder.scene, -1));
    QVERIFY(read.convention.raised_labels);
    QVERIFY(warns_of(read, "raised by one"));
  }

  void mapsOfManyForms_areTheSame_data() {
    QTest::addColumn<QString>("views");
    QTest::addColumn<QString>("maps");
    QTest::addColumn<QString>("opened");
    QTest::newRow("INRIA") << "lf_{}_{}.png"
                           << "disparity_{}_{}.npy"
                           << "";
    QTest::newRow("upper case") << "{}_{}.png"
                                << "{}_{}_Disparity.PFM"
                                << "";
    QTest::newRow("tiff") << "cam_{}_{}.png"
                          << "disp_0{}_0{}.tiff"
                          << "";
    QTest::newRow("folder") << "{}_{}.png"
                            << "gt/{}_{}_disp.pfm"
                            << "";
    QTest::newRow("beside the folder of views") << "lf/{}_{}.png"
                                                << "disparity/{}_{}.npy"
                                                << "lf";
  }
  void mapsOfManyForms_areTheSame() {
    QFETCH(QString, views);
    QFETCH(QString, maps);
    QFETCH(QString, opened);
    const LayeredFolder folder;
    folder.write_views(named(views.toStdString()));
    folder.for_views(named(maps.toStdString()), [&](const fs::path& file, ViewIndex view) {
      const auto map = folder.scene.disparity.view(view);
      if (file.extension() == ".npy") {
        folder.write_npy(fs::relative(file, folder.path()).string(), map);
      } else if (file.extension() == ".tiff") {
        io::write_tiff(file, map);
      } else {
        io::write_pfm(file, map);
      }
    });

    const Scene read = folder.open(opened.toStdString());

    QVERIFY2(error_of(read, folder.scene) == 0, describe(read.convention).c_str());
    QCOMPARE(read.truth->field.disparity.grid().count(), 9);
    QCOMPARE(count_used(read, "disparity maps"), 9);
    QVERIFY(is_in_order(read));
  }

  void oneArrayOfAllViews_isReadWhole() {
    const LayeredFolder folder;
    folder.write_views(named("{}_{}.png"));
    const ViewStack<float>& maps = folder.scene.disparity;
    io::write_npy<float>(folder.path("disparity.npy"), {3, 3, 60, 72},
                         {maps.data(), maps.data() + maps.size()});

    const Scene read = folder.open();

    QVERIFY(error_of(read, folder.scene) == 0);
    QCOMPARE(read.truth->field.disparity.grid(), (GridShape{3, 3}));
  }

  void signAndUnit_followFromTheViews_data() {
    QTest::addColumn<double>("factor");
    QTest::addColumn<QString>("says");
    QTest::newRow("as it should be") << 1.0 << "px per view step; ";
    QTest::newRow("negative = nearer") << -1.0 << "negative = nearer";
    QTest::newRow("whole baseline") << 4.0 << "4 steps of the whole baseline";
    QTest::newRow("negative, whole baseline") << -4.0 << "baseline, negative = nearer";
  }
  void signAndUnit_followFromTheViews() {
    QFETCH(double, factor);
    QFETCH(QString, says);
    const LayeredFolder folder({5, 5});
    folder.write_views(named("{}_{}.png"));
    folder.write_npy("gt_disparity.npy", folder.scene.disparity.view({2, 2}), factor);

    const Scene read = folder.open();

    QVERIFY2(error_of(read, folder.scene) < 1e-6, describe(read.convention).c_str());
    QVERIFY2(units_say(read, says.toUtf8()), units_text(read.convention).c_str());
    QVERIFY(is_in_order(read));
  }

  void viewsTheOtherWayRound_keepTheSignOfTheTruth() {
    const LayeredFolder folder;
    folder.write_views([](int row, int column) {
      return std::to_string(4 - row) + "_" + std::to_string(4 - column) + ".png";
    });
    folder.write_npy("disparity.npy", folder.scene.disparity.view({1, 1}));

    const Scene read = folder.open();

    QVERIFY(read.convention.reversed_u && read.convention.reversed_v);
    QVERIFY(error_of(read, folder.scene) == 0);
  }

  void cambridgeBaseline_isTheUnit() {
    const LayeredFolder folder;
    folder.write_views(named("scene/0.5/{}_{}.png"));
    write_text(folder.path("scene/0.5/param.txt"), "num_x: 3\nnum_y: 3\nbase_x: 0.05\n");
    folder.write_npy("scene/disparity.npy", folder.scene.disparity.view({1, 1}), 20);

    const Scene read = folder.open("scene/0.5");

    QVERIFY2(error_of(read, folder.scene) < 1e-6, describe(read.convention).c_str());
    QCOMPARE(count_used(read, "parameter files"), 1);
  }

  void depthWithoutACamera_isNotUsed() {
    const LayeredFolder folder;
    folder.write_views(named("{}_{}.png"));
    folder.write_npy(named("{}_{}_depth.npy"), folder.scene.depth);

    const Scene read = folder.open();

    QVERIFY(!read.truth->has_disparity());
    QCOMPARE(count_unused(read, "depth maps, as no camera parameters are known"), 9);
  }

  void picturesOfDepth_areNotUsed() {
    const LayeredFolder folder;
    folder.write_views(named("{}_{}.png"));
    folder.for_views(named("{}_{}_depth.png"), [&](const fs::path& file, ViewIndex) {
      io::write_png(file, Image<std::uint16_t>(60, 72, 1, 4000).view());
    });

    const Scene read = folder.open();

    QVERIFY(!read.truth->has_disparity());
    QCOMPARE(count_unused(read, "pictures of depth, of unknown scale"), 9);
  }

  void damagedMaps_areLeftOut_data() {
    QTest::addColumn<QByteArray>("content");
    QTest::addColumn<QString>("says");
    QTest::newRow("other file") << QByteArray("no array") << ".npy";
    QTest::newRow("truncated")
        << QByteArray(
               "\x93NUMPY\x01\x00\x46\x00{'descr': '<f4', 'fortran_order': False, "
               "'shape': (60, 72), }             \n",
               80)
        << "3_2_disparity.npy";
    QTest::newRow("empty") << QByteArray() << "3_2_disparity.npy";
  }
  void damagedMaps_areLeftOut() {
    QFETCH(QByteArray, content);
    QFETCH(QString, says);
    const LayeredFolder folder;
    folder.write_views(named("{}_{}.png"));
    folder.write_npy(named("{}_{}_disparity.npy"), folder.scene.disparity);
    write_text(folder.path("3_2_disparity.npy"), content.toStdString());

    const Scene read = folder.open();

    QVERIFY(warns_of(read, "1 of 9 disparity maps are left out"));
    QVERIFY(warns_of(read, says.toStdString()));
    QCOMPARE(count_used(read, "disparity maps"), 8);
    QCOMPARE(count_unused(read, "disparity maps that are damaged or do not fit"), 1);
    const DisparityField& field = read.truth->field;
    QVERIFY(!field.view({2, 1}).is_valid(5, 5));
    QVERIFY(field.view({2, 2}).is_valid(5, 5));
  }

  void mapsOfAnotherSize_areLeftOut() {
    const LayeredFolder folder;
    folder.write_views(named("{}_{}.png"));
    const Image<float> small(31, 36, 1, 1.0F);
    folder.for_views(named("{}_{}_disparity.pfm"),
                     [&](const fs::path& file, ViewIndex) { io::write_pfm(file, small.view()); });
    folder.write_npy(named("{}_{}_label.npy"), folder.scene.labels);

    const Scene read = folder.open();

    QVERIFY(!read.truth->has_disparity());
    QVERIFY(warns_of(read, "36×31 px, but the views have 72×60 px"));
    QVERIFY(has_labels(read, folder.scene));
  }

  // By repeated samples, as programs pad whose sizes are multiples of 16.
  void mapsThatMayBePadded_areLeftOutWithTheRemedy() {
    const LayeredFolder folder;
    folder.write_views(named("{}_{}.png"));
    Image<float> large(64, 80);
    for (int y = 0; y < large.height(); ++y) {
      for (int x = 0; x < large.width(); ++x) large.at(y, x) = static_cast<float>(x + y);
    }
    io::write_pfm(folder.path("disparity.pfm"), large.view());

    const Scene read = folder.open();

    QVERIFY(!read.truth->has_disparity());
    QVERIFY2(warns_of(read, "cut it by episcope-cli convert --map-crop corner --truth"),
             describe(read.convention).c_str());
  }

  void mapsThatExplainNothing_areWarnedOf() {
    const LayeredFolder folder;
    folder.write_views(named("{}_{}.png"));
    const Image<float> wrong(60, 72, 1, 9.0F);
    folder.write_npy("disparity.npy", wrong.view());

    const Scene read = folder.open();

    QVERIFY(warns_of(read, "hardly explains the views"));
  }

  void validMasks_limitTheTruth_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<bool>("marks_valid");
    QTest::newRow("valid") << "{}_{}_valid.png" << true;
    QTest::newRow("mask") << "masks/{}_{}.png" << true;
    QTest::newRow("invalid") << "{}_{}_invalid.png" << false;
  }
  void validMasks_limitTheTruth() {
    QFETCH(QString, name);
    QFETCH(bool, marks_valid);
    const LayeredFolder folder;
    folder.write_views(named("{}_{}.png"));
    folder.write_npy(named("{}_{}_disparity.npy"), folder.scene.disparity);
    folder.for_views(named(name.toStdString()), [&](const fs::path& file, ViewIndex) {
      Image<std::uint8_t> mask(60, 72, 1, marks_valid ? 255 : 0);
      for (int x = 0; x < 72; ++x) mask.at(3, x) = marks_valid ? 0 : 255;
      io::write_png(file, mask.view());
    });

    const Scene read = folder.open();

    const DisparityView map = read.truth->field.view({1, 1});
    QVERIFY(!map.is_valid(3, 10));
    QVERIFY(map.is_valid(4, 10));
    QCOMPARE(count_used(read, marks_valid ? "masks of valid pixels" : "masks of invalid pixels"),
             9);
  }

  void regionMasks_areRegions() {
    const LayeredFolder folder;
    folder.write_views(named("{}_{}.png"));
    io::write_png(folder.path("mask_planes.png"), Image<std::uint8_t>(60, 72, 1, 255).view());

    const Scene read = folder.open();

    QCOMPARE(read.truth->regions.size(), std::size_t{1});
    QVERIFY(read.truth->regions.contains("planes"));
  }

  void ownScribbles_areNoTruth() {
    const LayeredFolder folder;
    folder.write_views(named("{}_{}.png"));
    Scene painted = folder.open();
    Image<std::int32_t> strokes(60, 72);
    strokes.at(10, 10) = 3;
    painted.scribbles.views.push_back({{1, 1}, std::move(strokes)});
    io::write_scribbles(folder.path("labels.h5"), painted.scribbles, painted, Progress(1));

    const Scene read = folder.open();

    QVERIFY(read.truth->labels.empty());
    QCOMPARE(count_used(read, "scribble files"), 1);
    for (const std::string& warning : read.convention.warnings) {
      QVERIFY2(!QString::fromStdString(warning).contains("label"), warning.c_str());
    }
  }

  void withoutTruth_onlyTheCenterSettlesTheOrder() {
    const LayeredFolder folder;
    folder.write_views(named("{}_{}.png"));
    folder.write_npy(named("{}_{}_disparity.npy"), folder.scene.disparity);
    folder.write_npy(named("{}_{}_label.npy"), folder.scene.labels);
    io::OpenOptions options;
    options.needs_truth = false;

    const Scene read = folder.open({}, options);

    QVERIFY(!read.truth->has_disparity());
    QVERIFY(read.truth->labels.empty());
    QVERIFY(read.convention.order_check.starts_with("checked against the ground truth"));
  }
};

}  // namespace episcope::in_sidecar_maps_test

EPISCOPE_TEST(sidecar_maps_test, SidecarMapsTest)

#include "sidecar_maps_test.moc"
