// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/window/use.h"

#include "app/gui/compare/compare_controller.h"
#include "app/gui/estimate/estimate_controller.h"
#include "app/gui/estimate/live_controller.h"
#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/scene_switcher.h"
#include "engine/disparity/registry.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/bench/window/event_ages.h"
#include "tests/bench/window/process.h"
#include "tests/bench/window/timed_application.h"
#include "tests/widgets/pictures.h"
#include "widgets/canvas/epi_pane.h"
#include "widgets/canvas/tile_wall.h"
#include "widgets/canvas/view_canvas.h"

#include <QAction>
#include <QMouseEvent>
#include <QTest>

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace episcope::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostResults = 6;
constexpr std::size_t kLabels = 3;
constexpr std::array kMethods = {"epi_l", "st_ch_l", "epi_s", "st_ch_s", "st_ch_g", "epi_g"};

/// Not QTest::mouseMove, which handles all events that wait: they would be part of the input.
void move_mouse(QWidget& widget, QPoint to, Qt::MouseButtons buttons = {}) {
  QMouseEvent move(QEvent::MouseMove, to, widget.mapToGlobal(to), Qt::NoButton, buttons, {});
  QCoreApplication::sendEvent(&widget, &move);
}

/// A user that does one thing every 20 ms, while methods run one after the other if they shall.
class User {
 public:
  User(WindowFixture& f, bool runs_methods) : f_(f), runs_methods_(runs_methods) {}

  /// A result of each light field.
  void estimateOnce() {
    for (int i = 0; i < 2; ++i) {
      keepRunning(1);
      (void)QTest::qWaitFor([this] { return f_.window.bench().jobs.count() == 0; }, kScenePatience);
      f_.window.bench().scenes.step(1);
    }
  }

  /// So many strokes on each light field, of three labels, on all views in turn.
  void paintBefore(int strokes) {
    for (int scene = 0; scene < 2; ++scene) {
      DocumentController& painted = f_.window.bench().document;
      painted.edit([](AnnotationDocument& document) {
        while (document.labels().labels().size() < kLabels) document.add_label();
      });
      for (int i = 0; i < strokes; ++i) {
        const PaintStyle style{.label = 1 + i % static_cast<int>(kLabels)};
        const double y = 20 + i * 37 % 460;
        const double x = 20 + i * 53 % 440;
        painted.beginStroke({i / 9 % 9, i % 9}, style, {y, x});
        painted.extendStroke({y + 10, x + 25});
        painted.endStroke();
      }
      f_.window.bench().scenes.step(1);
      QCoreApplication::processEvents();
    }
  }

  void act(int number) {
    if (runs_methods_) keepRunning(number);
    static constexpr std::array actions = {
        Action{"mouse", &User::hover},     Action{"mouse", &User::hover},
        Action{"cross-hair", &User::aim},  Action{"mouse", &User::hover},
        Action{"view", &User::step},       Action{"wheel", &User::zoom},
        Action{"mouse", &User::hover},     Action{"EPI", &User::measure},
        Action{"cross-hair", &User::aim},  Action{"mouse", &User::hover},
        Action{"overlay", &User::overlay}, Action{"view", &User::step},
        Action{"stroke", &User::stroke},   Action{"mouse", &User::hover},
        Action{"stroke", &User::stroke},   Action{"focus", &User::focus}};
    const Action& action = number % 97 == 96     ? Action{"tab", &User::tab}
                           : number % 241 == 240 ? Action{"arrangement", &User::arrange}
                           : number % 499 == 498
                               ? Action{"light field", &User::scene}
                               : actions[static_cast<std::size_t>(number) % actions.size()];
    done_.emplace_back(action.name);
    const double begin_ms = thread_cpu_ms();
    (this->*action.run)(number);
    double& most_ms = most_ms_[action.name];
    most_ms = std::max(most_ms, thread_cpu_ms() - begin_ms);
  }
  /// The longest that the thread of windows computed within one input of each kind, in ms.
  [[nodiscard]] const std::map<std::string, double>& mostComputed() const { return most_ms_; }
  /// What was done, in order.
  [[nodiscard]] const std::vector<std::string>& done() const { return done_; }

 private:
  struct Action {
    const char* name;
    void (User::*run)(int);
  };
  Session& session() { return f_.window.bench().session; }
  ViewCanvas* canvas() { return f_.window.bench().viewer_area.activeCanvas(); }

