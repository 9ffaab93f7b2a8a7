// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/kernels/net_kernel.h"

#include "engine/core/simd.h"
#include "engine/disparity/kernels/shared_constants.h"

// Compiled once for each instruction set: see engine/core/isa.h for what may stand here.

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

// Pixels that are summed for at once, by all disparities.
constexpr int kPlaneRun = 128;
constexpr int kMapRun = 32;

// Pixels [begin, end) of a row.
struct Run {
  const float* reference;  // Of planes the whole row, of maps from the first pixel on.
  int begin;
  int end;
};

// How far views of a sector are from the reference: sums over colors and over differences, and how
// many views count.
struct Sums {
  float parts[3][kPlaneRun + kLanes];
};

inline Vec evidence_of(Vec sum, Vec count, float channels) {
  const Vec mean = sum / (greatest(count, splat(1)) * channels);
  const Vec value = (natural_log(mean + kNetFloor) + kNetAdd) * kNetScale;
  return choose(count > 0.0F, value, splat(kNetNoViews));
}

// Evidence of one sector for a run of pixels.
void finish_sector(Sums& sums, const Run& run, int sector, float* out) {
  for (int i = 0; i < run.end - run.begin; i += kLanes) {
    const Vec count = load(sums.parts[2] + i);
    store(sums.parts[0] + i, evidence_of(load(sums.parts[0] + i), count, 3));
    store(sums.parts[1] + i, evidence_of(load(sums.parts[1] + i), count, 2));
  }
  out += static_cast<long>(run.begin) * 2 * kNetSectors + sector;
  for (int i = 0; i < run.end - run.begin; ++i, out += 2 * kNetSectors) {
    out[0] = sums.parts[0][i];
    out[kNetSectors] = sums.parts[1][i];
  }
}

// Disparities that are the same for all pixels.

// The pixels around a sample of the first pixel of a row, and their weights.
struct Corners {
  const float* upper;  // The left ones.
  const float* lower;
  float weights[4];  // Of the upper left and right and the lower ones.
};

inline Vec magnitude(Vec value) {
  return reinterpret_cast<Vec>(reinterpret_cast<IntVec>(value) & 0x7fffffff);
}
inline Vec where(IntVec mask, Vec value) {
  return reinterpret_cast<Vec>(reinterpret_cast<IntVec>(value) & mask);
}
inline void add_to(float* sum, Vec value) {
  store(sum, load(sum) + value);
}

// Pixels [first, last) of a run; with samples between two columns, or on one.
template <bool kHasInvalid, bool kIsBetween>
inline void add_columns(const Run& run, int first, int last, const Corners& from, long channel,
                        Sums& sums) {
  IntVec lanes;
  for (int i = 0; i < kLanes; ++i) lanes[i] = i;
  for (int x = first; x < last; x += kLanes) {
    const auto distance = [&](int c) {
      const long at = x + c * channel;
      Vec off = load(from.upper + at) * from.weights[0] - load(run.reference + at);
      if constexpr (kIsBetween) off += load(from.upper + at + 1) * from.weights[1];
      off += load(from.lower + at) * from.weights[2];
      if constexpr (kIsBetween) off += load(from.lower + at + 1) * from.weights[3];
      return magnitude(off);
    };
    const Vec color = distance(0) + distance(1) + distance(2);
    const Vec difference = distance(3) + distance(4);
    IntVec counts = lanes < last - x;
    if constexpr (kHasInvalid) counts &= color + difference == color + difference;
    const int i = x - run.begin;
    add_to(sums.parts[0] + i, where(counts, color));
    add_to(sums.parts[1] + i, where(counts, difference));
    add_to(sums.parts[2] + i, where(counts, splat(1)));
  }
}

