// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/double_products.cuh"

#include "engine/cuda/device.cuh"
#include "engine/disparity/kernels/shared_constants.h"

#include <algorithm>
#include <cstdlib>

namespace episcope::cuda {
namespace {

__device__ float sample_at(const DoubleLine& line, const DoublePlanes& planes, int row, int a,
                           int b, int channel) {
  const int along = min(max(a, 0), planes.length() - 1);
  const long pixel = planes.is_horizontal ? line.samples.pixel(line.number, row, b, along)
                                          : line.samples.pixel(row, line.number, along, b);
  if (line.samples.valid != nullptr && line.samples.valid[pixel] == 0) return nanf("");
  return line.samples.at(pixel, channel);
}

// Where a thread works: x and y of a plane with margins, to a and b.
struct Place {
  int a = 0, b = 0;
  bool is_inside = false;
};
__device__ Place place_of(const DoublePlanes& planes, int x, int y) {
  const int length = planes.length() + 2 * planes.margin;
  const int a = planes.is_horizontal ? x : y, b = planes.is_horizontal ? y : x;
  return {a - planes.margin, b, a < length && b < planes.breadth()};
}
__device__ Place place_of_thread(const DoublePlanes& planes) {
  return place_of(planes, static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x),
                  static_cast<int>(blockIdx.y * blockDim.y + threadIdx.y));
}

dim3 blocks_of(const DoublePlanes& planes, int count) {
  const int width = planes.width + (planes.is_horizontal ? 2 * planes.margin : 0);
  const int height = planes.height + (planes.is_horizontal ? 0 : 2 * planes.margin);
  return {blocks_for(width, 32), blocks_for(height, 8), static_cast<unsigned>(count)};
}

// Block z is a channel of a view.
__global__ void differentiate_planes(DoubleLine line, DoubleFilters filters, DoublePlanes planes,
                                     float* derivatives) {
  const Place place = place_of_thread(planes);
  if (!place.is_inside) return;
  const int plane = static_cast<int>(blockIdx.z);
  const int channel = plane / line.rows, row = plane % line.rows;
  const int radius = filters.along[0].radius;
  float sums[3] = {};
  for (int i = -radius; i <= radius; ++i) {
    const float sample = sample_at(line, planes, row, place.a + i, place.b, channel);
    for (int order = 0; order < 3; ++order) {
      sums[order] += filters.along[order].values[i + radius] * sample;
    }
  }
  const long size = planes.size(), count = static_cast<long>(gridDim.z);
  const long at = plane * size + planes.at(place.a, place.b);
  for (int order = 0; order < 3; ++order) derivatives[order * count * size + at] = sums[order];
}

// Product rows of a block, which read much the same derivatives.
constexpr int kRowsAtOnce = 3;
constexpr int kChannels = 3;  // at most

// Sums over views along a line, the derivatives of which are read once for all rows.
struct LineSums {
  float xx[kRowsAtOnce][kChannels] = {}, xu[kRowsAtOnce][kChannels] = {};
  float uu[kRowsAtOnce][kChannels] = {};
};

struct Rows {
  int first = 0, count = 0;
};

// Line a + step·row goes through pixel a of view `row`.
__device__ LineSums sums_of(const DoubleLine& line, const DoubleFilters& filters, const Rows& rows,
                            int step, const DoublePlanes& planes, const float* derivatives, int on,
                            int b) {
  const int channels = line.samples.channels;
  const long channel = line.rows * planes.size(), order = channels * channel;
  const int radius = filters.views[0].radius;
  LineSums sums;
  for (int view = rows.first - radius; view < rows.first + rows.count + radius; ++view) {
    const float* const from =
        derivatives + view * planes.size() + planes.at_clamped(on - view * step, b);
    float values[3][kChannels] = {};
#pragma unroll
    for (int c = 0; c < kChannels; ++c) {
      if (c >= channels) break;
      for (int k = 0; k < 3; ++k) values[k][c] = __ldg(from + c * channel + k * order);
    }
#pragma unroll
    for (int r = 0; r < kRowsAtOnce; ++r) {
      const int tap = view - rows.first - r + radius;
      if (tap < 0 || tap > 2 * radius) continue;
#pragma unroll
      for (int c = 0; c < kChannels; ++c) {
        sums.xx[r][c] += filters.views[0].values[tap] * values[2][c];
        sums.xu[r][c] += filters.views[1].values[tap] * values[1][c];
        sums.uu[r][c] += filters.views[2].values[tap] * values[0][c];
      }
    }
  }
  return sums;
}

struct Products {
  float values[6];
};

// Products of the whitened derivatives, channels summed, toned down.
__device__ Products products_of(const LineSums& line, int row, int channels,
                                const DoubleFilters& filters) {
  float sums[6] = {};
#pragma unroll
  for (int c = 0; c < kChannels; ++c) {
    if (c >= channels) break;
    const float third = filters.scale[2] * line.uu[row][c] + filters.mix * line.xx[row][c];
    const float first = filters.scale[0] * line.xx[row][c];
    const float middle = filters.scale[1] * line.xu[row][c];
    sums[0] += first * first;
    sums[1] += first * middle;
    sums[2] += first * third;
    sums[3] += middle * middle;
    sums[4] += middle * third;
    sums[5] += third * third;
  }
  const float energy = sums[0] + sums[3] + sums[5];
  const float weight = filters.contrast_energy / (energy + filters.contrast_energy);
  Products products;
  for (int j = 0; j < 6; ++j) {
    // What an invalid sample entered counts nothing.
    products.values[j] = isnan(sums[j]) ? 0.0F : weight * sums[j];
  }
  return products;
}

// Tiles of a block, with the halo of the integration along a.
constexpr int kLongTile = 128, kThinTile = 2;      // a, b of horizontal EPIs
constexpr int kSquareTile = 16, kNarrowTile = 16;  // of vertical ones
constexpr int kThreads = 256;
constexpr int kMostRadius = DoubleTaps::kMost / 2;

// Blocks x are groups of product rows, y and z tiles of lines.
template <int kTileA, int kTileB>
__global__ void multiply_planes(const __grid_constant__ DoubleLine line,
                                const __grid_constant__ DoubleFilters filters, int step,
                                DoublePlanes of_derivatives, const float* derivatives,
                                DoublePlanes planes, int first_line, float* products) {
  constexpr int kMostA = kTileA + 2 * kMostRadius;
  __shared__ float tile[kRowsAtOnce][6][kMostA * kTileB];
  const bool is_horizontal = planes.is_horizontal;
  const auto block_a = static_cast<int>(is_horizontal ? blockIdx.y : blockIdx.z);
  const auto block_b = static_cast<int>(is_horizontal ? blockIdx.z : blockIdx.y);
  const int first_on = block_a * kTileA + first_line, first_b = block_b * kTileB;
  const int first_row = static_cast<int>(blockIdx.x) * kRowsAtOnce;
  const Rows rows{line.first_product + first_row, min(kRowsAtOnce, line.product_rows - first_row)};
  const int radius = filters.integrate.radius, long_a = kTileA + 2 * radius;
  for (int i = static_cast<int>(threadIdx.x); i < long_a * kTileB; i += kThreads) {
    const int a = is_horizontal ? i % long_a : i / kTileB;
    const int b = is_horizontal ? i / long_a : i % kTileB;
    const LineSums sums = sums_of(line, filters, rows, step, of_derivatives, derivatives,
                                  first_on + a - radius, min(first_b + b, planes.breadth() - 1));
#pragma unroll
    for (int r = 0; r < kRowsAtOnce; ++r) {
      const Products here = products_of(sums, r, line.samples.channels, filters);
      for (int j = 0; j < 6; ++j) tile[r][j][b * kMostA + a] = here.values[j];
    }
  }
  __syncthreads();
  const long size = planes.size(), order = line.product_rows * size;
  for (int i = static_cast<int>(threadIdx.x); i < kTileA * kTileB; i += kThreads) {
    const int a = is_horizontal ? i % kTileA : i / kTileB;
    const int b = is_horizontal ? i / kTileA : i % kTileB;
    if (first_b + b >= planes.breadth()) continue;
    for (int r = 0; r < rows.count; ++r) {
      const int pixel = first_on + a - step * (rows.first + r);
      if (!planes.has(pixel)) continue;
      float sums[6] = {};
      for (int k = 0; k <= 2 * radius; ++k) {
        const float weight = filters.integrate.values[k];
        for (int j = 0; j < 6; ++j) sums[j] += weight * tile[r][j][b * kMostA + a + k];
      }
      const long at = (first_row + r) * size + planes.at(pixel, first_b + b);
      for (int j = 0; j < 6; ++j) products[j * order + at] = sums[j];
    }
  }
}

// Rows that a thread goes down.
constexpr int kRun = 8;

// Σ weight·value over a window of which the thread's next row brings one value more.
template <int kRadius>
__device__ void average_down(const DoubleTaps& taps, int width, int height, int x, int first,
                             const float* from, float* to) {
  constexpr int kTaps = 2 * kRadius + 1;
  const auto value = [&](int y) { return __ldg(from + min(max(y, 0), height - 1) * width + x); };
  float window[kTaps];
#pragma unroll
  for (int i = 1; i < kTaps; ++i) window[i] = value(first - kRadius + i - 1);
#pragma unroll
  for (int y = first; y < first + kRun; ++y) {
    if (y >= height) return;
#pragma unroll
    for (int i = 0; i + 1 < kTaps; ++i) window[i] = window[i + 1];
    window[kTaps - 1] = value(y + kRadius);
    float sum = 0;
#pragma unroll
    for (int i = 0; i < kTaps; ++i) sum += taps.values[i] * window[i];
    to[y * width + x] = sum;
  }
}

template <int kRadius>
__device__ void average_along(const DoubleTaps& taps, int width, int height, int x, int first,
                              const float* from, float* to) {
  constexpr int kTaps = 2 * kRadius + 1;
  int at[kTaps];
#pragma unroll
  for (int i = 0; i < kTaps; ++i) at[i] = min(max(x + i - kRadius, 0), width - 1);
  for (int y = first; y < min(first + kRun, height); ++y) {
    float sum = 0;
#pragma unroll
    for (int i = 0; i < kTaps; ++i) sum += taps.values[i] * __ldg(from + y * width + at[i]);
    to[y * width + x] = sum;
  }
}

// Block z is a plane. Beyond the first and last EPI, these repeat. kRadius is that of the taps.
template <int kRadius>
__global__ void average_planes(const __grid_constant__ DoubleTaps taps, DoublePlanes planes,
                               const float* products, float* averaged) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int first = static_cast<int>(blockIdx.y * blockDim.y + threadIdx.y) * kRun;
  const int margins = 2 * planes.margin;
  const int width = planes.width + (planes.is_horizontal ? margins : 0);
  const int height = planes.height + (planes.is_horizontal ? 0 : margins);
  if (x >= width || first >= height) return;
  const long plane = blockIdx.z * planes.size();
  const float* const from = products + plane;
  if (planes.is_horizontal) {
    average_down<kRadius>(taps, width, height, x, first, from, averaged + plane);
  } else {
    average_along<kRadius>(taps, width, height, x, first, from, averaged + plane);
  }
}

}  // namespace

