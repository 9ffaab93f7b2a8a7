// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/tensor/orientations.h"

#include "engine/cuda/device/host_pages.h"
#include "engine/cuda/device/transfer.cuh"
#include "engine/cuda/maps/map_memory.cuh"
#include "engine/cuda/tensor/tensor_run.cuh"

namespace episcope::cuda {

void find_orientations(const LightField& lf, const TensorSettings& settings, DeviceMaps& maps,
                       const Progress& progress) {
  MapMemory& memory = maps.memory();
  find_orientations_on_device(memory.samples(lf, progress), settings, memory.pointers(),
                              memory.stream, progress);
}

void find_orientations(const LightField& lf, const TensorSettings& settings,
                       ViewStack<float>& disparity, ViewStack<float>& confidence,
                       const Progress& progress) {
  const auto of_disparity = begin_pages(disparity, progress);
  const auto of_confidence = begin_pages(confidence, progress);
  const auto light_field = on_device(lf, progress.part(0, 0));
  const DeviceStream stream;
  DeviceArray<float> d(disparity.size(), stream), r(confidence.size(), stream);
  PipelinedDownload downloads(stream, progress.part(0, 0));
  const auto begin_download = [&](int first, int count) {
    const std::size_t from = first * disparity.view_size(), size = count * disparity.view_size();
    downloads.add(disparity.data() + from, d.data() + from, size * sizeof(float));
    downloads.add(confidence.data() + from, r.data() + from, size * sizeof(float));
  };
  find_orientations_on_device(light_field->samples(), settings,
                              {disparity.grid(), disparity.first(), d.data(), r.data()}, stream,
                              progress, begin_download);
  downloads.finish();
}

}  // namespace episcope::cuda
