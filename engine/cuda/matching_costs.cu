// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/matching_costs.cuh"

#include "engine/cuda/device.cuh"
#include "engine/disparity/kernels/shared_constants.h"

#include <cuda_pipeline.h>

#include <algorithm>

namespace episcope::cuda {
namespace {

__global__ void fill_planes(DeviceSamples samples, ViewPlanes views, float* planes) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y), slot = static_cast<int>(blockIdx.z);
  if (x >= samples.width) return;
  const ViewIndex view = views.view_of(slot);
  const long from = samples.pixel(view.v, view.u, y, x);
  const bool is_valid = samples.valid == nullptr || samples.valid[from] != 0;
  float* const to = planes + slot * samples.channels * views.plane_size() +
                    static_cast<long>(y) * samples.width + x;
  for (int c = 0; c < samples.channels; ++c) {
    to[c * views.plane_size()] = is_valid ? samples.at(from, c) : nanf("");
  }
}

}  // namespace

DeviceArray<float> make_view_planes(const DeviceSamples& samples, const ViewPlanes& views,
                                    const DeviceStream& stream) {
  constexpr int kThreads = 256;
  const std::size_t count =
      static_cast<std::size_t>(views.slots()) * samples.channels * views.plane_size();
  DeviceArray<float> planes(count, stream);
  const dim3 grid(blocks_for(samples.width, kThreads), static_cast<unsigned>(samples.height),
                  static_cast<unsigned>(views.slots()));
  launch(stream, {"stereo: planes", 5.0 * static_cast<double>(count)},
         [&] { fill_planes<<<grid, kThreads, 0, stream.get()>>>(samples, views, planes.data()); });
  return planes;
}