void differentiate(const DoubleLine& line, const DoubleFilters& filters, const DoublePlanes& planes,
                   float* derivatives, const DeviceStream& stream) {
  const int count = line.samples.channels * line.rows;
  const double places = static_cast<double>(planes.size()) * count;
  launch(stream, {"double: derivatives", places * 13, places * 6 * 5}, [&] {
    differentiate_planes<<<blocks_of(planes, count), dim3(32, 8), 0, stream.get()>>>(
        line, filters, planes, derivatives);
  });
}

void multiply(const DoubleLine& line, const DoubleFilters& filters, int step,
              const DoublePlanes& of_derivatives, const float* derivatives,
              const DoublePlanes& planes, float* products, const DeviceStream& stream) {
  const double places = static_cast<double>(planes.size());
  const double read = static_cast<double>(of_derivatives.size()) * line.rows;
  const KernelWork work{"double: products",
                        4 * (3 * line.samples.channels * read + 6 * line.product_rows * places),
                        places * line.product_rows * (line.samples.channels * 48 + 110)};
  // Of the first and the last product row, every pixel lies on one of these lines.
  const int one = step * line.first_product,
            other = step * (line.first_product + line.product_rows - 1);
  const int first_line = std::min(one, other) - planes.margin;
  const int lines = planes.length() + 2 * planes.margin + std::abs(other - one);
  const unsigned groups = blocks_for(line.product_rows, kRowsAtOnce);
  launch(stream, work, [&] {
    if (planes.is_horizontal) {
      const dim3 grid(groups, blocks_for(lines, kLongTile),
                      blocks_for(planes.breadth(), kThinTile));
      multiply_planes<kLongTile, kThinTile><<<grid, kThreads, 0, stream.get()>>>(
          line, filters, step, of_derivatives, derivatives, planes, first_line, products);
    } else {
      const dim3 grid(groups, blocks_for(planes.breadth(), kNarrowTile),
                      blocks_for(lines, kSquareTile));
      multiply_planes<kSquareTile, kNarrowTile><<<grid, kThreads, 0, stream.get()>>>(
          line, filters, step, of_derivatives, derivatives, planes, first_line, products);
    }
  });
}

