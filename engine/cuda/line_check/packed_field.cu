// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/line_check/packed_field.cuh"

namespace episcope::cuda {
namespace {

constexpr int kThreads = 256;

__device__ std::uint32_t quantised(float sample) {
  return static_cast<std::uint32_t>(
      __fmaf_rn(fminf(fmaxf(sample, 0.0F), 1.0F), static_cast<float>(kPackedMost), 0.5F));
}

__global__ __launch_bounds__(kThreads) void pack(DeviceSamples samples, long count,
                                                 std::uint32_t* out) {
  const long pixel = static_cast<long>(blockIdx.x) * kThreads + threadIdx.x;
  if (pixel >= count) return;
  if (samples.valid && samples.valid[pixel] == 0) {
    out[pixel] = 1U << kPackedInvalidBit;
    return;
  }
  const int second = samples.channels == 3 ? 1 : 0;
  out[pixel] = quantised(samples.at(pixel, 0)) |
               quantised(samples.at(pixel, second)) << kPackedBits |
               quantised(samples.at(pixel, 2 * second)) << (2 * kPackedBits);
}

}  // namespace

PackedFieldMemory::PackedFieldMemory(const DeviceSamples& samples, const DeviceStream& stream) {
  const long count = static_cast<long>(samples.grid.count()) * samples.height * samples.width;
  pixels_ = DeviceArray<std::uint32_t>(count, stream);
  const double read = static_cast<double>(count) * samples.channels;
  launch(stream, {"packing views", read + 4.0 * count, 2 * read}, [&] {
    pack<<<blocks_for(count, kThreads), kThreads, 0, stream.get()>>>(samples, count,
                                                                     pixels_.data());
  });
  field_ = {pixels_.data(), samples.grid, samples.height, samples.width, samples.valid != nullptr};
}

}  // namespace episcope::cuda
