// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>
#include <QStringList>

namespace episcope {

class Commands;
class Messages;

/// Colours the application: "light", "dark", or "system" for those of the desktop. False for any
/// other name, and nothing changes.
bool apply_theme(const QString& name);

/// What was chosen in the menu last; "system" at first.
[[nodiscard]] QString remembered_theme();

/// Commands that choose the colours, and remember them.
void add_theme_commands(Commands& commands);

/// Codes of the languages that this build has, "en" among them: "de", "en". Only English where Qt's
/// tools for translations were missing when it was built.
[[nodiscard]] QStringList languages();

/// The one of `languages` that a user wants who prefers `wanted`, best first, as of
/// QLocale::uiLanguages(): "de-AT", "C". English if there is none.
[[nodiscard]] QString language_for(const QStringList& wanted, const QStringList& languages);

/// Translates all texts that are made from now on: "de", …, or "system" for the language of the
/// desktop (LANGUAGE, LC_ALL, LC_MESSAGES, LANG). Numbers keep the decimal point, as in files and
/// on command lines, in the C library too. False for a language that this build does not have, and
/// nothing changes.
bool apply_language(const QString& name);

/// What was chosen in the menu last; "system" at first.
[[nodiscard]] QString remembered_language();

/// Commands that choose the language of the next start, and remember it.
void add_language_commands(Commands& commands, Messages& messages);

}  // namespace episcope
