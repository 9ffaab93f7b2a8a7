// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/stereo/view_noise.cuh"

#include <array>
#include <bit>

namespace episcope::cuda {
namespace {

// As engine/disparity/common/local_noise.cpp.
constexpr int kRadius = 2;
constexpr float kSecondDifference = 6;
constexpr int kWays = 4;

struct ViewSamples {
  DeviceSamples samples;
  ViewIndex view;

  [[nodiscard]] __device__ float at(int y, int x, int channel) const {
    return samples.at(samples.pixel(view.v, view.u, y, x), channel);
  }
};

// Squared second differences along four ways, `[way][y][x]`.
__global__ void square_differences(ViewSamples view, float* squares) {
  const int height = view.samples.height, width = view.samples.width;
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y * blockDim.y + threadIdx.y);
  if (x >= width || y >= height) return;
  const int row = min(max(y, 1), height - 2), column = min(max(x, 1), width - 2);
  const float scale = 1 / (kSecondDifference * static_cast<float>(view.samples.channels));
  const int ways[kWays][2] = {{0, 1}, {1, 0}, {1, 1}, {1, -1}};
  for (int i = 0; i < kWays; ++i) {
    const int down = ways[i][0], along = ways[i][1];
    float sum = 0;
    for (int c = 0; c < view.samples.channels; ++c) {
      const float d = view.at(row - down, column - along, c) - 2 * view.at(row, column, c) +
                      view.at(row + down, column + along, c);
      sum = __fadd_rn(sum, __fmul_rn(d, d));  // as the CPU rounds
    }
    squares[(static_cast<long>(i) * height + y) * width + x] = sum * scale;
  }
}

// The least over the ways of the means over windows.
__global__ void take_least_means(const float* squares, int height, int width, float most,
                                 float* least) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y * blockDim.y + threadIdx.y);
  if (x >= width || y >= height) return;
  const int top = max(y - kRadius, 0), bottom = min(y + kRadius, height - 1);
  const int left = max(x - kRadius, 0), right = min(x + kRadius, width - 1);
  float result = most;
  for (int i = 0; i < kWays; ++i) {
    const float* const plane = squares + static_cast<long>(i) * height * width;
    float sum = 0;
    for (int column = left; column <= right; ++column) {
      float down = 0;
      for (int row = top; row <= bottom; ++row) {
        down += plane[static_cast<long>(row) * width + column];
      }
      sum += down;
    }
    const float mean =
        sum / static_cast<float>(right - left + 1) / static_cast<float>(bottom - top + 1);
    result = fminf(result, mean);
  }
  least[static_cast<long>(y) * width + x] = result;
}

// The bits of a value ≥ 0 grow with it: the median is found digit by digit.
constexpr int kDigitBits = 11;
constexpr int kDigits = 1 << kDigitBits;
using Counts = std::array<unsigned, kDigits>;

// Of the values whose bits above the digit are `above`, how many have each digit.
__global__ void count_digits(const float* values, int count, int shift, unsigned above,
                             unsigned* counts) {
  __shared__ unsigned own[kDigits];
  for (int i = static_cast<int>(threadIdx.x); i < kDigits; i += static_cast<int>(blockDim.x)) {
    own[i] = 0;
  }
  __syncthreads();
  const int step = static_cast<int>(gridDim.x * blockDim.x);
  for (int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x); i < count; i += step) {
    const unsigned bits = __float_as_uint(values[i]);
    const unsigned digit = bits >> shift;
    if (digit / kDigits == above) atomicAdd(&own[digit % kDigits], 1U);
  }
  __syncthreads();
  for (int i = static_cast<int>(threadIdx.x); i < kDigits; i += static_cast<int>(blockDim.x)) {
    if (own[i] != 0) atomicAdd(&counts[i], own[i]);
  }
}

}  // namespace

DeviceArray<float> local_noise_on_device(const DeviceSamples& samples, ViewIndex view, float most,
                                         const DeviceStream& stream) {
  const int height = samples.height, width = samples.width;
  const auto pixels = static_cast<std::size_t>(height) * width;
  DeviceArray<float> least(pixels, stream);
  if (height < 3 || width < 3) {
    least.clear();
    return least;
  }
  DeviceArray<float> squares(kWays * pixels, stream);
  const dim3 block(32, 8);
  const dim3 grid(blocks_for(width, 32), blocks_for(height, 8));
  const auto all = static_cast<double>(pixels);
  launch(stream, {"stereo: second differences", all * (samples.channels + 16), all * 60}, [&] {
    square_differences<<<grid, block, 0, stream.get()>>>({samples, view}, squares.data());
  });
  launch(stream, {"stereo: noise", all * 20, all * 110}, [&] {
    take_least_means<<<grid, block, 0, stream.get()>>>(squares.data(), height, width, most,
                                                       least.data());
  });
  return least;
}

float median_on_device(const float* values, int count, const DeviceStream& stream) {
  constexpr int kThreads = 512, kBlocks = 64;
  DeviceArray<unsigned> counts(kDigits, stream);
  auto rank = static_cast<unsigned>(count / 2);
  unsigned above = 0;
  for (int shift = 2 * kDigitBits; shift >= 0; shift -= kDigitBits) {
    counts.clear();
    launch(stream, {"stereo: median", 4.0 * count}, [&] {
      count_digits<<<kBlocks, kThreads, 0, stream.get()>>>(values, count, shift, above,
                                                           counts.data());
    });
    Counts found;
    check(cudaMemcpyAsync(found.data(), counts.data(), counts.byte_size(), cudaMemcpyDeviceToHost,
                          stream.get()));
    stream.wait();
    unsigned digit = 0;
    while (digit + 1 < kDigits && found[digit] <= rank) rank -= found[digit++];
    above = above * kDigits + digit;
  }
  return std::bit_cast<float>(above);
}

}  // namespace episcope::cuda
