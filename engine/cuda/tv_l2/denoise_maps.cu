// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/tv_l2/denoise_maps.cuh"
#include "engine/cuda/tv_l2/tv_l2_solver.cuh"

#include <algorithm>

namespace episcope::cuda {
namespace {

// Of the free memory, what the solver may take.
constexpr double kShare = 0.8;

// Views that fit at once, at least one.
int views_at_once(const DeviceSamples& samples, int wanted) {
  std::size_t free = 0, total = 0;
  check(cudaMemGetInfo(&free, &total));
  const std::size_t pixels = static_cast<std::size_t>(samples.height) * samples.width;
  const std::size_t each =
      TvL2Grids::bytes_per_view(samples.height, samples.width) + 2 * pixels * sizeof(float);
  const auto fit = static_cast<std::size_t>(kShare * static_cast<double>(free)) / each;
  return std::clamp(static_cast<int>(std::min<std::size_t>(fit, 1 << 20)), 1, wanted);
}

}  // namespace

std::vector<double> denoise_on_device(const DeviceSamples& samples, const MappedViews& views,
                                      const MapDenoising& denoising, const float* confidence,
                                      float* disparity, const DeviceStream& stream,
                                      const Progress& progress) {
  const int count = views.grid.count();
  const int at_once = views_at_once(samples, count);
  const std::size_t pixels = static_cast<std::size_t>(samples.height) * samples.width;
  DeviceArray<float> data(at_once * pixels, stream), edges(at_once * pixels, stream);
  std::vector<double> gaps;
  for (int first = 0; first < count; first += at_once) {
    const int now = std::min(at_once, count - first);
    float* const maps = disparity + first * pixels;
    fill_weights(samples, views, first, now, denoising, confidence + first * pixels, maps,
                 {data.data(), edges.data()}, stream);
    TvL2DeviceSolver solver(samples.height, samples.width, now, stream);
    const Progress part =
        progress.part(static_cast<double>(first) / count, static_cast<double>(first + now) / count);
    for (const TvL2Outcome& outcome :
         solver.solve({maps, data.data(), edges.data(), denoising.lambda}, denoising.max_iterations,
                      denoising.gap, part, maps)) {
      gaps.push_back(outcome.relative_gap());
    }
  }
  return gaps;
}

}  // namespace episcope::cuda
