// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/kernels/net_evidence_kernel.h"

#include "engine/core/simd.h"

// Compiled once for each instruction set: see engine/core/isa.h for what may stand here.

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

// A pixel of a view is one register of eight numbers whatever the instruction set.

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

}  // namespace

void net_evidence(const NetEvidenceRow& row) {
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

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
