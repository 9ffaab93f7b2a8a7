// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/help/theme_choice.h"
#include "app/gui/main_window.h"
#include "engine/core/parameter/parameter.h"
#include "engine/core/version.h"

#include <QApplication>
#include <QCommandLineParser>

#include <cstdio>

namespace {

constexpr int kUsageError = 2;

int fail(const QString& sentence) {
  std::fprintf(stderr, "episcope: %s\n", qPrintable(sentence));
  return kUsageError;
}

QString no_option(const QString& name) {
  const std::string nearest =
      episcope::nearest_name(name.toStdString(), {"theme", "help", "version"});
  const QString sentence = QString("there is no option '--%1'; ").arg(name);
  return sentence + (nearest.empty() ? QString("see episcope --help")
                                     : QString("did you mean '--%1'?").arg(nearest.c_str()));
}

}  // namespace

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  QApplication::setApplicationName("episcope");
  QApplication::setOrganizationName("episcope");
  QApplication::setApplicationVersion(episcope::kVersion);

  QCommandLineParser parser;
  parser.setApplicationDescription(
      "Views, EPIs, disparity and labels of 4D light fields. Without INPUT, opens the demo.");
  const QCommandLineOption help = parser.addHelpOption();
  const QCommandLineOption version = parser.addVersionOption();
  parser.addPositionalArgument(
      "INPUT",
      "an lf.h5, a scene folder, an image grid, a project (*.episcope), demo or demo:<scene>",
      "[INPUT]");
  const QCommandLineOption theme("theme", "Colours: light, dark or those of the desktop.",
                                 "light|dark|system", episcope::remembered_theme());
  parser.addOption(theme);
  if (!parser.parse(application.arguments())) {
    const QStringList unknown = parser.unknownOptionNames();
    return fail(unknown.isEmpty() ? parser.errorText() : no_option(unknown.front()));
  }
  if (parser.isSet(help)) parser.showHelp();
  if (parser.isSet(version)) parser.showVersion();
  const QStringList inputs = parser.positionalArguments();
  if (!episcope::apply_theme(parser.value(theme)) || inputs.size() > 1) {
    return fail(inputs.size() > 1 ? "give one INPUT; a project (*.episcope) holds several"
                                  : "--theme must be light, dark or system");
  }

  episcope::MainWindow window;
  window.show();
  window.start(inputs.isEmpty() ? QStringLiteral("demo") : inputs.front());
  return QApplication::exec();
}
