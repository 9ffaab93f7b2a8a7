// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/stereo/matching_tables.cuh"
#include "engine/cuda/stereo/stored_sample.cuh"

#include <climits>

namespace episcope::cuda {
namespace {

// A warp takes `kRows` rows of pixels; samples are interpolated between rows by each lane for its
// column, and between columns from the lanes to the right, so that the last three only serve.
constexpr int kRows = 8;
constexpr int kWarps = 4;
constexpr int kThreads = 32 * kWarps;
constexpr int kTileRows = kRows * kWarps;
constexpr int kTileColumns = 29;
constexpr int kLabels = 4;  // Of a block: they share what is read of a view.
constexpr int kTaps = 4;
// Samples that fit into shared memory, along each axis, and how far labels may lie apart for it.
constexpr int kWindow = 48;
constexpr int kSpread = kWindow - kTileRows - kTaps + 1;
constexpr unsigned kAllLanes = 0xffffffff;

// Samples of a view around the tile: offsets of the first from the tile's first pixel.
struct Window {
  int top = INT_MAX, left = INT_MAX;
  int bottom = INT_MIN, right = INT_MIN;  // Last offsets of first taps.
  int end = 0;                            // Label behind the last one that it is for.

  [[nodiscard]] __device__ Window with(const MatchShift& row, const MatchShift& column) const {
    return {min(top, row.origin), min(left, column.origin), max(bottom, row.origin),
            max(right, column.origin), end};
  }
  [[nodiscard]] __device__ bool fits() const {
    return bottom - top <= kSpread && right - left <= kSpread;
  }
};

// What the block works on.
struct Tile {
  int y = 0, x = 0, label = 0;

  [[nodiscard]] __device__ bool is_seen(const MatchShift& row, const MatchShift& column) const {
    return row.first < y + kTileRows && row.last > y && column.first < x + kTileColumns &&
           column.last > x;
  }
};

// The window for as many labels as share one, from `begin` on; none if no more is seen.
__device__ Window next_window(const Tile& tile, const MatchShift* rows, const MatchShift* columns,
                              int labels, int& begin) {
  const auto is_seen = [&](int l) {
    return l < kLabels && tile.label + l < labels && tile.is_seen(rows[l], columns[l]);
  };
  while (begin < kLabels && !is_seen(begin)) ++begin;
  Window window;
  for (window.end = begin; is_seen(window.end); ++window.end) {
    const Window wider = window.with(rows[window.end], columns[window.end]);
    if (!wider.fits()) break;
    window.top = wider.top, window.left = wider.left;
    window.bottom = wider.bottom, window.right = wider.right;
  }
  return window;
}

template <int kChannels>
using Samples = float[kChannels][kWindow][kWindow];

// A pixel of a view as floats; one that is not valid as NaN.
template <class T, int kChannels>
__device__ void read_pixel(const DeviceSamples& samples, long at, float (&out)[kChannels]) {
  const T* const stored = static_cast<const T*>(samples.samples) + at * kChannels;
  const bool is_valid = samples.valid == nullptr || samples.valid[at] != 0;
#pragma unroll
  for (int c = 0; c < kChannels; ++c) out[c] = is_valid ? to_unit(stored[c]) : nanf("");
}

// Reads a window; the border of the view is repeated.
template <class T, int kChannels>
__device__ void read_window(const DeviceSamples& samples, ViewIndex view, const Tile& tile,
                            const Window& window, Samples<kChannels>& out) {
  const int rows = window.bottom - window.top + kTileRows + kTaps - 1;
  const int columns = window.right - window.left + 32;
  const int lane = static_cast<int>(threadIdx.x) % 32;
  for (int i = static_cast<int>(threadIdx.x) / 32; i < rows; i += kWarps) {
    const int y = min(max(tile.y + window.top + i, 0), samples.height - 1);
    const long row = samples.pixel(view.v, view.u, y, 0);
    for (int j = lane; j < columns; j += 32) {
      const int x = min(max(tile.x + window.left + j, 0), samples.width - 1);
      float pixel[kChannels];
      read_pixel<T>(samples, row + x, pixel);
#pragma unroll
      for (int c = 0; c < kChannels; ++c) out[c][i][j] = pixel[c];
    }
  }
}

// A column of samples interpolated between rows.
template <int kCount>
__device__ void interpolate_rows(const float* samples, const float* weights, float (&out)[kRows]) {
  float column[kRows + kCount - 1];
#pragma unroll
  for (int i = 0; i < kRows + kCount - 1; ++i) column[i] = samples[i * kWindow];
#pragma unroll
  for (int r = 0; r < kRows; ++r) {
    float sum = kCount == 1 ? column[r] : weights[0] * column[r];
#pragma unroll
    for (int i = 1; i < kCount; ++i) sum += weights[i] * column[r + i];
    out[r] = sum;
  }
}

// Samples of all lanes interpolated between columns.
template <int kCount>
__device__ void interpolate_columns(const float* weights, float (&values)[kRows]) {
#pragma unroll
  for (int r = 0; r < kRows; ++r) {
    float sum = weights[0] * values[r];
#pragma unroll
    for (int i = 1; i < kCount; ++i) {
      sum += weights[i] * __shfl_down_sync(kAllLanes, values[r], i);
    }
    values[r] = sum;
  }
}

// The pixels of a lane.
template <int kChannels>
struct Lane {
  int y = 0, x = 0;
  float reference[kChannels][kRows];
  float noise[kRows];
};

// How far the samples of a view at one label are from the reference's.
template <int kChannels>
__device__ void find_distances(const MatchShift& row, const MatchShift& column,
                               const float* samples, const Lane<kChannels>& lane,
                               float (&distances)[kRows]) {
  const float lost = kChannels * fmaxf(1 - row.noise_left * column.noise_left, 0.0F);
#pragma unroll
  for (int r = 0; r < kRows; ++r) distances[r] = lost * lane.noise[r];
#pragma unroll
  for (int c = 0; c < kChannels; ++c) {
    const float* const from = samples + c * kWindow * kWindow;
    float values[kRows];
    if (row.taps == 4) {
      interpolate_rows<4>(from, row.weights, values);
    } else if (row.taps == 2) {
      interpolate_rows<2>(from, row.weights, values);
    } else {
      interpolate_rows<1>(from, row.weights, values);
    }
    if (column.taps == 4) interpolate_columns<4>(column.weights, values);
    if (column.taps == 2) interpolate_columns<2>(column.weights, values);
#pragma unroll
    for (int r = 0; r < kRows; ++r) {
      const float off = values[r] - lane.reference[c][r];
      distances[r] += off * off;
    }
  }
#pragma unroll
  for (int r = 0; r < kRows; ++r) distances[r] = quick_root(distances[r]);
}

// Sums over the views, and how many there are of them if they are counted.
template <bool kIsCounted>
struct Sums {
  float costs[kRows] = {};
  float counts[kIsCounted ? kRows : 1] = {};

