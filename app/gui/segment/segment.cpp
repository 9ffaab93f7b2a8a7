// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/segment/segment.h"

#include "app/gui/frame/frame.h"
#include "app/gui/segment/segment_controller.h"

namespace episcope {

void add_segmenting(const Workbench& bench) {
  auto* panel = new SegmentPanel(&bench.frame);
  bench.frame.addToTab("annotate", panel);
  new SegmentController(bench, panel);
}

}  // namespace episcope
