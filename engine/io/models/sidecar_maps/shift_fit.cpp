// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/sidecar_maps/shift_fit.h"

#include "engine/io/models/order/grey_picture.h"
#include "engine/io/models/order/warp_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace episcope::io {
namespace {

constexpr std::size_t kFewestFitPoints = 200;
constexpr std::size_t kSearchPoints = 3000;  ///< Of which the search takes so many.
constexpr double kSearchStep = 0.5;          ///< px of the pictures that are searched,
constexpr int kSearchReach = 16;             ///< and steps to either side.
constexpr double kSidesPerReach = 12;        ///< The width, in units of the largest shift.
constexpr double kLargestShiftError = 40;    ///< Grey levels; what is hidden counts no more.
constexpr std::size_t kValueParts = 8;
constexpr double kKnown = 0.03;               ///< px: a part whose d is known so well is judged.
constexpr double kLargestDeviation = 0.05;    ///< px,
constexpr double kLargestShare = 0.01;        ///< and of the range of d.
constexpr double kBetterThanConstant = 0.85;  ///< When refined,
constexpr double kPromising = 0.97;           ///< and in the steps of the search.
constexpr double kBetterThanUnwarped = 0.8;

/// d = low + value · (high − low), of values from 0 to 1.
struct Ramp {
  double low = 0;
  double high = 0;
  [[nodiscard]] double at(double value) const { return low + value * (high - low); }
};

/// A view along one axis of the grid, and of the picture. `pixels`: how far disparity 1 moves a
/// pixel towards lower coordinates, with the sign of the direction of the axis.
struct Neighbour {
  Image<float> picture;
  bool is_along_x = true;
  double pixels = 1;
};

/// How pictures are taken: views so many steps away, reduced, rows and columns of views exchanged.
struct Looking {
  int steps = 1;
  int reduction = 1;
  bool is_exchanged = false;
};

Image<float> reduced_view(const LightField::Samples& samples, ViewIndex view, int reduction) {
  const Image<float> grey = grey_levels(samples, view);
  return smoothed(reduction > 1 ? reduced_by(grey, reduction) : grey);
}

std::vector<Neighbour> neighbours(const LightField::Samples& samples, ViewIndex at,
                                  const Looking& looking) {
  const GridShape grid = grid_of(samples);
  std::vector<Neighbour> found;
  for (const bool is_u : {true, false}) {
    for (const int step : {-looking.steps, looking.steps}) {
      const ViewIndex view{at.v + (is_u ? 0 : step), at.u + (is_u ? step : 0)};
      if (!grid.contains(view)) continue;
      found.push_back({reduced_view(samples, view, looking.reduction), is_u != looking.is_exchanged,
                       static_cast<double>(step)});
    }
  }
  return found;
}

struct Sampled {
  double value = 0;
  double slope = 0;  ///< Along the axis.
};

/// Cubic (Catmull-Rom) along one axis; the border is repeated.
Sampled sample(const Image<float>& picture, bool is_along_x, double place, int line) {
  const int last = (is_along_x ? picture.width() : picture.height()) - 1;
  const double clamped = std::clamp(place, 0.0, static_cast<double>(last));
  const int first = static_cast<int>(clamped);
  const double t = clamped - first;
  const auto tap = [&](int i) -> double {
    const int j = std::clamp(first + i, 0, last);
    return is_along_x ? picture.at(line, j) : picture.at(j, line);
  };
  const double a = tap(-1), b = tap(0), c = tap(1), d = tap(2);
  const double c1 = 0.5 * (c - a), c2 = a - 2.5 * b + 2 * c - 0.5 * d,
               c3 = 0.5 * (d - a) + 1.5 * (b - c);
  return {b + t * (c1 + t * (c2 + t * c3)), c1 + t * (2 * c2 + t * 3 * c3)};
}

/// The view, reduced, and the points in it.
struct Here {
  Image<float> picture;
  std::vector<ValuePoint> points;  ///< With values from 0 to 1.
};

Here here_of(const LightField::Samples& samples, ViewIndex at, std::vector<ValuePoint> points,
             int reduction) {
  Here here{reduced_view(samples, at, reduction), std::move(points)};
  for (ValuePoint& point : here.points) {
    point.y = std::min(point.y / reduction, here.picture.height() - 1);
    point.x = std::min(point.x / reduction, here.picture.width() - 1);
  }
  return here;
}

Sampled sample_moved(const Neighbour& to, const ValuePoint& point, double disparity) {
  const double place = (to.is_along_x ? point.x : point.y) - to.pixels * disparity;
  return sample(to.picture, to.is_along_x, place, to.is_along_x ? point.y : point.x);
}

/// Grey errors of every point for every shift of the search, along u and along v.
class ErrorTable {
 public:
  static constexpr int kShifts = 2 * kSearchReach + 1;

