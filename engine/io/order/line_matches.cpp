// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/order/line_matches.h"

#include "engine/core/array/transposed.h"
#include "engine/io/order/grey_picture.h"
#include "engine/io/order/warp_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

namespace episcope::io {
namespace {

constexpr int kArea = 512;
constexpr int kRadius = 2;
constexpr double kStep = 0.5;
constexpr double kLargestShift = 24;
constexpr double kLargestRange = 48;  ///< In px of what is looked at: smaller views tell as much.
constexpr int kCoarseSide = 128;      ///< Of views in which motion of any size is looked for,
constexpr double kCoarseRange = 24;   ///< and so far,
constexpr float kFarBetter = 0.5F;    ///< beyond the usual with so much of the error within.
constexpr double kLeastBrightness = 0.6;  ///< Of a view, as a share of the middle one's.

double mean_of(const Image<float>& picture) {
  double sum = 0;
  for (const float value : picture) sum += value;
  return sum / static_cast<double>(std::max<std::size_t>(picture.size(), 1));
}

/// Loads views of one axis through the centre of the grid, brought to the brightness of the middle
/// one: else the darker of two surfaces would seem to be seen in a vignetted view.
class Axis {
 public:
  Axis(const LightField::Samples& samples, bool is_v, int side)
      : samples_(samples), is_v_(is_v), side_(side) {
    const GridShape grid = grid_of(samples);
    center_ = grid.center();
    reach_ = is_v ? std::min(center_.v, grid.v - 1 - center_.v)
                  : std::min(center_.u, grid.u - 1 - center_.u);
    mean_ = mean_of(as_stored(0));
  }
  [[nodiscard]] int reach() const { return reach_; }
  /// Of the views as stored, in a px of what is looked at.
  [[nodiscard]] int pixels() const {
    return std::visit(
        [&](const auto& stack) {
          return reduction(std::max(stack.height(), stack.width()), side_);
        },
        samples_);
  }
  [[nodiscard]] Image<float> view(int offset) const {
    Image<float> picture = as_stored(offset);
    const double mean = mean_of(picture);
    const auto gain = static_cast<float>(mean > 0 ? mean_ / mean : 1.0);
    for (float& value : picture) value *= gain;
    return picture;
  }
  /// The farthest step, at most `most`, at which neither view is much darker than the middle one.
  [[nodiscard]] int farthest_bright(int most) const {
    const auto is_bright = [&](int offset) {
      return mean_of(as_stored(offset)) > kLeastBrightness * mean_;
    };
    int far = std::min(most, reach_);
    while (far > 1 && !(is_bright(-far) && is_bright(far))) --far;
    return far;
  }

 private:
  // What is looked at of a view: the squares that become the middle of the reduced one.
  [[nodiscard]] Image<float> as_stored(int offset) const {
    const ViewIndex at{center_.v + (is_v_ ? offset : 0), center_.u + (is_v_ ? 0 : offset)};
    const auto [height, width] = std::visit(
        [](const auto& stack) { return std::pair(stack.height(), stack.width()); }, samples_);
    const int k = pixels();
    const auto middle = [k](int length) {
      const int all = std::max(length / k, 1), kept = std::min(all, kArea);
      const int first = (all - kept) / 2;
      return std::pair(first * k, std::min((first + kept) * k, length));
    };
    const auto [y0, y1] = middle(height);
    const auto [x0, x1] = middle(width);
    const Image<float> grey = reduced_by(grey_levels(samples_, at, {y0, x0, y1, x1}), k);
    return smoothed(is_v_ ? transposed(grey) : grey);
  }

