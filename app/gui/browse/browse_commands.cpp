// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/browse_actions.h"

#include "app/gui/browse/browse_controller.h"
#include "app/gui/compare/compare_controller.h"
#include "app/gui/files/focus_controller.h"
#include "app/gui/frame/commands.h"
#include "app/gui/main_window.h"
#include "widgets/canvas/view_canvas.h"

#include <QAction>

namespace episcope {
namespace {

QString tr(const char* source) {
  return MainWindow::tr(source);
}

void add_step(ActionTable& table, BrowseController& browse, const char* id, const QString& text,
              const QString& tip, int dv, int du, QKeySequence key, QKeySequence jump_key) {
  table.add({.id = QString("view.%1").arg(id),
             .menu = tr("View"),
             .text = text,
             .tip = tip,
             .icon = "",
             .keys = {key},
             .run = [&browse, dv, du] { browse.step(dv, du); },
             .scope = KeyScope::Viewer});
  table.add({.id = QString("view.%1_most").arg(id),
             .menu = tr("View"),
             .text = tr("%1, to the border").arg(text),
             .tip = tr("%1, as far as the grid goes").arg(tip),
             .icon = "",
             .keys = {jump_key},
             .run = [&browse, dv, du] { browse.jump(dv, du); },
             .scope = KeyScope::Viewer});
}

void add_walk_actions(ActionTable& table, MainWindow& window) {
  BrowseController& browse = window.browse();
  add_step(table, browse, "left", tr("View to the left"), tr("Shows the view to the left"), 0, -1,
           Qt::Key_Left, QKeySequence("Shift+Left"));
  add_step(table, browse, "right", tr("View to the right"), tr("Shows the view to the right"), 0, 1,
           Qt::Key_Right, QKeySequence("Shift+Right"));
  add_step(table, browse, "up", tr("View above"), tr("Shows the view above"), -1, 0, Qt::Key_Up,
           QKeySequence("Shift+Up"));
  add_step(table, browse, "down", tr("View below"), tr("Shows the view below"), 1, 0, Qt::Key_Down,
           QKeySequence("Shift+Down"));
  const QString menu = tr("View");
  table.add({.id = "view.center",
             .menu = menu,
             .text = tr("Centre view"),
             .tip = tr("Shows the view in the middle of the grid"),
             .icon = "",
             .keys = {Qt::Key_Home},
             .run = [&browse] { browse.goToCenter(); },
             .scope = KeyScope::Viewer});
  table.add({.id = "view.play",
             .menu = menu,
             .text = tr("Play"),
             .tip = tr("Plays the views one after the other, or pauses"),
             .icon = "play",
             .keys = {Qt::Key_Space},
             .run = [&browse] { browse.togglePlay(); },
             .scope = KeyScope::Viewer});
}

void add_zoom_actions(ActionTable& table, MainWindow& window) {
  CompareController& compare = window.compare();
  const QString menu = tr("View");
  table.add({.id = "view.zoom_in",
             .menu = menu,
             .text = tr("Zoom in"),
             .tip = tr("Shows the picture larger"),
             .icon = "",
             .keys = {Qt::Key_Plus, Qt::Key_Equal, tr("Ctrl++")},
             .run = [&compare] { compare.activeCanvas()->zoomIn(); },
             .begins_group = true});
  table.add({.id = "view.zoom_out",
             .menu = menu,
             .text = tr("Zoom out"),
             .tip = tr("Shows the picture smaller"),
             .icon = "",
             .keys = {Qt::Key_Minus, tr("Ctrl+-")},
             .run = [&compare] { compare.activeCanvas()->zoomOut(); }});
  table.add({.id = "view.fit",
             .menu = menu,
             .text = tr("Fit"),
             .tip = tr("Shows the whole picture"),
             .icon = "fit",
             .keys = {Qt::Key_K},
             .run = [&compare] { compare.activeCanvas()->zoomToFit(); }});
  table.add({.id = "view.actual_size",
             .menu = menu,
             .text = tr("100 %"),
             .tip = tr("Shows one image pixel on one pixel of the screen"),
             .icon = "",
             .keys = {tr("Ctrl+0")},
             .run = [&compare] { compare.activeCanvas()->zoomToActualSize(); }});
}

void add_focus_actions(ActionTable& table, MainWindow& window) {
  BrowseController& browse = window.browse();
  const QString menu = tr("View");
  table.add({.id = "view.focus_nearer",
             .menu = menu,
             .text = tr("Focus nearer"),
             .tip = tr("Moves the focus plane to larger disparities"),
             .icon = "",
             .keys = {tr("Ctrl+Alt+Up")},
             .run = [&browse] { browse.stepFocus(1); },
             .begins_group = true});
  table.add({.id = "view.focus_farther",
             .menu = menu,
             .text = tr("Focus farther"),
             .tip = tr("Moves the focus plane to smaller disparities"),
             .icon = "",
             .keys = {tr("Ctrl+Alt+Down")},
             .run = [&browse] { browse.stepFocus(-1); }});
  table.add({.id = "view.focus_reset",
             .menu = menu,
             .text = tr("Focus at zero"),
             .tip = tr("Moves the focus plane back to the plane of zero disparity"),
             .icon = "",
             .keys = {tr("Ctrl+Alt+0")},
             .run = [&browse] { browse.resetFocus(); }});
  FocusController& focus = window.focus();
  table.add({.id = "view.focus_apply",
             .menu = menu,
             .text = tr("Apply focus plane"),
             .tip = tr("Bakes the focus plane in: what is in focus gets disparity 0, results and "
                       "truth move along"),
             .icon = "apply",
             .keys = {tr("Ctrl+Alt+Return")},
             .run = [&focus] { focus.apply(); }});
  table.add({.id = "view.focus_undo",
             .menu = menu,
             .text = tr("Undo applied focus plane"),
             .tip = tr("Goes back to the disparities of the files"),
             .icon = "",
             .keys = {},
             .run = [&focus] { focus.undo(); }});
  QAction* refocus =
      table.add({.id = "view.refocus",
                 .menu = menu,
                 .text = tr("Refocus the view"),
                 .tip = tr("Shows the mean of all views at the focus plane, not only sheared EPIs"),
                 .icon = "",
                 .keys = {},
                 .run = {},
                 .is_checkable = true});
  refocus->setChecked(true);
  QObject::connect(refocus, &QAction::toggled, &browse, &BrowseController::setRefocusing);
}

}  // namespace

void add_browse_actions(ActionTable& table, MainWindow& window) {
  add_walk_actions(table, window);
  add_zoom_actions(table, window);
  add_focus_actions(table, window);
}

}  // namespace episcope
