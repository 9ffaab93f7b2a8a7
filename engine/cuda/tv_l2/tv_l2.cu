// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/tv_l2/tv_l2.h"

#include "engine/cuda/device/transfer.cuh"
#include "engine/cuda/light_field/device_light_field.cuh"
#include "engine/cuda/maps/map_memory.cuh"
#include "engine/cuda/tv_l2/denoise_maps.cuh"
#include "engine/cuda/tv_l2/tv_l2_solver.cuh"

namespace episcope::cuda {
namespace {

// As TvL2Options.
constexpr int kIterations = 30;
constexpr double kGap = 1e-4;

}  // namespace

std::vector<double> denoise_maps(const LightField& lf, const MapDenoising& denoising,
                                 const ViewStack<float>& confidence, ViewStack<float>& disparity,
                                 const Progress& progress) {
  const auto light_field = on_device(lf, progress);
  const DeviceStream stream;
  const auto weights = upload(confidence.data(), confidence.size(), stream, progress);
  auto maps = upload(disparity.data(), disparity.size(), stream, progress);
  const std::vector<double> gaps =
      denoise_on_device(light_field->samples(), {disparity.grid(), disparity.first()}, denoising,
                        weights.data(), maps.data(), stream, progress);
  download(disparity, maps, stream, progress);
  return gaps;
}

std::vector<double> denoise_maps(const LightField& lf, const MapDenoising& denoising,
                                 DeviceMaps& maps, const Progress& progress) {
  MapMemory& memory = maps.memory();
  return denoise_on_device(memory.samples(lf, progress), {memory.grid, memory.first}, denoising,
                           memory.confidence.data(), memory.disparity.data(), memory.stream,
                           progress);
}

void solve_tv_l2(Image<float>& f, const Image<float>& w, ImageView<const float> g, double lambda,
                 const Progress& progress) {
  const DeviceStream stream;
  auto map = upload(f.data(), f.size(), stream, progress);
  const auto weights = upload(w.data(), w.size(), stream, progress);
  const auto edges = upload(g.data, f.size(), stream, progress);
  TvL2DeviceSolver solver(f.height(), f.width(), 1, stream);
  (void)solver.solve({map.data(), weights.data(), edges.data(), lambda}, kIterations, kGap,
                     progress, map.data());
  download_bytes(f.data(), map.data(), map.byte_size(), stream, progress);
}

}  // namespace episcope::cuda
