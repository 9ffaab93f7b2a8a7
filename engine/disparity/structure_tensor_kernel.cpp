// SPDX-License-Identifier: BSD-3-Clause
// Compiled once for each instruction set: see engine/core/isa.h for what may stand here.
#include "engine/disparity/structure_tensor_kernel.h"

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

constexpr int kLanes = EPISCOPE_VECTOR_BYTES / sizeof(float);
typedef float Vec __attribute__((vector_size(EPISCOPE_VECTOR_BYTES)));
typedef int IntVec __attribute__((vector_size(EPISCOPE_VECTOR_BYTES)));
typedef float LooseVec __attribute__((vector_size(EPISCOPE_VECTOR_BYTES), aligned(4), may_alias));

// Lanes that are worked on together, so that every row they touch stays in the L1 cache.
constexpr int kChunk = 128;

inline Vec load(const float* from) { return *reinterpret_cast<const LooseVec*>(from); }
inline void store(float* to, Vec value) { *reinterpret_cast<LooseVec*>(to) = value; }
inline Vec splat(float value) { return value - Vec{}; }
inline Vec select(IntVec mask, Vec yes, Vec no) { return mask ? yes : no; }
inline Vec square_root(Vec value) {
  Vec root;
  for (int i = 0; i < kLanes; ++i) root[i] = __builtin_sqrtf(value[i]);
  return root;
}

void deinterleave(const std::uint8_t* __restrict in, int count, int channels, float* const* out) {
  constexpr float scale = 1.0F / 255;
  if (channels == 1) {
    float* __restrict grey = out[0];
    for (int i = 0; i < count; ++i) grey[i] = scale * static_cast<float>(in[i]);
    return;
  }
  float* __restrict red = out[0];
  float* __restrict green = out[1];
  float* __restrict blue = out[2];
  for (int i = 0; i < count; ++i) {
    red[i] = scale * static_cast<float>(in[3 * i]);
    green[i] = scale * static_cast<float>(in[3 * i + 1]);
    blue[i] = scale * static_cast<float>(in[3 * i + 2]);
  }
}

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
    case 0: return filter_fixed<0>(in, begin, end, stride, taps.values, out);
    case 1: return filter_fixed<1>(in, begin, end, stride, taps.values, out);
    case 2: return filter_fixed<2>(in, begin, end, stride, taps.values, out);
    case 3: return filter_fixed<3>(in, begin, end, stride, taps.values, out);
    case 4: return filter_fixed<4>(in, begin, end, stride, taps.values, out);
    case 5: return filter_fixed<5>(in, begin, end, stride, taps.values, out);
    default: return filter_fixed<6>(in, begin, end, stride, taps.values, out);
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
  const int stride = block.stride;
  // What each stage needs of the stage before it.
  const int smooth_begin = filters.smooth.radius * stride;
  const int smooth_end = block.pitch - smooth_begin - kLanes;
  float* smooth = block.line;
  float* half = block.line + block.pitch;
  for (int plane = 0; plane < block.channels * block.rows; ++plane) {
    const long offset = static_cast<long>(plane) * block.pitch;
    filter(block.samples + offset, smooth_begin, smooth_end, stride, filters.smooth, smooth);
    gradient_row(smooth, smooth_begin + stride, smooth_end - stride, stride,
                 block.along[0] + offset, block.across[0] + offset);
    if (!with_half) continue;
    half_pixel_row(smooth, smooth_begin + stride, smooth_end - 2 * stride, stride, half);
    gradient_row(half, smooth_begin + 2 * stride, smooth_end - 3 * stride, stride,
                 block.along[1] + offset, block.across[1] + offset);
  }
}

// Where a sheared row begins: the plane (whole or half pixel) and the lane offset.
struct RowSource {
  int half = 0;
  long offset = 0;
};

RowSource source_of(const TensorBlock& block, const Shear& shear, int row) {
  // Disparity k stands upright if row r is read at x − k·(r − center).
  const int half_steps = -shear.half_steps * (row - shear.center_row);
  const int whole = half_steps >> 1;  // floor
  return {half_steps & 1,
          static_cast<long>(row) * block.pitch + static_cast<long>(whole) * block.stride};
}

struct Products {
  Vec xx, xs, ss;
};

// Gradient of `count` source rows at lane n, one channel, added to the products.
template <int kCount>
inline void add_products(const float* const* along, const float* const* across,
                         const float* smooth, const float* derivative, int n, Products& sum) {
  Vec gx = smooth[0] * load(along[0] + n);
  Vec gs = derivative[0] * load(across[0] + n);
  for (int i = 1; i < kCount; ++i) {
    gx += smooth[i] * load(along[i] + n);
    gs += derivative[i] * load(across[i] + n);
  }
  sum.xx += gx * gx;
  sum.xs += gx * gs;
  sum.ss += gs * gs;
}