// Adds how far one view is from the reference, at one disparity.
template <bool kHasInvalid>
inline void add_plane(const NetEvidenceRow& row, const NetView& view, const Run& run, float d,
                      Sums& sums) {
  const float y = static_cast<float>(row.y) - d * view.dv;
  if (!(y >= 0 && y <= static_cast<float>(row.height - 1))) return;
  const int upper = static_cast<int>(y);
  const int lower = upper + 1 < row.height ? upper + 1 : upper;
  const float shift = -d * view.du;
  const int whole = static_cast<int>(__builtin_floorf(shift));
  const float right = shift - static_cast<float>(whole), below = y - static_cast<float>(upper);
  // Pixels whose sample x + shift lies in [0, width − 1].
  const int first = run.begin > -whole ? run.begin : -whole;
  const int end_within = row.width - whole - (right > 0 ? 1 : 0);
  const int last = run.end < end_within ? run.end : end_within;
  if (first >= last) return;
  const auto pixels = [&](int at) {
    return view.pixels + (at - view.first_row) * view.row_stride + whole;
  };
  const Corners from{
      pixels(upper),
      pixels(lower),
      {(1 - right) * (1 - below), right * (1 - below), (1 - right) * below, right * below}};
  if (right > 0) return add_columns<kHasInvalid, true>(run, first, last, from, row.width, sums);
  add_columns<kHasInvalid, false>(run, first, last, from, row.width, sums);
}

template <bool kHasInvalid>
void planes_of_run(const NetEvidenceRow& row, const Run& run) {
  for (int k = 0; k < kNetSectors; ++k) {
    Sums sums[kNetAtOnce] = {};
    for (int i = row.sector_begin[k]; i < row.sector_begin[k + 1]; ++i) {
      for (int j = 0; j < row.count; ++j) {
        add_plane<kHasInvalid>(row, row.views[i], run, row.disparities[j].same, sums[j]);
      }
    }
    for (int j = 0; j < row.count; ++j) finish_sector(sums[j], run, k, row.disparities[j].out);
  }
}

// Maps. A pixel of a view is one register of eight numbers whatever the instruction set.

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

// Where the pixels of a run are sampled.
struct Places {
  int offset[kMapRun];    // Of the first of four pixels, in the rows that are held.
  float along[kMapRun];   // Weights of the second column
  float down[kMapRun];    // and row.
  float within[kMapRun];  // 1 or 0
};

// An axis: coordinates clamped, the first of two places, the second never outside.
struct Axis {
  IntVec first;
  Vec weight;
  IntVec is_within;
};

inline Axis axis_at(Vec at, int size) {
  const Vec last = splat(static_cast<float>(size - 1));
  const Vec inside = greatest(least(at, last), Vec{});
  const IntVec first = least(convert<int>(inside), IntVec{} + (size > 1 ? size - 2 : 0));
  return {first, inside - convert<float>(first), inside == at};
}

// Finds the places of a run in a view and fetches them; whether all are within the view.
inline bool find_places(const NetEvidenceRow& row, const NetView& view, int begin,
                        const float (&disparities)[kMapRun], Places& places) {
  IntVec column, is_within = IntVec{} - 1;
  for (int i = 0; i < kLanes; ++i) column[i] = begin + i;
  for (int i = 0; i < kMapRun; i += kLanes, column += kLanes) {
    const Vec d = load(disparities + i);
    const Axis x = axis_at(convert<float>(column) - d * view.du, row.width);
    const Axis y = axis_at(static_cast<float>(row.y) - d * view.dv, row.height);
    const IntVec offset =
        (y.first - view.first_row) * static_cast<int>(view.row_stride) + x.first * kNetPixel;
    __builtin_memcpy(places.offset + i, &offset, sizeof offset);
    for (int j = i; j < i + kLanes; j += 4) {
      __builtin_prefetch(view.pixels + places.offset[j]);
      __builtin_prefetch(view.pixels + places.offset[j] + view.row_stride);
    }
    store(places.along + i, x.weight);
    store(places.down + i, y.weight);
    store(places.within + i, choose(x.is_within & y.is_within, splat(1), Vec{}));
    is_within &= x.is_within & y.is_within;
  }
  return !any(~is_within);
}

