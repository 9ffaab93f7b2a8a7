// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/estimate/batch.h"
#include "app/gui/estimate/estimate_controller.h"
#include "app/gui/estimate/result_export.h"
#include "app/gui/frame/cancels.h"
#include "app/gui/frame/commands.h"
#include "app/gui/frame/frame.h"
#include "widgets/estimate/method_panel.h"

namespace episcope {
namespace {

// Sections of the menu.
constexpr int kRun = 0;
constexpr int kResults = 1;

}  // namespace

void EstimateController::addCommands() {
  const auto has_scene = [this] { return session_.scene() != nullptr; };
  bench_.commands.add({.id = "estimate.run",
                       .menu = Menu::Estimate,
                       .text = tr("Run"),
                       .tip = tr("Runs the chosen method with the parameters of the form"),
                       .icon = "run",
                       .keys = {Qt::Key_F5, tr("Ctrl+Return")},
                       .run = [this] { run(); },
                       .section = kRun,
                       .enabled = has_scene});
  bench_.commands.add({.id = "estimate.batch",
                       .menu = Menu::Estimate,
                       .text = tr("Run on several…"),
                       .tip = tr("Runs one or several methods on light fields that are open"),
                       .keys = {tr("Shift+F5")},
                       .run = [this] { ask_for_batch(bench_, runs_, method_->request()); },
                       .section = kRun,
                       .enabled = has_scene});
  bench_.commands.add({.id = "estimate.sweep",
                       .menu = Menu::Estimate,
                       .text = tr("Sweep parameters…"),
                       .tip = tr("Runs the method with several values of one or two parameters"),
                       .keys = {tr("Ctrl+Shift+F5")},
                       .run = [this] { bench_.frame.showTab("sweep"); },
                       .section = kRun});
  QAction* cancel = bench_.commands.add({.id = "estimate.cancel",
                                         .menu = Menu::Estimate,
                                         .text = tr("Cancel"),
                                         .tip = tr("Cancels the current gesture, mode or job"),
                                         .icon = "stop",
                                         .keys = {Qt::Key_Escape},
                                         .run = [&cancels = bench_.cancels] { cancels.cancel(); },
                                         .section = kRun});
  QAction* copy = bench_.commands.add(
      {.id = "estimate.copy_command",
       .menu = Menu::Estimate,
       .text = tr("Copy as command"),
       .tip = tr("Copies the command line that runs the method with the parameters of the form"),
       .icon = "copy",
       .keys = {tr("Ctrl+Shift+C")},
       .run = [this] { copyCommand(); },
       .section = kRun,
       .enabled = has_scene});
  method_->followTips(cancel, copy);
  addResultCommands();
  addNoteCommand();
}

void EstimateController::addNoteCommand() {
  bench_.commands.add({.id = "estimate.note",
                       .menu = Menu::Estimate,
                       .text = tr("Note on result…"),
                       .tip = tr("Writes a note on the shown result, kept with the project"),
                       .keys = {tr("Ctrl+Alt+N")},
                       .run = [this] { askForNote(*session_.shown()); },
                       .section = kResults,
                       .enabled = [this] { return session_.shown() != nullptr; }});
}

void EstimateController::addResultCommands() {
  const auto has_result = [this] { return session_.shown() != nullptr; };
  bench_.commands.add({.id = "estimate.next",
                       .menu = Menu::Estimate,
                       .text = tr("Next result"),
                       .tip = tr("Shows the next result of the list"),
                       .keys = {tr("Ctrl+PgDown")},
                       .run = [this] { showNeighbour(1); },
                       .section = kResults,
                       .enabled = has_result});
  bench_.commands.add({.id = "estimate.previous",
                       .menu = Menu::Estimate,
                       .text = tr("Previous result"),
                       .tip = tr("Shows the previous result of the list"),
                       .keys = {tr("Ctrl+PgUp")},
                       .run = [this] { showNeighbour(-1); },
                       .section = kResults,
                       .enabled = has_result});
  bench_.commands.add({.id = "estimate.remove",
                       .menu = Menu::Estimate,
                       .text = tr("Remove result"),
                       .tip = tr("Removes the shown result from the list"),
                       .icon = "trash",
                       .keys = {tr("Ctrl+Delete")},
                       .run = [this] { removeShown(); },
                       .section = kResults,
                       .enabled = has_result});
  bench_.commands.add({.id = "estimate.restore",
                       .menu = Menu::Estimate,
                       .text = tr("Restore removed result"),
                       .tip = tr("Brings back the result that was removed last"),
                       .icon = "undo",
                       .keys = {tr("Ctrl+Shift+Delete")},
                       .run = [this] { restoreRemoved(); },
                       .section = kResults,
                       .enabled = [this] { return canRestore(); }});
  bench_.commands.add({.id = "file.export",
                       .menu = Menu::File,
                       .text = tr("Export result…"),
                       .tip = tr("Writes the shown result: HDF5, PFM, TIFF or PLY"),
                       .icon = "export",
                       .keys = {tr("Ctrl+E")},
                       .run = [this] { ask_to_export(bench_, *session_.shown()); },
                       .section = section::kExport,
                       .bar = BarSection::Files,
                       .enabled = has_result});
  bench_.commands.add({.id = "file.export_submission",
                       .menu = Menu::File,
                       .text = tr("Export for submission…"),
                       .tip = tr("Adds the shown result to a submission to the 2016 benchmark"),
                       .icon = "export",
                       .run = [this] { ask_to_submit(bench_, *session_.shown()); },
                       .section = section::kExport,
                       .enabled = has_result});
}

}  // namespace episcope
