// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/order/warp_check.h"

#include "engine/core/numbers.h"
#include "engine/io/models/order/motion_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace episcope::io {
namespace {

/// How much brighter one view is than another, by the median ratio of grey levels of their pixels,
/// whichever of them show the same.
class PairGain {
 public:
  /// Grey levels (0 … 255); dark ones do not count.
  void add(float here, float there);
  /// What `there` is to be multiplied by; 1 where that is so within 2 %, or not known. Reorders
  /// what was added.
  [[nodiscard]] float value();

 private:
  std::vector<float> ratios_;
};

constexpr float kDark = 4;
constexpr float kNearlyEven = 0.02F;
constexpr std::size_t kFewestRatios = 50;

void PairGain::add(float here, float there) {
  if (std::min(here, there) > kDark) ratios_.push_back(here / there);
}

float PairGain::value() {
  if (ratios_.size() < kFewestRatios) return 1;
  const float gain = quantile(ratios_, 0.5);
  return std::abs(gain - 1) > kNearlyEven ? gain : 1;
}

float sample(const Image<float>& image, double y, double x) {
  const int x0 = static_cast<int>(x);
  const int y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, image.width() - 1);
  const int y1 = std::min(y0 + 1, image.height() - 1);
  const auto fx = static_cast<float>(x - x0);
  const auto fy = static_cast<float>(y - y0);
  const float top = image.at(y0, x0) + fx * (image.at(y0, x1) - image.at(y0, x0));
  const float bottom = image.at(y1, x0) + fx * (image.at(y1, x1) - image.at(y1, x0));
  return top + fy * (bottom - top);
}

/// The value that counts as white: of 16-bit samples what as many bits hold as the view at the
/// center uses, since cameras give 10, 12 or 14 of them.
template <class T>
float white_of_views(const ViewStack<T>& stack) {
  if constexpr (std::is_same_v<T, float>) return 1;
  if constexpr (std::is_same_v<T, std::uint8_t>) return 255;
  constexpr std::size_t kStride = 7;
  const auto center = stack.view(stack.grid().center());
  std::size_t largest = 0;
  for (std::size_t i = 0; i < center.size(); i += kStride) {
    largest = std::max(largest, static_cast<std::size_t>(center.data[i]));
  }
  std::size_t white = 255;
  while (white < largest) white = 2 * white + 1;
  return static_cast<float>(white);
}

/// A view, and one next to it along an axis.
struct ViewPair {
  const Image<float>& center;
  const Image<float>& neighbour;
  bool is_u;
  int step;  ///< +1 or −1.
};

/// Grey levels at a pixel, and where it is by each assumption.
struct Moved {
  float here;
  float forward;
  float reversed;
  float unwarped;
};

/// Of every `stride`-th pixel whose targets lie inside the image.
template <class Visit>
void for_moved(const ViewPair& pair, const DisparityView& disparity, int stride,
               const Visit& visit) {
  const int width = pair.center.width();
  const int height = pair.center.height();
  for (int y = 0; y < height; y += stride) {
    for (int x = 0; x < width; x += stride) {
      if (!disparity.is_valid(y, x)) continue;
      const double shift = pair.step * static_cast<double>(disparity.disparity.at(y, x));
      const double place = pair.is_u ? x : y;
      const double last = (pair.is_u ? width : height) - 1;
      if (place - std::abs(shift) < 0 || place + std::abs(shift) > last) continue;
      const auto moved = [&](double by) {
        return pair.is_u ? sample(pair.neighbour, y, x - by) : sample(pair.neighbour, y - by, x);
      };
      visit(Moved{pair.center.at(y, x), moved(shift), moved(-shift), pair.neighbour.at(y, x)});
    }
  }
}

/// Adds the errors against the neighbor, of which brightness is evened out.
void add_neighbour(const ViewPair& pair, const DisparityView& disparity, AxisErrors& sums) {
  constexpr int kGainStride = 3;
  PairGain forward, reversed, unwarped;
  for_moved(pair, disparity, kGainStride, [&](const Moved& moved) {
    forward.add(moved.here, moved.forward);
    reversed.add(moved.here, moved.reversed);
    unwarped.add(moved.here, moved.unwarped);
  });
  const float of_forward = forward.value();
  const float of_reversed = reversed.value();
  const float of_unwarped = unwarped.value();
  for_moved(pair, disparity, 1, [&](const Moved& moved) {
    sums.forward += std::abs(moved.here - of_forward * moved.forward);
    sums.reversed += std::abs(moved.here - of_reversed * moved.reversed);
    sums.unwarped += std::abs(moved.here - of_unwarped * moved.unwarped);
    ++sums.pixels;
  });
}

