// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/simplex_moves.cuh"

#include "engine/cuda/device.cuh"

namespace episcope::cuda {
namespace {

constexpr int kThreads = 128;
constexpr int kSums = 3;

// Projects u to what is allowed, into `ahead`, and reads labels off it.
__global__ void cut(SimplexFields fields, SolvedMask solved, std::int32_t* labels) {
  extern __shared__ float shared[];
  const int stride = static_cast<int>(blockDim.x), thread = static_cast<int>(threadIdx.x);
  const int x = static_cast<int>(blockIdx.x) * stride + thread, y = static_cast<int>(blockIdx.y);
  const auto problem = static_cast<int>(blockIdx.z);
  if (x >= fields.width || (solved >> problem & 1U) != 0) return;
  float* const values = shared + thread;
  const long first = fields.unknown(problem, y, x);
  float top = -1e30F;
  for (int l = 0; l < fields.layers; ++l) {
    const float value = fields.u[first + static_cast<long>(l) * fields.width];
    values[l * stride] = value;
    top = fmaxf(value, top);
  }
  const float theta = simplex_threshold(values, stride, fields.layers, top);
  float most = -1;
  int label = 0;
  for (int l = 0; l < fields.layers; ++l) {
    const float projected = fmaxf(values[l * stride] - theta, 0.0F);
    fields.ahead[first + static_cast<long>(l) * fields.width] = projected;
    if (projected > most) label = l;
    most = fmaxf(projected, most);
  }
  labels[fields.pixel(problem, y, x)] = label;
}

__device__ float clamped(float value, float limit) {
  return fminf(fmaxf(value, -limit), limit);
}

// Limits of all pairs that touch a pixel.
struct Limits {
  SimplexLimits here, left, above, corner;

  __device__ Limits(const SimplexFields& fields, int problem, int y, int x)
      : here(fields, problem, y, x),
        left(fields, problem, y, x - 1),
        above(fields, problem, y - 1, x),
        corner(fields, problem, y - 1, x - 1) {}
};

// The divergence with duals within their limits, at unknown i of pixel (y, x).
__device__ float limited_divergence(const SimplexFields& fields, const Limits& limits, long i,
                                    int y, int x) {
  const auto dual = [&](int k, const SimplexLimits& of, bool exists, long at) {
    return exists ? clamped(fields.duals[k][at], of.of[k]) : 0.0F;
  };
  const bool has_left = x > 0, has_above = y > 0;
  const long row = fields.row();
  return dual(0, limits.here, true, i) - dual(0, limits.left, has_left, i - 1) +
         (dual(1, limits.here, true, i) - dual(1, limits.above, has_above, i - row)) +
         (dual(2, limits.here, true, i) -
          dual(2, limits.corner, has_above && has_left, i - row - 1)) +
         (dual(3, limits.left, has_left, i - 1) - dual(3, limits.above, has_above, i - row));
}

// E of the pairs that begin at a pixel, as potts_jump.
__device__ double jumps(const SimplexFields& fields, const std::int32_t* labels,
                        const SimplexLimits& limits, long at, int y, int x) {
  const long right = x + 1 < fields.width ? 1 : 0, down = y + 1 < fields.height ? fields.width : 0;
  const std::int32_t here = labels[at], beside = labels[at + right];
  const std::int32_t below = labels[at + down], across = labels[at + right + down];
  const auto jump = [&](int k, std::int32_t from, std::int32_t to) {
    return from == to ? 0.0 : 2.0 * static_cast<double>(limits.of[k]);
  };
  return jump(0, here, beside) + jump(1, here, below) + jump(2, here, across) +
         jump(3, beside, below);
}

__device__ void sum_of_block(const double (&of_thread)[kSums], double* out) {
  __shared__ double sums[kSums][kThreads];
  const int thread = static_cast<int>(threadIdx.x);
  for (int k = 0; k < kSums; ++k) sums[k][thread] = of_thread[k];
  for (int half = kThreads / 2; half > 0; half /= 2) {
    __syncthreads();
    if (thread >= half) continue;
    for (int k = 0; k < kSums; ++k) sums[k][thread] += sums[k][thread + half];
  }
  if (thread != 0) return;
  for (int k = 0; k < kSums; ++k) out[k] = sums[k][0];
}

__global__ void sum_rows(SimplexFields fields, SolvedMask solved, const std::int32_t* labels,
                         double* partial) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const auto y = static_cast<int>(blockIdx.y), problem = static_cast<int>(blockIdx.z);
  if ((solved >> problem & 1U) != 0) return;
  double sums[kSums] = {};
  if (x < fields.width) {
    const Limits limits(fields, problem, y, x);
    const long first = fields.unknown(problem, y, x), at = fields.pixel(problem, y, x);
    const long right = x + 1 < fields.width ? 1 : 0;
    const long down = y + 1 < fields.height ? fields.row() : 0;
    float cheapest = INFINITY, relaxed = 0;
    for (int l = 0; l < fields.layers; ++l) {
      const long i = first + static_cast<long>(l) * fields.width;
      const float cost = fields.cost[i];
      cheapest = fminf(cheapest, cost - limited_divergence(fields, limits, i, y, x));
      const float here = fields.ahead[i], beside = fields.ahead[i + right];
      const float below = fields.ahead[i + down], across = fields.ahead[i + right + down];
      relaxed += cost * here + limits.here.of[0] * fabsf(beside - here) +
                 limits.here.of[1] * fabsf(below - here) +
                 limits.here.of[2] * fabsf(across - here) +
                 limits.here.of[3] * fabsf(below - beside);
    }
    sums[0] = static_cast<double>(cheapest);
    sums[1] = static_cast<double>(relaxed);
    sums[2] =
        static_cast<double>(fields.cost[first + static_cast<long>(labels[at]) * fields.width]) +
        jumps(fields, labels, limits.here, at, y, x);
  }
  const long block = (static_cast<long>(problem) * gridDim.y + y) * gridDim.x + blockIdx.x;
  sum_of_block(sums, partial + block * kSums);
}

__global__ void sum_problems(const double* partial, int blocks, SolvedMask solved,
                             SimplexMeasure* measures) {
  const auto problem = static_cast<int>(blockIdx.x);
  if ((solved >> problem & 1U) != 0) return;
  const double* const of_problem = partial + static_cast<long>(problem) * blocks * kSums;
  double sums[kSums] = {};
  for (int i = static_cast<int>(threadIdx.x); i < blocks; i += kThreads) {
    for (int k = 0; k < kSums; ++k) sums[k] += of_problem[static_cast<long>(i) * kSums + k];
  }
  double all[kSums];
  sum_of_block(sums, all);
  if (threadIdx.x == 0) measures[problem] = {all[0], all[1], all[2]};
}

dim3 blocks(const SimplexFields& fields, int threads) {
  return dim3(blocks_for(fields.width, threads), static_cast<unsigned>(fields.height),
              static_cast<unsigned>(fields.problems));
}

}  // namespace

