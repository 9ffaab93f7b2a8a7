// SPDX-License-Identifier: BSD-3-Clause
#include "tests/app/session/capture/plenoptic_chain.h"
#include "app/session/load_scene.h"
#include "app/session/raw_scene.h"
#include "engine/capture/plenoptic/decode_files.h"
#include "engine/core/error.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

namespace episcope::in_plenoptic_chain_test {

using namespace test;

namespace {

capture::SyntheticCamera small_camera(capture::CameraModel model) {
  capture::SyntheticCamera camera = capture::synthetic_camera(model);
  camera.width = 1000;
  camera.height = 752;
  return camera;
}

}  // namespace

class PlenopticChainTest : public QObject {
  Q_OBJECT

 private slots:
  void chain_findsWhatTheCameraSaw_data() {
    QTest::addColumn<int>("model");
    QTest::addColumn<double>("noise");
    QTest::addColumn<double>("degrees");
    QTest::addColumn<double>("pitch");
    QTest::addColumn<bool>("has_colors");
    QTest::addColumn<double>("disparity");
    const int f01 = int(capture::CameraModel::F01), illum = int(capture::CameraModel::Illum),
              square = int(capture::CameraModel::Square);
    // Limits of disparity: noise of the sensor is what remains in it.
    QTest::newRow("F01") << f01 << 0.0 << 0.1 << 1.0 << true << 0.03;
    QTest::newRow("F01, turned, pitch off, noise") << f01 << 0.01 << -0.5 << 1.01 << false << 0.035;
    QTest::newRow("Illum") << illum << 0.0 << 0.1 << 1.0 << true << 0.03;
    QTest::newRow("square") << square << 0.0 << 0.1 << 1.0 << false << 0.03;
    QTest::newRow("square, turned, noise") << square << 0.01 << 0.5 << 0.99 << false << 0.035;
  }
  void chain_findsWhatTheCameraSaw() {
    QFETCH(int, model);
    QFETCH(double, noise);
    QFETCH(double, degrees);
    QFETCH(double, pitch);
    QFETCH(bool, has_colors);
    QFETCH(double, disparity);
    capture::SyntheticCamera camera = small_camera(capture::CameraModel(model));
    camera.noise = noise;
    camera.rotation_degrees = degrees;
    camera.pitch_px *= pitch;
    if (!has_colors) camera.colors = {.is_balanced = true};

    const ChainErrors errors = chain_errors("demo", camera);

    const std::string text = errors.text();
    qInfo("%s", text.c_str());
    QVERIFY2(errors.center_px <= 0.05, text.c_str());
    QVERIFY2(errors.disparity_px <= disparity, text.c_str());
    // Noise tilts the slopes of hexagonal arrays, whose rows are interpolated in one direction.
    QVERIFY2(errors.slope_percent <= (noise > 0 ? 2 : 1), text.c_str());
    QVERIFY2(errors.row_shift_px <= 0.05, text.c_str());
    QVERIFY2(errors.brightness_percent <= 2, text.c_str());
    QVERIFY2(std::abs(errors.level - 1) <= 0.02, text.c_str());
    // The corner of a hexagonal lens lies below its neighbor.
    const LightField& field = *errors.decoded.light_field;
    const bool is_square = camera.lattice == capture::LensLattice::Square;
    QVERIFY(is_square || !field.is_valid({0, 0}, field.height() / 2, field.width() / 2));
    QVERIFY(field.is_valid(field.center(), field.height() / 2, field.width() / 2));
  }

  // Vignetting shows the lenses of the raw picture itself, to a fraction of a pixel.
  void withoutWhitePicture_theLensesAreFound() {
    const ChainErrors errors = chain_errors("demo", small_camera(capture::CameraModel::F01), false);
    QVERIFY2(errors.center_px <= 0.5, errors.text().c_str());
    QVERIFY(!errors.decoded.warnings.empty());
  }

  void writtenPictures_areDecodedByTheirNames() {
    const QTemporaryDir folder;
    for (const auto& each : names_of(capture::CameraModel{})) {
      const std::filesystem::path out =
          std::filesystem::path(folder.path().toStdString()) / each.name;
      const RawFolder files =
          write_raw_folder(out, {"edge", {}}, small_camera(each.value), Progress(2));
      const Scene scene =
          capture::decode_files({.raw = files.raw, .white = files.white}, {}, Progress(2));
      QVERIFY(scene.light_field->grid().u >= 9);
      QVERIFY(std::filesystem::exists(files.ideal));
      const QString told = QString::fromStdString(scene.convention.warnings.front());
      QVERIFY2(told.contains("white picture"), qPrintable(told));
      if (each.value == capture::CameraModel::F01) QVERIFY(told.contains("MOD_0001.RAW"));
    }
    // A container is opened like any light field.
    const std::string raw = (folder.path() + "/illum/raw.lfr").toStdString();
    const Scene opened = load_scene(raw, {}, Progress(2));
    QCOMPARE(opened.light_field->info().source, raw);
    QVERIFY(QString::fromStdString(opened.convention.format).contains("serial B5000000001"));
  }

  void demo_needsNoFile() {
    QCOMPARE(builtin_input_name("plenoptic"), std::string("plenoptic"));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, require_builtin_input("plenoptic?seed=3"));
  }
};

}  // namespace episcope::in_plenoptic_chain_test

EPISCOPE_CORE_TEST(plenoptic_chain_test, PlenopticChainTest)
#include "plenoptic_chain_test.moc"
