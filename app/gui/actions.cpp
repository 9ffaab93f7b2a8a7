// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/actions.h"

#include "app/gui/action_table.h"
#include "app/gui/browse_actions.h"
#include "app/gui/estimate_controller.h"
#include "app/gui/export_controller.h"
#include "app/gui/main_window.h"
#include "app/gui/open_controller.h"
#include "app/gui/overlay_controller.h"
#include "app/session/session.h"

#include <QAction>
#include <QTabWidget>

namespace episcope {
namespace {

using render::Quantity;

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
  table.add({.id = "file.export",
             .menu = menu,
             .text = tr("Export result…"),
             .tip = tr("Writes the shown result: HDF5, PFM, TIFF or PLY"),
             .icon = "export",
             .keys = {QKeySequence::Save},
             .run = [&window] { window.exporter().exportShownDialog(); },
             .begins_group = true});
  table.add({.id = "file.save_picture",
             .menu = menu,
             .text = tr("Save picture…"),
             .tip = tr("Writes the view with its overlay as PNG"),
             .icon = "save",
             .keys = {tr("Ctrl+Shift+S")},
             .run = [&window] { window.exporter().savePictureDialog(); }});
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

void add_overlay(ActionTable& table, OverlayController& overlay, const QString& id,
                 const QString& text, const QString& tip, Quantity quantity) {
  table.add({.id = id,
             .menu = tr("Compare"),
             .text = text,
             .tip = tip,
             .icon = "",
             .keys = {},
             .run = [&overlay, quantity] { overlay.setQuantity(quantity); },
             .is_checkable = true});
}

void add_overlay_actions(ActionTable& table, MainWindow& window) {
  OverlayController& overlay = window.overlay();
  const auto add = [&](const char* id, const QString& text, const QString& tip, Quantity quantity) {
    add_overlay(table, overlay, id, text, tip, quantity);
  };
  add("overlay.none", tr("None"), tr("Shows the view alone"), Quantity::View);
  add("overlay.disparity", tr("Disparity"), tr("Shows the disparity of the result over the view"),
      Quantity::Disparity);
  add("overlay.confidence", tr("Confidence"), tr("Shows how sure the method is, from 0 to 1"),
      Quantity::Confidence);
  add("overlay.truth", tr("Truth"), tr("Shows the true disparity"), Quantity::Truth);
  add("overlay.signed_error", tr("Error"),
      tr("Shows truth − estimate: blue is too near, red too far"), Quantity::SignedError);
  add("overlay.absolute_error", tr("|Error|"), tr("Shows the size of the error"),
      Quantity::AbsoluteError);
  add("overlay.bad_pixels", tr("Bad"), tr("Shows the pixels that are off by more than 0.07 px"),
      Quantity::BadPixels);
  add("overlay.labels", tr("Labels"), tr("Shows the true object labels"), Quantity::Labels);
}

void add_compare_actions(ActionTable& table, MainWindow& window) {
  OverlayController& overlay = window.overlay();
  const QString menu = tr("Compare");
  table.add({.id = "compare.next_map",
             .menu = menu,
             .text = tr("Next map"),
             .tip = tr("Shows the next map over the view"),
             .icon = "",
             .keys = {Qt::Key_M},
             .run = [&overlay] { overlay.selectNextQuantity(); },
             .begins_group = true});
  table.add({.id = "compare.difference",
             .menu = menu,
             .text = tr("Difference of two results"),
             .tip = tr("Shows the shown result minus the one shown before"),
             .icon = "",
             .keys = {Qt::Key_D},
             .run = [&overlay] { overlay.setDifference(!overlay.showsDifference()); },
             .is_checkable = true});
  table.add({.id = "compare.swap",
             .menu = menu,
             .text = tr("Flip to the other result"),
             .tip = tr("Shows the result shown before; Tab held in the view flips meanwhile"),
             .icon = "",
             .keys = {Qt::Key_QuoteLeft},
             .run = [&window] {
               if (const EstimateEntry* other = window.session().compared()) {
                 window.session().show_estimate(other->id);
               }
             }});
  table.add({.id = "compare.auto_range",
             .menu = menu,
             .text = tr("Automatic range"),
             .tip = tr("Stretches the colours over the values of this map"),
             .icon = "auto",
             .keys = {Qt::Key_A},
             .run = [&overlay] { overlay.useAutomaticRange(); },
             .begins_group = true});
  table.add({.id = "compare.own_range",
             .menu = menu,
             .text = tr("Own range"),
             .tip = tr("Back to the range that belongs to the quantity"),
             .icon = "reset",
             .keys = {Qt::Key_R},
             .run = [&overlay] { overlay.useOwnRange(); }});
  const char* tabs[] = {"estimate", "compare", "cloud"};
  const QString texts[] = {tr("Estimate tab"), tr("Compare tab"), tr("3D tab")};
  const QString tips[] = {tr("Shows methods and results"), tr("Shows the table of metrics"),
                          tr("Shows the result as a point cloud")};
  for (int i = 0; i < 3; ++i) {
    table.add({.id = QString("tab.%1").arg(tabs[i]),
               .menu = tr("View"),
               .text = texts[i],
               .tip = tips[i],
               .icon = i == 2 ? "cube" : "",
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
  add_overlay_actions(table, window);
  add_compare_actions(table, window);
  add_help_actions(table, window);
}

const std::vector<std::pair<QString, Quantity>>& overlay_actions() {
  static const std::vector<std::pair<QString, Quantity>> actions = {
      {"overlay.none", Quantity::View},
      {"overlay.disparity", Quantity::Disparity},
      {"overlay.confidence", Quantity::Confidence},
      {"overlay.truth", Quantity::Truth},
      {"overlay.signed_error", Quantity::SignedError},
      {"overlay.absolute_error", Quantity::AbsoluteError},
      {"overlay.bad_pixels", Quantity::BadPixels},
      {"overlay.labels", Quantity::Labels}};
  return actions;
}

}  // namespace episcope