namespace {

constexpr int kSurfaceThreads = 256;

// The pixels of one axis that a point at `place` covers, within [0, extent).
struct Covered {
  int first, last;
};
__device__ Covered covered(float place, int extent) {
  const int whole = static_cast<int>(floorf(place));
  const float t = place - static_cast<float>(whole);
  const int first = t > 1 - kSurfaceOverlap ? whole + 1 : whole;
  const int last = t < kSurfaceOverlap ? whole : whole + 1;
  return {max(first, 0), min(last, extent - 1)};
}

// Floats of one sign are in the order of their bits, negative ones in the opposite one.
__device__ void raise(float* to, float value) {
  if (value >= 0) {
    atomicMax(reinterpret_cast<int*>(to), __float_as_int(value));
  } else {
    atomicMin(reinterpret_cast<unsigned*>(to), __float_as_uint(value));
  }
}

__global__ __launch_bounds__(kSurfaceThreads) void fill(float* values, long count) {
  const long at = static_cast<long>(blockIdx.x) * kSurfaceThreads + threadIdx.x;
  if (at < count) values[at] = kNothingNear;
}

__global__ __launch_bounds__(kSurfaceThreads) void cast(ViewPlanes views, const float* disparity,
                                                        float* surfaces) {
  const int x = static_cast<int>(blockIdx.x) * kSurfaceThreads + static_cast<int>(threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  if (x >= views.width) return;
  const float d = disparity[static_cast<long>(y) * views.width + x] + 0.0F;  // −0 becomes 0
  if (d <= kNothingNear) return;
  const ViewIndex view = views.view_of(static_cast<int>(blockIdx.z));
  const auto place = [d](int from, int step) {
    return __fsub_rn(static_cast<float>(from), __fmul_rn(d, static_cast<float>(step)));
  };
  const Covered rows = covered(place(y, view.v - views.reference.v), views.height);
  const Covered columns = covered(place(x, view.u - views.reference.u), views.width);
  float* const surface = surfaces + blockIdx.z * views.plane_size();
  for (int row = rows.first; row <= rows.last; ++row) {
    for (int column = columns.first; column <= columns.last; ++column) {
      raise(surface + static_cast<long>(row) * views.width + column, d);
    }
  }
}

}  // namespace

DeviceArray<float> cast_surfaces(const ViewPlanes& views, const float* disparity,
                                 const DeviceStream& stream) {
  const long count = views.slots() * views.plane_size();
  DeviceArray<float> surfaces(count, stream);
  launch(stream, {"stereo: no surfaces", 4.0 * static_cast<double>(count)}, [&] {
    fill<<<blocks_for(count, kSurfaceThreads), kSurfaceThreads, 0, stream.get()>>>(surfaces.data(),
                                                                                   count);
  });
  const dim3 grid(blocks_for(views.width, kSurfaceThreads), static_cast<unsigned>(views.height),
                  static_cast<unsigned>(views.slots()));
  const auto points = static_cast<double>(count);
  launch(stream, {"stereo: surfaces in views", 8 * points, 10 * points}, [&] {
    cast<<<grid, kSurfaceThreads, 0, stream.get()>>>(views, disparity, surfaces.data());
  });
  return surfaces;
}

namespace {

// A small array: what it takes to pin memory would be more than the copy.
template <class T>
DeviceArray<T> copied(const std::vector<T>& host, const DeviceStream& stream) {
  DeviceArray<T> array(host.size(), stream);
  if (host.empty()) return array;
  check(cudaMemcpyAsync(array.data(), host.data(), array.byte_size(), cudaMemcpyHostToDevice,
                        stream.get()));
  return array;
}

std::vector<GroupShift> grouped(const std::vector<MatchShift>& shifts, int labels) {
  std::vector<GroupShift> groups;
  for (std::size_t way = 0; way < shifts.size(); way += labels) {
    for (int label = 0; label < labels; label += kGroupLabels) {
      const MatchShift& first = shifts[way + label];
      GroupShift group{first.origin, first.origin, first.first, first.last};
      for (int l = label; l < std::min(label + kGroupLabels, labels); ++l) {
        const MatchShift& each = shifts[way + l];
        group.low = std::min(group.low, each.origin);
        group.high = std::max(group.high, each.origin);
        group.first = std::min(group.first, each.first);
        group.last = std::max(group.last, each.last);
      }
      groups.push_back(group);
    }
  }
  return groups;
}

}  // namespace

DeviceMatching::DeviceMatching(const StereoMatching& matching, const ViewPlanes& planes,
                               const float* noise, const DeviceStream& stream,
                               const Visibility& visibility)
    : views_(copied(matching.views, stream)),
      rows_(copied(matching.rows, stream)),
      columns_(copied(matching.columns, stream)),
      row_groups_(copied(grouped(matching.rows, matching.labels), stream)),
      column_groups_(copied(grouped(matching.columns, matching.labels), stream)),
      rows_seen_(copied(matching.rows_seen, stream)),
      columns_seen_(copied(matching.columns_seen, stream)),
      disparities_(copied(matching.disparities, stream)) {
  tables_.planes = planes;
  tables_.views = views_.data();
  tables_.view_count = static_cast<int>(matching.views.size());
  tables_.labels = matching.labels;
  tables_.rows = rows_.data();
  tables_.columns = columns_.data();
  tables_.row_groups = row_groups_.data();
  tables_.column_groups = column_groups_.data();
  tables_.rows_seen = rows_seen_.data();
  tables_.columns_seen = columns_seen_.data();
  tables_.is_cross_hair = matching.is_cross_hair;
  tables_.cap = matching.cap;
  tables_.worst = matching.worst;
  tables_.noise = noise;
  tables_.visibility = visibility;
  tables_.disparities = disparities_.data();
}

namespace {

// A warp takes `kRows` rows of pixels; samples are interpolated between rows by each lane for its
// column, and between columns from the lanes to the right, so that the last three only serve.
constexpr int kRows = 8;
constexpr int kWarps = 4;
constexpr int kThreads = 32 * kWarps;
constexpr int kTileRows = kRows * kWarps;
constexpr int kTileColumns = 29;
constexpr int kLabels = kGroupLabels;  // Of a block: they share what is read of a view.
constexpr int kTaps = 4;
// Samples that fit into shared memory, along each axis, and how far labels may lie apart for it.
constexpr int kWindow = 48;
constexpr int kSpread = kWindow - kTileRows - kTaps + 1;
constexpr unsigned kAllLanes = 0xffffffff;

// What tells how many views a sum is of: where pixels lie, counts, or sums of shares of views.
enum class Counting { Places, Valid, Visible };

// What the block works on.
struct Tile {
  int y = 0, x = 0, label = 0;

