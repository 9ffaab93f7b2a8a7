// SPDX-License-Identifier: BSD-3-Clause
// The steps of tv_l2_steps.cuh on tiles in shared memory: a step needs its neighbours' results, so
// a tile computes some of what belongs to its neighbours too, instead of all going through memory
// after each step. All pixels at once, for few of them; see tv_l2_strips.cu.
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/tv_l2/tv_l2_iteration.cuh"
#include "engine/cuda/tv_l2/tv_l2_steps.cuh"
#include "engine/cuda/tv_l2/tv_l2_tile_shape.cuh"

namespace episcope::cuda {
namespace {

using Shape = TvL2TileShape<32, 30, 3, 5, 768>;
constexpr int kThreads = Shape::kThreads, kEach = Shape::kEach;
constexpr int kOdd = Shape::kOdd, kRow = Shape::kRow, kPlane = Shape::kPlane;
constexpr int kSharedPlanes = 5;

// How many pixels around the tile a step computes, for those after it to have their neighbours.
constexpr int kReadReach = 5;
constexpr int kReachOfRelaxed1 = 4, kReachOfRelaxed0 = 3;  // before the dual
constexpr int kReachOfDual = 3, kReachOfB = 2;
constexpr int kReachOfLast0 = 2, kReachOfLast1 = 1;

// A place of a tile: two pixels, the even one first.
struct Pair {
  float of[2] = {0, 0};
};

// Where one of a thread's places lies, found once.
struct Place {
  int at = 0;              // of its even pixel in a plane of the tile
  int from = 0;            // in a plane of a view
  int cell = 0;            // of its pixels in a plane of the coarse level
  int reach = 0;           // pixels beside the tile; kReadReach + 1 where there is no place
  bool is_inside = false;  // in the level
  bool is_odd = false;     // its row
  bool has_below = false;  // in the level
  int from_right = 0;      // pixels of the level from its even pixel on, but for that

  [[nodiscard]] __device__ bool exists() const { return reach <= kReadReach; }
  // Of the tile itself.
  [[nodiscard]] __device__ bool is_core() const { return reach == 0 && is_inside; }
};

__device__ Place place_of(const TvL2Level& level, const TvL2Level& coarse, int number) {
  const TvL2TilePlace place = Shape::place(level, number);
  Place result;
  result.at = place.y * kRow + place.i;
  result.from = place.row * static_cast<int>(level.pitch) + place.place;
  result.cell = static_cast<int>(coarse.at(place.row >> 1, place.place));
  result.reach =
      place.exists ? max(Shape::rows_beside(place), Shape::pixels_beside(place)) : kReadReach + 1;
  result.is_inside = place.is_inside;
  result.is_odd = (place.row & 1) != 0;
  result.has_below = place.row + 1 < level.height;
  result.from_right = level.width - 1 - 2 * place.place;
  return result;
}

class Tile {
 public:
  __device__ Tile(const TvL2Level& level, const TvL2Level& coarse, int view, float* shared)
      : level_(level),
        view_(view),
        u_(shared),
        rx_(shared + kPlane),
        ry_(shared + 2 * kPlane),
        qx_(shared + 3 * kPlane),
        qy_(shared + 4 * kPlane) {
#pragma unroll
    for (int k = 0; k < kEach; ++k) places_[k] = place_of(level, coarse, k);
  }

  // Reads the tile; colour 0 with the correction of its cell.
  __device__ void load(const TvL2Level& coarse, bool is_first);
  __device__ void invert_diagonal();
  // Relaxes one colour from b as it is.
  __device__ void relax(int colour, int reach);
  __device__ void move_dual(float relaxation);
  __device__ void renew();
  __device__ void store(const TvL2Level& coarse);

