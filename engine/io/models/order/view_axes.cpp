// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/order/view_axes.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/numbers.h"
#include "engine/core/text_table.h"
#include "engine/io/models/open_options.h"
#include "engine/io/models/order/line_matches.h"
#include "engine/io/models/order/warp_check.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace episcope::io {
namespace {

constexpr int kMatchedBlock = 12;

/// Blocks side by side that no shift moves out of the picture.
struct Blocks {
  int rows = 0;
  int columns = 0;
  int margin = 0;

  Blocks(const Image<float>& picture, int range)
      : rows(std::max(picture.height() - 2 * range, 0) / kMatchedBlock),
        columns(std::max(picture.width() - 2 * range, 0) / kMatchedBlock),
        margin(range) {}
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(rows) * columns; }
};

/// What is left of every block, as the root of its mean square, when `other` is moved by whole
/// pixels (dy, dx), of which one is 0, and along the axis by up to a pixel more: to first order,
/// with the gradient of `other`.
std::vector<float> left_over(const Image<float>& one, const Image<float>& other,
                             const Blocks& blocks, PixelIndex shift, bool is_x) {
  struct Sums {
    float squares = 0, products = 0, gradients = 0;
  };
  std::vector<Sums> sums(blocks.count());
  for (int y = 0; y < blocks.rows * kMatchedBlock; ++y) {
    const int at = y + blocks.margin + shift.y;
    const float* a = one.row(y + blocks.margin) + blocks.margin;
    const float* b = other.row(at) + blocks.margin + shift.x;
    const float* next = is_x ? b + 1 : other.row(at + 1) + blocks.margin + shift.x;
    const float* last = is_x ? b - 1 : other.row(at - 1) + blocks.margin + shift.x;
    for (int k = 0; k < blocks.columns; ++k) {
      Sums row;
      for (int x = k * kMatchedBlock; x < (k + 1) * kMatchedBlock; ++x) {
        const float difference = a[x] - b[x];
        const float gradient = 0.5F * (next[x] - last[x]);
        row.squares += difference * difference;
        row.products += difference * gradient;
        row.gradients += gradient * gradient;
      }
      Sums& block = sums[static_cast<std::size_t>(y / kMatchedBlock) * blocks.columns + k];
      block.squares += row.squares;
      block.products += row.products;
      block.gradients += row.gradients;
    }
  }
  std::vector<float> left(sums.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    const Sums& block = sums[i];
    const float more =
        block.gradients > 0 ? std::clamp(block.products / block.gradients, -1.0F, 1.0F) : 0.0F;
    const float rest = block.squares - 2 * more * block.products + more * more * block.gradients;
    left[i] = std::sqrt(std::max(rest, 0.0F) / (kMatchedBlock * kMatchedBlock));
  }
  return left;
}

std::vector<float> unmoved_difference(const Image<float>& one, const Image<float>& other,
                                      const Blocks& blocks) {
  std::vector<float> sums(blocks.count());
  for (int y = 0; y < blocks.rows * kMatchedBlock; ++y) {
    for (int x = 0; x < blocks.columns * kMatchedBlock; ++x) {
      const float difference = one.at(y + blocks.margin, x + blocks.margin) -
                               other.at(y + blocks.margin, x + blocks.margin);
      sums[static_cast<std::size_t>(y / kMatchedBlock) * blocks.columns + x / kMatchedBlock] +=
          difference * difference;
    }
  }
  for (float& sum : sums) sum = std::sqrt(sum / (kMatchedBlock * kMatchedBlock));
  return sums;
}

void keep_smaller(std::vector<float>& best, const std::vector<float>& more) {
  for (std::size_t i = 0; i < best.size(); ++i) best[i] = std::min(best[i], more[i]);
}

void add_pair(const Image<float>& one, const Image<float>& other, int range,
              AxisEvidence::Sums& sums) {
  // The gradient reaches one pixel further.
  const Blocks blocks(one, range + 1);
  const std::vector<float> unmoved = unmoved_difference(one, other, blocks);
  std::vector<float> along_x = unmoved;
  std::vector<float> along_y = unmoved;
  for (int shift = -range; shift <= range; ++shift) {
    keep_smaller(along_x, left_over(one, other, blocks, {0, shift}, true));
    keep_smaller(along_y, left_over(one, other, blocks, {shift, 0}, false));
  }
  for (std::size_t i = 0; i < blocks.count(); ++i) {
    const double difference = along_y[i] - along_x[i];
    sums.blocks += 1;
    sums.unmoved += unmoved[i];
    sums.along_x += along_x[i];
    sums.along_y += along_y[i];
    sums.squares += difference * difference;
  }
}

}  // namespace