AxisErrors axis_errors(const LightField::Samples& samples, ViewIndex at, bool is_u,
                       const DisparityView& disparity) {
  const GridShape grid = grid_of(samples);
  const Image<float> center = grey_levels(samples, at);
  AxisErrors errors;
  for (const int step : {-1, 1}) {
    const ViewIndex next = is_u ? ViewIndex{at.v, at.u + step} : ViewIndex{at.v + step, at.u};
    if (!grid.contains(next)) continue;
    const Image<float> neighbour = grey_levels(samples, next);
    add_neighbour({center, neighbour, is_u, step}, disparity, errors);
  }
  if (errors.pixels > 0) {
    errors.forward /= static_cast<double>(errors.pixels);
    errors.reversed /= static_cast<double>(errors.pixels);
    errors.unwarped /= static_cast<double>(errors.pixels);
  }
  return errors;
}

template <class T>
void add_channels(const T* samples, int width, int channels, float* sums) {
  for (int x = 0; x < width; ++x) {
    const T* const pixel = samples + static_cast<std::ptrdiff_t>(x) * channels;
    sums[x] = 0;
    for (int c = 0; c < channels; ++c) sums[x] += static_cast<float>(pixel[c]);
  }
}

/// Sums floats: a sample that is not finite counts as the last finite one before it.
void add_channels(const float* samples, int width, int channels, float* sums) {
  std::array<float, 4> last{};
  for (int x = 0; x < width; ++x) {
    sums[x] = 0;
    for (int c = 0; c < channels; ++c) {
      const float value = samples[static_cast<std::ptrdiff_t>(x) * channels + c];
      float& kept = last[static_cast<std::size_t>(c)];
      if (std::isfinite(value)) kept = value;
      sums[x] += kept;
    }
  }
}

}  // namespace

bool AxisErrors::is_decided() const {
  const double difference = std::abs(forward - reversed);
  return pixels > 0 && difference > 0.02 && difference > 0.03 * std::min(forward, reversed);
}

bool AxisErrors::is_poor() const {
  if (pixels == 0) return false;
  const double best = std::min(forward, reversed);
  const double other = std::max(forward, reversed);
  if (is_decided()) return best > 0.9 * std::min(other, unwarped);
  return best > 1.1 * unwarped + 0.5;
}

double WarpErrors::best() const {
  if (u.pixels + v.pixels == 0) return std::numeric_limits<double>::infinity();
  const double sum = std::min(u.forward, u.reversed) * static_cast<double>(u.pixels) +
                     std::min(v.forward, v.reversed) * static_cast<double>(v.pixels);
  return sum / static_cast<double>(u.pixels + v.pixels);
}

double WarpErrors::unwarped() const {
  const auto pixels = static_cast<double>(u.pixels + v.pixels);
  if (pixels == 0) return 0;
  return (u.unwarped * static_cast<double>(u.pixels) + v.unwarped * static_cast<double>(v.pixels)) /
         pixels;
}

Image<float> grey_levels(const LightField::Samples& samples, ViewIndex view) {
  const PixelRect all = std::visit(
      [](const auto& stack) {
        return PixelRect{0, 0, stack.height(), stack.width()};
      },
      samples);
  return grey_levels(samples, view, all);
}

Image<float> grey_levels(const LightField::Samples& samples, ViewIndex view,
                         const PixelRect& part) {
  return std::visit(
      [&]<class T>(const ViewStack<T>& stack) {
        const auto image = stack.view(view);
        const float scale = 255.0F / white_of_views(stack) / static_cast<float>(image.channels);
        Image<float> grey(part.y1 - part.y0, part.x1 - part.x0);
        for (int y = 0; y < grey.height(); ++y) {
          const T* const row = image.row(part.y0 + y) + part.x0 * image.channels;
          add_channels(row, grey.width(), image.channels, grey.row(y));
          for (int x = 0; x < grey.width(); ++x) grey.row(y)[x] *= scale;
        }
        return grey;
      },
      samples);
}

WarpErrors warp_errors(const LightField::Samples& samples, ViewIndex at,
                       const DisparityView& disparity) {
  return {axis_errors(samples, at, true, disparity), axis_errors(samples, at, false, disparity)};
}

std::vector<MapPoint> spread_points(const DisparityView& map) {
  constexpr double most = 10000;
  const ImageView<const float>& values = map.disparity;
  const double area = static_cast<double>(values.height) * values.width;
  const int stride = std::max(1, static_cast<int>(std::sqrt(area / most)));
  std::vector<MapPoint> points;
  for (int y = 0; y < values.height; y += stride) {
    for (int x = 0; x < values.width; x += stride) {
      if (map.is_valid(y, x)) points.push_back({y, x, values.at(y, x)});
    }
  }
  return points;
}

