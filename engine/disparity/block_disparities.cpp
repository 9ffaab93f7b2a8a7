// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/block_disparities.h"

#include "engine/core/image.h"
#include "engine/core/parallel.h"
#include "engine/disparity/matching_cost.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

namespace episcope {
namespace {

// Means of blocks of one view.
void reduce(const LightField& lf, ViewIndex view, int factor, ImageView<std::uint16_t> out) {
  const int channels = lf.channels(), width = out.width * factor;
  const float scale = 65535.0F / static_cast<float>(factor * factor);
  std::vector<float> row(static_cast<std::size_t>(width) * channels);
  std::vector<float> sums(static_cast<std::size_t>(out.width) * channels);
  for (int y = 0; y < out.height; ++y) {
    std::ranges::fill(sums, 0.0F);
    for (int dy = 0; dy < factor; ++dy) {
      lf.read_row(view, y * factor + dy, 0, width, row.data());
      for (int x = 0; x < width; ++x) {
        float* const sum = sums.data() + static_cast<std::size_t>(x / factor) * channels;
        for (int c = 0; c < channels; ++c)
          sum[c] += row[static_cast<std::size_t>(x) * channels + c];
      }
    }
    std::uint16_t* const to = out.row(y);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const float clamped = std::clamp(sums[i] * scale, 0.0F, 65535.0F);
      to[i] = static_cast<std::uint16_t>(clamped + 0.5F);
    }
  }
}

void reduce_valid(const LightField& lf, ViewIndex view, int factor, ImageView<std::uint8_t> out) {
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      bool is_valid = true;
      for (int i = 0; i < factor * factor; ++i) {
        is_valid = is_valid && lf.is_valid(view, y * factor + i / factor, x * factor + i % factor);
      }
      out.at(y, x) = is_valid ? 1 : 0;
    }
  }
}

// Side of a cell, px, and sides of blocks, cells.
constexpr int kCell = 4;
constexpr std::array<int, 2> kSides{1, 2};
constexpr double kBlockLabelStep = 0.125;
// Labels nearer to the best one than that do not compete with it, px per view step.
constexpr float kBlockApart = 0.75F;
// A block of n pixels is distinct where the next best label costs 1 + kDistinct/n times as much,
// and doubts labels that cost up to 1 + kDoubt/n times as much.
constexpr float kDistinct = 24;
constexpr float kDoubt = 0.8F;
// Share of the views that must see a block.
constexpr float kSeen = 0.25F;
// Noise that is always there: a tenth of a gray value.
constexpr float kNoise = 0.1F / 255;

// Samples of a view, one channel below the other; NaN where they are not valid.
Image<float> channel_planes(const LightField& lf, ViewIndex view) {
  const int channels = lf.channels();
  Image<float> planes(channels * lf.height(), lf.width());
  std::vector<float> row(static_cast<std::size_t>(lf.width()) * channels);
  for (int y = 0; y < lf.height(); ++y) {
    lf.read_row(view, y, 0, lf.width(), row.data());
    for (int x = 0; x < lf.width(); ++x) {
      const bool is_valid = lf.is_valid(view, y, x);
      for (int c = 0; c < channels; ++c) {
        planes.at(c * lf.height() + y, x) = is_valid
                                                ? row[static_cast<std::size_t>(x) * channels + c]
                                                : std::numeric_limits<float>::quiet_NaN();
      }
    }
  }
  return planes;
}

// Where a view is sampled: between the pixels `y`, `x` and `y + dy`, `x + dx` further, and which
// pixels [first, end) have both.
struct SamplePlace {
  int y = 0, x = 0, dy = 0, dx = 0;
  float weight = 0;  // of the second
};

SamplePlace sample_place(double y, double x) {
  SamplePlace offset{static_cast<int>(std::floor(y)), static_cast<int>(std::floor(x))};
  const double fraction_y = y - offset.y, fraction_x = x - offset.x;
  offset.dy = fraction_y > 0 ? 1 : 0;
  offset.dx = fraction_x > 0 ? 1 : 0;
  offset.weight = static_cast<float>(fraction_y + fraction_x);
  return offset;
}

// Cells [begin, end) of an axis whose pixels all have samples.
std::pair<int, int> cells_within(int extent, int offset, int more) {
  const int first = std::max(0, -offset), end = std::min(extent, extent - offset - more);
  return {(first + kCell - 1) / kCell, std::max(end, 0) / kCell};
}

