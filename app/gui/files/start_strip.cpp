// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/features.h"

#include "app/gui/scene/scene_opener.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/workbench.h"
#include "app/session/load_scene.h"
#include "app/session/session.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/message_bar.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QAction>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QToolButton>
#include <QWidget>

#include <algorithm>
#include <string>

namespace episcope {
namespace {

bool is_demo(const std::string& input) {
  const std::string id = builtin_scene_id(input);
  return id == "demo" || id.starts_with("demo?");
}

}  // namespace

/// What to do first, above everything else while the demo is opened or shown: open a light field of
/// one's own, or three steps to try. Gone for good once a light field that is not built in was
/// opened, or its cross was clicked.
class StartStrip : public QWidget {
  Q_OBJECT

 public:
  /// `recent` lists recent inputs and outlives this.
  StartStrip(const Workbench& bench, QMenu* recent) : QWidget(&bench.frame), bench_(bench) {
    setObjectName("startStrip");
    auto* row = make_row(
        this, {new QLabel(tr("This is a demo."), this)},
        {.margins = {theme::kMargin + 4, 4, theme::kMargin, 4}, .spacing = theme::kSpacing});
    addButtons(*row, recent);
    row->addWidget(makeSteps(), 1);
    auto* close = make_tool_button({"start.close", "close", tr("Do not show these hints")}, this);
    close->setAutoRaise(true);
    connect(close, &QToolButton::clicked, this, [this] {
      is_over_ = true;
      hide();
    });
    row->addWidget(close);
    hide();
    bench.frame.addAbove(this);
    connect(&bench.opener, &SceneOpener::changed, this, &StartStrip::update);
    bench.session.on_changed([this](Parts parts) {
      if (parts.has_any(Part::Scene | Part::Scenes)) update();
    });
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    paint_message_ground(*this, palette().color(QPalette::Link));
  }

 private:
  QLabel* makeSteps() {
    auto* steps = named("start.steps", new QLabel(this));
    steps->setWordWrap(true);
    steps->setTextFormat(Qt::RichText);
    steps->setText(
        tr("Try it: <b>1</b> drag in the view to look around, "
           "<b>2</b> <a href=\"tab.estimate\">run a method</a>, "
           "<b>3</b> <a href=\"tab.compare\">compare it with the ground truth</a>."));
    connect(steps, &QLabel::linkActivated, &bench_.commands, &Commands::trigger);
    return steps;
  }

  void addButtons(QHBoxLayout& row, QMenu* recent) {
    auto* open = named("start.open", new QPushButton(tr("Open…"), this));
    connect(open, &QPushButton::clicked, this, [this] { bench_.commands.trigger("file.open"); });
    auto* again = named("start.recent", new QPushButton(tr("Recent"), this));
    again->setMenu(recent);
    const QAction* listed = recent->menuAction();
    const auto follow = [again, listed] { again->setEnabled(listed->isEnabled()); };
    connect(listed, &QAction::changed, again, follow);
    follow();
    row.addWidget(open);
    row.addWidget(again);
  }

  void update() {
    const auto scenes = bench_.session.scenes();
    is_over_ |= std::ranges::any_of(
        scenes, [](const OpenScene* each) { return builtin_scene_id(each->input).empty(); });
    const std::string input =
        bench_.session.scene() ? bench_.session.input() : bench_.opener.loading().toStdString();
    setVisible(!is_over_ && is_demo(input));
  }

  Workbench bench_;
  bool is_over_ = false;
};

void add_start_strip(const Workbench& bench, QMenu* recent) {
  new StartStrip(bench, recent);
}

}  // namespace episcope

#include "start_strip.moc"