  void keepRunning(int number) {
    if (f_.window.bench().jobs.count(Lane::Estimate) > 0) return;
    Session& open = session();
    while (open.estimates().size() > kMostResults) {
      open.remove_estimate(open.estimates().front().id);
    }
    const char* method = kMethods[static_cast<std::size_t>(runs_++) % kMethods.size()];
    const bool is_all = number % 2 == 0;
    find<EstimateController>(f_.window).run(
        {method, {}, {.views = is_all ? ViewSelection::All : ViewSelection::Center}});
  }
  void hover(int number) { move_mouse(*canvas(), {40 + number * 7 % 400, 40 + number * 11 % 380}); }
  void aim(int number) { session().set_cross_hair({number * 13 % 500, number * 7 % 500}); }
  void step(int number) { session().set_view({number / 16 % 9, number / 5 % 9}); }
  void zoom(int number) { test::turn_wheel(*canvas(), {200, 180}, number % 64 < 32 ? 1 : -1); }
  void focus(int number) { session().set_focus(0.05 * (number % 40) - 1); }
  void measure(int number) {
    EpiPane* epi = f_.window.bench().viewer_area.horizontalEpi();
    if (!epi->isVisible()) return;
    const QPoint from(epi->width() / 2, 4);
    QTest::mousePress(epi, Qt::LeftButton, {}, from);
    move_mouse(*epi, {from.x() + number % 30, epi->height() - 4}, Qt::LeftButton);
    QTest::mouseRelease(epi, Qt::LeftButton, {}, {from.x() + number % 30, epi->height() - 4});
  }
  void overlay(int number) {
    using render::Quantity;
    constexpr std::array maps = {Quantity::View, Quantity::Disparity, Quantity::SignedError,
                                 Quantity::Truth, Quantity::BadPixels};
    f_.window.bench().overlay.setQuantity(
        maps[static_cast<std::size_t>(number / 16) % maps.size()]);
  }
  void stroke(int number) {
    f_.window.bench().frame.showTab("annotate");
    f_.window.bench().labels.choose(1 + number % static_cast<int>(kLabels));
    for (const bool is_press : {true, false}) {
      const QPoint at(60 + number * 17 % 300, 60 + number * 23 % 300);
      is_press ? QTest::mousePress(canvas(), Qt::LeftButton, {}, at)
               : QTest::mouseRelease(canvas(), Qt::LeftButton, {}, at + QPoint(25, 10));
      if (is_press) move_mouse(*canvas(), at + QPoint(12, 5), Qt::LeftButton);
    }
  }
  void tab(int number) {
    constexpr std::array tabs = {"estimate", "compare", "annotate", "check", "sweep", "errors"};
    f_.window.bench().frame.showTab(tabs[static_cast<std::size_t>(number) % tabs.size()]);
  }
  void arrange(int number) {
    constexpr std::array modes = {CompareMode::Wipe, CompareMode::Sides, CompareMode::Wall,
                                  CompareMode::Single};
    find<CompareController>(f_.window).setMode(
        modes[static_cast<std::size_t>(number) % modes.size()]);
  }
  void scene(int) { f_.window.bench().scenes.step(1); }

  WindowFixture& f_;
  bool runs_methods_;
  int runs_ = 0;
  std::vector<std::string> done_;
  std::map<std::string, double> most_ms_;
};

void report(const std::vector<double>& ages, const User& user) {
  const auto late =
      std::count_if(ages.begin(), ages.end(), [](double age) { return age > kLate_ms; });
  std::printf("%zu events: median %.2f, 95 %% %.2f, 99 %% %.2f, longest %.1f ms; %td over 50 ms\n",
              ages.size(), percentile(ages, 0.5), percentile(ages, 0.95), percentile(ages, 0.99),
              percentile(ages, 1), late);
  std::map<std::string, std::pair<int, double>> after;  // how often, and the longest
  for (std::size_t i = 0; i < ages.size(); ++i) {
    // An event waits for the input before it.
    const std::size_t input = i / kEventsPerInput;
    if (ages[i] <= kLate_ms || input >= user.done().size()) continue;
    auto& [count, longest] = after[user.done()[input]];
    ++count;
    longest = std::max(longest, ages[i]);
  }
  for (const auto& [action, found] : after) {
    std::printf("  late near '%s': %d, longest %.1f ms\n", action.c_str(), found.first,
                found.second);
  }
  for (const auto& [action, most_ms] : user.mostComputed()) {
    std::printf("  '%s' computed at most %.1f ms at once\n", action.c_str(), most_ms);
  }
}

}  // namespace

void measure_use(TimedApplication& application, double seconds, int strokes, bool runs_methods) {
  WindowFixture f;
  f.openScene("edge", {});  // 9×9 views of 512×512
  f.openScene("slant", {});
  f.trigger("segment.live");
  User user(f, runs_methods);
  user.estimateOnce();
  user.paintBefore(strokes);
  application.begin();
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  const auto ages = event_ages(f.window, {.input = [&](int number) { user.act(number); },
                                          .has_ended = [&] { return Clock::now() > end; },
                                          .patience_ms = static_cast<int>(1000 * seconds) + 60'000,
                                          .on_age =
                                              [&](double age_ms) {
                                                if (age_ms > kLate_ms) application.noteLate(age_ms);
                                              }});
  report(ages, user);
  application.report();
  const Process process = this_process();
  std::printf("%zu inputs; %.0f MiB, at most %.0f MiB\n", user.done().size(), process.memory_mib,
              process.most_memory_mib);
  f.window.bench().jobs.cancelLane(Lane::Estimate);
  f.window.bench().document.discardAll();
}

}  // namespace episcope::bench