// Adds how far some views are from the reference.
template <bool kHasInvalid, bool kIsPartial>
inline void add_views(const NetEvidenceRow& row, const NetView* views, int count, const Run& run,
                      const Places* places, float* sums) {
  const long right = row.width > 1 ? kNetPixel : 0;
  const long below = row.height > 1 ? views->row_stride : 0;
  for (int i = 0; i < run.end - run.begin; ++i) {
    const Eight reference = load_pixel(run.reference + i * kNetPixel);
    Eight sum = load_pixel(sums + i * kNetPixel);
    for (int v = 0; v < count; ++v) {
      const float* const from = views[v].pixels + places[v].offset[i];
      const float along = places[v].along[i];
      const Eight upper = load_pixel(from);
      const Eight lower = load_pixel(from + below);
      const Eight first = upper + (load_pixel(from + right) - upper) * along;
      const Eight second = lower + (load_pixel(from + below + right) - lower) * along;
      Eight off = distance(first + (second - first) * places[v].down[i], reference);
      if constexpr (kHasInvalid) off = off == off ? off : Eight{};
      if constexpr (kIsPartial) off *= places[v].within[i];
      sum += off;
    }
    *reinterpret_cast<LooseEight*>(sums + i * kNetPixel) = sum;
  }
}

// A sector of views at the disparities of one map.
template <bool kHasInvalid>
void add_map(const NetEvidenceRow& row, const Run& run, int sector, const float* map,
             float (&sums)[kMapRun * kNetPixel]) {
  constexpr int kMostViews = 12;
  Places places[kMostViews];
  alignas(64) float disparities[kMapRun] = {};
  for (int i = run.begin; i < run.end; ++i) disparities[i - run.begin] = map[i];
  const int end = row.sector_begin[sector + 1];
  for (int first = row.sector_begin[sector]; first < end; first += kMostViews) {
    const int count = end - first < kMostViews ? end - first : kMostViews;
    const NetView* const views = row.views + first;
    bool is_within = true;
    for (int v = 0; v < count; ++v) {
      is_within &= find_places(row, views[v], run.begin, disparities, places[v]);
    }
    is_within ? add_views<kHasInvalid, false>(row, views, count, run, places, sums)
              : add_views<kHasInvalid, true>(row, views, count, run, places, sums);
  }
}

template <bool kHasInvalid>
void maps_of_run(const NetEvidenceRow& row, const Run& run) {
  for (int k = 0; k < kNetSectors; ++k) {
    for (int j = 0; j < row.count; ++j) {
      alignas(64) float pixels[kMapRun * kNetPixel] = {};
      add_map<kHasInvalid>(row, run, k, row.disparities[j].map, pixels);
      Sums sums;
      for (int i = 0; i < kMapRun; ++i) {
        const float* const sum = pixels + i * kNetPixel;
        sums.parts[0][i] = sum[0] + sum[1] + sum[2];
        sums.parts[1][i] = sum[3] + sum[4];
        sums.parts[2][i] = sum[5];
      }
      finish_sector(sums, run, k, row.disparities[j].out);
    }
  }
}

// Runs one after the other.
template <class OfRun>
inline void for_runs(const NetEvidenceRow& row, int length, const OfRun& of_run) {
  for (int begin = 0; begin < row.width; begin += length) {
    of_run(begin, begin + length < row.width ? begin + length : row.width);
  }
}

void planes(const NetEvidenceRow& row) {
  for_runs(row, kPlaneRun, [&](int begin, int end) {
    const Run run{row.reference, begin, end};
    row.has_invalid ? planes_of_run<true>(row, run) : planes_of_run<false>(row, run);
  });
}

void maps(const NetEvidenceRow& row) {
  for_runs(row, kMapRun, [&](int begin, int end) {
    const Run run{row.reference + static_cast<long>(begin) * kNetPixel, begin, end};
    row.has_invalid ? maps_of_run<true>(row, run) : maps_of_run<false>(row, run);
  });
}

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

const NetEvidenceKernel kNetEvidenceKernel = {planes, maps};

const NetKernel kNetKernel = {convolve, convolve_narrow, convolve_mixed, mix, enlarge};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