  __device__ void add(const float (&distances)[kRows], const MatchShift& row,
                      const MatchShift& column, int y, int x, float cap) {
    const bool in_columns = x >= column.first && x < column.last;
#pragma unroll
    for (int r = 0; r < kRows; ++r) {
      bool is_seen = in_columns && y + r >= row.first && y + r < row.last;
      if constexpr (kIsCounted) {
        is_seen = is_seen && distances[r] == distances[r];
        counts[r] += is_seen ? 1.0F : 0.0F;
      }
      costs[r] += is_seen ? fminf(distances[r], cap) : 0.0F;
    }
  }
};

template <bool kIsCounted>
__device__ void store(const MatchingTables& tables, const Sums<kIsCounted>& sums, int label, int y,
                      int x, int end, float* out) {
  const int width = tables.samples.width;
#pragma unroll
  for (int r = 0; r < kRows; ++r) {
    if (y + r >= end) continue;
    float views;
    if constexpr (kIsCounted) {
      views = sums.counts[r];
    } else {
      views = tables.views_seen(label, y + r, x);
    }
    out[static_cast<long>(r) * tables.labels * width] =
        views > 0 ? sums.costs[r] / views : tables.worst;
  }
}

template <class T, int kChannels>
__device__ Lane<kChannels> read_lane(const MatchingTables& tables, int y, int x) {
  Lane<kChannels> lane;
  lane.y = y;
  lane.x = x;
  const DeviceSamples& samples = tables.samples;
  const int column = min(x, samples.width - 1);
#pragma unroll
  for (int r = 0; r < kRows; ++r) {
    const int row = min(y + r, samples.height - 1);
    float pixel[kChannels];
    read_pixel<T>(samples, samples.pixel(tables.reference.v, tables.reference.u, row, column),
                  pixel);
#pragma unroll
    for (int c = 0; c < kChannels; ++c) lane.reference[c][r] = pixel[c];
    lane.noise[r] =
        tables.noise == nullptr ? 0 : tables.noise[static_cast<long>(row) * samples.width + column];
  }
  return lane;
}

template <class T, int kChannels, bool kIsCounted>
__global__ __launch_bounds__(kThreads, kIsCounted ? 3 : 4) void match(MatchingTables tables,
                                                                      int first, int end,
                                                                      float* costs) {
  __shared__ Samples<kChannels> window_samples;
  const Tile tile{first + static_cast<int>(blockIdx.y) * kTileRows,
                  static_cast<int>(blockIdx.x) * kTileColumns,
                  static_cast<int>(blockIdx.z) * kLabels};
  const int of_lane = static_cast<int>(threadIdx.x) % 32;
  const int of_warp = static_cast<int>(threadIdx.x) / 32 * kRows;
  const Lane<kChannels> lane = read_lane<T, kChannels>(tables, tile.y + of_warp, tile.x + of_lane);
  Sums<kIsCounted> sums[kLabels];
  for (int i = 0; i < tables.view_count; ++i) {
    const MatchedView each = tables.views[i];
    const MatchShift* const rows = tables.rows + each.row * tables.labels + tile.label;
    const MatchShift* const columns = tables.columns + each.column * tables.labels + tile.label;
    for (int begin = 0; begin < kLabels;) {
      const Window window = next_window(tile, rows, columns, tables.labels, begin);
      if (window.end == begin) break;
      read_window<T, kChannels>(tables.samples, each.view, tile, window, window_samples);
      __syncthreads();
#pragma unroll
      for (int l = 0; l < kLabels; ++l) {
        if (l < begin || l >= window.end) continue;
        const MatchShift row = rows[l], column = columns[l];
        float distances[kRows];
        find_distances<kChannels>(row, column,
                                  &window_samples[0][of_warp + row.origin - window.top]
                                                 [of_lane + column.origin - window.left],
                                  lane, distances);
        sums[l].add(distances, row, column, lane.y, lane.x, tables.cap);
      }
      __syncthreads();
      begin = window.end;
    }
  }
  if (of_lane >= kTileColumns || lane.x >= tables.samples.width) return;
#pragma unroll
  for (int l = 0; l < kLabels; ++l) {
    const int label = tile.label + l;
    if (label >= tables.labels) continue;
    const long row = static_cast<long>(lane.y - first) * tables.labels + label;
    store(tables, sums[l], label, lane.y, lane.x, end, costs + row * tables.samples.width + lane.x);
  }
}

template <class T, int kChannels>
void launch_match(const MatchingTables& tables, int first, int rows, float* costs,
                  const DeviceStream& stream) {
  const dim3 grid(blocks_for(tables.samples.width, kTileColumns), blocks_for(rows, kTileRows),
                  blocks_for(tables.labels, kLabels));
  const double pixels = static_cast<double>(rows) * tables.samples.width;
  const double each = pixels * tables.labels * tables.view_count;
  const KernelWork work{"stereo: matching costs",
                        pixels * (tables.view_count * kChannels * sizeof(T) + 4.0 * tables.labels),
                        each * (kChannels * (tables.is_cross_hair ? 10 : 18) + 4)};
  launch(stream, work, [&] {
    if (tables.rows_seen == nullptr) {
      match<T, kChannels, true>
          <<<grid, kThreads, 0, stream.get()>>>(tables, first, first + rows, costs);
    } else {
      match<T, kChannels, false>
          <<<grid, kThreads, 0, stream.get()>>>(tables, first, first + rows, costs);
    }
  });
}

template <class T>
void launch_for_channels(const MatchingTables& tables, int first, int rows, float* costs,
                         const DeviceStream& stream) {
  if (tables.samples.channels == 3) return launch_match<T, 3>(tables, first, rows, costs, stream);
  launch_match<T, 1>(tables, first, rows, costs, stream);
}

}  // namespace

void compute_costs(const MatchingTables& tables, int first, int rows, float* costs,
                   const DeviceStream& stream) {
  switch (tables.samples.type) {
    case SampleType::UInt8:
      return launch_for_channels<std::uint8_t>(tables, first, rows, costs, stream);
    case SampleType::UInt16:
      return launch_for_channels<std::uint16_t>(tables, first, rows, costs, stream);
    default:
      return launch_for_channels<float>(tables, first, rows, costs, stream);
  }
}

}  // namespace episcope::cuda
