// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/tv_l2_iteration.cuh"

#include "engine/cuda/device.cuh"
#include "engine/cuda/tv_l2_steps.cuh"

#include <algorithm>
#include <limits>

// The steps of tv_l2_steps.cuh, all of an iteration in one pass over the rows of a strip of
// columns: each step follows the one before it at the least distance that its neighbors allow, and
// rows in between stay in shared memory. On the level being solved all edges of a pixel have the
// same penalty, so that one plane and the borders of the image tell it.

namespace episcope::cuda {
namespace {

// A thread has a place of every row, two pixels; those beside the strip, and the rows above and
// below, are computed for the sake of the five pixels that results depend on.
constexpr int kStripThreads = 96;
constexpr int kHaloPlaces = 4, kHaloRows = 6;  // strips begin where sectors of memory do
constexpr int kStripPlaces = kStripThreads - 2 * kHaloPlaces;
constexpr int kLeastRows = 32;
constexpr int kRing = 8;  // rows in shared memory

// Rows behind the one that is read.
constexpr int kRelaxed1 = 1, kRelaxed0 = 2, kDual = 3, kLast1 = 4, kStored = 5;

// The even pixel first.
struct StripPair {
  float of[2] = {0, 0};
};

using Row = float[2][kStripThreads + 2];  // of both halves, beside which a place more
struct Shared {
  Row u[kRing], r[kRing], qx;
};

// What is read of a row when it enters, when its dual moves, and when it leaves.
struct Entering {
  StripPair u, r, b, c;
};
struct Moving {
  StripPair zx, zy, g, cf;
};

class Strip {
 public:
  __device__ Strip(const TvL2Level& level, const TvL2Level& coarse, int view, int rows,
                   Shared& shared)
      : level_(level),
        coarse_(coarse),
        view_(view),
        shared_(shared),
        lane_(static_cast<int>(threadIdx.x)),
        place_(static_cast<int>(blockIdx.x) * kStripPlaces + lane_ - kHaloPlaces),
        pitch_(static_cast<int>(level.pitch)),
        odd_(static_cast<int>(level.odd)),
        origin_(static_cast<int>(view * level.view) + place_),
        first_(static_cast<int>(blockIdx.y) * rows),
        end_(min(first_ + rows, level.height)),
        in_level_(place_ >= 0 && place_ < level.half()),
        in_strip_(in_level_ && lane_ >= kHaloPlaces && lane_ < kStripThreads - kHaloPlaces),
        right_{{2 * place_ + 1 < level.width ? 1.0F : 0.0F,
                2 * place_ + 2 < level.width ? 1.0F : 0.0F}} {}

  __device__ void iterate(float relaxation, bool is_first);
  // A view that is done keeps its u.
  __device__ void keep() const;

 private:
  template <int kOdd>
  __device__ void step(int t, float relaxation, bool is_first);
  __device__ void read_ahead(int t, bool is_first);
  __device__ void enter(int t);
  __device__ void invert_diagonal(int y);
  template <int kHalf>
  __device__ void relax(int y, float b, float inverse);
  __device__ void move_dual(int y, float relaxation);
  __device__ void renew(int y);
  template <int kHalf>
  __device__ void leave(int y, const StripPair& c);

  // What no block writes meanwhile.
  [[nodiscard]] __device__ StripPair read(TvL2Plane which, int y) const {
    if (!in_level_ || y < 0 || y >= level_.height) return {};
    const float* const from = level_.of(which, 0) + at(y);
    return {{__ldg(from), __ldg(from + odd_)}};
  }
  [[nodiscard]] __device__ StripPair read_penalties(int y) const;
  __device__ void write(int moved, int y, int half, float value) const {
    if (!in_strip_ || y < first_ || y >= end_) return;
    level_.second(moved, 0)[at(y) + half * odd_] = value;
  }
  // In a plane of all views: one sum for all planes.
  [[nodiscard]] __device__ int at(int y) const { return origin_ + y * pitch_; }
  [[nodiscard]] __device__ float below(int y) const { return y + 1 < level_.height ? 1.0F : 0.0F; }

