// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/layer_solver.h"

#include "engine/cuda/device.cuh"
#include "engine/solvers/shared_constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

namespace episcope::cuda {
namespace {

// The unknowns of the solver and what they are held against, for kernels. φ, `ahead` and each
// pair's duals are `[y][layer][x]`, the limits of each pair `[y][x]`.
struct LiftedFields {
  VolumeView<const float> cost;  // One layer more.
  float* phi = nullptr;
  float* ahead = nullptr;
  float* duals[kPairKinds] = {};
  float* limits[kPairKinds] = {};
  int* cuts[kLiftedCuts] = {};  // Labels at each threshold, `[y][x]`.
  int steps = 0;                // Layers of φ: labels − 1.
  float primal_step = 0, dual_step = 0;

  [[nodiscard]] __host__ __device__ int height() const { return cost.height; }
  [[nodiscard]] __host__ __device__ int width() const { return cost.width; }
  [[nodiscard]] __host__ __device__ long pixel(int y, int x) const {
    return static_cast<long>(y) * cost.width + x;
  }
  // Where layer 0 of a pixel is among the unknowns, and among the costs.
  [[nodiscard]] __host__ __device__ long unknown(int y, int x) const {
    return static_cast<long>(y) * steps * cost.width + x;
  }
  [[nodiscard]] __host__ __device__ long costs_of(int y, int x) const {
    return static_cast<long>(y) * cost.layers * cost.width + x;
  }
};

// Sums that a check of the gap needs: of a bound and of the energy of each cut.
constexpr int kLiftedSums = 1 + kLiftedCuts;

constexpr int kThreads = 128;
__constant__ const LiftedThresholds kThresholds = kLiftedThresholds;

// Adds up what the threads of a block have, by halves, into its part.
__device__ void store_part(double own, double* parts) {
  __shared__ double shared[kThreads];
  shared[threadIdx.x] = own;
  __syncthreads();
  for (int half = kThreads / 2; half > 0; half /= 2) {
    if (static_cast<int>(threadIdx.x) < half) shared[threadIdx.x] += shared[threadIdx.x + half];
    __syncthreads();
  }
  if (threadIdx.x == 0) parts[static_cast<long>(blockIdx.y) * gridDim.x + blockIdx.x] = shared[0];
  __syncthreads();
}

// Duals of one pair at one pixel, projected to the limit.
struct Limited {
  const float* duals;
  float limit;

