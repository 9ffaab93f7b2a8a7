// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/order/view_axes.h"
#include "tests/engine/io/archive_files.h"
#include "tests/engine/io/archive_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <cmath>

namespace episcope::in_archive_convention_test {

using namespace episcope::test;

/// The order of views and the units of depth: found, checked, reported, overridden.
class ArchiveConventionTest : public QObject, private ArchiveFolder {
  Q_OBJECT

 private slots:
  void init() { renew(); }

  void rawOrder_isFoundByTruth_data() {
    QTest::addColumn<bool>("u");
    QTest::addColumn<bool>("v");
    QTest::newRow("in order") << false << false;
    QTest::newRow("h reversed") << true << false;
    QTest::newRow("v reversed") << false << true;
    QTest::newRow("both reversed") << true << true;
  }
  void rawOrder_isFoundByTruth() {
    QFETCH(bool, u);
    QFETCH(bool, v);
    const Scene scene = plane_scene();
    RawArchive form;
    form.flip = {u, v};
    write_raw_archive(path("lf.h5"), scene, form);

    const Scene read = open(path("lf.h5"));

    QVERIFY2(has_same_samples(scene, read), describe(read.convention).c_str());
    QVERIFY(largest_difference(scene.truth->field, read.truth->field) < kDepthRounding);
    QCOMPARE(read.convention.reversed_u, u);
    QCOMPARE(read.convention.reversed_v, v);
    QVERIFY(QString::fromStdString(read.convention.order_check).contains("truth"));
  }

  void columnsBeforeRowsOfViews_arePutRight() {
    PlaneOptions options;
    options.d0 = 1.3;
    const Scene scene = plane_scene(options);
    Scene stored = scene;
    auto views = bytes_of(scene).clone();
    GroundTruth truth;
    truth.field.disparity = scene.truth->field.disparity.clone();
    LightField::Samples samples = std::move(views);
    io::swap_view_axes(samples);
    io::swap_view_axes(truth);
    stored.light_field =
        std::make_shared<LightField>(std::move(samples), scene.light_field->info());
    stored.truth = std::make_shared<GroundTruth>(std::move(truth));
    write_raw_archive(path("lf.h5"), stored, {});

    const Scene read = open(path("lf.h5"));

    QVERIFY2(has_same_samples(scene, read), describe(read.convention).c_str());
    QVERIFY(largest_difference(scene.truth->field, read.truth->field) < kDepthRounding);
  }

  void depthWithoutAttributes_isLeftOutWithAWarning() {
    const Scene scene = plane_scene();
    RawArchive form;
    form.has_attributes = false;
    write_raw_archive(path("lf.h5"), scene, form);

    const Scene read = open(path("lf.h5"));

    QVERIFY2(has_same_samples(scene, read), describe(read.convention).c_str());
    QVERIFY(!read.truth->has_disparity());
    QVERIFY2(describe(read.convention).find("GT_DEPTH is ignored because") != std::string::npos,
             describe(read.convention).c_str());
  }

  void rawOrder_isFoundBySlopesWithoutTruth_data() {
    QTest::addColumn<bool>("u");
    QTest::newRow("in order") << false;
    QTest::newRow("h reversed") << true;
  }
  void rawOrder_isFoundBySlopesWithoutTruth() {
    QFETCH(bool, u);
    PlaneOptions options;
    options.slope_x = 0.04;
    const Scene scene = plane_scene(options);
    RawArchive form;
    form.flip = {u, false};
    form.has_depth = false;
    write_raw_archive(path("lf.h5"), scene, form);

    const Scene read = open(path("lf.h5"));

    QVERIFY2(has_same_samples(scene, read), describe(read.convention).c_str());
    QVERIFY(QString::fromStdString(read.convention.order_check).contains("slopes"));
  }

  void statedOrder_isCheckedAgainstTruth() {
    const Scene scene = plane_scene();
    RawArchive form;
    form.flip = {true, false};
    form.more = [](io::Hdf5Output& file) {
      file.set_text("/", "convention", "canonical order, so it says");
    };
    write_raw_archive(path("lf.h5"), scene, form);

    const Scene read = open(path("lf.h5"));

    QVERIFY(has_same_samples(scene, read));
    QVERIFY(!read.convention.warnings.empty());
  }

  void orderChosenByHand_winsAndIsContradicted() {
    const Scene scene = plane_scene();
    write_raw_archive(path("lf.h5"), scene, {});
    io::OpenOptions options;
    options.flip = io::Flip::U;

    const Scene read = open(path("lf.h5"), options);

    QVERIFY(!has_same_samples(scene, read));
    QVERIFY(read.convention.reversed_u);
    QVERIFY(QString::fromStdString(describe(read.convention)).contains("check favors"));
    // Truth moves with its view.
    const auto moved = read.truth->field.disparity.view({1, 0});
    QVERIFY(std::abs(moved.at(5, 5) - scene.truth->field.disparity.view({1, 4}).at(5, 5)) <
            kDepthRounding);
  }

  void units_withoutWidthAreFound() {
    const Scene scene = plane_scene();
    RawArchive form;
    form.attribute_scale = 1.0 / 80;
    write_raw_archive(path("lf.h5"), scene, form);

    const Scene read = open(path("lf.h5"));

    QVERIFY2(largest_difference(scene.truth->field, read.truth->field) < kDepthRounding,
             describe(read.convention).c_str());
    QVERIFY(QString::fromStdString(read.convention.units).contains("times xRes"));
  }

  void unitsChosenByHand_win() {
    const Scene scene = plane_scene();
    write_raw_archive(path("lf.h5"), scene, {});
    io::OpenOptions options;
    options.units = io::Units::WithoutWidth;

    const Scene read = open(path("lf.h5"), options);

    QCOMPARE(read.light_field->info().camera.baseline, 80 * 40.0);
    QVERIFY(read.convention.units_were_chosen);
    QVERIFY(units_text(read.convention).find("by hand") != std::string::npos);
  }

  void camDistance_isCheckedAgainstTheShift() {
    RawArchive form;
    form.more = [](io::Hdf5Output&) {};
    Scene scene = plane_scene();
    LightFieldInfo info = scene.light_field->info();
    info.camera.cam_distance = 17;
    scene.light_field = std::make_shared<LightField>(bytes_of(scene).clone(), info);
    write_raw_archive(path("lf.h5"), scene, form);

    QVERIFY(QString::fromStdString(describe(open(path("lf.h5")).convention)).contains("17"));
  }
};

}  // namespace episcope::in_archive_convention_test

EPISCOPE_TEST(archive_convention_test, ArchiveConventionTest)
#include "archive_convention_test.moc"
