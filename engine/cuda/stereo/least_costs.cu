// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/stereo/matching_tables.cuh"
#include "engine/cuda/stereo/stored_sample.cuh"

namespace episcope::cuda {
namespace {

constexpr int kColumns = 32;
constexpr int kLabelsAtOnce = 8;

// A view at one label, where the sample of pixel (y, x) is put together from taps.
struct Sampled {
  const MatchShift& row;
  const MatchShift& column;
  const DeviceSamples& samples;
  ViewIndex view;
  int y, x;

  [[nodiscard]] __device__ float tap(int i, int j, int channel) const {
    const int from_y = min(max(y + row.origin + i, 0), samples.height - 1);
    const int from_x = min(max(x + column.origin + j, 0), samples.width - 1);
    const long at = samples.pixel(view.v, view.u, from_y, from_x);
    const bool is_valid = samples.valid == nullptr || samples.valid[at] != 0;
    return is_valid ? samples.at(at, channel) : nanf("");
  }
  [[nodiscard]] __device__ float between_rows(int j, int channel) const {
    if (row.taps == 1) return tap(0, j, channel);
    float sum = row.weights[0] * tap(0, j, channel);
    for (int i = 1; i < row.taps; ++i) sum += row.weights[i] * tap(i, j, channel);
    return sum;
  }
  [[nodiscard]] __device__ float operator()(int channel) const {
    if (column.taps == 1) return between_rows(0, channel);
    float sum = column.weights[0] * between_rows(0, channel);
    for (int j = 1; j < column.taps; ++j) sum += column.weights[j] * between_rows(j, channel);
    return sum;
  }
};

__device__ float cost_of(const MatchingTables& tables, const float (&reference)[3], int label,
                         int y, int x) {
  float sum = 0, count = 0;
  for (int i = 0; i < tables.view_count; ++i) {
    const MatchedView& each = tables.views[i];
    const MatchShift& row = tables.rows[each.row * tables.labels + label];
    const MatchShift& column = tables.columns[each.column * tables.labels + label];
    if (y < row.first || y >= row.last || x < column.first || x >= column.last) continue;
    const Sampled sampled{row, column, tables.samples, each.view, y, x};
    float square = 0;
    for (int c = 0; c < tables.samples.channels; ++c) {
      const float off = sampled(c) - reference[c];
      square += off * off;
    }
    if (!(square == square)) continue;
    sum += fminf(quick_root(square), tables.cap);
    count += 1;
  }
  return count > 0 ? sum / count : tables.worst;
}

__global__ void find_least(MatchingTables tables, const int* rows, float most, float* least) {
  __shared__ float of_labels[kLabelsAtOnce][kColumns];
  const DeviceSamples& samples = tables.samples;
  const int lane = static_cast<int>(threadIdx.x), first = static_cast<int>(threadIdx.y);
  const int x = static_cast<int>(blockIdx.x) * kColumns + lane;
  const int y = rows[blockIdx.y];
  float own = most;
  if (x < samples.width) {
    const long at = samples.pixel(tables.reference.v, tables.reference.u, y, x);
    const bool is_valid = samples.valid == nullptr || samples.valid[at] != 0;
    float reference[3] = {};
    for (int c = 0; c < samples.channels; ++c) {
      reference[c] = is_valid ? samples.at(at, c) : nanf("");
    }
    for (int label = first; label < tables.labels; label += kLabelsAtOnce) {
      own = fminf(own, cost_of(tables, reference, label, y, x));
    }
  }
  of_labels[first][lane] = own;
  __syncthreads();
  if (first != 0 || x >= samples.width) return;
  for (int i = 1; i < kLabelsAtOnce; ++i) own = fminf(own, of_labels[i][lane]);
  least[static_cast<long>(blockIdx.y) * samples.width + x] = own;
}

}  // namespace

void find_least_costs(const MatchingTables& tables, const int* rows, int row_count, float most,
                      float* least, const DeviceStream& stream) {
  const dim3 grid(blocks_for(tables.samples.width, kColumns), static_cast<unsigned>(row_count));
  const dim3 block(kColumns, kLabelsAtOnce);
  const double each = static_cast<double>(row_count) * tables.samples.width * tables.labels *
                      tables.view_count * tables.samples.channels;
  launch(stream, {"stereo: least costs", each / tables.labels, each * 11},
         [&] { find_least<<<grid, block, 0, stream.get()>>>(tables, rows, most, least); });
}

}  // namespace episcope::cuda
