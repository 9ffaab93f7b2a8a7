// SPDX-License-Identifier: BSD-3-Clause
// The window that ships, worked with on three light fields until it is killed: strokes, undo,
// labels, methods, sweeps, names, notes, choices, one light field after the other, a project that
// is saved again and again. Started anew, it first takes back what the killed one left. Tells what
// a user would miss after each step, and what it is about to do before. Usage: day_in_window
// <folder> <seed>
#include "app/gui/annotate/annotate_controller.h"
#include "app/gui/estimate/estimate_controller.h"
#include "app/gui/files/autosave.h"
#include "app/gui/files/project_controller.h"
#include "app/gui/main_window.h"
#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/scene/scene_switcher.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/session/project_file.h"
#include "app/session/session.h"
#include "engine/core/error.h"
#include "engine/io/formats/write_scene.h"
#include "engine/scenes/builtin.h"
#include "tests/app/gui/paint_stroke.h"
#include "tests/app/kills/window_state.h"
#include "tests/patience.h"
#include "widgets/controls/message_bar.h"

#include <fmt/format.h>

#include <QAction>
#include <QApplication>
#include <QLineEdit>
#include <QPushButton>
#include <QSettings>
#include <QTest>

#include <array>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <random>

namespace {

using namespace episcope;
namespace fs = std::filesystem;

constexpr std::array kScenes = {"edge", "slant", "fronto"};
constexpr std::size_t kMostResults = 4;  // of a light field

class Day {
 public:
  Day(fs::path folder, unsigned seed) : folder_(std::move(folder)), random_(seed) {
    window_.bench().opener.setCacheFolder({});
    window_.bench().document.setJournalFolder(folder_ / "journals");
    window_.findChild<Autosave*>()->setRoot(folder_ / "sessions");
    window_.resize(1280, 800);
    window_.show();
  }

  /// Takes back what is left, else opens the light fields.
  bool begin() {
    check_saved_project();
    window_.bench().frame.start();
    auto* bar = window_.findChild<MessageBar*>("sessionRecoveryBar");
    const bool is_first = !fs::exists(folder_ / "begun");
    if (is_first) return open_all();
    if (!QTest::qWaitFor([bar] { return bar->isVisible(); }, kPatience)) return false;
    bar->findChild<QPushButton*>("message.action")->click();
    if (!wait_for_document()) return false;
    for (const OpenScene* each : session().scenes()) {
      if (!show(each->id)) return false;  // what its files hold is read
      for (const std::string& strokes : watcher_.strokes_around()) {
        std::printf("STROKES\t%s\t%s\n", each->name.c_str(), strokes.c_str());
      }
      (void)watcher_.look();
    }
    return true;
  }

  void go_on() {
    window_.findChild<AnnotateController*>()->setAnnotating(true);
    test::tell(watcher_.look());
    for (int number = 0;; ++number) {
      const Step& step = steps_[random_() % steps_.size()];
      std::printf("STEP\t%s\n", step.name);
      std::fflush(stdout);
      step.run(*this, number);
      QCoreApplication::processEvents();
      test::tell(watcher_.look());
    }
  }

 private:
  struct Step {
    const char* name;
    void (*run)(Day&, int number);
  };

  Session& session() { return window_.bench().session; }
  bool wait_for_document() {
    return QTest::qWaitFor(
        [this] { return session().scene() && window_.bench().document.document(); },
        kScenePatience);
  }

  bool open_all() {
    for (const char* id : kScenes) {
      const fs::path file = folder_ / "data" / id / "lf.h5";
      fs::create_directories(file.parent_path());
      scenes::RenderOptions options;
      options.grid = {5, 5};
      options.height = options.width = 96;
      io::write_archive(file, scenes::render_builtin(id, options, Progress()), Progress());
      const std::size_t before = session().scenes().size();
      window_.bench().opener.open(QString::fromStdString(file.string()));
      if (!QTest::qWaitFor([&] { return session().scenes().size() > before; }, kPatience)) {
        return false;
      }
    }
    const auto* autosave = window_.findChild<Autosave*>();
    const bool is_kept =
        wait_for_document() && QTest::qWaitFor([&] { return autosave->isIdle(); }, kPatience);
    std::fclose(std::fopen((folder_ / "begun").c_str(), "w"));
    return is_kept;
  }

  // What Ctrl+S wrote last can be opened, and all that it names is there.
  void check_saved_project() {
    const fs::path file = folder_ / "day.episcope";
    if (!fs::exists(file)) return;
    std::string problem;
    try {
      for (const ProjectScene& scene : read_project(file).scenes) {
        for (const EstimateEntry& each : scene.estimates) {
          if (!fs::exists(each.kept)) problem = each.kept.string() + " is not there";
        }
        if (!scene.strokes.empty()) (void)read_journal(scene.strokes);
      }
    } catch (const Error& error) {
      problem = error.what();
    }
    std::printf("PROJECT\t%s\n", problem.empty() ? "whole" : problem.c_str());
  }

