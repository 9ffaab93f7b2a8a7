// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/better_reading.h"

#include "engine/core/numbers.h"
#include "engine/io/models/order/warp_check.h"
#include "engine/io/models/sidecar_maps/disparity_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <vector>

namespace episcope::io {
namespace {

/// Shares of the error as read, and of the error of a map that says nothing, below which another
/// reading explains a map far better.
constexpr double kFarBetterByTruth = 0.5;
constexpr double kFarBetterByViews = 0.6;
/// Share of the error of a map that says nothing above which a map explains little, and the error
/// that is small in any scene.
constexpr double kPoor = 0.5;
constexpr double kSmallError_px = 0.1;
/// A reading that changes more must beat one that changes less by this.
constexpr double kClearlyBetter = 0.9;
/// Of the pixels that could be compared, those that must be.
constexpr double kLeastCompared = 0.5;
/// How much better the views must fit the map as it is to speak against another reading.
constexpr double kContradicts = 1.1;

/// A value that stands for no estimate: share of the pixels that have it, how far it lies beyond
/// all others, in their spread, and how much farther from the truth than they are.
constexpr double kLeastMissing = 0.001;
constexpr double kFarBeyond = 0.5;
constexpr double kFarFromTruth = 4;
constexpr float kUsualMissing[] = {0, -1};
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr int kRowStride = 4;     ///< Of the rows that are warped.
constexpr int kFarthestOff = 16;  ///< Pixels that maps are looked for off their place.

/// Integers that stand for fractions of a pixel: decimal, and fixed-point numbers of matchers. And
/// maps of half or twice the resolution that were resized with their values as they were.
constexpr double kMapScales[] = {0.1,       0.01,        0.001, 1.0 / 16, 1.0 / 64, 1.0 / 255,
                                 1.0 / 256, 1.0 / 65535, 10,    100,      2,        0.5};
/// Depth in m, mm or cm where the camera has another of these units.
constexpr double kDepthScales[] = {1, 0.001, 1000, 0.01, 100};

std::vector<MapReading> turned_readings(bool is_square) {
  std::vector<MapReading> readings;
  for (const bool is_transposed : {false, true}) {
    if (is_transposed && !is_square) continue;
    for (const MapFlip flip : {MapFlip::None, MapFlip::Y, MapFlip::X, MapFlip::Both}) {
      readings.push_back({.is_transposed = is_transposed, .flip = flip});
    }
  }
  return readings;
}

/// Meanings of the values of a map, the one as read first.
std::vector<MapReading> valued_readings(const LightField& light_field) {
  std::vector<double> factors{1};
  for (const MapUnit& unit : common_units(light_field.grid(), light_field.width())) {
    if (unit.factor != 1) factors.insert(factors.end(), {unit.factor, 1 / unit.factor});
  }
  const int fewer_steps = std::min(light_field.grid().v, light_field.grid().u) - 1;
  if (fewer_steps > 1) factors.push_back(1.0 / fewer_steps);
  factors.insert(factors.end(), std::begin(kMapScales), std::end(kMapScales));
  std::vector<MapReading> readings;
  for (const double sign : {1.0, -1.0}) {
    for (const double factor : factors) readings.push_back({.scale = sign * factor});
  }
  if (!light_field.info().camera.is_known()) return readings;
  for (const double factor : kDepthScales) {
    readings.push_back({.scale = factor, .values = MapValues::Depth});
  }
  return readings;
}

MapReading joined_reading(MapReading turned, const MapReading& valued) {
  turned.scale = valued.scale;
  turned.values = valued.values;
  return turned;
}

/// Pixels that a map in the upper left corner lacks at each side of the view: half of the rows
/// below, and of as many columns on the right, that have no value or one value only. 0 if there are
/// no such rows and columns.
int corner_border(const DisparityView& map) {
  const int height = map.disparity.height, width = map.disparity.width;
  const auto is_bare = [&](int y, int x) {
    return !map.is_valid(y, x) || map.disparity.at(y, x) == map.disparity.at(height - 1, width - 1);
  };
  const int widest = std::min(height, width) / 4;
  int rows = 0, columns = 0;
  const auto is_bare_row = [&](int y) {
    int x = 0;
    while (x < width && is_bare(y, x)) ++x;
    return x == width;
  };
  const auto is_bare_column = [&](int x) {
    int y = 0;
    while (y < height && is_bare(y, x)) ++y;
    return y == height;
  };
  while (rows <= widest && is_bare_row(height - 1 - rows)) ++rows;
  while (columns <= widest && is_bare_column(width - 1 - columns)) ++columns;
  return rows == columns && rows % 2 == 0 && rows <= widest ? rows / 2 : 0;
}

/// What may be meant, the readings that change least first; the map as read is not among them.
std::vector<MapReading> possible_readings(const DisparityView& map, const LightField& light_field,
                                          bool has_truth) {
  const bool is_square = light_field.height() == light_field.width();
  const std::vector<MapReading> turned = turned_readings(is_square);
  const std::vector<MapReading> valued = valued_readings(light_field);
  std::vector<MapReading> readings(turned.begin() + 1, turned.end());
  readings.insert(readings.end(), valued.begin() + 1, valued.end());
  if (const int border = corner_border(map)) readings.push_back({.border_px = border});
  for (std::size_t i = 1; i < turned.size(); ++i) {
    for (std::size_t k = 1; k < valued.size(); ++k) {
      const bool is_tried = has_truth || valued[k] == MapReading{.scale = -1};
      if (is_tried) readings.push_back(joined_reading(turned[i], valued[k]));
    }
  }
  return readings;
}

/// The truth at some pixels.
class TruthPoints {
 public:
  explicit TruthPoints(const DisparityView& truth) : points_(spread_points(truth)) {
    if (points_.empty()) return;
    std::vector<double> all;
    for (const MapPoint& point : points_) all.push_back(point.disparity);
    const double middle = quantile(all, 0.5);
    for (const MapPoint& point : points_) constant_error_ += std::abs(point.disparity - middle);
    constant_error_ /= static_cast<double>(points_.size());
  }

