// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane_labeling.h"

#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>
#include <utility>

namespace episcope::in_silhouette_median_test {

using namespace episcope::test;

namespace {

constexpr int kSize = 24;
constexpr int kEdge = 12;

// A bright half beside a dark one.
LightField halves() {
  return make_light_field({1, 1}, kSize, kSize, 3,
                          [](ViewIndex, int, int x, int) { return x < kEdge ? 0.7F : 0.3F; });
}

// The same without the columns from `first` on.
LightField halves_until(int first) {
  ViewStack<float> samples = float_samples(halves());
  ViewStack<std::uint8_t> valid({1, 1}, kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) valid.view({0, 0}).at(y, x) = x < first ? 1 : 0;
  }
  return LightField(std::move(samples), {}, std::move(valid));
}

// A surface of disparity 1 on the left that reaches `too_far` px beyond the edge.
Image<float> fattened(int too_far) {
  Image<float> map(kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) map.at(y, x) = x < kEdge + too_far ? 1.0F : 0.0F;
  }
  return map;
}

}  // namespace

class SilhouetteMedianTest : public QObject {
  Q_OBJECT

 private slots:
  void silhouette_movesToTheEdge();
  void smoothSurface_staysAsItIs();
  void invalidPixels_neitherCountNorChange();
};

void SilhouetteMedianTest::silhouette_movesToTheEdge() {
  Image<float> map = fattened(1);

  place_silhouettes(halves(), {0, 0}, Progress(), map.view());

  const Image<float> right = fattened(0);
  QVERIFY(std::equal(map.begin(), map.end(), right.begin()));
}

void SilhouetteMedianTest::smoothSurface_staysAsItIs() {
  const auto slant = [](int y, int x) {
    return 0.15F * static_cast<float>(x) + 0.02F * static_cast<float>(y % 3);
  };
  Image<float> map(kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) map.at(y, x) = slant(y, x);
  }

  place_silhouettes(halves(), {0, 0}, Progress(), map.view());

  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) QCOMPARE(map.at(y, x), slant(y, x));
  }
}

void SilhouetteMedianTest::invalidPixels_neitherCountNorChange() {
  Image<float> map = fattened(2);

  place_silhouettes(halves_until(kEdge + 2), {0, 0}, Progress(), map.view());

  // Beyond the edge only pixels that were too far are left to vote.
  const Image<float> before = fattened(2);
  QVERIFY(std::equal(map.begin(), map.end(), before.begin()));
}

}  // namespace episcope::in_silhouette_median_test

EPISCOPE_TEST(silhouette_median_test, SilhouetteMedianTest)
#include "silhouette_median_test.moc"
