// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/browse/browse_controller.h"
#include "app/gui/frame/commands.h"
#include "app/gui/stage/stage.h"
#include "widgets/browse/view_grid.h"
#include "widgets/canvas/view_canvas.h"

#include <QAction>

namespace episcope {

void BrowseController::addStep(const QString& id, const QString& text, const QString& tip, int dv,
                               int du, Qt::Key key) {
  bench_.commands.add({.id = "view." + id,
                       .menu = Menu::Views,
                       .text = text,
                       .tip = tip,
                       .keys = {QKeySequence(key)},
                       .run = [this, dv, du] { step(dv, du); },
                       .section = section::kWalk});
  bench_.commands.add({.id = "view." + id + "_most",
                       .menu = Menu::Views,
                       .text = tr("%1, to the end").arg(text),
                       .tip = tr("%1, at the end of the grid").arg(tip),
                       .keys = {QKeySequence(Qt::ShiftModifier | key)},
                       .run = [this, dv, du] { jump(dv, du); },
                       .section = section::kWalk});
}

void BrowseController::addWalkCommands() {
  addStep("left", tr("View to the left"), tr("Shows the view to the left"), 0, -1, Qt::Key_Left);
  addStep("right", tr("View to the right"), tr("Shows the view to the right"), 0, 1, Qt::Key_Right);
  addStep("up", tr("View above"), tr("Shows the view above"), -1, 0, Qt::Key_Up);
  addStep("down", tr("View below"), tr("Shows the view below"), 1, 0, Qt::Key_Down);
  bench_.commands.add({.id = "view.center",
                       .menu = Menu::Views,
                       .text = tr("Centre view"),
                       .tip = tr("Shows the view in the middle of the grid"),
                       .keys = {Qt::Key_Home},
                       .run = [this] { goToCenter(); },
                       .section = section::kWalk});
  QAction* play = bench_.commands.add({.id = "view.play",
                                       .menu = Menu::Views,
                                       .text = tr("Play"),
                                       .tip = tr("Plays the views one after the other, or pauses"),
                                       .icon = "play",
                                       .keys = {Qt::Key_Space},
                                       .run = [this] { togglePlay(); },
                                       .section = section::kWalk,
                                       .scope = KeyScope::Viewer});
  grid_->followTip(play);
}

void BrowseController::addZoom(const QString& id, const QString& text, const QString& tip,
                               const QString& icon, const QList<QKeySequence>& keys,
                               void (ViewCanvas::*zoom)()) {
  bench_.commands.add({.id = "view." + id,
                       .menu = Menu::View,
                       .text = text,
                       .tip = tip,
                       .icon = icon,
                       .keys = keys,
                       .run = [this, zoom] { (stage_.activeCanvas()->*zoom)(); },
                       .section = section::kZoom});
}

void BrowseController::addZoomCommands() {
  addZoom("zoom_in", tr("Zoom in"), tr("Enlarges the picture"), {},
          {Qt::Key_Plus, Qt::Key_Equal, tr("Ctrl++")}, &ViewCanvas::zoomIn);
  addZoom("zoom_out", tr("Zoom out"), tr("Shrinks the picture"), {}, {Qt::Key_Minus, tr("Ctrl+-")},
          &ViewCanvas::zoomOut);
  addZoom("fit", tr("Fit"), tr("Fits the whole picture into its pane"), "fit", {Qt::Key_K},
          &ViewCanvas::zoomToFit);
  addZoom("actual_size", tr("100 %"), tr("Shows each image pixel as one screen pixel"), {},
          {tr("Ctrl+0")}, &ViewCanvas::zoomToActualSize);
}

void BrowseController::addFocusCommands() {
  const auto add = [this](const QString& id, const QString& text, const QString& tip,
                          const QKeySequence& key, std::function<void()> run) {
    bench_.commands.add({.id = id,
                         .menu = Menu::View,
                         .text = text,
                         .tip = tip,
                         .keys = {key},
                         .run = std::move(run),
                         .section = section::kFocus});
  };
  add("view.focus_nearer", tr("Focus nearer"), tr("Moves the focus plane to larger disparities"),
      tr("Ctrl+Alt+Up"), [this] { stepFocus(1); });
  add("view.focus_farther", tr("Focus farther"), tr("Moves the focus plane to smaller disparities"),
      tr("Ctrl+Alt+Down"), [this] { stepFocus(-1); });
  add("view.focus_reset", tr("Focus at zero"), tr("Moves the focus plane back to zero disparity"),
      tr("Ctrl+Alt+0"), [this] { resetFocus(); });
  bench_.commands.add({.id = "view.refocus",
                       .menu = Menu::View,
                       .text = tr("Refocus the view"),
                       .tip = tr("Refocuses the view too, as the mean of all views at the focus "
                                 "plane; otherwise only the EPIs are sheared"),
                       .run = [this] { setRefocusing(!refocuses_); },
                       .section = section::kFocus,
                       .checked = [this] { return refocuses_; }});
}

void BrowseController::addCommands() {
  addWalkCommands();
  addZoomCommands();
  addFocusCommands();
}

}  // namespace episcope
