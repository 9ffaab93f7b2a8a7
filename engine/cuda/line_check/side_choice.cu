// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/line_check/line_residual.cuh"
#include "engine/cuda/line_check/side_choice.cuh"

namespace episcope::cuda {
namespace {

// As in side_choice.cpp.
constexpr int kNeighbours = 12;
__constant__ const int kOffsets[kNeighbours][2] = {{-3, -3}, {-3, 0}, {-3, 3}, {0, -3},
                                                   {0, 3},   {3, -3}, {3, 0},  {3, 3},
                                                   {-6, 0},  {0, -6}, {0, 6},  {6, 0}};
constexpr float kMinDifference = 1.0F / 255;
constexpr float kCap = 3;
constexpr float kColorScale = 8.0F / 255;
constexpr float kLeastStep = 0.2F;
constexpr float kFarAdvantage = 0.95F, kNearAdvantage = 0.8F;
constexpr float kFarTrust = 0.2F;
constexpr float kDoubtfulStep = 0.5F, kDoubtfulShare = 0.25F, kRelief = 1.5F;
constexpr float kNoPixel = 100;

constexpr int kVoteRadius = 2;
constexpr int kColumns = 32, kRows = 8;
constexpr int kThreads = kColumns * kRows;
constexpr int kWide = kColumns + 2 * kVoteRadius, kHigh = kRows + 2 * kVoteRadius;
constexpr int kPlaces = kWide * kHigh;

// Disparities and confidences that a ray can take.
struct Sides {
  float own, far, near;
  float own_confidence, far_confidence, near_confidence;
  __device__ bool has_far() const { return own - far > kLeastStep; }
  __device__ bool has_near() const { return near - own > kLeastStep; }
};

// `disparity` and `confidence` are those of a view.
__device__ Sides find_sides(const PackedField& field, const float* disparity,
                            const float* confidence, int y, int x) {
  const int here = y * field.width + x;
  Sides sides;
  sides.own = sides.far = sides.near = disparity[here];
  sides.own_confidence = sides.far_confidence = sides.near_confidence = confidence[here];
  const float least_trust = kFarTrust * sides.own_confidence;
#pragma unroll
  for (int k = 0; k < kNeighbours; ++k) {
    const int py = min(max(y + kOffsets[k][0], 0), field.height - 1);
    const int px = min(max(x + kOffsets[k][1], 0), field.width - 1);
    const int at = py * field.width + px;
    const float d = disparity[at], r = confidence[at];
    if (d < sides.far && r >= least_trust) {
      sides.far = d;
      sides.far_confidence = r;
    }
    if (d > sides.near) {
      sides.near = d;
      sides.near_confidence = r;
    }
  }
  return sides;
}

// What stands for the residual of a side that is none: own counts there, too.
constexpr float kAsOwn = -1;
enum Side { kOwn, kFar, kNear, kSides };

// What pixels of a tile and around it vote with.
struct Ballots {
  float residual[kSides][kPlaces];  // first the disparities that are asked for
  float color[3][kPlaces];
  std::uint16_t asked[kSides * kPlaces];  // a side of a place each, in any order
  int asked_count;
  std::uint32_t jumps[kRows];  // a bit for each pixel of the tile, whose votes are counted

