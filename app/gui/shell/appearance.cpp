// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/appearance.h"

#include "app/gui/shell/commands.h"
#include "app/gui/shell/frame.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/theme.h"

#include <QAction>
#include <QApplication>
#include <QCoreApplication>
#include <QDir>
#include <QLibraryInfo>
#include <QLocale>
#include <QRegularExpression>
#include <QSettings>
#include <QStyle>
#include <QTranslator>

#include <clocale>
#include <memory>

namespace episcope {
namespace {

constexpr const char* kThemeContext = "episcope::Theme";
constexpr const char* kThemeSetting = "theme";
constexpr const char* kApplied = "episcope.theme";  // property of the application

struct Theme {
  const char* name;
  const char* text;
  const char* tip;
};

constexpr Theme kThemes[] = {
    {"system", QT_TRANSLATE_NOOP("episcope::Theme", "Follow the desktop"),
     QT_TRANSLATE_NOOP("episcope::Theme", "Colors of the desktop")},
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
  const QString name = QSettings().value(kThemeSetting).toString();
  return name == "light" || name == "dark" ? name : QString("system");
}

void add_theme_commands(Commands& commands) {
  for (const Theme& theme : kThemes) {
    const QString name = theme.name;
    commands.add({.id = "theme." + name,
                  .menu = Menu::Colors,
                  .text = QCoreApplication::translate(kThemeContext, theme.text),
                  .tip = QCoreApplication::translate(kThemeContext, theme.tip),
                  .run =
                      [name] {
                        if (apply_theme(name)) QSettings().setValue(kThemeSetting, name);
                      },
                  .checked =
                      [name] {
                        const QString applied = qApp->property(kApplied).toString();
                        return name == (applied.isEmpty() ? QString("system") : applied);
                      },
                  .choice = "theme"});
  }
}

}  // namespace episcope

// Q_INIT_RESOURCE works in the global namespace only.
static void init_translations() {
  Q_INIT_RESOURCE(translations);
}

namespace episcope {
namespace {

constexpr const char* kEnglish = "en";
constexpr const char* kSystem = "system";
constexpr const char* kLanguageSetting = "language";
constexpr const char* kTranslator = "episcope.translator";
constexpr const char* kFolder = ":/episcope/translations";

struct LanguageText {
  Q_DECLARE_TR_FUNCTIONS(episcope::Language)
};

void add_translator(const QString& file, const QString& folder) {
  auto* translator = named(kTranslator, new QTranslator(QCoreApplication::instance()));
  if (translator->load(file, folder)) {
    QCoreApplication::installTranslator(translator);
  } else {
    delete translator;
  }
}

void remove_translators() {
  qDeleteAll(QCoreApplication::instance()->findChildren<QTranslator*>(kTranslator));
}

// Dates follow the desktop, unless the window has another language.
QLocale locale_for(const QString& code) {
  const QLocale desktop = QLocale::system();
  const bool is_same = desktop.language() == QLocale(code).language() ||
                       (desktop.language() == QLocale::C && code == kEnglish);
  return is_same ? desktop : QLocale(code);
}

QString native_name(const QString& code) {
  // Qt calls English of no country "American English".
  return code == kEnglish ? QString("English") : QLocale(code).nativeLanguageName();
}

// `chosen` is shared by all choices: settings and translations are not read at every refresh.
void add_choice(Commands& commands, Messages& messages, const std::shared_ptr<QString>& chosen,
                const QString& name, const QString& text, const QString& tip) {
  const auto choose = [&commands, &messages, chosen, name] {
    QSettings().setValue(kLanguageSetting, name);
    *chosen = name;
    commands.refresh();
    messages.hint(
        LanguageText::tr("The window will be in this language when Episcope starts again."));
  };
  commands.add({.id = "language." + name,
                .menu = Menu::Language,
                .text = text,
                .tip = tip,
                .run = choose,
                .checked = [chosen, name] { return name == *chosen; },
                .choice = "language"});
}

}  // namespace

QStringList languages() {
  init_translations();
  QStringList codes;
  for (const QString& file : QDir(kFolder).entryList({"*.qm"}, QDir::Files, QDir::Name)) {
    codes << file.section('.', 0, 0);
  }
  if (!codes.contains(kEnglish)) codes << kEnglish;
  return codes;
}

QString language_for(const QStringList& wanted, const QStringList& languages) {
  static const QRegularExpression separator("[-_.@]");
  for (const QString& each : wanted) {
    const QString code = each.section(separator, 0, 0);
    if (code == "C" || code == "POSIX") break;
    if (languages.contains(code)) return code;
  }
  return kEnglish;
}

bool apply_language(const QString& name) {
  const QStringList known = languages();
  if (name != kSystem && !known.contains(name)) return false;
  const QString code =
      name == kSystem ? language_for(QLocale::system().uiLanguages(), known) : name;
  remove_translators();
  // What Qt says, completely where it is installed; of ours the most frequent, and the keys.
  if (code != kEnglish) {
    add_translator("qtbase_" + code, QLibraryInfo::path(QLibraryInfo::TranslationsPath));
  }
  add_translator(code, kFolder);
  QLocale::setDefault(locale_for(code));
  std::setlocale(LC_NUMERIC, "C");
  return true;
}

QString remembered_language() {
  const QString name = QSettings().value(kLanguageSetting).toString();
  return languages().contains(name) ? name : QString(kSystem);
}

void add_language_commands(Commands& commands, Messages& messages) {
  const auto chosen = std::make_shared<QString>(remembered_language());
  add_choice(commands, messages, chosen, kSystem, LanguageText::tr("Follow the desktop"),
             LanguageText::tr("The language of the desktop"));
  for (const QString& code : languages()) {
    const QString name = native_name(code);
    add_choice(commands, messages, chosen, code, name,
               LanguageText::tr("Shows the window in %1").arg(name));
  }
}

}  // namespace episcope