 private:
  // What no block writes meanwhile.
  [[nodiscard]] __device__ Pair read(TvL2Plane which, const Place& place) const {
    if (!place.is_inside) return {};
    const float* const from = level_.of(which, view_) + place.from;
    return {{__ldg(from), __ldg(from + level_.odd)}};
  }
  __device__ void write(int moved, const Place& place, const Pair& values) const {
    float* const to = level_.second(moved, view_) + place.from;
    to[0] = values.of[0];
    to[level_.odd] = values.of[1];
  }
  // The penalty of a pixel's edges: what is stored of that below in the last column, else of that
  // to the right.
  [[nodiscard]] __device__ float read_penalty(const Place& place, int half) const {
    if (!place.is_inside) return 0;
    const float* const from =
        place.from_right > half ? level_.of(TvL2Plane::Rx, view_) : level_.of(TvL2Plane::Ry, view_);
    return __ldg(from + place.from + half * level_.odd);
  }
  // Σ penalty·neighbour, and with the pixel itself as `here` Σ penalty·(neighbour − here).
  [[nodiscard]] __device__ float pull(int at, int left, float here) const {
    return rx_[at] * (u_[left + 1] - here) + rx_[left] * (u_[left] - here) +
           ry_[at] * (u_[at + kRow] - here) + ry_[at - kRow] * (u_[at - kRow] - here);
  }
  [[nodiscard]] __device__ static int left_of(const Place& place, int half) {
    return half == 0 ? place.at + kOdd - 1 : place.at;
  }

  const TvL2Level& level_;
  int view_;
  float *u_, *rx_, *ry_, *qx_, *qy_;
  Place places_[kEach];
  Pair b_[kEach], inverse_[kEach];
};

__device__ void Tile::load(const TvL2Level& coarse, bool is_first) {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place& place = places_[k];
    if (!place.exists()) continue;
    Pair u = read(TvL2Plane::U, place);
    if (!is_first) {
      if (place.reach <= kReachOfRelaxed1) b_[k] = read(TvL2Plane::B, place);
      if (place.is_inside) {
        const float cell = __ldg(coarse.of(TvL2Plane::U, view_) + place.cell);
        place.is_odd ? u.of[1] += cell : u.of[0] += cell;
      }
    }
#pragma unroll
    for (int half = 0; half < 2; ++half) {
      const int at = place.at + half * kOdd;
      u_[at] = u.of[half];
      const float penalty = read_penalty(place, half);
      rx_[at] = place.from_right > half ? penalty : 0.0F;
      ry_[at] = place.has_below ? penalty : 0.0F;
    }
  }
  __syncthreads();
}

__device__ void Tile::invert_diagonal() {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place& place = places_[k];
    if (place.reach > kReachOfRelaxed1) continue;
    const Pair c = read(TvL2Plane::C, place);
#pragma unroll
    for (int half = 0; half < 2; ++half) {
      const int at = place.at + half * kOdd;
      const float edges = rx_[at] + rx_[left_of(place, half)] + ry_[at] + ry_[at - kRow];
      const float own = level_.data_scale * c.of[half];
      inverse_[k].of[half] = own > 0 ? 1 / (own + edges) : 0.0F;
    }
  }
}

__device__ void Tile::relax(int colour, int reach) {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place& place = places_[k];
    if (place.reach > reach) continue;
    const int half = place.is_odd ? 1 - colour : colour;
    const int at = place.at + half * kOdd;
    const float b = half == 0 ? b_[k].of[0] : b_[k].of[1];
    const float inverse = half == 0 ? inverse_[k].of[0] : inverse_[k].of[1];
    u_[at] = (b + pull(at, left_of(place, half), 0)) * inverse;
  }
  __syncthreads();
}

// z ← p + relaxed step along the gradient; 2p − z is kept for `renew`.
__device__ void Tile::move_dual(float relaxation) {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place& place = places_[k];
    if (place.reach > kReachOfDual) continue;
    Pair zx = read(TvL2Plane::Zx, place), zy = read(TvL2Plane::Zy, place);
    const Pair g = read(TvL2Plane::G, place);
#pragma unroll
    for (int half = 0; half < 2; ++half) {
      const int at = place.at + half * kOdd;
      const int right = half == 0 ? place.at + kOdd : place.at + 1;
      const float along = u_[right] - u_[at];
      const float down = u_[at + kRow] - u_[at];
      const float stay = 1 - relaxation * (1 - shrinkage(zx.of[half], zy.of[half], g.of[half]));
      zx.of[half] = zx.of[half] * stay + relaxation * rx_[at] * along;
      zy.of[half] = zy.of[half] * stay + relaxation * ry_[at] * down;
      const float mirror = 2 * shrinkage(zx.of[half], zy.of[half], g.of[half]) - 1;
      qx_[at] = zx.of[half] * mirror;
      qy_[at] = zy.of[half] * mirror;
    }
    if (!place.is_core()) continue;
    write(1, place, zx);
    write(2, place, zy);
  }
  __syncthreads();
}

