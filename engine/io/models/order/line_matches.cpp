// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/order/line_matches.h"

#include "engine/core/image.h"
#include "engine/io/models/order/motion_pictures.h"
#include "engine/io/models/order/warp_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <variant>
#include <vector>

namespace episcope::io {
namespace {

constexpr int kArea = 512;
constexpr int kRadius = 2;
constexpr double kMatchStep = 0.5;
constexpr double kLargestLineShift = 24;
constexpr double kLargestRange = 48;  ///< In px of what is looked at: smaller views tell as much.
constexpr int kCoarseSide = 128;      ///< Of views in which motion of any size is looked for,
constexpr double kCoarseRange = 24;   ///< and so far,
constexpr float kFarBetterBeyond = 0.5F;  ///< beyond the usual with so much of the error within.
constexpr double kLeastBrightness = 0.6;  ///< Of a view, as a share of the middle one's.

double mean_of(const Image<float>& picture) {
  double sum = 0;
  for (const float value : picture) sum += value;
  return sum / static_cast<double>(std::max<std::size_t>(picture.size(), 1));
}

/// Loads views of one axis through the center of the grid, brought to the brightness of the middle
/// one: else the darker of two surfaces would seem to be seen in a vignetted view.
class AxisViews {
 public:
  AxisViews(const LightField::Samples& samples, bool is_v, int side)
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

}  // namespace

struct ShiftSearch {
  double first = 0;
  double last = 0;

  [[nodiscard]] bool is_empty() const { return last <= first; }
  [[nodiscard]] double most() const { return std::max(std::abs(first), std::abs(last)); }
};

/// The shift of least cost of every pixel, of those tried so far.
struct BestShifts {
  Image<float> cost;
  Image<float> sum;
  Image<float> shift;
  int count = 0;

  explicit BestShifts(const Image<float>& picture)
      : cost(picture.height(), picture.width(), 1, std::numeric_limits<float>::max()),
        sum(picture.height(), picture.width()),
        shift(sum) {}

  void take(const Image<float>& costs, double tried) {
    for (std::size_t k = 0; k < costs.size(); ++k) {
      const float value = costs.data()[k];
      sum.data()[k] += value;
      // Beside the border all shifts out of the view cost as much: none of them is distinct.
      const bool is_as_far = value == cost.data()[k] && std::abs(tried) > std::abs(shift.data()[k]);
      if (value < cost.data()[k] || is_as_far) {
        cost.data()[k] = value;
        shift.data()[k] = static_cast<float>(tried);
      }
    }
    ++count;
  }
  /// NaN for shifts at the ends of the search, and for those hardly better than the others.
  [[nodiscard]] float distinct(std::size_t k, const ShiftSearch& search) const {
    const float found = shift.data()[k];
    const float mean = sum.data()[k] / static_cast<float>(count);
    const bool is_inside = found > search.first && found < search.last;
    const bool is_distinct = is_inside && cost.data()[k] < 0.6F * mean;
    return is_distinct ? found : std::numeric_limits<float>::quiet_NaN();
  }
};

namespace {

/// Calls `take` with the costs of every shift of the search.
template <class Take>
void try_shifts(const LineOfViews& views, const ShiftSearch& search, const Progress& progress,
                const Take& take) {
  Costs costs(views);
  const int steps = static_cast<int>(std::round((search.last - search.first) / kMatchStep));
  for (int i = 0; i <= steps; ++i) {
    progress.check();
    const double tried = search.first + i * kMatchStep;
    take(costs.at(tried), tried);
  }
}

Image<float> best_shifts(const LineOfViews& views, const ShiftSearch& search,
                         const Progress& progress) {
  BestShifts best(views.middle);
  try_shifts(views, search, progress,
             [&](const Image<float>& costs, double tried) { best.take(costs, tried); });
  for (std::size_t k = 0; k < best.shift.size(); ++k) {
    best.shift.data()[k] = best.distinct(k, search);
  }
  return std::move(best.shift);
}

void lower(const Image<float>& values, Image<float>& least) {
  std::transform(values.begin(), values.end(), least.begin(), least.begin(),
                 [](float a, float b) { return std::min(a, b); });
}

/// The middle 96 % of the shifts and a bit more; empty if there are hardly any.
ShiftSearch range_of(const Image<float>& shifts) {
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
LineOfViews next_views(const AxisViews& axis) {
  LineOfViews views;
  views.middle = axis.view(0);
  views.near = {axis.view(-1), axis.view(1)};
  views.far = views.near;
  views.far_step = 1;
  return views;
}

}  // namespace

struct CoarseMotion::Search {
  static constexpr ShiftSearch kRange{-kCoarseRange, kCoarseRange};

