// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/near_side.h"

#include "engine/core/array/quantile.h"
#include "engine/io/order/warp_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace episcope::io {
namespace {

constexpr int kFarthest = 4;     ///< View steps.
constexpr float kContrast = 15;  ///< Grey levels between the two pixels of a pair, or in weak
                                 ///< views so many times the usual error, and no less than this;
constexpr float kAboveNoise = 2.5;
constexpr float kLeastContrast = 2;
constexpr double kGap = 1.5;     ///< px between their places if both moved on.
constexpr int kErrorStride = 7;  ///< Of the pixels that tell the usual error.
constexpr int kFewestPoints = 50;
constexpr double kDistinct = 0.85;  ///< Of the larger error, at most.
/// Standard deviations of chance, of which pairs of the same edge, seen side by side and from four
/// sides, make one out of two.
constexpr double kSignificant = 6.6;

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
    if (std::abs(line.shift[most] - line.shift[least]) < kGap) continue;
    compared.pairs.push_back(
        {std::abs(line.here[most] - line.here[least]), error(cell.most), error(cell.least)});
  }
}

struct Pair {
  const Image<float>& here;
  const Image<float>& there;
  bool is_along_x;
  double pixels;  ///< Shift of disparity 1.
};

void compare_views(const Pair& pair, const DisparityView& map, double factor, Compared& compared) {
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
NearSide side_of(const std::vector<HiddenPair>& pairs, float contrast) {
  NearSide side;
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
  return std::clamp(kAboveNoise * quantile(errors, 0.5), kLeastContrast, kContrast);
}

}  // namespace

bool NearSide::is_decided() const {
  return points >= kFewestPoints &&
         std::min(larger, smaller) < kDistinct * std::max(larger, smaller) &&
         std::abs(larger - smaller) > kSignificant * doubt;
}

NearSide find_near_side(const LightField::Samples& samples, ViewIndex at, const DisparityView& map,
                        double factor, const Explanation& explanation) {
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
      while (steps < kFarthest && grid.contains(neighbour(steps + 1))) ++steps;
      if (steps == 0) continue;
      const Image<float> there = grey_levels(samples, neighbour(steps));
      const double pixels = (is_reversed ? -1.0 : 1.0) * direction * steps;
      compare_views({here, there, is_along_x, pixels}, map, factor, compared);
    }
  }
  const NearSide plain = side_of(compared.pairs, kContrast);
  return plain.is_decided() ? plain : side_of(compared.pairs, weak_contrast(compared.errors));
}

std::string hiding_text(const NearSide& side) {
  return fmt::format(
      "hide others in other views (grey error {:.2f}, the hidden ones {:.2f}, {} pairs)",
      std::min(side.larger, side.smaller), std::max(side.larger, side.smaller), side.points);
}

}  // namespace episcope::io