// Sums over the pixels of cells, `[y][x]`; of the differences channel below channel.
struct CellSums {
  Image<float> squares;
  Image<float> differences;
};

// Compares the center view with the other views of its row and column.
class BlockMatching {
 public:
  explicit BlockMatching(const LightField& lf)
      : channels_(lf.channels()), height_(lf.height()), center_(channel_planes(lf, lf.center())) {
    const ViewIndex center = lf.center();
    const auto add = [&](ViewIndex view) {
      if (view == center) return;
      views_.push_back({channel_planes(lf, view), view.v - center.v, view.u - center.u});
    };
    for (int u = 0; u < lf.grid().u; ++u) add({center.v, u});
    for (int v = 0; v < lf.grid().v; ++v) add({v, center.u});
  }

  [[nodiscard]] int cell_rows() const { return height_ / kCell; }
  [[nodiscard]] int cell_columns() const { return center_.width() / kCell; }
  /// Of blocks of `side` cells, one cell apart.
  [[nodiscard]] int count(int side) const {
    return std::max(cell_rows() - side + 1, 0) * std::max(cell_columns() - side + 1, 0);
  }

  /// The cost of every block of each size at a label; NaN where too few views see it.
  [[nodiscard]] std::array<std::vector<float>, kSides.size()> costs(float label) const {
    std::array<std::vector<float>, kSides.size()> costs, seen;
    for (std::size_t i = 0; i < kSides.size(); ++i) {
      costs[i].resize(count(kSides[i]));
      seen[i].resize(costs[i].size());
    }
    CellSums sums{Image<float>(cell_rows(), cell_columns()),
                  Image<float>(channels_ * cell_rows(), cell_columns())};
    for (const View& view : views_) {
      compare(view, label, sums);
      for (std::size_t i = 0; i < kSides.size(); ++i) {
        add_blocks(sums, kSides[i], costs[i].data(), seen[i].data());
      }
    }
    const float enough = kSeen * static_cast<float>(views_.size());
    for (std::size_t i = 0; i < kSides.size(); ++i) {
      for (std::size_t block = 0; block < costs[i].size(); ++block) {
        costs[i][block] = seen[i][block] >= enough ? costs[i][block] / seen[i][block]
                                                   : std::numeric_limits<float>::quiet_NaN();
      }
    }
    return costs;
  }

 private:
  struct View {
    Image<float> planes;
    int down = 0, right = 0;  // steps from the center
  };

  // The point of pixel (x, y) is seen at x − d·right, y − d·down. Cells that are not NaN lie within
  // the view.
  void compare(const View& view, float label, CellSums& sums) const {
    std::fill_n(sums.squares.row(0), sums.squares.size(), std::numeric_limits<float>::quiet_NaN());
    const SamplePlace offset = sample_place(-label * view.down, -label * view.right);
    const auto [first_row, end_row] = cells_within(height_, offset.y, offset.dy);
    const auto [first, end] = cells_within(center_.width(), offset.x, offset.dx);
    Image<float> columns(2, center_.width());
    for (int row = first_row; row < end_row && first < end; ++row) {
      std::fill(sums.squares.row(row) + first, sums.squares.row(row) + end, 0.0F);
      for (int c = 0; c < channels_; ++c) {
        std::fill_n(columns.row(0), columns.size(), 0.0F);
        for (int y = row * kCell; y < (row + 1) * kCell; ++y) {
          add_differences(view.planes, offset, c * height_ + y, first * kCell, end * kCell,
                          columns);
        }
        float* const differences = sums.differences.row(c * cell_rows() + row);
        for (int cell = first; cell < end; ++cell) {
          differences[cell] = sum_of_cell(columns.row(0), cell);
          sums.squares.at(row, cell) += sum_of_cell(columns.row(1), cell);
        }
      }
    }
  }

  static float sum_of_cell(const float* columns, int cell) {
    const float* const begin = columns + static_cast<std::ptrdiff_t>(cell) * kCell;
    return std::accumulate(begin, begin + kCell, 0.0F);
  }

