// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/main_window.h"
#include "engine/core/version.h"
#include "widgets/outlined_style.h"
#include "widgets/theme.h"

#include <QApplication>
#include <QCommandLineParser>
#include <QStyle>

#include <cstdio>

namespace {

constexpr int kUsageError = 2;

bool set_theme(const QString& name) {
  const bool is_own = name == "light" || name == "dark";
  if (is_own || QApplication::style()->name() == "fusion") {
    QApplication::setStyle(new episcope::OutlinedStyle);
  }
  if (is_own) {
    QApplication::setPalette(name == "light" ? episcope::theme::light_palette()
                                             : episcope::theme::dark_palette());
    return true;
  }
  return name == "system";
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
  parser.addHelpOption();
  parser.addVersionOption();
  parser.addPositionalArgument(
      "INPUT", "an lf.h5, a scene folder, an image grid, demo or demo:<scene>", "[INPUT]");
  const QCommandLineOption theme("theme", "Colours: light, dark or those of the desktop.",
                                 "light|dark|system", "system");
  parser.addOption(theme);
  parser.process(application);
  const QStringList inputs = parser.positionalArguments();
  if (!set_theme(parser.value(theme)) || inputs.size() > 1) {
    std::fprintf(stderr, "episcope: %s\n",
                 inputs.size() > 1 ? "only one INPUT can be open; start it again for each"
                                   : "--theme must be light, dark or system");
    return kUsageError;
  }

  episcope::MainWindow window;
  window.show();
  window.open(inputs.isEmpty() ? QStringLiteral("demo") : inputs.front());
  window.offerRecovery();
  return QApplication::exec();
}