  // Whether no sample of the tile lies outside the image.
  [[nodiscard]] __device__ bool is_inside(const MatchShift& row, const MatchShift& column) const {
    return row.first <= y && row.last >= y + kTileRows && column.first <= x &&
           column.last >= x + kTileColumns;
  }
};

// A view and those labels, of the block's, that share a window of samples around the tile; top and
// left are offsets of the window from the tile's first pixel.
struct Stage {
  int view = 0;
  int begin = 0, end = 0;  // Labels.
  int top = 0, left = 0;
  int rows = 0, columns = 0;
};

// The stage after label `begin` of a view; `view` = their number: none. All labels of the block
// share a window, unless they lie too far apart.
__device__ Stage find_stage(const MatchingTables& tables, const Tile& tile, int view, int begin) {
  const int groups = (tables.labels + kLabels - 1) / kLabels, group = tile.label / kLabels;
  const int labels = min(kLabels, tables.labels - tile.label);
  if (begin >= labels) {
    ++view;
    begin = 0;
  }
  for (; view < tables.view_count; ++view, begin = 0) {
    const MatchedView each = tables.views[view];
    const GroupShift row = tables.row_groups[each.row * groups + group];
    const GroupShift column = tables.column_groups[each.column * groups + group];
    if (!row.sees(tile.y, tile.y + kTileRows) || !column.sees(tile.x, tile.x + kTileColumns)) {
      continue;
    }
    const int down = row.high - row.low, along = column.high - column.low;
    if (down <= kSpread && along <= kSpread) {
      return {view, 0, labels, row.low, column.low, down + kTileRows + kTaps - 1, along + 32};
    }
    const int label = tile.label + begin;
    return {view,
            begin,
            begin + 1,
            tables.rows[each.row * tables.labels + label].origin,
            tables.columns[each.column * tables.labels + label].origin,
            kTileRows + kTaps - 1,
            32};
  }
  return {view};
}

// What is read of a view: its channels, and what stands before its points.
template <int kChannels, Counting kCounting>
struct Samples {
  float planes[kChannels + (kCounting == Counting::Visible ? 1 : 0)][kWindow][kWindow];
};

// Begins to read a window of one plane; the border is repeated.
__device__ void begin_to_read(const ViewPlanes& planes, const float* plane, const Tile& tile,
                              const Stage& stage, float (&out)[kWindow][kWindow]) {
  const int lane = static_cast<int>(threadIdx.x) % 32;
  const int left = tile.x + stage.left + lane;
  const int x = min(max(left, 0), planes.width - 1);
  const int further = min(max(left + 32, 0), planes.width - 1);
  for (int i = static_cast<int>(threadIdx.x) / 32; i < stage.rows; i += kWarps) {
    const int y = min(max(tile.y + stage.top + i, 0), planes.height - 1);
    const float* const row = plane + static_cast<long>(y) * planes.width;
    __pipeline_memcpy_async(&out[i][lane], row + x, sizeof(float));
    if (lane + 32 < stage.columns) {
      __pipeline_memcpy_async(&out[i][lane + 32], row + further, sizeof(float));
    }
  }
}

template <int kChannels, Counting kCounting>
__device__ void begin_to_read(const MatchingTables& tables, const Tile& tile, const Stage& stage,
                              Samples<kChannels, kCounting>& out) {
  const ViewPlanes& planes = tables.planes;
  const ViewIndex view = tables.views[stage.view].view;
#pragma unroll
  for (int c = 0; c < kChannels; ++c) {
    begin_to_read(planes, planes.of(view, c), tile, stage, out.planes[c]);
  }
  if constexpr (kCounting == Counting::Visible) {
    const float* const nearest = tables.visibility.nearest;
    if (nearest == nullptr) return;
    begin_to_read(planes, nearest + planes.slot(view) * planes.plane_size(), tile, stage,
                  out.planes[kChannels]);
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
  float caps[kRows];
};

// How far the samples of a view at one label are from the reference's.
template <int kChannels>
__device__ void find_distances(const MatchShift& row, const MatchShift& column,
                               const float* samples, const Lane<kChannels>& lane,
                               float (&distances)[kRows]) {
  const auto lost =
      static_cast<float>(kChannels * fmax(1 - row.noise_left * column.noise_left, 0.0));
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

// Sums over the views, and of how many where that is counted.
template <Counting kCounting>
struct Sums {
  static constexpr bool kIsCounted = kCounting != Counting::Places;
  float costs[kRows] = {};
  float counts[kIsCounted ? kRows : 1] = {};

  __device__ void add(const float (&distances)[kRows], float cap) {
#pragma unroll
    for (int r = 0; r < kRows; ++r) costs[r] += fminf(distances[r], cap);
  }
  __device__ void add_seen(const float (&distances)[kRows], const MatchShift& row,
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
  // `shares`: how much of each sample is not occluded.
  template <class Pixels>
  __device__ void add_visible(const float (&distances)[kRows], const MatchShift& row,
                              const MatchShift& column, const Pixels& lane,
                              const float (&shares)[kRows]) {
    const bool in_columns = lane.x >= column.first && lane.x < column.last;
#pragma unroll
    for (int r = 0; r < kRows; ++r) {
      const bool is_seen = in_columns && lane.y + r >= row.first && lane.y + r < row.last &&
                           distances[r] == distances[r];
      const float share = is_seen ? shares[r] : 0.0F;
      counts[r] += share;
      costs[r] += is_seen ? share * fminf(distances[r], lane.caps[r]) : 0.0F;
    }
  }
};

// Of samples whose nearest surfaces stand one below the other from `nearest` on.
__device__ void find_shares(const Visibility& visibility, float disparity, const float* nearest,
                            float (&shares)[kRows]) {
  const float limit = disparity + visibility.tolerance + visibility.softness;
  const float steepness = 1 / visibility.softness;
#pragma unroll
  for (int r = 0; r < kRows; ++r) {
    const float free = visibility.nearest ? (limit - nearest[r * kWindow]) * steepness : 1.0F;
    shares[r] = fminf(fmaxf(free, 0.0F), 1.0F);
  }
}

template <Counting kCounting, class Pixels>
__device__ void store(const MatchingTables& tables, const Sums<kCounting>& sums, int label,
                      const Pixels& lane, int end, float* out) {
  const int width = tables.planes.width;
#pragma unroll
  for (int r = 0; r < kRows; ++r) {
    if (lane.y + r >= end) continue;
    float views;
    if constexpr (kCounting == Counting::Places) {
      views = tables.views_seen(label, lane.y + r, lane.x);
    } else {
      views = sums.counts[r];
    }
    const float worst = kCounting == Counting::Visible ? lane.caps[r] : tables.worst;
    out[static_cast<long>(r) * tables.labels * width] = views > 0 ? sums.costs[r] / views : worst;
  }
}

template <int kChannels>
__device__ Lane<kChannels> read_lane(const MatchingTables& tables, int y, int x) {
  Lane<kChannels> lane;
  lane.y = y;
  lane.x = x;
  const ViewPlanes& planes = tables.planes;
  const int column = min(x, planes.width - 1);
#pragma unroll
  for (int r = 0; r < kRows; ++r) {
    const long at = static_cast<long>(min(y + r, planes.height - 1)) * planes.width + column;
#pragma unroll
    for (int c = 0; c < kChannels; ++c) {
      lane.reference[c][r] = planes.of(planes.reference, c)[at];
    }
    lane.noise[r] = tables.noise == nullptr ? 0.0F : tables.noise[at];
    const float* const caps = tables.visibility.caps;
    lane.caps[r] = caps == nullptr ? tables.worst : caps[at];
  }
  return lane;
}

// The sums of the next label come first: so the loop over labels needs no copy of its code for
// each.
template <Counting kCounting>
__device__ void rotate(Sums<kCounting> (&sums)[kLabels]) {
  const Sums<kCounting> first = sums[0];
#pragma unroll
  for (int l = 0; l + 1 < kLabels; ++l) sums[l] = sums[l + 1];
  sums[kLabels - 1] = first;
}

template <int kChannels, Counting kCounting>
__device__ void add_stage(const MatchingTables& tables, const Tile& tile, const Stage& stage,
                          const Samples<kChannels, kCounting>& samples, const Lane<kChannels>& lane,
                          Sums<kCounting> (&sums)[kLabels]) {
  const MatchedView each = tables.views[stage.view];
  const MatchShift* const rows = tables.rows + each.row * tables.labels + tile.label;
  const MatchShift* const columns = tables.columns + each.column * tables.labels + tile.label;
#pragma unroll 1
  for (int l = 0; l < kLabels; ++l) {
    if (l >= stage.begin && l < stage.end) {
      const MatchShift row = rows[l], column = columns[l];
      const int y = lane.y - tile.y - stage.top, x = lane.x - tile.x - stage.left;
      float distances[kRows];
      find_distances<kChannels>(row, column, &samples.planes[0][y + row.origin][x + column.origin],
                                lane, distances);
      if constexpr (kCounting == Counting::Visible) {
        float shares[kRows];
        find_shares(tables.visibility, tables.disparities[tile.label + l],
                    &samples.planes[kChannels][y + row.nearest][x + column.nearest], shares);
        sums[0].add_visible(distances, row, column, lane, shares);
      } else if (kCounting == Counting::Places && tile.is_inside(row, column)) {
        sums[0].add(distances, tables.cap);
      } else {
        sums[0].add_seen(distances, row, column, lane.y, lane.x, tables.cap);
      }
    }
    rotate(sums);
  }
}

// While one window is worked on, the next one is read.
template <int kChannels, Counting kCounting>
__global__ __launch_bounds__(kThreads, kCounting == Counting::Places ? 4 : 3) void match(
    MatchingTables tables, int first, int end, float* costs) {
  extern __shared__ float shared[];
  auto* const windows = reinterpret_cast<Samples<kChannels, kCounting>*>(shared);
  const Tile tile{first + static_cast<int>(blockIdx.z) * kTileRows,
                  static_cast<int>(blockIdx.y) * kTileColumns,
                  static_cast<int>(blockIdx.x) * kLabels};
  const int of_lane = static_cast<int>(threadIdx.x) % 32;
  const Lane<kChannels> lane = read_lane<kChannels>(
      tables, tile.y + static_cast<int>(threadIdx.x) / 32 * kRows, tile.x + of_lane);
  Sums<kCounting> sums[kLabels];
  Stage stage = find_stage(tables, tile, 0, 0);
  const auto begin_stage = [&](const Stage& begun, int number) {
    if (begun.view < tables.view_count) {
      begin_to_read<kChannels, kCounting>(tables, tile, begun, windows[number % 2]);
    }
    __pipeline_commit();
  };
  begin_stage(stage, 0);
  for (int number = 0; stage.view < tables.view_count; ++number) {
    const Stage next = find_stage(tables, tile, stage.view, stage.end);
    begin_stage(next, number + 1);
    __pipeline_wait_prior(1);
    __syncthreads();
    add_stage<kChannels, kCounting>(tables, tile, stage, windows[number % 2], lane, sums);
    __syncthreads();
    stage = next;
  }
  if (of_lane >= kTileColumns || lane.x >= tables.planes.width) return;
#pragma unroll
  for (int l = 0; l < kLabels; ++l) {
    const int label = tile.label + l;
    if (label >= tables.labels) continue;
    const long row = static_cast<long>(lane.y - first) * tables.labels + label;
    store(tables, sums[l], label, lane, end, costs + row * tables.planes.width + lane.x);
  }
}

template <int kChannels, Counting kCounting>
void launch_match(const MatchingTables& tables, int first, int rows, float* costs,
                  const DeviceStream& stream) {
  // Labels of one tile run together and share what the cache holds of the views.
  const dim3 grid(blocks_for(tables.labels, kLabels), blocks_for(tables.planes.width, kTileColumns),
                  blocks_for(rows, kTileRows));
  constexpr std::size_t kBytes = 2 * sizeof(Samples<kChannels, kCounting>);
  check(cudaFuncSetAttribute(match<kChannels, kCounting>,
                             cudaFuncAttributeMaxDynamicSharedMemorySize,
                             static_cast<int>(kBytes)));
  const double pixels = static_cast<double>(rows) * tables.planes.width;
  const double each = pixels * tables.labels * tables.view_count;
  const KernelWork work{"stereo: matching costs",
                        4 * pixels * (tables.view_count * kChannels + tables.labels),
                        each * (kChannels * (tables.is_cross_hair ? 10 : 18) + 4)};
  launch(stream, work, [&] {
    match<kChannels, kCounting>
        <<<grid, kThreads, kBytes, stream.get()>>>(tables, first, first + rows, costs);
  });
}

template <int kChannels>
void launch_match(const MatchingTables& tables, int first, int rows, float* costs,
                  const DeviceStream& stream) {
  const auto run = tables.visibility.weighs()    ? launch_match<kChannels, Counting::Visible>
                   : tables.rows_seen == nullptr ? launch_match<kChannels, Counting::Valid>
                                                 : launch_match<kChannels, Counting::Places>;
  run(tables, first, rows, costs, stream);
}

}  // namespace

void compute_costs(const MatchingTables& tables, int first, int rows, float* costs,
                   const DeviceStream& stream) {
  const auto run = tables.planes.channels == 3 ? launch_match<3> : launch_match<1>;
  run(tables, first, rows, costs, stream);
}

namespace {

constexpr int kColumns = 32;
constexpr int kLabelsAtOnce = 32;

// A view at one label, where the sample of pixel (y, x) is put together from taps.
struct Sampled {
  const MatchShift& row;
  const MatchShift& column;
  int height, width;
  int y, x;

  [[nodiscard]] __device__ float between_rows(const float* plane, int j) const {
    const int from_x = min(max(x + column.origin + j, 0), width - 1);
    const auto tap = [&](int i) {
      const int from_y = min(max(y + row.origin + i, 0), height - 1);
      return __ldg(plane + from_y * width + from_x);
    };
    if (row.taps == 1) return tap(0);
    const float sum = row.weights[0] * tap(0) + row.weights[1] * tap(1);
    return row.taps == 2 ? sum : sum + row.weights[2] * tap(2) + row.weights[3] * tap(3);
  }
  [[nodiscard]] __device__ float operator()(const float* plane) const {
    if (column.taps == 1) return between_rows(plane, 0);
    float sum =
        column.weights[0] * between_rows(plane, 0) + column.weights[1] * between_rows(plane, 1);
    for (int j = 2; j < column.taps; ++j) sum += column.weights[j] * between_rows(plane, j);
    return sum;
  }
};

__device__ float cost_of(const MatchingTables& tables, const float (&reference)[3], int label,
                         int y, int x) {
  float sum = 0, count = 0;
#pragma unroll 2
  for (int i = 0; i < tables.view_count; ++i) {
    const MatchedView each = tables.views[i];
    const MatchShift& row = tables.rows[each.row * tables.labels + label];
    const MatchShift& column = tables.columns[each.column * tables.labels + label];
    if (y < row.first || y >= row.last || x < column.first || x >= column.last) continue;
    const Sampled sampled{row, column, tables.planes.height, tables.planes.width, y, x};
    float square = 0;
    for (int c = 0; c < tables.planes.channels; ++c) {
      const float off = sampled(tables.planes.of(each.view, c)) - reference[c];
      square += off * off;
    }
    if (!(square == square)) continue;
    sum += fminf(quick_root(square), tables.cap);
    count += 1;
  }
  return count > 0 ? sum / count : tables.worst;
}

__global__ void find_least(const __grid_constant__ MatchingTables tables,
                           const __grid_constant__ DeviceSamples samples, const int* rows,
                           float most, float* least) {
  __shared__ float of_labels[kLabelsAtOnce][kColumns];
  const ViewPlanes& planes = tables.planes;
  const int lane = static_cast<int>(threadIdx.x), first = static_cast<int>(threadIdx.y);
  const int x = static_cast<int>(blockIdx.x) * kColumns + lane;
  const int y = rows[blockIdx.y];
  float own = most;
  if (x < planes.width) {
    float reference[3] = {};
    for (int c = 0; c < planes.channels; ++c) {
      reference[c] = planes.of(planes.reference, c)[static_cast<long>(y) * planes.width + x];
    }
    for (int label = first; label < tables.labels; label += kLabelsAtOnce) {
      own = fminf(own, cost_of(tables, reference, label, y, x));
    }
  }
  of_labels[first][lane] = own;
  __syncthreads();
  if (first != 0 || x >= planes.width) return;
  for (int i = 1; i < kLabelsAtOnce; ++i) own = fminf(own, of_labels[i][lane]);
  const ViewIndex view = planes.reference;
  const bool is_valid =
      samples.valid == nullptr || samples.valid[samples.pixel(view.v, view.u, y, x)] != 0;
  least[static_cast<long>(blockIdx.y) * planes.width + x] = is_valid ? own : INFINITY;
}

}  // namespace

void find_least_costs(const MatchingTables& tables, const DeviceSamples& samples, const int* rows,
                      int row_count, float most, float* least, const DeviceStream& stream) {
  const dim3 grid(blocks_for(tables.planes.width, kColumns), static_cast<unsigned>(row_count));
  const dim3 block(kColumns, kLabelsAtOnce);
  const double each = static_cast<double>(row_count) * tables.planes.width * tables.labels *
                      tables.view_count * tables.planes.channels;
  launch(stream, {"stereo: least costs", each / tables.labels, each * 11},
         [&] { find_least<<<grid, block, 0, stream.get()>>>(tables, samples, rows, most, least); });
}

}  // namespace episcope::cuda
