// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/measure/measure.h"

#include "app/gui/measure/measure_controller.h"

namespace episcope {

void add_measuring(const Workbench& bench) {
  new MeasureController(bench);
}

}  // namespace episcope