  // A place of a row that is held, and what stands to the left and to the right of its pixels.
  [[nodiscard]] __device__ float& own(Row* rows, int y, int half) const {
    return rows[y & (kRing - 1)][half][lane_ + 1];
  }
  [[nodiscard]] __device__ float left(const Row& row, int half) const {
    return half == 0 ? row[1][lane_] : row[0][lane_ + 1];
  }
  [[nodiscard]] __device__ float right(const Row& row, int half) const {
    return half == 0 ? row[1][lane_ + 1] : row[0][lane_ + 2];
  }
  // Σ penalty·neighbor, and with the pixel itself as `here` Σ penalty·(neighbor − here).
  [[nodiscard]] __device__ float pull(int y, int half, float here) const {
    const Row &u = shared_.u[y & (kRing - 1)], &r = shared_.r[y & (kRing - 1)];
    const float beside =
        right_.of[half] * (right(u, half) - here) + below(y) * (own(shared_.u, y + 1, half) - here);
    return own(shared_.r, y, half) * beside + left(r, half) * (left(u, half) - here) +
           own(shared_.r, y - 1, half) * (own(shared_.u, y - 1, half) - here);
  }

  const TvL2Level &level_, &coarse_;
  int view_;
  Shared& shared_;
  int lane_, place_, pitch_, odd_;
  int origin_;  // of the place in row 0, in a plane of all views
  int first_, end_;
  bool in_level_, in_strip_;
  StripPair right_;  // 1 where there is a pixel to the right in the level

