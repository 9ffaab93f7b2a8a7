// SPDX-License-Identifier: BSD-3-Clause
// Compiled once for each instruction set: see engine/core/parallel/isa.h for what may stand here.
#include "engine/disparity/tensor/structure_tensor_kernel.h"

#include "engine/core/parallel/simd.h"

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
  switch (taps.radius) {
    case 0:
      return filter_fixed<0>(in, begin, end, stride, taps.values, out);
    case 1:
      return filter_fixed<1>(in, begin, end, stride, taps.values, out);
    case 2:
      return filter_fixed<2>(in, begin, end, stride, taps.values, out);
    case 3:
      return filter_fixed<3>(in, begin, end, stride, taps.values, out);
    case 4:
      return filter_fixed<4>(in, begin, end, stride, taps.values, out);
    case 5:
      return filter_fixed<5>(in, begin, end, stride, taps.values, out);
    default:
      return filter_fixed<6>(in, begin, end, stride, taps.values, out);
  }
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

// The number of taps that rows have with neighbours enough on both sides, at the usual scale: those
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

// Products of all rows in a chunk.
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

}  // namespace

extern const TensorKernel kTensorKernel;
const TensorKernel kTensorKernel{differentiate, accumulate};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
