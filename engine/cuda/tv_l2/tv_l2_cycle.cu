// SPDX-License-Identifier: BSD-3-Clause
// Multigrid, down and up one level: the steps of tv_l2_steps.cuh on tiles in shared memory.
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/tv_l2/tv_l2_iteration.cuh"
#include "engine/cuda/tv_l2/tv_l2_tile_shape.cuh"

namespace episcope::cuda {
namespace {

// The last step of a tile needs two pixels around it.
using Shape = TvL2TileShape<32, 16, 1, 2, 352>;
constexpr int kThreads = Shape::kThreads, kEach = Shape::kEach;
constexpr int kOdd = Shape::kOdd, kRow = Shape::kRow, kPlane = Shape::kPlane;

struct Shared {
  float u[kPlane], rx[kPlane], ry[kPlane], residual[kPlane];
};

// Where one of a thread's places lies, two pixels, found once; arrays are by colour.
struct Place {
  int at[2] = {0, 0};    // in a plane of the tile
  int left[2] = {0, 0};  // of the pixel to the left there; that to the right is the next one
  int from[2] = {0, 0};  // in a plane of a view
  int cell = 0;          // in a plane of the coarse level
  bool exists = false, is_inside = false, is_core = false;
  bool is_inner = false;   // the rows above and below belong to the tile
  bool is_even = false;    // its row
  bool has_below = false;  // in the level
};

__device__ Place place_of(const TvL2Level& level, const TvL2Level& coarse, int number) {
  const TvL2TilePlace place = Shape::place(level, number);
  Place result;
#pragma unroll
  for (int colour = 0; colour < 2; ++colour) {
    const int half = (place.row + colour) & 1;
    result.at[colour] = place.y * kRow + half * kOdd + place.i;
    result.left[colour] = place.y * kRow + (half == 0 ? kOdd - 1 : 0) + place.i;
    result.from[colour] = place.row * static_cast<int>(level.pitch) +
                          half * static_cast<int>(level.odd) + place.place;
  }
  result.cell = static_cast<int>(coarse.at(place.row >> 1, place.place));
  result.exists = place.exists;
  result.is_inside = place.is_inside;
  result.is_core =
      place.is_inside && Shape::rows_beside(place) == 0 && Shape::pixels_beside(place) == 0;
  result.is_inner = place.exists && place.y > 0 && place.y + 1 < Shape::kRows;
  result.is_even = (place.row & 1) == 0;
  result.has_below = place.row + 1 < level.height;
  return result;
}

class Tile {
 public:
  __device__ Tile(const TvL2Level& level, const TvL2Level& coarse, int view, Shared& shared)
      : level_(level), coarse_(coarse), view_(view), shared_(shared) {
#pragma unroll
    for (int k = 0; k < kEach; ++k) places_[k] = place_of(level, coarse, k);
  }

  // Reads the tile and relaxes colour 0 from 0; colour 1 begins at 0.
  __device__ void load();
  // Adds the correction of the coarse cells to colour 0.
  __device__ void correct();
  __device__ void relax(int colour);
  __device__ void restrict_residual();
  __device__ void store() const;

 private:
  // What no block writes meanwhile.
  [[nodiscard]] __device__ float read(TvL2Plane which, const Place& place, int colour) const {
    return place.is_inside ? __ldg(level_.of(which, view_) + place.from[colour]) : 0.0F;
  }
  // Σ penalty·(neighbour − here).
  [[nodiscard]] __device__ float pull(const Place& place, int colour, float here) const {
    const int at = place.at[colour], left = place.left[colour];
    const float *const u = shared_.u, *const rx = shared_.rx, *const ry = shared_.ry;
    return rx[at] * (u[left + 1] - here) + rx[left] * (u[left] - here) +
           ry[at] * (u[at + kRow] - here) + ry[at - kRow] * (u[at - kRow] - here);
  }

