// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/cloud/cloud.h"

#include "app/gui/cloud/cloud_controller.h"
#include "app/gui/frame/commands.h"
#include "app/gui/frame/frame.h"
#include "app/gui/frame/panes.h"

namespace episcope {
namespace {

void add_commands(const Workbench& bench, CloudController* cloud) {
  bench.commands.add({.id = "cloud.large",
                      .menu = Menu::Panes,
                      .text = CloudController::tr("3D in the place of the view"),
                      .tip = CloudController::tr("Shows the 3D view large, in the place of the "
                                                 "view, or puts it back into its tab"),
                      .icon = "cube",
                      .keys = {Qt::Key_F4},
                      .run = [cloud] { cloud->setLarge(!cloud->isLarge()); },
                      .checked = [cloud] { return cloud->isLarge(); }});
  bench.commands.add(
      {.id = "cloud.window",
       .menu = Menu::Panes,
       .text = CloudController::tr("3D in its own window"),
       .tip = CloudController::tr("Gives the 3D view with its controls a window of "
                                  "its own, or takes it back"),
       .icon = "sides",
       .keys = {CloudController::tr("Shift+F4")},
       .run =
           [&frame = bench.frame, cloud] {
             cloud->setLarge(false);
             frame.showTab("cloud");
             frame.panes().toggle("tab.cloud");
           },
       .checked = [&frame = bench.frame] { return frame.panes().isTorn("tab.cloud"); }});
  bench.commands.add({.id = "cloud.export",
                      .menu = Menu::File,
                      .text = CloudController::tr("Save 3D view…"),
                      .tip = CloudController::tr("Writes the points or surfaces that the 3D view "
                                                 "shows, in their colours, as PLY"),
                      .icon = "export",
                      .keys = {CloudController::tr("Ctrl+Alt+E")},
                      .run = [cloud] { cloud->askToExport(); },
                      .section = section::kExport,
                      .enabled = [cloud] { return cloud->hasScene(); }});
}

}  // namespace

void add_cloud(const Workbench& bench) {
  auto* tab = new QWidget(&bench.frame);
  bench.frame.addTab({.id = "cloud",
                      .title = CloudController::tr("3D"),
                      .command_text = CloudController::tr("3D tab"),
                      .command_tip = CloudController::tr("Shows the result in 3D, as points or as "
                                                         "a surface"),
                      .icon = "cube",
                      .widget = tab});
  add_commands(bench, new CloudController(bench, tab));
}

}  // namespace episcope
