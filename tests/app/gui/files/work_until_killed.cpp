// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/annotate_controller.h"
#include "app/gui/estimate/estimate_controller.h"
#include "app/gui/files/autosave.h"
#include "app/gui/files/project_controller.h"
#include "app/gui/main_window.h"
#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/scene/scene_switcher.h"
#include "app/gui/shell/commands.h"
#include "app/session/session.h"
#include "tests/app/gui/paint_stroke.h"
#include "tests/patience.h"

#include <QAction>
#include <QApplication>
#include <QSettings>
#include <QTest>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <random>

// The window that ships, worked with on several light fields until it is killed: methods, strokes,
// names, a project that is saved, one light field after the other. After each step it tells how
// many results there are, how many of them files keep, and how many strokes. Usage:
// work_until_killed <state folder> <seed> <light field>…

using namespace episcope;

namespace {

void show_any(MainWindow& window, std::mt19937& random) {
  const auto scenes = window.bench().session.scenes();
  const std::uint64_t scene = scenes[random() % scenes.size()]->id;
  window.bench().scenes.show(scene);
  (void)QTest::qWaitFor(
      [&] {
        return window.bench().session.generation() == scene &&
               window.bench().document.document() != nullptr;
      },
      kPatience);
}

void estimate(MainWindow& window) {
  const std::size_t before = window.bench().session.estimates().size();
  window.findChild<EstimateController*>()->run({"st_ch_l", {}, {.views = ViewSelection::Center}});
  (void)QTest::qWaitFor([&] { return window.bench().session.estimates().size() > before; },
                        kScenePatience);
}

void save(MainWindow& window, const std::filesystem::path& file) {
  bool is_saved = false;
  window.findChild<ProjectController*>()->saveTo(QString::fromStdString(file.string()),
                                                 [&is_saved] { is_saved = true; });
  (void)QTest::qWaitFor([&] { return is_saved; }, kScenePatience);
}

// A result is kept once the session's file names it: what a saved project has just taken in is in a
// file before that.
void tell(const MainWindow& window, int strokes) {
  static int kept = 0;
  int made = 0;
  int in_files = 0;
  for (const OpenScene* scene : window.bench().session.scenes()) {
    for (const EstimateEntry& entry : scene->estimates) {
      ++made;
      if (!entry.kept.empty()) ++in_files;
    }
  }
  if (window.findChild<Autosave*>()->isIdle()) kept = in_files;
  std::printf("%d %d %d\n", made, kept, strokes);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  if (argc < 4) return 2;
  const std::filesystem::path state = argv[1];
  std::mt19937 random(static_cast<unsigned>(std::atoi(argv[2])));
  QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, (state / "settings").c_str());
  MainWindow window;
  window.bench().document.setJournalFolder(state / "journals");
  window.findChild<Autosave*>()->setRoot(state / "sessions");
  window.show();
  for (int i = 3; i < argc; ++i) {
    const auto count = static_cast<std::size_t>(i - 2);
    window.bench().opener.open(argv[i]);
    if (!QTest::qWaitFor([&] { return window.bench().session.scenes().size() == count; },
                         kPatience)) {
      return 3;
    }
  }
  if (!QTest::qWaitFor([&] { return window.bench().document.document(); }, kPatience)) return 3;
  // The list of what is open is kept some milliseconds after it changes.
  const auto* autosave = window.findChild<Autosave*>();
  if (!QTest::qWaitFor([&] { return autosave->isIdle(); }, kPatience)) return 3;
  window.findChild<AnnotateController*>()->setAnnotating(true);
  int strokes = 0;
  for (int number = 0;; ++number) {
    switch (random() % 5) {
      case 0:
        show_any(window, random);
        break;
      case 1:
        estimate(window);
        break;
      case 2:
        save(window, state / "work.episcope");
        break;
      default: {
        // What changes no pixel is no step.
        const History<Edit>& history = window.bench().document.document()->history();
        const std::size_t before = history.applied_count();
        paint_stroke(window, number);
        if (history.applied_count() > before) ++strokes;
      }
    }
    QCoreApplication::processEvents();
    tell(window, strokes);
  }
}
