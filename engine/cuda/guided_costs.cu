// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/matching_costs.cuh"

#include "engine/cuda/device.cuh"
#include "engine/disparity/kernels/shared_constants.h"

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
  constexpr int kSums = kChannels + kProducts<kChannels>;
  double means[kSums] = {};
  for (int j = left; j <= right; ++j) {
    double down[kSums] = {};
    for (int i = top; i <= bottom; ++i) {
      const long at = samples.pixel(view.v, view.u, i, j);
      float sample[kChannels];
#pragma unroll
      for (int c = 0; c < kChannels; ++c) sample[c] = samples.at(at, c);
      int product = kChannels;
#pragma unroll
      for (int a = 0; a < kChannels; ++a) {
        down[a] += static_cast<double>(sample[a]);
#pragma unroll
        for (int b = a; b < kChannels; ++b) {
          down[product++] += static_cast<double>(__fmul_rn(sample[a], sample[b]));
        }
      }
    }
#pragma unroll
    for (int k = 0; k < kSums; ++k) means[k] += down[k];
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
    out[2 * plane] =
        static_cast<float>(1 / (means[1] - __dmul_rn(means[0], means[0]) + regularization));
  } else {
    double m[6];
    int product = 0;
#pragma unroll
    for (int a = 0; a < 3; ++a) {
#pragma unroll
      for (int b = a; b < 3; ++b, ++product) {
        m[product] =
            means[3 + product] - __dmul_rn(means[a], means[b]) + (a == b ? regularization : 0.0);
      }
    }
    // Products are rounded as on the CPU: little is left of their differences.
    const auto minor = [&](int i, int j, int k, int l) {
      return __dmul_rn(m[i], m[j]) - __dmul_rn(m[k], m[l]);
    };
    const double a = minor(3, 5, 4, 4), b = minor(2, 4, 1, 5), c = minor(1, 4, 2, 3);
    const double scale = 1 / (__dmul_rn(m[0], a) + __dmul_rn(m[1], b) + __dmul_rn(m[2], c));
    const double inverse[6] = {a * scale,
                               b * scale,
                               c * scale,
                               minor(0, 5, 2, 2) * scale,
                               minor(1, 2, 0, 4) * scale,
                               minor(0, 3, 1, 1) * scale};
#pragma unroll
    for (int i = 0; i < 6; ++i) out[(6 + i) * plane] = static_cast<float>(inverse[i]);
  }
}

// One plane for the values alone and one for each channel.
template <int kChannels>
using Planes = float[kChannels + 1];

// A row of a block in shared memory, `[plane][thread]`, and of each thread the last 2·radius + 1
// sums along a row, `[slot][plane][thread]`. The radius is known to the compiler unless kRadius is
// 0.
template <int kChannels, int kRadius>
struct Rows {
  float* row;
  float* sums;
  int radius;
  int base;  // Row whose sums are in slot 0, of the last rows; at first the first one.

  [[nodiscard]] __device__ int reach() const { return kRadius > 0 ? kRadius : radius; }
  [[nodiscard]] __device__ float* slot(int y) const {
    const int i = y < base ? y - base + 2 * reach() + 1 : y - base;
    return sums + i * (kChannels + 1) * kThreads + threadIdx.x;
  }
  __device__ void put(const Planes<kChannels>& values) {
#pragma unroll
    for (int p = 0; p <= kChannels; ++p) row[p * kThreads + threadIdx.x] = values[p];
  }
  // Sums of the row along x, kept as those of row y, which must be asked for in order.
  __device__ void keep_sums(int y) {
    if (y - base > 2 * reach()) base = y;
    float* const to = slot(y);
#pragma unroll
    for (int p = 0; p <= kChannels; ++p) {
      const float* const from = row + p * kThreads + threadIdx.x;
      float sum = from[-reach()];
      for (int i = 1 - reach(); i <= reach(); ++i) sum += from[i];
      to[p * kThreads] = sum;
    }
  }
  // Sums of the kept rows about y that lie in [0, height).
  __device__ void sum_down(int y, int height, Planes<kChannels>& out) const {
#pragma unroll
    for (int p = 0; p <= kChannels; ++p) out[p] = 0;
    for (int i = y - reach(); i <= y + reach(); ++i) {
      if (i < 0 || i >= height) continue;
      const float* const from = slot(i);
#pragma unroll
      for (int p = 0; p <= kChannels; ++p) out[p] += from[p * kThreads];
    }
  }
};

