// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/kernels/matching_kernel.h"

#include "engine/core/simd.h"

// Compiled once for each instruction set: see engine/core/isa.h for what may stand here.

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

// Lanes 0, 1, 2 … as numbers.
inline Vec lane_numbers() {
  Vec numbers;
  for (int i = 0; i < kLanes; ++i) numbers[i] = static_cast<float>(i);
  return numbers;
}

template <int kTaps>
inline Vec weigh(const float* samples, long step, const Vec* weights) {
  if constexpr (kTaps == 1) return load(samples);
  Vec sum = weights[0] * load(samples);
  for (int i = 1; i < kTaps; ++i) sum += weights[i] * load(samples + i * step);
  return sum;
}

// A row of samples interpolated between rows, with all its taps along x.
template <int kTaps>
void interpolate_rows(const float* samples, long pitch, const float* weights, int count,
                      float* line) {
  Vec w[kTaps];
  for (int i = 0; i < kTaps; ++i) w[i] = splat(weights[i]);
  for (int x = 0; x < count; x += kLanes) store(line + x, weigh<kTaps>(samples + x, pitch, w));
}

// Samples of the other view for one row: from its rows as they are, or from the scratch lines.
struct Line {
  const float* samples[3];
  const float* reference[3];
  const float* noise;
  float* costs;
  float* seen;
  const float* nearest;
  const float* caps;
};

Line make_line(const MatchingTile& tile, int y) {
  Line line{};
  line.costs = tile.costs + y * tile.cost_pitch;
  line.seen = tile.seen ? tile.seen + y * tile.cost_pitch : nullptr;
  line.noise = tile.noise + static_cast<long>(y) * tile.reference_pitch;
  if (tile.nearest) {
    line.nearest = tile.nearest + static_cast<long>(y) * tile.sample_pitch;
    line.caps = tile.caps + static_cast<long>(y) * tile.reference_pitch;
  }
  for (int c = 0; c < tile.channels; ++c) {
    const float* row = tile.samples[c] + static_cast<long>(y) * tile.sample_pitch;
    line.reference[c] = tile.reference[c] + static_cast<long>(y) * tile.reference_pitch;
    line.samples[c] = row;
    if (tile.row_taps == 1) continue;
    float* scratch = tile.lines + static_cast<long>(c) * tile.line_pitch;
    const int count = tile.columns + tile.column_taps - 1;
    if (tile.row_taps == 2) {
      interpolate_rows<2>(row, tile.sample_pitch, tile.row_weights, count, scratch);
    } else {
      interpolate_rows<4>(row, tile.sample_pitch, tile.row_weights, count, scratch);
    }
    line.samples[c] = scratch;
  }
  return line;
}

template <int kTaps, int kChannels>
inline Vec distance(const Line& line, int x, const Vec* weights, Vec noise_lost) {
  Vec sum = noise_lost * load(line.noise + x);
  for (int c = 0; c < kChannels; ++c) {
    const Vec difference =
        weigh<kTaps>(line.samples[c] + x, 1, weights) - load(line.reference[c] + x);
    sum += difference * difference;
  }
  return square_root(sum);
}

// Which lanes from x on are columns that the view sees.
inline IntVec in_columns(const MatchingTile& tile, Vec numbers, int x) {
  const Vec column = numbers + static_cast<float>(x);
  return (column >= static_cast<float>(tile.first_column)) &
         (column < static_cast<float>(tile.last_column));
}

