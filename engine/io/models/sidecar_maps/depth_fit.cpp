// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/sidecar_maps/depth_fit.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace episcope::io {
namespace {

constexpr double kExact = 0.01;  ///< px
constexpr int kTriedLines = 200;
constexpr std::size_t kSome = 2000;  ///< Points by which a pair is judged.

struct DepthPoint {
  double inverse = 0;  ///< 1/Z
  double disparity = 0;
};

struct DepthLine {
  double a = 0;
  double b = 0;
  [[nodiscard]] double residual(const DepthPoint& p) const {
    return std::abs(p.disparity - (a * p.inverse - b));
  }
};

/// Through the points that `last` explains.
DepthLine least_squares(const std::vector<DepthPoint>& points, const DepthLine& last) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const DepthPoint& p : points) {
    if (last.residual(p) > kExact) continue;
    n += 1;
    x += p.inverse;
    y += p.disparity;
    xx += p.inverse * p.inverse;
    xy += p.inverse * p.disparity;
  }
  const double spread = n * xx - x * x;
  if (n < 2 || spread <= 1e-12 * n * xx) return last;
  DepthLine line;
  line.a = (n * xy - x * y) / spread;
  line.b = (line.a * x - y) / n;
  return line;
}

std::ptrdiff_t count_exact(const std::vector<DepthPoint>& points, const DepthLine& line) {
  return std::ranges::count_if(points,
                               [&](const DepthPoint& p) { return line.residual(p) < kExact; });
}

/// Of lines through pairs of points, the one that explains most points.
DepthLine best_line(const std::vector<DepthPoint>& points) {
  std::vector<DepthPoint> some;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kSome);
  for (std::size_t i = 0; i < points.size(); i += stride) some.push_back(points[i]);
  std::mt19937 random(1);
  DepthLine best;
  std::ptrdiff_t most = 0;
  for (int pair = 0; pair < kTriedLines; ++pair) {
    const DepthPoint& p = some[random() % some.size()];
    const DepthPoint& q = some[random() % some.size()];
    const double run = p.inverse - q.inverse;
    if (std::abs(run) < 1e-3 * std::max(p.inverse, q.inverse)) continue;
    DepthLine line;
    line.a = (p.disparity - q.disparity) / run;
    line.b = line.a * p.inverse - p.disparity;
    const std::ptrdiff_t exact = count_exact(some, line);
    if (exact <= most) continue;
    most = exact;
    best = line;
  }
  return best;
}

}  // namespace

CameraGrid DepthFit::camera() const {
  CameraGrid camera;
  camera.baseline = a;
  camera.focal_length = 1;
  camera.shift = b;
  return camera;
}

DepthFit fit_depth(const DisparityView& disparity, double factor, const DisparityView& depth) {
  std::vector<DepthPoint> points;
  for (int y = 0; y < disparity.disparity.height; ++y) {
    for (int x = 0; x < disparity.disparity.width; ++x) {
      if (!disparity.is_valid(y, x) || !depth.is_valid(y, x)) continue;
      const double z = depth.disparity.at(y, x);
      if (z > 0) points.push_back({1 / z, factor * disparity.disparity.at(y, x)});
    }
  }
  if (points.size() < 2) return {};
  const DepthLine line = least_squares(points, best_line(points));
  const std::ptrdiff_t exact = count_exact(points, line);
  return {line.a, line.b, static_cast<double>(exact) / static_cast<double>(points.size()),
          points.size()};
}

}  // namespace episcope::io
