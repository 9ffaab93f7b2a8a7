// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/line_check/line_residual.cuh"
#include "engine/cuda/line_check/line_trust.cuh"

namespace episcope::cuda {
namespace {

constexpr float kMinDifference = 1.0F / 255;
constexpr int kRadius = 2;
constexpr float kTextureGain = 4;
constexpr int kColumns = 32, kRows = 8;
constexpr int kWide = kColumns + 2 * kRadius, kHigh = kRows + 2 * kRadius;

// Whole numbers, which floats hold.
__device__ float squared_difference(const PackedColour& a, std::uint32_t packed) {
  constexpr float kUnit = 1.0F / static_cast<float>(kPackedMost);
  const PackedColour b = unpacked(packed);
  float sum = 0;
  for (int c = 0; c < 3; ++c) {
    const float off = a.channel[c] - b.channel[c];
    sum = __fmaf_rn(off, off, sum);
  }
  return sum * (kUnit * kUnit);
}

// Of the pixel and those around it: sums over both axes of squared differences.
struct Gradients {
  float mean, own;
};

// The neighbour opposite stands in place of one beyond the border.
__device__ int mirrored(int at, int size) {
  const int inside = at < 0 ? -at : at >= size ? 2 * (size - 1) - at : at;
  return min(max(inside, 0), size - 1);
}

__device__ Gradients gradients_at(const PackedField& field, const std::uint32_t* view, int y,
                                  int x) {
  const auto pixel = [&](int py, int px) { return __ldg(view + py * field.width + px); };
  const PackedColour here = unpacked(pixel(y, x));
  const float left = squared_difference(here, pixel(y, mirrored(x - 1, field.width)));
  const float right = squared_difference(here, pixel(y, mirrored(x + 1, field.width)));
  const float up = squared_difference(here, pixel(mirrored(y - 1, field.height), x));
  const float down = squared_difference(here, pixel(mirrored(y + 1, field.height), x));
  return {0.5F * (left + right) + 0.5F * (up + down), fminf(left, right) + fminf(up, down)};
}

// The mean over the window around a pixel, of what exists; `mean` is 0 elsewhere.
__device__ float window_mean(const PackedField& field, const float (&mean)[kHigh][kWide], int y,
                             int x) {
  float sum = 0;
  for (int i = 0; i <= 2 * kRadius; ++i) {
    float column = 0;
    for (int j = 0; j <= 2 * kRadius; ++j) column += mean[threadIdx.y + j][threadIdx.x + i];
    sum += column;
  }
  const int columns = min(x + kRadius, field.width - 1) - max(x - kRadius, 0) + 1;
  const int rows = min(y + kRadius, field.height - 1) - max(y - kRadius, 0) + 1;
  return sum / static_cast<float>(columns) / static_cast<float>(rows);
}

__global__ __launch_bounds__(kColumns* kRows) void reduce(PackedField field, MapPointers maps,
                                                          float variance) {
  __shared__ float mean[kHigh][kWide], own[kHigh][kWide];
  const int place = static_cast<int>(blockIdx.z);
  const int v = maps.first.v + place / maps.grid.u, u = maps.first.u + place % maps.grid.u;
  const std::uint32_t* const view = field.view(v, u);
  const int first_y = static_cast<int>(blockIdx.y) * kRows;
  const int first_x = static_cast<int>(blockIdx.x) * kColumns;
  const int thread = static_cast<int>(threadIdx.y) * kColumns + static_cast<int>(threadIdx.x);
  for (int i = thread; i < kHigh * kWide; i += kColumns * kRows) {
    const int y = first_y + i / kWide - kRadius, x = first_x + i % kWide - kRadius;
    const bool exists = y >= 0 && y < field.height && x >= 0 && x < field.width;
    const Gradients gradients = exists ? gradients_at(field, view, y, x) : Gradients{0, 0};
    mean[i / kWide][i % kWide] = gradients.mean;
    own[i / kWide][i % kWide] = gradients.own;
  }
  __syncthreads();
  const int y = first_y + static_cast<int>(threadIdx.y);
  const int x = first_x + static_cast<int>(threadIdx.x);
  if (y >= field.height || x >= field.width) return;
  const long at = (static_cast<long>(place) * field.height + y) * field.width + x;
  const float residual = line_residual(field, {v, u, y, x}, maps.disparity[at]);
  const float noise = __fmaf_rn(kMinDifference, kMinDifference, variance);
  const float beyond = fmaxf(residual - variance, 0);
  const float line = residual < INFINITY ? noise / (noise + beyond) : 1;
  const float change = own[threadIdx.y + kRadius][threadIdx.x + kRadius];
  const float share = kTextureGain * (change + noise) / (window_mean(field, mean, y, x) + noise);
  maps.confidence[at] *= sqrtf(sqrtf(line * fminf(share, 1)));
}

}  // namespace

void reduce_confidence(const PackedField& field, const MapPointers& maps, float variance,
                       const DeviceStream& stream) {
  const dim3 grid(blocks_for(field.width, kColumns), blocks_for(field.height, kRows),
                  static_cast<unsigned>(maps.grid.count()));
  const double rays = static_cast<double>(maps.grid.count()) * field.height * field.width;
  // A sample, a disparity and a confidence, read and written; two samples of up to 16 views.
  launch(stream, {"trust in lines", rays * 16, rays * 500},
         [&] { reduce<<<grid, dim3(kColumns, kRows), 0, stream.get()>>>(field, maps, variance); });
}

}  // namespace episcope::cuda
