// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/line_check.cuh"

#include "engine/cuda/device.cuh"
#include "engine/cuda/device_data.cuh"

#include <cub/device/device_radix_sort.cuh>

namespace episcope::cuda {
namespace {

constexpr int kTrustColumns = 32, kTrustRows = 8;
constexpr int kTrustWide = kTrustColumns + 2 * kTextureRadius,
              kTrustHigh = kTrustRows + 2 * kTextureRadius;

// Whole numbers, which floats hold.
__device__ float squared_difference(const PackedColor& a, std::uint32_t packed) {
  constexpr float kUnit = 1.0F / static_cast<float>(kPackedMost);
  const PackedColor b = unpacked(packed);
  float sum = 0;
  for (int c = 0; c < 3; ++c) {
    const float off = a.channel[c] - b.channel[c];
    sum = __fmaf_rn(off, off, sum);
  }
  return sum * (kUnit * kUnit);
}

// Of the pixel and those around it: sums over both axes of squared differences.
struct Gradients {
  float mean, own;
};

// The neighbor opposite stands in place of one beyond the border.
__device__ int mirrored(int at, int size) {
  const int inside = at < 0 ? -at : at >= size ? 2 * (size - 1) - at : at;
  return min(max(inside, 0), size - 1);
}

__device__ Gradients gradients_at(const PackedField& field, const std::uint32_t* view, int y,
                                  int x) {
  const auto pixel = [&](int py, int px) { return __ldg(view + py * field.width + px); };
  const PackedColor here = unpacked(pixel(y, x));
  const float left = squared_difference(here, pixel(y, mirrored(x - 1, field.width)));
  const float right = squared_difference(here, pixel(y, mirrored(x + 1, field.width)));
  const float up = squared_difference(here, pixel(mirrored(y - 1, field.height), x));
  const float down = squared_difference(here, pixel(mirrored(y + 1, field.height), x));
  return {0.5F * (left + right) + 0.5F * (up + down), fminf(left, right) + fminf(up, down)};
}

// The mean over the window around a pixel, of what exists; `mean` is 0 elsewhere.
__device__ float window_mean(const PackedField& field, const float (&mean)[kTrustHigh][kTrustWide],
                             int y, int x) {
  float sum = 0;
  for (int i = 0; i <= 2 * kTextureRadius; ++i) {
    float column = 0;
    for (int j = 0; j <= 2 * kTextureRadius; ++j) column += mean[threadIdx.y + j][threadIdx.x + i];
    sum += column;
  }
  const int columns = min(x + kTextureRadius, field.width - 1) - max(x - kTextureRadius, 0) + 1;
  const int rows = min(y + kTextureRadius, field.height - 1) - max(y - kTextureRadius, 0) + 1;
  return sum / static_cast<float>(columns) / static_cast<float>(rows);
}

__global__ __launch_bounds__(kTrustColumns* kTrustRows) void reduce(PackedField field,
                                                                    MapPointers maps,
                                                                    float variance) {
  __shared__ float mean[kTrustHigh][kTrustWide], own[kTrustHigh][kTrustWide];
  const int place = static_cast<int>(blockIdx.z);
  const int v = maps.first.v + place / maps.grid.u, u = maps.first.u + place % maps.grid.u;
  const std::uint32_t* const view = field.view(v, u);
  const int first_y = static_cast<int>(blockIdx.y) * kTrustRows;
  const int first_x = static_cast<int>(blockIdx.x) * kTrustColumns;
  const int thread = static_cast<int>(threadIdx.y) * kTrustColumns + static_cast<int>(threadIdx.x);
  for (int i = thread; i < kTrustHigh * kTrustWide; i += kTrustColumns * kTrustRows) {
    const int y = first_y + i / kTrustWide - kTextureRadius,
              x = first_x + i % kTrustWide - kTextureRadius;
    const bool exists = y >= 0 && y < field.height && x >= 0 && x < field.width;
    const Gradients gradients = exists ? gradients_at(field, view, y, x) : Gradients{0, 0};
    mean[i / kTrustWide][i % kTrustWide] = gradients.mean;
    own[i / kTrustWide][i % kTrustWide] = gradients.own;
  }
  __syncthreads();
  const int y = first_y + static_cast<int>(threadIdx.y);
  const int x = first_x + static_cast<int>(threadIdx.x);
  if (y >= field.height || x >= field.width) return;
  const long at = (static_cast<long>(place) * field.height + y) * field.width + x;
  const float residual = line_residual(field, {v, u, y, x}, maps.disparity[at]);
  const float noise = __fmaf_rn(kMinDifference, kMinDifference, variance);
  const float beyond = fmaxf(residual - variance, 0);
  const float line = residual < INFINITY ? noise / (noise + beyond) : 1;
  const float change = own[threadIdx.y + kTextureRadius][threadIdx.x + kTextureRadius];
  const float share = kTextureGain * (change + noise) / (window_mean(field, mean, y, x) + noise);
  maps.confidence[at] *= sqrtf(sqrtf(line * fminf(share, 1)));
}

// Multiplies confidences by the trust in the maps' disparities, `variance` being residual_noise of
// these; see reduce_confidence.
void reduce_confidence(const PackedField& field, const MapPointers& maps, float variance,
                       const DeviceStream& stream) {
  const dim3 grid(blocks_for(field.width, kTrustColumns), blocks_for(field.height, kTrustRows),
                  static_cast<unsigned>(maps.grid.count()));
  const double rays = static_cast<double>(maps.grid.count()) * field.height * field.width;
  // A sample, a disparity and a confidence, read and written; two samples of up to 16 views.
  launch(stream, {"trust in lines", rays * 16, rays * 500}, [&] {
    reduce<<<grid, dim3(kTrustColumns, kTrustRows), 0, stream.get()>>>(field, maps, variance);
  });
}

constexpr int kThreads = 256;

// Residuals of one view, and how many of them are finite.
__global__ __launch_bounds__(kThreads) void measure(PackedField field, ViewIndex view,
                                                    const float* disparity, float* residuals,
                                                    int* finite) {
  const int count = field.height * field.width;
  const int at = static_cast<int>(blockIdx.x * kThreads + threadIdx.x);
  bool is_finite = false;
  if (at < count) {
    const RayPlace ray{view.v, view.u, at / field.width, at % field.width};
    residuals[at] = line_residual(field, ray, disparity[at]);
    is_finite = isfinite(residuals[at]);
  }
  const int in_block = __syncthreads_count(is_finite);
  if (threadIdx.x == 0) atomicAdd(finite, in_block);
}

template <class T>
T fetch(const T* from, const DeviceStream& stream) {
  T value{};
  check(cudaMemcpyAsync(&value, from, sizeof value, cudaMemcpyDeviceToHost, stream.get()));
  stream.wait();
  return value;
}

// The median residual of the center view, which the maps must cover; 0 if no ray has one. Waits
// for the device. Throws DeviceFailure.
float residual_noise(const PackedField& field, const MapPointers& maps,
                     const DeviceStream& stream) {
  const ViewIndex center = field.grid.center();
  const int count = field.height * field.width;
  const long place = maps.index(center.v, center.u);
  DeviceArray<float> residuals(count, stream), sorted(count, stream);
  DeviceArray<int> finite(1, stream);
  finite.clear();
  launch(stream, {"residuals of the center view", 8.0 * count, 700.0 * count}, [&] {
    measure<<<blocks_for(count, kThreads), kThreads, 0, stream.get()>>>(
        field, center, maps.disparity + place * count, residuals.data(), finite.data());
  });
  std::size_t bytes = 0;
  check(cub::DeviceRadixSort::SortKeys(nullptr, bytes, residuals.data(), sorted.data(), count, 0,
                                       32, stream.get()));
  DeviceArray<char> scratch(bytes, stream);
  check(cub::DeviceRadixSort::SortKeys(scratch.data(), bytes, residuals.data(), sorted.data(),
                                       count, 0, 32, stream.get()));
  const int known = fetch(finite.data(), stream);
  // The median by nearest rank; what is infinite comes last.
  return known == 0 ? 0 : fetch(sorted.data() + known / 2, stream);
}

// What lies farther than a ray at the ends of its line.
struct Farther {
  float disparity[4 * kOccludedReach];
  int count;

