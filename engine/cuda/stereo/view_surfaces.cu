// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/stereo/view_surfaces.cuh"

namespace episcope::cuda {
namespace {

constexpr int kThreads = 256;
// As in surfaces_in_views.
constexpr float kNothing = -1e9F;
constexpr float kOverlap = 0.25F;

// The pixels of one axis that a point at `place` covers, within [0, extent).
struct Covered {
  int first, last;
};
__device__ Covered covered(float place, int extent) {
  const int whole = static_cast<int>(floorf(place));
  const float t = place - static_cast<float>(whole);
  const int first = t > 1 - kOverlap ? whole + 1 : whole;
  const int last = t < kOverlap ? whole : whole + 1;
  return {max(first, 0), min(last, extent - 1)};
}

// Floats of one sign are in the order of their bits, negative ones in the opposite one.
__device__ void raise(float* to, float value) {
  if (value >= 0) {
    atomicMax(reinterpret_cast<int*>(to), __float_as_int(value));
  } else {
    atomicMin(reinterpret_cast<unsigned*>(to), __float_as_uint(value));
  }
}

__global__ __launch_bounds__(kThreads) void fill(float* values, long count) {
  const long at = static_cast<long>(blockIdx.x) * kThreads + threadIdx.x;
  if (at < count) values[at] = kNothing;
}

__global__ __launch_bounds__(kThreads) void cast(ViewPlanes views, const float* disparity,
                                                 float* surfaces) {
  const int x = static_cast<int>(blockIdx.x) * kThreads + static_cast<int>(threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  if (x >= views.width) return;
  const float d = disparity[static_cast<long>(y) * views.width + x] + 0.0F;  // −0 becomes 0
  if (d <= kNothing) return;
  const ViewIndex view = views.view_of(static_cast<int>(blockIdx.z));
  const auto place = [d](int from, int step) {
    return __fsub_rn(static_cast<float>(from), __fmul_rn(d, static_cast<float>(step)));
  };
  const Covered rows = covered(place(y, view.v - views.reference.v), views.height);
  const Covered columns = covered(place(x, view.u - views.reference.u), views.width);
  float* const surface = surfaces + blockIdx.z * views.plane_size();
  for (int row = rows.first; row <= rows.last; ++row) {
    for (int column = columns.first; column <= columns.last; ++column) {
      raise(surface + static_cast<long>(row) * views.width + column, d);
    }
  }
}

}  // namespace

DeviceArray<float> cast_surfaces(const ViewPlanes& views, const float* disparity,
                                 const DeviceStream& stream) {
  const long count = views.slots() * views.plane_size();
  DeviceArray<float> surfaces(count, stream);
  launch(stream, {"stereo: no surfaces", 4.0 * static_cast<double>(count)}, [&] {
    fill<<<blocks_for(count, kThreads), kThreads, 0, stream.get()>>>(surfaces.data(), count);
  });
  const dim3 grid(blocks_for(views.width, kThreads), static_cast<unsigned>(views.height),
                  static_cast<unsigned>(views.slots()));
  const auto points = static_cast<double>(count);
  launch(stream, {"stereo: surfaces in views", 8 * points, 10 * points},
         [&] { cast<<<grid, kThreads, 0, stream.get()>>>(views, disparity, surfaces.data()); });
  return surfaces;
}

}  // namespace episcope::cuda
