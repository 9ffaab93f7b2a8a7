// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/region_metrics.h"
#include "tests/engine/evaluation/judged_maps.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>

namespace episcope::in_region_metrics_test {

using namespace episcope::test;

class RegionMetricsTest : public QObject {
  Q_OBJECT
 private slots:
  // A hole in the truth is not a fault of the estimate.
  void holesOfTheTruth_costNothing() {
    auto truth = constant(1);
    truth.at(25, 25) = kNan;

    const auto evaluation = judge(constant(1), truth, Protocol::Benchmark2016,
                                  InvalidEstimates::Bad, everywhere("planes"));

    QCOMPARE(metric(evaluation, "bumpiness_planes_100_0050"), 0.0);
    auto estimate = constant(1);
    estimate.at(20, 20) = kNan;
    QVERIFY(metric(judge(estimate, truth, Protocol::Benchmark2016, InvalidEstimates::Bad,
                         everywhere("planes")),
                   "bumpiness_planes_100_0050") > 0);
  }

  void hessianNorm_isFourTimesTheDerivative_data() {
    QTest::addColumn<double>("xx");
    QTest::addColumn<double>("xy");
    QTest::addColumn<double>("yy");
    QTest::newRow("along x") << 0.3 << 0.0 << 0.0;
    QTest::newRow("along y") << 0.0 << 0.0 << -0.2;
    QTest::newRow("mixed") << 0.0 << 0.25 << 0.0;
    QTest::newRow("all") << 0.1 << -0.2 << 0.3;
  }

  void hessianNorm_isFourTimesTheDerivative() {
    QFETCH(double, xx);
    QFETCH(double, xy);
    QFETCH(double, yy);
    Image<double> map(12, 11);
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        map.at(y, x) = 0.5 * xx * x * x + xy * x * y + 0.5 * yy * y * y + 0.7 * x - 2 * y + 5;
      }
    }

    const auto norm = hessian_norm(map);