  __device__ Limited(const LiftedFields& fields, int pair, int y, int x)
      : duals(fields.duals[pair] + fields.unknown(max(y, 0), max(x, 0))),
        limit(y < 0 || x < 0 ? 0.0F : fields.limits[pair][fields.pixel(y, x)]) {}
  [[nodiscard]] __device__ float operator()(long i) const {
    return fmaxf(fminf(duals[i], limit), -limit);
  }
};

// min_k [ρ_k − Σ_{l ≤ k} div p_l] of a pixel.
__device__ float bound_at(const LiftedFields& fields, int y, int x) {
  const Limited right(fields, 0, y, x), left(fields, 0, y, x - 1);
  const Limited down(fields, 1, y, x), upper(fields, 1, y - 1, x);
  const Limited across(fields, 2, y, x), falling(fields, 2, y - 1, x - 1);
  const Limited rising(fields, 3, y, x - 1), above(fields, 3, y - 1, x);
  const float* const cost = fields.cost.data + fields.costs_of(y, x);
  float least = cost[0], gathered = 0;
#pragma unroll 2
  for (int l = 0; l < fields.steps; ++l) {
    const long i = static_cast<long>(l) * fields.width();
    gathered += right(i) - left(i) + (down(i) - upper(i)) + (across(i) - falling(i)) +
                (rising(i) - above(i));
    least = fminf(least, cost[i + fields.width()] - gathered);
  }
  return least;
}

// The labels at each threshold, and the bound.
__global__ void cut_and_bound(LiftedFields fields, double* bounds) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  double own = 0;
  if (x < fields.width()) {
    int labels[kLiftedCuts] = {};
    const float* const phi = fields.phi + fields.unknown(y, x);
#pragma unroll 4
    for (int l = 0; l < fields.steps; ++l) {
      const float value = phi[static_cast<long>(l) * fields.width()];
#pragma unroll
      for (int k = 0; k < kLiftedCuts; ++k) labels[k] += value >= kThresholds.at[k] ? 1 : 0;
    }
#pragma unroll
    for (int k = 0; k < kLiftedCuts; ++k) {
      fields.cuts[k][fields.pixel(y, x)] = labels[k];
    }
    own = bound_at(fields, y, x);
  }
  store_part(own, bounds);
}

// The costs of a labeling's pixels and of the pairs that begin there.
__global__ void sum_energies(LiftedFields fields, double* sums) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  const int right = min(x + 1, fields.width() - 1), below = min(y + 1, fields.height() - 1);
  for (int k = 0; k < kLiftedCuts; ++k) {
    double own = 0;
    if (x < fields.width()) {
      const int* const labels = fields.cuts[k];
      const long at = fields.pixel(y, x);
      const int here = labels[at], beside = labels[fields.pixel(y, right)];
      const int down = labels[fields.pixel(below, x)];
      const int across = labels[fields.pixel(below, right)];
      const auto pair = [&](int kind, int from, int to) {
        return static_cast<double>(fields.limits[kind][at]) * abs(to - from);
      };
      own = pair(0, here, beside) + pair(1, here, down) + pair(2, here, across) +
            pair(3, beside, down) +
            static_cast<double>(
                fields.cost.data[fields.costs_of(y, x) + static_cast<long>(here) * fields.width()]);
    }
    store_part(own, sums + static_cast<long>(k) * gridDim.x * gridDim.y);
  }
}

dim3 grid_of(const LiftedFields& fields) {
  return {blocks_for(fields.width(), kThreads), static_cast<unsigned>(fields.height())};
}

// Parts that each of them is made of.
int lifted_parts(const LiftedFields& fields) {
  return static_cast<int>(grid_of(fields).x) * fields.height();
}

// Fills the cuts and the parts of the bound, which are to be added in their order;
void measure_bound(const LiftedFields& fields, double* parts, const DeviceStream& stream) {
  const auto values = static_cast<double>(fields.cost.size());
  launch(stream, {"lifted: bound", values * 24, values * 30},
         [&] { cut_and_bound<<<grid_of(fields), kThreads, 0, stream.get()>>>(fields, parts); });
}

// those of the energy of each cut, `[cut][part]`.
void measure_energies(const LiftedFields& fields, double* parts, const DeviceStream& stream) {
  const double pixels = static_cast<double>(fields.height()) * fields.width();
  launch(stream, {"lifted: energies", pixels * 40, pixels * 30},
         [&] { sum_energies<<<grid_of(fields), kThreads, 0, stream.get()>>>(fields, parts); });
}

// Of shared memory, what the columns of a block may take.
constexpr int kBlockBytes = 64 << 10;

// Duals at the pixels around one, of its layers; 0 beyond the border.
struct Around {
  const float* here[kPairKinds];
  const float* above[kPairKinds];
  bool has_left, has_above;

  __device__ Around(const LiftedFields& fields, int y, int x) : has_left(x > 0), has_above(y > 0) {
    for (int k = 0; k < kPairKinds; ++k) {
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

// Where the projection of a column is neither 1 nor 0; as Summits of layered_kernel.cpp.
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
    phi[i] = old + kOverRelaxation * (projected - old);
  }
}

__global__ void move_duals(LiftedFields fields) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y), width = fields.width();
  if (x >= width) return;
  const int right = x + 1 < width ? 1 : 0;
  const float* const ahead = fields.ahead + fields.unknown(y, x);
  const float* const below = fields.ahead + fields.unknown(min(y + 1, fields.height() - 1), x);
  float limits[kPairKinds];
  float* duals[kPairKinds];
  for (int k = 0; k < kPairKinds; ++k) {
    limits[k] = fields.limits[k][fields.pixel(y, x)];
    duals[k] = fields.duals[k] + fields.unknown(y, x);
  }
