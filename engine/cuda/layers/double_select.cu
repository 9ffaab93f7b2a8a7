// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/layers/double_planes.cuh"

#include <algorithm>
#include <cstdlib>

namespace episcope::cuda {
namespace {

// The tensor of 6 products and what its smallest eigenvector says.
struct Answer {
  float mean = 0, half_distance = 0, confidence = 0;
  bool is_real = false;
};

// Below it the tensor, of trace 1, has rank 1 as far as floats can tell.
constexpr float kMinorsFloor = 1e-5F;

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