template <int kTaps, int kChannels>
void add_line(const MatchingTile& tile, const Line& line) {
  Vec weights[kTaps];
  for (int i = 0; i < kTaps; ++i) weights[i] = splat(tile.column_weights[i]);
  const Vec lost = splat(tile.noise_lost), cap = splat(tile.cap);
  const bool whole = tile.first_column == 0 && tile.last_column == tile.columns;
  if (whole) {
    for (int x = 0; x < tile.columns; x += kLanes) {
      const Vec cost = least(distance<kTaps, kChannels>(line, x, weights, lost), cap);
      store(line.costs + x, load(line.costs + x) + cost);
    }
    return;
  }
  const Vec numbers = lane_numbers();
  for (int x = tile.first_column / kLanes * kLanes; x < tile.last_column; x += kLanes) {
    const Vec cost = least(distance<kTaps, kChannels>(line, x, weights, lost), cap);
    const IntVec seen = in_columns(tile, numbers, x);
    store(line.costs + x, load(line.costs + x) + choose(seen, cost, Vec{}));
  }
}

// With a count of what is not NaN.
template <int kTaps, int kChannels>
void add_known(const MatchingTile& tile, const Line& line) {
  Vec weights[kTaps];
  for (int i = 0; i < kTaps; ++i) weights[i] = splat(tile.column_weights[i]);
  const Vec lost = splat(tile.noise_lost), cap = splat(tile.cap), one = splat(1);
  const Vec numbers = lane_numbers();
  for (int x = tile.first_column / kLanes * kLanes; x < tile.last_column; x += kLanes) {
    const Vec off = distance<kTaps, kChannels>(line, x, weights, lost);
    const IntVec seen = (off == off) & in_columns(tile, numbers, x);
    store(line.costs + x, load(line.costs + x) + choose(seen, least(off, cap), Vec{}));
    store(line.seen + x, load(line.seen + x) + choose(seen, one, Vec{}));
  }
}

// The same where samples count more or less, as they are before or behind what is known to be
// there.
template <int kTaps, int kChannels>
void add_visible(const MatchingTile& tile, const Line& line) {
  Vec weights[kTaps];
  for (int i = 0; i < kTaps; ++i) weights[i] = splat(tile.column_weights[i]);
  const Vec lost = splat(tile.noise_lost), limit = splat(tile.limit);
  const Vec steepness = splat(tile.steepness), one = splat(1);
  const Vec numbers = lane_numbers();
  for (int x = tile.first_column / kLanes * kLanes; x < tile.last_column; x += kLanes) {
    const Vec off = distance<kTaps, kChannels>(line, x, weights, lost);
    const IntVec seen = (off == off) & in_columns(tile, numbers, x);
    const Vec free = (limit - load(line.nearest + x)) * steepness;
    const Vec share = choose(seen, least(greatest(free, Vec{}), one), Vec{});
    const Vec cost = choose(seen, least(off, load(line.caps + x)), Vec{});
    store(line.costs + x, load(line.costs + x) + share * cost);
    store(line.seen + x, load(line.seen + x) + share);
  }
}

template <int kTaps, int kChannels>
void add_either(const MatchingTile& tile, const Line& line) {
  if (line.nearest) return add_visible<kTaps, kChannels>(tile, line);
  if (line.seen) return add_known<kTaps, kChannels>(tile, line);
  add_line<kTaps, kChannels>(tile, line);
}

template <int kTaps>
void add_rows(const MatchingTile& tile) {
  for (int y = tile.first_row; y < tile.last_row; ++y) {
    const Line line = make_line(tile, y);
    if (tile.channels == 3) {
      add_either<kTaps, 3>(tile, line);
    } else {
      add_either<kTaps, 1>(tile, line);
    }
  }
}

void add(const MatchingTile& tile) {
  if (tile.column_taps == 1) return add_rows<1>(tile);
  if (tile.column_taps == 2) return add_rows<2>(tile);
  add_rows<4>(tile);
}

// Sums of `padded`, whose payload begins at lane `radius` between zeros, over 2·radius + 1 lanes.
void sum_along(const GuideRow& row, float* padded, float* out) {
  for (int x = 0; x < row.radius; ++x) padded[x] = 0;
  for (int x = 0; x < row.radius + kGuidedSlack; ++x) padded[row.radius + row.width + x] = 0;
  for (int x = 0; x < row.width; x += kLanes) {
    Vec sum = load(padded + x);
    for (int i = 1; i <= 2 * row.radius; ++i) sum += load(padded + x + i);
    store(out + x, sum);
  }
}

