// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/cuda_device.h"
#include "engine/cuda/tv_l2/tv_l2.h"

namespace episcope::cuda {

std::vector<double> denoise_maps(const LightField&, const MapDenoising&, const ViewStack<float>&,
                                 ViewStack<float>&, const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}

std::vector<double> denoise_maps(const LightField&, const MapDenoising&, DeviceMaps&,
                                 const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}

void solve_tv_l2(Image<float>&, const Image<float>&, ImageView<const float>, double,
                 const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}

}  // namespace episcope::cuda
