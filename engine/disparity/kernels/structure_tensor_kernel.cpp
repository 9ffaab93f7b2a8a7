// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/kernels/structure_tensor_kernel.h"

#include "engine/core/simd.h"

// Compiled once for each instruction set: see engine/core/isa.h for what may stand here.

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

// Lanes that are worked on together, so that every row they touch stays in the L1 cache.
constexpr int kChunk = 128;

// out[n] = Σ taps·in over [begin, end), rounded up to whole vectors.
template <int kRadius>
void filter_fixed(const float* __restrict in, int begin, int end, int stride, const float* taps,
                  float* __restrict out) {
  Vec weights[2 * kRadius + 1];
  for (int i = 0; i <= 2 * kRadius; ++i) weights[i] = splat(taps[i]);
  for (int n = begin; n < end; n += kLanes) {
    Vec sum = weights[kRadius] * load(in + n);
    for (int i = 1; i <= kRadius; ++i) {
      sum += weights[kRadius + i] * load(in + n + i * stride);
      sum += weights[kRadius - i] * load(in + n - i * stride);
    }
    store(out + n, sum);
  }
}

void filter(const float* in, int begin, int end, int stride, const Taps& taps, float* out) {
  with_radius(taps.radius, [&]<int kRadius>() {
    filter_fixed<kRadius>(in, begin, end, stride, taps.values, out);
  });
}

// Central difference and Scharr's smoothing of a pre-smoothed row.
void gradient_row(const float* __restrict in, int begin, int end, int stride,
                  float* __restrict along, float* __restrict across) {
  for (int n = begin; n < end; n += kLanes) {
    const Vec left = load(in + n - stride);
    const Vec right = load(in + n + stride);
    store(along + n, 0.5F * (right - left));
    store(across + n, (3.0F / 16) * (left + right) + (10.0F / 16) * load(in + n));
  }
}

// out[n] = in at n + ½, by the four-point interpolation [−1, 9, 9, −1]/16.
void half_pixel_row(const float* __restrict in, int begin, int end, int stride,
                    float* __restrict out) {
  for (int n = begin; n < end; n += kLanes) {
    const Vec near_pair = load(in + n) + load(in + n + stride);
    const Vec far_pair = load(in + n - stride) + load(in + n + 2 * stride);
    store(out + n, (9.0F / 16) * near_pair - (1.0F / 16) * far_pair);
  }
}

void differentiate(const TensorBlock& block, const TensorFilters& filters, bool with_half) {
  const int center = block.rows / 2;
  const int stride = block.stride;
  // What each stage needs of the stage before it.
  const int smooth_begin = filters.smooth.radius * stride;
  const int smooth_end = 2 * block.margin + block.length - smooth_begin;
  float* smooth = block.line;
  float* half = block.line + block.pitch;
  for (int plane = 0; plane < block.channels * block.rows; ++plane) {
    const long offset = static_cast<long>(plane) * block.pitch;
    filter(block.samples + offset, smooth_begin, smooth_end, stride, filters.smooth, smooth);
    gradient_row(smooth, smooth_begin + stride, smooth_end - stride, stride,
                 block.along[0] + offset, block.across[0] + offset);
    // A shear moves a row by half a pixel only at an odd distance from the row about which it
    // turns.
    if (!with_half || ((plane % block.rows - center) & 1) == 0) continue;
    half_pixel_row(smooth, smooth_begin + stride, smooth_end - 2 * stride, stride, half);
    gradient_row(half, smooth_begin + 2 * stride, smooth_end - 3 * stride, stride,
                 block.along[1] + offset, block.across[1] + offset);
  }
}

// Where a row is read, so that lane 0 of the sheared coordinates falls on it: the plane (whole or
// half pixel) and the lane. Disparity k stands upright if row r is read at x − k·(r − center).
struct RowSource {
  int half = 0;
  long offset = 0;
};

RowSource source_of(const TensorBlock& block, const Shear& shear, int row) {
  const int half_steps = -shear.half_steps * (row - shear.center_row);
  return {half_steps & 1, static_cast<long>(row) * block.pitch + block.margin +
                              static_cast<long>(floor_half(half_steps)) * block.stride};
}