  // Adds the differences of pixels [begin, end) of a row, and their squares, to those above.
  void add_differences(const Image<float>& planes, const SamplePlace& offset, int y, int begin,
                       int end, Image<float>& columns) const {
    const float* const near = planes.row(y + offset.y) + offset.x;
    const float* const next = planes.row(y + offset.y + offset.dy) + offset.x + offset.dx;
    const float* const own = center_.row(y);
    const float weight = offset.weight;
    float* const sums = columns.row(0);
    float* const squares = columns.row(1);
    for (int x = begin; x < end; ++x) {
      const float difference = near[x] + weight * (next[x] - near[x]) - own[x];
      sums[x] += difference;
      squares[x] += difference * difference;
    }
  }

  // Adds the variance of the differences in each block that the view shows.
  void add_blocks(const CellSums& sums, int side, float* costs, float* seen) const {
    const int count = cell_columns() - side + 1;
    if (count <= 0) return;
    const float share = 1 / static_cast<float>(side * side * kCell * kCell);
    std::vector<float> variance(count), sum(count);
    const auto add_cells = [&](const Image<float>& cells, int first_row, std::vector<float>& to) {
      std::ranges::fill(to, 0.0F);
      for (int i = 0; i < side * side; ++i) {
        const float* const from = cells.row(first_row + i / side) + i % side;
        for (int column = 0; column < count; ++column) to[column] += from[column];
      }
    };
    for (int row = 0; row + side <= cell_rows(); ++row, costs += count, seen += count) {
      add_cells(sums.squares, row, variance);
      for (int c = 0; c < channels_; ++c) {
        add_cells(sums.differences, c * cell_rows() + row, sum);
        for (int i = 0; i < count; ++i) variance[i] -= share * sum[i] * sum[i];
      }
      for (int i = 0; i < count; ++i) {
        const bool is_seen = !std::isnan(variance[i]);
        costs[i] += is_seen ? std::max(variance[i], 0.0F) * share : 0;
        seen[i] += is_seen ? 1 : 0;
      }
    }
  }

  int channels_, height_;
  Image<float> center_;
  std::vector<View> views_;
};

// Reads the disparity off the costs of a block of `pixels`; false if it does not match distinctly.
bool read_disparity(const std::vector<float>& labels, const std::vector<float>& costs, int pixels,
                    BlockDisparity& found) {
  const int last = static_cast<int>(labels.size()) - 1;
  int best = -1;
  for (int l = 0; l <= last; ++l) {
    if (!std::isnan(costs[l]) && (best < 0 || costs[l] < costs[best])) best = l;
  }
  if (best <= 0 || best == last) return false;
  const float least = costs[best], before = costs[best - 1], after = costs[best + 1];
  const float bend = before - 2 * least + after;
  float next = std::numeric_limits<float>::infinity();
  for (int l = 0; l <= last; ++l) {
    const bool competes = std::fabs(labels[l] - labels[best]) >= kBlockApart;
    if (competes && !std::isnan(costs[l])) next = std::min(next, costs[l]);
  }
  if (!(bend > 0) || !std::isfinite(next)) return false;
  const auto n = static_cast<float>(pixels);
  if (next <= (1 + kDistinct / n) * least) return false;
  const float step = labels[1] - labels[0];
  found = {labels[best] + step * 0.5F * (before - after) / bend,
           step * std::sqrt(kDoubt / n * least / (0.5F * bend))};
  return true;
}

// Blocks are matched in views of at least this side, px, and in such of half of it.
constexpr int kBlockViews = 96;
constexpr int kLevels = 2;
constexpr int kSmallestHalved = 64;
// So many blocks of a kind make an end of the range.
constexpr std::size_t kAgreeing = 4;
// How far beyond what is seen blocks are matched, px of the views in which they are.
constexpr double kBeyondSeen = 1;

std::optional<Interval> united(const std::optional<Interval>& a, const std::optional<Interval>& b) {
  if (!a || !b) return a ? a : b;
  return united(*a, *b);
}

// The least range that a few blocks, whatever their doubts, reach at either end.
std::optional<Interval> ends_of(const std::vector<BlockDisparity>& blocks) {
  if (blocks.size() < kAgreeing) return {};
  std::vector<double> highest, lowest;
  for (const BlockDisparity& block : blocks) {
    highest.push_back(block.disparity + block.doubt);
    lowest.push_back(block.disparity - block.doubt);
  }
  const auto nth = static_cast<std::ptrdiff_t>(kAgreeing) - 1;
  std::ranges::nth_element(highest, highest.begin() + nth);
  std::ranges::nth_element(lowest, lowest.begin() + nth, std::greater());
  return Interval{std::min(highest[nth], lowest[nth]), std::max(highest[nth], lowest[nth])};
}

