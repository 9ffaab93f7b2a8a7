// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/simplex/simplex_levels.cuh"

namespace episcope::cuda {
namespace {

constexpr int kThreads = 128;

struct Place {
  int problem, y, x;
  bool inside;
};

__device__ Place place_of(const SimplexFields& fields) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  return {static_cast<int>(blockIdx.z), static_cast<int>(blockIdx.y), x, x < fields.width};
}

dim3 blocks(const SimplexFields& fields) {
  return dim3(blocks_for(fields.width, kThreads), static_cast<unsigned>(fields.height),
              static_cast<unsigned>(fields.problems));
}

// Of the two or four values under a coarse one, `below` and `beside` the way to the next.
__device__ float halved(const float* from, long beside, long below) {
  if (beside == 0) return 0.5F * (from[0] + from[below]);
  return 0.25F * (from[0] + from[beside] + from[below] + from[below + beside]);
}

__global__ void halve(SimplexFields fine, SimplexFields coarse) {
  const auto [problem, y, x, inside] = place_of(coarse);
  if (!inside) return;
  const bool has_below = 2 * y + 1 < fine.height;
  const long beside = 2 * x + 1 < fine.width ? 1 : 0;
  coarse.weights[coarse.pixel(problem, y, x)] =
      halved(fine.weights + fine.pixel(problem, 2 * y, 2 * x), beside, has_below ? fine.width : 0);
  const long from = fine.unknown(problem, 2 * y, 2 * x), to = coarse.unknown(problem, y, x);
  for (int l = 0; l < fine.layers; ++l) {
    coarse.cost[to + static_cast<long>(l) * coarse.width] = halved(
        fine.cost + from + static_cast<long>(l) * fine.width, beside, has_below ? fine.row() : 0);
  }
}

__global__ void take_cheapest(SimplexFields fields) {
  const auto [problem, y, x, inside] = place_of(fields);
  if (!inside) return;
  const long first = fields.unknown(problem, y, x);
  int best = 0;
  for (int l = 1; l < fields.layers; ++l) {
    const long i = first + static_cast<long>(l) * fields.width;
    if (fields.cost[i] < fields.cost[first + static_cast<long>(best) * fields.width]) best = l;
  }
  for (int l = 0; l < fields.layers; ++l) {
    const long i = first + static_cast<long>(l) * fields.width;
    fields.u[i] = l == best ? 1.0F : 0.0F;
    for (float* const dual : fields.duals) dual[i] = 0;
  }
}

// Pairs that lead to the end within a coarse pixel: the flow between that which enters it and that
// which leaves.
__global__ void spread(SimplexFields coarse, SimplexFields fine) {
  const auto [problem, y, x, inside] = place_of(fine);
  if (!inside) return;
  const long from = coarse.unknown(problem, y / 2, x / 2), to = fine.unknown(problem, y, x);
  const bool has_left = x / 2 > 0, has_above = y / 2 > 0;
  for (int l = 0; l < fine.layers; ++l) {
    const long i = from + static_cast<long>(l) * coarse.width;
    const long o = to + static_cast<long>(l) * fine.width;
    const float right = coarse.duals[0][i], down = coarse.duals[1][i];
    const float left = x % 2 != 0 ? right : has_left ? coarse.duals[0][i - 1] : 0.0F;
    const float above = y % 2 != 0 ? down : has_above ? coarse.duals[1][i - coarse.row()] : 0.0F;
    fine.u[o] = coarse.u[i];
    fine.duals[0][o] = right + left;
    fine.duals[1][o] = down + above;
    fine.duals[2][o] = 2.0F * coarse.duals[2][i];
    fine.duals[3][o] = 2.0F * coarse.duals[3][i];
  }
}

__global__ void gather(SimplexFields from, const std::int32_t* places, SimplexFields to) {
  const auto [problem, y, x, inside] = place_of(to);
  if (!inside) return;
  const std::int32_t named = places[to.pixel(problem, y, x)];
  const int width = to.width;
  const long source =
      named < 0 ? from.unknown(problem, y, x) : from.unknown(problem, named / width, named % width);
  const long target = to.unknown(problem, y, x);
  for (int l = 0; l < to.layers; ++l) {
    const long layer = static_cast<long>(l) * width;
    to.u[target + layer] = from.u[source + layer];
    for (int k = 0; k < kSimplexPairs; ++k) {
      to.duals[k][target + layer] = from.duals[k][source + layer];
    }
  }
}

}  // namespace

void halve_problems(const SimplexFields& fine, const SimplexFields& coarse,
                    const DeviceStream& stream) {
  const auto values = static_cast<double>(fine.size());
  launch(stream, {"labels: halve", 5 * values, values},
         [&] { halve<<<blocks(coarse), kThreads, 0, stream.get()>>>(fine, coarse); });
}

void begin_from_cheapest(const SimplexFields& fields, const DeviceStream& stream) {
  const auto values = static_cast<double>(fields.size());
  launch(stream, {"labels: cheapest", 24 * values, values},
         [&] { take_cheapest<<<blocks(fields), kThreads, 0, stream.get()>>>(fields); });
}

void begin_from_coarse(const SimplexFields& coarse, const SimplexFields& fine,
                       const DeviceStream& stream) {
  const auto values = static_cast<double>(fine.size());
  launch(stream, {"labels: from coarse", 25 * values, 4 * values},
         [&] { spread<<<blocks(fine), kThreads, 0, stream.get()>>>(coarse, fine); });
}

void begin_from_moved(const SimplexFields& from, const std::int32_t* places,
                      const SimplexFields& to, const DeviceStream& stream) {
  const auto values = static_cast<double>(to.size());
  launch(stream, {"labels: from last view", 40 * values, 0},
         [&] { gather<<<blocks(to), kThreads, 0, stream.get()>>>(from, places, to); });
}

}  // namespace episcope::cuda