// The rows of the first channel that a filter along the views takes in, with their taps; zero taps
// are left out.
struct RowSources {
  int count = 0;
  float taps[kMaxTaps];
  const float* rows[kMaxTaps];
};

// Vectors worked on together, so that a pointer and a tap are fetched once for all of them.
template <int kCount>
struct GroupOf {
  Vec at[kCount];
};
constexpr int kGroup = 2;
constexpr int kGroupLanes = kGroup * kLanes;
using Group = GroupOf<kGroup>;
// Integration has nothing else in registers, and needs as many sums as additions take to end.
constexpr int kWideGroup = EPISCOPE_VECTOR_BYTES == 64 ? 4 : 2;
constexpr int kWideGroupLanes = kWideGroup * kLanes;

template <int kCount>
inline void multiply_add(GroupOf<kCount>& sum, float tap, const float* from) {
  for (int k = 0; k < kCount; ++k) sum.at[k] += tap * load(from + k * kLanes);
}

// A product that an invalid sample entered, NaN, counts nothing.
template <bool kHasInvalid>
inline Vec known_or_zero(Vec product) {
  if constexpr (kHasInvalid) return choose(product == product, product, Vec{});
  return product;
}

// Lanes of the sheared coordinates, [begin, end).
struct Window {
  int begin = 0;
  int end = 0;
};

// Lanes of one row from one product to the next. Groups may begin anywhere and reach beyond the
// chunk.
constexpr int kProductPitch = kChunk + kWideGroupLanes;

// What one row contributes under a shear, and where that is needed.
struct RowWork {
  RowSources along, across;
  long channel = 0;  // From one channel of the sources to the next.
  Window window;
};

// Both derivatives at a group of lanes.
struct GradientGroup {
  Group along{}, across{};
};

// kAlong and kAcross are the numbers of taps, 0 = any.
template <int kAlong, int kAcross>
inline GradientGroup gradient_group(const RowWork& work, long at) {
  const int along = kAlong > 0 ? kAlong : work.along.count;
  const int across = kAcross > 0 ? kAcross : work.across.count;
  GradientGroup g;
  for (int i = 0; i < along; ++i) {
    multiply_add(g.along, work.along.taps[i], work.along.rows[i] + at);
  }
  for (int i = 0; i < across; ++i) {
    multiply_add(g.across, work.across.taps[i], work.across.rows[i] + at);
  }
  return g;
}

// The number of taps that rows have with neighbors enough on both sides, at the usual scale: those
// along are symmetric, those across antisymmetric. Samples of a pair are added first, on adders
// that multiplications leave idle.
constexpr int kInner = -5;

template <>
inline GradientGroup gradient_group<kInner, kInner>(const RowWork& work, long at) {
  const float* const* const a = work.along.rows;
  const float* const* const b = work.across.rows;
  GradientGroup g;
  for (int k = 0; k < kGroup; ++k) {
    const long n = at + k * kLanes;
    g.along.at[k] = work.along.taps[2] * load(a[2] + n) +
                    work.along.taps[1] * (load(a[1] + n) + load(a[3] + n)) +
                    work.along.taps[0] * (load(a[0] + n) + load(a[4] + n));
    g.across.at[k] = work.across.taps[1] * (load(b[1] + n) - load(b[2] + n)) +
                     work.across.taps[0] * (load(b[0] + n) - load(b[3] + n));
  }
  return g;
}

bool is_inner(const RowWork& work) {
  const float* const a = work.along.taps;
  const float* const b = work.across.taps;
  return work.along.count == 5 && work.across.count == 4 && a[0] == a[4] && a[1] == a[3] &&
         b[0] == -b[3] && b[1] == -b[2];
}

