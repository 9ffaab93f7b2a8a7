// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/simplex/simplex_race.cuh"

namespace episcope::cuda {
namespace {

constexpr int kThreads = 128;

__global__ void find_near(SimplexFields fields, const std::int32_t* labels, float behind,
                          SimplexRace race) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const auto y = static_cast<int>(blockIdx.y), problem = static_cast<int>(blockIdx.z);
  if (x >= fields.width) return;
  const float* const cost = fields.cost + fields.unknown(problem, y, x);
  float least = cost[0];
  for (int l = 1; l < fields.layers; ++l) {
    least = fminf(least, cost[static_cast<long>(l) * fields.width]);
  }
  const int label = labels[fields.pixel(problem, y, x)];
  std::uint8_t* const near =
      race.near + race.tile(problem, y / kRaceRows, x / kRaceColumns) * race.layers;
  for (int l = 0; l < fields.layers; ++l) {
    // All that write there write the same.
    if (l == label || cost[static_cast<long>(l) * fields.width] - least < behind) near[l] = 1;
  }
}

__device__ bool is_near(const SimplexRace& race, int problem, int first_row, int last_row,
                        int first_column, int last_column, int layer) {
  for (int row = max(first_row, 0); row <= min(last_row, race.down - 1); ++row) {
    for (int column = first_column; column <= min(last_column, race.across - 1); ++column) {
      if (race.near[race.tile(problem, row, column) * race.layers + layer] != 0) return true;
    }
  }
  return false;
}

// A thread for each tile.
__global__ void list_layers(SimplexRace race) {
  const int column = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const auto row = static_cast<int>(blockIdx.y), problem = static_cast<int>(blockIdx.z);
  if (column >= race.across) return;
  std::uint16_t* const moving =
      race.lists + race.list_begin(problem, row, column, SimplexRace::Moving);
  std::uint16_t* const paired =
      race.lists + race.list_begin(problem, row, column, SimplexRace::Paired);
  int moving_count = 0, paired_count = 0;
  for (int l = 0; l < race.layers; ++l) {
    // What moves in the tile, and in those to the right and below.
    if (is_near(race, problem, row - 1, row + 1, column, column, l)) {
      moving[++moving_count] = static_cast<std::uint16_t>(l);
    }
    if (is_near(race, problem, row - 1, row + 2, column, column + 1, l)) {
      paired[++paired_count] = static_cast<std::uint16_t>(l);
    }
  }
  moving[0] = static_cast<std::uint16_t>(moving_count);
  paired[0] = static_cast<std::uint16_t>(paired_count);
}

__global__ void clear_others(SimplexFields fields, SimplexRace race) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const auto y = static_cast<int>(blockIdx.y), problem = static_cast<int>(blockIdx.z);
  if (x >= fields.width) return;
  const std::uint16_t* const moving = race.list(problem, y, x, SimplexRace::Moving);
  const std::uint16_t* const paired = race.list(problem, y, x, SimplexRace::Paired);
  int next_moving = 1, next_paired = 1;
  for (int l = 0; l < fields.layers; ++l) {
    const long i = fields.unknown(problem, y, x) + static_cast<long>(l) * fields.width;
    fields.ahead[i] = 0;
    if (next_moving <= moving[0] && moving[next_moving] == l) {
      ++next_moving;
    } else {
      fields.u[i] = 0;
    }
    if (next_paired <= paired[0] && paired[next_paired] == l) {
      ++next_paired;
      continue;
    }
    for (float* const dual : fields.duals) dual[i] = 0;
  }
}

__global__ void take_labels(SimplexFields fields, const std::int32_t* labels,
                            const std::int32_t* places, std::int32_t* moved) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const auto y = static_cast<int>(blockIdx.y), problem = static_cast<int>(blockIdx.z);
  if (x >= fields.width) return;
  const long at = fields.pixel(problem, y, x);
  moved[at] = places[at] < 0 ? labels[at] : labels[fields.pixel(problem, 0, 0) + places[at]];
}

dim3 blocks(const SimplexFields& fields) {
  return dim3(blocks_for(fields.width, kThreads), static_cast<unsigned>(fields.height),
              static_cast<unsigned>(fields.problems));
}

}  // namespace

SimplexRaceMemory::SimplexRaceMemory(const SimplexFields& fields, const DeviceStream& stream) {
  race_.across = static_cast<int>(blocks_for(fields.width, kRaceColumns));
  race_.down = static_cast<int>(blocks_for(fields.height, kRaceRows));
  race_.layers = fields.layers;
  const auto tiles = static_cast<std::size_t>(race_.tile(fields.problems, 0, 0));
  near_ = {tiles * static_cast<std::size_t>(fields.layers), stream};
  lists_ = {tiles * SimplexRace::Kinds * (static_cast<std::size_t>(fields.layers) + 1), stream};
  race_.near = near_.data();
  race_.lists = lists_.data();
}

void SimplexRaceMemory::choose(const SimplexFields& fields, const std::int32_t* labels,
                               float behind, const DeviceStream& stream) {
  const auto values = static_cast<double>(fields.size());
  near_.clear();
  launch(stream, {"labels: near ones", 8 * values, 2 * values}, [&] {
    find_near<<<blocks(fields), kThreads, 0, stream.get()>>>(fields, labels, behind, race_);
  });
  const dim3 tiles(blocks_for(race_.across, kThreads), static_cast<unsigned>(race_.down),
                   static_cast<unsigned>(fields.problems));
  launch(stream, {"labels: lists of near ones", static_cast<double>(near_.size()), 0},
         [&] { list_layers<<<tiles, kThreads, 0, stream.get()>>>(race_); });
  launch(stream, {"labels: leave out far ones", 24 * values, 0},
         [&] { clear_others<<<blocks(fields), kThreads, 0, stream.get()>>>(fields, race_); });
}

void move_labels(const SimplexFields& fields, const std::int32_t* labels,
                 const std::int32_t* places, std::int32_t* moved, const DeviceStream& stream) {
  const double pixels = static_cast<double>(fields.pixels()) * fields.problems;
  launch(stream, {"labels: of last view", 12 * pixels, 0}, [&] {
    take_labels<<<blocks(fields), kThreads, 0, stream.get()>>>(fields, labels, places, moved);
  });
}

}  // namespace episcope::cuda
