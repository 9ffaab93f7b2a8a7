// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/sidecar_maps/disparity_units.h"

#include "engine/core/finding.h"
#include "engine/core/numbers.h"
#include "engine/io/models/order/motion_pictures.h"
#include "engine/io/models/order/warp_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace episcope::io {

namespace {

/// A map that explains views this well needs no comparison with other units.
constexpr double kPlainUnit = 0.5;
/// Another unit must leave at most this share of the error, and this one of that without warping:
/// values that lack a constant are off by more than any unit, and small ones explain a little.
constexpr double kClearlyBetterUnit = 0.85;
constexpr double kOtherUnit = 0.7;

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
  if (errors.u.pixels + errors.v.pixels == 0) return found;
  found.error = errors.best();
  found.unwarped = errors.unwarped();
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
  units.push_back({1.0 / 100, "hundredths of a px per view step"});
  units.push_back({1.0 / 256, "px per view step, in fixed point of 1/256"});
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
  // Shifts out of the picture leave nothing to compare.
  const bool is_compared = first.unwarped > 0;
  if (is_compared && first.error <= kPlainUnit * first.unwarped) return best;
  double least =
      is_compared ? kClearlyBetterUnit * first.error : std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < units.size(); ++i) {
    const Explanation other = explain_views(samples, at, map, units[i].factor);
    if (other.error >= std::min(kOtherUnit * other.unwarped, least)) continue;
    least = other.error;
    best = {units[i], other, first};
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
  return fmt::format(finding_text("sign.hiding"), std::min(side.larger, side.smaller),
                     std::max(side.larger, side.smaller), side.points);
}

namespace {

std::optional<TruthSign> sign_by_views(const LightField::Samples& samples,
                                       const Explanation& explanation) {
  const ViewFlip flip{explanation.reversed_u, explanation.reversed_v};
  const SignFinding views = check_sign(samples, flip, true, Progress(1));
  if (!views.is_decided) return std::nullopt;
  const bool is_negated = !(views.flip == flip);
  return TruthSign{is_negated, true,
                   fmt::format(fmt::runtime(is_negated ? finding_text("sign.smaller")
                                                       : finding_text("sign.larger")),
                               views.evidence)};
}

}  // namespace

TruthSign find_truth_sign(const LightField::Samples& samples, const OcclusionOrder& side,
                          const Explanation& explanation) {
  if (side.is_decided()) {
    return {!side.larger_is_nearer(), true,
            fmt::format(fmt::runtime(side.larger_is_nearer() ? finding_text("sign.larger_hide")
                                                             : finding_text("sign.smaller_hide")),
                        hiding_text(side))};
  }
  const GridShape grid = grid_of(samples);
  if (!explanation.is_good() || explanation.is_transposed || grid.count() == 1) return {};
  if (auto sign = sign_by_views(samples, explanation)) return std::move(*sign);
  const bool runs_backwards =
      (grid.u == 1 || explanation.reversed_u) && (grid.v == 1 || explanation.reversed_v);
  return {runs_backwards, false, runs_backwards ? std::string(finding_text("sign.by_order")) : ""};
}