// Products of the gradient in a window, lane 0 being lane `from` of the sources, all channels
// summed, toned down and stored.
template <int kChannels, bool kHasInvalid, int kAlong, int kAcross>
void fill_products(const RowWork& work, float contrast, Window window, long from,
                   float* __restrict out) {
  for (int n = window.begin; n < window.end; n += kGroupLanes) {
    Group xx{}, xs{}, ss{};
    for (int c = 0; c < kChannels; ++c) {
      const GradientGroup g = gradient_group<kAlong, kAcross>(work, from + n + c * work.channel);
      for (int k = 0; k < kGroup; ++k) {
        xx.at[k] += g.along.at[k] * g.along.at[k];
        xs.at[k] += g.along.at[k] * g.across.at[k];
        ss.at[k] += g.across.at[k] * g.across.at[k];
      }
    }
    for (int k = 0; k < kGroup; ++k) {
      // A silhouette must not drown the weaker texture beside it: strong gradients are toned down.
      const Vec weight = contrast * reciprocal(xx.at[k] + ss.at[k] + contrast);
      float* const to = out + n + k * kLanes;
      store(to, known_or_zero<kHasInvalid>(weight * xx.at[k]));
      store(to + kProductPitch, known_or_zero<kHasInvalid>(weight * xs.at[k]));
      store(to + 2 * kProductPitch, known_or_zero<kHasInvalid>(weight * ss.at[k]));
    }
  }
}

using FillProducts = void (*)(const RowWork&, float contrast, Window, long from, float* out);

// For the numbers of taps that the usual scales have.
template <int kChannels, bool kHasInvalid>
FillProducts fill_products_by_taps(const RowWork& work) {
  const int along = work.along.count, across = work.across.count;
  if (is_inner(work)) return fill_products<kChannels, kHasInvalid, kInner, kInner>;
  if (along == 4 && across == 4) return fill_products<kChannels, kHasInvalid, 4, 4>;
  if (along == 3 && across == 3) return fill_products<kChannels, kHasInvalid, 3, 3>;
  if (along == 7 && across == 6) return fill_products<kChannels, kHasInvalid, 7, 6>;
  return fill_products<kChannels, kHasInvalid, 0, 0>;
}

FillProducts fill_products_of(const TensorBlock& block, const RowWork& work) {
  if (block.has_invalid) {
    return block.channels == 1 ? fill_products_by_taps<1, true>(work)
                               : fill_products_by_taps<3, true>(work);
  }
  return block.channels == 1 ? fill_products_by_taps<1, false>(work)
                             : fill_products_by_taps<3, false>(work);
}

// Pointers to lane 0 of the sheared coordinates.
void find_sources(const TensorBlock& block, const Shear& shear, float* const* planes,
                  const RowTaps& taps, RowSources& sources) {
  sources.count = 0;
  for (int i = 0; i < taps.count; ++i) {
    if (taps.values[i] == 0) continue;
    const RowSource source = source_of(block, shear, taps.first + i);
    sources.taps[sources.count] = taps.values[i];
    sources.rows[sources.count++] = planes[source.half] + source.offset;
  }
}

// Where the tensor of a row is needed for its payload.
Window target_window(const TensorBlock& block, const TensorFilters& filters, const Shear& shear,
                     int row) {
  const int start = floor_half(shear.half_steps * (row - shear.center_row));
  return {(start - filters.integrate.radius) * block.stride,
          (start + filters.integrate.radius + 1) * block.stride + block.length};
}

// Where the products of a row are needed by the wanted rows that integrate over it.
Window source_window(const TensorBlock& block, const TensorFilters& filters, const Shear& shear,
                     int row) {
  Window window{0, 0};
  for (int r = block.first_row; r < block.last_row; ++r) {
    const RowTaps& taps = filters.row_integrate[r];
    if (row < taps.first || row >= taps.first + taps.count) continue;
    const Window target = target_window(block, filters, shear, r);
    if (window.begin == window.end) {
      window = target;
    } else {
      if (target.begin < window.begin) window.begin = target.begin;
      if (target.end > window.end) window.end = target.end;
    }
  }
  return window;
}

struct ChunkProducts {
  alignas(64) float values[kMaxTensorViews][3][kProductPitch];
};

