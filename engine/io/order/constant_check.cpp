// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/order/constant_check.h"

#include "engine/core/array/quantile.h"
#include "engine/io/order/grey_picture.h"
#include "engine/io/order/pair_gain.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace episcope::io {
namespace {

constexpr int kSquare = 16;
constexpr int kFewestSquares = 8;
/// Standard deviations of chance. The constant is the best of many, which leaves less to it.
constexpr double kSignificant = 2.7;
constexpr int kSteps = 24;              ///< Constants tried to either side of 0.
constexpr double kDiffers = 0.25;       ///< px between the map and the constant, or less in maps
constexpr double kPartOfRange = 0.125;  ///< of which that is more than this part of the range;
constexpr double kLeastRange = 0.05;    ///< those of less px are constants.
constexpr float kLargestError = 40;     ///< Grey levels; what is hidden counts no more.
constexpr double kMostPoints = 10000;

struct Point {
  int y = 0;
  int x = 0;
  double disparity = 0;
};

std::vector<Point> points_of(const DisparityView& map) {
  const ImageView<const float>& values = map.disparity;
  const double area = static_cast<double>(values.height) * values.width;
  const int stride = std::max(1, static_cast<int>(std::sqrt(area / kMostPoints)));
  std::vector<Point> points;
  for (int y = 0; y < values.height; y += stride) {
    for (int x = 0; x < values.width; x += stride) {
      const double value = values.at(y, x);
      if (map.is_valid(y, x) && std::isfinite(value)) points.push_back({y, x, value});
    }
  }
  return points;
}

/// The view and one next to it; `shift`: of disparity 1 in the neighbour, to lower coordinates.
struct Pair {
  const Image<float>& here;
  Image<float> there;
  bool is_u;
  int shift;
  float gain = 1;

  /// Negative outside of the picture.
  [[nodiscard]] float moved(const Point& point, double disparity) const {
    const double place = (is_u ? point.x : point.y) - shift * disparity;
    const int last = (is_u ? there.width() : there.height()) - 1;
    if (!(place >= 0 && place < last)) return -1;
    const int first = static_cast<int>(place);
    const auto part = static_cast<float>(place - first);
    const float a = is_u ? there.at(point.y, first) : there.at(first, point.x);
    const float b = is_u ? there.at(point.y, first + 1) : there.at(first + 1, point.x);
    return a + part * (b - a);
  }
  /// Likewise.
  [[nodiscard]] float error(const Point& point, double disparity) const {
    const float grey = moved(point, disparity);
    if (grey < 0) return -1;
    return std::min(kLargestError, std::abs(here.at(point.y, point.x) - gain * grey));
  }
  void even_out(const std::vector<Point>& points) {
    PairGain brightness;
    for (const Point& point : points) {
      brightness.add(here.at(point.y, point.x), moved(point, point.disparity));
    }
    gain = brightness.value();
  }
};

/// Smoothed, or shifts between pixels would reduce noise, and so errors, more than others.
Image<float> picture_of(const LightField::Samples& samples, ViewIndex view) {
  return smoothed(grey_levels(samples, view));
}

std::vector<Pair> pairs_of(const LightField::Samples& samples, ViewIndex at,
                           const Image<float>& here, const WarpErrors& errors, bool is_u) {
  const bool is_reversed = (is_u ? errors.u : errors.v).says_reversed();
  std::vector<Pair> pairs;
  for (const int step : {-1, 1}) {
    const ViewIndex next = is_u ? ViewIndex{at.v, at.u + step} : ViewIndex{at.v + step, at.u};
    if (!grid_of(samples).contains(next)) continue;
    pairs.push_back({here, picture_of(samples, next), is_u, is_reversed ? -step : step});
  }
  return pairs;
}

double best_constant(const std::vector<Pair>& pairs, const std::vector<Point>& points) {
  double reach = 0;
  for (const Point& point : points) reach = std::max(reach, std::abs(point.disparity));
  std::pair<double, double> least{HUGE_VAL, 0};
  for (int step = -kSteps; step <= kSteps; ++step) {
    const double constant = reach * step / kSteps;
    double sum = 0, inside = 0;
    for (const Pair& pair : pairs) {
      for (const Point& point : points) {
        const float error = pair.error(point, constant);
        if (error < 0) continue;
        sum += error;
        inside += 1;
      }
    }
    if (2 * inside < static_cast<double>(pairs.size() * points.size())) continue;
    least = std::min(least, {sum / inside, constant});
  }
  return least.second;
}

/// Of 90 % of the points.
double range_of(const std::vector<Point>& points) {
  std::vector<float> values;
  for (const Point& point : points) values.push_back(static_cast<float>(point.disparity));
  if (values.empty()) return 0;
  return quantile(values, 0.95) - quantile(values, 0.05);
}

/// By how much the map is better than a constant in a square.
struct Sum {
  double better = 0;
  int points = 0;
};
using Squares = std::map<std::pair<int, int>, Sum>;

/// One disparity for all, and how far a map is from it that differs.
struct Constant {
  double disparity = 0;
  double differs = 0;
};

void add_pair(const Pair& pair, const std::vector<Point>& points, const Constant& constant,
              Squares& squares) {
  for (const Point& point : points) {
    if (std::abs(point.disparity - constant.disparity) < constant.differs) continue;
    const float by_map = pair.error(point, point.disparity);
    const float by_constant = pair.error(point, constant.disparity);
    if (by_map < 0 || by_constant < 0) continue;
    Sum& sum = squares[{point.y / kSquare, point.x / kSquare}];
    sum.better += by_constant - by_map;
    ++sum.points;
  }
}

ConstantComparison compared(const Squares& squares) {
  double sum = 0, square = 0;
  for (const auto& [place, one] : squares) {
    const double better = one.better / one.points;
    sum += better;
    square += better * better;
  }
  const auto count = static_cast<double>(squares.size());
  if (count < kFewestSquares) return {static_cast<int>(count), 0};
  const double mean = sum / count;
  const double variance = std::max(square / count - mean * mean, 1e-9);
  return {static_cast<int>(count), mean / std::sqrt(variance / count)};
}

}  // namespace

bool ConstantComparison::is_told() const {
  return squares >= kFewestSquares;
}

bool ConstantComparison::is_better() const {
  return is_told() && score > kSignificant;
}

ConstantComparison compare_with_constant(const LightField::Samples& samples, ViewIndex at,
                                         const DisparityView& disparity, const WarpErrors& errors) {
  const std::vector<Point> points = points_of(disparity);
  const double range = range_of(points);
  if (range < kLeastRange) return {};
  const double differs = std::min(kDiffers, kPartOfRange * range);
  const Image<float> here = picture_of(samples, at);
  Squares squares;
  for (const bool is_u : {true, false}) {
    std::vector<Pair> pairs = pairs_of(samples, at, here, errors, is_u);
    for (Pair& pair : pairs) pair.even_out(points);
    const double constant = best_constant(pairs, points);
    for (const Pair& pair : pairs) add_pair(pair, points, {constant, differs}, squares);
  }
  return compared(squares);
}

}  // namespace episcope::io
