// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/predict_from_strokes.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace episcope::in_stroke_distance_test {

namespace {

constexpr int kHeight = 9;
constexpr int kWidth = 11;

Image<std::int32_t> two_dots() {
  Image<std::int32_t> strokes(kHeight, kWidth);
  strokes.at(4, 1) = 1;
  strokes.at(4, 9) = 2;
  return strokes;
}

// By relaxing all steps until nothing changes.
std::vector<double> reference(const Image<std::int32_t>& strokes, int label,
                              const Image<float>& guide) {
  const int height = strokes.height();
  const int width = strokes.width();
  std::vector<double> distance(strokes.size(), 1e9);
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    if (strokes.data()[i] == label + 1) distance[i] = 0;
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (int i = 0; i < height * width * 9; ++i) {
      const int y = i / 9 / width, x = i / 9 % width;
      const int ny = y + i % 9 / 3 - 1, nx = x + i % 3 - 1;
      if (ny < 0 || ny >= height || nx < 0 || nx >= width) continue;
      const double way = distance[static_cast<std::size_t>(ny) * width + nx] +
                         StrokeDistances::kStep * std::hypot(ny - y, nx - x) +
                         std::abs(guide.at(y, x) - guide.at(ny, nx));
      double& own = distance[static_cast<std::size_t>(y) * width + x];
      if (way < own - 1e-9) {
        own = way;
        changed = true;
      }
    }
  }
  return distance;
}

}  // namespace

class StrokeDistanceTest : public QObject {
  Q_OBJECT

 private slots:
  void distances_areThoseOfShortestWays();
  void wall_parts();
  void jumpsOfDisparity_part_slopesDoNot();
  void untrustedJumps_partNothing();
  void surface_goesOnBehindAFence();
  void labelWithoutStroke_isLeftToTheForest();
  void weighing_keepsTheSum();
  void instructionSets_agree();
  void strokes_areCarriedAlongRays_andHiddenOnesAreNot();
};

void StrokeDistanceTest::distances_areThoseOfShortestWays() {
  // Hills without mazes, so that three sweeps find every way.
  Image<float> guide(kHeight, kWidth);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      guide.at(y, x) = 0.0005F * static_cast<float>((x - 6) * (x - 6) + 2 * y * y);
    }
  }
  const Image<std::int32_t> strokes = two_dots();

  const StrokeDistances distances(strokes, 2, {{guide.view()}}, Progress());

  const auto first = reference(strokes, 0, guide);
  const auto second = reference(strokes, 1, guide);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * kWidth + x;
      const double excess = first[i] - std::min(first[i], second[i]);
      QVERIFY(std::abs(distances.excess(y, x, 0) - excess) < 1e-5);
    }
  }
}

void StrokeDistanceTest::wall_parts() {
  Image<float> guide(kHeight, kWidth);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 8; x < kWidth; ++x) guide.at(y, x) = 1;
  }

  const StrokeDistances distances(two_dots(), 2, {{guide.view()}}, Progress());

  // Column 7 is nearer to the second dot, but beyond the wall.
  QCOMPARE(distances.excess(4, 7, 0), 0.F);
  QVERIFY(distances.excess(4, 7, 1) > 0.9F);
  QCOMPARE(distances.excess(4, 8, 1), 0.F);
}

void StrokeDistanceTest::jumpsOfDisparity_part_slopesDoNot() {
  Image<float> guide(kHeight, kWidth);
  Image<float> slope(kHeight, kWidth);
  Image<float> jump(kHeight, kWidth);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      slope.at(y, x) = 0.9F * StrokeDistances::kSlope_px * static_cast<float>(x);
      jump.at(y, x) = x < 8 ? 0 : 1;
    }
  }

  const StrokeDistances flat(two_dots(), 2, {{guide.view()}}, Progress());
  const StrokeDistances slanted(two_dots(), 2, {{guide.view()}, slope.view()}, Progress());
  const StrokeDistances parted(two_dots(), 2, {{guide.view()}, jump.view()}, Progress());

  QCOMPARE(slanted.excess(4, 7, 0), flat.excess(4, 7, 0));
  QCOMPARE(parted.excess(4, 7, 0), 0.F);
  QVERIFY(parted.excess(4, 7, 1) > 4);
}

void StrokeDistanceTest::untrustedJumps_partNothing() {
  Image<float> guide(kHeight, kWidth);
  Image<float> jump(kHeight, kWidth);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      guide.at(y, x) = x < 6 ? 0 : 0.5F;
      jump.at(y, x) = x < 8 ? 0 : 1;
    }
  }
  const Image<float> trust(kHeight, kWidth);

  const StrokeDistances alone(two_dots(), 2, {{guide.view()}}, Progress());
  const StrokeDistances untrusted(two_dots(), 2,
                                  {{guide.view()}, jump.view(), nullptr, trust.view()}, Progress());

  for (int x = 0; x < kWidth; ++x) {
    QVERIFY(std::abs(untrusted.excess(4, x, 0) - alone.excess(4, x, 0)) < 1e-5F);
  }
}

