// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/order/epi_slopes.h"

#include "engine/core/array/transposed.h"
#include "engine/io/order/both_axes.h"
#include "engine/io/order/line_matches.h"
#include "engine/io/order/warp_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <variant>
#include <vector>

namespace episcope::io {
namespace {

constexpr int kLargestArea = 512;
constexpr int kStride = 4;
constexpr int kRadius = 3;
constexpr int kSquare = 8;
constexpr double kSignificant = 3.3;  ///< Standard deviations of correlations by chance.
constexpr double kStep = 0.5;
constexpr double kLargestRange = 64;

/// Three views in a row along one axis, the middle one common to both axes; views of the vertical
/// axis are transposed, so that disparity is always along x.
struct Triple {
  Image<float> before;
  Image<float> middle;
  Image<float> after;
};

/// Of a view of the given size.
PixelRect looked_at(int height, int width) {
  const int rows = std::min(height, kLargestArea), columns = std::min(width, kLargestArea);
  const int top = (height - rows) / 2, left = (width - columns) / 2;
  return {top, left, top + rows, left + columns};
}

PixelRect part_of(const LightField::Samples& samples) {
  return std::visit([](const auto& stack) { return looked_at(stack.height(), stack.width()); },
                    samples);
}

Triple load_triple(const LightField::Samples& samples, ViewIndex center, int step, bool is_v) {
  const PixelRect part = part_of(samples);
  const auto load = [&](int offset) {
    const ViewIndex view{center.v + (is_v ? offset : 0), center.u + (is_v ? 0 : offset)};
    const Image<float> grey = grey_levels(samples, view, part);
    return is_v ? transposed(grey) : grey;
  };
  return {load(-step), load(0), load(step)};
}

/// |middle − after(x − d)| + |middle − before(x + d)|, with the border repeated.
Image<float> differences(const Triple& views, double d) {
  const int width = views.middle.width();
  Image<float> out(views.middle.height(), width);
  const double whole = std::floor(d);
  const auto part = static_cast<float>(d - whole);
  const int k = static_cast<int>(whole);
  const auto clamp = [width](int x) { return std::clamp(x, 0, width - 1); };
  for (int y = 0; y < out.height(); ++y) {
    const float* after = views.after.row(y);
    const float* before = views.before.row(y);
    for (int x = 0; x < width; ++x) {
      const float a = after[clamp(x - k)] * (1 - part) + after[clamp(x - k - 1)] * part;
      const float b = before[clamp(x + k)] * (1 - part) + before[clamp(x + k + 1)] * part;
      const float m = views.middle.at(y, x);
      out.at(y, x) = std::abs(m - a) + std::abs(m - b);
    }
  }
  return out;
}

float window_sum(const Image<float>& image, int y, int x) {
  float sum = 0;
  for (int dy = -kRadius; dy <= kRadius; ++dy) {
    for (int dx = -kRadius; dx <= kRadius; ++dx) sum += image.at(y + dy, x + dx);
  }
  return sum;
}

/// Best disparity of every point of the coarse lattice, NaN where the match is not distinct.
struct Match {
  float best = std::numeric_limits<float>::max();
  float sum = 0;
  double disparity = 0;
};

std::vector<double> match(const Triple& views, double range, const Progress& progress) {
  const int rows = (views.middle.height() - 2 * kRadius) / kStride;
  const int columns = (views.middle.width() - 2 * kRadius) / kStride;
  std::vector<Match> matches(static_cast<std::size_t>(std::max(rows, 0)) * std::max(columns, 0));
  const int steps = static_cast<int>(std::round(range / kStep));
  for (int i = -steps; i <= steps; ++i) {
    progress.check();
    const Image<float> cost = differences(views, i * kStep);
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < columns; ++c) {
        Match& point = matches[static_cast<std::size_t>(r) * columns + c];
        const float sum = window_sum(cost, kRadius + r * kStride, kRadius + c * kStride);
        point.sum += sum;
        if (sum < point.best) {
          point.best = sum;
          point.disparity = i * kStep;
        }
      }
    }
  }
  std::vector<double> found;
  for (const Match& point : matches) {
    const double mean = point.sum / (2 * steps + 1);
    const bool is_textured = mean > 4.0F * (2 * kRadius + 1) * (2 * kRadius + 1);
    const bool is_inside = std::abs(point.disparity) < range - kStep;
    const bool is_distinct = is_textured && is_inside && point.best < 0.4 * mean;
    found.push_back(is_distinct ? point.disparity : std::numeric_limits<double>::quiet_NaN());
  }
  return found;
}

