// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/kernels/net_kernel.h"

#include "engine/core/simd.h"
#include "engine/disparity/kernels/net_constants.h"

// Compiled once for each instruction set: see engine/core/isa.h for what may stand here.

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

constexpr int kGroup = 16;
constexpr int kGroupVecs = kGroup / kLanes;
constexpr int kWeightsAhead = 24 * kGroup;  // So far weights are fetched before they are used.

// Sums of as many columns as registers hold, for one group of outputs or two.
#if EPISCOPE_VECTOR_BYTES == 64
constexpr int kColumns[2] = {14, 12};
constexpr int kMixedColumns = 12;
#elif EPISCOPE_VECTOR_BYTES == 32
constexpr int kColumns[2] = {6, 2};
constexpr int kMixedColumns = 6;
#else
constexpr int kColumns[2] = {2, 1};
constexpr int kMixedColumns = 2;
#endif

// A number as a type, which functions without a name can be given.
template <int kValue>
struct Whole {
  static constexpr int value = kValue;
};

inline Vec leaky(Vec value) {
  return greatest(value, value * kNetLeak);
}

// The sums of products of kCount inputs, kStep apart, and of groups of outputs.
template <int kGroups, int kCount, int kStep>
[[gnu::always_inline]] inline void add_products(const NetConvolutionRow& row, long from_at,
                                                long weights_at,
                                                Vec (&sums)[kCount][kGroups * kGroupVecs]) {
  constexpr int kVecs = kGroups * kGroupVecs;
  for (int t = 0; t < row.tap_count; ++t) {
    const float* from = row.taps[t].from + from_at;
    const float* weights = row.taps[t].weights + weights_at;
    const float* const end = from + row.inputs;
    for (; from != end; ++from, weights += kGroup) {
      __builtin_prefetch(weights + kWeightsAhead);
      Vec weight[kVecs];
      for (int i = 0; i < kVecs; ++i) {
        weight[i] = load(weights + i / kGroupVecs * row.group_stride + i % kGroupVecs * kLanes);
      }
#pragma GCC unroll 16
      for (int p = 0; p < kCount; ++p) {
        const Vec value = splat(from[p * kStep]);
        for (int i = 0; i < kVecs; ++i) sums[p][i] += weight[i] * value;
      }
    }
  }
}

inline void finish(const NetOutput& to, long at, bool is_leaky, Vec sum) {
  if (to.before != nullptr) sum += load(to.before + at);
  if (is_leaky) sum = leaky(sum);
  if (to.after != nullptr) sum += load(to.after + at);
  store(to.out + at, sum);
}

template <int kGroups, int kCount, int kStep>
inline void convolve_tile(const NetConvolutionRow& row, int group, int x) {
  constexpr int kVecs = kGroups * kGroupVecs;
  Vec sums[kCount][kVecs];
  for (int i = 0; i < kVecs; ++i) {
    const Vec bias = load(row.bias + group * kGroup + i * kLanes);
    for (int p = 0; p < kCount; ++p) sums[p][i] = bias;
  }
  add_products<kGroups, kCount, kStep>(row, static_cast<long>(x) * kStep, group * row.group_stride,
                                       sums);
  for (int p = 0; p < kCount; ++p) {
    const long at = static_cast<long>(x + p) * row.out_step + group * kGroup;
    for (int i = 0; i < kVecs; ++i) finish(row.out, at + i * kLanes, row.is_leaky, sums[p][i]);
  }
}

// The last columns are computed together with some before them a second time.
template <int kGroups, int kStep>
void convolve_groups(const NetConvolutionRow& row, int group) {
  constexpr int kCount = kColumns[kGroups - 1];
  if (row.columns < kCount) {
    for (int x = 0; x < row.columns; ++x) convolve_tile<kGroups, 1, kStep>(row, group, x);
    return;
  }
  int x = 0;
  for (; x + kCount <= row.columns; x += kCount) {
    convolve_tile<kGroups, kCount, kStep>(row, group, x);
  }
  if (x < row.columns) convolve_tile<kGroups, kCount, kStep>(row, group, row.columns - kCount);
}

// Calls `convolve_groups` for all groups of outputs, two at a time where registers hold as many.
template <class ConvolveGroups>
inline void for_groups(const NetConvolutionRow& row, const ConvolveGroups& convolve_groups) {
  int group = 0;
  if constexpr (kGroupVecs == 1) {
    for (; group + 2 <= row.outputs / kGroup; group += 2) convolve_groups(Whole<2>(), group);
  }
  for (; group < row.outputs / kGroup; ++group) convolve_groups(Whole<1>(), group);
}