  // Of the rows to come next, and of those that are held: [0] is the one that was read last, or of
  // `renewed_` the one whose dual was moved last.
  Entering entering_;
  Moving moving_;
  StripPair c_of_leaving_;
  float cell_ = 0;
  StripPair b_[3], inverse_[5], renewed_[3];
  StripPair qy_above_;
  float residual_ = 0;
};

// The penalty of a pixel's edges: what is stored of that below in the last column, else of that to
// the right.
__device__ StripPair Strip::read_penalties(int y) const {
  if (!in_level_ || y < 0 || y >= level_.height) return {};
  const float* const rx = level_.of(TvL2Plane::Rx, 0);
  const float* const ry = level_.of(TvL2Plane::Ry, 0);
  return {{__ldg((right_.of[0] > 0 ? rx : ry) + at(y)),
           __ldg((right_.of[1] > 0 ? rx : ry) + at(y) + odd_)}};
}

// For step t.
__device__ void Strip::read_ahead(int t, bool is_first) {
  entering_.u = read(TvL2Plane::U, t);
  entering_.r = read_penalties(t);
  entering_.c = read(TvL2Plane::C, t);
  if (!is_first) {
    entering_.b = read(TvL2Plane::B, t);
    const bool has_cell = in_level_ && t >= 0 && t < level_.height;
    cell_ = has_cell ? __ldg(coarse_.of(TvL2Plane::U, view_) + coarse_.at(t >> 1, place_)) : 0.0F;
  }
  moving_ = {read(TvL2Plane::Zx, t - kDual), read(TvL2Plane::Zy, t - kDual),
             read(TvL2Plane::G, t - kDual), read(TvL2Plane::Cf, t - kDual)};
  c_of_leaving_ = read(TvL2Plane::C, t - kStored);
}

// Row t, color 0 with the correction of its cells.
__device__ void Strip::enter(int t) {
#pragma unroll
  for (int half = 0; half < 2; ++half) {
    own(shared_.u, t, half) = entering_.u.of[half] + ((t & 1) == half ? cell_ : 0.0F);
    own(shared_.r, t, half) = entering_.r.of[half];
  }
#pragma unroll
  for (int i = 2; i > 0; --i) b_[i] = b_[i - 1];
  b_[0] = entering_.b;
}

// Of row y, whose c stands in inverse_[1] until then.
__device__ void Strip::invert_diagonal(int y) {
  const Row& r = shared_.r[y & (kRing - 1)];
#pragma unroll
  for (int half = 0; half < 2; ++half) {
    const float c = level_.data_scale * inverse_[1].of[half];
    const float diagonal = c + own(shared_.r, y, half) * (right_.of[half] + below(y)) +
                           left(r, half) + own(shared_.r, y - 1, half);
    inverse_[1].of[half] = c > 0 ? 1 / diagonal : 0.0F;
  }
}

template <int kHalf>
__device__ void Strip::relax(int y, float b, float inverse) {
  own(shared_.u, y, kHalf) = (b + pull(y, kHalf, 0)) * inverse;
}

// z ← p + relaxed step along the gradient; 2p − z is kept for `renew`, across in shared memory and
// down in place of z.
__device__ void Strip::move_dual(int y, float relaxation) {
  const Row& u = shared_.u[y & (kRing - 1)];
#pragma unroll
  for (int half = 0; half < 2; ++half) {
    const float here = own(shared_.u, y, half), r = own(shared_.r, y, half);
    const float along = right_.of[half] * (right(u, half) - here);
    const float down = below(y) * (own(shared_.u, y + 1, half) - here);
    const float x = moving_.zx.of[half], d = moving_.zy.of[half], g = moving_.g.of[half];
    const float stay = 1 - relaxation * (1 - shrinkage(x, d, g));
    const float zx = x * stay + relaxation * r * along;
    const float zy = d * stay + relaxation * r * down;
    const float mirror = 2 * shrinkage(zx, zy, g) - 1;
    shared_.qx[half][lane_ + 1] = zx * mirror;
    moving_.zy.of[half] = zy * mirror;
    write(1, y, half, zx);
    write(2, y, half, zy);
  }
}

// b ← c·f + div(2p − z).
__device__ void Strip::renew(int y) {
  StripPair b = moving_.cf;
#pragma unroll
  for (int half = 0; half < 2; ++half) {
    const float qy = moving_.zy.of[half];
    b.of[half] +=
        (shared_.qx[half][lane_ + 1] - left(shared_.qx, half)) + (qy - qy_above_.of[half]);
    qy_above_.of[half] = qy;
    write(3, y, half, b.of[half]);
  }
  renewed_[2] = renewed_[1];
  renewed_[1] = renewed_[0];
  renewed_[0] = b;
}

// Stores u, and the residual of color 0, half kHalf, of cells of 2×2; color 1, relaxed last, has
// none.
template <int kHalf>
__device__ void Strip::leave(int y, const StripPair& c) {
  for (int half = 0; half < 2; ++half) write(0, y, half, own(shared_.u, y, half));
  const float here = own(shared_.u, y, kHalf);
  const float own_pull = level_.data_scale * c.of[kHalf] * here;
  const float residual = renewed_[2].of[kHalf] - own_pull + pull(y, kHalf, here);
  residual_ = kHalf == 0 ? residual : residual_ + residual;
  const bool is_whole = kHalf == 1 || y + 1 == level_.height;
  if (!in_strip_ || !is_whole || y < first_ || y >= end_) return;
  coarse_.of(TvL2Plane::B, view_)[coarse_.at(y >> 1, place_)] = residual_;
}

// Row t enters; rows behind it are at their steps. kOdd: t is odd.
template <int kOdd>
__device__ void Strip::step(int t, float relaxation, bool is_first) {
  constexpr int kOther = 1 - kOdd;
  enter(t);
#pragma unroll
  for (int i = 4; i > 0; --i) inverse_[i] = inverse_[i - 1];
  inverse_[0] = entering_.c;
  __syncthreads();
  invert_diagonal(t - kRelaxed1);
  if (!is_first) {
    relax<kOdd>(t - kRelaxed1, b_[kRelaxed1].of[kOdd], inverse_[kRelaxed1].of[kOdd]);
    __syncthreads();
    relax<kOdd>(t - kRelaxed0, b_[kRelaxed0].of[kOdd], inverse_[kRelaxed0].of[kOdd]);
    __syncthreads();
  }
  move_dual(t - kDual, relaxation);
  __syncthreads();
  renew(t - kDual);
  relax<kOther>(t - kDual, renewed_[0].of[kOther], inverse_[kDual].of[kOther]);
  const StripPair c = c_of_leaving_;
  read_ahead(t + 1, is_first);
  __syncthreads();
  relax<kOther>(t - kLast1, renewed_[1].of[kOther], inverse_[kLast1].of[kOther]);
  __syncthreads();
  leave<kOther>(t - kStored, c);
}

__device__ void Strip::iterate(float relaxation, bool is_first) {
  read_ahead(first_ - kHaloRows, is_first);
  for (int t = first_ - kHaloRows; t < end_ + kStored; t += 2) {
    step<0>(t, relaxation, is_first);
    step<1>(t + 1, relaxation, is_first);
  }
}

__device__ void Strip::keep() const {
  for (int y = first_; y < end_; ++y) {
    const StripPair u = read(TvL2Plane::U, y);
    for (int half = 0; half < 2; ++half) write(0, y, half, u.of[half]);
  }
}

__global__ void __launch_bounds__(kStripThreads, 8)
    iterate_strips(const __grid_constant__ TvL2Level level,
                   const __grid_constant__ TvL2Level coarse, const TvL2View* views, bool is_first,
                   int rows) {
  __shared__ Shared shared;
  const int view = static_cast<int>(blockIdx.z);
  Strip strip(level, coarse, view, rows, shared);
  if (views[view].is_active == 0) return strip.keep();
  strip.iterate(views[view].relaxation, is_first);
}

dim3 strips(const TvL2Level& level, int views, int rows) {
  return {blocks_for(level.half(), kStripPlaces), blocks_for(level.height, rows),
          static_cast<unsigned>(views)};
}

// Strips that the device works on together.
long strips_at_once() {
  static const long count = [] {
    int device = 0, processors = 0, each = 0;
    check(cudaGetDevice(&device));
    check(cudaDeviceGetAttribute(&processors, cudaDevAttrMultiProcessorCount, device));
    check(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&each, iterate_strips, kStripThreads, 0));
    return std::max(1L, static_cast<long>(processors) * each);
  }();
  return count;
}

// Rows of a strip, an even number: those with which the device, which works on so many strips at a
// time, is done first. Strips of more rows compute fewer of them twice, but the last of them may
// leave it idle.
int rows_of(const TvL2Level& level, int views) {
  const long at_once = strips_at_once();
  const long most = std::max(level.height / kLeastRows, 1);
  int best = 0;
  long least = std::numeric_limits<long>::max();
  for (long count = 1; count <= most; ++count) {
    const int rows = 2 * static_cast<int>(blocks_for(level.height, static_cast<int>(2 * count)));
    const dim3 grid = strips(level, views, rows);
    const long turns = (static_cast<long>(grid.x) * grid.y * grid.z + at_once - 1) / at_once;
    const long time = turns * (rows + kHaloRows + kStored);
    if (time < least) {
      least = time;
      best = rows;
    }
  }
  return best;
}

}  // namespace

