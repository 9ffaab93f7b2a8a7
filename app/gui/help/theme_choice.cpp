// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/help/theme_choice.h"

#include "app/gui/frame/commands.h"
#include "app/gui/main_window.h"
#include "widgets/style/outlined_style.h"
#include "widgets/style/theme.h"

#include <QAction>
#include <QActionGroup>
#include <QApplication>
#include <QSettings>
#include <QStyle>

namespace episcope {
namespace {

constexpr const char* kSetting = "theme";
constexpr const char* kApplied = "episcope.theme";  // property of the application

QString tr(const char* source) {
  return MainWindow::tr(source);
}

struct Theme {
  const char* name;
  const char* text;
  const char* tip;
};

constexpr Theme kThemes[] = {
    {"system", QT_TRANSLATE_NOOP("episcope::MainWindow", "As the desktop"),
     QT_TRANSLATE_NOOP("episcope::MainWindow", "Colours of the desktop")},
    {"light", QT_TRANSLATE_NOOP("episcope::MainWindow", "Light"),
     QT_TRANSLATE_NOOP("episcope::MainWindow", "Dark text on light ground")},
    {"dark", QT_TRANSLATE_NOOP("episcope::MainWindow", "Dark"),
     QT_TRANSLATE_NOOP("episcope::MainWindow", "Light text on dark ground")}};

}  // namespace

bool apply_theme(const QString& name) {
  const bool is_own = name == "light" || name == "dark";
  if (!is_own && name != "system") return false;
  if (is_own || QApplication::style()->name() == "fusion") {
    QApplication::setStyle(new OutlinedStyle);
  }
  const QString before = qApp->property(kApplied).toString();
  if (is_own) {
    QApplication::setPalette(name == "light" ? theme::light_palette() : theme::dark_palette());
  } else if (!before.isEmpty()) {
    QApplication::setPalette(QPalette());
  }
  qApp->setProperty(kApplied, name);
  return true;
}

QString remembered_theme() {
  const QString name = QSettings().value(kSetting).toString();
  return name == "light" || name == "dark" ? name : QString("system");
}

void add_theme_actions(ActionTable& table) {
  auto* themes = new QActionGroup(&table);
  const QString applied = qApp->property(kApplied).toString();
  for (const Theme& theme : kThemes) {
    const QString name = theme.name;
    QAction* action = table.add({.id = "theme." + name,
                                 .menu = tr("View › Colours"),
                                 .text = tr(theme.text),
                                 .tip = tr(theme.tip),
                                 .icon = "",
                                 .keys = {},
                                 .run =
                                     [name] {
                                       if (apply_theme(name)) QSettings().setValue(kSetting, name);
                                     },
                                 .is_checkable = true});
    themes->addAction(action);
    action->setChecked(name == (applied.isEmpty() ? QString("system") : applied));
  }
}

}  // namespace episcope
