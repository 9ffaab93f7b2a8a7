// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device.h"
#include "engine/cuda/device_data.h"
#include "engine/cuda/layer_solver.h"
#include "engine/cuda/net.h"
#include "engine/cuda/orientations.h"
#include "engine/cuda/ray_labels.h"
#include "engine/cuda/stereo_matcher.h"
#include "engine/cuda/tv_l2.h"

// What a build without CUDA links in place of all device code.

namespace episcope {
namespace cuda {
namespace {

[[noreturn]] void fail() {
  throw DeviceFailure(known_cuda_device().why_not);
}

}  // namespace
}  // namespace cuda

CudaDevice cuda_device() {
  CudaDevice device;
  device.why_not = "this build has no CUDA";
  return device;
}

std::string cuda_runtime_version() {
  return {};
}

DeviceBounds measure_device_bounds() {
  cuda::fail();
}

void time_kernels(bool) {}

std::vector<KernelTime> kernel_times() {
  return {};
}

}  // namespace episcope

namespace episcope::cuda {

SharedVolume upload_volume(VolumeView<const float>, const Progress&) {
  fail();
}

struct MapMemory {};

DeviceMaps::DeviceMaps(const ViewStack<float>&) {
  fail();
}
DeviceMaps::~DeviceMaps() = default;
DeviceMaps::DeviceMaps(DeviceMaps&&) noexcept = default;

void DeviceMaps::clamp(float, float) {}

std::future<void> DeviceMaps::begin_confidence(ViewStack<float>&, const Progress&) const {
  return {};
}

void DeviceMaps::download_disparity(ViewStack<float>&, const Progress&) const {}

void find_orientations(const LightField&, const TensorSettings&, ViewStack<float>&,
                       ViewStack<float>&, const Progress&) {
  fail();
}

void find_orientations(const LightField&, const TensorSettings&, DeviceMaps&, const Progress&) {
  fail();
}

void check_lines(const LightField&, const LineCheckSteps&, ViewStack<float>&, ViewStack<float>&,
                 const Progress&) {
  fail();
}

void check_lines(const LightField&, const LineCheckSteps&, DeviceMaps&, const Progress&) {
  fail();
}

void replace_occluded(const LightField&, ViewStack<float>&, const ViewStack<float>&,
                      const Progress&) {
  fail();
}

double sweep_in_order(const LightField&, const OrderingSweeps&, const ViewStack<float>&,
                      const ViewStack<float>&, ViewStack<float>&, const Progress&) {
  fail();
}

OrderedLines count_ordered_lines(const ViewStack<float>&, float, const Progress&) {
  fail();
}

std::vector<double> denoise_maps(const LightField&, const MapDenoising&, const ViewStack<float>&,
                                 ViewStack<float>&, const Progress&) {
  fail();
}

std::vector<double> denoise_maps(const LightField&, const MapDenoising&, DeviceMaps&,
                                 const Progress&) {
  fail();
}

void solve_tv_l2(Image<float>&, const Image<float>&, ImageView<const float>, double,
                 const Progress&) {
  fail();
}

void solve_tgv_l2(Image<float>&, const TgvTask&, int, const Progress&) {
  fail();
}

struct StereoMatcher::State {};

StereoMatcher::StereoMatcher(const LightField&, const LightField&, ViewIndex, bool,
                             const Progress&) {
  fail();
}
StereoMatcher::~StereoMatcher() = default;

std::vector<float> StereoMatcher::least_costs(const StereoMatching&, const std::vector<int>&, float,
                                              const std::vector<int>&, const Progress&) {
  fail();
}

void StereoMatcher::compensate_noise(float, const Progress&) {
  fail();
}

float StereoMatcher::median_noise() const {
  fail();
}

Image<float> StereoMatcher::noise(const Progress&) const {
  fail();
}

float StereoMatcher::noise_variance(const Progress&) const {
  fail();
}

void StereoMatcher::aggregate(int, double) {
  fail();
}

void StereoMatcher::set_caps(const Image<float>&, const Progress&) {
  fail();
}

void StereoMatcher::set_occluders(const Image<float>&, float, float, const Progress&) {
  fail();
}

void StereoMatcher::choose(const StereoMatching&, const LabelPlaces&, ImageView<float>,
                           ImageView<float>, const Progress&) {
  fail();
}

SharedVolume StereoMatcher::volume(const StereoMatching&, const Progress&) {
  fail();
}

CostsAtLabels costs_at_labels(const DeviceVolume&, const Image<int>&, const Progress&) {
  fail();
}

Image<int> least_labels(const DeviceVolume&, const Progress&) {
  fail();
}

double sum_around_best(const DeviceVolume&, const std::uint8_t*, int, const Progress&) {
  fail();
}

LiftedLabels solve_lifted(const LiftedTask&, const std::function<void(int, double)>&,
                          const Progress&) {
  fail();
}

MessageAnswer solve_by_messages(const MessageTask&, int, const Progress&) {
  fail();
}

struct LayerMemory {};

DeviceLayers::DeviceLayers(const LightField&, const std::vector<DoublePass>&, const DoubleShears&,
                           DeviceMaps&, const Progress&) {
  fail();
}
DeviceLayers::~DeviceLayers() = default;
DeviceLayers::DeviceLayers(DeviceLayers&&) noexcept = default;

void measure_double_layers(const LightField&, const std::vector<DoublePass>&, const DoubleShears&,
                           const DoubleResults&, const Progress&) {
  fail();
}

LayerOutcome solve_layers(const LightField&, const LayerSmoothing&, const RawLayers&, DeviceMaps,
                          const LayerResults&, const Progress&) {
  fail();
}

RayLabelsAnswer label_rays(const RayLabelsTask&, const Progress&, ViewStack<std::int32_t>&) {
  fail();
}

struct DeviceNet::Memory {};

DeviceNet::DeviceNet(const NetParts&, const Progress&) {
  fail();
}
DeviceNet::~DeviceNet() = default;

NetAnswer DeviceNet::run(const NetTask&, const Progress&) const {
  fail();
}

struct DeviceForest::Memory {};

DeviceForest::DeviceForest(const ForestTables&, const Progress&) {
  fail();
}
DeviceForest::~DeviceForest() = default;

void DeviceForest::vote(VolumeView<const float>, const Progress&, float*) const {
  fail();
}

}  // namespace episcope::cuda
