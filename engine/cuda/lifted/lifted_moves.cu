// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/lifted/lifted_fields.cuh"

namespace episcope::cuda {
namespace {

constexpr float kRelaxation = 1.9F;
constexpr int kThreads = 128;
// Of shared memory, what the columns of a block may take.
constexpr int kBlockBytes = 64 << 10;

// Duals at the pixels around one, of its layers; 0 beyond the border.
struct Around {
  const float* here[kLiftedPairs];
  const float* above[kLiftedPairs];
  bool has_left, has_above;

  __device__ Around(const LiftedFields& fields, int y, int x) : has_left(x > 0), has_above(y > 0) {
    for (int k = 0; k < kLiftedPairs; ++k) {
      here[k] = fields.duals[k] + fields.unknown(y, x);
      above[k] = fields.duals[k] + fields.unknown(has_above ? y - 1 : y, x);
    }
  }
  // What leaves the pixel less what enters it.
  [[nodiscard]] __device__ float divergence(long i) const {
    const float left = has_left ? here[0][i - 1] : 0.0F;
    const float rising = has_left ? here[3][i - 1] : 0.0F;
    const float upper = has_above ? above[1][i] : 0.0F;
    const float falling = has_above && has_left ? above[2][i - 1] : 0.0F;
    const float from_right = has_above ? above[3][i] : 0.0F;
    return here[0][i] - left + (here[1][i] - upper) + (here[2][i] - falling) +
           (rising - from_right);
  }
};

// Where the projection of a column is neither 1 nor 0; as Summits of lifted_labeling_kernel.cpp.
struct Summits {
  float sum = 0, high = 0, excess = 0, high_excess = 0;
  int full = 0, empty = 0;

  __device__ void add(float value, int layers) {
    sum += value;
    excess += value - 1.0F;
    if (sum > high) {
      high = sum;
      empty = layers;
    }
    if (excess > high_excess) {
      high_excess = excess;
      full = layers;
    }
  }
};

// Projects layers [begin, end) of a column to non-increasing sequences by pooling adjacent
// violators. The sums of the blocks take the place of the values; `counts` holds their sizes.
__device__ void pool(float* values, int stride, float* counts, int pitch, int begin, int end) {
  int blocks = begin;
  for (int l = begin; l < end; ++l) {
    float sum = values[l * stride], count = 1;
    while (blocks > begin && values[(blocks - 1) * stride] * count <=
                                 sum * counts[static_cast<long>(blocks - 1) * pitch]) {
      --blocks;
      sum += values[blocks * stride];
      count += counts[static_cast<long>(blocks) * pitch];
    }
    values[blocks * stride] = sum;
    counts[static_cast<long>(blocks) * pitch] = count;
    ++blocks;
  }
  // Backwards: a block's values end at or behind where its sum is.
  int l = end;
  for (int block = blocks; --block >= begin;) {
    const float count = counts[static_cast<long>(block) * pitch];
    const float mean = values[block * stride] / count;
    for (int i = 0; i < static_cast<int>(count); ++i) values[--l * stride] = mean;
  }
}

__global__ void move_primal(LiftedFields fields) {
  extern __shared__ float shared[];
  const int stride = static_cast<int>(blockDim.x), thread = static_cast<int>(threadIdx.x);
  float* const values = shared + thread;
  const int x = static_cast<int>(blockIdx.x) * stride + thread, y = static_cast<int>(blockIdx.y);
  const int width = fields.width();
  if (x >= width) return;
  const float* const cost = fields.cost.data + fields.costs_of(y, x);
  float* const phi = fields.phi + fields.unknown(y, x);
  float* const ahead = fields.ahead + fields.unknown(y, x);
  const Around duals(fields, y, x);
  Summits summits;
  float lower = cost[0];
#pragma unroll 8
  for (int l = 0; l < fields.steps; ++l) {
    const long i = static_cast<long>(l) * width;
    const float upper = cost[i + width];
    const float value = phi[i] + fields.primal_step * (duals.divergence(i) + (lower - upper));
    lower = upper;
    values[l * stride] = value;
    summits.add(value, l + 1);
  }
  if (summits.empty - summits.full > 1) {
    pool(values, stride, ahead, width, summits.full, summits.empty);
  }
#pragma unroll 4
  for (int l = 0; l < fields.steps; ++l) {
    const long i = static_cast<long>(l) * width;
    const float within = fmaxf(fminf(values[l * stride], 1.0F), 0.0F);
    const float projected = l < summits.full ? 1.0F : l < summits.empty ? within : 0.0F;
    const float old = phi[i];
    ahead[i] = 2.0F * projected - old;
    phi[i] = old + kRelaxation * (projected - old);
  }
}

__global__ void move_duals(LiftedFields fields) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y), width = fields.width();
  if (x >= width) return;
  const int right = x + 1 < width ? 1 : 0;
  const float* const ahead = fields.ahead + fields.unknown(y, x);
  const float* const below = fields.ahead + fields.unknown(min(y + 1, fields.height() - 1), x);
  float limits[kLiftedPairs];
  float* duals[kLiftedPairs];
  for (int k = 0; k < kLiftedPairs; ++k) {
    limits[k] = fields.limits[k][fields.pixel(y, x)];
    duals[k] = fields.duals[k] + fields.unknown(y, x);
  }
#pragma unroll 4
  for (int l = 0; l < fields.steps; ++l) {
    const long i = static_cast<long>(l) * width;
    const float at = ahead[i], beside = ahead[i + right];
    const float down = below[i], across = below[i + right];
    const float differences[kLiftedPairs] = {beside - at, down - at, across - at, down - beside};
#pragma unroll
    for (int k = 0; k < kLiftedPairs; ++k) {
      const float old = duals[k][i];
      const float next =
          fmaxf(fminf(old + fields.dual_step * differences[k], limits[k]), -limits[k]);
      duals[k][i] = old + kRelaxation * (next - old);
    }
  }
}

