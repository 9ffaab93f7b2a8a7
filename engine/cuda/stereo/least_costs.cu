// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/stereo/matching_tables.cuh"

namespace episcope::cuda {
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