namespace {

constexpr int kConstantSquare = 16;
constexpr int kFewestConstantSquares = 8;
/// Standard deviations of chance. The constant is the best of many, which leaves less to it.
constexpr double kSignificantConstant = 2.7;
/// Where few squares decide, chance is hard to exclude; of wrong maps none leaves as little error.
constexpr double kFarBetterThanConstant = 0.5;
constexpr int kSteps = 24;              ///< Constants tried to either side of 0.
constexpr double kDiffers = 0.25;       ///< px between the map and the constant, or less in maps
constexpr double kPartOfRange = 0.125;  ///< of which that is more than this part of the range;
constexpr double kLeastRange = 0.05;    ///< maps of less px are constants.
constexpr float kLargestConstantError = 40;  ///< Grey levels; what is hidden counts no more.

/// The view and one next to it; `shift`: of disparity 1 in the neighbor, to lower coordinates.
struct WarpedPair {
  const Image<float>& here;
  Image<float> there;
  bool is_u;
  int shift;
  float gain = 1;

  /// Negative outside of the picture.
  [[nodiscard]] float moved(const MapPoint& point, double disparity) const {
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
  [[nodiscard]] float error(const MapPoint& point, double disparity) const {
    const float grey = moved(point, disparity);
    if (grey < 0) return -1;
    return std::min(kLargestConstantError, std::abs(here.at(point.y, point.x) - gain * grey));
  }
  void even_out(const std::vector<MapPoint>& points) {
    PairGain brightness;
    for (const MapPoint& point : points) {
      brightness.add(here.at(point.y, point.x), moved(point, point.disparity));
    }
    gain = brightness.value();
  }
};

/// Smoothed, or shifts between pixels would reduce noise, and so errors, more than others.
Image<float> picture_of(const LightField::Samples& samples, ViewIndex view) {
  return smoothed(grey_levels(samples, view));
}

std::vector<WarpedPair> pairs_of(const LightField::Samples& samples, ViewIndex at,
                                 const Image<float>& here, const WarpErrors& errors, bool is_u) {
  const bool is_reversed = (is_u ? errors.u : errors.v).says_reversed();
  std::vector<WarpedPair> pairs;
  for (const int step : {-1, 1}) {
    const ViewIndex next = is_u ? ViewIndex{at.v, at.u + step} : ViewIndex{at.v + step, at.u};
    if (!grid_of(samples).contains(next)) continue;
    pairs.push_back({here, picture_of(samples, next), is_u, is_reversed ? -step : step});
  }
  return pairs;
}

/// Of the pairs with the disparity of each point; infinite if it leads most out of the pictures.
template <class DisparityOf>
double mean_error(const std::vector<WarpedPair>& pairs, const std::vector<MapPoint>& points,
                  const DisparityOf& disparity_of) {
  double sum = 0, inside = 0;
  for (const WarpedPair& pair : pairs) {
    for (const MapPoint& point : points) {
      const float error = pair.error(point, disparity_of(point));
      if (error < 0) continue;
      sum += error;
      inside += 1;
    }
  }
  const bool is_told =
      inside > 0 && 2 * inside >= static_cast<double>(pairs.size() * points.size());
  return is_told ? sum / inside : HUGE_VAL;
}

double best_constant(const std::vector<WarpedPair>& pairs, const std::vector<MapPoint>& points) {
  double reach = 0;
  for (const MapPoint& point : points) reach = std::max(reach, std::abs(point.disparity));
  std::pair<double, double> least{HUGE_VAL, 0};
  for (int step = -kSteps; step <= kSteps; ++step) {
    const double constant = reach * step / kSteps;
    const double error = mean_error(pairs, points, [=](const MapPoint&) { return constant; });
    if (error < HUGE_VAL) least = std::min(least, {error, constant});
  }
  return least.second;
}

/// Of 90 % of the points.
double range_of(const std::vector<MapPoint>& points) {
  std::vector<float> values;
  for (const MapPoint& point : points) values.push_back(static_cast<float>(point.disparity));
  if (values.empty()) return 0;
  return quantile(values, 0.95) - quantile(values, 0.05);
}

/// Errors of two maps in a square.
struct Sum {
  double error = 0;
  double other_error = 0;
  int points = 0;
};
using Squares = std::map<std::pair<int, int>, Sum>;

template <class One, class Other>
void add_pair(const WarpedPair& pair, const std::vector<MapPoint>& points, const One& one,
              const Other& other, Squares& squares) {
  for (const MapPoint& point : points) {
    const float by_one = pair.error(point, one(point));
    const float by_other = pair.error(point, other(point));
    if (by_one < 0 || by_other < 0) continue;
    Sum& sum = squares[{point.y / kConstantSquare, point.x / kConstantSquare}];
    sum.error += by_one;
    sum.other_error += by_other;
    ++sum.points;
  }
}

ConstantComparison compared(const Squares& squares) {
  double sum = 0, square = 0, error = 0, other_error = 0;
  for (const auto& [place, one] : squares) {
    const double better = (one.other_error - one.error) / one.points;
    sum += better;
    square += better * better;
    error += one.error;
    other_error += one.other_error;
  }
  const auto count = static_cast<double>(squares.size());
  if (count < kFewestConstantSquares) return {static_cast<int>(count)};
  const double mean = sum / count;
  const double variance = std::max(square / count - mean * mean, 1e-9);
  return {static_cast<int>(count), mean / std::sqrt(variance / count),
          error / std::max(other_error, 1e-9)};
}

}  // namespace

bool ConstantComparison::is_told() const {
  return squares >= kFewestConstantSquares;
}

bool ConstantComparison::is_better() const {
  return is_told() && (score > kSignificantConstant || left < kFarBetterThanConstant);
}

ConstantComparison compare_with_constant(const LightField::Samples& samples, ViewIndex at,
                                         const DisparityView& disparity, const WarpErrors& errors) {
  const std::vector<MapPoint> points = spread_points(disparity);
  const double range = range_of(points);
  if (range < kLeastRange) return {};
  const double differs = std::min(kDiffers, kPartOfRange * range);
  const Image<float> here = picture_of(samples, at);
  Squares squares;
  for (const bool is_u : {true, false}) {
    std::vector<WarpedPair> pairs = pairs_of(samples, at, here, errors, is_u);
    for (WarpedPair& pair : pairs) pair.even_out(points);
    const double constant = best_constant(pairs, points);
    std::vector<MapPoint> apart;
    std::ranges::copy_if(points, std::back_inserter(apart), [=](const MapPoint& point) {
      return std::abs(point.disparity - constant) >= differs;
    });
    for (const WarpedPair& pair : pairs) {
      add_pair(
          pair, apart, [](const MapPoint& point) { return point.disparity; },
          [=](const MapPoint&) { return constant; }, squares);
    }
  }
  return compared(squares);
}

namespace {

/// Factors that are tried: up to 64 times as much or as little, and what differs more than
/// slightly.
constexpr int kFactorSteps = 48;
constexpr double kFactorsPerOctave = 8;
constexpr double kOtherFactor = 0.2;
/// Largest share of the error that another meaning may leave, and standard deviations of chance.
constexpr double kClearFactor = 0.85;
constexpr double kClearOffset = 0.8;
constexpr double kSignificantUnit = 4;
/// A map that explains views this well lacks no offset.
constexpr double kNoOffset = 0.5;
/// With an offset: the range of the map, px, from 1/8 to 32 in thirds of octaves, and its median.
constexpr int kFirstThird = -9, kLastThird = 15;
constexpr double kMedianStep = 0.25, kLargestMedian = 8;
constexpr std::size_t kCoarsePoints = 600;
constexpr int kRefinements = 4;

/// Numbers of a map times `factor`, plus `offset`.
struct Meaning {
  double factor = 1;
  double offset = 0;
  [[nodiscard]] double operator()(const MapPoint& point) const {
    return factor * point.disparity + offset;
  }
  [[nodiscard]] Meaning negated() const { return {-factor, -offset}; }
};

using Points = std::vector<MapPoint>;

/// The neighbors of a view along both axes, each in the order that suits a meaning better.
class Neighbors {
 public:
  Neighbors(const LightField::Samples& samples, ViewIndex at) : here_(picture_of(samples, at)) {
    for (const bool is_u : {true, false}) {
      auto pairs = pairs_of(samples, at, here_, {}, is_u);
      if (!pairs.empty()) axes_.push_back(std::move(pairs));
    }
  }

