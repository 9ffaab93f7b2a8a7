// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/layout.h"

#include "app/gui/frame/commands.h"
#include "app/gui/frame/frame.h"
#include "app/gui/frame/panes.h"
#include "app/gui/stage/stage.h"

#include <QSettings>

namespace episcope {
namespace {

constexpr const char* kPanelsHidden = "layout/panels_hidden";

}  // namespace

Layout::Layout(const Workbench& bench, QMainWindow& window)
    : QObject(&window), bench_(bench), window_(window), sizes_(window) {
  Panes& panes = bench.frame.panes();
  bench.stage.addPanesTo(panes);
  addScreenCommands();
  addPaneCommands();
  addStackCommands();
  connect(&panes, &Panes::opened, &bench.commands, &Commands::hearViewerKeys);
  connect(&panes, &Panes::changed, &bench.commands, &Commands::refresh);
  connect(&bench.frame, &Frame::started, this, [this] {
    bench_.frame.setPanelsShown(!QSettings().value(kPanelsHidden).toBool());
    bench_.frame.panes().restore();
    bench_.commands.refresh();
  });
}

void Layout::save() const {
  sizes_.save();
  bench_.frame.panes().save();
  QSettings().setValue(kPanelsHidden, !bench_.frame.arePanelsShown());
}

void Layout::toggleFullScreen() {
  window_.setWindowState(window_.windowState() ^ Qt::WindowFullScreen);
  bench_.commands.refresh();
}

void Layout::addScreenCommands() {
  bench_.commands.add({.id = "view.full_screen",
                       .menu = Menu::View,
                       .text = tr("Full screen"),
                       .tip = tr("Fills the screen with the window, or gives it back"),
                       .keys = {Qt::Key_F11},
                       .run = [this] { toggleFullScreen(); },
                       .section = section::kTabs,
                       .checked = [this] { return window_.isFullScreen(); }});
  bench_.commands.add({.id = "view.panels",
                       .menu = Menu::View,
                       .text = tr("Side panels"),
                       .tip = tr("Shows the views at the left and the tabs at the right; without "
                                 "them, the view has all the room"),
                       .keys = {tr("Shift+F11")},
                       .run =
                           [this] {
                             Frame& frame = bench_.frame;
                             frame.setPanelsShown(!frame.arePanelsShown());
                             bench_.commands.refresh();
                           },
                       .section = section::kTabs,
                       .checked = [this] { return bench_.frame.arePanelsShown(); }});
}

void Layout::addPaneCommands() {
  Panes& panes = bench_.frame.panes();
  bench_.commands.add({.id = "panes.tab",
                       .menu = Menu::Panes,
                       .text = tr("Tab in its own window"),
                       .tip = tr("Gives the tab that is shown a window of its own; closing that "
                                 "brings it back. So does a double click on the tab"),
                       .keys = {Qt::Key_F6},
                       .run = [&panes, this] { panes.tear("tab." + bench_.frame.shownTab()); }});
  const auto add_epi = [&panes, this](const QString& id, const QString& text, const QString& tip,
                                      Qt::Key key) {
    bench_.commands.add({.id = "panes." + id,
                         .menu = Menu::Panes,
                         .text = text,
                         .tip = tip,
                         .keys = {key},
                         .run = [&panes, id] { panes.toggle(id); },
                         .checked = [&panes, id] { return panes.isTorn(id); }});
  };
  add_epi("epi.horizontal", tr("Horizontal EPI in its own window"),
          tr("Gives the horizontal EPI a window of its own, or takes it back"), Qt::Key_F7);
  add_epi("epi.vertical", tr("Vertical EPI in its own window"),
          tr("Gives the vertical EPI a window of its own, or takes it back"), Qt::Key_F8);
  bench_.commands.add({.id = "panes.reset",
                       .menu = Menu::Panes,
                       .text = tr("Reset layout"),
                       .tip = tr("Brings all panes back and divides the window as at first"),
                       .keys = {tr("Ctrl+Shift+F11")},
                       .run = [this] { reset(); },
                       .section = 2});
}

void Layout::addStackCommands() {
  Panes& panes = bench_.frame.panes();
  bench_.commands.add({.id = "panes.stack_tab",
                       .menu = Menu::Panes,
                       .text = tr("Tab below the others"),
                       .tip = tr("Puts the tab that is shown into a second set of tabs below the "
                                 "others, so that both are seen; its cross brings it back"),
                       .keys = {tr("Shift+F6")},
                       .run =
                           [&panes, this] {
                             bench_.frame.setPanelsShown(true);
                             panes.stack("tab." + bench_.frame.shownTab());
                           },
                       .section = 1});
  const auto add_stacked = [this, &panes](const QString& id, const QString& text,
                                          const QString& tip, const QString& key) {
    bench_.commands.add({.id = "panes.stack." + id,
                         .menu = Menu::Panes,
                         .text = text,
                         .tip = tip,
                         .keys = {key},
                         .run =
                             [&panes, this, id] {
                               bench_.frame.setPanelsShown(true);
                               panes.toggleStacked(id);
                             },
                         .section = 1,
                         .checked = [&panes, id] { return panes.isStacked(id); }});
  };
  add_stacked("epi.horizontal", tr("Horizontal EPI below the tabs"),
              tr("Puts the horizontal EPI into the tabs below the others, or takes it back"),
              tr("Shift+F7"));
  add_stacked("epi.vertical", tr("Vertical EPI below the tabs"),
              tr("Puts the vertical EPI into the tabs below the others, or takes it back"),
              tr("Shift+F8"));
}

void Layout::reset() {
  if (window_.isFullScreen()) toggleFullScreen();
  bench_.frame.setPanelsShown(true);
  bench_.frame.panes().reset();
  sizes_.reset();
  bench_.frame.resetLayout();
  bench_.commands.refresh();
}

}  // namespace episcope

#include "moc_layout.cpp"
