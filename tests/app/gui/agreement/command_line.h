// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>
#include <QStringList>

namespace episcope {

/// What a run of the real command line left.
struct CommandLineRun {
  int exit_code = -1;
  QString output;
  QString error;
};

/// Runs episcope-cli with these arguments in a folder, where its cache is too.
[[nodiscard]] CommandLineRun run_command_line(const QStringList& arguments, const QString& folder);

/// The same with a line as users paste it into a shell: "episcope-cli estimate …".
[[nodiscard]] CommandLineRun run_pasted(const QString& line, const QString& folder);

}  // namespace episcope