// Calls `convolve_steps` with the distance of inputs as a constant.
template <class ConvolveSteps>
inline void for_step(int step, const ConvolveSteps& convolve_steps) {
  switch (step) {
    case 16:
      return convolve_steps(Whole<16>());
    case 32:
      return convolve_steps(Whole<32>());
    case 48:
      return convolve_steps(Whole<48>());
    case 64:
      return convolve_steps(Whole<64>());
    case 96:
      return convolve_steps(Whole<96>());
    case 128:
      return convolve_steps(Whole<128>());
    case 192:
      return convolve_steps(Whole<192>());
    case 256:
      return convolve_steps(Whole<256>());
    default:
      __builtin_trap();  // A layer of other channels needs a case.
  }
}

void convolve(const NetConvolutionRow& row) {
  for_step(row.input_step, [&](auto step) {
    for_groups(row, [&](auto groups, int group) {
      convolve_groups<groups.value, step.value>(row, group);
    });
  });
}

// Mixed convolutions.

constexpr float kRootOfHalf = 0.70710678F;
constexpr float kRootOfTwo = 1.41421356F;

inline void mix_six(const Vec (&d)[kNetMixed], Vec (&mixed)[kNetMixed]) {
  const Vec even = d[4] - d[2] * 2.0F, odd = (d[3] - d[1] * 2.0F) * kRootOfHalf;
  const Vec wide_even = d[4] - d[2] * 0.5F, wide_odd = (d[3] - d[1] * 0.5F) * kRootOfTwo;
  mixed[0] = d[4] - d[2] * 2.5F + d[0];
  mixed[1] = even + odd;
  mixed[2] = even - odd;
  mixed[3] = wide_even + wide_odd;
  mixed[4] = wide_even - wide_odd;
  mixed[5] = d[5] - d[3] * 2.5F + d[1];
}

inline void unmix_six(const Vec (&m)[kNetMixed], Vec (&sums)[kNetTile]) {
  const Vec even = m[1] + m[2], odd = (m[1] - m[2]) * kRootOfHalf;
  const Vec wide_even = m[3] + m[4], wide_odd = (m[3] - m[4]) * kRootOfTwo;
  sums[0] = m[0] + even + wide_even;
  sums[1] = odd + wide_odd;
  sums[2] = even * 0.5F + wide_even * 2.0F;
  sums[3] = odd * 0.5F + wide_odd * 2.0F + m[5];
}

inline int first_column(const NetBlock& block, int tile) {
  const int at = block.first + tile;
  return at / block.dilation * kNetTile * block.dilation + at % block.dilation;
}

// As many channels of a tile as a register holds, `first` numbers from the first output's.
template <int kPlanes>
inline void mix_tile(const NetMixing& mixing, long first, float* out) {
  const long step = static_cast<long>(mixing.block.dilation) * mixing.channels;
  const long channels = mixing.channels;
  Vec planes[kPlanes][kNetMixed];
  for (int z = 0; z < kPlanes; ++z) {
    Vec row[kNetMixed] = {};
    if (const float* from = mixing.rows[z]; from != nullptr) {
      from += first - step;
      for (int i = 0; i < kNetMixed; ++i, from += step) row[i] = load(from);
    }
    mix_six(row, planes[z]);
  }
  for (int i = 0; i < kNetMixed; ++i, out += channels) {
    if constexpr (kPlanes == 1) {
      store(out, planes[0][i]);
    } else {
      Vec column[kNetMixed], mixed[kNetMixed];
      for (int z = 0; z < kNetMixed; ++z) column[z] = planes[z][i];
      mix_six(column, mixed);
      for (int z = 0; z < kNetMixed; ++z) store(out + z * kNetMixed * channels, mixed[z]);
    }
  }
}

template <int kPlanes>
void mix_tiles(const NetMixing& mixing) {
  const int channels = mixing.channels;
  float* out = mixing.out;
  for (int tile = 0; tile < mixing.block.count; ++tile) {
    const long first = static_cast<long>(first_column(mixing.block, tile)) * channels;
    for (int c = 0; c < channels; c += kLanes) mix_tile<kPlanes>(mixing, first + c, out + c);
    out += kPlanes * kNetMixed * channels;
  }
}

void mix(const NetMixing& mixing) {
  mixing.planes == 1 ? mix_tiles<1>(mixing) : mix_tiles<kNetMixed>(mixing);
}

// Outputs of the tile that begins with column x and of as many channels as a register holds, from
// products `stride` apart.
template <int kPlanes>
inline void finish_mixed(const NetMixedRow& row, const float* products, long stride, int x,
                         int channel) {
  constexpr int kRows = kPlanes == 1 ? 1 : kNetTile;
  Vec columns[kPlanes][kNetTile];
  for (int z = 0; z < kPlanes; ++z) {
    Vec mixed[kNetMixed];
    for (int i = 0; i < kNetMixed; ++i) mixed[i] = load(products + (z * kNetMixed + i) * stride);
    unmix_six(mixed, columns[z]);
  }
  const Vec bias = load(row.plain.bias + channel);
  for (int i = 0; i < kNetTile && x < row.plain.columns; ++i, x += row.block.dilation) {
    Vec sums[kRows];
    if constexpr (kPlanes == 1) {
      sums[0] = columns[0][i];
    } else {
      Vec mixed[kNetMixed];
      for (int z = 0; z < kNetMixed; ++z) mixed[z] = columns[z][i];
      unmix_six(mixed, sums);
    }
    const long at = static_cast<long>(x) * row.plain.out_step + channel;
    for (int z = 0; z < kRows; ++z) {
      if (row.outputs[z].out == nullptr) continue;
      finish(row.outputs[z], at, row.plain.is_leaky, sums[z] + bias);
    }
  }
}