namespace {

constexpr std::ptrdiff_t kFewestUnknown = 30;
constexpr double kMostShare = 0.99;
/// Above this multiple of the error of the other pixels, an error is not that of noise.
constexpr double kAboveNoise = 1.3;
/// The next known values must leave at most this share of the error of the value,
constexpr double kClearlyBetterNext = 0.75;
constexpr double kSignificantNext =
    2.5;                        ///< by so many standard deviations of chance, over squares
constexpr int kNextSquare = 8;  ///< of so many px;
/// or this one if the error of the value is so many times the error of the others: around edges the
/// next value is often the one of the wrong side.
constexpr double kHardlyWorseNext = 1.2;
constexpr double kContradicted = 2.5;
/// In both cases they must leave this share of the error of a value as far to the other side.
constexpr double kBetterThanBeyond = 0.9;
constexpr double kFewestDiffering = 0.1;  ///< px between the two: else neither is judged.
constexpr float kLargestNextError = 40;   ///< Grey levels; what is hidden counts no more.

void mark(DisparityField& field, float value) {
  field.require_mask();
  for (std::size_t i = 0; i < field.disparity.size(); ++i) {
    if (field.disparity.data()[i] == value) field.valid.data()[i] = 0;
  }
}

std::ptrdiff_t count_of(const DisparityView& map, float value) {
  std::ptrdiff_t count = 0;
  for (int y = 0; y < map.disparity.height; ++y) {
    for (int x = 0; x < map.disparity.width; ++x) {
      count += map.is_valid(y, x) && map.disparity.at(y, x) == value ? 1 : 0;
    }
  }
  return count;
}

/// 1 where the map is valid and has another value, `[y][x]`.
Image<std::uint8_t> valid_without(const DisparityView& map, float value) {
  Image<std::uint8_t> valid(map.disparity.height, map.disparity.width);
  for (int y = 0; y < valid.height(); ++y) {
    for (int x = 0; x < valid.width(); ++x) {
      valid.at(y, x) = map.is_valid(y, x) && map.disparity.at(y, x) != value ? 1 : 0;
    }
  }
  return valid;
}

/// Whole numbers by which programs mark unknown pixels: 0, −1, and the largest and the smallest
/// value (65535, 1e10, −999). Only values that many pixels have exactly.
std::vector<float> possible_unknown_values(const DisparityView& map) {
  std::vector<float> values{0, -1};
  std::optional<float> smallest, largest;
  for (int y = 0; y < map.disparity.height; ++y) {
    for (int x = 0; x < map.disparity.width; ++x) {
      if (!map.is_valid(y, x)) continue;
      const float value = map.disparity.at(y, x);
      smallest = std::min(smallest.value_or(value), value);
      largest = std::max(largest.value_or(value), value);
    }
  }
  for (const std::optional<float>& extreme : {largest, smallest}) {
    const bool is_other = extreme && *extreme != 0 && *extreme != -1;
    if (is_other && *extreme == std::trunc(*extreme)) values.push_back(*extreme);
  }
  std::erase_if(values, [&](float value) { return count_of(map, value) < kFewestUnknown; });
  return values;
}

/// Value that may mark unknown pixels.
struct UnknownValue {
  float value = 0;    ///< In the map,
  double factor = 1;  ///< whose values times this are px.
};

/// The map with the nearest of the values that are `known` at all other pixels.
Image<float> filled(const DisparityView& map, Image<std::uint8_t> known) {
  Image<float> values(map.disparity.height, map.disparity.width);
  std::vector<PixelIndex> front;
  for (int y = 0; y < values.height(); ++y) {
    for (int x = 0; x < values.width(); ++x) {
      values.at(y, x) = map.disparity.at(y, x);
      if (known.at(y, x) != 0) front.push_back({y, x});
    }
  }
  for (std::size_t i = 0; i < front.size(); ++i) {
    const PixelIndex from = front[i];
    for (const PixelIndex step : {PixelIndex{0, 1}, {1, 0}, {0, -1}, {-1, 0}}) {
      const PixelIndex to{from.y + step.y, from.x + step.x};
      const bool is_inside =
          to.y >= 0 && to.x >= 0 && to.y < values.height() && to.x < values.width();
      if (!is_inside || known.at(to.y, to.x) != 0) continue;
      known.at(to.y, to.x) = 1;
      values.at(to.y, to.x) = values.at(from.y, from.x);
      front.push_back(to);
    }
  }
  return values;
}

/// The view and those next to it, smoothed, in the order that `explanation` found.
class NextViews {
 public:
  NextViews(const LightField::Samples& samples, ViewIndex at, const Explanation& explanation)
      : here_(smoothed(grey_levels(samples, at))) {
    for (const bool is_along_x : {true, false}) {
      const bool is_u = is_along_x != explanation.is_transposed;
      const bool is_reversed = is_along_x ? explanation.reversed_u : explanation.reversed_v;
      for (const int step : {-1, 1}) {
        const ViewIndex next = is_u ? ViewIndex{at.v, at.u + step} : ViewIndex{at.v + step, at.u};
        if (!grid_of(samples).contains(next)) continue;
        next_.push_back(
            {smoothed(grey_levels(samples, next)), is_along_x, is_reversed ? -step : step});
      }
    }
  }

