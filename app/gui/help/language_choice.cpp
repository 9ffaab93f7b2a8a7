// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/help/language_choice.h"

#include "app/gui/frame/commands.h"
#include "app/gui/frame/messages.h"

#include <QAction>
#include <QCoreApplication>
#include <QDir>
#include <QLibraryInfo>
#include <QLocale>
#include <QRegularExpression>
#include <QSettings>
#include <QTranslator>

#include <clocale>
#include <memory>

// Q_INIT_RESOURCE works in the global namespace only.
static void init_translations() {
  Q_INIT_RESOURCE(translations);
}

namespace episcope {
namespace {

constexpr const char* kEnglish = "en";
constexpr const char* kSystem = "system";
constexpr const char* kSetting = "language";
constexpr const char* kTranslator = "episcope.translator";
constexpr const char* kFolder = ":/episcope/translations";

struct Text {
  Q_DECLARE_TR_FUNCTIONS(episcope::Language)
};

void add_translator(const QString& file, const QString& folder) {
  auto* translator = new QTranslator(QCoreApplication::instance());
  translator->setObjectName(kTranslator);
  if (translator->load(file, folder)) {
    QCoreApplication::installTranslator(translator);
  } else {
    delete translator;
  }
}

void remove_translators() {
  qDeleteAll(QCoreApplication::instance()->findChildren<QTranslator*>(kTranslator));
}

// Of dates: that of the desktop, unless the window speaks another language.
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
    QSettings().setValue(kSetting, name);
    *chosen = name;
    commands.refresh();
    messages.hint(Text::tr("The window will be in this language when Episcope starts again."));
  };
  commands.add({.id = "language." + name,
                .menu = Menu::Language,
                .text = text,
                .tip = tip,
                .run = choose,
                .checked = [chosen, name] { return name == *chosen; }});
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
  const QString name = QSettings().value(kSetting).toString();
  return languages().contains(name) ? name : QString(kSystem);
}

void add_language_commands(Commands& commands, Messages& messages) {
  const auto chosen = std::make_shared<QString>(remembered_language());
  add_choice(commands, messages, chosen, kSystem, Text::tr("Follow the desktop"),
             Text::tr("The language of the desktop"));
  for (const QString& code : languages()) {
    const QString name = native_name(code);
    add_choice(commands, messages, chosen, code, name,
               Text::tr("Shows the window in %1").arg(name));
  }
}

}  // namespace episcope
