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

struct Place {
  int view, y, x;
  long first;  ///< Of the view.
  bool inside;
};

__device__ Place place_in(const PackedField& field) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const auto view = static_cast<int>(blockIdx.z);
  return {view, static_cast<int>(blockIdx.y), x,
          static_cast<long>(view) * field.height * field.width, x < field.width};
}

// The mean of `count` quantities over the window of a pixel, column by column as window_mean_row
// adds them up; `values(at, out)` gives those of pixel `at` of a view.
template <int count, class Values>
__device__ void window_means(const PackedField& field, int y, int x, int radius,
                             const Values& values, float (&means)[count]) {
  const int top = max(y - radius, 0), bottom = min(y + radius + 1, field.height);
  const int left = max(x - radius, 0), right = min(x + radius + 1, field.width);
  for (float& mean : means) mean = 0;
  for (int column = left; column < right; ++column) {
    float sums[count] = {};
    for (int row = top; row < bottom; ++row) {
      float each[count];
      values(static_cast<long>(row) * field.width + column, each);
      for (int k = 0; k < count; ++k) sums[k] += each[k];
    }
    for (int k = 0; k < count; ++k) means[k] += sums[k];
  }
  for (float& mean : means) {
    mean = mean / static_cast<float>(right - left) / static_cast<float>(bottom - top);
  }
}

// Residuals of the lines of the single layer, for line_fit.
__global__ void find_misfits(PackedField field, MappedViews views, const float* single,
                             float* misfits) {
  const Place place = place_in(field);
  if (!place.inside) return;
  const RayPlace ray{views.first.v + place.view / views.grid.u,
                     views.first.u + place.view % views.grid.u, place.y, place.x};
  const long at = place.first + static_cast<long>(place.y) * field.width + place.x;
  misfits[at] = fminf(line_residual(field, ray, single[at]), kMostResidual);
}

// Of one layer: its variance over a window, weighted by confidence.
__device__ float variance_of(const PackedField& field, const Place& place, const float* layer,
                             const std::uint8_t* confidence) {
  float means[3];
  window_means<3>(
      field, place.y, place.x, kSpreadRadius,
      [&](long at, float(&out)[3]) {
        const float weight = confidence[at], d = layer[at];
        out[0] = weight;
        out[1] = __fmul_rn(weight, d);
        out[2] = __fmul_rn(out[1], d);
      },
      means);
  const float of = fmaxf(means[0], kLeastWeight), mean = means[1] / of;
  return __fsub_rn(means[2] / of, __fmul_rn(mean, mean));
}

__global__ void find_steadiness(PackedField field, ScoredMaps maps, float* steadiness) {
  const Place place = place_in(field);
  if (!place.inside) return;
  const std::uint8_t* const confidence = maps.confidence + place.first;
  const float variance =
      fmaxf(fmaxf(0.0F, variance_of(field, place, maps.near + place.first, confidence)),
            variance_of(field, place, maps.far + place.first, confidence));
  steadiness[place.first + static_cast<long>(place.y) * field.width + place.x] =
      1 / (1 + variance / (kSpread * kSpread));
}

// The largest coherence around a pixel.
__device__ float spread_at(const PackedField& field, const Place& place, const float* fit) {
  float most = -INFINITY;
  for (int y = max(place.y - kSpreadReach, 0); y < min(place.y + kSpreadReach + 1, field.height);
       ++y) {
    for (int x = max(place.x - kSpreadReach, 0); x < min(place.x + kSpreadReach + 1, field.width);
         ++x) {
      most = fmaxf(most, fit[place.first + static_cast<long>(y) * field.width + x]);
    }
  }
  return most;
}

// How well lines explain the pixels of a window: 1 − s·e/v, see raise_by_line_fit.
__device__ float line_fit(const PackedField& field, const MappedViews& views, const Place& place,
                          const float* misfits, float strictness) {
  const std::uint32_t* const pixels = field.view(views.first.v + place.view / views.grid.u,
                                                 views.first.u + place.view % views.grid.u);
  float means[5];
  window_means<5>(
      field, place.y, place.x, kFitRadius,
      [&](long at, float(&out)[5]) {
        out[3] = 0;
        for (int c = 0; c < 3; ++c) {
          out[c] = static_cast<float>(packed_channel(pixels[at], c)) / kPackedMost;
          out[3] = __fadd_rn(out[3], __fmul_rn(out[c], out[c]));
        }
        out[4] = misfits[place.first + at];
      },
      means);
  float variance = means[3];
  for (int c = 0; c < 3; ++c) variance = __fsub_rn(variance, __fmul_rn(means[c], means[c]));
  return 1 - strictness * means[4] / (2 * fmaxf(variance, kMinVariance));
}

__global__ void judge(PackedField field, MappedViews views, float decision, float strictness,
                      ScoredMaps maps, const float* misfits, const float* steady) {
  const Place place = place_in(field);
  if (!place.inside) return;
  const long at = place.first + static_cast<long>(place.y) * field.width + place.x;
  const float r =
      fmaxf(spread_at(field, place, maps.fit), line_fit(field, views, place, misfits, strictness));
  const float c = static_cast<float>(maps.confidence[at]) / 255;
  float means[1];
  window_means<1>(
      field, place.y, place.x, kSteadyReach,
      [&](long i, float(&out)[1]) { out[0] = steady[place.first + i]; }, means);
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
  const dim3 blocks(blocks_for(field.width, kThreads), static_cast<unsigned>(field.height),
                    static_cast<unsigned>(views.grid.count()));
  const auto count = static_cast<double>(field.height) * field.width * views.grid.count();
  const auto size = static_cast<std::size_t>(count);
  DeviceArray<float> misfits(size, stream), steady(size, stream);
  launch(stream, {"layers: misfits of lines", 12 * count, 700 * count}, [&] {
    find_misfits<<<blocks, kThreads, 0, stream.get()>>>(field, views, maps.single, misfits.data());
  });
  launch(stream, {"layers: steadiness", 13 * count, 250 * count}, [&] {
    find_steadiness<<<blocks, kThreads, 0, stream.get()>>>(field, maps, steady.data());
  });
  launch(stream, {"layers: score", 25 * count, 400 * count}, [&] {
    judge<<<blocks, kThreads, 0, stream.get()>>>(field, views, decision, strictness, maps,
                                                 misfits.data(), steady.data());
  });
}

}  // namespace episcope::cuda
