// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/layers/layer_score.cuh"
#include "engine/cuda/line_check/line_residual.cuh"

namespace episcope::cuda {
namespace {

constexpr int kThreads = 128;
// As in layer_decision, line_fit, layer_steadiness and layer_score.cpp.
constexpr int kSpreadReach = 2, kFitRadius = 2, kSpreadRadius = 2, kSteadyReach = 4;
constexpr float kMinVariance = 1.0F / (255 * 255), kMostResidual = 3;
constexpr float kSpread = 0.2F, kLeastWeight = 1e-6F, kSurface = 0.5F, kNoSurface = 0.3F;
constexpr float kLeastMisfit = 0.03F, kNoiseFit = 0.3F, kOneLayer = 0.02F;

// A thread has a column of a row of a view; those at either end of a block, and beyond the view,
// only help with windows of their neighbours.
struct Place {
  int view, y, x;
  long first;  ///< Of the view.
  bool exists, inside;
};

template <int kHalo>
__device__ Place place_in(const PackedField& field) {
  const int thread = static_cast<int>(threadIdx.x);
  const int x = static_cast<int>(blockIdx.x) * (kThreads - 2 * kHalo) + thread - kHalo;
  const auto view = static_cast<int>(blockIdx.z);
  const bool exists = x >= 0 && x < field.width;
  const bool is_result = thread >= kHalo && thread < kThreads - kHalo;
  return {view,   static_cast<int>(blockIdx.y),
          x,      static_cast<long>(view) * field.height * field.width,
          exists, exists && is_result};
}

template <int kHalo>
dim3 blocks_of(const PackedField& field, const MappedViews& views) {
  return {blocks_for(field.width, kThreads - 2 * kHalo), static_cast<unsigned>(field.height),
          static_cast<unsigned>(views.grid.count())};
}

// What the columns of a window add up to, by thread.
using ColumnSums = float[5][kThreads];

// The mean of `count` quantities over the window of a pixel, column by column as window_mean_row
// adds them up; `values(at, out)` gives those of pixel `at` of a view. All threads take part.
template <int count, class Values>
__device__ void window_means(const PackedField& field, const Place& place, int radius,
                             const Values& values, ColumnSums& columns, float (&means)[count]) {
  const int top = max(place.y - radius, 0), bottom = min(place.y + radius + 1, field.height);
  const int left = max(place.x - radius, 0), right = min(place.x + radius + 1, field.width);
  const int thread = static_cast<int>(threadIdx.x);
  float sums[count] = {};
  for (int row = top; place.exists && row < bottom; ++row) {
    float each[count];
    values(row * field.width + place.x, each);
    for (int k = 0; k < count; ++k) sums[k] += each[k];
  }
  __syncthreads();  // those of the window before have been read
  for (int k = 0; k < count; ++k) columns[k][thread] = sums[k];
  __syncthreads();
  for (float& mean : means) mean = 0;
  if (!place.inside) return;
  for (int column = left; column < right; ++column) {
    for (int k = 0; k < count; ++k) means[k] += columns[k][thread + column - place.x];
  }
  for (float& mean : means) {
    mean = mean / static_cast<float>(right - left) / static_cast<float>(bottom - top);
  }
}

// Residuals of the lines of the single layer, for line_fit.
__global__ __launch_bounds__(kThreads) void find_misfits(PackedField field, MappedViews views,
                                                         const float* single, float* misfits) {
  const Place place = place_in<0>(field);
  if (!place.inside) return;
  const RayPlace ray{views.first.v + place.view / views.grid.u,
                     views.first.u + place.view % views.grid.u, place.y, place.x};
  const long at = place.first + static_cast<long>(place.y) * field.width + place.x;
  misfits[at] = fminf(line_residual(field, ray, single[at]), kMostResidual);
}

// Of one layer: its variance over a window, weighted by confidence.
__device__ float variance_of(const PackedField& field, const Place& place, const float* layer,
                             const std::uint8_t* confidence, ColumnSums& columns) {
  float means[3];
  window_means<3>(
      field, place, kSpreadRadius,
      [&](int at, float(&out)[3]) {
        const float weight = confidence[at], d = layer[at];
        out[0] = weight;
        out[1] = __fmul_rn(weight, d);
        out[2] = __fmul_rn(out[1], d);
      },
      columns, means);
  const float of = fmaxf(means[0], kLeastWeight), mean = means[1] / of;
  return __fsub_rn(means[2] / of, __fmul_rn(mean, mean));
}

__global__ __launch_bounds__(kThreads) void find_steadiness(PackedField field, ScoredMaps maps,
                                                            float* steadiness) {
  __shared__ ColumnSums columns;
  const Place place = place_in<kSpreadRadius>(field);
  const std::uint8_t* const confidence = maps.confidence + place.first;
  const float near = variance_of(field, place, maps.near + place.first, confidence, columns);
  const float far = variance_of(field, place, maps.far + place.first, confidence, columns);
  if (!place.inside) return;
  const float variance = fmaxf(fmaxf(0.0F, near), far);
  steadiness[place.first + static_cast<long>(place.y) * field.width + place.x] =
      1 / (1 + variance / (kSpread * kSpread));
}

// The largest coherence around a pixel. All threads take part.
__device__ float spread_at(const PackedField& field, const Place& place, const float* fit,
                           ColumnSums& columns) {
  const int thread = static_cast<int>(threadIdx.x);
  const int top = max(place.y - kSpreadReach, 0);
  const int bottom = min(place.y + kSpreadReach + 1, field.height);
  float most = -INFINITY;
  for (int y = top; place.exists && y < bottom; ++y) {
    most = fmaxf(most, fit[y * field.width + place.x]);
  }
  __syncthreads();
  columns[0][thread] = most;
  __syncthreads();
  if (!place.inside) return 0;
  for (int i = -kSpreadReach; i <= kSpreadReach; ++i) most = fmaxf(most, columns[0][thread + i]);
  return most;
}

// How well lines explain the pixels of a window: 1 − s·e/v, see raise_by_line_fit.
__device__ float line_fit(const PackedField& field, const MappedViews& views, const Place& place,
                          const float* misfits, float strictness, ColumnSums& columns) {
  const std::uint32_t* const pixels = field.view(views.first.v + place.view / views.grid.u,
                                                 views.first.u + place.view % views.grid.u);
  float means[5];
  window_means<5>(
      field, place, kFitRadius,
      [&](int at, float(&out)[5]) {
        out[3] = 0;
        for (int c = 0; c < 3; ++c) {
          out[c] = static_cast<float>(packed_channel(pixels[at], c)) / kPackedMost;
          out[3] = __fadd_rn(out[3], __fmul_rn(out[c], out[c]));
        }
        out[4] = misfits[at];
      },
      columns, means);
  float variance = means[3];
  for (int c = 0; c < 3; ++c) variance = __fsub_rn(variance, __fmul_rn(means[c], means[c]));
  return 1 - strictness * means[4] / (2 * fmaxf(variance, kMinVariance));
}

__global__ __launch_bounds__(kThreads) void judge(PackedField field, MappedViews views,
                                                  float decision, float strictness, ScoredMaps maps,
                                                  const float* misfits, const float* steady) {
  __shared__ ColumnSums columns;
  const Place place = place_in<kSteadyReach>(field);
  const float spread = spread_at(field, place, maps.fit + place.first, columns);
  const float r =
      fmaxf(spread, line_fit(field, views, place, misfits + place.first, strictness, columns));
  float means[1];
  window_means<1>(
      field, place, kSteadyReach,
      [from = steady + place.first](int i, float(&out)[1]) { out[0] = from[i]; }, columns, means);
  if (!place.inside) return;
  const long at = place.first + static_cast<long>(place.y) * field.width + place.x;
  const float c = static_cast<float>(maps.confidence[at]) / 255;
  const float steadiness =
      fminf(fmaxf((means[0] - kNoSurface) / (kSurface - kNoSurface), 0.0F), 1.0F);
  const float share = (1 - r) / (2 - r - c + kLeastMisfit);
  const float doubles =
      share > decision ? (share - decision) / (1 - decision) : share / decision - 1;
  // What is no surface speaks for one layer.
  const float seen = steadiness * (doubles + 1) - 1;
  const float fit = fmaxf((fmaxf(r, c) - kNoiseFit) / (1 - kNoiseFit), 0.0F);
  maps.score[at] = (fit * seen - kOneLayer) / (fit + kOneLayer);
  maps.weight[at] = fit + kOneLayer;
}

}  // namespace

void score_layers(const PackedField& field, const MappedViews& views, float decision,
                  float strictness, const ScoredMaps& maps, const DeviceStream& stream) {
  const auto count = static_cast<double>(field.height) * field.width * views.grid.count();
  const auto size = static_cast<std::size_t>(count);
  DeviceArray<float> misfits(size, stream), steady(size, stream);
  launch(stream, {"layers: misfits of lines", 12 * count, 700 * count}, [&] {
    find_misfits<<<blocks_of<0>(field, views), kThreads, 0, stream.get()>>>(
        field, views, maps.single, misfits.data());
  });
  launch(stream, {"layers: steadiness", 13 * count, 250 * count}, [&] {
    find_steadiness<<<blocks_of<kSpreadRadius>(field, views), kThreads, 0, stream.get()>>>(
        field, maps, steady.data());
  });
  launch(stream, {"layers: score", 25 * count, 400 * count}, [&] {
    judge<<<blocks_of<kSteadyReach>(field, views), kThreads, 0, stream.get()>>>(
        field, views, decision, strictness, maps, misfits.data(), steady.data());
  });
}

}  // namespace episcope::cuda
