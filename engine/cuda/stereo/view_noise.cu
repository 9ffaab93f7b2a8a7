// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/stereo/view_noise.cuh"

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

}  // namespace episcope::cuda