bool has_enough_strips(const TvL2Level& level, int views) {
  constexpr unsigned kEnough = 300;
  const dim3 grid = strips(level, views, 2 * kLeastRows);
  return grid.x * grid.y * grid.z >= kEnough;
}

void iterate_by_strips(const DeviceStream& stream, const TvL2Level& level, const TvL2Level& coarse,
                       int views, const TvL2View* of_views, bool is_first) {
  const double places = static_cast<double>(level.height) * level.half() * views;
  const int rows = rows_of(level, views);
  launch(stream, {"tv_l2: iteration by strips", places * 24 * sizeof(float), places * 220}, [&] {
    iterate_strips<<<strips(level, views, rows), kStripThreads, 0, stream.get()>>>(
        level, coarse, of_views, is_first, rows);
  });
}

namespace {

// The steps of tv_l2_steps.cuh on tiles in shared memory: a step needs its neighbors' results, so
// a tile computes some of what belongs to its neighbors too, instead of all going through memory
// after each step. All pixels at once, for few of them.

using Shape = TvL2TileShape<32, 30, 3, 5, 768>;
constexpr int kTileThreads = Shape::kThreads, kEach = Shape::kEach;
constexpr int kOdd = Shape::kOdd, kRow = Shape::kRow, kPlane = Shape::kPlane;
constexpr int kSharedPlanes = 5;

// How many pixels around the tile a step computes, for those after it to have their neighbors.
constexpr int kReadReach = 5;
constexpr int kReachOfRelaxed1 = 4, kReachOfRelaxed0 = 3;  // before the dual
constexpr int kReachOfDual = 3, kReachOfB = 2;
constexpr int kReachOfLast0 = 2, kReachOfLast1 = 1;

// A place of a tile: two pixels, the even one first.
struct TilePair {
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