  ErrorTable(const Here& here, const std::vector<Neighbour>& others) : points_(here.points) {
    for (auto& axis : errors_) axis.assign(points_.size() * kShifts, 0);
    for (const Neighbour& other : others) {
      std::vector<float>& errors = errors_[other.is_along_x ? 0 : 1];
      for (std::size_t i = 0; i < points_.size(); ++i) {
        const float grey = here.picture.at(points_[i].y, points_[i].x);
        for (int s = 0; s < kShifts; ++s) {
          const double moved =
              sample_moved(other, points_[i], kSearchStep * (s - kSearchReach)).value;
          errors[i * kShifts + static_cast<std::size_t>(s)] +=
              static_cast<float>(std::min(kLargestShiftError, std::abs(grey - moved)));
        }
      }
    }
  }

  /// With the better direction of each axis; in steps of the search.
  [[nodiscard]] double error(const Ramp& ramp) const {
    return std::min(sum(0, ramp, 1), sum(0, ramp, -1)) +
           std::min(sum(1, ramp, 1), sum(1, ramp, -1));
  }
  [[nodiscard]] bool is_reversed(std::size_t axis, const Ramp& ramp) const {
    return sum(axis, ramp, -1) < sum(axis, ramp, 1);
  }

 private:
  [[nodiscard]] double sum(std::size_t axis, const Ramp& ramp, int sign) const {
    double total = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const int step = static_cast<int>(std::lround(sign * ramp.at(points_[i].value)));
      const int shift = std::clamp(step, -kSearchReach, kSearchReach) + kSearchReach;
      total += errors_[axis][i * kShifts + static_cast<std::size_t>(shift)];
    }
    return total;
  }

  const std::vector<ValuePoint>& points_;
  std::array<std::vector<float>, 2> errors_;
};

struct FoundShift {
  Ramp ramp;
  std::array<bool, 2> is_reversed{};  ///< Along x, along y.
  double share = 1;                   ///< Of the error that the best disparity for all leaves.
  Looking looking{};                  ///< At what it was found in.
};

/// The best ramp in whole steps.
FoundShift search(const Here& here, const std::vector<Neighbour>& others) {
  const ErrorTable table(here, others);
  double least = std::numeric_limits<double>::infinity();
  double constant = least;
  Ramp best;
  for (int low = -kSearchReach; low <= kSearchReach; ++low) {
    for (int high = low; high <= kSearchReach; ++high) {
      const Ramp ramp{static_cast<double>(low), static_cast<double>(high)};
      const double error = table.error(ramp);
      if (low == high) constant = std::min(constant, error);
      if (error >= least) continue;
      least = error;
      best = ramp;
    }
  }
  return {{kSearchStep * best.low, kSearchStep * best.high},
          {table.is_reversed(0, best), table.is_reversed(1, best)},
          constant > 0 ? least / constant : 1};
}

/// Residual of a point in a view, and how it changes with the disparity.
struct Residual {
  double value = 0;
  double change = 0;
  double weight = 0;
};

/// What is hidden, or does not fit, counts little: weights of Cauchy with this scale.
template <class Add>
void for_residuals(const Here& here, const std::vector<Neighbour>& others, const Ramp& ramp,
                   double scale, const Add& add) {
  for (const Neighbour& other : others) {
    const double last = (other.is_along_x ? other.picture.width() : other.picture.height()) - 1;
    for (const ValuePoint& point : here.points) {
      const double disparity = ramp.at(point.value);
      const double place = (other.is_along_x ? point.x : point.y) - other.pixels * disparity;
      if (!(place >= 0 && place <= last)) continue;
      const Sampled moved = sample_moved(other, point, disparity);
      Residual residual{moved.value - here.picture.at(point.y, point.x),
                        -other.pixels * moved.slope, 1};
      residual.weight = 1 / (1 + residual.value * residual.value / (scale * scale));
      add(point, residual);
    }
  }
}