// b ← c·f + div(2p − z).
__device__ void Tile::renew() {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place& place = places_[k];
    if (place.reach > kReachOfB) continue;
    b_[k] = read(TvL2Plane::Cf, place);
#pragma unroll
    for (int half = 0; half < 2; ++half) {
      const int at = place.at + half * kOdd;
      b_[k].of[half] += (qx_[at] - qx_[left_of(place, half)]) + (qy_[at] - qy_[at - kRow]);
    }
    if (place.is_core()) write(3, place, b_[k]);
  }
}

// Stores u, and the residual of colour 0 of cells of 2×2; colour 1, relaxed last, has none.
__device__ void Tile::store(const TvL2Level& coarse) {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place& place = places_[k];
    if (place.reach > 0) continue;
    const int half = place.is_odd ? 1 : 0;
    const int at = place.at + half * kOdd;
    const float here = u_[at];
    const Pair c = read(TvL2Plane::C, place);
    const float own = level_.data_scale * (half == 0 ? c.of[0] : c.of[1]) * here;
    qx_[at] = (half == 0 ? b_[k].of[0] : b_[k].of[1]) - own + pull(at, left_of(place, half), here);
    if (place.is_inside) write(0, place, {{u_[place.at], u_[place.at + kOdd]}});
  }
  __syncthreads();
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place& place = places_[k];
    if (!place.is_core() || place.is_odd) continue;
    float sum = qx_[place.at];
    if (place.has_below) sum += qx_[place.at + kRow + kOdd];
    coarse.of(TvL2Plane::B, view_)[place.cell] = sum;
  }
}

// A view that is done keeps its u.
__device__ void keep(const TvL2Level& level, const TvL2Level& coarse, int view) {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place place = place_of(level, coarse, k);
    if (!place.is_core()) continue;
    const float* const from = level.of(TvL2Plane::U, view) + place.from;
    float* const to = level.second(0, view) + place.from;
    to[0] = from[0];
    to[level.odd] = from[level.odd];
  }
}

__global__ void __launch_bounds__(kThreads, 2)
    iterate_tiles(const __grid_constant__ TvL2Level level, const __grid_constant__ TvL2Level coarse,
                  const TvL2View* views, bool is_first) {
  extern __shared__ float shared[];
  const int view = static_cast<int>(blockIdx.z);
  if (views[view].is_active == 0) return keep(level, coarse, view);
  Tile tile(level, coarse, view, shared);
  tile.load(coarse, is_first);
  tile.invert_diagonal();
  if (!is_first) {
    tile.relax(1, kReachOfRelaxed1);
    tile.relax(0, kReachOfRelaxed0);
  }
  tile.move_dual(views[view].relaxation);
  tile.renew();
  tile.relax(0, kReachOfLast0);
  tile.relax(1, kReachOfLast1);
  tile.store(coarse);
}

}  // namespace

void iterate_by_tiles(const DeviceStream& stream, const TvL2Level& level, const TvL2Level& coarse,
                      int views, const TvL2View* of_views, bool is_first) {
  constexpr int kBytes = kSharedPlanes * kPlane * static_cast<int>(sizeof(float));
  check(cudaFuncSetAttribute(iterate_tiles, cudaFuncAttributeMaxDynamicSharedMemorySize, kBytes));
  const double places = static_cast<double>(level.height) * level.half() * views;
  launch(stream, {"tv_l2: iteration by tiles", places * 24 * sizeof(float), places * 220}, [&] {
    iterate_tiles<<<Shape::blocks(level, views), kThreads, kBytes, stream.get()>>>(
        level, coarse, of_views, is_first);
  });
}

}  // namespace episcope::cuda