template <int kPlanes, int kGroups, int kStep>
void convolve_mixed_groups(const NetMixedRow& row, int group) {
  constexpr int kVecs = kGroups * kGroupVecs, kKinds = kPlanes * kNetMixed;
  static_assert(kNetBlock % kMixedColumns == 0);
  alignas(64) float products[kKinds][kNetBlock + 1][kVecs * kLanes];  // Not a power of two.
  for (int kind = 0; kind < kKinds; ++kind) {
    for (int tile = 0; tile < row.block.count; tile += kMixedColumns) {
      Vec sums[kMixedColumns][kVecs] = {};
      add_products<kGroups, kMixedColumns, kKinds * kStep>(
          row.plain, kind * kStep + static_cast<long>(tile) * kKinds * kStep,
          kind * row.weights_stride + group * row.plain.group_stride, sums);
      for (int p = 0; p < kMixedColumns; ++p) {
        for (int i = 0; i < kVecs; ++i) store(products[kind][tile + p] + i * kLanes, sums[p][i]);
      }
    }
  }
  for (int tile = 0; tile < row.block.count; ++tile) {
    const int x = first_column(row.block, tile);
    for (int c = 0; c < kVecs * kLanes; c += kLanes) {
      finish_mixed<kPlanes>(row, products[0][tile] + c, (kNetBlock + 1) * kVecs * kLanes, x,
                            group * kGroup + c);
    }
  }
}

void convolve_mixed(const NetMixedRow& row) {
  for_step(row.plain.input_step, [&](auto step) {
    for_groups(row.plain, [&](auto groups, int group) {
      row.planes == 1 ? convolve_mixed_groups<1, groups.value, step.value>(row, group)
                      : convolve_mixed_groups<kNetMixed, groups.value, step.value>(row, group);
    });
  });
}

// Layers of few outputs.

inline float sum_of_lanes(Vec value) {
  float lanes[kLanes];
  store(lanes, value);
  for (int step = kLanes / 2; step > 0; step /= 2) {
    for (int i = 0; i < step; ++i) lanes[i] += lanes[i + step];
  }
  return lanes[0];
}

template <int kCount>
inline void narrow_tile(const NetConvolutionRow& row, int output, int x) {
  Vec sums[kCount] = {};
  for (int t = 0; t < row.tap_count; ++t) {
    const float* const from = row.taps[t].from + static_cast<long>(x) * row.input_step;
    const float* const weights = row.taps[t].weights + output * row.group_stride;
    for (int i = 0; i < row.inputs; i += kLanes) {
      const Vec weight = load(weights + i);
      for (int p = 0; p < kCount; ++p) sums[p] += weight * load(from + p * row.input_step + i);
    }
  }
  for (int p = 0; p < kCount; ++p) {
    row.out.out[static_cast<long>(x + p) * row.out_step + output] =
        row.bias[output] + sum_of_lanes(sums[p]);
  }
}

void convolve_narrow(const NetConvolutionRow& row) {
  constexpr int kCount = 8;
  for (int output = 0; output < row.outputs; ++output) {
    int x = 0;
    for (; x + kCount <= row.columns; x += kCount) narrow_tile<kCount>(row, output, x);
    for (; x < row.columns; ++x) narrow_tile<1>(row, output, x);
  }
}

inline Vec mixed(const NetEnlargedRow& row, long at) {
  Vec sum = row.weights[0] * load(row.rows[0] + at);
  for (int i = 1; i < 4; ++i) sum += row.weights[i] * load(row.rows[i] + at);
  return sum;
}

// Output 2i lies a quarter before source i, output 2i + 1 a quarter behind.
void enlarge(const NetEnlargedRow& row) {
  for (int x = 0; x < row.columns; ++x) {
    const int near = x / 2;
    int far = x % 2 == 0 ? near - 1 : near + 1;
    if (far < 0) far = 0;
    if (far > row.source_columns - 1) far = row.source_columns - 1;
    const long at = static_cast<long>(x) * row.channels;
    for (int c = 0; c < row.channels; c += kLanes) {
      const Vec value = 0.75F * mixed(row, static_cast<long>(near) * row.channels + c) +
                        0.25F * mixed(row, static_cast<long>(far) * row.channels + c);
      store(row.out + at + c, value + load(row.plus + at + c));
    }
  }
}

}  // namespace

const NetKernel kNetKernel = {convolve, convolve_narrow, convolve_mixed, mix, enlarge};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
