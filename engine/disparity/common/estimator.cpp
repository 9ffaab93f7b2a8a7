// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/estimator.h"

#include "engine/core/version.h"

namespace episcope {

void complete_estimate(Estimate& estimate, const std::string& method, const LightField& light_field,
                       double seconds) {
  estimate.method = method;
  estimate.seconds = seconds;
  estimate.version = kVersion;
  estimate.source = light_field.info().source;
}

}  // namespace episcope