  /// Mean absolute error of the map of one value that fits best.
  [[nodiscard]] double constant_error() const { return constant_error_; }

  /// Mean absolute error by a reading, from which `bias` is taken first; infinite if the map has
  /// values at few of the pixels, or the error is `most` or more.
  [[nodiscard]] double error(const DisparityView& map, const MapReading& reading,
                             const MapTarget& target, double most = kInfinite,
                             double bias = 0) const {
    const auto all = static_cast<double>(points_.size());
    double sum = 0, count = 0;
    for (const MapPoint& point : points_) {
      const float value = value_by(map, reading, target, point.y, point.x);
      if (!std::isfinite(value)) continue;
      sum += std::abs(value - point.disparity - bias);
      if (sum >= most * all) return kInfinite;
      count += 1;
    }
    const bool is_told = count > 0 && count >= kLeastCompared * all && sum < most * count;
    return is_told ? sum / count : kInfinite;
  }

  /// The same of the map as it is, but for one value by which all of it is off.
  [[nodiscard]] double unbiased_error(const DisparityView& map, const MapTarget& target) const {
    std::vector<double> all;
    for (const MapPoint& point : points_) {
      const float value = value_by(map, {}, target, point.y, point.x);
      if (std::isfinite(value)) all.push_back(value - point.disparity);
    }
    return all.empty() ? kInfinite : error(map, {}, target, kInfinite, quantile(all, 0.5));
  }

 private:
  std::vector<MapPoint> points_;
  double constant_error_ = 0;
};

/// The next views of a view, warped by maps in the stored order of views.
class WarpedViews {
 public:
  WarpedViews(const MapEvidence& evidence, const MapTarget& target)
      : evidence_(evidence), target_(target) {
    DisparityField still{ViewStack<float>({1, 1}, target.height, target.width),
                         ViewStack<std::uint8_t>({1, 1}, target.height, target.width)};
    std::fill_n(still.disparity.data(), still.disparity.size(), 0.0F);
    std::fill_n(still.valid.data(), still.valid.size(), std::uint8_t{1});
    pixels_ = errors_of(still).pixels;
  }

  struct Errors {
    double warped = 0;  ///< Mean, in grey levels,
    double unwarped = 0;
    double pixels = 0;

    [[nodiscard]] double share() const { return unwarped > 0 ? warped / unwarped : 1; }
  };

  /// None if the map moves most pixels out of the views.
  [[nodiscard]] std::optional<Errors> errors(const DisparityView& map,
                                             const MapReading& reading) const {
    DisparityField read{ViewStack<float>({1, 1}, target_.height, target_.width),
                        ViewStack<std::uint8_t>({1, 1}, target_.height, target_.width)};
    for (int y = 0; y < target_.height; ++y) {
      for (int x = 0; x < target_.width; ++x) {
        const float value = value_by(map, reading, target_, y, x);
        read.valid.view({}).at(y, x) = std::isfinite(value) ? 1 : 0;
        read.disparity.view({}).at(y, x) = std::isfinite(value) ? value : 0;
      }
    }
    const Errors errors = errors_of(read);
    if (errors.pixels == 0 || errors.pixels < kLeastCompared * pixels_) return std::nullopt;
    return errors;
  }