  const LightField::Samples& samples_;
  bool is_v_;
  int side_;
  ViewIndex center_;
  int reach_ = 0;
  double mean_ = 0;
};

/// |one − other moved by `shift` to the right|, with the border repeated.
void difference(const Image<float>& one, const Image<float>& other, double shift,
                Image<float>& out) {
  const int width = one.width();
  const double whole = std::floor(-shift);
  const auto part = static_cast<float>(-shift - whole);
  const int k = static_cast<int>(whole);
  const auto clamp = [width](int x) { return std::clamp(x, 0, width - 1); };
  const int first = std::clamp(-k, 0, width);
  const int last = std::clamp(width - 1 - k, first, width);
  for (int y = 0; y < one.height(); ++y) {
    const float* a = one.row(y);
    const float* b = other.row(y);
    float* to = out.row(y);
    const auto edge = [&](int x) {
      to[x] = std::abs(a[x] - (1 - part) * b[clamp(x + k)] - part * b[clamp(x + k + 1)]);
    };
    for (int x = 0; x < first; ++x) edge(x);
    for (int x = first; x < last; ++x) {
      to[x] = std::abs(a[x] - (1 - part) * b[x + k] - part * b[x + k + 1]);
    }
    for (int x = last; x < width; ++x) edge(x);
  }
}

/// Means over windows, the border left as it is.
void box_filter(Image<float>& picture, Image<float>& scratch) {
  const int height = picture.height();
  const int width = picture.width();
  constexpr float kWeight = 1.0F / (2 * kRadius + 1);
  for (int y = 0; y < height; ++y) {
    const float* from = picture.row(y);
    float* to = scratch.row(y);
    std::copy_n(from, width, to);
    for (int x = kRadius; x < width - kRadius; ++x) {
      to[x] = kWeight * (from[x - 2] + from[x - 1] + from[x] + from[x + 1] + from[x + 2]);
    }
  }
  for (int y = 0; y < height; ++y) {
    float* to = picture.row(y);
    if (y < kRadius || y >= height - kRadius) {
      std::copy_n(scratch.row(y), width, to);
      continue;
    }
    const std::array<const float*, 5> rows{scratch.row(y - 2), scratch.row(y - 1), scratch.row(y),
                                           scratch.row(y + 1), scratch.row(y + 2)};
    for (int x = 0; x < width; ++x) {
      to[x] = kWeight * (rows[0][x] + rows[1][x] + rows[2][x] + rows[3][x] + rows[4][x]);
    }
  }
}

/// Costs of one shift: of the views before and of those after, the better ones.
class Costs {
 public:
  explicit Costs(const LineOfViews& views)
      : views_(views),
        part_(views.middle.height(), views.middle.width()),
        scratch_(part_),
        sides_{part_, part_} {}

  const Image<float>& at(double shift) {
    for (std::size_t side = 0; side < 2; ++side) {
      const double towards = side == 0 ? shift : -shift;
      difference(views_.middle, views_.far[side], -towards, sides_[side]);
      if (views_.near_share < 1) {
        difference(views_.middle, views_.near[side], -towards * views_.near_share, part_);
        for (std::size_t i = 0; i < part_.size(); ++i) sides_[side].data()[i] += part_.data()[i];
      }
      box_filter(sides_[side], scratch_);
    }
    for (std::size_t i = 0; i < part_.size(); ++i) {
      sides_[0].data()[i] = std::min(sides_[0].data()[i], sides_[1].data()[i]);
    }
    return sides_[0];
  }