struct Sums {
  double n = 0, h = 0, v = 0, hh = 0, vv = 0, hv = 0;

  void add(double a, double b) {
    n += 1;
    h += a;
    v += b;
    hh += a * a;
    vv += b * b;
    hv += a * b;
  }
  [[nodiscard]] SlopeCorrelation correlation() const {
    if (n < 2) return {};
    const double var_h = hh / n - h / n * h / n;
    const double var_v = vv / n - v / n * v / n;
    const bool has_depth = std::min(var_h, var_v) > 0.25 * kStep * kStep;
    const double top = has_depth ? hv / n - h / n * v / n : hv / n;
    const double bottom = has_depth ? var_h * var_v : hh / n * vv / n;
    return {bottom > 0 ? top / std::sqrt(bottom) : 0, static_cast<int>(n), 0};
  }
};

SlopeCorrelation correlate(const LightField::Samples& samples, ViewIndex center, int step,
                           double range, const Progress& progress) {
  const auto [along_u, along_v] = along_both_axes(progress, [&](bool is_v) {
    return match(load_triple(samples, center, step, is_v), range, progress);
  });
  const PixelRect part = part_of(samples);
  const int columns = (part.x1 - part.x0 - 2 * kRadius) / kStride;
  const int rows = (part.y1 - part.y0 - 2 * kRadius) / kStride;
  Sums sums;
  std::set<std::pair<int, int>> squares;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const double a = along_u[static_cast<std::size_t>(r) * columns + c];
      const double b = along_v[static_cast<std::size_t>(c) * rows + r];
      if (!std::isfinite(a) || !std::isfinite(b)) continue;
      sums.add(a, b);
      squares.insert({r * kStride / kSquare, c * kStride / kSquare});
    }
  }
  SlopeCorrelation found = sums.correlation();
  found.squares = static_cast<int>(squares.size());
  return found;
}

/// In px between neighbouring views.
double search_range(const LightField::Samples& samples, const Progress& progress) {
  const int smaller = std::visit(
      [](const auto& stack) { return std::min(stack.width(), stack.height()); }, samples);
  const double usual = std::clamp(smaller / 48.0, 3.0, 16.0);
  const auto [u, v] = along_both_axes(
      progress, [&](bool is_v) { return largest_motion(samples, is_v, usual, progress); });
  return std::clamp(std::max(u, v), usual, kLargestRange);
}

bool is_better(const SlopeCorrelation& next, const SlopeCorrelation& found) {
  if (next.is_decided() != found.is_decided()) return next.is_decided();
  return std::abs(next.value) * std::min(next.points, 30) >
         std::abs(found.value) * std::min(found.points, 30);
}

}  // namespace

bool SlopeCorrelation::is_decided() const {
  return points >= 30 && std::abs(value) > 0.2 &&
         std::abs(value) * std::sqrt(squares) > kSignificant;
}

SlopeCorrelation correlate_epi_slopes(const LightField::Samples& samples,
                                      const Progress& progress) {
  return std::visit(
      [&](const auto& stack) {
        const ViewIndex center = stack.grid().center();
        const int reach = std::min(
            {center.v, center.u, stack.grid().v - 1 - center.v, stack.grid().u - 1 - center.u});
        SlopeCorrelation found;
        const double range = search_range(samples, progress);
        // Farther views tell small disparities apart, where the next ones do not.
        for (int step = 1; step <= std::min(reach, 4); step *= 2) {
          const SlopeCorrelation next = correlate(samples, center, step, range, progress);
          if (is_better(next, found)) found = next;
          if (found.is_decided() && std::abs(found.value) > 0.5) break;
        }
        return found;
      },
      samples);
}

}  // namespace episcope::io
