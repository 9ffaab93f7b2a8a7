// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/help/theme_choice.h"

#include "app/gui/frame/commands.h"
#include "widgets/style/outlined_style.h"
#include "widgets/style/theme.h"

#include <QAction>
#include <QApplication>
#include <QSettings>
#include <QStyle>

namespace episcope {
namespace {

constexpr const char* kContext = "episcope::Theme";
constexpr const char* kSetting = "theme";
constexpr const char* kApplied = "episcope.theme";  // property of the application

struct Theme {
  const char* name;
  const char* text;
  const char* tip;
};

constexpr Theme kThemes[] = {
    {"system", QT_TRANSLATE_NOOP("episcope::Theme", "Follow the desktop"),
     QT_TRANSLATE_NOOP("episcope::Theme", "Colours of the desktop")},
    {"light", QT_TRANSLATE_NOOP("episcope::Theme", "Light"),
     QT_TRANSLATE_NOOP("episcope::Theme", "Dark text on a light background")},
    {"dark", QT_TRANSLATE_NOOP("episcope::Theme", "Dark"),
     QT_TRANSLATE_NOOP("episcope::Theme", "Light text on a dark background")}};

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

void add_theme_commands(Commands& commands) {
  for (const Theme& theme : kThemes) {
    const QString name = theme.name;
    commands.add({.id = "theme." + name,
                  .menu = Menu::Colours,
                  .text = QCoreApplication::translate(kContext, theme.text),
                  .tip = QCoreApplication::translate(kContext, theme.tip),
                  .run =
                      [name] {
                        if (apply_theme(name)) QSettings().setValue(kSetting, name);
                      },
                  .checked =
                      [name] {
                        const QString applied = qApp->property(kApplied).toString();
                        return name == (applied.isEmpty() ? QString("system") : applied);
                      }});
  }
}

}  // namespace episcope