double mean_error(const Here& here, const std::vector<Neighbour>& others, const Ramp& ramp) {
  double sum = 0, count = 0;
  for_residuals(here, others, ramp, 1, [&](const ValuePoint&, const Residual& residual) {
    sum += std::abs(residual.value);
    count += 1;
  });
  return count > 0 ? sum / count : std::numeric_limits<double>::infinity();
}

double scale_of(const Here& here, const std::vector<Neighbour>& others, const Ramp& ramp) {
  return std::max(0.5, mean_error(here, others, ramp));
}

void refine(const Here& here, const std::vector<Neighbour>& others, Ramp& ramp) {
  constexpr int kIterations = 12;
  for (int i = 0; i < kIterations; ++i) {
    double ll = 0, lh = 0, hh = 0, rl = 0, rh = 0;
    for_residuals(here, others, ramp, scale_of(here, others, ramp),
                  [&](const ValuePoint& point, const Residual& r) {
                    const double l = (1 - point.value) * r.change;
                    const double h = point.value * r.change;
                    ll += r.weight * l * l;
                    lh += r.weight * l * h;
                    hh += r.weight * h * h;
                    rl += r.weight * l * r.value;
                    rh += r.weight * h * r.value;
                  });
    const double determinant = ll * hh - lh * lh;
    if (!(determinant > 1e-9 * ll * hh)) return;
    const double low = (lh * rh - hh * rl) / determinant;
    const double high = (lh * rl - ll * rh) / determinant;
    ramp.low += std::clamp(low, -0.5, 0.5);
    ramp.high += std::clamp(high, -0.5, 0.5);
    if (std::abs(low) + std::abs(high) < 1e-5) return;
  }
}

/// Whether the ramp explains the points clearly better than any one disparity of its range.
bool beats_constants(const Here& here, const std::vector<Neighbour>& others, const Ramp& ramp) {
  constexpr int kTried = 16;
  const double limit = mean_error(here, others, ramp) / kBetterThanConstant;
  for (int i = 0; i <= kTried; ++i) {
    const double constant = ramp.at(static_cast<double>(i) / kTried);
    if (mean_error(here, others, {constant, constant}) <= limit) return false;
  }
  return true;
}

/// By how much parts of the values move otherwise than the ramp says, at most; infinite if less
/// than three are known and differ.
double largest_deviation(const Here& here, const std::vector<Neighbour>& others, const Ramp& ramp) {
  std::vector<double> values;
  for (const ValuePoint& point : here.points) values.push_back(point.value);
  std::ranges::sort(values);
  std::vector<double> bounds;
  for (std::size_t part = 1; part < kValueParts; ++part) {
    bounds.push_back(values[part * values.size() / kValueParts]);
  }
  bounds.erase(std::unique(bounds.begin(), bounds.end()), bounds.end());
  struct Sums {
    double square = 0;
    double product = 0;
  };
  std::vector<Sums> parts(bounds.size() + 1);
  const double scale = scale_of(here, others, ramp);
  for_residuals(here, others, ramp, scale, [&](const ValuePoint& point, const Residual& r) {
    const auto part = std::ranges::upper_bound(bounds, point.value) - bounds.begin();
    Sums& sums = parts[static_cast<std::size_t>(part)];
    sums.square += r.weight * r.change * r.change;
    sums.product += r.weight * r.change * r.value;
  });
  double largest = 0;
  int known = 0;
  for (const Sums& sums : parts) {
    if (!(sums.square > scale * scale / (kKnown * kKnown))) continue;
    largest = std::max(largest, std::abs(sums.product / sums.square));
    ++known;
  }
  return known < 3 ? std::numeric_limits<double>::infinity() : largest;
}

