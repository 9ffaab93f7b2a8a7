// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>
#include <QStringList>

namespace episcope {

class Commands;
class Messages;

/// Applies a theme: "light", "dark", or "system" for the desktop's colors. Returns false for any
/// other name and changes nothing.
bool apply_theme(const QString& name);

/// Theme chosen last in the menu; "system" by default.
[[nodiscard]] QString remembered_theme();

/// Adds commands that choose and remember the theme.
void add_theme_commands(Commands& commands);

/// Codes of the languages in this build, with "en". Only English if Qt's translation tools were
/// missing.
[[nodiscard]] QStringList languages();

/// Best match among `languages` for a user's preferences, best first, as of QLocale::uiLanguages():
/// "de-AT", "C". English if none matches.
[[nodiscard]] QString language_for(const QStringList& wanted, const QStringList& languages);

/// Translates all texts made from now on: "de", …, or "system" for the desktop's language
/// (LANGUAGE, LC_ALL, LC_MESSAGES, LANG). Numbers keep the decimal point, as in files and on
/// command lines, also in the C library. Returns false for a language missing in this build and
/// changes nothing.
bool apply_language(const QString& name);

/// Language chosen last in the menu; "system" by default.
[[nodiscard]] QString remembered_language();

/// Adds commands that choose and remember the language of the next start.
void add_language_commands(Commands& commands, Messages& messages);

}  // namespace episcope
