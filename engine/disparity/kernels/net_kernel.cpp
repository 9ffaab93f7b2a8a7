// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/kernels/net_kernel.h"

#include "engine/core/simd.h"

// Compiled once for each instruction set: see engine/core/isa.h for what may stand here.

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

constexpr int kGroup = 16;
constexpr int kGroupVecs = kGroup / kLanes;
constexpr float kLeakySlope = 0.1F;

// Sums of as many columns as registers hold, for one group of outputs or two.
#if EPISCOPE_VECTOR_BYTES == 64
constexpr int kColumns[2] = {14, 12};
#elif EPISCOPE_VECTOR_BYTES == 32
constexpr int kColumns[2] = {6, 2};
#else
constexpr int kColumns[2] = {2, 1};
#endif

inline Vec leaky(Vec value) {
  return greatest(value, value * kLeakySlope);
}

template <int kGroups, int kCount, int kStep>
inline void convolve_tile(const NetConvolutionRow& row, int group, int x) {
  constexpr int kVecs = kGroups * kGroupVecs;
  Vec sums[kCount][kVecs];
  for (int i = 0; i < kVecs; ++i) {
    const Vec bias = load(row.bias + group * kGroup + i * kLanes);
    for (int p = 0; p < kCount; ++p) sums[p][i] = bias;
  }
  const long first_weight = group * row.group_stride;
  for (int t = 0; t < row.tap_count; ++t) {
    const float* from = row.taps[t].from + static_cast<long>(x) * kStep;
    const float* weights = row.taps[t].weights + first_weight;
    const float* const end = from + row.inputs;
    for (; from != end; ++from, weights += kGroup) {
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
  for (int p = 0; p < kCount; ++p) {
    const long at = static_cast<long>(x + p) * row.out_step + group * kGroup;
    for (int i = 0; i < kVecs; ++i) {
      Vec sum = sums[p][i];
      if (row.before != nullptr) sum += load(row.before + at + i * kLanes);
      if (row.is_leaky) sum = leaky(sum);
      if (row.after != nullptr) sum += load(row.after + at + i * kLanes);
      store(row.out + at + i * kLanes, sum);
    }
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

template <int kStep>
void convolve_steps(const NetConvolutionRow& row) {
  int group = 0;
  if constexpr (kGroupVecs == 1) {
    for (; group + 2 <= row.outputs / kGroup; group += 2) convolve_groups<2, kStep>(row, group);
  }
  for (; group < row.outputs / kGroup; ++group) convolve_groups<1, kStep>(row, group);
}

void convolve(const NetConvolutionRow& row) {
  switch (row.input_step) {
    case 16:
      return convolve_steps<16>(row);
    case 32:
      return convolve_steps<32>(row);
    case 48:
      return convolve_steps<48>(row);
    case 64:
      return convolve_steps<64>(row);
    case 96:
      return convolve_steps<96>(row);
    case 128:
      return convolve_steps<128>(row);
    default:
      return convolve_steps<192>(row);
  }
}

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
    row.out[static_cast<long>(x + p) * row.out_step + output] =
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

// Evidence. A pixel of a view is one register of eight numbers whatever the instruction set.

typedef float Eight __attribute__((vector_size(32)));
typedef float LooseEight __attribute__((vector_size(32), aligned(4), may_alias));
typedef int EightInts __attribute__((vector_size(32)));

inline Eight load_pixel(const float* from) {
  return *reinterpret_cast<const LooseEight*>(from);
}
inline Eight distance(Eight a, Eight b) {
  const Eight difference = a - b;
  const EightInts bits = reinterpret_cast<EightInts>(difference) & 0x7fffffff;
  return reinterpret_cast<Eight>(bits);
}

template <bool kHasInvalid>
inline Eight counted(Eight off) {
  if constexpr (kHasInvalid) return off == off ? off : Eight{};
  return off;
}

inline void add_to(float* sum, Eight off) {
  *reinterpret_cast<LooseEight*>(sum) = load_pixel(sum) + off;
}

// The rows of a view around a coordinate, and the weight of the second.
struct RowPair {
  const float* upper;
  const float* lower;
  float weight;
};

// Sums of pixels [begin, end) of a row, and what is added to them.
struct Run {
  const float* reference;  // Of its first pixel.
  int begin;
  int end;
  float* sums;
};

// Pixels [first, last) of a run, whose samples lie `part` behind the pixels at `from`.
template <bool kHasInvalid, bool kIsBetween>
void add_columns(const Run& run, int first, int last, const RowPair& from, float part) {
  const auto column = [&](long at) {
    const Eight above = load_pixel(from.upper + at);
    return above + (load_pixel(from.lower + at) - above) * from.weight;
  };
  Eight left = column(first * kNetPixel);
  for (long at = first * kNetPixel; at < last * kNetPixel; at += kNetPixel) {
    Eight sample = kIsBetween ? left : column(at);
    if constexpr (kIsBetween) {
      const Eight right = column(at + kNetPixel);
      sample += (right - left) * part;
      left = right;
    }
    const long i = at - static_cast<long>(run.begin) * kNetPixel;
    add_to(run.sums + i, counted<kHasInvalid>(distance(sample, load_pixel(run.reference + i))));
  }
}

// Adds how far one view is from the reference, at one disparity.
template <bool kHasInvalid>
void add_plane(const NetEvidenceRow& row, const NetView& view, const Run& run) {
  const float y = static_cast<float>(row.y) - row.disparity * view.dv;
  if (!(y >= 0 && y <= static_cast<float>(row.height - 1))) return;
  const int upper = static_cast<int>(y);
  const int lower = upper + 1 < row.height ? upper + 1 : upper;
  const float shift = -row.disparity * view.du;
  const int whole = static_cast<int>(__builtin_floorf(shift));
  const float part = shift - static_cast<float>(whole);
  // Pixels whose sample x + shift lies in [0, width − 1].
  const int first = run.begin > -whole ? run.begin : -whole;
  const int end_within = row.width - whole - (part > 0 ? 1 : 0);
  const int last = run.end < end_within ? run.end : end_within;
  if (first >= last) return;
  const auto pixels = [&](int at) {
    return view.pixels + (at - view.first_row) * view.row_stride + whole * kNetPixel;
  };
  const RowPair from{pixels(upper), pixels(lower), y - static_cast<float>(upper)};
  if (part > 0) return add_columns<kHasInvalid, true>(run, first, last, from, part);
  add_columns<kHasInvalid, false>(run, first, last, from, part);
}

// Where the pixels of a run are sampled.
struct Places {
  int offset[kNetRun];    // Of the first of four pixels, in the rows that are held.
  float along[kNetRun];   // Weights of the second column
  float down[kNetRun];    // and row.
  float within[kNetRun];  // 1 or 0
};

// An axis: coordinates clamped, the first of two places, the second never outside.
struct Axis {
  IntVec first;
  Vec weight;
  IntVec is_within;
};

inline Axis axis_at(Vec at, int size) {
  const Vec last = splat(static_cast<float>(size - 1));
  const IntVec is_within = (at >= 0.0F) & (at <= last);
  const Vec inside = greatest(least(at, last), Vec{});
  const IntVec first = least(convert<int>(inside), IntVec{} + (size > 1 ? size - 2 : 0));
  return {first, inside - convert<float>(first), is_within};
}

void find_places(const NetEvidenceRow& row, const NetView& view, const Run& run, Places& places) {
  IntVec column;
  for (int i = 0; i < kLanes; ++i) column[i] = run.begin + i;
  alignas(64) float disparities[kNetRun] = {};
  for (int i = run.begin; i < run.end; ++i) disparities[i - run.begin] = row.disparities[i];
  for (int i = 0; i < kNetRun; i += kLanes, column += kLanes) {
    const Vec d = load(disparities + i);
    const Axis x = axis_at(convert<float>(column) - d * view.du, row.width);
    const Axis y = axis_at(static_cast<float>(row.y) - d * view.dv, row.height);
    const IntVec offset =
        (y.first - view.first_row) * static_cast<int>(view.row_stride) + x.first * kNetPixel;
    __builtin_memcpy(places.offset + i, &offset, sizeof offset);
    store(places.along + i, x.weight);
    store(places.down + i, y.weight);
    store(places.within + i, choose(x.is_within & y.is_within, splat(1), Vec{}));
  }
}

// The same where each pixel has its own disparity.
template <bool kHasInvalid>
void add_map(const NetEvidenceRow& row, const NetView& view, const Run& run) {
  Places places;
  find_places(row, view, run, places);
  const long right = row.width > 1 ? kNetPixel : 0;
  const long below = row.height > 1 ? view.row_stride : 0;
  for (int i = 0; i < run.end - run.begin; ++i) {
    const float* const from = view.pixels + places.offset[i];
    const Eight upper = load_pixel(from);
    const Eight lower = load_pixel(from + below);
    const Eight first = upper + (load_pixel(from + right) - upper) * places.along[i];
    const Eight second = lower + (load_pixel(from + below + right) - lower) * places.along[i];
    const Eight sample = first + (second - first) * places.down[i];
    const Eight off = distance(sample, load_pixel(run.reference + i * kNetPixel));
    add_to(run.sums + i * kNetPixel, counted<kHasInvalid>(off) * places.within[i]);
  }
}

template <bool kHasInvalid>
inline void add_view(const NetEvidenceRow& row, const NetView& view, const Run& run) {
  if (row.disparities == nullptr) return add_plane<kHasInvalid>(row, view, run);
  add_map<kHasInvalid>(row, view, run);
}

inline Vec evidence_of(Vec sum, Vec count, float channels) {
  constexpr float kFloor = 0.003F, kAdd = 4.2F, kScale = 0.8F, kNone = 1.5F;
  const Vec mean = sum / (greatest(count, splat(1)) * channels);
  const Vec value = (natural_log(mean + kFloor) + kAdd) * kScale;
  return choose(count > 0.0F, value, splat(kNone));
}

// Evidence of one sector from the sums of a run of pixels.
void finish_sector(const NetEvidenceRow& row, const float* sums, int sector, int begin, int end) {
  float parts[3][kNetRun];
  for (int i = 0; i < kNetRun; ++i) {
    const float* const sum = sums + i * kNetPixel;
    parts[0][i] = sum[0] + sum[1] + sum[2];
    parts[1][i] = sum[3] + sum[4];
    parts[2][i] = sum[5];
  }
  for (int i = 0; i < kNetRun; i += kLanes) {
    const Vec count = load(parts[2] + i);
    store(parts[0] + i, evidence_of(load(parts[0] + i), count, 3));
    store(parts[1] + i, evidence_of(load(parts[1] + i), count, 2));
  }
  for (int i = 0; i < end - begin; ++i) {
    float* const out = row.out + static_cast<long>(begin + i) * row.out_step;
    out[sector] = parts[0][i];
    out[8 + sector] = parts[1][i];
  }
}

void evidence(const NetEvidenceRow& row) {
  for (int begin = 0; begin < row.width; begin += kNetRun) {
    const int end = begin + kNetRun < row.width ? begin + kNetRun : row.width;
    for (int k = 0; k < 8; ++k) {
      alignas(64) float sums[kNetRun * kNetPixel] = {};
      const Run run{row.reference + static_cast<long>(begin) * kNetPixel, begin, end, sums};
      for (int i = row.sector_begin[k]; i < row.sector_begin[k + 1]; ++i) {
        if (row.has_invalid) {
          add_view<true>(row, row.views[i], run);
        } else {
          add_view<false>(row, row.views[i], run);
        }
      }
      finish_sector(row, sums, k, begin, end);
    }
  }
}

}  // namespace

const NetKernel kNetKernel = {convolve, convolve_narrow, enlarge, evidence};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