void sum_products(const GuideRow& row, const float* values, float* scratch, float* const* out) {
  float* payload = scratch + row.radius;
  __builtin_memcpy(payload, values, sizeof(float) * row.width);
  sum_along(row, scratch, out[0]);
  for (int c = 0; c < row.channels; ++c) {
    for (int x = 0; x < row.width; x += kLanes) {
      store(payload + x, load(values + x) * load(row.guide[c] + x));
    }
    sum_along(row, scratch, out[c + 1]);
  }
}

inline Vec sum_down(const GuidedSums& sums, int plane, int x) {
  Vec sum = load(sums.planes[0][plane] + x);
  for (int i = 1; i < sums.rows; ++i) sum += load(sums.planes[i][plane] + x);
  return sum;
}

template <int kChannels>
inline void solve_at(const GuideRow& row, const GuidedSums& sums, float share, int x,
                     float* const* models) {
  const Vec scale = load(row.share + x) * share;
  const Vec mean = sum_down(sums, 0, x) * scale;
  Vec covariance[kChannels];
  for (int c = 0; c < kChannels; ++c) {
    covariance[c] = sum_down(sums, c + 1, x) * scale - load(row.mean[c] + x) * mean;
  }
  const auto inverse = [&](int i) { return load(row.inverse[i] + x); };
  Vec a[kChannels];
  if constexpr (kChannels == 1) {
    a[0] = inverse(0) * covariance[0];
  } else {
    const Vec i01 = inverse(1);
    const Vec i02 = inverse(2);
    const Vec i12 = inverse(4);
    a[0] = inverse(0) * covariance[0] + i01 * covariance[1] + i02 * covariance[2];
    a[1] = i01 * covariance[0] + inverse(3) * covariance[1] + i12 * covariance[2];
    a[2] = i02 * covariance[0] + i12 * covariance[1] + inverse(5) * covariance[2];
  }
  Vec b = mean;
  for (int c = 0; c < kChannels; ++c) {
    b -= a[c] * load(row.mean[c] + x);
    store(models[c + 1] + x, a[c]);
  }
  store(models[0] + x, b);
}

void solve(const GuideRow& row, const GuidedSums& sums, float* scratch, float* const* models,
           float* const* out) {
  const float share = 1.0F / static_cast<float>(sums.rows);
  for (int x = 0; x < row.width; x += kLanes) {
    if (row.channels == 3) {
      solve_at<3>(row, sums, share, x, models);
    } else {
      solve_at<1>(row, sums, share, x, models);
    }
  }
  for (int plane = 0; plane <= row.channels; ++plane) {
    __builtin_memcpy(scratch + row.radius, models[plane], sizeof(float) * row.width);
    sum_along(row, scratch, out[plane]);
  }
}

void apply(const GuideRow& row, const GuidedSums& sums, float* out) {
  const float share = 1.0F / static_cast<float>(sums.rows);
  int x = 0;
  const auto filtered = [&] {
    Vec sum = sum_down(sums, 0, x);
    for (int c = 0; c < row.channels; ++c) {
      sum += sum_down(sums, c + 1, x) * load(row.guide[c] + x);
    }
    return sum * load(row.share + x) * share;
  };
  for (; x + kLanes <= row.width; x += kLanes) store(out + x, filtered());
  if (x == row.width) return;
  // What follows the row belongs to other data.
  const Vec rest = filtered();
  __builtin_memcpy(out + x, &rest, sizeof(float) * (row.width - x));
}

}  // namespace

extern const MatchingKernel kMatchingKernel;
const MatchingKernel kMatchingKernel{add};

extern const GuidedKernel kGuidedKernel;
const GuidedKernel kGuidedKernel{sum_products, solve, apply};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
