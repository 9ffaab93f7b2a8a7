// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/line_check/line_residual.cuh"
#include "engine/cuda/line_check/residual_noise.cuh"

#include <cub/device/device_radix_sort.cuh>

namespace episcope::cuda {
namespace {

constexpr int kThreads = 256;

// Residuals of one view, and how many of them are finite.
__global__ __launch_bounds__(kThreads) void measure(PackedField field, ViewIndex view,
                                                    const float* disparity, float* residuals,
                                                    int* finite) {
  const int count = field.height * field.width;
  const int at = static_cast<int>(blockIdx.x * kThreads + threadIdx.x);
  bool is_finite = false;
  if (at < count) {
    const RayPlace ray{view.v, view.u, at / field.width, at % field.width};
    residuals[at] = line_residual(field, ray, disparity[at]);
    is_finite = isfinite(residuals[at]);
  }
  const int in_block = __syncthreads_count(is_finite);
  if (threadIdx.x == 0) atomicAdd(finite, in_block);
}

template <class T>
T fetch(const T* from, const DeviceStream& stream) {
  T value{};
  check(cudaMemcpyAsync(&value, from, sizeof value, cudaMemcpyDeviceToHost, stream.get()));
  stream.wait();
  return value;
}

}  // namespace

float residual_noise(const PackedField& field, const MapPointers& maps,
                     const DeviceStream& stream) {
  const ViewIndex center = field.grid.center();
  const int count = field.height * field.width;
  const long place = maps.index(center.v, center.u);
  DeviceArray<float> residuals(count, stream), sorted(count, stream);
  DeviceArray<int> finite(1, stream);
  finite.clear();
  launch(stream, {"residuals of the centre view", 8.0 * count, 700.0 * count}, [&] {
    measure<<<blocks_for(count, kThreads), kThreads, 0, stream.get()>>>(
        field, center, maps.disparity + place * count, residuals.data(), finite.data());
  });
  std::size_t bytes = 0;
  check(cub::DeviceRadixSort::SortKeys(nullptr, bytes, residuals.data(), sorted.data(), count, 0,
                                       32, stream.get()));
  DeviceArray<char> scratch(bytes, stream);
  check(cub::DeviceRadixSort::SortKeys(scratch.data(), bytes, residuals.data(), sorted.data(),
                                       count, 0, 32, stream.get()));
  const int known = fetch(finite.data(), stream);
  // The median by nearest rank; what is infinite comes last.
  return known == 0 ? 0 : fetch(sorted.data() + known / 2, stream);
}

}  // namespace episcope::cuda
