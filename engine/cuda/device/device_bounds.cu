// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/device_bounds.h"

#include "engine/cuda/device/device_array.cuh"

#include <algorithm>

namespace episcope {
namespace {

constexpr int kThreads = 256;
constexpr int kBlocks = 132 * 32;
constexpr int kSteps = 4096;
constexpr int kChains = 8;

// Independent chains of multiply-adds, so that none waits for another.
__global__ void multiply_add(float* out, float factor) {
  float values[kChains];
  for (int i = 0; i < kChains; ++i) values[i] = static_cast<float>(threadIdx.x + i);
  for (int step = 0; step < kSteps; ++step) {
#pragma unroll
    for (int i = 0; i < kChains; ++i) values[i] = values[i] * factor + 1;
  }
  float sum = 0;
  for (int i = 0; i < kChains; ++i) sum += values[i];
  out[blockIdx.x * kThreads + threadIdx.x] = sum;
}

// Seconds of one of several runs, after one that is not counted.
template <class Work>
double seconds_of(const cuda::DeviceStream& stream, const Work& work) {
  constexpr int kRuns = 5;
  cudaEvent_t begin = nullptr, end = nullptr;
  cuda::check(cudaEventCreate(&begin));
  cuda::check(cudaEventCreate(&end));
  work();
  cuda::check(cudaEventRecord(begin, stream.get()));
  for (int i = 0; i < kRuns; ++i) work();
  cuda::check(cudaEventRecord(end, stream.get()));
  cuda::check(cudaEventSynchronize(end));
  float milliseconds = 0;
  cuda::check(cudaEventElapsedTime(&milliseconds, begin, end));
  cudaEventDestroy(begin);
  cudaEventDestroy(end);
  return milliseconds / 1e3 / kRuns;
}

}  // namespace

DeviceBounds measure_device_bounds() {
  constexpr std::size_t kBytes = std::size_t{1} << 30;
  const cuda::DeviceStream stream;
  cuda::DeviceArray<char> from(kBytes, stream), to(kBytes, stream);
  cuda::DeviceArray<float> sums(static_cast<std::size_t>(kThreads) * kBlocks, stream);
  from.clear();
  DeviceBounds bounds;
  bounds.bytes = 2.0 * kBytes / seconds_of(stream, [&] {
                   cuda::check(cudaMemcpyAsync(to.data(), from.data(), kBytes,
                                               cudaMemcpyDeviceToDevice, stream.get()));
                 });
  const double operations = 2.0 * kThreads * kBlocks * kSteps * kChains;
  bounds.operations = operations / seconds_of(stream, [&] {
                        multiply_add<<<kBlocks, kThreads, 0, stream.get()>>>(sums.data(), 0.5F);
                        cuda::check(cudaGetLastError());
                      });
  return bounds;
}

}  // namespace episcope