  bool show(std::uint64_t scene) {
    window_.bench().scenes.show(scene);
    return QTest::qWaitFor(
        [&] { return session().generation() == scene && window_.bench().document.document(); },
        kScenePatience);
  }
  void trigger(const char* command) {
    QAction* action = window_.bench().commands.find(command);
    if (action->isEnabled()) action->trigger();
  }
  int any_result() {
    const auto& results = session().estimates();
    return results.empty() ? 0 : results[random_() % results.size()].id;
  }

  static void stroke(Day& day, int number) {
    const Qt::MouseButton button = number % 4 == 3 ? Qt::RightButton : Qt::LeftButton;
    paint_stroke(day.window_, static_cast<int>(day.random_() % 1000), button);
  }
  static void undo(Day& day, int) { day.trigger("annotate.undo"); }
  static void redo(Day& day, int) { day.trigger("annotate.redo"); }
  static void label(Day& day, int) {
    if (day.window_.bench().document.document()->labels().labels().size() < 9) {
      day.trigger("annotate.add_label");
    }
  }
  static void scene(Day& day, int) {
    const auto scenes = day.session().scenes();
    (void)day.show(scenes[day.random_() % scenes.size()]->id);
  }
  // Some are waited for, others end later.
  static void estimate(Day& day, int number) {
    if (day.session().estimates().size() >= kMostResults) return;
    const std::size_t before = day.session().estimates().size();
    day.window_.findChild<EstimateController*>()->run(
        {"st_ch_l",
         {{"labels", 8 + static_cast<int>(day.random_() % 100)}},
         {.views = ViewSelection::Center}});
    if (number % 2 == 0) {
      (void)QTest::qWaitFor([&] { return day.session().estimates().size() > before; },
                            kScenePatience);
    }
  }
  static void remove(Day& day, int number) {
    if (number % 3 == 0) return day.trigger("estimate.restore");
    if (day.session().estimates().size() > 2) day.trigger("estimate.remove");
  }
  static void rename(Day& day, int number) {
    day.session().rename_estimate(day.any_result(), fmt::format("mine {}", number));
  }
  static void note(Day& day, int number) {
    day.session().set_note(day.any_result(), fmt::format("seen at step {}", number));
  }
  static void choose(Day& day, int number) {
    Session& session = day.session();
    if (number % 3 == 0) {
      session.set_tone({0, 1.0 + 0.25 * (number % 9), 1});
    } else if (number % 3 == 1) {
      const int edge = 5 + number % 40;
      session.set_judged(session.generation(),
                         {JudgedPixels::Rectangle, {edge, 4, edge + 30, 40 + number % 30}, {}});
    } else {
      Measurements measured = session.place().measured;
      if (measured.list.size() > 5) measured = {};
      measured.list.push_back({fmt::format("line {}", number),
                               EpiDirection::Horizontal,
                               session.view(),
                               {number % 90, 20},
                               0.01 * number});
      session.set_measurements(measured);
    }
  }
  static void browse(Day& day, int number) {
    day.session().set_view({number % 5, (number * 3) % 5});
    day.session().set_cross_hair({number % 96, number * 7 % 96});
  }
  static void sweep(Day& day, int number) {
    SweepList& sweeps = day.window_.bench().scenes.sweeps();
    auto* run = day.window_.findChild<QPushButton*>("sweep.run");
    auto* values = day.window_.findChild<QLineEdit*>("sweep.first.values");
    if (sweeps.all().size() > 3) sweeps.remove(sweeps.all().front().id);
    values->selectAll();
    QTest::keyClicks(values, QString("0.%1, 0.9").arg(5000 + number % 3000));
    if (run->isEnabled()) run->click();
  }
  static void save(Day& day, int) {
    const QString file = QString::fromStdString((day.folder_ / "day.episcope").string());
    bool is_saved = false;
    day.window_.findChild<ProjectController*>()->saveTo(file, [&is_saved] { is_saved = true; });
    (void)QTest::qWaitFor([&] { return is_saved; }, kPatience);
  }

  static constexpr std::array<Step, 19> steps_{{
      {"stroke", stroke}, {"stroke", stroke}, {"stroke", stroke},     {"stroke", stroke},
      {"stroke", stroke}, {"undo", undo},     {"redo", redo},         {"label", label},
      {"scene", scene},   {"scene", scene},   {"estimate", estimate}, {"estimate", estimate},
      {"remove", remove}, {"rename", rename}, {"note", note},         {"choose", choose},
      {"browse", browse}, {"sweep", sweep},   {"save", save},
  }};

  fs::path folder_;
  std::mt19937 random_;
  MainWindow window_;
  test::WindowWatcher watcher_{window_};
};

}  // namespace

int main(int argc, char** argv) {
  const QApplication application(argc, argv);
  if (argc != 3) return 2;
  const fs::path folder = argv[1];
  fs::create_directories(folder);
  QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, (folder / "settings").c_str());
  Day day(folder, static_cast<unsigned>(std::atoi(argv[2])));
  if (!day.begin()) return 3;
  day.go_on();
}
