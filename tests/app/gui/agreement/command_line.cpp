// SPDX-License-Identifier: BSD-3-Clause
#include "tests/app/gui/agreement/command_line.h"

#include "tests/patience.h"

#include <QFileInfo>
#include <QProcess>

namespace episcope {
namespace {

CommandLineRun run(const QString& program, const QStringList& arguments, const QString& folder) {
  QProcess process;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert("XDG_CACHE_HOME", folder);
  environment.insert("PATH",
                     QFileInfo(EPISCOPE_CLI).absolutePath() + ':' + environment.value("PATH"));
  process.setProcessEnvironment(environment);
  process.setWorkingDirectory(folder);
  process.start(program, arguments);
  const bool is_finished = process.waitForFinished(kScenePatience);
  return {is_finished && process.exitStatus() == QProcess::NormalExit ? process.exitCode() : -1,
          QString::fromUtf8(process.readAllStandardOutput()),
          QString::fromUtf8(process.readAllStandardError())};
}

}  // namespace

CommandLineRun run_command_line(const QStringList& arguments, const QString& folder) {
  return run(EPISCOPE_CLI, arguments, folder);
}

CommandLineRun run_pasted(const QString& line, const QString& folder) {
  return run("/bin/sh", {"-c", line}, folder);
}

}  // namespace episcope