constexpr int kMaxChannels = 3;

struct RowPointers {
  const float* along[kMaxChannels][kMaxTaps];
  const float* across[kMaxChannels][kMaxTaps];
};

template <int kCount, int kChannels>
void products_chunk(const RowPointers& rows, const RowTaps& smooth, const RowTaps& derivative,
                    int begin, int end, float* __restrict const* out) {
  for (int n = begin; n < end; n += kLanes) {
    Products sum{};
    for (int c = 0; c < kChannels; ++c) {
      add_products<kCount>(rows.along[c], rows.across[c], smooth.values, derivative.values, n, sum);
    }
    store(out[0] + (n - begin), sum.xx);
    store(out[1] + (n - begin), sum.xs);
    store(out[2] + (n - begin), sum.ss);
  }
}

template <int kChannels>
void products_row(int count, const RowPointers& rows, const RowTaps& smooth,
                  const RowTaps& derivative, int begin, int end, float* const* out) {
  switch (count) {
    case 2: return products_chunk<2, kChannels>(rows, smooth, derivative, begin, end, out);
    case 3: return products_chunk<3, kChannels>(rows, smooth, derivative, begin, end, out);
    case 4: return products_chunk<4, kChannels>(rows, smooth, derivative, begin, end, out);
    case 5: return products_chunk<5, kChannels>(rows, smooth, derivative, begin, end, out);
    case 6: return products_chunk<6, kChannels>(rows, smooth, derivative, begin, end, out);
    case 7: return products_chunk<7, kChannels>(rows, smooth, derivative, begin, end, out);
    case 8: return products_chunk<8, kChannels>(rows, smooth, derivative, begin, end, out);
    case 9: return products_chunk<9, kChannels>(rows, smooth, derivative, begin, end, out);
    case 10: return products_chunk<10, kChannels>(rows, smooth, derivative, begin, end, out);
    case 11: return products_chunk<11, kChannels>(rows, smooth, derivative, begin, end, out);
    case 12: return products_chunk<12, kChannels>(rows, smooth, derivative, begin, end, out);
    default: return products_chunk<13, kChannels>(rows, smooth, derivative, begin, end, out);
  }
}

// The widest grid axis whose products of a chunk are kept on the stack.
constexpr int kMaxRows = 32;

void fill_pointers(const TensorBlock& block, const Shear& shear, const RowTaps& taps,
                   RowPointers& rows) {
  const long plane = static_cast<long>(block.rows) * block.pitch;
  for (int i = 0; i < taps.count; ++i) {
    const RowSource source = source_of(block, shear, taps.first + i);
    for (int c = 0; c < block.channels; ++c) {
      rows.along[c][i] = block.along[source.half] + c * plane + source.offset;
      rows.across[c][i] = block.across[source.half] + c * plane + source.offset;
    }
  }
}

void integrate_rows(const float (*products)[kChunk], const RowTaps& taps, int count,
                    float* __restrict out) {
  for (int n = 0; n < count; n += kLanes) {
    Vec sum = taps.values[0] * load(products[taps.first] + n);
    for (int i = 1; i < taps.count; ++i) {
      sum += taps.values[i] * load(products[taps.first + i] + n);
    }
    store(out + n, sum);
  }
}

// Lanes whose tensor is needed: the payload seen through every shear offset and the integration.
int reach_of(const TensorBlock& block, const TensorFilters& filters, const Shear& shear) {
  const int below = shear.center_row - block.first_row;
  const int above = block.last_row - 1 - shear.center_row;
  const int rows = below > above ? below : above;
  const int steps = shear.half_steps < 0 ? -shear.half_steps : shear.half_steps;
  return ((rows > 0 ? rows : 0) * steps / 2 + 1 + filters.integrate.radius + 1) * block.stride;
}

void accumulate(const TensorBlock& block, const TensorFilters& filters, const Shear& shear) {
  alignas(64) float products[3][kMaxRows][kChunk];
  const int reach = reach_of(block, filters, shear);
  const int begin = block.margin - reach;
  const int end = block.margin + block.length + reach;
  int first = block.rows;
  int last = 0;
  for (int r = block.first_row; r < block.last_row; ++r) {
    const RowTaps& taps = filters.row_integrate[r];
    if (taps.first < first) first = taps.first;
    if (taps.first + taps.count > last) last = taps.first + taps.count;
  }
  for (int chunk = begin; chunk < end; chunk += kChunk) {
    const int stop = chunk + kChunk < end ? chunk + kChunk : end;
    for (int r = first; r < last; ++r) {
      RowPointers rows;
      const RowTaps& smooth = filters.row_smooth[r];
      fill_pointers(block, shear, smooth, rows);
      float* const out[3] = {products[0][r], products[1][r], products[2][r]};
      if (block.channels == 1) {
        products_row<1>(smooth.count, rows, smooth, filters.row_derivative[r], chunk, stop, out);
      } else {
        products_row<3>(smooth.count, rows, smooth, filters.row_derivative[r], chunk, stop, out);
      }
    }
    for (int r = block.first_row; r < block.last_row; ++r) {
      for (int j = 0; j < 3; ++j) {
        integrate_rows(products[j], filters.row_integrate[r], stop - chunk,
                       block.tensor[j] + static_cast<long>(r) * block.pitch + chunk);
      }
    }
  }
}