  int pixels = 1;  ///< Of the views as stored, in a px of the views of the search.
  BestShifts best;
  /// Least cost of shifts of up to so many steps, either way.
  std::vector<Image<float>> within;

  Search(const AxisViews& axis, const Progress& progress)
      : Search(axis, next_views(axis), progress) {}
  Search(const AxisViews& axis, const LineOfViews& views, const Progress& progress)
      : pixels(axis.pixels()), best(views.middle) {
    within.assign(static_cast<std::size_t>(kCoarseRange / kMatchStep) + 1, best.cost);
    try_shifts(views, kRange, progress, [&](const Image<float>& costs, double tried) {
      best.take(costs, tried);
      lower(costs, within[static_cast<std::size_t>(std::abs(tried) / kMatchStep)]);
    });
    for (std::size_t i = 1; i < within.size(); ++i) lower(within[i - 1], within[i]);
  }

  [[nodiscard]] double largest(double usual) const {
    const double steps = std::min(usual, kCoarseRange) / kMatchStep;
    const Image<float>& least = within[static_cast<std::size_t>(steps)];
    Image<float> shifts = best.shift;
    for (std::size_t k = 0; k < shifts.size(); ++k) {
      float& shift = shifts.data()[k];
      const bool is_usual =
          std::abs(shift) <= usual || best.cost.data()[k] < kFarBetterBeyond * least.data()[k];
      shift = is_usual ? best.distinct(k, kRange) : std::numeric_limits<float>::quiet_NaN();
    }
    return range_of(shifts).most();
  }
};

CoarseMotion::CoarseMotion(const LightField::Samples& samples) : samples_(samples) {}
CoarseMotion::~CoarseMotion() = default;

double CoarseMotion::largest(bool is_v, double usual_px, const Progress& progress) const {
  std::unique_ptr<const Search>& search = along_[is_v ? 1 : 0];
  if (!search) {
    const AxisViews axis(samples_, is_v, kCoarseSide);
    if (axis.reach() < 1) return 0;
    search = std::make_unique<const Search>(axis, progress);
  }
  return search->pixels * search->largest(usual_px / search->pixels);
}

LineMatches match_line(const CoarseMotion& coarse, bool is_v, int side, const Progress& progress) {
  const AxisViews axis(coarse.samples(), is_v, side);
  LineMatches found;
  if (axis.reach() < 1) return found;
  LineOfViews& views = found.views;
  views = next_views(axis);
  const double usual = std::clamp(views.middle.width() / 32.0, 4.0, 16.0);
  const double motion = coarse.largest(is_v, usual * axis.pixels(), progress);
  const double range = std::max(usual, motion / axis.pixels());
  if (range > kLargestRange) return {};
  found.shift = best_shifts(views, {-range, range}, progress);
  const ShiftSearch first = range_of(found.shift);
  if (first.is_empty()) return {};

  const int far =
      axis.farthest_bright(std::clamp(static_cast<int>(kLargestLineShift / first.most()), 1, 8));
  if (far == 1) return found;
  const int near = (far + 1) / 2;
  if (near > 1) views.near = {axis.view(-near), axis.view(near)};
  views.far = {axis.view(-far), axis.view(far)};
  views.far_step = far;
  views.near_share = static_cast<double>(near) / far;
  found.shift = best_shifts(views, {first.first * far, first.last * far}, progress);
  return found;
}

namespace {

constexpr int kSlopeStride = 4;
constexpr int kSlopeRadius = 3;
constexpr int kSlopeSquare = 8;
constexpr double kSignificantSlopes = 3.3;  ///< Standard deviations of correlations by chance.
constexpr double kMostSlope = 64;

/// Three views in a row along one axis, the middle one common to both axes; views of the vertical
/// axis are transposed, so that disparity is always along x.
struct Triple {
  Image<float> before;
  Image<float> middle;
  Image<float> after;
};

/// Of a view of the given size.
PixelRect looked_at(int height, int width) {
  const int rows = std::min(height, kArea), columns = std::min(width, kArea);
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
  for (int dy = -kSlopeRadius; dy <= kSlopeRadius; ++dy) {
    for (int dx = -kSlopeRadius; dx <= kSlopeRadius; ++dx) sum += image.at(y + dy, x + dx);
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
  const int rows = (views.middle.height() - 2 * kSlopeRadius) / kSlopeStride;
  const int columns = (views.middle.width() - 2 * kSlopeRadius) / kSlopeStride;
  std::vector<Match> matches(static_cast<std::size_t>(std::max(rows, 0)) * std::max(columns, 0));
  const int steps = static_cast<int>(std::round(range / kMatchStep));
  for (int i = -steps; i <= steps; ++i) {
    progress.check();
    const Image<float> cost = differences(views, i * kMatchStep);
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < columns; ++c) {
        Match& point = matches[static_cast<std::size_t>(r) * columns + c];
        const float sum =
            window_sum(cost, kSlopeRadius + r * kSlopeStride, kSlopeRadius + c * kSlopeStride);
        point.sum += sum;
        if (sum < point.best) {
          point.best = sum;
          point.disparity = i * kMatchStep;
        }
      }
    }
  }
  std::vector<double> found;
  for (const Match& point : matches) {
    const double mean = point.sum / (2 * steps + 1);
    const bool is_textured = mean > 4.0F * (2 * kSlopeRadius + 1) * (2 * kSlopeRadius + 1);
    const bool is_inside = std::abs(point.disparity) < range - kMatchStep;
    const bool is_distinct = is_textured && is_inside && point.best < 0.4 * mean;
    found.push_back(is_distinct ? point.disparity : std::numeric_limits<double>::quiet_NaN());
  }
  return found;
}

struct SlopeSums {
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
    const bool has_depth = std::min(var_h, var_v) > 0.25 * kMatchStep * kMatchStep;
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
  const int columns = (part.x1 - part.x0 - 2 * kSlopeRadius) / kSlopeStride;
  const int rows = (part.y1 - part.y0 - 2 * kSlopeRadius) / kSlopeStride;
  SlopeSums sums;
  std::set<std::pair<int, int>> squares;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const double a = along_u[static_cast<std::size_t>(r) * columns + c];
      const double b = along_v[static_cast<std::size_t>(c) * rows + r];
      if (!std::isfinite(a) || !std::isfinite(b)) continue;
      sums.add(a, b);
      squares.insert({r * kSlopeStride / kSlopeSquare, c * kSlopeStride / kSlopeSquare});
    }
  }
  SlopeCorrelation found = sums.correlation();
  found.squares = static_cast<int>(squares.size());
  return found;
}

/// In px between neighboring views.
double search_range(const CoarseMotion& coarse, const Progress& progress) {
  const int smaller = std::visit(
      [](const auto& stack) { return std::min(stack.width(), stack.height()); }, coarse.samples());
  const double usual = std::clamp(smaller / 48.0, 3.0, 16.0);
  const auto [u, v] =
      along_both_axes(progress, [&](bool is_v) { return coarse.largest(is_v, usual, progress); });
  return std::clamp(std::max(u, v), usual, kMostSlope);
}

bool is_better(const SlopeCorrelation& next, const SlopeCorrelation& found) {
  if (next.is_decided() != found.is_decided()) return next.is_decided();
  return std::abs(next.value) * std::min(next.points, 30) >
         std::abs(found.value) * std::min(found.points, 30);
}

}  // namespace

bool SlopeCorrelation::is_decided() const {
  return points >= 30 && std::abs(value) > 0.2 &&
         std::abs(value) * std::sqrt(squares) > kSignificantSlopes;
}

SlopeCorrelation correlate_epi_slopes(const CoarseMotion& coarse, const Progress& progress) {
  const LightField::Samples& samples = coarse.samples();
  return std::visit(
      [&](const auto& stack) {
        const ViewIndex center = stack.grid().center();
        const int reach = std::min(
            {center.v, center.u, stack.grid().v - 1 - center.v, stack.grid().u - 1 - center.u});
        SlopeCorrelation found;
        const double range = search_range(coarse, progress);
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
