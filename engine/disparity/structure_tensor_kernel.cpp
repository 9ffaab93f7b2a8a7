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

inline Vec load(const float* from) {
  return *reinterpret_cast<const LooseVec*>(from);
}
inline void store(float* to, Vec value) {
  *reinterpret_cast<LooseVec*>(to) = value;
}
inline Vec splat(float value) {
  return value - Vec{};
}
inline Vec choose(IntVec mask, Vec yes, Vec no) {
  return mask ? yes : no;
}
inline Vec square_root(Vec value) {
  Vec root;
  for (int i = 0; i < kLanes; ++i) root[i] = __builtin_sqrtf(value[i]);
  return root;
}

typedef std::uint8_t Bytes __attribute__((vector_size(16)));

constexpr float kSampleScale = 1.0F / 255;

// Where sample i of a channel stands among 48 interleaved bytes: gathered from the first two
// vectors, then from the third.
constexpr int from_two(int i, int channel) {
  return 3 * i + channel < 32 ? 3 * i + channel : 0;
}
constexpr int from_third(int i, int channel) {
  return 3 * i + channel < 32 ? i : 3 * i + channel - 16;
}

template <int kChannel>
inline void store_channel(Bytes first, Bytes second, Bytes third, float* out) {
  const Bytes low = __builtin_shufflevector(
      first, second, from_two(0, kChannel), from_two(1, kChannel), from_two(2, kChannel),
      from_two(3, kChannel), from_two(4, kChannel), from_two(5, kChannel), from_two(6, kChannel),
      from_two(7, kChannel), from_two(8, kChannel), from_two(9, kChannel), from_two(10, kChannel),
      from_two(11, kChannel), from_two(12, kChannel), from_two(13, kChannel),
      from_two(14, kChannel), from_two(15, kChannel));
  const Bytes all = __builtin_shufflevector(
      low, third, from_third(0, kChannel), from_third(1, kChannel), from_third(2, kChannel),
      from_third(3, kChannel), from_third(4, kChannel), from_third(5, kChannel),
      from_third(6, kChannel), from_third(7, kChannel), from_third(8, kChannel),
      from_third(9, kChannel), from_third(10, kChannel), from_third(11, kChannel),
      from_third(12, kChannel), from_third(13, kChannel), from_third(14, kChannel),
      from_third(15, kChannel));
  // Through memory: the compiler widens a loop, but takes vector conversions apart.
  std::uint8_t bytes[16];
  __builtin_memcpy(bytes, &all, sizeof bytes);
  for (int i = 0; i < 16; ++i) out[i] = kSampleScale * static_cast<float>(bytes[i]);
}

void deinterleave(const std::uint8_t* in, int count, int channels, float* const* out) {
  if (channels == 1) {
    for (int i = 0; i < count; ++i) out[0][i] = kSampleScale * static_cast<float>(in[i]);
    return;
  }
  int i = 0;
  for (; i + 16 <= count; i += 16) {
    Bytes bytes[3];
    __builtin_memcpy(bytes, in + 3 * static_cast<long>(i), sizeof bytes);
    store_channel<0>(bytes[0], bytes[1], bytes[2], out[0] + i);
    store_channel<1>(bytes[0], bytes[1], bytes[2], out[1] + i);
    store_channel<2>(bytes[0], bytes[1], bytes[2], out[2] + i);
  }
  for (; i < count; ++i) {
    for (int c = 0; c < 3; ++c) out[c][i] = kSampleScale * static_cast<float>(in[3 * i + c]);
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
    if (!with_half) continue;
    half_pixel_row(smooth, smooth_begin + stride, smooth_end - 2 * stride, stride, half);
    gradient_row(half, smooth_begin + 2 * stride, smooth_end - 3 * stride, stride,
                 block.along[1] + offset, block.across[1] + offset);
  }
}

