// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/core/point_cloud.h"
#include "engine/evaluation/metrics.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stop_token>

namespace episcope::in_cloud_distance_test {

namespace {

CameraGrid camera() {
  return camera_grid_from_blender({0.5, 0.7, 12, 40});
}

Image<float> wavy(int height, int width, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> noise(-0.2F, 0.2F);
  Image<float> map(height, width, 1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      map.at(y, x) = 0.4F * std::sin(0.2F * x) + (y > height / 2 ? 0.5F : 0) + noise(random);
    }
  }
  return map;
}

/// By comparing every point with every other one.
Image<float> by_exhaustion(const DisparityView& a, const DisparityView& b) {
  const int height = a.disparity.height;
  const int width = a.disparity.width;
  const BackProjection project(camera(), height, width, 1);
  Image<float> distance(height, width, 1, std::numeric_limits<float>::quiet_NaN());
  for (int i = 0; i < height * width; ++i) {
    if (!a.is_valid(i / width, i % width)) continue;
    const auto from = project(i / width, i % width, a.disparity.at(i / width, i % width));
    double best = std::numeric_limits<double>::infinity();
    for (int j = 0; j < height * width; ++j) {
      if (!b.is_valid(j / width, j % width)) continue;
      const auto to = project(j / width, j % width, b.disparity.at(j / width, j % width));
      best = std::min(best, std::hypot(from[0] - to[0], from[1] - to[1], from[2] - to[2]));
    }
    distance.at(i / width, i % width) = static_cast<float>(best);
  }
  return distance;
}

}  // namespace

class CloudDistanceTest : public QObject {
  Q_OBJECT

 private slots:
  void equalClouds_areNowhereApart() {
    const Image<float> map = wavy(70, 40, 3);

    const CloudDistance distance = cloud_distance({map, {}}, {map, {}}, camera(), Progress());

    QCOMPARE(distance.points, std::size_t(70 * 40));
    QCOMPARE(distance.mean, 0.0);
    QCOMPARE(distance.percentile95, 0.0);
  }

  void parallelPlanes_areAsFarApartAsTheirDepths() {
    const double near = camera().disparity_from_depth(10);
    const double far = camera().disparity_from_depth(10.01);
    const Image<float> a(70, 40, 1, float(near));
    const Image<float> b(70, 40, 1, float(far));

    const CloudDistance distance = cloud_distance({a, {}}, {b, {}}, camera(), Progress());

    QVERIFY(std::abs(distance.median - 0.01) < 2e-3);  // the points of b lie a little wider
    QVERIFY(distance.mean >= 0.0099 && distance.percentile95 < 0.013);
  }

  void everyDistance_isTheLeastOfAll() {
    const Image<float> a = wavy(67, 40, 5);
    const Image<float> b = wavy(67, 40, 7);
    Image<std::uint8_t> valid(67, 40, 1, 1);
    for (int x = 0; x < 40; ++x) valid.at(10, x) = valid.at(60, x) = 0;

    const CloudDistance distance = cloud_distance({a, valid}, {b, valid}, camera(), Progress());
    const Image<float> expected = by_exhaustion({a, valid}, {b, valid});

    std::vector<float> values;
    for (int y = 0; y < 67; ++y) {
      for (int x = 0; x < 40; ++x) {
        if (!valid.at(y, x)) {
          QVERIFY(std::isnan(distance.distance.at(y, x)));
          continue;
        }
        QVERIFY(std::abs(distance.distance.at(y, x) - expected.at(y, x)) < 1e-4);
        values.push_back(expected.at(y, x));
      }
    }
    std::ranges::sort(values);
    QCOMPARE(distance.points, values.size());
    QVERIFY(std::abs(distance.median - values[values.size() / 2]) < 1e-4);
    QVERIFY(std::abs(distance.percentile95 - values[values.size() * 95 / 100]) < 1e-3);
  }

  void threads_changeNothing() {
    const Image<float> a = wavy(67, 40, 5);
    const Image<float> b = wavy(67, 40, 7);

    const auto one = cloud_distance({a, {}}, {b, {}}, camera(), Progress(1));
    const auto four = cloud_distance({a, {}}, {b, {}}, camera(), Progress(4));

    QVERIFY(std::equal(one.distance.data(), one.distance.data() + one.distance.size(),
                       four.distance.data()));
  }

  void wrongInput_isRefused() {
    const Image<float> map(4, 4, 1, 0.1F);
    const Image<float> other(4, 5, 1, 0.1F);
    const Image<std::uint8_t> none(4, 4, 1, 0);

    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             (void)cloud_distance({map, {}}, {map, {}}, {}, Progress()));
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             (void)cloud_distance({map, {}}, {other, {}}, camera(), Progress()));
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             (void)cloud_distance({map, {}}, {map, none}, camera(), Progress()));
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             (void)cloud_distance({map, none}, {map, {}}, camera(), Progress()));
  }

  void stopRequest_isHeard() {
    const Image<float> map = wavy(70, 40, 3);
    std::stop_source stop;
    stop.request_stop();

    QVERIFY_THROWS_EXCEPTION(Cancelled, (void)cloud_distance({map, {}}, {map, {}}, camera(),
                                                             Progress(stop.get_token(), {})));
  }
};

}  // namespace episcope::in_cloud_distance_test

EPISCOPE_TEST(cloud_distance_test, CloudDistanceTest)
#include "cloud_distance_test.moc"
