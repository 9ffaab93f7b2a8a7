// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/solve_pose.h"
#include "engine/core/error.h"

#include "tests/test_main.h"

#include <QTemporaryDir>

#include <cmath>
#include <fstream>
#include <functional>
#include <random>

namespace episcope::in_pose_test {

using namespace capture;

namespace {

CameraGrid camera() {
  CameraGrid grid;
  grid.baseline = 1;
  grid.focal_length = 5740.38;
  grid.pinhole = Pinhole{5740.38, 460, 455};
  return grid;
}

RigidPose true_pose() {
  // Turned by 0.7 about (1, 2, 2)/3.
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  const double k[3] = {1.0 / 3, 2.0 / 3, 2.0 / 3};
  RigidPose pose;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) pose.rotation[3 * i + j] = (1 - c) * k[i] * k[j] + (i == j ? c : 0);
  }
  const double cross[9] = {0, -k[2], k[1], k[2], 0, -k[0], -k[1], k[0], 0};
  for (int i = 0; i < 9; ++i) pose.rotation[i] += s * cross[i];
  pose.translation = {3, -4, 800};
  return pose;
}

/// Points within 50 mm of the origin, as seen with noise.
std::vector<PointPair> pairs_of(int count, double noise, unsigned seed, bool is_flat = false) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-50, 50);
  std::normal_distribution<double> normal(0, noise > 0 ? noise : 1);
  std::vector<PointPair> pairs;
  const RigidPose pose = true_pose();
  for (int i = 0; i < count; ++i) {
    PointPair pair{"p" + std::to_string(i), 0, 0, {place(random), place(random), place(random)}};
    if (is_flat) pair.point.z = 7;
    const auto [x, y] = reprojection_residual(pair, pose, *camera().pinhole);
    pair.x_px = x + (noise > 0 ? normal(random) : 0);
    pair.y_px = y + (noise > 0 ? normal(random) : 0);
    pairs.push_back(pair);
  }
  return pairs;
}

double pose_error(const RigidPose& pose) {
  double worst = 0;
  for (int i = 0; i < 9; ++i) {
    worst = std::max(worst, std::abs(pose.rotation[i] - true_pose().rotation[i]));
  }
  for (int i = 0; i < 3; ++i) {
    worst = std::max(worst, std::abs(pose.translation[i] - true_pose().translation[i]) / 800);
  }
  return worst;
}

QString message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return QString::fromUtf8(error.what());
  }
  return {};
}

}  // namespace

class PoseTest : public QObject {
  Q_OBJECT

