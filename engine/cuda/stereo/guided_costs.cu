// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/stereo/guided_costs.cuh"

namespace episcope::cuda {
namespace {

constexpr int kThreads = 128;
// Rows that a block filters: many compared with those it needs beyond them.
constexpr int kChunk = 64;

// Guides of `kChannels` hold samples, means, and inverse covariances.
template <int kChannels>
constexpr int kProducts = kChannels == 3 ? 6 : 1;

// As GuideImage::find_statistics.
template <int kChannels>
__global__ void fill_guide(DeviceSamples samples, ViewIndex view, int radius, double regularization,
                           float* planes) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y * blockDim.y + threadIdx.y);
  const int height = samples.height, width = samples.width;
  if (x >= width || y >= height) return;
  const int top = max(0, y - radius), bottom = min(height - 1, y + radius);
  const int left = max(0, x - radius), right = min(width - 1, x + radius);
  double means[kChannels + kProducts<kChannels>] = {};
  for (int j = left; j <= right; ++j) {
    for (int i = top; i <= bottom; ++i) {
      const long at = samples.pixel(view.v, view.u, i, j);
      float sample[kChannels];
#pragma unroll
      for (int c = 0; c < kChannels; ++c) sample[c] = samples.at(at, c);
      int product = kChannels;
#pragma unroll
      for (int a = 0; a < kChannels; ++a) {
        means[a] += static_cast<double>(sample[a]);
#pragma unroll
        for (int b = a; b < kChannels; ++b) {
          means[product++] += static_cast<double>(__fmul_rn(sample[a], sample[b]));
        }
      }
    }
  }
  const double count = static_cast<double>(right - left + 1) * (bottom - top + 1);
#pragma unroll
  for (double& mean : means) mean /= count;
  const long plane = static_cast<long>(height) * width;
  float* const out = planes + static_cast<long>(y) * width + x;
  const long at = samples.pixel(view.v, view.u, y, x);
#pragma unroll
  for (int c = 0; c < kChannels; ++c) {
    out[c * plane] = samples.at(at, c);
    out[(kChannels + c) * plane] = static_cast<float>(means[c]);
  }
  if constexpr (kChannels == 1) {
    out[2 * plane] = static_cast<float>(1 / (means[1] - means[0] * means[0] + regularization));
  } else {
    double m[6];
    int product = 0;
#pragma unroll
    for (int a = 0; a < 3; ++a) {
#pragma unroll
      for (int b = a; b < 3; ++b, ++product) {
        m[product] = means[3 + product] - means[a] * means[b] + (a == b ? regularization : 0.0);
      }
    }
    const double a = m[3] * m[5] - m[4] * m[4];
    const double b = m[2] * m[4] - m[1] * m[5];
    const double c = m[1] * m[4] - m[2] * m[3];
    const double scale = 1 / (m[0] * a + m[1] * b + m[2] * c);
    const double inverse[6] = {a * scale,
                               b * scale,
                               c * scale,
                               (m[0] * m[5] - m[2] * m[2]) * scale,
                               (m[1] * m[2] - m[0] * m[4]) * scale,
                               (m[0] * m[3] - m[1] * m[1]) * scale};
#pragma unroll
    for (int i = 0; i < 6; ++i) out[(6 + i) * plane] = static_cast<float>(inverse[i]);
  }
}

// One plane for the values alone and one for each channel.
template <int kChannels>
using Planes = float[kChannels + 1];

// Rows of a block in shared memory, `[plane][thread]`, and the last 2·radius + 1 sums of each
// thread, `[slot][plane][thread]`.
template <int kChannels>
struct Rows {
  float* row;
  float* sums;
  int window;