  /// Mean grey error of a pixel with this disparity along both axes.
  [[nodiscard]] float error(PixelIndex at, double disparity) const {
    const auto along_x = error_along(true, at, disparity);
    const auto along_y = error_along(false, at, disparity);
    if (along_x && along_y) return (*along_x + *along_y) / 2;
    return along_x.value_or(along_y.value_or(0));
  }

 private:
  struct Next {
    Image<float> grey;
    bool is_along_x;
    int step;

    /// Infinite outside of the picture.
    [[nodiscard]] float grey_at(PixelIndex at, double disparity) const {
      const double place = (is_along_x ? at.x : at.y) - step * disparity;
      const int last = (is_along_x ? grey.width() : grey.height()) - 1;
      if (!(place >= 0 && place <= last)) return std::numeric_limits<float>::infinity();
      const int i = std::min(static_cast<int>(place), last - 1);
      const float first = is_along_x ? grey.at(at.y, i) : grey.at(i, at.x);
      const float second = is_along_x ? grey.at(at.y, i + 1) : grey.at(i + 1, at.x);
      return first + static_cast<float>(place - i) * (second - first);
    }
  };

  /// By the view that shows the pixel better, as edges hide it in the other; none without views.
  [[nodiscard]] std::optional<float> error_along(bool is_along_x, PixelIndex at,
                                                 double disparity) const {
    std::optional<float> least;
    for (const Next& next : next_) {
      if (next.is_along_x != is_along_x) continue;
      const float error = std::abs(here_.at(at.y, at.x) - next.grey_at(at, disparity));
      least = std::min(least.value_or(kLargestNextError), error);
    }
    return least;
  }

  Image<float> here_;
  std::vector<Next> next_;
};

/// What the views say of pixels with one value.
struct ValueErrors {
  double stored = 0;  ///< Mean grey error with the value,
  double next = 0;    ///< with the nearest other value,
  double beyond = 0;  ///< with one as far to the other side, which averages noise as much,
  double others = 0;  ///< and of the pixels with other values.
  double score = 0;   ///< By how many standard deviations of chance `next` is better.

  [[nodiscard]] bool is_contradicted() const {
    if (next > kBetterThanBeyond * beyond) return false;
    const bool is_clear = stored > kAboveNoise * others && next < kClearlyBetterNext * stored &&
                          score > kSignificantNext;
    return is_clear || (stored > kContradicted * others && next < kHardlyWorseNext * stored);
  }
};

ValueErrors compare_with_next(const NextViews& views, const DisparityView& map,
                              const UnknownValue& unknown, const Image<float>& next) {
  ValueErrors errors;
  std::map<std::pair<int, int>, double> squares;
  double count = 0, count_of_others = 0;
  for (int y = 0; y < next.height(); ++y) {
    for (int x = 0; x < next.width(); ++x) {
      if (!map.is_valid(y, x)) continue;
      const double stored_px = unknown.factor * map.disparity.at(y, x);
      const double next_px = unknown.factor * next.at(y, x);
      const double stored = views.error({y, x}, stored_px);
      if (map.disparity.at(y, x) != unknown.value) {
        errors.others += stored;
        count_of_others += 1;
      } else if (std::abs(stored_px - next_px) >= kFewestDiffering) {
        const double other = views.error({y, x}, next_px);
        errors.stored += stored;
        errors.next += other;
        errors.beyond += views.error({y, x}, 2 * stored_px - next_px);
        count += 1;
        squares[{y / kNextSquare, x / kNextSquare}] += stored - other;
      }
    }
  }
  if (count < kFewestUnknown) return {};
  double sum_of_squares = 0;
  for (const auto& [place, gain] : squares) sum_of_squares += gain * gain;
  errors.score = (errors.stored - errors.next) / std::sqrt(std::max(sum_of_squares, 1e-9));
  errors.stored /= count;
  errors.next /= count;
  errors.beyond /= count;
  errors.others /= count_of_others;
  return errors;
}

/// Marks pixels of exactly this value as invalid, in all views, if the nearest other values explain
/// the neighbors of view `at` clearly better there than the value does. Returns a warning, or
/// nothing.
std::string drop_unknown_value(const LightField::Samples& samples, ViewIndex at,
                               const UnknownValue& unknown, NamedValues values) {
  DisparityField& field = values.field;
  const DisparityView map = field.view(at);
  const auto count = static_cast<double>(count_of(map, unknown.value));
  const auto all = static_cast<double>(map.disparity.size());
  if (count > kMostShare * all) return {};
  Image<std::uint8_t> others = valid_without(map, unknown.value);
  const Explanation known =
      explain_views(samples, at, {map.disparity, others.view()}, unknown.factor);
  const NextViews views(samples, at, known);
  const ValueErrors errors = compare_with_next(views, map, unknown, filled(map, std::move(others)));
  if (!errors.is_contradicted()) return {};
  mark(field, unknown.value);
  const bool leads_out = errors.stored >= kLargestNextError;
  return fmt::format(
      finding_text("map.unknown_value"), values.name, unknown.value, 100 * count / all,
      leads_out ? std::string(finding_text("map.leads_out"))
                : fmt::format(finding_text("map.error_there"), errors.stored, errors.others));
}

}  // namespace

