// SPDX-License-Identifier: BSD-3-Clause
// take_pictures STEPS FOLDER: does in the window that ships what the file STEPS says, with mouse
// and keys, and writes its pictures to FOLDER. resources/manual/pictures.txt has the steps.
#include "app/gui/capture/capture_controller.h"
#include "app/gui/capture/photographs.h"
#include "app/gui/shell/appearance.h"
#include "tests/app/gui/window_fixture.h"

#include <QAbstractButton>
#include <QApplication>
#include <QComboBox>
#include <QFile>
#include <QFileDialog>
#include <QScreen>
#include <QTest>

#include <cstdio>
#include <functional>
#include <map>

namespace episcope::manual {
namespace {

constexpr int kSettling_ms = 400;  // what is drawn a little later: overlays, EPIs, tool tips
constexpr int kPatience_ms = 300'000;

class Player {
 public:
  explicit Player(QString folder) : folder_(std::move(folder)) {
    fixture_.window.resize(fixture_.window.screen()->availableSize());
    fixture_.window.move(0, 0);
  }

  /// Does one step; returns what is wrong with it, or nothing.
  QString play(const QString& line) {
    const QString verb = line.section(' ', 0, 0);
    const QString rest = line.section(' ', 1);
    const std::map<QString, std::function<QString(const QString&)>> verbs = {
        {"open", [this](const QString& input) { return open(input); }},
        {"do", [this](const QString& id) { return run(id); }},
        {"click", [this](const QString& name) { return click(name); }},
        {"choose", [this](const QString& what) { return choose(what); }},
        {"place", [this](const QString& at) { return mouse(at); }},
        {"close", [this](const QString& name) { return close(name); }},
        {"segmented", [this](const QString&) { return awaitLabels(); }},
        {"gantry", [this](const QString&) { return photograph(); }},
        {"save", [this](const QString& what) { return save(what); }},
        {"hover", [this](const QString& at) { return hover(at); }},
        {"drag", [this](const QString& path) { return mouse(path); }},
        {"picture", [this](const QString& name) { return picture(name); }}};
    const auto found = verbs.find(verb);
    if (found == verbs.end()) return "there is no such step";
    const QString problem = found->second(rest);
    return problem.isEmpty() && !settle() ? "the window is still busy" : problem;
  }

 private:
  bool settle() {
    QTest::qWait(kSettling_ms);
    const bool is_idle =
        QTest::qWaitFor([this] { return fixture_.window.bench().jobs.count() == 0; }, kPatience_ms);
    QTest::qWait(kSettling_ms);
    return is_idle;
  }

  QString open(const QString& input) {
    fixture_.window.start({input});
    const bool is_open = QTest::qWaitFor(
        [this] { return fixture_.window.bench().session.scene() != nullptr; }, kPatience_ms);
    return is_open ? QString() : "it does not open";
  }

  QString run(const QString& id) {
    QAction* action = fixture_.window.bench().commands.find(id);
    if (!action || !action->isEnabled()) return "there is no such command now";
    action->trigger();
    return {};
  }

  QString click(const QString& name) {
    auto* button = fixture_.window.findChild<QAbstractButton*>(name);
    if (!button || !button->isVisible() || !button->isEnabled())
      return "there is no such button now";
    QTest::mouseClick(button, Qt::LeftButton);
    return {};
  }

  QString choose(const QString& what) {
    auto* box = fixture_.window.findChild<QComboBox*>(what.section(' ', 0, 0));
    const int index = box ? box->findText(what.section(' ', 1), Qt::MatchStartsWith) : -1;
    if (index < 0) return "there is no such choice";
    box->setCurrentIndex(index);
    emit box->activated(index);
    return {};
  }

  QString mouse(const QString& places) {
    const QStringList numbers = places.split(' ', Qt::SkipEmptyParts);
    if (numbers.size() < 2 || numbers.size() % 2 != 0) return "places are pairs of numbers";
    const auto place = [&](qsizetype i) {
      return PixelIndex{.y = numbers[i + 1].toInt(), .x = numbers[i].toInt()};
    };
    fixture_.press(place(0));
    for (qsizetype i = 2; i < numbers.size(); i += 2) fixture_.move(place(i));
    fixture_.release(place(numbers.size() - 2));
    return {};
  }

  QString hover(const QString& at) {
    const QStringList numbers = at.split(' ', Qt::SkipEmptyParts);
    if (numbers.size() != 2) return "a place is a pair of numbers";
    fixture_.move({.y = numbers[1].toInt(), .x = numbers[0].toInt()});
    return {};
  }

  QString close(const QString& name) {
    auto* other = fixture_.window.findChild<QWidget*>(name);
    if (!other || !other->isVisible()) return "there is no such window now";
    other->close();
    return {};
  }

  QString awaitLabels() {
    const bool is_there = QTest::qWaitFor([this] { return fixture_.isSegmented(); }, kPatience_ms);
    return is_there ? QString() : "there are no labels";
  }

  /// Photographs of the demo of a gantry, with its lens, mesh and picks.
  QString photograph() {
    if (const QString problem = run("tab.capture"); !problem.isEmpty()) return problem;
    auto& capture = find<CaptureController>(fixture_.window);
    capture.photographs().makeDemo(fixture_.path(""), {});
    const bool is_there = QTest::qWaitFor([&] { return !capture.pairs().empty(); }, kPatience_ms);
    return is_there ? QString() : "the demo is not there";
  }

  /// Names a file for a dialog that asks for one.
  QString save(const QString& what) {
    auto* dialog = fixture_.window.findChild<QFileDialog*>(what.section(' ', 0, 0));
    if (!dialog) return "nobody asks for that file";
    const QString file = fixture_.path(what.section(' ', 1));
    dialog->close();
    emit dialog->fileSelected(file);
    emit dialog->filesSelected({file});
    return {};
  }

  QString picture(const QString& name) {
    const QString file = folder_ + '/' + name + ".png";
    const QPixmap picture = fixture_.window.screen()->grabWindow(0);
    return picture.save(file) ? QString() : "the picture cannot be written";
  }

  QString folder_;
  WindowFixture fixture_;
};

int play_file(const QString& steps, const QString& folder) {
  QFile file(steps);
  if (!file.open(QIODevice::ReadOnly)) {
    std::fprintf(stderr, "%s cannot be read\n", qPrintable(steps));
    return 1;
  }
  Player player(folder);
  int number = 0;
  while (!file.atEnd()) {
    ++number;
    const QString line = QString::fromUtf8(file.readLine()).trimmed();
    if (line.isEmpty() || line.startsWith('#')) continue;
    const QString problem = player.play(line);
    if (problem.isEmpty()) continue;
    std::fprintf(stderr, "%s:%d: %s: %s\n", qPrintable(steps), number, qPrintable(line),
                 qPrintable(problem));
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace episcope::manual

int main(int argc, char** argv) {
  const QApplication application(argc, argv);
  const QStringList arguments = QApplication::arguments();
  const bool has_language = arguments.size() == 4;
  if (arguments.size() != 3 && !has_language) {
    std::fprintf(stderr, "usage: take_pictures STEPS FOLDER [LANGUAGE]\n");
    return 2;
  }
  if (has_language && !episcope::apply_language(arguments[3])) {
    std::fprintf(stderr, "there is no language %s\n", qPrintable(arguments[3]));
    return 2;
  }
  return episcope::manual::play_file(arguments[1], arguments[2]);
}