void average_across(const DoubleLine& line, const DoubleFilters& filters,
                    const DoublePlanes& planes, const float* products, float* averaged,
                    const DeviceStream& stream) {
  const int count = 6 * line.product_rows;
  const double places = static_cast<double>(planes.size()) * count;
  const dim3 each = blocks_of(planes, count);
  const dim3 grid(each.x, blocks_for(each.y, kRun), each.z);
  const auto run = [&] {
    switch (filters.across.radius) {
      case 0:
        return average_planes<0>;
      case 1:
        return average_planes<1>;
      case 2:
        return average_planes<2>;
      case 3:
        return average_planes<3>;
      case 4:
        return average_planes<4>;
      case 5:
        return average_planes<5>;
      default:
        return average_planes<DoubleTaps::kMost / 2>;
    }
  }();
  launch(stream, {"double: across EPIs", places * 8, places * 10}, [&] {
    run<<<grid, dim3(32, 8), 0, stream.get()>>>(filters.across, planes, products, averaged);
  });
}

namespace {

// The tensor of 6 products and what its smallest eigenvector says.
struct Answer {
  float mean = 0, half_distance = 0, confidence = 0;
  bool is_real = false;
};

// Newton's steps on the characteristic polynomial from 0, which rise monotonically.
__device__ float smallest_eigenvalue(float minors, float determinant) {
  float value = 0;
  for (int i = 0; i < 5; ++i) {
    const float p = ((value - 1) * value + minors) * value - determinant;
    const float slope = (3 * value - 2) * value + minors;
    value = fmaxf(value - p / fmaxf(slope, kMinorsFloor), 0.0F);
  }
  return value;
}

__device__ Answer solve(const float (&products)[6], const DoubleFilters& filters) {
  const float trace = products[0] + products[3] + products[5] + 1e-20F;
  const float inverse = 1 / trace;
  float t[6];
  for (int j = 0; j < 6; ++j) t[j] = inverse * products[j];
  const float minors =
      t[0] * t[3] - t[1] * t[1] + (t[0] * t[5] - t[2] * t[2]) + (t[3] * t[5] - t[4] * t[4]);
  const float determinant = t[0] * (t[3] * t[5] - t[4] * t[4]) -
                            t[1] * (t[1] * t[5] - t[2] * t[4]) + t[2] * (t[1] * t[4] - t[2] * t[3]);
  const float smallest = smallest_eigenvalue(fmaxf(minors, 0.0F), determinant);
  // The other two: their sum is 1 − smallest, their product what is left of the minors.
  const float sum = 1 - smallest, product = fmaxf(minors - smallest * sum, 0.0F);
  const float root = sqrtf(fmaxf(sum * sum - 4 * product, 0.0F));
  const float middle = 2 * product / (sum + root + 1e-20F);
  // Its eigenvector is any column of the adjoint of T − λ: the longest is the safest.
  const float a = t[0] - smallest, d = t[3] - smallest, f = t[5] - smallest;
  const float c11 = d * f - t[4] * t[4], c22 = a * f - t[2] * t[2], c33 = a * d - t[1] * t[1];
  const float c12 = t[2] * t[4] - t[1] * f, c13 = t[1] * t[4] - t[2] * d;
  const float c23 = t[1] * t[2] - a * t[4];
  const bool third = c33 >= c11 && c33 >= c22, second = c22 >= c11;
  const float b1 = third ? c13 : second ? c12 : c11;
  const float b2 = third ? c23 : second ? c22 : c12;
  const float b3 = third ? c33 : second ? c23 : c13;
  // Back from whitened derivatives: Q f_xx − S f_xu + f_uu = 0.
  const bool is_sound = b3 * b3 > 1e-4F * (b1 * b1 + b2 * b2 + b3 * b3);
  const float inverse_last = 1 / (is_sound ? filters.scale[2] * b3 : 1.0F);
  Answer answer;
  answer.mean = -0.5F * filters.scale[1] * b2 * inverse_last;
  const float both = (filters.scale[0] * b1 + filters.mix * b3) * inverse_last;
  const float discriminant = answer.mean * answer.mean - both;
  answer.half_distance = sqrtf(fmaxf(discriminant, 0.0F));
  answer.is_real = is_sound && discriminant > 0 && minors > kMinorsFloor;
  // Two orientations leave the third eigenvalue empty, one leaves the second empty as well.
  const float strength = middle * trace;
  answer.confidence = fmaxf(1 - smallest / (middle + 1e-20F), 0.0F) * strength /
                      (strength + filters.noise_energy + 1e-20F);
  return answer;
}

// The lines of a shear on which wanted views lie: line a + step·row goes through pixel a of view
// `row`, and takes the same of the products for all of them.
struct Lines {
  int first = 0, count = 0;

