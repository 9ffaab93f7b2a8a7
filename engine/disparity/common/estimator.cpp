// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/estimator.h"

#include "engine/core/error.h"
#include "engine/core/version.h"

#include <algorithm>

namespace episcope {

void require_device(Device device, const EstimatorInfo& info) {
  if (device == Device::Auto || std::ranges::count(info.devices, device) > 0) return;
  throw Unavailable("this build runs on the CPU only; use --device cpu or auto");
}

void complete_estimate(Estimate& estimate, const std::string& method, const LightField& light_field,
                       double seconds) {
  estimate.method = method;
  estimate.seconds = seconds;
  estimate.version = kVersion;
  estimate.source = light_field.info().source;
  estimate.reading = light_field.info().reading;
}

}  // namespace episcope