  __device__ float of(int side, int place) const {
    const float value = residual[side][place];
    return value == kAsOwn ? residual[kOwn][place] : value;
  }
};

// Whether a pixel that jumps is near.
__device__ bool is_asked(const Ballots& ballots, int place) {
  const int row = place / kWide, column = place % kWide;
  std::uint32_t jumps = 0;
  for (int j = max(row - 2 * kVoteRadius, 0); j <= min(row, kRows - 1); ++j) {
    jumps |= ballots.jumps[j];
  }
  // Of a row of the tile, bits column − 2·kVoteRadius to column are near.
  constexpr std::uint64_t kWindow = (1U << (2 * kVoteRadius + 1)) - 1;
  return (std::uint64_t{jumps} << (2 * kVoteRadius) >> column & kWindow) != 0;
}

// One view, and the part of it that a block decides.
struct Tile {
  int v, u, y, x;
  const float* disparity;
  const float* confidence;
};

// The pixel that a place stands for, which may lie outside.
__device__ RayPlace pixel_of(const Tile& tile, int place) {
  return {tile.v, tile.u, tile.y + place / kWide - kVoteRadius,
          tile.x + place % kWide - kVoteRadius};
}

// All but the residuals.
__device__ void begin_ballot(const PackedField& field, const Tile& tile, int place,
                             Ballots& ballots) {
  const auto [v, u, y, x] = pixel_of(tile, place);
  if (y < 0 || y >= field.height || x < 0 || x >= field.width) {
    for (auto& residual : ballots.residual) residual[place] = 0;
    for (auto& color : ballots.color) color[place] = kNoPixel;
    return;
  }
  const std::uint32_t packed = field.view(v, u)[static_cast<long>(y) * field.width + x];
  for (int c = 0; c < 3; ++c) {
    ballots.color[c][place] = static_cast<float>(packed_channel(packed, c)) / kPackedMost;
  }
  const Sides sides = find_sides(field, tile.disparity, tile.confidence, y, x);
  const float wanted[kSides] = {sides.own, sides.far, sides.near};
  for (int side = 0; side < kSides; ++side) {
    const bool asks = side == kOwn || wanted[side] != sides.own;
    ballots.residual[side][place] = asks ? wanted[side] : kAsOwn;
    if (asks) {
      ballots.asked[atomicAdd(&ballots.asked_count, 1)] =
          static_cast<std::uint16_t>(side * kPlaces + place);
    }
  }
}

__device__ void fill_residual(const PackedField& field, const Tile& tile, float cap, int asked,
                              Ballots& ballots) {
  const int place = asked % kPlaces;
  float& residual = ballots.residual[asked / kPlaces][place];
  residual = fminf(line_residual<1>(field, pixel_of(tile, place), residual), cap);
}

struct Votes {
  float own, far, near;
};

// Sums of residuals of the pixels around, by similarity of colour.
__device__ Votes collect(const Ballots& ballots, int place, float sharpness) {
  Votes votes{0, 0, 0};
  for (int j = -kVoteRadius; j <= kVoteRadius; ++j) {
    for (int i = -kVoteRadius; i <= kVoteRadius; ++i) {
      const int at = place + j * kWide + i;
      float square = 0;
      for (const auto& color : ballots.color) {
        const float off = color[at] - color[place];
        square = __fmaf_rn(off, off, square);
      }
      const float root = fmaxf(__fmaf_rn(-sharpness, square, 1), 0);
      const float weight = root * root * root * root;
      votes.own = __fmaf_rn(weight, ballots.of(kOwn, at), votes.own);
      votes.far = __fmaf_rn(weight, ballots.of(kFar, at), votes.far);
      votes.near = __fmaf_rn(weight, ballots.of(kNear, at), votes.near);
    }
  }
  return votes;
}

// What is left of the confidence of a ray that keeps its disparity.
__device__ float kept_share(const Votes& votes) {
  const float excess = votes.far / fmaxf(votes.own, 1e-20F) - 1;
  return fminf(fmaxf(__fmaf_rn(kRelief, excess, kDoubtfulShare), 0), 1);
}

// Disparity and confidence.
__device__ float2 decide(const Sides& sides, const Votes& votes) {
  const bool has_near = sides.has_near();
  if (sides.has_far() && votes.far < kFarAdvantage * votes.own &&
      (!has_near || votes.far <= votes.near)) {
    return {sides.far, sides.far_confidence};
  }
  if (has_near && votes.near < kNearAdvantage * votes.own) {
    return {sides.near, sides.near_confidence};
  }
  const bool is_doubtful = sides.own - sides.far > kDoubtfulStep;
  return {sides.own, sides.own_confidence * (is_doubtful ? kept_share(votes) : 1)};
}

__global__ __launch_bounds__(kThreads, 4) void choose(PackedField field, MapPointers before,
                                                      float cap, float sharpness,
                                                      MapPointers after) {
  __shared__ Ballots ballots;
  const long size = static_cast<long>(field.height) * field.width;
  const int number = static_cast<int>(blockIdx.z);
  const Tile tile{before.first.v + number / before.grid.u, before.first.u + number % before.grid.u,
                  static_cast<int>(blockIdx.y) * kRows,    static_cast<int>(blockIdx.x) * kColumns,
                  before.disparity + number * size,        before.confidence + number * size};
  const int thread = static_cast<int>(threadIdx.y) * kColumns + static_cast<int>(threadIdx.x);
  const int y = tile.y + static_cast<int>(threadIdx.y);
  const int x = tile.x + static_cast<int>(threadIdx.x);
  const bool exists = y < field.height && x < field.width;
  if (thread == 0) ballots.asked_count = 0;
  const int place = (static_cast<int>(threadIdx.y) + kVoteRadius) * kWide +
                    static_cast<int>(threadIdx.x) + kVoteRadius;
  Sides sides{};
  if (exists) sides = find_sides(field, tile.disparity, tile.confidence, y, x);
  const bool has_jump = exists && (sides.has_far() || sides.has_near());
  const std::uint32_t jumps = __ballot_sync(~0U, has_jump);
  if (threadIdx.x == 0) ballots.jumps[threadIdx.y] = jumps;
  float2 decided{sides.own, sides.own_confidence};
  if (__syncthreads_or(has_jump)) {
    for (int i = thread; i < kPlaces; i += kThreads) {
      if (is_asked(ballots, i)) begin_ballot(field, tile, i, ballots);
    }
    __syncthreads();
    for (int i = thread; i < ballots.asked_count; i += kThreads) {
      fill_residual(field, tile, cap, ballots.asked[i], ballots);
    }
    __syncthreads();
    if (has_jump) decided = decide(sides, collect(ballots, place, sharpness));
  }
  if (!exists) return;
  const long at = number * size + static_cast<long>(y) * field.width + x;
  after.disparity[at] = decided.x;
  after.confidence[at] = decided.y;
}

}  // namespace

void choose_sides(const PackedField& field, const MapPointers& before, float variance,
                  const MapPointers& after, const DeviceStream& stream) {
  const dim3 grid(blocks_for(field.width, kColumns), blocks_for(field.height, kRows),
                  static_cast<unsigned>(before.grid.count()));
  const float cap = kCap * (variance + kMinDifference * kMinDifference);
  const float sharpness = 1 / (8 * (kColorScale * kColorScale + 2 * variance));
  const double rays = static_cast<double>(before.grid.count()) * field.height * field.width;
  // Where nothing jumps, which is nearly everywhere: both maps are read and written.
  launch(stream, {"choice of sides", rays * 20, rays * 50}, [&] {
    choose<<<grid, dim3(kColumns, kRows), 0, stream.get()>>>(field, before, cap, sharpness, after);
  });
}

}  // namespace episcope::cuda