double AxisEvidence::Sums::score() const {
  if (blocks < 2 || squares == 0) return 0;
  const double mean = (along_y - along_x) / blocks;
  const double variance = std::max(squares / blocks - mean * mean, 1e-12);
  return mean / std::sqrt(variance / blocks);
}

void AxisEvidence::add(const MotionPictures& one, const MotionPictures& other) {
  add_pair(one.scales[0], other.scales[0], 6, scales_[0]);
  add_pair(one.scales[1], other.scales[1], 12, scales_[1]);
}

const AxisEvidence::Sums& AxisEvidence::clearest() const {
  return std::abs(scales_[0].score()) >= std::abs(scales_[1].score()) ? scales_[0] : scales_[1];
}

double AxisEvidence::gone_along_x() const {
  const Sums& sums = clearest();
  return sums.unmoved > 0 ? 1 - sums.along_x / sums.unmoved : 0;
}

double AxisEvidence::gone_along_y() const {
  const Sums& sums = clearest();
  return sums.unmoved > 0 ? 1 - sums.along_y / sums.unmoved : 0;
}

double AxisEvidence::score() const {
  return clearest().score();
}

bool AxisEvidence::is_x() const {
  return score() > 5 && gone_along_x() > 1.25 * gone_along_y();
}

bool AxisEvidence::is_y() const {
  return score() < -5 && gone_along_y() > 1.25 * gone_along_x();
}

namespace {

constexpr int kFarthestNeighbour = 8;
/// Swapping axes against what names or files say takes more than looking at them.
constexpr double kWithoutDoubt = 8;
/// Of views of a line: those beside the center, and as many as are looked at in doubt.
constexpr int kNextPairs = 2, kMostPairs = 8;

/// The views of the line along an axis through the center of the grid.
class ViewLine {
 public:
  ViewLine(const LightField::Samples& samples, bool is_v) : samples_(samples), is_v_(is_v) {}

  [[nodiscard]] int count() const { return is_v_ ? grid_.v : grid_.u; }
  /// Of up to `most` pairs of views `step` apart, from the center outwards.
  [[nodiscard]] AxisEvidence evidence(int step, int most) {
    AxisEvidence sum;
    for (int i = 0; i < most; ++i) {
      const int steps_out = i % 2 == 0 ? -1 - i / 2 : i / 2;
      const int place = (is_v_ ? center_.v : center_.u) + steps_out * step;
      if (place >= 0 && place + step < count()) sum.add(picture(place), picture(place + step));
    }
    return sum;
  }

 private:
  const MotionPictures& picture(int place) {
    const auto [found, is_new] = pictures_.try_emplace(place);
    const ViewIndex view = is_v_ ? ViewIndex{place, center_.u} : ViewIndex{center_.v, place};
    if (is_new) found->second = MotionPictures(grey_levels(samples_, view));
    return found->second;
  }

  const LightField::Samples& samples_;
  bool is_v_;
  GridShape grid_ = grid_of(samples_);
  ViewIndex center_ = grid_.center();
  std::map<int, MotionPictures> pictures_;
};

AxisEvidence evidence_along(const LightField::Samples& samples, bool is_v,
                            const Progress& progress) {
  ViewLine line(samples, is_v);
  AxisEvidence clearest;
  for (const int pairs : {kNextPairs, kMostPairs}) {
    for (int step = 1; step <= kFarthestNeighbour && step < line.count(); step *= 2) {
      progress.check();
      const AxisEvidence evidence = line.evidence(step, pairs);
      if (std::abs(evidence.score()) > std::abs(clearest.score())) clearest = evidence;
      if (clearest.is_decided() && std::abs(clearest.score()) > kWithoutDoubt) return clearest;
    }
  }
  return clearest;
}

template <class T>
void swap_axes(ViewStack<T>& stack) {
  if (stack.empty()) return;
  if (stack.kind() == LargeKind::File) return stack.transpose_in_place();
  const GridShape grid = stack.grid();
  const ViewIndex first = stack.first();
  if (grid.u == grid.v && first.u == first.v) {
    for (int v = 0; v < grid.v; ++v) {
      for (int u = 0; u < v; ++u) {
        T* a = stack.view({first.v + v, first.u + u}).data;
        T* b = stack.view({first.v + u, first.u + v}).data;
        std::swap_ranges(a, a + stack.view_size(), b);
      }
    }
    return;
  }
  ViewStack<T> swapped({grid.u, grid.v}, stack.height(), stack.width(), stack.channels(),
                       {first.u, first.v});
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = stack.view_at(i);
    std::copy_n(stack.view(view).data, stack.view_size(), swapped.view({view.u, view.v}).data);
  }
  stack = std::move(swapped);
}

