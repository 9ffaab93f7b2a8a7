// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/tv_l2.h"

#include "engine/cuda/device.cuh"
#include "engine/solvers/shared_constants.h"

namespace episcope::cuda {
namespace {

// Iterations between two looks whether the run is to end.
constexpr int kCheckEvery = 25;

// What the solver holds, planes `[y][x]`: q is the dual of ∇u − p, r of ℰp (xx, yy, and xy twice).
struct Planes {
  int height = 0, width = 0;
  const float* f = nullptr;
  const float* w = nullptr;
  const float* g = nullptr;
  float *u, *ahead_u, *px, *py, *ahead_px, *ahead_py, *qx, *qy, *rxx, *ryy, *rxy;
};

struct Place {
  int y, x;
  long at;
  bool is_inside;
};
__device__ Place place_of(const Planes& planes) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y * blockDim.y + threadIdx.y);
  return {y, x, static_cast<long>(y) * planes.width + x, x < planes.width && y < planes.height};
}

__global__ void move_duals(Planes planes, float bend) {
  const Place place = place_of(planes);
  if (!place.is_inside) return;
  const long at = place.at, width = planes.width;
  const float limit = planes.g[at];
  const float here = planes.ahead_u[at];
  const float px = planes.ahead_px[at], py = planes.ahead_py[at];
  float qx = planes.qx[at], qy = planes.qy[at];
  if (place.x + 1 < planes.width) qx += kTgvStep * (planes.ahead_u[at + 1] - here - px);
  if (place.y + 1 < planes.height) qy += kTgvStep * (planes.ahead_u[at + width] - here - py);
  const float shrink = 1 / fmaxf(1.0F, sqrtf(qx * qx + qy * qy) / limit);
  planes.qx[at] = qx * shrink;
  planes.qy[at] = qy * shrink;
  const long left = place.x > 0 ? at - 1 : at, above = place.y > 0 ? at - width : at;
  const float xx = planes.rxx[at] + kTgvStep * (px - planes.ahead_px[left]);
  const float yy = planes.ryy[at] + kTgvStep * (py - planes.ahead_py[above]);
  const float xy =
      planes.rxy[at] + kTgvStep * 0.5F * (px - planes.ahead_px[above] + py - planes.ahead_py[left]);
  const float size = sqrtf(xx * xx + yy * yy + 2 * xy * xy);
  const float shrink_r = 1 / fmaxf(1.0F, size / (bend * limit));
  planes.rxx[at] = xx * shrink_r;
  planes.ryy[at] = yy * shrink_r;
  planes.rxy[at] = xy * shrink_r;
}

__global__ void move_unknowns(Planes planes, float inverse_lambda) {
  const Place place = place_of(planes);
  if (!place.is_inside) return;
  const long at = place.at, width = planes.width;
  const bool has_right = place.x + 1 < planes.width, has_below = place.y + 1 < planes.height;
  const bool has_left = place.x > 0, has_above = place.y > 0;
  const float qx = has_right ? planes.qx[at] : 0.0F, qy = has_below ? planes.qy[at] : 0.0F;
  float divergence = qx;
  if (has_left) divergence -= planes.qx[at - 1];
  divergence += qy;
  if (has_above) divergence -= planes.qy[at - width];
  const float c = kTgvStep * inverse_lambda * planes.w[at], u = planes.u[at];
  const float moved = (u + kTgvStep * divergence + c * planes.f[at]) / (1 + c);
  planes.ahead_u[at] = 2 * moved - u;
  planes.u[at] = moved;
  // Of r, minus the adjoint of ℰ: backward differences, none across the first row and column.
  const auto along = [&](const float* r) {
    return (has_right ? r[at + 1] : 0.0F) - (has_left ? r[at] : 0.0F);
  };
  const auto down = [&](const float* r) {
    return (has_below ? r[at + width] : 0.0F) - (has_above ? r[at] : 0.0F);
  };
  const float old_x = planes.px[at], old_y = planes.py[at];
  const float px = old_x + kTgvStep * (qx + (along(planes.rxx) + down(planes.rxy)));
  const float py = old_y + kTgvStep * (qy + (along(planes.rxy) + down(planes.ryy)));
  planes.ahead_px[at] = 2 * px - old_x;
  planes.ahead_py[at] = 2 * py - old_y;
  planes.px[at] = px;
  planes.py[at] = py;
}

DeviceArray<float> upload_or_ones(ImageView<const float> image, std::size_t size,
                                  const DeviceStream& stream, const Progress& progress) {
  if (!image.empty()) return upload(image.data, size, stream, progress);
  const Image<float> ones(1, static_cast<int>(size), 1, 1.0F);
  return upload(ones.data(), size, stream, progress);
}

}  // namespace

void solve_tgv_l2(Image<float>& f, const TgvTask& task, int iterations, const Progress& progress) {
  constexpr int kPlanes = 11;
  const DeviceStream stream;
  const std::size_t size = f.size();
  const auto observed = upload(f.data(), size, stream, progress);
  const auto w = upload_or_ones(task.w, size, stream, progress);
  const auto g = upload_or_ones(task.g, size, stream, progress);
  DeviceArray<float> memory(kPlanes * size, stream);
  memory.clear();
  const auto plane = [&](int number) { return memory.data() + number * size; };
  const Planes planes{f.height(), f.width(), observed.data(), w.data(), g.data(), plane(0),
                      plane(1),   plane(2),  plane(3),        plane(4), plane(5), plane(6),
                      plane(7),   plane(8),  plane(9),        plane(10)};
  for (float* const start : {planes.u, planes.ahead_u}) {
    check(cudaMemcpyAsync(start, observed.data(), observed.byte_size(), cudaMemcpyDeviceToDevice,
                          stream.get()));
  }
  const dim3 block(32, 8);
  const dim3 grid(blocks_for(f.width(), 32), blocks_for(f.height(), 8));
  const auto pixels = static_cast<double>(size);
  for (int i = 0; i < iterations && !progress.finish_requested(); ++i) {
    launch(stream, {"tgv: duals", pixels * 56, pixels * 50}, [&] {
      move_duals<<<grid, block, 0, stream.get()>>>(planes, static_cast<float>(task.bend));
    });
    launch(stream, {"tgv: unknowns", pixels * 72, pixels * 40}, [&] {
      move_unknowns<<<grid, block, 0, stream.get()>>>(planes, static_cast<float>(1 / task.lambda));
    });
    if (i % kCheckEvery != kCheckEvery - 1) continue;
    stream.wait();
    progress.check();
    progress.report(static_cast<double>(i + 1) / iterations);
  }
  download_bytes(f.data(), planes.u, size * sizeof(float), stream, progress);
}

}  // namespace episcope::cuda