template <int kCount>
inline Vec integrate_at(const float* in, int stride, const float* taps) {
  Vec sum = taps[0] * load(in);
  for (int i = 1; i < kCount; ++i) sum += taps[i] * load(in + i * stride);
  return sum;
}

struct Orientation {
  Vec disparity, coherence;
};

// Slope and coherence of a tensor (algorithms of Bigün and Granlund 1987): the angle-free form.
inline Orientation orientation(Vec xx, Vec xs, Vec ss, Vec noise_energy) {
  const Vec difference = xx - ss;
  const Vec trace = xx + ss;
  const Vec root = square_root(difference * difference + 4.0F * xs * xs);
  const Vec tiny = splat(1e-20F);
  const Vec steep = difference + root;
  // Jxs = 0 and Jxx ≤ Jss: a line along x has no finite disparity.
  const IntVec has_slope = steep > 1e-6F * trace + tiny;
  const Vec slope = -2.0F * xs / select(has_slope, steep, splat(1));
  const Vec coherence = root / (trace + noise_energy + tiny);
  return {select(has_slope, slope, splat(1e6F)), select(has_slope, coherence, splat(0))};
}

template <int kCount>
void orient_row(const float* const* tensor, int stride, const float* taps, float noise_energy,
                const Shear& shear, int length, float* __restrict disparity,
                float* __restrict coherence) {
  const Vec upright = splat(0.5F * static_cast<float>(shear.half_steps));
  for (int n = 0; n < length; n += kLanes) {
    const Orientation local = orientation(integrate_at<kCount>(tensor[0] + n, stride, taps),
                                          integrate_at<kCount>(tensor[1] + n, stride, taps),
                                          integrate_at<kCount>(tensor[2] + n, stride, taps),
                                          splat(noise_energy));
    const Vec value = local.disparity + upright;
    const IntVec inside = (local.disparity <= shear.limit) & (local.disparity >= -shear.limit) &
                          (value >= shear.min) & (value <= shear.max);
    const Vec best = load(coherence + n);
    const Vec candidate = select(inside, local.coherence, splat(0));
    const IntVec better = candidate > best;
    store(coherence + n, select(better, candidate, best));
    store(disparity + n, select(better, value, load(disparity + n)));
  }
}

void orient(const TensorBlock& block, const TensorFilters& filters, const Shear& shear) {
  for (int r = block.first_row; r < block.last_row; ++r) {
    // The payload pixel x of row r stands at x + k·(r − center) of the sheared block.
    const int half_steps = shear.half_steps * (r - shear.center_row);
    const bool half = (half_steps & 1) != 0;
    const Taps& taps = half ? filters.integrate_half : filters.integrate;
    const int first = (half_steps >> 1) - filters.integrate.radius;
    const long row = static_cast<long>(r) * block.pitch;
    const long from = row + block.margin + static_cast<long>(first) * block.stride;
    const float* const tensor[3] = {block.tensor[0] + from, block.tensor[1] + from,
                                    block.tensor[2] + from};
    const auto run = [&](auto kernel) {
      kernel(tensor, block.stride, taps.values, filters.noise_energy, shear, block.length,
             block.disparity + row, block.coherence + row);
    };
    switch (2 * filters.integrate.radius + (half ? 2 : 1)) {
      case 1: run(orient_row<1>); break;
      case 2: run(orient_row<2>); break;
      case 3: run(orient_row<3>); break;
      case 4: run(orient_row<4>); break;
      case 5: run(orient_row<5>); break;
      case 6: run(orient_row<6>); break;
      case 7: run(orient_row<7>); break;
      case 8: run(orient_row<8>); break;
      case 9: run(orient_row<9>); break;
      case 10: run(orient_row<10>); break;
      case 11: run(orient_row<11>); break;
      case 12: run(orient_row<12>); break;
      default: run(orient_row<13>); break;
    }
  }
}

}  // namespace

extern const TensorKernel kTensorKernel;
const TensorKernel kTensorKernel{deinterleave, differentiate, accumulate, orient};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
