// SPDX-License-Identifier: BSD-3-Clause
#include "app/about/version_text.h"
#include "app/gui/main_window.h"
#include "app/gui/shell/appearance.h"
#include "app/session/user_folders.h"
#include "engine/core/parameter.h"
#include "engine/core/version.h"
#include "engine/io/base/files.h"
#include "widgets/cloud/point_cloud_view.h"
#include "widgets/controls/tool_button.h"

#include <QApplication>
#include <QCommandLineParser>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string_view>

namespace {

constexpr int kFailure = 1;
constexpr int kUsageError = 2;

int fail(const QString& sentence) {
  std::fprintf(stderr, "episcope: %s\n", qPrintable(sentence));
  return kUsageError;
}

QString no_option(const QString& name) {
  const std::string nearest =
      episcope::nearest_name(name.toStdString(), {"theme", "language", "help", "version"});
  const QString sentence = QString("there is no option '--%1'; ").arg(name);
  return sentence + (nearest.empty() ? QString("see episcope --help")
                                     : QString("did you mean '--%1'?").arg(nearest.c_str()));
}

/// Whether only text is asked for, which needs no display.
bool asks_for_text(int argc, char** argv) {
  char** const end = std::find(argv + 1, argv + argc, std::string_view("--"));
  return std::any_of(argv + 1, end, [](std::string_view argument) {
    return argument == "-h" || argument == "--help" || argument == "--help-all" ||
           argument == "-v" || argument == "--version";
  });
}

/// Whether there is anywhere to show a window: Qt would abort. Only Linux needs one to be named.
bool has_display(int argc, char** argv) {
#if defined(__linux__)
  const auto is_set = [](const char* name) { return !qgetenv(name).isEmpty(); };
  return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY") || is_set("QT_QPA_PLATFORM") ||
         std::any_of(argv + 1, argv + argc, [](std::string_view argument) {
           return argument == "-platform" || argument == "--platform";
         });
#else
  return true;
#endif
}

std::unique_ptr<QCoreApplication> make_application(int& argc, char** argv) {
  if (asks_for_text(argc, argv)) return std::make_unique<QCoreApplication>(argc, argv);
  return std::make_unique<QApplication>(argc, argv);
}

QCommandLineOption theme_option() {
  return {"theme", "Colors: light, dark or those of the desktop.", "light|dark|system",
          episcope::remembered_theme()};
}

QCommandLineOption language_option() {
  return {"language", "Language of the window: that of the desktop, or one of its own.",
          "system|" + episcope::languages().join('|'), episcope::remembered_language()};
}

int show_version() {
  const std::string text =
      episcope::version_text("episcope", {{"Qt", qVersion()}, {"VTK", episcope::vtk_version()}});
  return std::fputs(text.c_str(), stdout) < 0 ? kFailure : 0;
}

}  // namespace

int main(int argc, char** argv) {
  QCoreApplication::setApplicationName("episcope");
  QCoreApplication::setOrganizationName("episcope");
  QCoreApplication::setApplicationVersion(episcope::kVersion);
  episcope::state_built_commit(episcope::kCommit);
  if (!asks_for_text(argc, argv) && !has_display(argc, argv)) {
    std::fputs("episcope: there is no display; episcope-cli does the same work without one\n",
               stderr);
    return kFailure;
  }
  const std::unique_ptr<QCoreApplication> application = make_application(argc, argv);

  QCommandLineParser parser;
  parser.setApplicationDescription(
      "Views, EPIs, disparity and labels of 4D light fields. Without INPUT, opens the demo.");
  const QCommandLineOption help = parser.addHelpOption();
  const QCommandLineOption version = parser.addVersionOption();
  parser.addPositionalArgument(
      "INPUT",
      "an lf.h5, a scene folder, an image grid, a project (*.episcope), demo or demo:<scene>; "
      "or a result, which opens its light field",
      "[INPUT...]");
  const QCommandLineOption theme = theme_option();
  const QCommandLineOption language = language_option();
  parser.addOptions({theme, language});
  if (!parser.parse(QCoreApplication::arguments())) {
    const QStringList unknown = parser.unknownOptionNames();
    return fail(unknown.isEmpty() ? parser.errorText() : no_option(unknown.front()));
  }
  if (parser.isSet(help)) parser.showHelp();
  if (parser.isSet(version)) return show_version();
  const QStringList inputs = parser.positionalArguments();
  if (!episcope::apply_theme(parser.value(theme))) {
    return fail("--theme must be light, dark or system");
  }
  if (!episcope::apply_language(parser.value(language))) {
    return fail("--language must be system, " + episcope::languages().join(" or "));
  }

  QGuiApplication::setDesktopFileName("episcope");
  QApplication::setWindowIcon(episcope::program_icon());
  episcope::io::report_file_size_limit();
  episcope::use_cache_for_scratch();
  episcope::MainWindow window;
  window.show();
  window.start(inputs.isEmpty() ? QStringList("demo") : inputs);
  return QApplication::exec();
}