  Lines(const DoublePlanes& planes, const DoubleBest& best, int step) {
    const int one = step * best.first, other = step * (best.first + best.count - 1);
    first = std::min(one, other);
    count = planes.length() + std::abs(other - one);
  }
};

// The products of a line, of the thread alone: `[product row][which of 6][thread]`.
class LineProducts {
 public:
  __device__ LineProducts(const DoubleLine& line, const DoublePlanes& planes, int step, int on,
                          int b, const float* products, float* memory)
      : own_(memory + threadIdx.x), rows_(line.product_rows) {
    const long size = planes.size();
    for (int i = 0; i < rows_; ++i) {
      const float* const from =
          products + i * size + planes.at(on - step * (line.first_product + i), b);
      for (int j = 0; j < 6; ++j) at(i, j) = __ldg(from + j * rows_ * size);
    }
  }
  __device__ void weigh(const float* weights, float (&sums)[6]) const {
    for (int i = 0; i < rows_; ++i) {
      const float weight = __ldg(weights + i);
      for (int j = 0; j < 6; ++j) sums[j] += weight * at(i, j);
    }
  }

 private:
  [[nodiscard]] __device__ float& at(int i, int j) const {
    return own_[(i * 6 + j) * static_cast<int>(blockDim.x)];
  }