 private:
  [[nodiscard]] Errors errors_of(DisparityField& map) const {
    for (int y = 0; y < target_.height; ++y) {
      if (y % kRowStride != 0)
        std::fill_n(map.valid.view({}).row(y), target_.width, std::uint8_t{0});
    }
    const WarpErrors found =
        warp_errors(evidence_.light_field.samples(), evidence_.view, map.view({}));
    const auto u = static_cast<double>(found.u.pixels), v = static_cast<double>(found.v.pixels);
    if (u + v == 0) return {};
    return {(found.u.forward * u + found.v.forward * v) / (u + v),
            (found.u.unwarped * u + found.v.unwarped * v) / (u + v), u + v};
  }

  const MapEvidence& evidence_;
  const MapTarget& target_;
  double pixels_ = 0;  ///< Of a map that moves nothing.
};

/// The reading of the least error by `error_of`, if it is below `limit`.
template <class ErrorOf>
std::optional<MapReading> least_reading(const std::vector<MapReading>& readings, double limit,
                                        ErrorOf error_of) {
  double least = limit / kClearlyBetter;
  std::optional<MapReading> best;
  for (const MapReading& reading : readings) {
    const double error = error_of(reading);
    if (!(error < kClearlyBetter * least)) continue;
    least = error;
    best = reading;
  }
  return best;
}

/// The move of maps that are off their place which has the least error, if it is below `most`.
std::optional<MapReading> best_move(const DisparityView& map, const TruthPoints& truth,
                                    const MapTarget& target, double most) {
  std::optional<MapReading> best;
  for (int down = -kFarthestOff; down <= kFarthestOff; ++down) {
    for (int right = -kFarthestOff; right <= kFarthestOff; ++right) {
      if (down == 0 && right == 0) continue;
      const MapReading moved{.down_px = down, .right_px = right};
      const double error = truth.error(map, moved, target, most);
      if (!(error < most)) continue;
      most = error;
      best = moved;
    }
  }
  return best;
}

std::optional<MapReading> found_by_truth(const DisparityView& map, const MapEvidence& evidence,
                                         const MapTarget& target) {
  const TruthPoints truth(evidence.truth);
  const auto error_of = [&](const MapReading& reading) {
    return truth.error(map, reading, target);
  };
  const double limit = kFarBetterByTruth * std::min(error_of({}), truth.constant_error());
  std::vector<MapReading> readings = possible_readings(map, evidence.light_field, true);
  // On slanted surfaces, a map that is off by one value resembles one that is off its place.
  const double most_moved = kFarBetterByTruth * truth.unbiased_error(map, target);
  if (const auto moved = best_move(map, truth, target, std::min(limit, most_moved))) {
    readings.push_back(*moved);
  }
  return least_reading(readings, limit, error_of);
}

std::optional<MapReading> found_by_views(const DisparityView& map, const MapEvidence& evidence,
                                         const MapTarget& target) {
  const WarpedViews views(evidence, target);
  const auto share_of = [&](const MapReading& reading) {
    const auto errors = views.errors(map, reading);
    return errors ? errors->share() : 1.0;
  };
  const double limit = kFarBetterByViews * std::min(share_of({}), 1.0);
  return least_reading(possible_readings(map, evidence.light_field, false), limit, share_of);
}

std::optional<double> mse_100(const DisparityView& map, const MapReading& reading,
                              const DisparityView& truth, const MapTarget& target) {
  double sum = 0;
  std::size_t count = 0;
  for (int y = 0; y < truth.disparity.height; ++y) {
    for (int x = 0; x < truth.disparity.width; ++x) {
      if (!truth.is_valid(y, x)) continue;
      const double error = value_by(map, reading, target, y, x) - truth.disparity.at(y, x);
      if (!std::isfinite(error)) continue;
      sum += error * error;
      ++count;
    }
  }
  if (count == 0) return std::nullopt;
  return 100 * sum / static_cast<double>(count);
}

/// Values that many pixels have exactly: the usual ones for no estimate, and the least and the
/// largest if it lies far beyond all others.
std::vector<float> possible_missing(const DisparityView& map) {
  std::vector<float> all;
  for (int y = 0; y < map.disparity.height; ++y) {
    for (int x = 0; x < map.disparity.width; ++x) {
      if (map.is_valid(y, x)) all.push_back(map.disparity.at(y, x));
    }
  }
  std::ranges::sort(all);
  const auto enough =
      static_cast<std::ptrdiff_t>(std::max(4.0, kLeastMissing * static_cast<double>(all.size())));
  std::vector<float> values;
  const auto add = [&](float value) {
    const auto [begin, end] = std::equal_range(all.begin(), all.end(), value);
    if (end - begin >= enough && std::ranges::count(values, value) == 0) {
      values.push_back(value);
    }
  };
  if (all.empty()) return {};
  const auto second = std::ranges::upper_bound(all, all.front());
  const auto last = std::ranges::lower_bound(all, all.back());
  if (second == all.end()) return {};
  const float spread = last > second ? *(last - 1) - *second : 0;
  const auto is_far = [spread](float gap) { return gap > kFarBeyond * spread; };
  if (is_far(*second - all.front())) add(all.front());
  if (is_far(all.back() - *(last - 1))) add(all.back());
  for (const float value : kUsualMissing) add(value);
  return values;
}

/// A map of which the pixels of one value are set apart.
struct SplitMap {
  DisparityField rest;
  DisparityField missing;

