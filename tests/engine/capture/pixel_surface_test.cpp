// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/pixel_surface.h"

#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace episcope::in_pixel_surface_test {

using namespace capture;

namespace {

/// The share of the pixel that shows each triangle, by `side`² samples.
std::vector<double> sampled_areas(const std::vector<ScreenTriangle>& triangles, int side) {
  std::vector<double> areas(triangles.size(), 0.0);
  for (int i = 0; i < side * side; ++i) {
    const Corner p{(i % side + 0.5) / side - 0.5, (i / side + 0.5) / side - 0.5};
    int nearest = -1;
    double largest = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto& c = triangles[t].polygon.corners;
      const auto turn = [&](int a, int b) {
        return (c[b].x - c[a].x) * (p.y - c[a].y) - (c[b].y - c[a].y) * (p.x - c[a].x);
      };
      const bool is_left = turn(0, 1) >= 0 && turn(1, 2) >= 0 && turn(2, 0) >= 0;
      const bool is_right = turn(0, 1) <= 0 && turn(1, 2) <= 0 && turn(2, 0) <= 0;
      const double w = triangles[t].plane.at(p);
      if ((is_left || is_right) && w > largest) {
        largest = w;
        nearest = static_cast<int>(t);
      }
    }
    if (nearest >= 0) areas[nearest] += 1.0 / (side * side);
  }
  return areas;
}

std::vector<ScreenTriangle> random_triangles(std::mt19937& random, int count) {
  std::uniform_real_distribution<float> place(-1.2F, 1.2F);
  std::uniform_real_distribution<float> depth(1, 2);
  std::vector<ScreenTriangle> triangles;
  for (int i = 0; i < count; ++i) {
    std::array<ScreenVertex, 3> v;
    for (ScreenVertex& vertex : v) vertex = {place(random), place(random), depth(random)};
    triangles.push_back(around_pixel(v, 0, 0));
  }
  return triangles;
}

// As the rasterizer finds them.
std::vector<Fragment> fragments_of(const std::vector<ScreenTriangle>& triangles) {
  std::vector<Fragment> fragments;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const Polygon part = clipped_to_pixel(triangles[i].polygon);
    if (part.count < 3) continue;
    Fragment fragment{.triangle = i, .near = -1, .far = 99, .is_front = true};
    fragment.area = static_cast<float>(std::abs(twice_area(part)) / 2);
    for (int c = 0; c < part.count; ++c) {
      const auto w = static_cast<float>(triangles[i].plane.at(part.corners[c]));
      fragment.near = std::max(fragment.near, w);
      fragment.far = std::min(fragment.far, w);
    }
    fragments.push_back(fragment);
  }
  return fragments;
}

std::array<ScreenVertex, 3> flat(float x0, float y0, float x1, float y1, float x2, float y2,
                                 float w) {
  return {ScreenVertex{x0, y0, w}, {x1, y1, w}, {x2, y2, w}};
}

}  // namespace

class PixelSurfaceTest : public QObject {
  Q_OBJECT

 private slots:
  void randomTriangles_thatPierceEachOther_showWhatSamplesShow() {
    std::mt19937 random(3);
    for (int trial = 0; trial < 150; ++trial) {
      const auto triangles = random_triangles(random, 2 + trial % 9);
      constexpr int side = 160;
      const std::vector<double> expected = sampled_areas(triangles, side);
      std::vector<double> areas(triangles.size(), 0.0);
      for (const VisiblePart& part : visible_parts(triangles)) areas[part.index] = part.area;
      for (std::size_t i = 0; i < areas.size(); ++i) {
        // Samples miss by up to half a sample along borders, of which there are a few px.
        QVERIFY2(std::abs(areas[i] - expected[i]) < 4.0 / side,
                 qPrintable(QString("trial %1, triangle %2: %3, by samples %4")
                                .arg(trial)
                                .arg(i)
                                .arg(areas[i])
                                .arg(expected[i])));
      }
    }
  }

  void theLargestVisibleArea_decides() {
    // In front a narrow strip, behind it a wide one: the wide one decides, less what is hidden.
    const std::vector<std::array<ScreenVertex, 3>> corners{
        flat(-0.5F, -9, -0.1F, 0, -0.5F, 9, 0.2F), flat(-9, -9, 9, -9, 0, 30, 0.1F)};
    std::vector<Fragment> fragments;
    for (std::uint32_t i = 0; i < corners.size(); ++i) {
      const float w = corners[i][0].w;
      fragments.push_back({i, i == 0 ? 0.39F : 1.0F, w, w, 0, true});
    }
    PixelResolver resolver(1e9);
    const PixelSurface surface = resolver.resolve(
        fragments, [&](std::uint32_t id) { return around_pixel(corners[id], 0, 0); });
    QCOMPARE(surface.triangle, 1U);
    QVERIFY(std::abs(surface.covered - 1) < 1e-9);

    PixelResolver sensitive(0.01);
    const PixelSurface edge = sensitive.resolve(
        fragments, [&](std::uint32_t id) { return around_pixel(corners[id], 0, 0); });
    QVERIFY(edge.is_edge);
  }

  // The rule against samples, on triangles that hide and pierce each other.
  void theTriangleThatDecides_isThatOfBruteForce() {
    std::mt19937 random(11);
    int decided = 0;
    for (int trial = 0; trial < 300; ++trial) {
      const auto triangles = random_triangles(random, 2 + trial % 9);
      constexpr int side = 160;
      const std::vector<double> areas = sampled_areas(triangles, side);
      const auto best = std::ranges::max_element(areas);
      const auto is_close = [&](double area) { return area > *best - 8.0 / side; };
      if (std::ranges::count_if(areas, is_close) != 1) continue;  // too close for samples to tell
      std::vector<Fragment> fragments = fragments_of(triangles);
      const PixelSurface surface =
          PixelResolver(0.1).resolve(fragments, [&](std::uint32_t id) { return triangles[id]; });
      QCOMPARE(surface.triangle, static_cast<std::uint32_t>(best - areas.begin()));
      ++decided;
    }
    QVERIFY2(decided > 200, qPrintable(QString::number(decided)));
  }

  void tilesOfOneSurface_areNotCounted_twice() {
    // Two triangles of a square cut the pixel along its diagonal: half of it each, the first wins.
    const std::vector<std::array<ScreenVertex, 3>> corners{flat(-2, -2, 2, 2, -2, 2, 0.1F),
                                                           flat(-2, -2, 2, -2, 2, 2, 0.1F)};
    const std::vector<ScreenTriangle> triangles{around_pixel(corners[0], 0, 0),
                                                around_pixel(corners[1], 0, 0)};
    const auto parts = visible_parts(triangles);
    QCOMPARE(parts.size(), std::size_t{2});
    for (const VisiblePart& part : parts) QVERIFY(std::abs(part.area - 0.5) < 1e-12);
  }
};

}  // namespace episcope::in_pixel_surface_test

EPISCOPE_TEST(pixel_surface_test, PixelSurfaceTest)
#include "pixel_surface_test.moc"