 private slots:
  void withoutNoise_thePoseIsExact_data() {
    QTest::addColumn<int>("count");
    QTest::addColumn<bool>("isFlat");
    QTest::newRow("20 in space") << 20 << false;
    QTest::newRow("6 in space") << 6 << false;
    QTest::newRow("5 in space") << 5 << false;
    QTest::newRow("4 in a plane") << 4 << true;
    QTest::newRow("10 in a plane") << 10 << true;
  }
  void withoutNoise_thePoseIsExact() {
    QFETCH(int, count);
    QFETCH(bool, isFlat);
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const SolvedPose solved = solve_pose(pairs_of(count, 0, seed, isFlat), camera());
      QVERIFY2(pose_error(solved.pose) < 1e-6,
               qPrintable(QString("seed %1: %2").arg(seed).arg(pose_error(solved.pose))));
      QVERIFY(solved.reprojection_error_px < 1e-6);
    }
  }

  void tzError_isWithinItsCovariance_andNearDeltaTz() {
    int within_two = 0;
    int within_covariance = 0;
    for (unsigned seed = 1; seed <= 100; ++seed) {
      const SolvedPose solved = solve_pose(pairs_of(20, 0.5, seed), camera());
      const double off = std::abs(solved.pose.translation[2] - 800);
      within_two += off <= 2 * solved.delta_tz ? 1 : 0;
      within_covariance += off <= 2 * std::sqrt(solved.covariance[35]) ? 1 : 0;
    }
    QVERIFY2(within_two >= 95, qPrintable(QString::number(within_two)));
    // 95.4 of 100 are expected within two standard deviations; 88 is three standard errors below.
    QVERIFY2(within_covariance >= 88, qPrintable(QString::number(within_covariance)));
  }

  void deltaTz_isThatOfThePaper() {
    // Zc = 0.8 m, u − cx = 400 px, Δu = 0.5 px: 1 mm, 0.009 px of disparity for 1 mm of baseline.
    std::vector<PointPair> pairs;
    for (const auto& [x, y] :
         {std::pair{400.0, 0.0}, {-300.0, 20.0}, {10.0, 300.0}, {0.0, -310.0}}) {
      PointPair pair{"p", 460 + x, 455 + y, {x * 800 / 5740.38, y * 800 / 5740.38, 0}};
      pair.x_px += x > 0 ? 0.5 : -0.5;
      pairs.push_back(pair);
    }
    const SolvedPose solved = solve_pose(pairs, camera());
    double largest = 0;
    for (const PointPair& pair : pairs) largest = std::max(largest, std::abs(pair.x_px - 460));
    const double expected = solved.pose.translation[2] * solved.reprojection_error_px / largest;
    QVERIFY(std::abs(solved.delta_tz - expected) < 0.02 * expected);
    QVERIFY(std::abs(solved.delta_tz_px - 5740.38 / (800.0 * 800) * solved.delta_tz) <
            0.02 * solved.delta_tz_px);
  }

  void aWrongPick_isFoundAndLeftOut() {
    for (unsigned seed = 1; seed <= 30; ++seed) {
      std::vector<PointPair> pairs = pairs_of(12, 0.5, seed);
      pairs[seed % 12].x_px += seed % 2 == 0 ? 25 : -140;
      const SolvedPose solved = solve_pose(pairs, camera());
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        QCOMPARE(solved.pairs[i].is_outlier, i == seed % 12);
      }
      QVERIFY(solved.reprojection_error_px < 1.2);
    }
  }

  void lockedPair_isNeverAWrongPick() {
    std::vector<PointPair> pairs = pairs_of(12, 0.5, 3);
    pairs[5].x_px += 25;
    const SolvedPose left_out = solve_pose(pairs, camera());
    QVERIFY(left_out.pairs[5].is_outlier);
    pairs[5].is_locked = true;
    const SolvedPose kept = solve_pose(pairs, camera());
    for (const PairResidual& each : kept.pairs) QVERIFY(!each.is_outlier || each.residual_px > 3);
    QVERIFY(!kept.pairs[5].is_outlier);
    QVERIFY(kept.pairs[5].residual_px < 0.8 * left_out.pairs[5].residual_px);
    QVERIFY(kept.reprojection_error_px > 2 * left_out.reprojection_error_px);
  }

  void aMirroredMesh_isRecognised() {
    std::vector<PointPair> pairs = pairs_of(12, 0.5, 5);
    for (PointPair& pair : pairs) pair.point.z = -pair.point.z;
    QVERIFY(message_of([&] { (void)solve_pose(pairs, camera()); }).contains("mirror image"));
  }

  void tooFewPairs_orOnALine_areRefused() {
    QVERIFY(message_of([&] {
              (void)solve_pose(pairs_of(3, 0, 1), camera());
            }).contains("needs 4 pairs, and there are 3"));
    std::vector<PointPair> pairs = pairs_of(6, 0, 1);
    for (PointPair& pair : pairs) pair.point = {pair.point.x, 0, 0};
    QVERIFY(message_of([&] { (void)solve_pose(pairs, camera()); }).contains("one line"));
  }

  void files_keepWhatIsWritten() {
    const QTemporaryDir folder;
    const std::filesystem::path path = folder.filePath("pairs.csv").toStdString();
    PoseStory story;
    story.pairs = pairs_of(8, 0.5, 2);
    write_pairs(path, story.pairs);
    for (const PointPair& each : read_pairs(path)) QVERIFY(!each.is_locked);
    story.pairs[3].is_locked = true;
    write_pairs(path, story.pairs);
    const std::vector<PointPair> read = read_pairs(path);
    QCOMPARE(read.size(), story.pairs.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
      QCOMPARE(read[i].name, story.pairs[i].name);
      QVERIFY(read[i].x_px == story.pairs[i].x_px && read[i].point.z == story.pairs[i].point.z);
      QCOMPARE(read[i].is_locked, i == 3);
    }

    story.mesh = folder.filePath("scan.ply").toStdString();
    story.solved = solve_pose(story.pairs, camera());
    write_pose(folder.filePath("pose.json").toStdString(), story);
    const PoseStory again = read_pose(folder.filePath("pose.json").toStdString());
    QVERIFY(again.solved.pose.rotation == story.solved.pose.rotation);
    QVERIFY(again.solved.pose.translation == story.solved.pose.translation);
    QVERIFY(again.pairs == story.pairs);
    QCOMPARE(again.solved.reprojection_error_px, story.solved.reprojection_error_px);
    QCOMPARE(again.solved.pairs.at(3).residual_px, story.solved.pairs.at(3).residual_px);
    QCOMPARE(again.mesh.filename().string(), std::string("scan.ply"));
  }

  void badFiles_sayWhichLine() {
    const QTemporaryDir folder;
    const std::filesystem::path path = folder.filePath("bad.csv").toStdString();
    std::ofstream(path) << "name,x_px,y_px,X,Y,Z\np1,1,2,3,4,5\np2,1,two,3,4,5\n";
    QVERIFY(message_of([&] { (void)read_pairs(path); }).contains("line 3 has 'two'"));
    std::ofstream(path) << "p1,1,2,3,4,5,yes\n";
    QVERIFY(message_of([&] { (void)read_pairs(path); }).contains("'yes' where 1 (locked) or 0"));
    std::ofstream(path) << "{\"mesh\": \"a.ply\", \"rotation\": [1,0,0,0,1,0,0,0,-1], "
                           "\"translation\": [0,0,1]}";
    QVERIFY(message_of([&] { (void)read_pose(path); }).contains("no rotation matrix"));
  }
};

}  // namespace episcope::in_pose_test

EPISCOPE_TEST(pose_test, PoseTest)
#include "pose_test.moc"