  // Reads the tile; color 0 with the correction of its cell.
  __device__ void load(const TvL2Level& coarse, bool is_first);
  __device__ void invert_diagonal();
  // Relaxes one color from b as it is.
  __device__ void relax(int color, int reach);
  __device__ void move_dual(float relaxation);
  __device__ void renew();
  __device__ void store(const TvL2Level& coarse);

 private:
  // What no block writes meanwhile.
  [[nodiscard]] __device__ TilePair read(TvL2Plane which, const Place& place) const {
    if (!place.is_inside) return {};
    const float* const from = level_.of(which, view_) + place.from;
    return {{__ldg(from), __ldg(from + level_.odd)}};
  }
  __device__ void write(int moved, const Place& place, const TilePair& values) const {
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
  // Σ penalty·neighbor, and with the pixel itself as `here` Σ penalty·(neighbor − here).
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
  TilePair b_[kEach], inverse_[kEach];
};

__device__ void Tile::load(const TvL2Level& coarse, bool is_first) {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place& place = places_[k];
    if (!place.exists()) continue;
    TilePair u = read(TvL2Plane::U, place);
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
    const TilePair c = read(TvL2Plane::C, place);
#pragma unroll
    for (int half = 0; half < 2; ++half) {
      const int at = place.at + half * kOdd;
      const float edges = rx_[at] + rx_[left_of(place, half)] + ry_[at] + ry_[at - kRow];
      const float own = level_.data_scale * c.of[half];
      inverse_[k].of[half] = own > 0 ? 1 / (own + edges) : 0.0F;
    }
  }
}

__device__ void Tile::relax(int color, int reach) {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place& place = places_[k];
    if (place.reach > reach) continue;
    const int half = place.is_odd ? 1 - color : color;
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
    TilePair zx = read(TvL2Plane::Zx, place), zy = read(TvL2Plane::Zy, place);
    const TilePair g = read(TvL2Plane::G, place);
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

// Stores u, and the residual of color 0 of cells of 2×2; color 1, relaxed last, has none.
__device__ void Tile::store(const TvL2Level& coarse) {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place& place = places_[k];
    if (place.reach > 0) continue;
    const int half = place.is_odd ? 1 : 0;
    const int at = place.at + half * kOdd;
    const float here = u_[at];
    const TilePair c = read(TvL2Plane::C, place);
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

__global__ void __launch_bounds__(kTileThreads, 2)
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
    iterate_tiles<<<Shape::blocks(level, views), kTileThreads, kBytes, stream.get()>>>(
        level, coarse, of_views, is_first);
  });
}

}  // namespace episcope::cuda