std::size_t partial_sums(const SimplexFields& fields) {
  return static_cast<std::size_t>(kSums) * blocks_for(fields.width, kThreads) *
         static_cast<std::size_t>(fields.height) * static_cast<std::size_t>(fields.problems);
}

void read_labels(const SimplexFields& fields, SolvedMask solved, std::int32_t* labels,
                 const DeviceStream& stream) {
  const int threads = column_threads(fields.layers);
  const auto values = static_cast<double>(fields.size());
  launch(stream, {"labels: read off", 8 * values, 8 * values}, [&] {
    cut<<<blocks(fields, threads), static_cast<unsigned>(threads),
          sizeof(float) * static_cast<std::size_t>(fields.layers * threads), stream.get()>>>(
        fields, solved, labels);
  });
}

void measure_simplex(const SimplexFields& fields, SolvedMask solved, std::int32_t* labels,
                     double* partial, SimplexMeasure* measures, const DeviceStream& stream) {
  read_labels(fields, solved, labels, stream);
  const auto values = static_cast<double>(fields.size());
  launch(stream, {"labels: energy and bound", 24 * values, 40 * values}, [&] {
    sum_rows<<<blocks(fields, kThreads), kThreads, 0, stream.get()>>>(fields, solved, labels,
                                                                      partial);
  });
  const auto of_problem = static_cast<int>(blocks_for(fields.width, kThreads)) * fields.height;
  launch(stream, {"labels: sums", 24.0 * of_problem * fields.problems, 0}, [&] {
    sum_problems<<<static_cast<unsigned>(fields.problems), kThreads, 0, stream.get()>>>(
        partial, of_problem, solved, measures);
  });
}

namespace {

// Duals at a pixel and before it, of its layers.
struct Around {
  const float* here[kPairKinds];
  bool has_left, has_above;
  long row;

  __device__ Around(const SimplexFields& fields, long at, int y, int x)
      : has_left(x > 0), has_above(y > 0), row(fields.row()) {
    for (int k = 0; k < kPairKinds; ++k) here[k] = fields.duals[k] + at;
  }
  // What leaves the pixel less what enters it.
  [[nodiscard]] __device__ float divergence(long i) const {
    const float left = has_left ? here[0][i - 1] : 0.0F;
    const float rising = has_left ? here[3][i - 1] : 0.0F;
    const float upper = has_above ? here[1][i - row] : 0.0F;
    const float falling = has_above && has_left ? here[2][i - row - 1] : 0.0F;
    const float from_right = has_above ? here[3][i - row] : 0.0F;
    return here[0][i] - left + (here[1][i] - upper) + (here[2][i] - falling) +
           (rising - from_right);
  }
};

// All layers, or those of a list.
struct Layers {
  const std::uint16_t* list;
  int count;

