// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/depth_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace episcope::io {
namespace {

constexpr double kExact = 0.01;  ///< px
constexpr int kRounds = 6;

struct Point {
  double inverse = 0;  ///< 1/Z
  double disparity = 0;
};

struct Line {
  double a = 0;
  double b = 0;
  [[nodiscard]] double residual(const Point& p) const {
    return std::abs(p.disparity - (a * p.inverse - b));
  }
};

Line least_squares(const std::vector<Point>& points, const Line& last, double limit) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const Point& p : points) {
    if (last.residual(p) > limit) continue;
    n += 1;
    x += p.inverse;
    y += p.disparity;
    xx += p.inverse * p.inverse;
    xy += p.inverse * p.disparity;
  }
  const double spread = n * xx - x * x;
  if (n < 2 || spread <= 1e-12 * n * xx) return {};
  Line line;
  line.a = (n * xy - x * y) / spread;
  line.b = (line.a * x - y) / n;
  return line;
}

double median_residual(const std::vector<Point>& points, const Line& line) {
  std::vector<double> residuals;
  residuals.reserve(points.size());
  for (const Point& p : points) residuals.push_back(line.residual(p));
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  return *middle;
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
  std::vector<Point> points;
  for (int y = 0; y < disparity.disparity.height; ++y) {
    for (int x = 0; x < disparity.disparity.width; ++x) {
      if (!disparity.is_valid(y, x) || !depth.is_valid(y, x)) continue;
      const double z = depth.disparity.at(y, x);
      if (z > 0) points.push_back({1 / z, factor * disparity.disparity.at(y, x)});
    }
  }
  if (points.size() < 2) return {};
  Line line = least_squares(points, {}, HUGE_VAL);
  for (int round = 0; round < kRounds; ++round) {
    line = least_squares(points, line, std::max(3 * median_residual(points, line), 1e-6));
  }
  const auto exact =
      std::ranges::count_if(points, [&](const Point& p) { return line.residual(p) < kExact; });
  return {line.a, line.b, static_cast<double>(exact) / static_cast<double>(points.size()),
          points.size()};
}

}  // namespace episcope::io
