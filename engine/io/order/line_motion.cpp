// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/order/line_motion.h"

#include "engine/core/array/quantile.h"
#include "engine/core/array/transposed.h"
#include "engine/io/order/grey_picture.h"
#include "engine/io/order/warp_check.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace episcope::io {
namespace {

constexpr int kSide = 512;
constexpr int kSquare = 16;
constexpr int kRange = 8;
constexpr int kFarthest = 8;
constexpr int kFewestSquares = 12;
constexpr double kEnough_px = 1;   ///< Motion along the line that tells.
constexpr double kBothWays = 0.1;  ///< Of the texture of a square across its main direction.
constexpr double kLeast_px = 0.25;
constexpr double kShare = 0.3;

struct Motion {
  double x = 0;
  double y = 0;
};

/// Sums over a square of what a step to sub-pixel motion needs; all with their means taken off.
struct Normal {
  double xx = 0, xy = 0, yy = 0, xd = 0, yd = 0, dd = 0;
};

Normal normal_of(const Image<float>& a, const Image<float>& b, int top, int left, int shift) {
  Normal sums;
  double x = 0, y = 0, d = 0;
  for (int row = top; row < top + kSquare; ++row) {
    for (int column = left; column < left + kSquare; ++column) {
      const int at = column + shift;
      const double gx = 0.5 * (b.at(row, at + 1) - b.at(row, at - 1));
      const double gy = 0.5 * (b.at(row + 1, at) - b.at(row - 1, at));
      const double difference = a.at(row, column) - b.at(row, at);
      x += gx;
      y += gy;
      d += difference;
      sums.xx += gx * gx;
      sums.xy += gx * gy;
      sums.yy += gy * gy;
      sums.xd += gx * difference;
      sums.yd += gy * difference;
      sums.dd += difference * difference;
    }
  }
  constexpr double kCount = kSquare * kSquare;
  return {sums.xx - x * x / kCount, sums.xy - x * y / kCount, sums.yy - y * y / kCount,
          sums.xd - x * d / kCount, sums.yd - y * d / kCount, sums.dd - d * d / kCount};
}

/// Nothing where the texture does not fix both directions.
std::optional<Motion> motion_of(const Image<float>& a, const Image<float>& b, int top, int left) {
  Normal best;
  best.dd = std::numeric_limits<double>::infinity();
  int shift = 0;
  for (int s = -kRange; s <= kRange; ++s) {
    const Normal one = normal_of(a, b, top, left, s);
    if (one.dd >= best.dd) continue;
    best = one;
    shift = s;
  }
  const double trace = best.xx + best.yy;
  const double determinant = best.xx * best.yy - best.xy * best.xy;
  // The smaller eigenvalue is about the determinant over the trace.
  if (!(trace > 0) || determinant < kBothWays * trace * trace) return std::nullopt;
  return Motion{shift + (best.yy * best.xd - best.xy * best.yd) / determinant,
                (best.xx * best.yd - best.xy * best.xd) / determinant};
}

/// With the line along x.
Image<float> picture_of(const LightField::Samples& samples, int place) {
  const bool is_column = grid_of(samples).u == 1;
  const ViewIndex view = is_column ? ViewIndex{place, 0} : ViewIndex{0, place};
  Image<float> picture = smoothed(reduced(grey_levels(samples, view), kSide));
  return is_column ? transposed(picture) : picture;
}

LineMotion motion_between(const Image<float>& a, const Image<float>& b, int step) {
  std::vector<float> along;
  std::vector<float> across;
  constexpr int kMargin = kRange + 1;
  for (int y = 1; y + kSquare < a.height(); y += kSquare) {
    for (int x = kMargin; x + kSquare + kMargin <= a.width(); x += kSquare) {
      const auto motion = motion_of(a, b, y, x);
      if (!motion) continue;
      along.push_back(static_cast<float>(std::abs(motion->x)));
      across.push_back(static_cast<float>(std::abs(motion->y)));
    }
  }
  const auto squares = static_cast<int>(along.size());
  if (squares < kFewestSquares) return {0, 0, step, squares};
  return {quantile(along, 0.5), quantile(across, 0.5), step, squares};
}

}  // namespace

bool LineMotion::is_askew() const {
  return across > kLeast_px && across > kShare * along;
}

std::string LineMotion::warning() const {
  return fmt::format(
      "Points move across the line of views as well: by {:.2f} px between views {} apart, beside "
      "{:.2f} px along it. This may be a film of a camera that zooms or turns, or views that are "
      "not rectified; disparity is not to be trusted then.",
      across, step, along);
}

LineMotion measure_line_motion(const LightField::Samples& samples, const Progress& progress) {
  const int count = grid_of(samples).count();
  const int center = count / 2;
  const Image<float> middle = picture_of(samples, center);
  LineMotion motion;
  for (int step = 1; step <= kFarthest && step <= center; step *= 2) {
    progress.check();
    motion = motion_between(middle, picture_of(samples, center - step), step);
    if (motion.along > kEnough_px || motion.across > kEnough_px) break;
  }
  return motion;
}

}  // namespace episcope::io
