// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/calibrate.h"

#include "engine/capture/demo_folder.h"
#include "engine/core/error.h"

#include "tests/engine/io/memory_use.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <cmath>
#include <fstream>

namespace episcope::in_calibrate_test {

using namespace capture;

namespace {

constexpr int kHeight = 300;
constexpr int kWidth = 400;

LensCamera true_camera() {
  return {kWidth, kHeight, 560, 560, 204, 147, {-0.1, 0.01, 0, 0, 0}, 0};
}

Image<std::uint8_t> smeared(const Image<std::uint8_t>& picture, int reach) {
  Image<std::uint8_t> result = picture;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = reach; x < picture.width() - reach; ++x) {
      int sum = 0;
      for (int k = -reach; k <= reach; ++k) sum += picture.at(y, x + k);
      result.at(y, x) = static_cast<std::uint8_t>(sum / (2 * reach + 1));
    }
  }
  return result;
}

PatternPhotograph seen(const Image<std::uint8_t>& picture, const Pattern& pattern,
                       const std::string& name) {
  PatternPhotograph photograph;
  photograph.name = name;
  photograph.found = find_pattern(picture, pattern);
  photograph.sharpness = sharpness(picture, photograph.found.pixels, 5);
  return photograph;
}

}  // namespace

class CalibrateTest : public QObject {
  Q_OBJECT

 private slots:
  void camera_isFound_data() {
    QTest::addColumn<int>("kind");
    QTest::newRow("chessboard") << static_cast<int>(PatternKind::Chessboard);
    QTest::newRow("charuco") << static_cast<int>(PatternKind::Charuco);
    QTest::newRow("circles") << static_cast<int>(PatternKind::Circles);
  }
  void camera_isFound() {
    QFETCH(int, kind);
    const Pattern pattern{static_cast<PatternKind>(kind), 7, 5, 30};
    std::vector<PatternPhotograph> photographs;
    const std::vector<RigidPose> poses = pattern_poses(pattern, 560, 10);
    try {
      (void)pattern_picture(pattern, 10);
    } catch (const Unavailable& error) {
      QSKIP(error.what());
    }
    for (std::size_t i = 0; i < poses.size(); ++i) {
      RigidPose pose = poses[i];
      if (i == 9) pose.translation[0] += 170;  // cut off
      Exposure exposure;
      exposure.noise = 2;
      exposure.seed = static_cast<unsigned>(i);
      Image<std::uint8_t> picture = pattern_photograph(pattern, pose, true_camera(), exposure);
      if (i == 8) picture = smeared(picture, 5);
      photographs.push_back(seen(picture, pattern, "photo " + std::to_string(i)));
    }
    const Calibration calibration = calibrate(photographs, kHeight, kWidth);
    QVERIFY2(calibration.camera.rms < 0.2, qPrintable(QString::number(calibration.camera.rms)));
    QVERIFY2(std::abs(calibration.camera.focal_x - 560) < 3,
             qPrintable(QString::number(calibration.camera.focal_x)));
    QVERIFY(std::abs(calibration.camera.center_x - 204) < 4);
    for (std::size_t i = 0; i < 8; ++i) {
      QVERIFY2(calibration.photographs[i].is_used(),
               qPrintable(QString::fromStdString(calibration.photographs[i].problem)));
    }
    // A smeared photograph is either not recognized or known to be blurred.
    QVERIFY(!calibration.photographs[8].is_used());
    if (kind != static_cast<int>(PatternKind::Charuco)) {
      QVERIFY(!calibration.photographs[9].is_used());
    }
  }

  void leftPhotographsOfOpenCv_fitAsItSays() {
    const std::filesystem::path folder = "/usr/share/doc/opencv-doc/examples/data";
    std::vector<std::filesystem::path> files;
    for (int i = 1; i <= 14; ++i) {
      const auto file =
          folder / ("left" + std::string(i < 10 ? "0" : "") + std::to_string(i) + ".jpg");
      if (std::filesystem::exists(file)) files.push_back(file);
    }
    if (files.size() != 13) QSKIP("opencv-doc is not installed");
    const Calibration calibration =
        calibrate(files, {PatternKind::Chessboard, 9, 6, 1}, Progress(1));
    QVERIFY2(calibration.camera.rms <= 0.41, qPrintable(QString::number(calibration.camera.rms)));
    QVERIFY(std::abs(calibration.camera.focal_x - 536) < 5);
  }

  void cameraFile_isReadAsWritten() {
    const QTemporaryDir folder;
    const std::filesystem::path path = folder.filePath("camera.yml").toStdString();
    write_camera(path, true_camera());
    const LensCamera read = read_camera(path);
    QCOMPARE(read.width, kWidth);
    QCOMPARE(read.focal_y, 560.0);
    QVERIFY(read.distortion == true_camera().distortion);
    std::ofstream(path) << "%YAML:1.0\n---\nfocal: 3\n";
    QVERIFY_THROWS_EXCEPTION(IoError, (void)read_camera(path));
    std::ofstream(path) << "\x01\x02 no yaml {";
    QVERIFY_THROWS_EXCEPTION(IoError, (void)read_camera(path));
  }

  // Found by a fuzzer: OpenCV ends the program.
  void camerasWithAKeyWithoutName_areRefused() {
    const QTemporaryDir folder;
    const std::filesystem::path path = folder.filePath("camera.yml").toStdString();
    std::ofstream(path) << "%YAML:1.0\ncamera_matrix: !!opencv-matrix\n   data: [1. ]\n   :";
    QVERIFY_THROWS_EXCEPTION(IoError, (void)read_camera(path));
  }

  void camerasOfHugeMatrices_areRefused_data() {
    QTest::addColumn<QString>("sizes");
    QTest::newRow("claimed") << "rows: 60000\n   cols: 60000";
    QTest::newRow("left out") << "rows: 3";  // whatever memory held, for OpenCV
    QTest::newRow("negative") << "rows: -3\n   cols: -3";
    QTest::newRow("none") << "rows: 0\n   cols: 0";
  }
  void camerasOfHugeMatrices_areRefused() {
    QFETCH(QString, sizes);
    const QTemporaryDir folder;
    const std::filesystem::path path = folder.filePath("camera.yml").toStdString();
    std::ofstream(path) << "%YAML:1.0\n---\nimage_width: 100\nimage_height: 100\n"
                           "camera_matrix: !!opencv-matrix\n   "
                        << sizes.toStdString()
                        << "\n   dt: d\n   data: [ 50., 0., 50., 0., 50., 50., 0., 0., 1. ]\n";
    const test::PeakMemory memory;

    QVERIFY_THROWS_EXCEPTION(IoError, (void)read_camera(path));
    QVERIFY(memory.used() < (std::uintmax_t{64} << 20));
  }

  void tooFewPhotographs_areNamed() {
    PatternPhotograph bad;
    bad.name = "dark.png";
    bad.found.problem = "the pattern was not found";
    try {
      (void)calibrate({bad}, kHeight, kWidth);
      QFAIL("nothing was thrown");
    } catch (const InvalidInput& error) {
      QVERIFY(QString::fromUtf8(error.what()).contains("dark.png: the pattern was not found"));
    }
  }
};

}  // namespace episcope::in_calibrate_test

EPISCOPE_TEST(calibrate_test, CalibrateTest)
#include "calibrate_test.moc"
