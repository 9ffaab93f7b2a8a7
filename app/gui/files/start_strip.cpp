// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/files/start_strip.h"

#include "app/gui/shell/commands.h"
#include "app/gui/shell/frame.h"
#include "app/session/load_scene.h"
#include "app/session/session.h"
#include "widgets/controls/message_bar.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QAction>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <string>

namespace episcope {
namespace {

bool is_demo(const std::string& input) {
  const std::string id = builtin_scene_id(input);
  return id == "demo" || id.starts_with("demo?");
}

}  // namespace

StartStrip::StartStrip(const Workbench& bench, QMenu* recent)
    : QWidget(&bench.frame), bench_(bench) {
  setObjectName("startStrip");
  auto* steps = new QLabel(this);
  steps->setObjectName("start.steps");
  steps->setWordWrap(true);
  steps->setTextFormat(Qt::RichText);
  steps->setText(
      tr("Try it: <b>1</b> drag in the view to look around, "
         "<b>2</b> <a href=\"tab.estimate\">run a method</a>, "
         "<b>3</b> <a href=\"tab.compare\">compare it with the ground truth</a>."));
  connect(steps, &QLabel::linkActivated, &bench.commands, &Commands::trigger);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(theme::kMargin + 4, 4, theme::kMargin, 6);
  layout->setSpacing(theme::kSpacing);
  layout->addWidget(makeButtons(recent));
  layout->addWidget(steps);
  hide();
  bench.frame.addFloating(this);
  bench.session.on_changed([this](Parts parts) {
    if (parts.has_any(Part::Scene | Part::Scenes)) update();
  });
}

QWidget* StartStrip::makeButtons(QMenu* recent) {
  auto* buttons = new QWidget(this);
  auto* row = new QHBoxLayout(buttons);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(theme::kSpacing);
  row->addWidget(new QLabel(tr("This is a demo."), buttons));
  auto* open = new QPushButton(tr("Open…"), buttons);
  open->setObjectName("start.open");
  connect(open, &QPushButton::clicked, this, [this] { bench_.commands.trigger("file.open"); });
  auto* again = new QPushButton(tr("Recent"), buttons);
  again->setObjectName("start.recent");
  again->setMenu(recent);
  const QAction* listed = recent->menuAction();
  const auto follow = [again, listed] { again->setEnabled(listed->isEnabled()); };
  connect(listed, &QAction::changed, again, follow);
  follow();
  row->addWidget(open);
  row->addWidget(again);
  row->addStretch(1);
  auto* close = make_tool_button({"start.close", "close", tr("Do not show these hints")}, buttons);
  close->setAutoRaise(true);
  connect(close, &QToolButton::clicked, this, [this] {
    is_over_ = true;
    hide();
  });
  row->addWidget(close);
  return buttons;
}

void StartStrip::update() {
  const auto scenes = bench_.session.scenes();
  is_over_ |= std::ranges::any_of(
      scenes, [](const OpenScene* each) { return builtin_scene_id(each->input).empty(); });
  setVisible(!is_over_ && bench_.session.scene() && is_demo(bench_.session.input()));
}

void StartStrip::paintEvent(QPaintEvent*) {
  paint_message_ground(*this, palette().color(QPalette::Link));
}

}  // namespace episcope

#include "moc_start_strip.cpp"
