// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/estimator.h"

#include "engine/core/error.h"
#include "engine/core/light_field/view_places.h"
#include "engine/core/version.h"
#include "engine/cuda/device/cuda_device.h"
#include "engine/disparity/common/disparity_range.h"

#include <fmt/format.h>

#include <algorithm>

namespace episcope {

void require_device(Device device, const EstimatorInfo& info) {
  if (device == Device::Auto) return;
  if (std::ranges::count(info.devices, device) == 0) {
    throw Unavailable(fmt::format("{} runs on the CPU only; use --device cpu or auto", info.name));
  }
  if (device != Device::Cuda || has_cuda_device()) return;
  throw Unavailable(fmt::format("there is no GPU to use: {}; use --device cpu or auto",
                                known_cuda_device().why_not));
}

Device chosen_device(Device device, const EstimatorInfo& info) {
  if (device != Device::Auto) return device;
  const bool can_use = std::ranges::count(info.devices, Device::Cuda) > 0 && has_cuda_device();
  return can_use ? Device::Cuda : Device::Cpu;
}

Estimate estimate_on_device(Device device, const EstimatorInfo& info,
                            const std::function<Estimate(Device)>& estimate) {
  if (chosen_device(device, info) == Device::Cpu) return estimate(Device::Cpu);
  try {
    Estimate result = estimate(Device::Cuda);
    result.notes.push_back(fmt::format("computed on {}", known_cuda_device().name));
    return result;
  } catch (const DeviceFailure& failure) {
    if (device == Device::Cuda) throw;
    Estimate result = estimate(Device::Cpu);
    result.notes.push_back(fmt::format("computed on the CPU: {}", failure.what()));
    return result;
  }
}

namespace {

// For a parameter `range` that asked to find it, and for a range found that may be too narrow.
void note_range(const LightField& light_field, Provenance& estimate) {
  for (const auto& [key, value] : estimate.parameters) {
    const auto* const wanted = std::get_if<IntervalOrAuto>(&value);
    if (key != "range" || !wanted) continue;
    if (wanted->is_found) estimate.notes.push_back(found_range_note(estimate.range));
    if (range_source(light_field, *wanted) != RangeSource::Found) continue;
    const std::string limited = limited_range_note(light_field, estimate.range);
    if (!limited.empty()) estimate.notes.push_back(limited);
  }
}

// For a method without a parameter `positions`: that it takes cameras for equidistant.
void note_positions(const LightField& light_field, Provenance& estimate) {
  const auto is_choice = [](const auto& entry) { return entry.first == "positions"; };
  if (std::ranges::any_of(estimate.parameters, is_choice)) return;
  const ViewPlaces stated = view_places(light_field.info(), light_field.grid());
  if (stated.kind != PlacesKind::Irregular) return;
  estimate.notes.push_back(fmt::format(
      "cameras stand up to {:.2f} steps off the regular grid, which this method takes for granted; "
      "stereo methods can use their positions",
      stated.largest_deviation));
}

}  // namespace

void complete_estimate(Provenance& estimate, const std::string& method,
                       const LightField& light_field, double seconds) {
  estimate.method = method;
  estimate.seconds = seconds;
  estimate.version = kVersion;
  estimate.source = light_field.info().source;
  estimate.reading = light_field.info().reading;
  note_range(light_field, estimate);
  note_positions(light_field, estimate);
}

}  // namespace episcope