void StrokeDistanceTest::surface_goesOnBehindAFence() {
  // A fence of label 2 in every third column before a wall of label 1, which is painted on the
  // left.
  constexpr int kLong = 30;
  Image<float> disparity(kHeight, kLong);
  Image<std::int32_t> strokes(kHeight, kLong);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kLong; ++x) {
      const bool is_fence = x > 4 && x % 3 == 0;
      disparity.at(y, x) = is_fence ? 1.5F : 0.01F * static_cast<float>(x);
      if (x < 4) strokes.at(y, x) = 1;
      if (is_fence && x < 13) strokes.at(y, x) = 2;
    }
  }
  const Image<float> guide(kHeight, kLong);
  const LabelSurfaces surfaces(strokes.view(), 2, disparity.view(), {}, Progress());

  const StrokeDistances along(strokes, 2, {{guide.view()}, disparity.view()}, Progress());
  const StrokeDistances behind(strokes, 2, {{guide.view()}, disparity.view(), &surfaces},
                               Progress());

  // Between the last bars, many gaps away from the strokes of the wall.
  QVERIFY(along.excess(4, 28, 0) > 1);
  QCOMPARE(behind.excess(4, 28, 0), 0.F);
  QVERIFY(behind.excess(4, 28, 1) > 0.1F);
}

void StrokeDistanceTest::labelWithoutStroke_isLeftToTheForest() {
  const Image<float> guide(kHeight, kWidth);

  const StrokeDistances distances(two_dots(), 3, {{guide.view()}}, Progress());

  QCOMPARE(distances.excess(0, 0, 2), 0.F);
}

void StrokeDistanceTest::weighing_keepsTheSum() {
  Image<float> guide(kHeight, kWidth);
  for (int y = 0; y < kHeight; ++y) guide.at(y, 10) = 1;
  const StrokeDistances distances(two_dots(), 2, {{guide.view()}}, Progress());
  std::vector<float> row(static_cast<std::size_t>(kWidth) * 16);
  for (int x = 0; x < kWidth; ++x) row[x * 16] = row[x * 16 + 1] = 0.5F;

  distances.weigh_row(4, 100, row.data());

  for (int x = 0; x < kWidth; ++x) QVERIFY(std::abs(row[x * 16] + row[x * 16 + 1] - 1) < 1e-5F);
  QVERIFY(row[1 * 16] > 0.6F);      // At the first dot,
  QVERIFY(row[9 * 16 + 1] > 0.6F);  // and at the second.
}

void StrokeDistanceTest::instructionSets_agree() {
  std::mt19937 random(7);
  Image<float> guide(kHeight, kWidth);
  for (float& value : guide) value = static_cast<float>(random() % 100) * 0.01F;

  const StrokeDistances best(two_dots(), 2, {{guide.view()}}, Progress());
  const StrokeDistances plain(two_dots(), 2, {{guide.view()}}, Progress(), Isa::Baseline);

  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) QCOMPARE(best.excess(y, x, 0), plain.excess(y, x, 0));
  }
}

void StrokeDistanceTest::strokes_areCarriedAlongRays_andHiddenOnesAreNot() {
  DisparityField field;
  field.disparity = ViewStack<float>({1, 2}, 1, 8);
  std::fill_n(field.disparity.data(), field.disparity.size(), 1.F);
  field.disparity.view({0, 1}).at(0, 4) = 3;  // Something nearer hides what arrives here.
  Scribbles scribbles;
  scribbles.views.push_back({{0, 0}, Image<std::int32_t>(1, 8)});
  scribbles.views[0].labels.at(0, 3) = 7;
  scribbles.views[0].labels.at(0, 5) = 9;
  const std::vector<std::int32_t> ids{7, 9};

  const auto own = propagated_strokes(scribbles, ids, &field, {0, 0}, 1, 8);
  const auto carried = propagated_strokes(scribbles, ids, &field, {0, 1}, 1, 8);
  const auto without = propagated_strokes(scribbles, ids, nullptr, {0, 1}, 1, 8);

  QCOMPARE(own.at(0, 3), 1);
  QCOMPARE(own.at(0, 5), 2);
  QCOMPARE(carried.at(0, 2), 1);  // x − d·1
  QCOMPARE(std::ranges::count(carried, 2), 0);
  QVERIFY(std::ranges::all_of(without, [](std::int32_t l) { return l == 0; }));
}

}  // namespace episcope::in_stroke_distance_test

EPISCOPE_TEST(stroke_distance_test, StrokeDistanceTest)
#include "stroke_distance_test.moc"