  float* own_;
  int rows_;
};

__device__ void keep_better(const Answer& answer, const DoubleLimits& limits,
                            const DoubleBest& best, long at) {
  const auto step = static_cast<float>(limits.step);
  const float near = answer.mean + answer.half_distance + step;
  const float far = answer.mean - answer.half_distance + step;
  const bool better = answer.is_real && fabsf(answer.mean) <= limits.limit &&
                      answer.half_distance >= 0.5F * limits.min_distance && near <= limits.max &&
                      far >= limits.min && answer.confidence > best.confidence[at];
  if (!better) return;
  best.near[at] = near;
  best.far[at] = far;
  best.confidence[at] = answer.confidence;
}

__global__ void select_best(DoubleLine line, DoubleFilters filters, const float* row_weights,
                            DoubleLimits limits, DoublePlanes planes, Lines lines,
                            const float* products, DoubleBest best) {
  extern __shared__ float memory[];
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  const int on = lines.first + (planes.is_horizontal ? x : y);
  const int b = planes.is_horizontal ? y : x;
  if (on >= lines.first + lines.count || b >= planes.breadth()) return;
  const LineProducts own(line, planes, limits.step, on, b, products, memory);
  const DoublePlanes views{planes.is_horizontal, planes.height, planes.width, 0};
  for (int number = 0; number < best.count; ++number) {
    const int row = best.first + number, a = on - limits.step * row;
    if (a < 0 || a >= planes.length()) continue;
    float sums[6] = {};
    own.weigh(row_weights + row * line.product_rows, sums);
    keep_better(solve(sums, filters), limits, best, number * views.size() + views.at(a, b));
  }
}

}  // namespace

void select(const DoubleLine& line, const DoubleFilters& filters, const float* row_weights,
            const DoubleLimits& limits, const DoublePlanes& planes, const float* products,
            const DoubleBest& best, const DeviceStream& stream) {
  constexpr std::size_t kMostBytes = std::size_t{48} << 10;
  const std::size_t of_thread = static_cast<std::size_t>(line.product_rows) * 6 * sizeof(float);
  int threads = 128;
  while (threads > 32 && threads * of_thread > kMostBytes) threads /= 2;
  const Lines lines(planes, best, limits.step);
  const int across = planes.is_horizontal ? lines.count : planes.breadth();
  const int down = planes.is_horizontal ? planes.breadth() : lines.count;
  const dim3 grid(blocks_for(across, threads), static_cast<unsigned>(down));
  const double pixels = static_cast<double>(planes.width) * planes.height * best.count;
  const double read = static_cast<double>(planes.size()) * static_cast<double>(of_thread);
  launch(stream, {"double: select", read + pixels * 12, pixels * (line.product_rows * 12 + 140)},
         [&] {
           select_best<<<grid, threads, threads * of_thread, stream.get()>>>(
               line, filters, row_weights, limits, planes, lines, products, best);
         });
}

}  // namespace episcope::cuda
