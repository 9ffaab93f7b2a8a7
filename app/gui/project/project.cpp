// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/project/project.h"

#include "app/gui/project/autosave.h"
#include "app/gui/project/project_controller.h"
#include "app/gui/project/project_guard.h"
#include "app/gui/project/scene_chooser.h"
#include "app/gui/project/session_recovery.h"
#include "app/gui/project/window_title.h"

namespace episcope {

void add_project(const Workbench& bench) {
  auto* autosave = new Autosave(bench);
  auto* project = new ProjectController(bench, *autosave);
  new ProjectGuard(bench, *project);
  new SessionRecovery(bench, *autosave);
  new SceneChooser(bench);
  new WindowTitle(bench, *autosave, *project);
}

}  // namespace episcope
