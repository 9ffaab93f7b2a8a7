// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/tensor/orientations.h"

#include "engine/cuda/maps/map_memory.cuh"
#include "engine/cuda/tensor/tensor_run.cuh"

namespace episcope::cuda {

void find_orientations(const LightField& lf, const TensorSettings& settings, DeviceMaps& maps,
                       const Progress& progress) {
  const auto light_field = on_device(lf, progress.part(0, 0));
  MapMemory& memory = maps.memory();
  find_orientations_on_device(
      light_field->samples(), settings,
      {memory.grid, memory.first, memory.disparity.data(), memory.confidence.data()}, memory.stream,
      progress);
}

void find_orientations(const LightField& lf, const TensorSettings& settings,
                       ViewStack<float>& disparity, ViewStack<float>& confidence,
                       const Progress& progress) {
  DeviceMaps maps(disparity);
  find_orientations(lf, settings, maps, progress.part(0, 0.9));
  maps.download(disparity, confidence, progress.part(0.9, 1));
}

}  // namespace episcope::cuda
