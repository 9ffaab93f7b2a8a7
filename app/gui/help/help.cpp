// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/help/help.h"

#include "app/gui/frame/commands.h"
#include "app/gui/help/command_palette.h"
#include "app/gui/help/language_choice.h"
#include "app/gui/help/shortcut_window.h"
#include "app/gui/help/theme_choice.h"
#include "engine/core/version.h"
#include "widgets/style/icon.h"

#include <QCoreApplication>
#include <QMessageBox>

namespace episcope {
namespace {

constexpr int kIconSize = 64;

struct Text {
  Q_DECLARE_TR_FUNCTIONS(episcope::Help)
};

void show_shortcuts(Commands& commands, QWidget& window) {
  auto* shortcuts = window.findChild<ShortcutWindow*>();
  if (!shortcuts) shortcuts = new ShortcutWindow(commands, &window);
  shortcuts->show();
  shortcuts->raise();
}

void show_about(QWidget& window) {
  auto* box = new QMessageBox(
      QMessageBox::NoIcon, Text::tr("About Episcope"),
      Text::tr("<b>Episcope %1</b><p>Views, EPIs, disparity and labels of 4D light fields.</p>"
               "<p>BSD 3-Clause licence.</p>")
          .arg(kVersion),
      QMessageBox::Close, &window);
  box->setObjectName("about");
  box->setIconPixmap(program_icon().pixmap(kIconSize));
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->open();
}

}  // namespace

void add_help(const Workbench& bench) {
  Commands& commands = bench.commands;
  QWidget& window = bench.window;
  auto* palette = new CommandPalette(commands, &window);
  add_theme_commands(commands);
  add_language_commands(commands, bench.messages);
  commands.add({.id = "help.keys",
                .menu = Menu::Help,
                .text = Text::tr("Keys and mouse"),
                .tip = Text::tr("Lists every key and mouse gesture"),
                .icon = "help",
                .keys = {Qt::Key_F1, Qt::Key_Question},
                .run = [&commands, &window] { show_shortcuts(commands, window); },
                .bar = BarSection::Help});
  commands.add({.id = "help.palette",
                .menu = Menu::Help,
                .text = Text::tr("Find a command…"),
                .tip = Text::tr("Finds any command by its name"),
                .keys = {Text::tr("Ctrl+Shift+P")},
                .run = [palette] { palette->popUp(); }});
  commands.add({.id = "help.about",
                .menu = Menu::Help,
                .text = Text::tr("About Episcope"),
                .tip = Text::tr("Shows version and licence"),
                .icon = "info",
                .run = [&window] { show_about(window); }});
}

}  // namespace episcope