// Of views `factor` times smaller than those of the range, and of `levels` − 1 smaller ones.
std::optional<Interval> range_of_levels(const LightField& lf, int factor, double limit,
                                        std::optional<Interval> seen, int levels,
                                        const Progress& progress) {
  std::optional<Interval> range;
  if (levels > 1 && std::min(lf.height(), lf.width()) >= kSmallestHalved) {
    const LightField smaller = smaller_views(lf, 2, progress.part(0, 0.1));
    range = range_of_levels(smaller, 2 * factor, limit, seen, levels - 1, progress.part(0.1, 0.4));
  }
  const Interval all{-limit / factor, limit / factor};
  Interval searched = all;
  if (const auto known = united(seen, range)) {
    searched = clipped(grown({known->min / factor, known->max / factor}, kBeyondSeen), all);
  }
  for (const auto& blocks : block_disparities(lf, searched, progress.part(0.4, 1))) {
    const std::optional<Interval> ends = ends_of(blocks);
    if (ends) range = united(range, Interval{factor * ends->min, factor * ends->max});
  }
  return range;
}

}  // namespace

LightField smaller_views(const LightField& lf, int factor, const Progress& progress,
                         ReducedViews reduced) {
  const GridShape grid = lf.grid();
  const int height = lf.height() / factor, width = lf.width() / factor;
  ViewStack<std::uint16_t> samples(grid, height, width, lf.channels(), {}, allocate_large_zeros);
  ViewStack<std::uint8_t> valid;
  if (!lf.valid().empty()) valid = ViewStack<std::uint8_t>(grid, height, width);
  parallel_for(grid.count(), progress, [&](int i) {
    const ViewIndex view = samples.view_at(i), center = lf.center();
    if (reduced == ReducedViews::All || view.v == center.v || view.u == center.u) {
      reduce(lf, view, factor, samples.view(view));
    }
    if (!valid.empty()) reduce_valid(lf, view, factor, valid.view(view));
    lf.forget_samples();
  });
  return {std::move(samples), LightFieldInfo(), std::move(valid)};
}

std::vector<std::vector<BlockDisparity>> block_disparities(const LightField& lf, Interval range,
                                                           const Progress& progress) {
  check_matching(lf, lf.center());
  const BlockMatching matching(lf);
  const int steps = static_cast<int>(std::ceil(range.length() / kBlockLabelStep));
  const std::vector<float> labels = equidistant_labels(range, std::max(steps, 2) + 1);
  const int count = static_cast<int>(labels.size());
  std::vector<std::array<std::vector<float>, kSides.size()>> costs(count);
  parallel_for(count, progress, [&](int l) { costs[l] = matching.costs(labels[l]); });
  std::vector<std::vector<BlockDisparity>> found(kSides.size());
  const float noise = kNoise * kNoise * static_cast<float>(lf.channels());
  std::vector<float> of_block(count);
  for (std::size_t i = 0; i < kSides.size(); ++i) {
    const int pixels = kSides[i] * kSides[i] * kCell * kCell;
    for (int block = 0; block < matching.count(kSides[i]); ++block) {
      for (int l = 0; l < count; ++l) of_block[l] = costs[l][i][block] + noise;
      BlockDisparity disparity;
      if (read_disparity(labels, of_block, pixels, disparity)) found[i].push_back(disparity);
    }
  }
  return found;
}

std::optional<Interval> certain_range(const LightField& lf, double limit,
                                      std::optional<Interval> seen, const Progress& progress) {
  int factor = 1;
  while (std::min(lf.height(), lf.width()) >= 2 * factor * kBlockViews) factor *= 2;
  if (factor == 1) return range_of_levels(lf, 1, limit, seen, kLevels, progress);
  return range_of_levels(smaller_views(lf, factor, progress.part(0, 0.3)), factor, limit, seen,
                         kLevels, progress.part(0.3, 1));
}

}  // namespace episcope