// What a model is solved with.
template <int kChannels>
struct Moments {
  float means[kChannels] = {};
  float inverse[kProducts<kChannels>] = {};
};

// b, and a of each channel, with a·guide + b ≈ values in the window whose sums these are.
template <int kChannels>
__device__ void solve(const Moments<kChannels>& moments, float scale, Planes<kChannels>& sums) {
  const float mean = __fmul_rn(sums[0], scale);
  const auto& inverse = moments.inverse;
  float covariance[kChannels];
#pragma unroll
  for (int c = 0; c < kChannels; ++c) {
    // What is left of two products: rounded as on the CPU.
    covariance[c] = __fmaf_rn(sums[c + 1], scale, -__fmul_rn(moments.means[c], mean));
  }
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
    sums[0] = __fmaf_rn(-a[c], moments.means[c], sums[0]);
    sums[c + 1] = a[c];
  }
}

// What a thread reads and writes: column x of one label; 0 beyond the image.
template <int kChannels>
struct Column {
  const DeviceGuide& guide;
  const CostRows& from;
  const CostRows& to;
  const float* costs;
  float* filtered;
  int label, x;

  [[nodiscard]] __device__ bool has(int y) const {
    return x >= 0 && x < guide.width && y >= 0 && y < guide.height;
  }
  [[nodiscard]] __device__ float guide_at(int plane, int y) const {
    return guide.plane(plane)[static_cast<long>(y) * guide.width + x];
  }
  __device__ void read_values(int y, Planes<kChannels>& values) const {
    const bool is_there = has(y) && y < from.first + from.rows;
    const long row = static_cast<long>(y - from.first) * from.labels + label;
    values[0] = is_there ? costs[row * guide.width + x] : 0.0F;
#pragma unroll
    for (int c = 0; c < kChannels; ++c) values[c + 1] = is_there ? guide_at(c, y) : 0.0F;
  }
  [[nodiscard]] __device__ Moments<kChannels> read_moments(int y) const {
    Moments<kChannels> moments;
    if (!has(y)) return moments;
#pragma unroll
    for (int c = 0; c < kChannels; ++c) moments.means[c] = guide_at(kChannels + c, y);
#pragma unroll
    for (int i = 0; i < kProducts<kChannels>; ++i) {
      moments.inverse[i] = guide_at(2 * kChannels + i, y);
    }
    return moments;
  }
  // The mean model of the window, applied to the guide.
  __device__ void write(int y, const Planes<kChannels>& model, float share,
                        float share_down) const {
    float sum = model[0];
#pragma unroll
    for (int c = 0; c < kChannels; ++c) sum += model[c + 1] * guide_at(c, y);
    const long row = static_cast<long>(y - to.first) * to.labels + label;
    filtered[row * guide.width + x] = sum * share * share_down;
  }
};

// 1 / how many of the pixels about `at` lie within the extent of an axis.
__device__ float share_of(int at, int radius, int extent) {
  const int count = min(at + radius, extent - 1) - max(at - radius, 0) + 1;
  return 1.0F / static_cast<float>(count);
}

// A block goes down its rows: sums of a row, the model a radius above it, and the result another
// radius above follow each other, as in GuidedFilter. What the next step needs of the device's
// memory is asked for before threads wait for each other.
template <int kChannels, int kRadius>
__global__ void filter(DeviceGuide guide, CostRows from, const float* costs, CostRows to,
                       float* filtered) {
  extern __shared__ float shared[];
  const int radius = kRadius > 0 ? kRadius : guide.radius;
  const int row_floats = (kChannels + 1) * kThreads, thread = static_cast<int>(threadIdx.x);
  float* const second = shared + row_floats * (2 + 2 * radius);
  const int x = static_cast<int>(blockIdx.x) * (kThreads - 4 * radius) - 2 * radius + thread;
  const Column<kChannels> column{guide, from, to, costs, filtered, static_cast<int>(blockIdx.z), x};
  const int begin = to.first + static_cast<int>(blockIdx.y) * kChunk;
  const int end = min(begin + kChunk, to.first + to.rows);
  const int first = max(begin - 2 * radius, 0), first_model = max(begin - radius, 0);
  Rows<kChannels, kRadius> products{shared, shared + row_floats, radius, first};
  Rows<kChannels, kRadius> models{second, second + row_floats, radius, first_model};
  const bool has_window = thread >= radius && thread < kThreads - radius;
  const bool has_both = thread >= 2 * radius && thread < kThreads - 2 * radius;
  const float share = share_of(x, radius, guide.width);
  Planes<kChannels> values;
  column.read_values(first, values);
  for (int row = first; row < end + 2 * radius; ++row) {
#pragma unroll
    for (int c = 0; c < kChannels; ++c) values[c + 1] *= values[0];
    products.put(values);
    const int middle = row - radius, done = row - 2 * radius;
    const Moments<kChannels> moments = column.read_moments(middle);
    column.read_values(row + 1, values);
    __syncthreads();
    if (has_window) products.keep_sums(row);
    const bool has_model = middle >= first_model && middle < guide.height;
    if (has_model && has_window) {
      Planes<kChannels> model = {};
      if (column.has(middle)) {
        products.sum_down(middle, guide.height, model);
        solve<kChannels>(moments, share * share_of(middle, radius, guide.height), model);
      }
      models.put(model);
    }
    __syncthreads();
    if (has_model && has_both) models.keep_sums(middle);
    if (done < begin || !has_both || !column.has(done)) continue;
    Planes<kChannels> model;
    models.sum_down(done, guide.height, model);
    column.write(done, model, share, share_of(done, radius, guide.height));
  }
}