// Integrates the products along the views, lane `from` of `tensor` being lane 0 of the chunk.
void integrate_rows(const ChunkProducts& products, const RowTaps& taps, Window window,
                    float* const* tensor, long from) {
  for (int n = window.begin; n < window.end; n += kWideGroupLanes) {
    GroupOf<kWideGroup> xx{}, xs{}, ss{};
    for (int i = 0; i < taps.count; ++i) {
      const float* const row = products.values[taps.first + i][0] + n;
      multiply_add(xx, taps.values[i], row);
      multiply_add(xs, taps.values[i], row + kProductPitch);
      multiply_add(ss, taps.values[i], row + 2 * kProductPitch);
    }
    for (int k = 0; k < kWideGroup; ++k) {
      const long to = from + n + k * kLanes;
      store(tensor[0] + to, xx.at[k]);
      store(tensor[1] + to, xs.at[k]);
      store(tensor[2] + to, ss.at[k]);
    }
  }
}

// The part of a window inside a chunk, relative to the chunk's first lane.
Window clip(Window window, int chunk) {
  const int begin = window.begin - chunk;
  const int end = window.end - chunk;
  return {begin < 0 ? 0 : begin & ~(kLanes - 1), end > kChunk ? kChunk : end};
}

void accumulate(const TensorBlock& block, const TensorFilters& filters, const Shear& shear) {
  ChunkProducts products;
  RowWork work[kMaxTensorViews];
  FillProducts fill[kMaxTensorViews];
  Window whole{0, 0};
  for (int r = 0; r < block.rows; ++r) {
    find_sources(block, shear, block.along, filters.row_smooth[r], work[r].along);
    find_sources(block, shear, block.across, filters.row_derivative[r], work[r].across);
    work[r].channel = static_cast<long>(block.rows) * block.pitch;
    work[r].window = source_window(block, filters, shear, r);
    fill[r] = fill_products_of(block, work[r]);
    if (work[r].window.begin < whole.begin) whole.begin = work[r].window.begin;
    if (work[r].window.end > whole.end) whole.end = work[r].window.end;
  }
  // Chunks begin at whole vectors of the planes.
  const int first = whole.begin / kLanes * kLanes - kLanes;
  for (int chunk = first; chunk < whole.end; chunk += kChunk) {
    for (int r = 0; r < block.rows; ++r) {
      fill[r](work[r], filters.contrast_energy, clip(work[r].window, chunk), chunk,
              products.values[r][0]);
    }
    for (int r = block.first_row; r < block.last_row; ++r) {
      const Window window = clip(target_window(block, filters, shear, r), chunk);
      integrate_rows(products, filters.row_integrate[r], window, block.tensor,
                     static_cast<long>(r) * block.tensor_pitch + block.tensor_margin + chunk);
    }
  }
}

// Taps are symmetric: both samples of a pair are added first, on adders that multiplications leave
// idle.
template <int kCount>
inline Vec integrate_at(const float* in, int stride, const Vec* taps) {
  Vec sum = taps[0] * (load(in) + load(in + (kCount - 1) * stride));
  if constexpr (kCount == 1) return taps[0] * load(in);
  for (int i = 1; i < kCount / 2; ++i) {
    sum += taps[i] * (load(in + i * stride) + load(in + (kCount - 1 - i) * stride));
  }
  if constexpr (kCount % 2 == 1) sum += taps[kCount / 2] * load(in + kCount / 2 * stride);
  return sum;
}

// |d| < 1 lies below a bound b exactly if tan 2θ does: with d = −tan θ and tan 2θ = 2Jxs/(Jxx −
// Jss), d ≤ b means −2Jxs ≤ 2b/(1 − b²)·(Jxx − Jss), Jxx > Jss. No root, no division.
inline float double_angle(float bound) {
  return 2 * bound / (1 - bound * bound);
}

// Bounds of the disparity that remains after a shear.
struct Bounds {
  float below, above;
};

Bounds bounds_of(const Shear& shear) {
  const float upright = 0.5F * static_cast<float>(shear.half_steps);
  const float low = shear.min - upright;
  const float high = shear.max - upright;
  return {double_angle(low > -shear.limit ? low : -shear.limit),
          double_angle(high < shear.limit ? high : shear.limit)};
}