/// Values from 0 to 1 between these two.
struct Span {
  double low = 0;
  double high = 0;
};

Span bring_to_one(std::vector<ValuePoint>& points) {
  std::vector<double> values;
  for (const ValuePoint& point : points) values.push_back(point.value);
  std::ranges::sort(values);
  const Span span{values[values.size() / 50], values[values.size() - 1 - values.size() / 50]};
  for (ValuePoint& point : points) {
    point.value = (point.value - span.low) / (span.high - span.low);
  }
  return span;
}

std::vector<ValuePoint> some_of(const std::vector<ValuePoint>& points) {
  std::vector<ValuePoint> some;
  const std::size_t stride = 1 + points.size() / kSearchPoints;
  for (std::size_t i = 0; i < points.size(); i += stride) some.push_back(points[i]);
  return some;
}

void turn(std::vector<Neighbour>& others, const FoundShift& found) {
  for (Neighbour& other : others) {
    if (found.is_reversed[other.is_along_x ? 0 : 1]) other.pixels = -other.pixels;
  }
}

/// In pictures as they are, and reduced so far that larger shifts are found, too; refined. Nothing
/// if it is hardly better than one disparity for all.
std::optional<FoundShift> search_scales(const LightField::Samples& samples, ViewIndex at,
                                        const std::vector<ValuePoint>& points) {
  const int width = std::visit([](const auto& stack) { return stack.width(); }, samples);
  const double reach = kSearchStep * kSearchReach;
  const int largest = std::max(1, static_cast<int>(std::lround(width / kSidesPerReach / reach)));
  FoundShift best;
  for (int reduction = 1; reduction <= largest; reduction *= 2) {
    const Here here = here_of(samples, at, some_of(points), reduction);
    for (const bool is_exchanged : {false, true}) {
      const Looking looking{1, reduction, is_exchanged};
      FoundShift found = search(here, neighbours(samples, at, looking));
      if (found.share >= best.share) continue;
      found.looking = looking;
      best = found;
    }
  }
  if (!(best.share < kPromising)) return std::nullopt;
  const int reduction = best.looking.reduction;
  if (reduction > 1) {
    std::vector<Neighbour> others = neighbours(samples, at, best.looking);
    turn(others, best);
    refine(here_of(samples, at, points, reduction), others, best.ramp);
    best.ramp = {reduction * best.ramp.low, reduction * best.ramp.high};
  }
  return best;
}

}  // namespace

std::optional<ShiftFit> fit_shift(const LightField::Samples& samples, ViewIndex at,
                                  const std::vector<ValuePoint>& values) {
  if (values.size() < kFewestFitPoints) return std::nullopt;
  std::vector<ValuePoint> points = values;
  const Span span = bring_to_one(points);
  if (!(span.high > span.low)) return std::nullopt;
  auto found = search_scales(samples, at, points);
  if (!found) return std::nullopt;
  Ramp ramp = found->ramp;
  const Here here = here_of(samples, at, std::move(points), 1);
  std::vector<Neighbour> next = neighbours(samples, at, {1, 1, found->looking.is_exchanged});
  turn(next, *found);
  refine(here, next, ramp);
  const double error = mean_error(here, next, ramp);
  const double unwarped = mean_error(here, next, {0, 0});
  for (const int steps : {2, 4}) {
    std::vector<Neighbour> farther =
        neighbours(samples, at, {steps, 1, found->looking.is_exchanged});
    if (farther.size() < next.size()) break;
    turn(farther, *found);
    refine(here, farther, ramp);
  }
  const double deviation = largest_deviation(here, next, ramp);
  const Here some = here_of(samples, at, some_of(here.points), 1);
  if (!beats_constants(some, next, ramp)) return std::nullopt;
  const double tolerance = kLargestDeviation + kLargestShare * (ramp.high - ramp.low);
  const bool is_good = error < kBetterThanUnwarped * unwarped && deviation < tolerance;
  if (!is_good || !(ramp.high > ramp.low)) return std::nullopt;
  const double slope = (ramp.high - ramp.low) / (span.high - span.low);
  return ShiftFit{slope, ramp.low - slope * span.low, error, unwarped, deviation};
}

}  // namespace episcope::io