template <int kChannels, int kRadius>
void launch_filter(const DeviceGuide& guide, const CostRows& from, const float* costs,
                   const CostRows& to, float* filtered, const DeviceStream& stream) {
  const dim3 grid(blocks_for(guide.width, kThreads - 4 * guide.radius), blocks_for(to.rows, kChunk),
                  static_cast<unsigned>(to.labels));
  const std::size_t bytes = sizeof(float) * (kChannels + 1) * kThreads * 2 *
                            (2 + 2 * static_cast<std::size_t>(guide.radius));
  check(cudaFuncSetAttribute(filter<kChannels, kRadius>,
                             cudaFuncAttributeMaxDynamicSharedMemorySize, static_cast<int>(bytes)));
  const double values = static_cast<double>(to.rows) * to.labels * guide.width;
  const double each = 4.0 * (kChannels + 1) * (2 * guide.radius + 1) + 40;
  launch(stream, {"stereo: guided filter", values * 8, values * each}, [&] {
    filter<kChannels, kRadius>
        <<<grid, kThreads, bytes, stream.get()>>>(guide, from, costs, to, filtered);
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
  constexpr int kUsual = 2;
  const bool is_usual = guide.radius == kUsual;
  const auto run = guide.channels == 3
                       ? (is_usual ? launch_filter<3, kUsual> : launch_filter<3, 0>)
                       : (is_usual ? launch_filter<1, kUsual> : launch_filter<1, 0>);
  run(guide, from, costs, to, filtered, stream);
}

namespace {

__global__ void choose(VolumeView<const float> costs, LabelPlaces places, float* disparity,
                       float* confidence) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  if (x >= costs.width) return;
  const float* const column = costs.data + static_cast<long>(y) * costs.layers * costs.width + x;
  float least = INFINITY, sum = 0;
  int best = 0;
#pragma unroll 8
  for (int label = 0; label < costs.layers; ++label) {
    const float cost = column[static_cast<long>(label) * costs.width];
    sum += cost;
    best = cost < least ? label : best;
    least = cost < least ? cost : least;
  }
  auto place = static_cast<float>(best);
  if (best > 0 && best + 1 < costs.layers) {
    place += offset_between(column[static_cast<long>(best - 1) * costs.width], least,
                            column[static_cast<long>(best + 1) * costs.width], places.refinement);
  }
  const long at = static_cast<long>(y) * costs.width + x;
  disparity[at] = places.first + place * places.step;
  const float mean = sum / static_cast<float>(costs.layers);
  confidence[at] = fminf(fmaxf((mean - least) / (mean + kFlatCost), 0.0F), 1.0F);
}

}  // namespace

void choose_winners(VolumeView<const float> costs, const LabelPlaces& places, float* disparity,
                    float* confidence, const DeviceStream& stream) {
  constexpr int kThreads = 128;
  const dim3 grid(blocks_for(costs.width, kThreads), static_cast<unsigned>(costs.height));
  const auto values = static_cast<double>(costs.size());
  launch(stream, {"stereo: winners", 4 * values, 3 * values}, [&] {
    choose<<<grid, kThreads, 0, stream.get()>>>(costs, places, disparity, confidence);
  });
}

}  // namespace episcope::cuda