#pragma unroll 4
  for (int l = 0; l < fields.steps; ++l) {
    const long i = static_cast<long>(l) * width;
    const float at = ahead[i], beside = ahead[i + right];
    const float down = below[i], across = below[i + right];
    const float differences[kPairKinds] = {beside - at, down - at, across - at, down - beside};
#pragma unroll
    for (int k = 0; k < kPairKinds; ++k) {
      const float old = duals[k][i];
      const float next =
          fmaxf(fminf(old + fields.dual_step * differences[k], limits[k]), -limits[k]);
      duals[k][i] = old + kOverRelaxation * (next - old);
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
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  if (x >= fields.width()) return;
  const bool down = y + 1 < fields.height(), right = x + 1 < fields.width();
  const float along =
      kPairSide + kPairDiagonal * static_cast<float>((y == 0 ? 1 : 0) + (down ? 0 : 1));
  const float aside =
      kPairSide + kPairDiagonal * static_cast<float>((x == 0 ? 1 : 0) + (right ? 0 : 1));
  const long at = fields.pixel(y, x);
  const float here = weight * g[at];
  const float diagonal = right && down ? here * kPairDiagonal : 0.0F;
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

// The limits of the pairs' duals, as PairLimits has them.
void fill_limits(const LiftedFields& fields, const float* g, float weight,
                 const DeviceStream& stream) {
  const double pixels = static_cast<double>(fields.height()) * fields.width();
  launch(stream, {"lifted: limits", pixels * 20, pixels * 6}, [&] {
    limit<<<rows_of(fields, kThreads), kThreads, 0, stream.get()>>>(fields, g, weight);
  });
}

// φ becomes the step at the cheapest label, which is every cut; duals 0.
void start_lifting(const LiftedFields& fields, const DeviceStream& stream) {
  const auto values = static_cast<double>(fields.cost.size());
  launch(stream, {"lifted: start", values * 24, values * 2},
         [&] { start<<<rows_of(fields, kThreads), kThreads, 0, stream.get()>>>(fields); });
}

// One iteration: φ and `ahead`, then the duals.
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

class Lifting {
 public:
  Lifting(const LiftedTask& task, const Progress& progress);

  void iterate() { iterate_lifting(fields_, stream_); }
  // Renews energy, bound and labels of `result` if better ones are found.
  void measure(LiftedLabels& result);
  // The energies of the cuts as they are; likewise.
  void compare_cuts(LiftedLabels& result);
  void unload(LiftedLabels& result, const Progress& progress);

 private:
  // Adds the parts of a sum.
  [[nodiscard]] double total(int sum) const;
  void download_sums();

  DeviceStream stream_;
  LiftedFields fields_;
  std::size_t pixels_;
  DeviceArray<float> unknowns_, limits_;
  DeviceArray<int> labels_;  // Of each cut, then the best.
  DeviceArray<double> sums_;
  std::vector<double> host_sums_;
};

Lifting::Lifting(const LiftedTask& task, const Progress& progress) {
  fields_.cost = task.cost->view();
  fields_.steps = fields_.cost.layers - 1;
  pixels_ = static_cast<std::size_t>(fields_.height()) * fields_.width();
  const std::size_t size = pixels_ * fields_.steps;
  unknowns_ = DeviceArray<float>((2 + kPairKinds) * size, stream_);
  limits_ = DeviceArray<float>(kPairKinds * pixels_, stream_);
  labels_ = DeviceArray<int>((kLiftedCuts + 1) * pixels_, stream_);
  fields_.phi = unknowns_.data();
  fields_.ahead = unknowns_.data() + size;
  for (int k = 0; k < kPairKinds; ++k) {
    fields_.duals[k] = unknowns_.data() + (2 + k) * size;
    fields_.limits[k] = limits_.data() + k * pixels_;
  }
  for (int k = 0; k < kLiftedCuts; ++k) fields_.cuts[k] = labels_.data() + k * pixels_;
  // Each pixel is in 8 pairs, so |K|² ≤ 16; φ moves within [0, 1], the duals within about Λ.
  fields_.primal_step = static_cast<float>(1 / (4 * task.smoothness));
  fields_.dual_step = static_cast<float>(task.smoothness / 4);
  sums_ =
      DeviceArray<double>(static_cast<std::size_t>(kLiftedSums) * lifted_parts(fields_), stream_);
  host_sums_.resize(sums_.size());
  const auto g = upload(task.g.data, pixels_, stream_, progress);
  fill_limits(fields_, g.data(), static_cast<float>(task.smoothness), stream_);
  start_lifting(fields_, stream_);
}

void Lifting::download_sums() {
  check(cudaMemcpyAsync(host_sums_.data(), sums_.data(), sums_.byte_size(), cudaMemcpyDeviceToHost,
                        stream_.get()));
  stream_.wait();
}

double Lifting::total(int sum) const {
  const int parts = lifted_parts(fields_);
  const auto first = host_sums_.begin() + static_cast<std::ptrdiff_t>(sum) * parts;
  return std::accumulate(first, first + parts, 0.0);
}

void Lifting::measure(LiftedLabels& result) {
  measure_bound(fields_, sums_.data(), stream_);
  compare_cuts(result);
  result.bound = std::max(result.bound, total(0));
}

void Lifting::compare_cuts(LiftedLabels& result) {
  measure_energies(fields_, sums_.data() + lifted_parts(fields_), stream_);
  download_sums();
  for (int k = 0; k < kLiftedCuts; ++k) {
    const double energy = total(1 + k);
    if (energy >= result.energy) continue;
    result.energy = energy;
    check(cudaMemcpyAsync(labels_.data() + kLiftedCuts * pixels_, fields_.cuts[k],
                          pixels_ * sizeof(int), cudaMemcpyDeviceToDevice, stream_.get()));
  }
}

void Lifting::unload(LiftedLabels& result, const Progress& progress) {
  result.labels = Image<int>(fields_.height(), fields_.width());
  download_bytes(result.labels.data(), labels_.data() + kLiftedCuts * pixels_,
                 pixels_ * sizeof(int), stream_, progress);
}

double gap_of(const LiftedLabels& result) {
  const double gap = result.energy - result.bound;
  return gap == 0 ? 0 : gap / std::abs(result.energy);
}

}  // namespace

LiftedLabels solve_lifted(const LiftedTask& task, const std::function<void(int, double)>& report,
                          const Progress& progress) {
  Lifting lifting(task, progress);
  LiftedLabels result;
  result.energy = std::numeric_limits<double>::infinity();
  result.bound = -result.energy;
  if (task.smoothness == 0) {  // each pixel for itself
    lifting.compare_cuts(result);
    result.bound = result.energy;
    result.converged = true;
    lifting.unload(result, progress);
    return result;
  }
  for (bool is_last = false; !is_last;) {
    progress.check();
    lifting.iterate();
    ++result.iterations;
    is_last = result.iterations >= task.max_iterations || progress.finish_requested();
    if (!is_last && result.iterations % std::max(1, task.check_every) != 0) continue;
    lifting.measure(result);
    const double gap = gap_of(result);
    result.converged = gap <= task.gap;
    is_last = is_last || result.converged;
    report(result.iterations, gap);
  }
  lifting.unload(result, progress);
  return result;
}

}  // namespace episcope::cuda
