// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/capture/capture.h"

#include "app/gui/capture/capture_controller.h"
#include "app/gui/frame/frame.h"

#include <QWidget>

namespace episcope {

void add_capture(const Workbench& bench) {
  auto* tab = new QWidget(&bench.frame);
  bench.frame.addTab({.id = "capture",
                      .title = CaptureController::tr("Capture"),
                      .command_text = CaptureController::tr("Capture tab"),
                      .command_tip = CaptureController::tr("Makes ground truth from a mesh"),
                      .widget = tab,
                      .waits = true});
  new CaptureController(bench, tab);
}

}  // namespace episcope