    const double expected = 4 * std::sqrt(xx * xx + 2 * xy * xy + yy * yy);
    for (int y = 2; y < map.height() - 2; ++y) {
      for (int x = 2; x < map.width() - 2; ++x) {
        QVERIFY(std::abs(norm.at(y, x) - expected) < 1e-5);
      }
    }
  }

  void hessianNorm_reflectsTheBorder() {
    Image<double> map(1, 3);
    map.at(0, 0) = 0;
    map.at(0, 1) = 1;
    map.at(0, 2) = 4;

    const auto norm = hessian_norm(map);

    // (0 | 0 1 4 | 4): dx = 1, 4, 3; reflected (1 | 1 4 3 | 3): dxx = 3, 2, −1.
    QCOMPARE(norm.at(0, 0), 3.0F);
    QCOMPARE(norm.at(0, 1), 2.0F);
    QCOMPARE(norm.at(0, 2), 1.0F);
  }

  void bumpiness_isClippedMeanOfKnownHessian() {
    // Error 0.5·a·x²: norm 4a. Left half of the region gentle (0.01), right half beyond the clip.
    const double gentle = 0.0025;
    const auto truth = constant(0);
    const auto estimate =
        map_of([&](int, int x) { return x < 25 ? 0.5 * gentle * x * x : 10.0 * ((x / 3) % 2); });
    std::map<std::string, Image<std::uint8_t>> regions;
    regions["planes"] = Image<std::uint8_t>(kSize, kSize);
    regions["smooth_surfaces"] = Image<std::uint8_t>(kSize, kSize);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < 23; ++x) regions["planes"].at(y, x) = 255;
      for (int x = 27; x < kSize; ++x) regions["smooth_surfaces"].at(y, x) = 1;
    }

    const auto evaluation =
        judge(estimate, truth, Protocol::Benchmark2016, InvalidEstimates::Bad, regions);

    // Float samples of 0.5·a·x² below 1 carry errors of 6e-8, times 4·4.
    QVERIFY(std::abs(metric(evaluation, "bumpiness_planes_100_0050") - 100 * 4 * gentle) < 1e-3);
    QVERIFY(std::abs(metric(evaluation, "bumpiness_contin_surfaces_100_0050") - 5) < 1e-5);
  }

  void fineStructures_countTheirSideOfTheError() {
    auto truth = constant(0);
    for (int x = 15; x < 35; ++x) {
      truth.at(15, x) = -0.15F;                         // not beyond the threshold
      truth.at(16, x) = std::nextafter(-0.15F, -1.0F);  // estimate too near: fattening
      truth.at(17, x) = 0.15F;                          // not beyond the threshold
      truth.at(18, x) = truth.at(19, x) = 0.2F;         // estimate too far: thinning
    }
    auto regions = everywhere("fine");
    regions.merge(everywhere("fine_surrounding"));

    const auto evaluation =
        judge(constant(0), truth, Protocol::Benchmark2016, InvalidEstimates::Bad, regions);

    QCOMPARE(metric(evaluation, "fine_fattening_0150_lowres"), 5.0);
    QCOMPARE(metric(evaluation, "fine_thinning_0150_lowres"), 10.0);
  }

  void discontinuities_countInsideTheirRegionOnly() {
    auto estimate = constant(0);
    std::map<std::string, Image<std::uint8_t>> regions;
    regions["discontinuities"] = Image<std::uint8_t>(kSize, kSize);
    for (int x = 15; x < 25; ++x) regions["discontinuities"].at(20, x) = 255;
    estimate.at(20, 15) = estimate.at(30, 30) = 1;

    const auto evaluation =
        judge(estimate, constant(0), Protocol::Benchmark2016, InvalidEstimates::Bad, regions);

    QCOMPARE(metric(evaluation, "discontinuities_0070_lowres"), 10.0);
    QVERIFY(!find_metric(evaluation.metrics, "bumpiness_planes_100_0050"));
    QVERIFY(!find_metric(evaluation.metrics, "fine_thinning_0150_lowres"));
  }

  void emptyRegion_addsNoMetric() {
    std::map<std::string, Image<std::uint8_t>> regions;
    regions["fine"] = Image<std::uint8_t>(kSize, kSize);
    regions["planes"] = Image<std::uint8_t>(kSize, kSize);

    const auto evaluation =
        judge(constant(0), constant(0), Protocol::Benchmark2016, InvalidEstimates::Bad, regions);

    QVERIFY(!find_metric(evaluation.metrics, "fine_thinning_0150_lowres"));
    QVERIFY(!find_metric(evaluation.metrics, "bumpiness_planes_100_0050"));
  }

  void angleBetweenNormals_isThatOfThePlanes() {
    // Depth planes Z = Z0 + s·X on points X = x·Z/(2·(w − 1)·f): 1/Z is affine in x.
    CameraGrid camera;
    camera.baseline = 100;
    camera.focal_length = 1.0;
    camera.shift = 10;
    const auto plane = [&](double slope) {
      Image<double> map(40, 40);
      for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 40; ++x) {
          const double ray = 0.5 * x / (39 * camera.focal_length);
          const double depth = 10 / (1 - slope * ray);
          map.at(y, x) = camera.disparity_from_depth(depth);
        }
      }
      return map;
    };

    const auto angle = angle_between_normals(plane(0), plane(0.5), camera);

    // Differences of three pixels lie in the plane itself, so the normal is exact but for the
    // averaging across rows: 0.05° leaves room for that.
    const double expected = std::atan(0.5) * 180 / std::acos(-1.0);
    QVERIFY(std::abs(angle.at(20, 20) - expected) < 0.05);
    QVERIFY(std::abs(angle.at(10, 30) - expected) < 0.05);
  }

  void angle_ofAnEvenNumberIsTheMeanOfBothInTheMiddle() {
    CameraGrid camera;
    camera.baseline = 100;
    camera.focal_length = 1;
    camera.shift = 10;
    const auto truth = constant(0), estimate = wavy_truth();
    std::map<std::string, Image<std::uint8_t>> regions;
    regions["planes"] = Image<std::uint8_t>(kSize, kSize);
    regions["planes"].at(15, 15) = regions["planes"].at(15, 18) = 1;
    const auto in_double = [](const Image<float>& map) {
      Image<double> copy(map.height(), map.width());
      std::copy(map.begin(), map.end(), copy.begin());
      return copy;
    };

    const auto evaluation = evaluate(whole(estimate), whole(truth), regions,
                                     {Protocol::Benchmark2016, InvalidEstimates::Bad, camera});

    const auto angle = angle_between_normals(in_double(estimate), in_double(truth), camera);
    const double mean = (double{angle.at(15, 15)} + angle.at(15, 18)) / 2;
    QVERIFY(std::isfinite(mean) && std::abs(angle.at(15, 15) - angle.at(15, 18)) > 0.1);
    QVERIFY(std::abs(metric(evaluation, "mae_planes") - mean) < 1e-4);
  }
};

}  // namespace episcope::in_region_metrics_test

EPISCOPE_TEST(region_metrics_test, RegionMetricsTest)
#include "region_metrics_test.moc"