  [[nodiscard]] double error(const Points& points, const Meaning& meaning) const {
    double sum = 0;
    for (const auto& pairs : axes_) {
      sum += std::min(mean_error(pairs, points, meaning),
                      mean_error(pairs, points, meaning.negated()));
    }
    return axes_.empty() ? HUGE_VAL : sum / static_cast<double>(axes_.size());
  }

  /// Whether one meaning is better than another by more than chance.
  [[nodiscard]] bool is_better(const Points& points, const Meaning& one,
                               const Meaning& other) const {
    Squares squares;
    for (const auto& pairs : axes_) {
      const auto ordered = [&](const Meaning& meaning) {
        const Meaning reversed = meaning.negated();
        return mean_error(pairs, points, meaning) <= mean_error(pairs, points, reversed) ? meaning
                                                                                         : reversed;
      };
      for (const WarpedPair& pair : pairs) {
        add_pair(pair, points, ordered(one), ordered(other), squares);
      }
    }
    const ConstantComparison comparison = compared(squares);
    return comparison.is_told() && comparison.score > kSignificantUnit;
  }

 private:
  Image<float> here_;
  std::vector<std::vector<WarpedPair>> axes_;
};

struct Candidate {
  Meaning meaning;
  double error = HUGE_VAL;
  void take(const Neighbors& neighbors, const Points& points, const Meaning& other) {
    const double its = neighbors.error(points, other);
    if (its < error) *this = {other, its};
  }
};

Candidate best_factor(const Neighbors& neighbors, const Points& points, double factor) {
  Candidate best;
  for (int step = -kFactorSteps; step <= kFactorSteps; ++step) {
    best.take(neighbors, points, {factor * std::exp2(step / kFactorsPerOctave)});
  }
  double ratio = std::exp2(0.5 / kFactorsPerOctave);
  for (int i = 0; i < kRefinements; ++i, ratio = std::sqrt(ratio)) {
    const double middle = best.meaning.factor;
    for (const double by : {1 / ratio, ratio}) best.take(neighbors, points, {by * middle});
  }
  return best;
}

/// Precondition: the range of the map is not 0.
Candidate best_with_offset(const Neighbors& neighbors, const Points& points) {
  std::vector<float> values;
  for (const MapPoint& point : points) values.push_back(static_cast<float>(point.disparity));
  const double middle = quantile(values, 0.5);
  const double range = range_of(points);
  Points few;
  const std::size_t stride = points.size() / kCoarsePoints + 1;
  for (std::size_t i = 0; i < points.size(); i += stride) few.push_back(points[i]);
  const auto meaning = [&](double factor, double median) {
    return Meaning{factor, median - factor * middle};
  };
  Candidate best;
  for (int third = kFirstThird; third <= kLastThird; ++third) {
    const double factor = std::exp2(third / 3.0) / range;
    for (double at = -kLargestMedian; at <= kLargestMedian; at += kMedianStep) {
      best.take(neighbors, few, meaning(factor, at));
    }
  }
  best.error = neighbors.error(points, best.meaning);
  double ratio = std::exp2(1 / 6.0), step = kMedianStep / 2;
  for (int i = 0; i < kRefinements; ++i, ratio = std::sqrt(ratio), step /= 2) {
    const double factor = best.meaning.factor;
    const double median = factor * middle + best.meaning.offset;
    for (const double by : {1 / ratio, 1.0, ratio}) {
      for (const double more : {-step, 0.0, step}) {
        best.take(neighbors, points, meaning(by * factor, median + more));
      }
    }
  }
  return best;
}

}  // namespace

std::optional<BetterUnit> find_better_unit(const LightField::Samples& samples, ViewIndex at,
                                           const DisparityView& map, double factor) {
  const Neighbors neighbors(samples, at);
  const Points points = spread_points(map);
  Candidate taken{{factor}, neighbors.error(points, {factor})};
  const double as_taken = std::min<double>(taken.error, kLargestConstantError);
  const double unwarped = neighbors.error(points, {0});
  taken.take(neighbors, points, {0});
  const Candidate scaled = best_factor(neighbors, points, factor);
  const auto found = [&](const Candidate& better) {
    return BetterUnit{better.meaning.factor, better.meaning.offset, better.error, as_taken};
  };
  const bool is_other = std::abs(std::log2(scaled.meaning.factor / factor)) > kOtherFactor;
  if (is_other && scaled.error < kClearFactor * taken.error &&
      neighbors.is_better(points, scaled.meaning, taken.meaning)) {
    return found(scaled);
  }
  if (as_taken <= kNoOffset * unwarped || !(range_of(points) > 0)) return {};
  if (scaled.error < taken.error) taken = scaled;
  const Candidate moved = best_with_offset(neighbors, points);
  const bool is_clear = moved.error < kClearOffset * taken.error &&
                        neighbors.is_better(points, moved.meaning, taken.meaning);
  return is_clear ? std::optional(found(moved)) : std::nullopt;
}

}  // namespace episcope::io
