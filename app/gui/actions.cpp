// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/actions.h"

#include "app/gui/annotate_actions.h"
#include "app/gui/browse_actions.h"
#include "app/gui/compare/picture_export.h"
#include "app/gui/compare_actions.h"
#include "app/gui/estimate/estimate_controller.h"
#include "app/gui/frame/commands.h"
#include "app/gui/help/theme_choice.h"
#include "app/gui/main_window.h"
#include "app/gui/opening/scene_opener.h"
#include "app/gui/segment_actions.h"

#include <QAction>
#include <QTabWidget>

namespace episcope {
namespace {

QString tr(const char* source) {
  return MainWindow::tr(source);
}

void add_file_actions(ActionTable& table, MainWindow& window) {
  OpenController& opener = window.opener();
  const QString menu = tr("File");
  table.add({.id = "file.open",
             .menu = menu,
             .text = tr("Open file…"),
             .tip = tr("Opens a light field or a result from a file"),
             .icon = "open",
             .keys = {QKeySequence::Open},
             .run = [&opener] { opener.openFileDialog(); }});
  table.add({.id = "file.open_folder",
             .menu = menu,
             .text = tr("Open folder…"),
             .tip = tr("Opens a folder: a scene of the archive, a benchmark scene, an image grid"),
             .icon = "open",
             .keys = {tr("Ctrl+Shift+O")},
             .run = [&opener] { opener.openFolderDialog(); }});
  table.add({.id = "file.open_result",
             .menu = menu,
             .text = tr("Open result…"),
             .tip = tr("Adds a result from a file to the list of results"),
             .icon = "",
             .keys = {tr("Ctrl+R")},
             .run = [&opener] { opener.openResultDialog(); }});
  table.add({.id = "file.demo",
             .menu = menu,
             .text = tr("Open demo"),
             .tip = tr("Opens the built-in demo scene"),
             .icon = "",
             .keys = {},
             .run = [&window] { window.open("demo"); }});
  table.add({.id = "file.conventions",
             .menu = menu,
             .text = tr("Conventions…"),
             .tip = tr("Overrules the order of views, the units or the names that were found"),
             .icon = "",
             .keys = {tr("Ctrl+Shift+R")},
             .run = [&opener] { opener.conventionsDialog(); }});
  add_scribble_file_actions(table, window);
  table.add({.id = "file.export",
             .menu = menu,
             .text = tr("Export result…"),
             .tip = tr("Writes the shown result: HDF5, PFM, TIFF or PLY"),
             .icon = "export",
             .keys = {tr("Ctrl+E")},
             .run = [&window] { window.exporter().exportShownDialog(); },
             .begins_group = true});
  table.add({.id = "file.save_picture",
             .menu = menu,
             .text = tr("Save picture…"),
             .tip = tr("Writes the view with its overlay as PNG"),
             .icon = "save",
             .keys = {tr("Ctrl+Shift+E")},
             .run = [&window] { window.exporter().savePictureDialog(); }});
  table.add({.id = "file.save_map",
             .menu = menu,
             .text = tr("Save map…"),
             .tip = tr("Writes the map that is drawn over the view as PNG, by itself"),
             .icon = "",
             .keys = {},
             .run = [&window] { window.exporter().saveMapDialog(); }});
  table.add({.id = "file.close",
             .menu = menu,
             .text = tr("Close"),
             .tip = tr("Closes the light field"),
             .icon = "",
             .keys = {tr("Ctrl+W")},
             .run = [&opener] { opener.closeScene(); },
             .begins_group = true});
  table.add({.id = "file.quit",
             .menu = menu,
             .text = tr("Quit"),
             .tip = tr("Ends Episcope"),
             .icon = "",
             .keys = {tr("Ctrl+Q")},
             .run = [&window] { window.close(); }});
}

void add_estimate_actions(ActionTable& table, MainWindow& window) {
  EstimateController& estimate = window.estimate();
  const QString menu = tr("Estimate");
  table.add({.id = "estimate.run",
             .menu = menu,
             .text = tr("Run"),
             .tip = tr("Runs the chosen method with the parameters of the form"),
             .icon = "run",
             .keys = {Qt::Key_F5, tr("Ctrl+Return")},
             .run = [&estimate] { estimate.run(); }});
  table.add({.id = "estimate.cancel",
             .menu = menu,
             .text = tr("Cancel or end"),
             .tip = tr("Ends what is in hand, then cancels the running job"),
             .icon = "stop",
             .keys = {Qt::Key_Escape},
             .run = [&window] { window.escape(); }});
  table.add({.id = "estimate.copy_command",
             .menu = menu,
             .text = tr("Copy as command"),
             .tip = tr("Copies the command line that does what the form says"),
             .icon = "copy",
             .keys = {tr("Ctrl+Shift+C")},
             .run = [&estimate] { estimate.copyCommand(); }});
  table.add({.id = "estimate.next",
             .menu = menu,
             .text = tr("Next result"),
             .tip = tr("Shows the next result of the list"),
             .icon = "",
             .keys = {tr("Ctrl+PgDown")},
             .run = [&estimate] { estimate.showNeighbour(1); },
             .begins_group = true});
  table.add({.id = "estimate.previous",
             .menu = menu,
             .text = tr("Previous result"),
             .tip = tr("Shows the previous result of the list"),
             .icon = "",
             .keys = {tr("Ctrl+PgUp")},
             .run = [&estimate] { estimate.showNeighbour(-1); }});
  table.add({.id = "estimate.remove",
             .menu = menu,
             .text = tr("Remove result"),
             .tip = tr("Removes the shown result from the list"),
             .icon = "trash",
             .keys = {tr("Ctrl+Delete")},
             .run = [&estimate] { estimate.removeShown(); }});
}

void add_tab_actions(ActionTable& table, MainWindow& window) {
  const char* tabs[] = {"estimate", "compare", "annotate", "cloud"};
  const QString texts[] = {tr("Estimate tab"), tr("Compare tab"), tr("Annotate tab"), tr("3D tab")};
  const QString tips[] = {tr("Shows methods and results"), tr("Shows the table of metrics"),
                          tr("Shows labels and tools to paint"),
                          tr("Shows the result as a point cloud")};
  for (int i = 0; i < 4; ++i) {
    table.add({.id = QString("tab.%1").arg(tabs[i]),
               .menu = tr("View"),
               .text = texts[i],
               .tip = tips[i],
               .icon = i == 3 ? "cube" : "",
               .keys = {tr("Ctrl+%1").arg(i + 1)},
               .run = [&window, i] { window.panels().tabs->setCurrentIndex(i); },
               .begins_group = i == 0});
  }
}

void add_help_actions(ActionTable& table, MainWindow& window) {
  const QString menu = tr("Help");
  table.add({.id = "help.keys",
             .menu = menu,
             .text = tr("Keys and mouse"),
             .tip = tr("Lists every key and mouse gesture"),
             .icon = "help",
             .keys = {Qt::Key_F1, Qt::Key_Question},
             .run = [&window] { window.showShortcuts(); }});
  table.add({.id = "help.palette",
             .menu = menu,
             .text = tr("Find a command…"),
             .tip = tr("Finds any command by its name"),
             .icon = "",
             .keys = {tr("Ctrl+Shift+P")},
             .run = [&window] { window.showPalette(); }});
  table.add({.id = "help.about",
             .menu = menu,
             .text = tr("About Episcope"),
             .tip = tr("Tells version and licence"),
             .icon = "info",
             .keys = {},
             .run = [&window] { window.showAbout(); }});
}

}  // namespace

void add_actions(ActionTable& table, MainWindow& window) {
  add_file_actions(table, window);
  add_browse_actions(table, window);
  add_estimate_actions(table, window);
  add_compare_actions(table, window);
  add_annotate_actions(table, window);
  add_segment_actions(table, window);
  add_tab_actions(table, window);
  add_theme_actions(table);
  add_help_actions(table, window);
}

}  // namespace episcope