std::string share_text(const char* which, const AxisEvidence& evidence) {
  return fmt::format("between {} {} % of the difference is motion along x and {} % along y", which,
                     fixed_text(100 * evidence.gone_along_x(), 0),
                     fixed_text(100 * evidence.gone_along_y(), 0));
}

}  // namespace

double ViewAxes::score() const {
  const int axes = (along_u.has_pairs() ? 1 : 0) + (along_v.has_pairs() ? 1 : 0);
  return axes > 0 ? (along_u.score() - along_v.score()) / std::sqrt(axes) : 0;
}

bool ViewAxes::are_straight() const {
  return (along_u.is_x() || along_v.is_y()) && !along_u.is_y() && !along_v.is_x();
}

bool ViewAxes::are_crossed() const {
  return (along_u.is_y() || along_v.is_x()) && !along_u.is_x() && !along_v.is_y();
}

bool ViewAxes::are_unclear() const {
  return is_grid && !are_straight() && !are_swapped();
}

bool ViewAxes::are_swapped() const {
  const bool has_both =
      (along_u.is_y() || !along_u.has_pairs()) && (along_v.is_x() || !along_v.has_pairs());
  return has_both && score() < -kWithoutDoubt;
}

std::string ViewAxes::evidence() const {
  std::string text;
  if (along_u.has_pairs()) text = share_text("columns", along_u);
  if (along_u.has_pairs() && along_v.has_pairs()) text += ", ";
  if (along_v.has_pairs()) text += share_text("rows", along_v);
  return text;
}

ViewAxes find_view_axes(const LightField::Samples& samples, const Progress& progress) {
  const auto [u, v] =
      along_both_axes(progress, [&](bool is_v) { return evidence_along(samples, is_v, progress); });
  const GridShape grid = grid_of(samples);
  return {u, v, grid.v > 1 && grid.u > 1};
}

void swap_view_axes(LightField::Samples& samples) {
  std::visit([](auto& stack) { swap_axes(stack); }, samples);
}

void swap_view_axes(ViewStack<std::uint8_t>& stack) {
  swap_axes(stack);
}

void swap_view_axes(ViewStack<std::int32_t>& stack) {
  swap_axes(stack);
}

void swap_view_axes(DisparityField& field) {
  swap_axes(field.disparity);
  swap_axes(field.valid);
}

void swap_view_axes(GroundTruth& truth) {
  swap_view_axes(truth.field);
  swap_view_axes(truth.foreground);
  swap_view_axes(truth.background);
  swap_axes(truth.labels);
}

void swap_view_axes(std::vector<CameraPosition>& positions, GridShape stored) {
  if (positions.size() != static_cast<std::size_t>(stored.count())) return;
  std::vector<CameraPosition> swapped;
  for (int u = 0; u < stored.u; ++u) {
    for (int v = 0; v < stored.v; ++v) {
      swapped.push_back(positions[static_cast<std::size_t>(v * stored.u + u)]);
    }
  }
  positions = std::move(swapped);
}

