// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/simplex/simplex_column.cuh"
#include "engine/cuda/simplex/simplex_moves.cuh"

namespace episcope::cuda {
namespace {

constexpr float kRelaxation = 1.9F;
constexpr int kThreads = 128;

// Duals at a pixel and before it, of its layers.
struct Around {
  const float* here[kSimplexPairs];
  bool has_left, has_above;
  long row;

  __device__ Around(const SimplexFields& fields, long at, int y, int x)
      : has_left(x > 0), has_above(y > 0), row(fields.row()) {
    for (int k = 0; k < kSimplexPairs; ++k) here[k] = fields.duals[k] + at;
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
    u[i] = old + kRelaxation * (projected - old);
  }
}

__device__ inline void move_dual(float* dual, float step, float limit) {
  const float old = *dual;
  const float next = fminf(fmaxf(old + step, -limit), limit);
  *dual = old + kRelaxation * (next - old);
}

template <bool kRaces>
__global__ void move_duals(SimplexFields fields, SolvedMask solved, SimplexRace race) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const auto y = static_cast<int>(blockIdx.y), problem = static_cast<int>(blockIdx.z);
  if (x >= fields.width || (solved >> problem & 1U) != 0) return;
  const SimplexLimits limits(fields, problem, y, x);
  const long first = fields.unknown(problem, y, x);
  // Where there is no neighbour the limit is 0.
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
