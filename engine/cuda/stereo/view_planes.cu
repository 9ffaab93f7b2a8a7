// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/stereo/view_planes.cuh"

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

}  // namespace episcope::cuda