__global__ void start(LiftedFields fields) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y), width = fields.width();
  if (x >= width) return;
  const float* const cost = fields.cost.data + fields.costs_of(y, x);
  float least = cost[0];
  int label = 0;
  for (int l = 1; l < fields.cost.layers; ++l) {
    const float each = cost[static_cast<long>(l) * width];
    label = each < least ? l : label;
    least = each < least ? each : least;
  }
  for (int* const cut : fields.cuts) cut[fields.pixel(y, x)] = label;
  for (int l = 0; l < fields.steps; ++l) {
    const long i = fields.unknown(y, x) + static_cast<long>(l) * width;
    fields.phi[i] = l < label ? 1.0F : 0.0F;
    for (float* const duals : fields.duals) duals[i] = 0;
  }
}

// As PairLimits.
__global__ void limit(LiftedFields fields, const float* g, float weight) {
  constexpr float kSide = 1.41421356F - 1, kDiagonal = 1 - 0.70710678F;  // √2 − 1, 1 − √½
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  if (x >= fields.width()) return;
  const bool down = y + 1 < fields.height(), right = x + 1 < fields.width();
  const float along = kSide + kDiagonal * static_cast<float>((y == 0 ? 1 : 0) + (down ? 0 : 1));
  const float aside = kSide + kDiagonal * static_cast<float>((x == 0 ? 1 : 0) + (right ? 0 : 1));
  const long at = fields.pixel(y, x);
  const float here = weight * g[at];
  const float diagonal = right && down ? here * kDiagonal : 0.0F;
  fields.limits[0][at] = right ? here * along : 0.0F;
  fields.limits[1][at] = down ? here * aside : 0.0F;
  fields.limits[2][at] = diagonal;
  fields.limits[3][at] = diagonal;
}

dim3 rows_of(const LiftedFields& fields, int threads) {
  return {blocks_for(fields.width(), threads), static_cast<unsigned>(fields.height())};
}

// Threads of a block whose columns fit into shared memory.
int threads_for(int steps) {
  int threads = kThreads;
  while (threads > 32 && threads * steps * static_cast<int>(sizeof(float)) > kBlockBytes)
    threads /= 2;
  return threads;
}

}  // namespace

void fill_limits(const LiftedFields& fields, const float* g, float weight,
                 const DeviceStream& stream) {
  const double pixels = static_cast<double>(fields.height()) * fields.width();
  launch(stream, {"lifted: limits", pixels * 20, pixels * 6}, [&] {
    limit<<<rows_of(fields, kThreads), kThreads, 0, stream.get()>>>(fields, g, weight);
  });
}

void start_lifting(const LiftedFields& fields, const DeviceStream& stream) {
  const auto values = static_cast<double>(fields.cost.size());
  launch(stream, {"lifted: start", values * 24, values * 2},
         [&] { start<<<rows_of(fields, kThreads), kThreads, 0, stream.get()>>>(fields); });
}

void iterate_lifting(const LiftedFields& fields, const DeviceStream& stream) {
  const auto values = static_cast<double>(fields.cost.size());
  const int threads = threads_for(fields.steps);
  const int bytes = threads * fields.steps * static_cast<int>(sizeof(float));
  check(cudaFuncSetAttribute(move_primal, cudaFuncAttributeMaxDynamicSharedMemorySize, bytes));
  launch(stream, {"lifted: primal", values * 32, values * 22},
         [&] { move_primal<<<rows_of(fields, threads), threads, bytes, stream.get()>>>(fields); });
  launch(stream, {"lifted: dual", values * 36, values * 28},
         [&] { move_duals<<<rows_of(fields, kThreads), kThreads, 0, stream.get()>>>(fields); });
}

}  // namespace episcope::cuda
