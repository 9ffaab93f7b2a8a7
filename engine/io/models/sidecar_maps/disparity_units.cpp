// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/sidecar_maps/disparity_units.h"

#include "engine/core/numbers.h"
#include "engine/io/models/order/sign_check.h"
#include "engine/io/models/order/warp_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <utility>
#include <vector>

namespace episcope::io {
namespace {

/// A map that explains views this well needs no comparison with other units.
constexpr double kPlainUnit = 0.5;
/// Another unit must leave at most this share of the error.
constexpr double kClearlyBetterUnit = 0.85;

struct ScaledMap {
  Image<float> disparity;
  ImageView<const std::uint8_t> valid;
  [[nodiscard]] DisparityView view() const { return {disparity.view(), valid}; }
};

ScaledMap scaled(const DisparityView& map, double factor) {
  ScaledMap result{Image<float>(map.disparity.height, map.disparity.width), map.valid};
  for (int y = 0; y < map.disparity.height; ++y) {
    const float* in = map.disparity.row(y);
    std::transform(in, in + map.disparity.width, result.disparity.row(y),
                   [&](float value) { return static_cast<float>(factor * value); });
  }
  return result;
}

/// The view and its four neighbors with rows and columns exchanged; the corners stay unset.
LightField::Samples transposed_cross(const LightField::Samples& samples, ViewIndex at) {
  return std::visit(
      [&]<class T>(const ViewStack<T>& stack) -> LightField::Samples {
        ViewStack<T> cross({3, 3}, stack.height(), stack.width(), stack.channels());
        for (int v = -1; v <= 1; ++v) {
          for (int u = -1; u <= 1; ++u) {
            if (v != 0 && u != 0) continue;
            std::copy_n(stack.view({at.v + v, at.u + u}).data, stack.view_size(),
                        cross.view({1 + u, 1 + v}).data);
          }
        }
        return cross;
      },
      samples);
}

bool has_four_neighbours(GridShape grid, ViewIndex at) {
  return at.v > 0 && at.u > 0 && at.v + 1 < grid.v && at.u + 1 < grid.u;
}

Explanation explanation_of(const WarpErrors& errors) {
  Explanation found;
  const auto pixels = static_cast<double>(errors.u.pixels + errors.v.pixels);
  if (pixels == 0) return found;
  found.error = errors.best();
  found.unwarped = (errors.u.unwarped * static_cast<double>(errors.u.pixels) +
                    errors.v.unwarped * static_cast<double>(errors.v.pixels)) /
                   pixels;
  found.reversed_u = errors.u.says_reversed();
  found.reversed_v = errors.v.says_reversed();
  return found;
}

}  // namespace

std::vector<MapUnit> common_units(GridShape grid, int width) {
  std::vector<MapUnit> units{{1, "px per view step"}};
  const int steps = std::max(grid.u, grid.v) - 1;
  if (steps > 1) {
    units.push_back(
        {1.0 / steps, fmt::format("px over the {} steps of the whole baseline", steps)});
  }
  if (steps > 3) {
    units.push_back({2.0 / steps, "px from the center view to the outermost one"});
  }
  units.push_back({static_cast<double>(width), "widths of the image per view step"});
  return units;
}

Explanation explain_views(const LightField::Samples& samples, ViewIndex at,
                          const DisparityView& map, double factor) {
  const ScaledMap disparity = scaled(map, factor);
  Explanation best = explanation_of(warp_errors(samples, at, disparity.view()));
  const GridShape grid = grid_of(samples);
  if (best.error <= kPlainUnit * best.unwarped || !has_four_neighbours(grid, at)) return best;
  Explanation exchanged =
      explanation_of(warp_errors(transposed_cross(samples, at), {1, 1}, disparity.view()));
  if (exchanged.error >= kClearlyBetterUnit * best.error) return best;
  exchanged.is_transposed = true;
  return exchanged;
}

SettledUnit settle_unit(const LightField::Samples& samples, ViewIndex at, const DisparityView& map,
                        const std::vector<MapUnit>& units) {
  const Explanation first = explain_views(samples, at, map, units.front().factor);
  SettledUnit best{units.front(), first, first};
  if (first.error <= kPlainUnit * first.unwarped) return best;
  for (std::size_t i = 1; i < units.size(); ++i) {
    const Explanation other = explain_views(samples, at, map, units[i].factor);
    const bool is_better = other.error < kClearlyBetterUnit * first.error && other.is_good() &&
                           other.error < best.explanation.error;
    if (is_better) best = {units[i], other, first};
  }
  return best;
}

namespace {

constexpr int kFarthestOccluded = 4;  ///< View steps.
constexpr float kContrast = 15;       ///< Grey levels between the two pixels of a pair, or in weak
                                 ///< views so many times the usual error, and no less than this;
constexpr float kPairAboveNoise = 2.5;
constexpr float kLeastPairContrast = 2;
constexpr double kPlaceGap = 1.5;  ///< px between their places if both moved on.
constexpr int kErrorStride = 7;    ///< Of the pixels that tell the usual error.
constexpr int kFewestPairs = 50;
constexpr double kDistinct = 0.85;  ///< Of the larger error, at most.
/// Standard deviations of chance, of which pairs of the same edge, seen side by side and from four
/// sides, make one out of two.
constexpr double kSignificantPairs = 6.6;

/// Two pixels that fall on the same one of another view.
struct HiddenPair {
  float contrast = 0;  ///< In grey levels,
  float larger = 0;    ///< and the errors of both.
  float smaller = 0;
};

struct Compared {
  std::vector<HiddenPair> pairs;
  std::vector<float> errors;  ///< Of any pixels.
};

/// One row or column of the view, and of the other view.
struct Line {
  std::vector<float> here;
  std::vector<float> there;
  std::vector<double> shift;  ///< NaN = invalid.
};

double sample(const std::vector<float>& line, double place) {
  const auto i = static_cast<std::size_t>(place);
  const std::size_t next = std::min(i + 1, line.size() - 1);
  const double part = place - static_cast<double>(i);
  return line[i] + part * (line[next] - line[i]);
}

/// `sign`: whether a larger shift means a larger disparity.
void compare_pairs(const Line& line, double sign, Compared& compared) {
  struct Extremes {
    int least = -1;
    int most = -1;
  };
  const int length = static_cast<int>(line.here.size());
  std::vector<Extremes> at(line.here.size());
  const auto error = [&](int i) {
    const auto place = static_cast<std::size_t>(i);
    return static_cast<float>(
        std::abs(line.here[place] - sample(line.there, i - line.shift[place])));
  };
  for (int i = 0; i < length; ++i) {
    const double shift = line.shift[static_cast<std::size_t>(i)];
    const double place = i - shift;
    if (!(place >= 0 && place <= length - 1)) continue;  // NaN too
    Extremes& cell = at[static_cast<std::size_t>(std::lround(place))];
    const auto value = [&](int j) { return sign * line.shift[static_cast<std::size_t>(j)]; };
    if (cell.least < 0 || sign * shift < value(cell.least)) cell.least = i;
    if (cell.most < 0 || sign * shift > value(cell.most)) cell.most = i;
    if (i % kErrorStride == 0) compared.errors.push_back(error(i));
  }
  for (const Extremes& cell : at) {
    if (cell.least == cell.most) continue;
    const auto least = static_cast<std::size_t>(cell.least);
    const auto most = static_cast<std::size_t>(cell.most);
    if (std::abs(line.shift[most] - line.shift[least]) < kPlaceGap) continue;
    compared.pairs.push_back(
        {std::abs(line.here[most] - line.here[least]), error(cell.most), error(cell.least)});
  }
}

struct ComparedPair {
  const Image<float>& here;
  const Image<float>& there;
  bool is_along_x;
  double pixels;  ///< Shift of disparity 1.
};

void compare_views(const ComparedPair& pair, const DisparityView& map, double factor,
                   Compared& compared) {
  const int lines = pair.is_along_x ? pair.here.height() : pair.here.width();
  const int length = pair.is_along_x ? pair.here.width() : pair.here.height();
  Line line;
  line.here.resize(static_cast<std::size_t>(length));
  line.there.resize(line.here.size());
  line.shift.resize(line.here.size());
  for (int l = 0; l < lines; ++l) {
    for (int i = 0; i < length; ++i) {
      const int y = pair.is_along_x ? l : i;
      const int x = pair.is_along_x ? i : l;
      const auto place = static_cast<std::size_t>(i);
      line.here[place] = pair.here.at(y, x);
      line.there[place] = pair.there.at(y, x);
      line.shift[place] =
          map.is_valid(y, x) ? pair.pixels * factor * map.disparity.at(y, x) : std::nan("");
    }
    compare_pairs(line, pair.pixels < 0 ? -1 : 1, compared);
  }
}

/// By the pairs of at least this contrast.
OcclusionOrder side_of(const std::vector<HiddenPair>& pairs, float contrast) {
  OcclusionOrder side;
  double squares = 0;
  for (const HiddenPair& pair : pairs) {
    if (pair.contrast < contrast) continue;
    side.larger += pair.larger;
    side.smaller += pair.smaller;
    squares += (pair.larger - pair.smaller) * (pair.larger - pair.smaller);
    ++side.points;
  }
  if (side.points == 0) return {};
  side.larger /= side.points;
  side.smaller /= side.points;
  const double mean = side.larger - side.smaller;
  side.doubt = std::sqrt(std::max(0.0, squares / side.points - mean * mean) / side.points);
  return side;
}

/// Above noise, but not above what is enough in any view.
float weak_contrast(std::vector<float> errors) {
  if (errors.empty()) return kContrast;
  return std::clamp(kPairAboveNoise * quantile(errors, 0.5), kLeastPairContrast, kContrast);
}

}  // namespace

bool OcclusionOrder::is_decided() const {
  return points >= kFewestPairs &&
         std::min(larger, smaller) < kDistinct * std::max(larger, smaller) &&
         std::abs(larger - smaller) > kSignificantPairs * doubt;
}

OcclusionOrder find_occlusion_order(const LightField::Samples& samples, ViewIndex at,
                                    const DisparityView& map, double factor,
                                    const Explanation& explanation) {
  const GridShape grid = grid_of(samples);
  const Image<float> here = grey_levels(samples, at);
  Compared compared;
  for (const bool is_along_x : {true, false}) {
    const bool is_u = is_along_x != explanation.is_transposed;
    const bool is_reversed = is_along_x ? explanation.reversed_u : explanation.reversed_v;
    for (const int direction : {-1, 1}) {
      int steps = 0;
      const auto neighbour = [&](int n) {
        return is_u ? ViewIndex{at.v, at.u + direction * n} : ViewIndex{at.v + direction * n, at.u};
      };
      while (steps < kFarthestOccluded && grid.contains(neighbour(steps + 1))) ++steps;
      if (steps == 0) continue;
      const Image<float> there = grey_levels(samples, neighbour(steps));
      const double pixels = (is_reversed ? -1.0 : 1.0) * direction * steps;
      compare_views({here, there, is_along_x, pixels}, map, factor, compared);
    }
  }
  const OcclusionOrder plain = side_of(compared.pairs, kContrast);
  return plain.is_decided() ? plain : side_of(compared.pairs, weak_contrast(compared.errors));
}

std::string hiding_text(const OcclusionOrder& side) {
  return fmt::format(
      "hide others in other views (grey error {:.2f}, the hidden ones {:.2f}, {} pairs)",
      std::min(side.larger, side.smaller), std::max(side.larger, side.smaller), side.points);
}

namespace {

constexpr const char* kByOrder =
    "no depth edges tell near from far: the sign is the one that leaves the views in the order in "
    "which they are stored";

std::optional<TruthSign> sign_by_views(const LightField::Samples& samples,
                                       const Explanation& explanation) {
  const ViewFlip flip{explanation.reversed_u, explanation.reversed_v};
  const SignFinding views = check_sign(samples, flip, true, Progress(1));
  if (!views.is_decided) return std::nullopt;
  const bool is_negated = !(views.flip == flip);
  return TruthSign{is_negated, true,
                   fmt::format("{} values are nearer, by {}", is_negated ? "smaller" : "larger",
                               views.evidence)};
}

}  // namespace

TruthSign find_truth_sign(const LightField::Samples& samples, const OcclusionOrder& side,
                          const Explanation& explanation) {
  if (side.is_decided()) {
    return {!side.larger_is_nearer(), true,
            fmt::format("{} values are nearer: they {}",
                        side.larger_is_nearer() ? "larger" : "smaller", hiding_text(side))};
  }
  const GridShape grid = grid_of(samples);
  if (!explanation.is_good() || explanation.is_transposed || grid.count() == 1) return {};
  if (auto sign = sign_by_views(samples, explanation)) return std::move(*sign);
  const bool runs_backwards =
      (grid.u == 1 || explanation.reversed_u) && (grid.v == 1 || explanation.reversed_v);
  return {runs_backwards, false, runs_backwards ? kByOrder : ""};
}

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
