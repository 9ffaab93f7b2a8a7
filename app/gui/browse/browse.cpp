// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/browse/browse.h"

#include "app/gui/browse/browse_controller.h"
#include "app/gui/browse/focus_controller.h"
#include "app/gui/browse/info_controller.h"
#include "app/gui/browse/tone_controller.h"
#include "app/gui/browse/value_controller.h"

namespace episcope {

void add_browsing(const Workbench& bench) {
  new BrowseController(bench);
  new FocusController(bench);
  new InfoController(bench);
  new ToneController(bench);
  new ValueController(bench);
}

}  // namespace episcope