 private:
  const LineOfViews& views_;
  Image<float> part_;
  Image<float> scratch_;
  std::array<Image<float>, 2> sides_;
};

struct Search {
  double first = 0;
  double last = 0;
  /// Beyond it, either way, points must match far better than within.
  double usual = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool is_empty() const { return last <= first; }
  [[nodiscard]] double most() const { return std::max(std::abs(first), std::abs(last)); }
};

void lower(const Image<float>& values, Image<float>& least) {
  std::transform(values.begin(), values.end(), least.begin(), least.begin(),
                 [](float a, float b) { return std::min(a, b); });
}

Image<float> best_shifts(const LineOfViews& views, Search search, const Progress& progress) {
  const int height = views.middle.height();
  const int width = views.middle.width();
  Image<float> best(height, width, 1, std::numeric_limits<float>::max());
  const bool looks_far = std::isfinite(search.usual);
  Image<float> usual;
  if (looks_far) usual = best;
  Image<float> sum(height, width);
  Image<float> shift(height, width);
  Costs costs(views);
  const int steps = static_cast<int>(std::round((search.last - search.first) / kStep));
  for (int i = 0; i <= steps; ++i) {
    progress.check();
    const double tried = search.first + i * kStep;
    const Image<float>& cost = costs.at(tried);
    if (looks_far && std::abs(tried) <= search.usual) lower(cost, usual);
    for (std::size_t k = 0; k < cost.size(); ++k) {
      const float value = cost.data()[k];
      sum.data()[k] += value;
      if (value < best.data()[k]) {
        best.data()[k] = value;
        shift.data()[k] = static_cast<float>(tried);
      }
    }
  }
  for (std::size_t k = 0; k < shift.size(); ++k) {
    const float mean = sum.data()[k] / static_cast<float>(steps + 1);
    const bool is_inside = shift.data()[k] > search.first && shift.data()[k] < search.last;
    const bool is_usual = !looks_far || std::abs(shift.data()[k]) <= search.usual ||
                          best.data()[k] < kFarBetter * usual.data()[k];
    const bool is_distinct = is_inside && is_usual && best.data()[k] < 0.6F * mean;
    if (!is_distinct) shift.data()[k] = std::numeric_limits<float>::quiet_NaN();
  }
  return shift;
}

/// The middle 96 % of the shifts and a bit more; empty if there are hardly any.
Search range_of(const Image<float>& shifts) {
  std::vector<float> found;
  for (const float shift : shifts) {
    if (std::isfinite(shift)) found.push_back(shift);
  }
  if (found.size() < 100) return {};
  std::ranges::sort(found);
  const std::size_t tail = found.size() / 50;
  return {found[tail] - 1.0, found[found.size() - 1 - tail] + 1.0};
}

/// The middle view and those next to it.
LineOfViews next_views(const Axis& axis) {
  LineOfViews views;
  views.middle = axis.view(0);
  views.near = {axis.view(-1), axis.view(1)};
  views.far = views.near;
  views.far_step = 1;
  return views;
}

}  // namespace

double largest_motion(const LightField::Samples& samples, bool is_v, double usual_px,
                      const Progress& progress) {
  const Axis axis(samples, is_v, kCoarseSide);
  if (axis.reach() < 1) return 0;
  const Search coarse{-kCoarseRange, kCoarseRange, usual_px / axis.pixels()};
  return axis.pixels() * range_of(best_shifts(next_views(axis), coarse, progress)).most();
}

LineMatches match_line(const LightField::Samples& samples, bool is_v, int side,
                       const Progress& progress) {
  const Axis axis(samples, is_v, side);
  LineMatches found;
  if (axis.reach() < 1) return found;
  LineOfViews& views = found.views;
  views = next_views(axis);
  const double usual = std::clamp(views.middle.width() / 32.0, 4.0, 16.0);
  const double motion = largest_motion(samples, is_v, usual * axis.pixels(), progress);
  const double range = std::max(usual, motion / axis.pixels());
  if (range > kLargestRange) return {};
  found.shift = best_shifts(views, {-range, range}, progress);
  const Search first = range_of(found.shift);
  if (first.is_empty()) return {};

  const int far =
      axis.farthest_bright(std::clamp(static_cast<int>(kLargestShift / first.most()), 1, 8));
  if (far == 1) return found;
  const int near = (far + 1) / 2;
  if (near > 1) views.near = {axis.view(-near), axis.view(near)};
  views.far = {axis.view(-far), axis.view(far)};
  views.far_step = far;
  views.near_share = static_cast<double>(near) / far;
  found.shift = best_shifts(views, {first.first * far, first.last * far}, progress);
  return found;
}

}  // namespace episcope::io