  // The element of index count/2 in ascending order.
  __device__ float median() const {
    float middle = 0;
    for (int i = 0; i < count; ++i) {
      int less = 0, same = 0;
      for (int j = 0; j < count; ++j) {
        less += disparity[j] < disparity[i] ? 1 : 0;
        same += disparity[j] == disparity[i] ? 1 : 0;
      }
      if (less <= count / 2 && count / 2 < less + same) middle = disparity[i];
    }
    return middle;
  }
};

// Looks along the line of a ray in a view `k` steps away. Whether that view exists.
__device__ bool look_along(const PackedField& field, const MapPointers& maps, const RayPlace& ray,
                           bool vertical, int k, float own, float confidence, Farther& farther) {
  const int v = ray.v + (vertical ? k : 0), u = ray.u + (vertical ? 0 : k);
  if (!field.contains(v, u)) return false;
  const int last = (vertical ? field.height : field.width) - 1;
  const float at =
      __fmaf_rn(-own, static_cast<float>(k), static_cast<float>(vertical ? ray.y : ray.x));
  if (!(at >= 0 && at <= static_cast<float>(last))) return true;
  const int nearest = static_cast<int>(at + 0.5F);
  const int y = vertical ? nearest : ray.y, x = vertical ? ray.x : nearest;
  const long place =
      ((static_cast<long>(v) * field.grid.u + u) * field.height + y) * field.width + x;
  const float met = maps.disparity[place];
  if (met < own - kOccludedFarther && maps.confidence[place] >= confidence) {
    farther.disparity[farther.count++] = met;
  }
  return true;
}

__device__ float replaced(const PackedField& field, const MapPointers& maps, const RayPlace& ray,
                          float own, float confidence, float tolerance) {
  Farther farther;
  farther.count = 0;
  int reached = 0;
  for (int k = -kOccludedReach; k <= kOccludedReach; ++k) {
    if (k == 0) continue;
    reached += look_along(field, maps, ray, false, k, own, confidence, farther) ? 1 : 0;
    reached += look_along(field, maps, ray, true, k, own, confidence, farther) ? 1 : 0;
  }
  if (farther.count < max(kOccludedMinViews, reached / kOccludedMinShare)) return own;
  const float other = farther.median();
  const bool fits = line_residual(field, ray, other) <= line_residual(field, ray, own) + tolerance;
  return fits ? other : own;
}

__global__ __launch_bounds__(kThreads) void replace(PackedField field, MapPointers maps,
                                                    float tolerance, float* out) {
  const int size = field.height * field.width;
  const int inside = static_cast<int>(blockIdx.x * kThreads + threadIdx.x);
  if (inside >= size) return;
  const int view = static_cast<int>(blockIdx.y);
  const RayPlace ray{view / field.grid.u, view % field.grid.u, inside / field.width,
                     inside % field.width};
  const long at = static_cast<long>(view) * size + inside;
  out[at] = replaced(field, maps, ray, maps.disparity[at], maps.confidence[at], tolerance);
}

// Writes the disparities of `maps`, which cover all views, to `out`, those that other views see
// through replaced; see replace_occluded. `variance` is residual_noise of the maps.
void replace_seen_through(const PackedField& field, const MapPointers& maps, float variance,
                          float* out, const DeviceStream& stream) {
  const int size = field.height * field.width;
  const dim3 grid(blocks_for(size, kThreads), static_cast<unsigned>(field.grid.count()));
  const float noise = variance + kMinDifference * kMinDifference;
  const double rays = static_cast<double>(field.grid.count()) * size;
  launch(stream, {"rays seen through", rays * 12, rays * 16 * 8}, [&] {
    replace<<<grid, kThreads, 0, stream.get()>>>(field, maps, kOccludedTolerance * noise, out);
  });
}

__constant__ const SideOffsets kOffsets = kSideOffsets;
constexpr int kColumns = 32, kRows = 8;
constexpr int kSideThreads = kColumns * kRows;
constexpr int kWide = kColumns + 2 * kVoteRadius, kHigh = kRows + 2 * kVoteRadius;
constexpr int kPlaces = kWide * kHigh;

// Disparities and confidences that a ray can take.
struct Sides {
  float own, far, near;
  float own_confidence, far_confidence, near_confidence;
  __device__ bool has_far() const { return own - far > kLeastSideStep; }
  __device__ bool has_near() const { return near - own > kLeastSideStep; }
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
  for (int k = 0; k < kSideNeighbors; ++k) {
    const int py = min(max(y + kOffsets.at[k][0], 0), field.height - 1);
    const int px = min(max(x + kOffsets.at[k][1], 0), field.width - 1);
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

// Sums of residuals of the pixels around, by similarity of color.
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

__global__ __launch_bounds__(kSideThreads, 4) void choose(PackedField field, MapPointers before,
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
    for (int i = thread; i < kPlaces; i += kSideThreads) {
      if (is_asked(ballots, i)) begin_ballot(field, tile, i, ballots);
    }
    __syncthreads();
    for (int i = thread; i < ballots.asked_count; i += kSideThreads) {
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

// Decides for every ray near a jump of `before` to which side of it the ray belongs, and writes
// disparity and confidence of all rays to `after`, which is another; see choose_sides. `variance`
// is residual_noise of `before`.
void choose_sides(const PackedField& field, const MapPointers& before, float variance,
                  const MapPointers& after, const DeviceStream& stream) {
  const dim3 grid(blocks_for(field.width, kColumns), blocks_for(field.height, kRows),
                  static_cast<unsigned>(before.grid.count()));
  const float cap = kSideCap * (variance + kMinDifference * kMinDifference);
  const float sharpness = 1 / (8 * (kSideColorScale * kSideColorScale + 2 * variance));
  const double rays = static_cast<double>(before.grid.count()) * field.height * field.width;
  // Where nothing jumps, which is nearly everywhere: both maps are read and written.
  launch(stream, {"choice of sides", rays * 20, rays * 50}, [&] {
    choose<<<grid, dim3(kColumns, kRows), 0, stream.get()>>>(field, before, cap, sharpness, after);
  });
}

__device__ std::uint32_t quantized(float sample) {
  return static_cast<std::uint32_t>(
      __fmaf_rn(fminf(fmaxf(sample, 0.0F), 1.0F), static_cast<float>(kPackedMost), 0.5F));
}

__global__ __launch_bounds__(kThreads) void pack(DeviceSamples samples, long count,
                                                 std::uint32_t* out) {
  const long pixel = static_cast<long>(blockIdx.x) * kThreads + threadIdx.x;
  if (pixel >= count) return;
  if (samples.valid && samples.valid[pixel] == 0) {
    out[pixel] = 1U << kPackedInvalidBit;
    return;
  }
  const int second = samples.channels == 3 ? 1 : 0;
  out[pixel] = quantized(samples.at(pixel, 0)) |
               quantized(samples.at(pixel, second)) << kPackedBits |
               quantized(samples.at(pixel, 2 * second)) << (2 * kPackedBits);
}

}  // namespace

PackedFieldMemory::PackedFieldMemory(const DeviceSamples& samples, const DeviceStream& stream) {
  const long count = static_cast<long>(samples.grid.count()) * samples.height * samples.width;
  pixels_ = DeviceArray<std::uint32_t>(count, stream);
  const double read = static_cast<double>(count) * samples.channels;
  launch(stream, {"packing views", read + 4.0 * count, 2 * read}, [&] {
    pack<<<blocks_for(count, kThreads), kThreads, 0, stream.get()>>>(samples, count,
                                                                     pixels_.data());
  });
  field_ = {pixels_.data(), samples.grid, samples.height, samples.width, samples.valid != nullptr};
}

namespace {

void copy(const float* from, float* to, std::size_t count, const DeviceStream& stream) {
  check(cudaMemcpyAsync(to, from, count * sizeof(float), cudaMemcpyDeviceToDevice, stream.get()));
}

void choose_sides_in_place(const PackedField& field, const MapPointers& maps,
                           const DeviceStream& stream) {
  const std::size_t size = static_cast<std::size_t>(maps.grid.count()) * field.height * field.width;
  DeviceArray<float> disparity(size, stream), confidence(size, stream);
  const MapPointers before{maps.grid, maps.first, disparity.data(), confidence.data()};
  copy(maps.disparity, before.disparity, size, stream);
  copy(maps.confidence, before.confidence, size, stream);
  choose_sides(field, before, residual_noise(field, before, stream), maps, stream);
}

}  // namespace

void check_lines_on_device(const DeviceSamples& samples, const LineCheckSteps& steps,
                           const MapPointers& maps, const DeviceStream& stream,
                           const Progress& progress) {
  if (!steps.chooses_sides && !steps.reduces_confidence) return;
  progress.step("checking lines");
  const PackedFieldMemory packed(samples, stream);
  if (steps.chooses_sides) choose_sides_in_place(packed.field(), maps, stream);
  stream.wait();
  progress.check();
  progress.report(0.7);
  if (!steps.reduces_confidence) return;
  const float variance = residual_noise(packed.field(), maps, stream);
  reduce_confidence(packed.field(), maps, variance, stream);
}

void check_lines(const LightField& lf, const LineCheckSteps& steps, ViewStack<float>& disparity,
                 ViewStack<float>& confidence, const Progress& progress) {
  const auto light_field = on_device(lf, progress.part(0, 0));
  const DeviceStream stream;
  const Progress silent = progress.part(0, 0);
  auto d = upload(disparity.data(), disparity.size(), stream, silent);
  auto r = upload(confidence.data(), confidence.size(), stream, silent);
  check_lines_on_device(light_field->samples(), steps,
                        {disparity.grid(), disparity.first(), d.data(), r.data()}, stream,
                        progress);
  download(disparity, d, stream, silent);
  download(confidence, r, stream, silent);
}

void check_lines(const LightField& lf, const LineCheckSteps& steps, DeviceMaps& maps,
                 const Progress& progress) {
  MapMemory& memory = maps.memory();
  check_lines_on_device(memory.samples(lf, progress), steps, memory.pointers(), memory.stream,
                        progress);
}

void replace_occluded(const LightField& lf, ViewStack<float>& disparity,
                      const ViewStack<float>& confidence, const Progress& progress) {
  const auto light_field = on_device(lf, progress.part(0, 0));
  const DeviceStream stream;
  auto d = upload(disparity.data(), disparity.size(), stream, progress);
  auto r = upload(confidence.data(), confidence.size(), stream, progress);
  DeviceArray<float> out(disparity.size(), stream);
  const PackedFieldMemory packed(light_field->samples(), stream);
  const MapPointers maps{disparity.grid(), disparity.first(), d.data(), r.data()};
  const float variance = residual_noise(packed.field(), maps, stream);
  replace_seen_through(packed.field(), maps, variance, out.data(), stream);
  download(disparity, out, stream, progress);
}

}  // namespace episcope::cuda