  __device__ void put(const Planes<kChannels>& values) {
#pragma unroll
    for (int p = 0; p <= kChannels; ++p) row[p * kThreads + threadIdx.x] = values[p];
  }
  [[nodiscard]] __device__ float* slot(int y) {
    return sums + y % window * (kChannels + 1) * kThreads + threadIdx.x;
  }
  // Sums of the row along x, kept as those of row y.
  __device__ void keep_sums(int y, int radius) {
    float* const to = slot(y);
#pragma unroll
    for (int p = 0; p <= kChannels; ++p) {
      const float* const from = row + p * kThreads + threadIdx.x;
      float sum = from[-radius];
      for (int i = 1 - radius; i <= radius; ++i) sum += from[i];
      to[p * kThreads] = sum;
    }
  }
  // Sums of the kept rows [top, bottom].
  __device__ void sum_down(int top, int bottom, Planes<kChannels>& out) {
#pragma unroll
    for (int p = 0; p <= kChannels; ++p) out[p] = slot(top)[p * kThreads];
    for (int y = top + 1; y <= bottom; ++y) {
      const float* const from = slot(y);
#pragma unroll
      for (int p = 0; p <= kChannels; ++p) out[p] += from[p * kThreads];
    }
  }
};

// b, and a of each channel, with a·guide + b ≈ values in the window whose sums these are.
template <int kChannels>
__device__ void solve(const DeviceGuide& guide, long at, float scale, Planes<kChannels>& sums) {
  const float mean = sums[0] * scale;
  float means[kChannels], covariance[kChannels], inverse[kProducts<kChannels>];
#pragma unroll
  for (int c = 0; c < kChannels; ++c) {
    means[c] = guide.plane(kChannels + c)[at];
    // What is left of two products: rounded as on the CPU.
    covariance[c] = __fmaf_rn(sums[c + 1], scale, -__fmul_rn(means[c], mean));
  }
#pragma unroll
  for (int i = 0; i < kProducts<kChannels>; ++i) inverse[i] = guide.plane(2 * kChannels + i)[at];
  float a[kChannels];
  if constexpr (kChannels == 1) {
    a[0] = inverse[0] * covariance[0];
  } else {
    a[0] = inverse[0] * covariance[0] + inverse[1] * covariance[1] + inverse[2] * covariance[2];
    a[1] = inverse[1] * covariance[0] + inverse[3] * covariance[1] + inverse[4] * covariance[2];
    a[2] = inverse[2] * covariance[0] + inverse[4] * covariance[1] + inverse[5] * covariance[2];
  }
  sums[0] = mean;
#pragma unroll
  for (int c = 0; c < kChannels; ++c) {
    sums[0] -= a[c] * means[c];
    sums[c + 1] = a[c];
  }
}

// A block goes down its rows: sums of a row, the model a radius above it, and the result another
// radius above follow each other, as in GuidedFilter.
template <int kChannels>
__global__ void filter(DeviceGuide guide, CostRows from, const float* costs, CostRows to,
                       float* filtered) {
  extern __shared__ float shared[];
  const int radius = guide.radius, window = 2 * radius + 1;
  const int row_floats = (kChannels + 1) * kThreads;
  Rows<kChannels> products{shared, shared + row_floats, window};
  float* const second = shared + row_floats * (1 + window);
  Rows<kChannels> models{second, second + row_floats, window};
  const int thread = static_cast<int>(threadIdx.x), width = guide.width, height = guide.height;
  const int x = static_cast<int>(blockIdx.x) * (kThreads - 4 * radius) - 2 * radius + thread;
  const int label = static_cast<int>(blockIdx.z);
  const int begin = to.first + static_cast<int>(blockIdx.y) * kChunk;
  const int end = min(begin + kChunk, to.first + to.rows);
  const bool is_inside = x >= 0 && x < width;
  const bool has_window = thread >= radius && thread < kThreads - radius;
  const bool has_both = thread >= 2 * radius && thread < kThreads - 2 * radius;
  const int columns = min(x + radius, width - 1) - max(x - radius, 0) + 1;
  const float share = 1.0F / static_cast<float>(columns);
  const auto rows_about = [&](int y) {
    return min(y + radius, height - 1) - max(y - radius, 0) + 1;
  };
  for (int row = max(begin - 2 * radius, 0); row < end + 2 * radius; ++row) {
    if (row < height) {
      Planes<kChannels> values = {};
      if (is_inside) {
        values[0] = costs[(static_cast<long>(row - from.first) * from.labels + label) * width + x];
#pragma unroll
        for (int c = 0; c < kChannels; ++c) {
          values[c + 1] = values[0] * guide.plane(c)[static_cast<long>(row) * width + x];
        }
      }
      products.put(values);
    }
    __syncthreads();
    if (row < height && has_window) products.keep_sums(row, radius);
    const int middle = row - radius;
    const bool has_model = middle >= max(begin - radius, 0) && middle < height;
    if (has_model && has_window) {
      Planes<kChannels> model = {};
      if (is_inside) {
        products.sum_down(max(middle - radius, 0), min(middle + radius, height - 1), model);
        solve<kChannels>(guide, static_cast<long>(middle) * width + x,
                         share * (1.0F / static_cast<float>(rows_about(middle))), model);
      }
      models.put(model);
    }
    __syncthreads();
    if (has_model && has_both) models.keep_sums(middle, radius);
    const int done = row - 2 * radius;
    if (done < begin || done >= end || !has_both || !is_inside) continue;
    Planes<kChannels> model;
    models.sum_down(max(done - radius, 0), min(done + radius, height - 1), model);
    float sum = model[0];
#pragma unroll
    for (int c = 0; c < kChannels; ++c) {
      sum += model[c + 1] * guide.plane(c)[static_cast<long>(done) * width + x];
    }
    filtered[(static_cast<long>(done - to.first) * to.labels + label) * width + x] =
        sum * share * (1.0F / static_cast<float>(rows_about(done)));
  }
}

