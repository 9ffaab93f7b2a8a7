// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/line_check/line_residual.cuh"
#include "engine/cuda/line_check/see_through.cuh"

namespace episcope::cuda {
namespace {

// As in replace_occluded.cpp.
constexpr int kReach = 4;
constexpr int kMinViews = 2;
constexpr int kMinShare = 4;
constexpr float kFarther = 0.1F;
constexpr float kTolerance = 0.3F;
constexpr float kMinDifference = 1.0F / 255;
constexpr int kThreads = 256;

// What lies farther than a ray at the ends of its line.
struct Farther {
  float disparity[4 * kReach];
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
  if (met < own - kFarther && maps.confidence[place] >= confidence) {
    farther.disparity[farther.count++] = met;
  }
  return true;
}

__device__ float replaced(const PackedField& field, const MapPointers& maps, const RayPlace& ray,
                          float own, float confidence, float tolerance) {
  Farther farther;
  farther.count = 0;
  int reached = 0;
  for (int k = -kReach; k <= kReach; ++k) {
    if (k == 0) continue;
    reached += look_along(field, maps, ray, false, k, own, confidence, farther) ? 1 : 0;
    reached += look_along(field, maps, ray, true, k, own, confidence, farther) ? 1 : 0;
  }
  if (farther.count < max(kMinViews, reached / kMinShare)) return own;
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

}  // namespace

void replace_seen_through(const PackedField& field, const MapPointers& maps, float variance,
                          float* out, const DeviceStream& stream) {
  const int size = field.height * field.width;
  const dim3 grid(blocks_for(size, kThreads), static_cast<unsigned>(field.grid.count()));
  const float noise = variance + kMinDifference * kMinDifference;
  const double rays = static_cast<double>(field.grid.count()) * size;
  launch(stream, {"rays seen through", rays * 12, rays * 16 * 8}, [&] {
    replace<<<grid, kThreads, 0, stream.get()>>>(field, maps, kTolerance * noise, out);
  });
}

}  // namespace episcope::cuda