namespace {

constexpr int kSide = 512;
constexpr int kMotionSquare = 16;
constexpr int kRange = 8;
constexpr int kFewestMotionSquares = 12;
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
  for (int row = top; row < top + kMotionSquare; ++row) {
    for (int column = left; column < left + kMotionSquare; ++column) {
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
  constexpr double kCount = kMotionSquare * kMotionSquare;
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
  for (int y = 1; y + kMotionSquare < a.height(); y += kMotionSquare) {
    for (int x = kMargin; x + kMotionSquare + kMargin <= a.width(); x += kMotionSquare) {
      const auto motion = motion_of(a, b, y, x);
      if (!motion) continue;
      along.push_back(static_cast<float>(std::abs(motion->x)));
      across.push_back(static_cast<float>(std::abs(motion->y)));
    }
  }
  const auto squares = static_cast<int>(along.size());
  if (squares < kFewestMotionSquares) return {0, 0, step, squares};
  return {quantile(along, 0.5), quantile(across, 0.5), step, squares};
}

}  // namespace

bool LineMotion::is_askew() const {
  return across > kLeast_px && across > kShare * along;
}

std::string LineMotion::warning() const {
  return fmt::format(finding_text("order.line"), across, step, along);
}

LineMotion measure_line_motion(const LightField::Samples& samples, const Progress& progress) {
  const int count = grid_of(samples).count();
  const int center = count / 2;
  const Image<float> middle = picture_of(samples, center);
  LineMotion motion;
  for (int step = 1; step <= kFarthestNeighbour && step <= center; step *= 2) {
    progress.check();
    motion = motion_between(middle, picture_of(samples, center - step), step);
    if (motion.along > kEnough_px || motion.across > kEnough_px) break;
  }
  return motion;
}

namespace {

/// Change from one end of the grid to the other, summed over rows or columns.
CameraPosition change(const std::vector<CameraPosition>& positions, GridShape grid, bool is_u) {
  CameraPosition sum;
  const int lines = is_u ? grid.v : grid.u;
  for (int i = 0; i < lines; ++i) {
    const int first = is_u ? i * grid.u : i;
    const int last = is_u ? first + grid.u - 1 : (grid.v - 1) * grid.u + i;
    const CameraPosition& a = positions[static_cast<std::size_t>(first)];
    const CameraPosition& b = positions[static_cast<std::size_t>(last)];
    sum.x += b.x - a.x;
    sum.y += b.y - a.y;
  }
  return sum;
}

std::string direction(const char* name, CameraPosition change) {
  const bool is_x = std::abs(change.x) >= std::abs(change.y);
  const double along = is_x ? change.x : change.y;
  if (along == 0 || !std::isfinite(along)) return {};
  return std::string("camera ") + name + (along > 0 ? " = larger " : " = smaller ") +
         (is_x ? "X" : "Y");
}

}  // namespace

void reverse_positions(std::vector<CameraPosition>& positions, GridShape grid, ViewFlip flip) {
  if (positions.size() != static_cast<std::size_t>(grid.count())) return;
  std::vector<CameraPosition> moved;
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex from = flipped(grid.view_at(i), grid, flip);
    moved.push_back(positions[static_cast<std::size_t>(from.v * grid.u + from.u)]);
  }
  positions = std::move(moved);
}

std::string position_directions(const std::vector<CameraPosition>& positions, GridShape grid) {
  if (positions.size() != static_cast<std::size_t>(grid.count())) return {};
  const std::string right = direction("right", change(positions, grid, true));
  const std::string down = direction("down", change(positions, grid, false));
  return right.empty() || down.empty() ? right + down : right + ", " + down;
}

namespace {

bool holds(const ViewCrop& crop, ViewIndex stored) {
  return crop.kept.contains({stored.v - crop.first.v, stored.u - crop.first.u});
}

}  // namespace

ViewCrop parse_crop(const std::string& text, GridShape stored) {
  const GridShape kept = parse_grid(text);
  if (kept.v > stored.v || kept.u > stored.u) {
    throw InvalidInput(
        fmt::format("--crop {} asks for more than the {} views that there are; give "
                    "a smaller grid, or all",
                    text, grid_text(stored)));
  }
  return central_crop(stored, kept);
}

void crop_truth(GroundTruth& truth, const ViewCrop& crop) {
  for (DisparityField* field : {&truth.field, &truth.foreground, &truth.background}) {
    field->disparity = cropped(std::move(field->disparity), crop);
    field->valid = cropped(std::move(field->valid), crop);
  }
  truth.labels = cropped(std::move(truth.labels), crop);
}

Scribbles cropped(Scribbles scribbles, const ViewCrop& crop) {
  std::erase_if(scribbles.views, [&](const ViewScribbles& one) { return !holds(crop, one.view); });
  for (ViewScribbles& one : scribbles.views) {
    one.view = {one.view.v - crop.first.v, one.view.u - crop.first.u};
  }
  return scribbles;
}

Scribbles uncropped(Scribbles scribbles, Scribbles before, const ViewCrop& crop) {
  for (ViewScribbles& one : scribbles.views) {
    one.view = {one.view.v + crop.first.v, one.view.u + crop.first.u};
  }
  for (ViewScribbles& one : before.views) {
    if (!holds(crop, one.view)) scribbles.views.push_back(std::move(one));
  }
  std::ranges::sort(scribbles.views, {},
                    [](const ViewScribbles& one) { return std::pair(one.view.v, one.view.u); });
  return scribbles;
}

}  // namespace episcope::io
