// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/tensor/orientations.h"

#include "engine/cuda/device/transfer.cuh"
#include "engine/cuda/tensor/tensor_run.cuh"

namespace episcope::cuda {

void find_orientations(const LightField& lf, const TensorSettings& settings,
                       ViewStack<float>& disparity, ViewStack<float>& confidence,
                       const Progress& progress) {
  const auto light_field = on_device(lf, progress.part(0, 0));
  const DeviceStream stream;
  DeviceArray<float> d(disparity.size(), stream), r(confidence.size(), stream);
  find_orientations_on_device(light_field->samples(), settings,
                              {disparity.grid(), disparity.first(), d.data(), r.data()}, stream,
                              progress.part(0, 0.9));
  download(disparity, d, stream, progress);
  download(confidence, r, stream, progress);
}

}  // namespace episcope::cuda