bool drop_unknown_values(const LightField::Samples& samples, ViewIndex at, double factor,
                         NamedValues values, ConventionReport& report) {
  bool has_dropped = false;
  for (const float value : possible_unknown_values(values.field.view(at))) {
    const std::string text = drop_unknown_value(samples, at, {value, factor}, values);
    if (text.empty()) continue;
    report.warnings.push_back(text);
    has_dropped = true;
  }
  return has_dropped;
}

namespace {

/// A map that explains views this well, as a share of the error without warping, is upright.
constexpr double kPlainMap = 0.5;

/// Before near and far are judged, which mirrored maps would get wrong.
void put_upright(const LightField::Samples& samples, const std::vector<MapUnit>& units,
                 ViewIndex at, DisparityField& field, ConventionReport& report) {
  const DisparityView map = field.view(at);
  const Explanation stored = settle_unit(samples, at, map, units).explanation;
  if (stored.error <= kPlainMap * stored.unwarped) return;  // or nothing was compared
  const auto found = far_better_turn(
      map, std::min(stored.error, stored.unwarped), [&](const DisparityView& turned) {
        return settle_unit(samples, at, turned, units).explanation.error;
      });
  if (!found) return;
  field = turned_back(field, *found);
  report.warnings.push_back(turned_back_text(found->text));
}

/// Where other numbers than the known units explain the views clearly better: a warning.
std::string doubt_of_unit(const LightField::Samples& samples, ViewIndex at, NamedValues values,
                          const MapUnit& unit) {
  const auto better = find_better_unit(samples, at, values.field.view(at), unit.factor);
  if (!better) return {};
  if (better->offset_px != 0) {
    return fmt::format(finding_text("units.offset"), values.name, unit.text, better->error_as_taken,
                       better->factor, better->offset_px, better->error);
  }
  return fmt::format(finding_text("units.doubt"), values.name, unit.text, better->error_as_taken,
                     better->factor, better->error, better->factor);
}

}  // namespace

void scale_values(DisparityField& field, double factor) {
  if (factor == 1) return;
  std::for_each(field.disparity.data(), field.disparity.data() + field.disparity.size(),
                [&](float& value) { value = static_cast<float>(factor * value); });
}

SettledUnit infer_units(const LightField::Samples& samples, const std::vector<MapUnit>& units,
                        NamedValues values, ConventionReport& report) {
  const ViewIndex at = told_view(values.field, grid_of(samples));
  put_upright(samples, units, at, values.field, report);
  SettledUnit settled = settle_unit(samples, at, values.field.view(at), units);
  if (drop_unknown_values(samples, at, settled.unit.factor, values, report)) {
    settled = settle_unit(samples, at, values.field.view(at), units);
  }
  const std::string doubt = doubt_of_unit(samples, at, values, settled.unit);
  if (!doubt.empty()) report.warnings.push_back(doubt);
  return settled;
}

}  // namespace episcope::io
