// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/kernels/net_evidence_kernel.h"

#include "engine/core/simd.h"
#include "engine/disparity/kernels/net_constants.h"

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

}  // namespace

const NetEvidenceKernel kNetEvidenceKernel = {planes, maps};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
