// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/cuda_device.h"
#include "engine/cuda/stereo/stereo_matcher.h"

namespace episcope::cuda {

struct StereoMatcher::State {};

StereoMatcher::StereoMatcher(const LightField&, const LightField&, ViewIndex, bool,
                             const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}
StereoMatcher::~StereoMatcher() = default;

std::vector<float> StereoMatcher::least_costs(const StereoMatching&, const std::vector<int>&, float,
                                              const std::vector<int>&, const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}

void StereoMatcher::compensate_noise(float, const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}

float StereoMatcher::median_noise() const {
  throw DeviceFailure(known_cuda_device().why_not);
}

Image<float> StereoMatcher::noise(const Progress&) const {
  throw DeviceFailure(cuda_device().why_not);
}

float StereoMatcher::noise_variance(const Progress&) const {
  throw DeviceFailure(known_cuda_device().why_not);
}

void StereoMatcher::aggregate(int, double) {
  throw DeviceFailure(known_cuda_device().why_not);
}

void StereoMatcher::set_caps(const Image<float>&, const Progress&) {
  throw DeviceFailure(cuda_device().why_not);
}

void StereoMatcher::set_occluders(const Image<float>&, float, float, const Progress&) {
  throw DeviceFailure(cuda_device().why_not);
}

void StereoMatcher::choose(const StereoMatching&, const LabelPlaces&, ImageView<float>,
                           ImageView<float>, const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}

SharedVolume StereoMatcher::volume(const StereoMatching&, const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}

}  // namespace episcope::cuda