// Keeps the tensor of the most coherent shear; coherence is compared squared:
// r² = ((Jxx − Jss)² + 4Jxs²)/(Jxx + Jss + n²)² (Bigün and Granlund 1987).
template <int kCount>
void select_row(const float* const* tensor, int stride, const float* values, float noise_energy,
                const Shear& shear, int length, float* __restrict const* best) {
  Vec taps[kCount];
  for (int i = 0; i < kCount; ++i) taps[i] = splat(values[i]);
  const Vec upright = splat(0.5F * static_cast<float>(shear.half_steps));
  const Bounds bounds = bounds_of(shear);
  for (int n = 0; n < length; n += kLanes) {
    const Vec xx = integrate_at<kCount>(tensor[0] + n, stride, taps);
    const Vec ss = integrate_at<kCount>(tensor[2] + n, stride, taps);
    const Vec xs = integrate_at<kCount>(tensor[1] + n, stride, taps);
    const Vec difference = xx - ss;
    const Vec twice = -2.0F * xs;
    const IntVec within = (difference > 0.0F) & (twice >= bounds.below * difference) &
                          (twice <= bounds.above * difference);
    // A shear far from the disparities here: mostly no lane is within its bounds.
    if (!any(within)) continue;
    const Vec whole = xx + ss + (noise_energy + 1e-20F);
    const Vec coherence = (difference * difference + twice * twice) * reciprocal(whole * whole);
    const Vec so_far = load(best[3] + n);
    const IntVec better = within & (coherence > so_far);
    if (!any(better)) continue;
    // Back to unsheared coordinates: ∂s = ∂s' − k ∂x.
    const Vec unsheared_xs = xs - upright * xx;
    const Vec unsheared_ss = ss - upright * (xs + unsheared_xs);
    store(best[0] + n, choose(better, xx, load(best[0] + n)));
    store(best[1] + n, choose(better, unsheared_xs, load(best[1] + n)));
    store(best[2] + n, choose(better, unsheared_ss, load(best[2] + n)));
    store(best[3] + n, choose(better, coherence, so_far));
  }
}

using SelectRow = void (*)(const float* const* tensor, int stride, const float* taps,
                           float noise_energy, const Shear& shear, int length,
                           float* __restrict const* best);
// By the number of taps.
constexpr SelectRow kSelectRows[] = {nullptr,        select_row<1>,  select_row<2>,  select_row<3>,
                                     select_row<4>,  select_row<5>,  select_row<6>,  select_row<7>,
                                     select_row<8>,  select_row<9>,  select_row<10>, select_row<11>,
                                     select_row<12>, select_row<13>, select_row<14>};
static_assert(sizeof(kSelectRows) / sizeof(SelectRow) == kMaxTaps + 2);

void select(const TensorBlock& block, const TensorFilters& filters, const Shear& shear) {
  for (int r = block.first_row; r < block.last_row; ++r) {
    // The payload pixel x of row r stands at x + k·(r − center) of the sheared coordinates.
    const int half_steps = shear.half_steps * (r - shear.center_row);
    const bool half = (half_steps & 1) != 0;
    const Taps& taps = half ? filters.integrate_half : filters.integrate;
    const long from =
        static_cast<long>(r) * block.tensor_pitch + block.tensor_margin +
        static_cast<long>(floor_half(half_steps) - filters.integrate.radius) * block.stride;
    const long to = static_cast<long>(r) * block.best_pitch;
    const float* const tensor[3] = {block.tensor[0] + from, block.tensor[1] + from,
                                    block.tensor[2] + from};
    float* const best[4] = {block.best[0] + to, block.best[1] + to, block.best[2] + to,
                            block.best[3] + to};
    kSelectRows[2 * filters.integrate.radius + (half ? 2 : 1)](
        tensor, block.stride, taps.values, filters.noise_energy, shear, block.length, best);
  }
}

// The slope of ∂s + d ∂x = 0, −d, of one tensor by least squares.
inline Vec slope_of(const float* const* tensor, int n) {
  return load(tensor[1] + n) * reciprocal(load(tensor[0] + n) + 1e-20F);
}