  __device__ Layers(const SimplexFields& fields, const std::uint16_t* of_tile)
      : list(of_tile), count(of_tile != nullptr ? of_tile[0] : fields.layers) {}
  [[nodiscard]] __device__ long at(int k) const { return list != nullptr ? list[k + 1] : k; }
};

template <bool kRaces>
__global__ void move_primal(SimplexFields fields, SolvedMask solved, SimplexRace race) {
  extern __shared__ float shared[];
  const int stride = static_cast<int>(blockDim.x), thread = static_cast<int>(threadIdx.x);
  const int x = static_cast<int>(blockIdx.x) * stride + thread, y = static_cast<int>(blockIdx.y);
  const auto problem = static_cast<int>(blockIdx.z);
  if (x >= fields.width || (solved >> problem & 1U) != 0) return;
  float* const values = shared + thread;
  const long at = fields.unknown(problem, y, x);
  const float* const cost = fields.cost + at;
  float* const u = fields.u + at;
  float* const ahead = fields.ahead + at;
  const Around duals(fields, at, y, x);
  const Layers layers(fields, kRaces ? race.list(problem, y, x, SimplexRace::Moving) : nullptr);
  float top = -1e30F;
#pragma unroll 4
  for (int k = 0; k < layers.count; ++k) {
    const long i = layers.at(k) * fields.width;
    const float value = u[i] + fields.primal_step * (duals.divergence(i) - cost[i]);
    values[k * stride] = value;
    top = fmaxf(value, top);
  }
  const float theta = simplex_threshold(values, stride, layers.count, top);
#pragma unroll 4
  for (int k = 0; k < layers.count; ++k) {
    const long i = layers.at(k) * fields.width;
    const float projected = fmaxf(values[k * stride] - theta, 0.0F);
    const float old = u[i];
    ahead[i] = 2.0F * projected - old;
    u[i] = old + kOverRelaxation * (projected - old);
  }
}

__device__ inline void move_dual(float* dual, float step, float limit) {
  const float old = *dual;
  const float next = fminf(fmaxf(old + step, -limit), limit);
  *dual = old + kOverRelaxation * (next - old);
}

template <bool kRaces>
__global__ void move_duals(SimplexFields fields, SolvedMask solved, SimplexRace race) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const auto y = static_cast<int>(blockIdx.y), problem = static_cast<int>(blockIdx.z);
  if (x >= fields.width || (solved >> problem & 1U) != 0) return;
  const SimplexLimits limits(fields, problem, y, x);
  const long first = fields.unknown(problem, y, x);
  // Where there is no neighbor the limit is 0.
  const long right = x + 1 < fields.width ? 1 : 0;
  const long down = y + 1 < fields.height ? fields.row() : 0;
  const float step = fields.dual_step;
  const Layers layers(fields, kRaces ? race.list(problem, y, x, SimplexRace::Paired) : nullptr);
#pragma unroll 4
  for (int k = 0; k < layers.count; ++k) {
    const long i = first + layers.at(k) * fields.width;
    const float here = fields.ahead[i], beside = fields.ahead[i + right];
    const float below = fields.ahead[i + down], across = fields.ahead[i + right + down];
    move_dual(fields.duals[0] + i, step * (beside - here), limits.of[0]);
    move_dual(fields.duals[1] + i, step * (below - here), limits.of[1]);
    move_dual(fields.duals[2] + i, step * (across - here), limits.of[2]);
    move_dual(fields.duals[3] + i, step * (below - beside), limits.of[3]);
  }
}

}  // namespace

void move_simplex(const SimplexFields& fields, SolvedMask solved, const SimplexRace* race,
                  const DeviceStream& stream) {
  const int threads = column_threads(fields.layers);
  int open = 0;
  for (int problem = 0; problem < fields.problems; ++problem) {
    open += (solved >> problem & 1U) == 0 ? 1 : 0;
  }
  const double values = static_cast<double>(fields.size()) / fields.problems * open;
  const auto blocks = [&](int size) {
    return dim3(blocks_for(fields.width, size), static_cast<unsigned>(fields.height),
                static_cast<unsigned>(fields.problems));
  };
  const auto room = sizeof(float) * static_cast<std::size_t>(fields.layers * threads);
  const auto size = static_cast<unsigned>(threads);
  if (race != nullptr) {
    // How many layers race is known on the device alone.
    launch(stream, {"labels: regions, near ones", 0, 0}, [&] {
      move_primal<true><<<blocks(threads), size, room, stream.get()>>>(fields, solved, *race);
    });
    launch(stream, {"labels: boundaries, near ones", 0, 0}, [&] {
      move_duals<true><<<blocks(kThreads), kThreads, 0, stream.get()>>>(fields, solved, *race);
    });
    return;
  }
  launch(stream, {"labels: regions", 32 * values, 24 * values}, [&] {
    move_primal<false><<<blocks(threads), size, room, stream.get()>>>(fields, solved, {});
  });
  launch(stream, {"labels: boundaries", 36 * values, 32 * values}, [&] {
    move_duals<false><<<blocks(kThreads), kThreads, 0, stream.get()>>>(fields, solved, {});
  });
}

}  // namespace episcope::cuda
