// SPDX-License-Identifier: BSD-3-Clause
// Multigrid, down one level: RelaxFromZero, RelaxColour and Restrict of tv_l2_steps.cuh on tiles in
// shared memory.
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/tv_l2/tv_l2_iteration.cuh"

namespace episcope::cuda {
namespace {

constexpr int kTilePlaces = 32, kTileRows = 16;
constexpr int kHaloPlaces = 2, kHaloRows = 2;
constexpr int kPlaces = kTilePlaces + 2 * kHaloPlaces;
constexpr int kRows = kTileRows + 2 * kHaloRows;
constexpr int kThreads = 256;
constexpr int kEach = (kPlaces * kRows + kThreads - 1) / kThreads;
constexpr int kPlane = kRows * 2 * kPlaces;

struct Tile {
  float u[kPlane], rx[kPlane], ry[kPlane], b[kPlane], inverse[kPlane];
};

// One place of the tile, halo included.
struct Place {
  int y = 0, i = 0, row = 0, place = 0;
  bool exists = false, is_inside = false, is_core = false, is_inner = false;

  __device__ Place(const TvL2Level& level, int number) {
    const int at = static_cast<int>(threadIdx.x) + number * kThreads;
    y = at / kPlaces;
    i = at % kPlaces;
    row = static_cast<int>(blockIdx.y) * kTileRows + y - kHaloRows;
    place = static_cast<int>(blockIdx.x) * kTilePlaces + i - kHaloPlaces;
    exists = at < kPlaces * kRows;
    is_inside = exists && row >= 0 && row < level.height && place >= 0 && place < level.half();
    is_inner = exists && y > 0 && y + 1 < kRows && i > 0 && i + 1 < kPlaces;
    is_core = is_inside && y >= kHaloRows && y < kHaloRows + kTileRows && i >= kHaloPlaces &&
              i < kHaloPlaces + kTilePlaces;
  }
  [[nodiscard]] __device__ int at(int half) const { return (y * 2 + half) * kPlaces + i; }
  [[nodiscard]] __device__ int left(int half) const { return half == 0 ? at(1) - 1 : at(0); }
};

// Σ penalty·(neighbour − here).
__device__ float pull(const Tile& tile, int at, int left, float here) {
  constexpr int kRow = 2 * kPlaces;
  return tile.rx[at] * (tile.u[left + 1] - here) + tile.rx[left] * (tile.u[left] - here) +
         tile.ry[at] * (tile.u[at + kRow] - here) + tile.ry[at - kRow] * (tile.u[at - kRow] - here);
}

// Reads the tile, and relaxes colour 0 from 0; colour 1 begins at 0.
__device__ void load(const TvL2Level& level, int view, Tile& tile) {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place place(level, k);
    if (!place.exists) continue;
#pragma unroll
    for (int half = 0; half < 2; ++half) {
      const long from = place.row * level.pitch + half * level.odd + place.place;
      const auto read = [&](TvL2Plane which) {
        return place.is_inside ? level.of(which, view)[from] : 0.0F;
      };
      const int at = place.at(half);
      tile.rx[at] = read(TvL2Plane::Rx);
      tile.ry[at] = read(TvL2Plane::Ry);
      tile.b[at] = read(TvL2Plane::B);
      tile.inverse[at] = read(TvL2Plane::Inverse);
      tile.u[at] = ((place.row + half) & 1) == 0 ? tile.b[at] * tile.inverse[at] : 0.0F;
    }
  }
  __syncthreads();
}

__device__ void relax_odd(const TvL2Level& level, Tile& tile) {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place place(level, k);
    if (!place.is_inner) continue;
    const int half = (place.row + 1) & 1, at = place.at(half);
    tile.u[at] = (tile.b[at] + pull(tile, at, place.left(half), 0)) * tile.inverse[at];
  }
  __syncthreads();
}

// Stores u, and the residual of colour 0 in place of its b.
__device__ void store(const TvL2Level& level, int view, Tile& tile) {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place place(level, k);
    if (!place.is_core) continue;
    const int half = place.row & 1, at = place.at(half);
    const long to = place.row * level.pitch + place.place;
    const float here = tile.u[at];
    const float c = level.of(TvL2Plane::C, view)[to + half * level.odd];
    tile.b[at] += pull(tile, at, place.left(half), here) - level.data_scale * c * here;
    float* const u = level.of(TvL2Plane::U, view);
    u[to] = tile.u[place.at(0)];
    u[to + level.odd] = tile.u[place.at(1)];
  }
  __syncthreads();
}

__global__ void __launch_bounds__(kThreads)
    descend_tiles(TvL2Level level, TvL2Level coarse, const TvL2View* views) {
  __shared__ Tile tile;
  const int view = static_cast<int>(blockIdx.z);
  if (views[view].is_active == 0) return;
  load(level, view, tile);
  relax_odd(level, tile);
  store(level, view, tile);
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place place(level, k);
    if (!place.is_core || (place.row & 1) != 0) continue;
    float sum = tile.b[place.at(0)];
    if (place.row + 1 < level.height) sum += tile.b[place.at(1) + 2 * kPlaces];
    coarse.of(TvL2Plane::B, view)[coarse.at(place.row >> 1, place.place)] = sum;
  }
}

}  // namespace

void descend_level(const DeviceStream& stream, const TvL2Level& level, const TvL2Level& coarse,
                   int views, const TvL2View* of_views) {
  const dim3 grid(blocks_for(level.half(), kTilePlaces), blocks_for(level.height, kTileRows),
                  static_cast<unsigned>(views));
  const double places = static_cast<double>(level.height) * level.half() * views;
  launch(stream, {"tv_l2: descent", places * 11.5 * sizeof(float), places * 40},
         [&] { descend_tiles<<<grid, kThreads, 0, stream.get()>>>(level, coarse, of_views); });
}

}  // namespace episcope::cuda
