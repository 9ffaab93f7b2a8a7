// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/estimate/estimate.h"

#include "app/gui/estimate/estimate_controller.h"

namespace episcope {

void add_estimating(const Workbench& bench) {
  new EstimateController(bench);
}

}  // namespace episcope