// K/(K + (slope − own)²), K as above, with slope = Jxs/Jxx: one division for both.
inline Vec agreement(Vec xx, Vec xs, Vec own) {
  const Vec off = xs - own * xx;
  const Vec agreeing = kTensorDisagreement * (xx * xx) + 1e-30F;
  return agreeing * reciprocal(agreeing + off * off);
}

// Least squares of ∂s + d ∂x = 0 over the averaged tensor; coherence in the frame sheared by d.
void resolve(const TensorAverage& average) {
  const int middle = average.count / 2;
  for (int n = 0; n < average.length; n += kLanes) {
    Vec sum[3];
    for (int j = 0; j < 3; ++j)
      sum[j] = average.weights[middle] * load(average.tensor[middle][j] + n);
    const Vec own = slope_of(average.tensor[middle], n);
    for (int i = 0; i < average.count; ++i) {
      if (i == middle) continue;
      const Vec tensor[3] = {load(average.tensor[i][0] + n), load(average.tensor[i][1] + n),
                             load(average.tensor[i][2] + n)};
      const Vec weight = average.weights[i] * agreement(tensor[0], tensor[1], own);
      for (int j = 0; j < 3; ++j) sum[j] += weight * tensor[j];
    }
    const Vec xx = sum[0] + 1e-20F;
    const Vec disparity = -sum[1] * reciprocal(xx);
    Vec residual = sum[2] + disparity * sum[1];
    residual = choose(residual > 0.0F, residual, splat(0));
    Vec coherence = (xx - residual) * reciprocal(xx + residual + average.noise_energy);
    const IntVec inside = (disparity >= average.min) & (disparity <= average.max);
    coherence = choose(inside & (coherence > 0.0F), coherence, splat(0));
    const Vec above = choose(disparity < average.min, splat(average.min), disparity);
    store(average.disparity + n, choose(above > average.max, splat(average.max), above));
    store(average.coherence + n, coherence);
  }
}

inline Vec raised(Vec base, int power) {
  Vec result = splat(1);
  for (; power > 0; power >>= 1) {
    if ((power & 1) != 0) result *= base;
    base *= base;
  }
  return result;
}

inline void merge_at(const float* disparity, const float* coherence, int power, float* to_disparity,
                     float* to_coherence) {
  const Vec here = load(coherence);
  const Vec there = load(to_coherence);
  const Vec value = load(disparity);
  const Vec other = load(to_disparity);
  const IntVec agree =
      (absolute(value - other) < kDirectionAgreement) & (here > 0.0F) & (there > 0.0F);
  const Vec weight = raised(here, power);
  const Vec share = weight / (weight + raised(there, power) + 1e-30F);
  const Vec winner = choose(here > there, value, other);
  store(to_disparity, choose(agree, other + share * (value - other), winner));
  store(to_coherence, choose(here > there, here, there));
}

void merge(const float* disparity, const float* coherence, int count, int power,
           float* to_disparity, float* to_coherence) {
  int n = 0;
  for (; n + kLanes <= count; n += kLanes) {
    merge_at(disparity + n, coherence + n, power, to_disparity + n, to_coherence + n);
  }
  if (n == count) return;
  // The rest through a padded copy: what lies behind belongs to others.
  float rest[4][kLanes] = {};
  for (int i = n; i < count; ++i) {
    rest[0][i - n] = disparity[i];
    rest[1][i - n] = coherence[i];
    rest[2][i - n] = to_disparity[i];
    rest[3][i - n] = to_coherence[i];
  }
  merge_at(rest[0], rest[1], power, rest[2], rest[3]);
  for (int i = n; i < count; ++i) {
    to_disparity[i] = rest[2][i - n];
    to_coherence[i] = rest[3][i - n];
  }
}

// Keeps divisions by zero out where there is no texture.
constexpr float kTiny = 1e-20F;

// One row of a shear: its tensors where the first tap of the first lane falls, and the best so far.
struct SearchedRow {
  const float* tensor[3];
  float* best[4];
  const float* taps;
  int count;
};