  SplitMap(const DisparityView& map, float value)
      : rest(DisparityField::unknown({1, 1}, map.disparity.height, map.disparity.width, {})),
        missing(DisparityField::unknown({1, 1}, map.disparity.height, map.disparity.width, {})) {
    for (int y = 0; y < map.disparity.height; ++y) {
      for (int x = 0; x < map.disparity.width; ++x) {
        if (!map.is_valid(y, x)) continue;
        DisparityField& part = map.disparity.at(y, x) == value ? missing : rest;
        part.disparity.view({}).at(y, x) = map.disparity.at(y, x);
        part.valid.view({}).at(y, x) = 1;
      }
    }
  }
};

/// A reading by which the pixels of one value stand for no estimate, and its errors without them.
std::optional<BetterReading> found_with_missing(const DisparityView& map,
                                                const MapEvidence& evidence,
                                                const MapTarget& target, double most_mse_100) {
  std::optional<BetterReading> best;
  for (const float value : possible_missing(map)) {
    const SplitMap parts(map, value);
    const DisparityView rest = parts.rest.view({});
    MapReading reading = found_by_truth(rest, evidence, target).value_or(MapReading{});
    const TruthPoints points(evidence.truth);
    const double error = points.error(rest, reading, target);
    if (!(error < kFarBetterByTruth * points.constant_error())) continue;
    const auto apart = mse_100(parts.missing.view({}), reading, evidence.truth, target);
    const double least = std::max(kSmallError_px, kFarFromTruth * error);
    if (!apart || *apart < 100 * least * least) continue;
    const auto mse = mse_100(rest, reading, evidence.truth, target);
    if (!mse || *mse > kFarBetterByTruth * most_mse_100) continue;
    most_mse_100 = *mse;
    const auto warped = WarpedViews(evidence, target).errors(rest, reading);
    reading.missing = fmt::format("{:.9g}", value);
    best = BetterReading{reading, {}, {mse, warped ? std::optional(warped->warped) : std::nullopt}};
  }
  return best;
}

}  // namespace

bool BetterReading::is_contradicted() const {
  return as_read.grey_levels &&
         (!better.grey_levels || *better.grey_levels > kContradicts * *as_read.grey_levels);
}

std::optional<BetterReading> find_better_reading(const DisparityView& map,
                                                 const MapEvidence& evidence) {
  const LightField& light_field = evidence.light_field;
  const MapTarget target{light_field.height(), light_field.width(), light_field.info().camera};
  const bool has_truth = !evidence.truth.disparity.empty();
  const auto found =
      has_truth ? found_by_truth(map, evidence, target) : found_by_views(map, evidence, target);
  const auto errors_of = [&](const MapReading& reading) {
    MapErrors errors;
    if (has_truth) errors.mse_100 = mse_100(map, reading, evidence.truth, target);
    const auto warped = WarpedViews(evidence, target).errors(map, reading);
    if (warped) errors.grey_levels = warped->warped;
    return errors;
  };
  std::optional<BetterReading> better;
  if (found) better = BetterReading{*found, {}, errors_of(*found)};
  if (has_truth) {
    const MapReading reading = found.value_or(MapReading{});
    const auto known = mse_100(map, reading, evidence.truth, target);
    if (auto more = found_with_missing(map, evidence, target, known.value_or(0))) better = more;
  }
  if (better) better->as_read = errors_of({});
  return better;
}

std::optional<PoorFit> find_poor_fit(const DisparityView& map, const DisparityView& truth) {
  const MapTarget target{truth.disparity.height, truth.disparity.width};
  const TruthPoints points(truth);
  const double error = points.error(map, {}, target);
  const double limit = std::max(kSmallError_px, kPoor * points.constant_error());
  if (!std::isfinite(error) || error <= limit) return std::nullopt;
  double sum = 0, squares = 0, errors = 0, count = 0;
  for (int y = 0; y < target.height; ++y) {
    for (int x = 0; x < target.width; ++x) {
      if (!truth.is_valid(y, x) || !map.is_valid(y, x)) continue;
      const double known = truth.disparity.at(y, x);
      const double difference = map.disparity.at(y, x) - known;
      if (!std::isfinite(difference)) continue;
      sum += known;
      squares += known * known;
      errors += difference * difference;
      ++count;
    }
  }
  const PoorFit fit{100 * errors / count, 100 * (squares - sum * sum / count) / count};
  return fit.mse_100 > kPoor * fit.constant_mse_100 ? std::optional(fit) : std::nullopt;
}

}  // namespace episcope::io