template <int kChannels>
void launch_filter(const DeviceGuide& guide, const CostRows& from, const float* costs,
                   const CostRows& to, float* filtered, const DeviceStream& stream) {
  const dim3 grid(blocks_for(guide.width, kThreads - 4 * guide.radius), blocks_for(to.rows, kChunk),
                  static_cast<unsigned>(to.labels));
  const std::size_t bytes = sizeof(float) * (kChannels + 1) * kThreads * 2 *
                            (2 + 2 * static_cast<std::size_t>(guide.radius));
  check(cudaFuncSetAttribute(filter<kChannels>, cudaFuncAttributeMaxDynamicSharedMemorySize,
                             static_cast<int>(bytes)));
  const double values = static_cast<double>(to.rows) * to.labels * guide.width;
  const double each = 4.0 * (kChannels + 1) * (2 * guide.radius + 1) + 40;
  launch(stream, {"stereo: guided filter", values * 8, values * each}, [&] {
    filter<kChannels><<<grid, kThreads, bytes, stream.get()>>>(guide, from, costs, to, filtered);
  });
}

}  // namespace

DeviceArray<float> make_guide_planes(const DeviceSamples& samples, ViewIndex view, int radius,
                                     double regularization, const DeviceStream& stream) {
  const auto pixels = static_cast<std::size_t>(samples.height) * samples.width;
  const int count = samples.channels == 3 ? 12 : 3;
  DeviceArray<float> planes(count * pixels, stream);
  const dim3 block(32, 8);
  const dim3 grid(blocks_for(samples.width, 32), blocks_for(samples.height, 8));
  const double work = static_cast<double>(pixels) * (2.0 * radius + 1) * (2.0 * radius + 1);
  launch(stream, {"stereo: guide", pixels * (4.0 * count + samples.channels), work * 2 * count},
         [&] {
           const auto fill = samples.channels == 3 ? fill_guide<3> : fill_guide<1>;
           fill<<<grid, block, 0, stream.get()>>>(samples, view, radius, regularization,
                                                  planes.data());
         });
  return planes;
}

void filter_costs(const DeviceGuide& guide, const CostRows& from, const float* costs,
                  const CostRows& to, float* filtered, const DeviceStream& stream) {
  const auto run = guide.channels == 3 ? launch_filter<3> : launch_filter<1>;
  run(guide, from, costs, to, filtered, stream);
}

}  // namespace episcope::cuda