int floor_half(int half_steps) {
  return half_steps >> 1;
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

struct Products {
  Vec xx, xs, ss;
};

// Gradient of `count` source rows at lane n, one channel, added to the products.
template <int kCount>
inline void add_products(const float* const* along, const float* const* across, const float* smooth,
                         const float* derivative, int n, Products& sum) {
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
                    float contrast, int begin, int end, float* __restrict const* out) {
  for (int n = begin; n < end; n += kLanes) {
    Products sum{};
    for (int c = 0; c < kChannels; ++c) {
      add_products<kCount>(rows.along[c], rows.across[c], smooth.values, derivative.values, n, sum);
    }
    // A silhouette must not drown the weaker texture beside it: strong gradients are toned down.
    const Vec weight = contrast / (sum.xx + sum.ss + contrast);
    store(out[0] + n, weight * sum.xx);
    store(out[1] + n, weight * sum.xs);
    store(out[2] + n, weight * sum.ss);
  }
}

template <int kChannels>
void products_row(const RowPointers& rows, const RowTaps& smooth, const RowTaps& derivative,
                  float contrast, int begin, int end, float* const* out) {
  switch (smooth.count) {
    case 2:
      return products_chunk<2, kChannels>(rows, smooth, derivative, contrast, begin, end, out);
    case 3:
      return products_chunk<3, kChannels>(rows, smooth, derivative, contrast, begin, end, out);
    case 4:
      return products_chunk<4, kChannels>(rows, smooth, derivative, contrast, begin, end, out);
    case 5:
      return products_chunk<5, kChannels>(rows, smooth, derivative, contrast, begin, end, out);
    case 6:
      return products_chunk<6, kChannels>(rows, smooth, derivative, contrast, begin, end, out);
    case 7:
      return products_chunk<7, kChannels>(rows, smooth, derivative, contrast, begin, end, out);
    case 8:
      return products_chunk<8, kChannels>(rows, smooth, derivative, contrast, begin, end, out);
    case 9:
      return products_chunk<9, kChannels>(rows, smooth, derivative, contrast, begin, end, out);
    case 10:
      return products_chunk<10, kChannels>(rows, smooth, derivative, contrast, begin, end, out);
    case 11:
      return products_chunk<11, kChannels>(rows, smooth, derivative, contrast, begin, end, out);
    case 12:
      return products_chunk<12, kChannels>(rows, smooth, derivative, contrast, begin, end, out);
    default:
      return products_chunk<13, kChannels>(rows, smooth, derivative, contrast, begin, end, out);
  }
}

// The widest grid axis whose products of a chunk are kept on the stack.
constexpr int kMaxRows = 32;

void fill_pointers(const TensorBlock& block, const Shear& shear, const RowTaps& taps, int chunk,
                   RowPointers& rows) {
  const long plane = static_cast<long>(block.rows) * block.pitch;
  for (int i = 0; i < taps.count; ++i) {
    const RowSource source = source_of(block, shear, taps.first + i);
    for (int c = 0; c < block.channels; ++c) {
      rows.along[c][i] = block.along[source.half] + c * plane + source.offset + chunk;
      rows.across[c][i] = block.across[source.half] + c * plane + source.offset + chunk;
    }
  }
}

// Lanes of the sheared coordinates, [begin, end).
struct Window {
  int begin = 0;
  int end = 0;
};

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

void integrate_rows(const float (*products)[kChunk + kLanes], const RowTaps& taps, Window window,
                    float* __restrict out) {
  for (int n = window.begin; n < window.end; n += kLanes) {
    Vec sum = taps.values[0] * load(products[taps.first] + n);
    for (int i = 1; i < taps.count; ++i) {
      sum += taps.values[i] * load(products[taps.first + i] + n);
    }
    store(out + n, sum);
  }
}

// The part of a window inside a chunk, relative to the chunk's first lane.
Window clip(Window window, int chunk) {
  const int begin = window.begin - chunk;
  const int end = window.end - chunk;
  return {begin < 0 ? 0 : begin, end > kChunk ? kChunk : end};
}

struct ChunkProducts {
  // Vectors may begin anywhere and reach beyond the chunk.
  alignas(64) float values[3][kMaxRows][kChunk + kLanes];
};

void fill_products(const TensorBlock& block, const TensorFilters& filters, const Shear& shear,
                   int row, int chunk, Window window, ChunkProducts& products) {
  RowPointers rows;
  const RowTaps& smooth = filters.row_smooth[row];
  fill_pointers(block, shear, smooth, chunk, rows);
  float* const out[3] = {products.values[0][row], products.values[1][row], products.values[2][row]};
  const auto run = block.channels == 1 ? products_row<1> : products_row<3>;
  run(rows, smooth, filters.row_derivative[row], filters.contrast_energy, window.begin, window.end,
      out);
}

void accumulate(const TensorBlock& block, const TensorFilters& filters, const Shear& shear) {
  ChunkProducts products;
  Window sources[kMaxRows];
  Window whole{0, 0};
  for (int r = 0; r < block.rows; ++r) {
    sources[r] = source_window(block, filters, shear, r);
    if (sources[r].begin < whole.begin) whole.begin = sources[r].begin;
    if (sources[r].end > whole.end) whole.end = sources[r].end;
  }
  for (int chunk = whole.begin; chunk < whole.end; chunk += kChunk) {
    for (int r = 0; r < block.rows; ++r) {
      const Window window = clip(sources[r], chunk);
      if (window.begin < window.end) {
        fill_products(block, filters, shear, r, chunk, window, products);
      }
    }
    for (int r = block.first_row; r < block.last_row; ++r) {
      const Window window = clip(target_window(block, filters, shear, r), chunk);
      const long row = static_cast<long>(r) * block.tensor_pitch + block.tensor_margin + chunk;
      for (int j = 0; j < 3; ++j) {
        integrate_rows(products.values[j], filters.row_integrate[r], window, block.tensor[j] + row);
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

// Slope and coherence of a tensor (Bigün and Granlund 1987) in the angle-free form, for upright
// structure: d = −2Jxs/(Jxx − Jss + √((Jxx − Jss)² + 4Jxs²)).
struct Orientation {
  Vec disparity, coherence;
};

inline Orientation orientation(Vec xx, Vec xs, Vec ss, Vec noise_energy) {
  const Vec difference = xx - ss;
  const Vec trace = xx + ss;
  const Vec root = square_root(difference * difference + 4.0F * xs * xs);
  const Vec tiny = splat(1e-20F);
  const Vec steep = difference + root;
  // Jxs = 0 and Jxx ≤ Jss: a line along x has no finite disparity.
  const IntVec has_slope = steep > 1e-6F * trace + tiny;
  const Vec slope = -2.0F * xs / choose(has_slope, steep, splat(1));
  const Vec coherence = root / (trace + noise_energy + tiny);
  return {choose(has_slope, slope, splat(1e6F)), choose(has_slope, coherence, splat(0))};
}

template <int kCount>
void select_row(const float* const* tensor, int stride, const float* taps, float noise_energy,
                const Shear& shear, int length, float* __restrict const* best) {
  const Vec upright = splat(0.5F * static_cast<float>(shear.half_steps));
  for (int n = 0; n < length; n += kLanes) {
    const Vec xx = integrate_at<kCount>(tensor[0] + n, stride, taps);
    const Vec xs = integrate_at<kCount>(tensor[1] + n, stride, taps);
    const Vec ss = integrate_at<kCount>(tensor[2] + n, stride, taps);
    const Orientation local = orientation(xx, xs, ss, splat(noise_energy));
    const Vec value = local.disparity + upright;
    const IntVec inside = (local.disparity <= shear.limit) & (local.disparity >= -shear.limit) &
                          (value >= shear.min) & (value <= shear.max);
    const Vec so_far = load(best[3] + n);
    const IntVec better = inside & (local.coherence > so_far);
    // Back to unsheared coordinates: ∂s = ∂s' − k ∂x.
    const Vec unsheared_xs = xs - upright * xx;
    const Vec unsheared_ss = ss - upright * (xs + unsheared_xs);
    store(best[0] + n, choose(better, xx, load(best[0] + n)));
    store(best[1] + n, choose(better, unsheared_xs, load(best[1] + n)));
    store(best[2] + n, choose(better, unsheared_ss, load(best[2] + n)));
    store(best[3] + n, choose(better, local.coherence, so_far));
  }
}

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
    const auto run = [&](auto kernel) {
      kernel(tensor, block.stride, taps.values, filters.noise_energy, shear, block.length, best);
    };
    switch (2 * filters.integrate.radius + (half ? 2 : 1)) {
      case 1:
        run(select_row<1>);
        break;
      case 2:
        run(select_row<2>);
        break;
      case 3:
        run(select_row<3>);
        break;
      case 4:
        run(select_row<4>);
        break;
      case 5:
        run(select_row<5>);
        break;
      case 6:
        run(select_row<6>);
        break;
      case 7:
        run(select_row<7>);
        break;
      case 8:
        run(select_row<8>);
        break;
      case 9:
        run(select_row<9>);
        break;
      case 10:
        run(select_row<10>);
        break;
      case 11:
        run(select_row<11>);
        break;
      case 12:
        run(select_row<12>);
        break;
      default:
        run(select_row<13>);
        break;
    }
  }
}

// Least squares of ∂s + d ∂x = 0 over the averaged tensor; coherence in the frame sheared by d.
void resolve(const TensorAverage& average) {
  for (int n = 0; n < average.length; n += kLanes) {
    Vec sum[3];
    for (int j = 0; j < 3; ++j) {
      sum[j] = average.weights[0] * load(average.tensor[0][j] + n);
      for (int i = 1; i < average.count; ++i) {
        sum[j] += average.weights[i] * load(average.tensor[i][j] + n);
      }
    }
    const Vec xx = sum[0] + 1e-20F;
    const Vec disparity = -sum[1] / xx;
    Vec residual = sum[2] + disparity * sum[1];
    residual = choose(residual > 0.0F, residual, splat(0));
    Vec coherence = (xx - residual) / (xx + residual + average.noise_energy);
    const IntVec inside = (disparity >= average.min) & (disparity <= average.max);
    coherence = choose(inside & (coherence > 0.0F), coherence, splat(0));
    const Vec above = choose(disparity < average.min, splat(average.min), disparity);
    store(average.disparity + n, choose(above > average.max, splat(average.max), above));
    store(average.coherence + n, coherence);
  }
}

inline Vec absolute(Vec value) {
  return choose(value < 0.0F, -value, value);
}

inline Vec raised(Vec base, int power) {
  Vec result = splat(1);
  for (; power > 0; power >>= 1) {
    if ((power & 1) != 0) result *= base;
    base *= base;
  }
  return result;
}

// Directions that agree within this many px are averaged.
constexpr float kAgreement = 0.3F;

inline void merge_at(const float* disparity, const float* coherence, int power, float* to_disparity,
                     float* to_coherence) {
  const Vec here = load(coherence);
  const Vec there = load(to_coherence);
  const Vec value = load(disparity);
  const Vec other = load(to_disparity);
  const IntVec agree = (absolute(value - other) < kAgreement) & (here > 0.0F) & (there > 0.0F);
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

}  // namespace

extern const TensorKernel kTensorKernel;
const TensorKernel kTensorKernel{deinterleave, differentiate, accumulate, select, resolve, merge};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