  const TvL2Level &level_, &coarse_;
  int view_;
  Shared& shared_;
  Place places_[kEach];
  float b_[kEach][2], inverse_[kEach][2];  // of both colours
};

__device__ void Tile::load() {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place& place = places_[k];
    if (!place.exists) continue;
#pragma unroll
    for (int colour = 0; colour < 2; ++colour) {
      const int at = place.at[colour];
      shared_.rx[at] = read(TvL2Plane::Rx, place, colour);
      shared_.ry[at] = read(TvL2Plane::Ry, place, colour);
      b_[k][colour] = read(TvL2Plane::B, place, colour);
      inverse_[k][colour] = read(TvL2Plane::Inverse, place, colour);
      shared_.u[at] = colour == 0 ? b_[k][0] * inverse_[k][0] : 0.0F;
    }
  }
  __syncthreads();
}

// Of its own pixels, which nobody else looks at before the next step.
__device__ void Tile::correct() {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place& place = places_[k];
    if (place.is_inside)
      shared_.u[place.at[0]] += __ldg(coarse_.of(TvL2Plane::U, view_) + place.cell);
  }
  __syncthreads();
}

__device__ void Tile::relax(int colour) {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place& place = places_[k];
    if (!place.is_inner) continue;
    shared_.u[place.at[colour]] = (b_[k][colour] + pull(place, colour, 0)) * inverse_[k][colour];
  }
  __syncthreads();
}

// The residual of colour 0 of cells of 2×2; colour 1, relaxed last, has none.
__device__ void Tile::restrict_residual() {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place& place = places_[k];
    if (!place.is_core) continue;
    const float here = shared_.u[place.at[0]], c = read(TvL2Plane::C, place, 0);
    shared_.residual[place.at[0]] = b_[k][0] + pull(place, 0, here) - level_.data_scale * c * here;
  }
  __syncthreads();
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place& place = places_[k];
    if (!place.is_core || !place.is_even) continue;
    float sum = shared_.residual[place.at[0]];
    if (place.has_below) sum += shared_.residual[place.at[1] + kRow];
    coarse_.of(TvL2Plane::B, view_)[place.cell] = sum;
  }
}

__device__ void Tile::store() const {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place& place = places_[k];
    if (!place.is_core) continue;
#pragma unroll
    for (int colour = 0; colour < 2; ++colour) {
      level_.of(TvL2Plane::U, view_)[place.from[colour]] = shared_.u[place.at[colour]];
    }
  }
}

enum class Way { Down, Up };

// On the way down nothing but colour 0 is found that is needed on the way up, and that again from b
// alone.
template <Way kWay>
__global__ void __launch_bounds__(kThreads, 3)
    cycle_tiles(const __grid_constant__ TvL2Level level, const __grid_constant__ TvL2Level coarse,
                const TvL2View* views) {
  __shared__ Shared shared;
  const int view = static_cast<int>(blockIdx.z);
  if (views[view].is_active == 0) return;
  Tile tile(level, coarse, view, shared);
  tile.load();
  if constexpr (kWay == Way::Up) tile.correct();
  tile.relax(1);
  if constexpr (kWay == Way::Down) {
    tile.restrict_residual();
  } else {
    tile.relax(0);
    tile.store();
  }
}

template <Way kWay>
void run_tiles(const DeviceStream& stream, const TvL2Level& level, const TvL2Level& coarse,
               int views, const TvL2View* of_views) {
  const char* const name = kWay == Way::Down ? "tv_l2: descent" : "tv_l2: ascent";
  const double floats = kWay == Way::Down ? 9.5 : 10.5;
  const double places = static_cast<double>(level.height) * level.half() * views;
  launch(stream, {name, places * floats * sizeof(float), places * 40}, [&] {
    cycle_tiles<kWay>
        <<<Shape::blocks(level, views), kThreads, 0, stream.get()>>>(level, coarse, of_views);
  });
}

}  // namespace

void descend_level(const DeviceStream& stream, const TvL2Level& level, const TvL2Level& coarse,
                   int views, const TvL2View* of_views) {
  run_tiles<Way::Down>(stream, level, coarse, views, of_views);
}

void ascend_level(const DeviceStream& stream, const TvL2Level& level, const TvL2Level& coarse,
                  int views, const TvL2View* of_views) {
  run_tiles<Way::Up>(stream, level, coarse, views, of_views);
}

}  // namespace episcope::cuda