SearchedRow row_of(const TensorBlock& block, const TensorFilters& filters, const Shear& shear,
                   int row) {
  const int half_steps = shear.half_steps * (row - shear.center_row);
  const bool half = (half_steps & 1) != 0;
  const int radius = filters.integrate.radius;
  const long from = static_cast<long>(row) * block.tensor_pitch + block.tensor_margin +
                    static_cast<long>(floor_half(half_steps) - radius) * block.stride;
  SearchedRow searched{};
  for (int j = 0; j < 3; ++j) searched.tensor[j] = block.tensor[j] + from;
  for (int j = 0; j < 4; ++j) {
    searched.best[j] = block.best[j] + static_cast<long>(row) * block.best_pitch;
  }
  searched.taps = half ? filters.integrate_half.values : filters.integrate.values;
  searched.count = 2 * radius + (half ? 2 : 1);
  return searched;
}

struct Tensor {
  Vec xx, xs, ss;
};

inline Vec integrate_at(const SearchedRow& row, int plane, int n, int stride) {
  Vec sum = row.taps[0] * load(row.tensor[plane] + n);
  for (int i = 1; i < row.count; ++i) {
    sum += row.taps[i] * load(row.tensor[plane] + n + i * stride);
  }
  return sum;
}

// Back to unsheared coordinates: ∂s = ∂s' − k ∂x.
inline Tensor unsheared(const Tensor& tensor, Vec k) {
  const Vec xs = tensor.xs - k * tensor.xx;
  return {tensor.xx, xs, tensor.ss - k * (tensor.xs + xs)};
}

// The tensor with eigenvalues (trace ± root)/2 whose residual along d is the smaller of them.
inline Tensor of_eigenvector(Vec trace, Vec root, Vec d) {
  const Vec large = 0.5F * (trace + root);
  const Vec xs = -d * large;
  return {large, xs, 0.5F * (trace - root) - d * xs};
}

void select_row(const SearchedRow& row, const TensorBlock& block, float noise_energy,
                const Shear& shear, bool replace) {
  const Vec upright = splat(0.5F * static_cast<float>(shear.half_steps));
  for (int n = 0; n < block.length; n += kLanes) {
    const Tensor tensor{integrate_at(row, 0, n, block.stride),
                        integrate_at(row, 1, n, block.stride),
                        integrate_at(row, 2, n, block.stride)};
    const Vec difference = tensor.xx - tensor.ss;
    const Vec twice = -2.0F * tensor.xs;
    const Vec trace = tensor.xx + tensor.ss;
    const Vec root = square_root(difference * difference + twice * twice);
    const Vec disparity = twice / (difference + root + kTiny);
    const Vec ratio = root / (trace + (noise_energy + kTiny));
    const Vec coherence = ratio * ratio;
    const Vec so_far = load(row.best[3] + n);
    const IntVec better =
        (disparity >= -shear.limit) & (disparity <= shear.limit) & (coherence > so_far);
    if (!any(better)) continue;
    const Tensor kept =
        unsheared(replace ? of_eigenvector(trace, root, disparity) : tensor, upright);
    store(row.best[0] + n, choose(better, kept.xx, load(row.best[0] + n)));
    store(row.best[1] + n, choose(better, kept.xs, load(row.best[1] + n)));
    store(row.best[2] + n, choose(better, kept.ss, load(row.best[2] + n)));
    store(row.best[3] + n, choose(better, coherence, so_far));
  }
}

void select(const TensorBlock& block, const TensorFilters& filters, const Shear& shear,
            bool replace) {
  for (int r = block.first_row; r < block.last_row; ++r) {
    select_row(row_of(block, filters, shear, r), block, filters.noise_energy, shear, replace);
  }
}

}  // namespace

extern const TensorKernel kTensorKernel;
const TensorKernel kTensorKernel{differentiate, accumulate};

extern const OrientationKernel kOrientationKernel;
const OrientationKernel kOrientationKernel{select, resolve, merge};

extern const EigenvectorKernel kEigenvectorKernel;
const EigenvectorKernel kEigenvectorKernel{select};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
