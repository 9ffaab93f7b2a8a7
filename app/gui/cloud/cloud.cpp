// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/cloud/cloud.h"

#include "app/gui/cloud/cloud_controller.h"
#include "app/gui/frame/frame.h"

namespace episcope {

void add_cloud(const Workbench& bench) {
  auto* tab = new QWidget(&bench.frame);
  bench.frame.addTab({.id = "cloud",
                      .title = CloudController::tr("3D"),
                      .command_text = CloudController::tr("3D tab"),
                      .command_tip = CloudController::tr("Shows the result as a point cloud"),
                      .icon = "cube",
                      .widget = tab});
  new CloudController(bench, tab);
}

}  // namespace episcope
