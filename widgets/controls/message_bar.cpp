// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/message_bar.h"

#include "widgets/controls/labels.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QAction>
#include <QClipboard>
#include <QEvent>
#include <QGridLayout>
#include <QGuiApplication>
#include <QLabel>
#include <QPainter>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <utility>

namespace episcope {
namespace {

// ms that good news stays, and an offer.
constexpr int kStay = 6000;
constexpr int kStayOffered = 20000;
constexpr double kTint = 0.14;
constexpr int kEdgeWidth = 4;

}  // namespace

void paint_message_ground(QWidget& widget, const QColor& accent) {
  QPainter painter(&widget);
  const QColor window = widget.palette().color(QPalette::Window);
  painter.fillRect(widget.rect(), theme::blend(window, accent, kTint));
  painter.fillRect(QRect(0, 0, kEdgeWidth, widget.height()), accent);
}

MessageBar::MessageBar(QWidget* parent)
    : QWidget(parent),
      icon_(named("message.icon", new QLabel(this))),
      text_(named("message.text", new QLabel(this))),
      buttons_{Button{new QPushButton(this), {}}, Button{new QPushButton(this), {}}},
      close_(make_tool_button({"message.close", "close", tr("Close this message")}, this)) {
  setObjectName("messageBar");
  text_->setTextFormat(Qt::PlainText);
  text_->setWordWrap(true);
  text_->setMinimumWidth(1);
  // What is shown holds places to break: the sentence itself is copied by the menu.
  auto* copy = named("message.copy", new QAction(tr("Copy message"), text_));
  connect(copy, &QAction::triggered, this,
          [this] { QGuiApplication::clipboard()->setText(sentence_); });
  text_->addAction(copy);
  text_->setContextMenuPolicy(Qt::ActionsContextMenu);
  auto* layout =
      make_row(this, {icon_, {text_, 1}},
               {.margins = {theme::kMargin + 4, 4, theme::kMargin, 4}, .spacing = theme::kSpacing});
  const char* names[] = {"message.action", "message.other"};
  for (std::size_t i = 0; i < buttons_.size(); ++i) {
    buttons_[i].button->setObjectName(names[i]);
    layout->addWidget(buttons_[i].button);
    connect(buttons_[i].button, &QPushButton::clicked, this, [this, i] {
      const auto run = std::exchange(buttons_[i].action, {}).run;
      dismiss();
      if (run) run();
    });
  }
  layout->addWidget(close_);
  timer_.setSingleShot(true);
  connect(close_, &QToolButton::clicked, this, [this] {
    dismiss();
    emit closed();
  });
  connect(&timer_, &QTimer::timeout, this, &MessageBar::dismiss);
  theme::follow_palette(this, this, [this] { updateIcon(); });
  hide();
}

void MessageBar::showMessage(Severity severity, const QString& text) {
  showMessage(severity, text, Action());
}

void MessageBar::setAction(Button& button, Action action) {
  button.button->setText(action.text);
  button.button->setVisible(!action.text.isEmpty());
  button.action = std::move(action);
}

void MessageBar::showMessage(Severity severity, const QString& text, Action action, Action other) {
  severity_ = severity;
  sentence_ = text;
  text_->setText(breakable(text));
  setAction(buttons_[0], std::move(action));
  setAction(buttons_[1], std::move(other));
  updateIcon();
  const bool goes_away = severity == Severity::Info || severity == Severity::Success;
  if (goes_away) {
    timer_.start(buttons_[0].action.text.isEmpty() ? kStay : kStayOffered);
  } else {
    timer_.stop();
  }
  show();
  update();
}

void MessageBar::dismiss() {
  timer_.stop();
  hide();
}

QColor MessageBar::accent() const {
  switch (severity_) {
    case Severity::Info:
      return palette().color(QPalette::Link);
    case Severity::Success:
      return theme::success_text(palette());
    case Severity::Warning:
      return theme::warning_text(palette());
    case Severity::Error:
      return theme::error_text(palette());
  }
  return {};
}

void MessageBar::updateIcon() {
  const char* names[] = {"info", "success", "warning", "error"};
  icon_->setPixmap(themed_icon(names[static_cast<int>(severity_)]).pixmap(16, 16));
}

namespace {

constexpr int kBarSteps = 1000;
constexpr int kBarHeight = 4;
constexpr int kRowSpacing = 0;
constexpr int kRowsInSight = 2;

}  // namespace

int percent_done(double fraction) {
  return static_cast<int>(std::clamp(std::lround(100 * fraction), 0L, 99L));
}

QString time_left_text(double fraction, double seconds) {
  constexpr double kLeastFraction = 0.02;  // Before, one would guess wildly.
  constexpr double kLeastSeconds = 3;
  if (fraction < kLeastFraction || fraction >= 1 || seconds < kLeastSeconds) return {};
  const double left = seconds * (1 - fraction) / fraction;
  if (left < 1) return JobPanel::tr("less than 1 s left");
  if (left < 60) return JobPanel::tr("about %1 s left").arg(std::lround(left));
  const long minutes = std::lround(left / 60);
  if (minutes < 60) return JobPanel::tr("about %1 min left").arg(minutes);
  return JobPanel::tr("about %1 h %2 min left").arg(minutes / 60).arg(minutes % 60);
}

JobPanel::JobPanel(QWidget* parent)
    : QWidget(parent),
      scroll_(named("jobPanel.scroll", new QScrollArea(this))),
      layout_(new QVBoxLayout),
      idle_(named("jobPanel.idle", new QLabel(tr("No jobs running"), this))) {
  setObjectName("jobPanel");
  auto* rows = new QWidget(scroll_);
  rows->setLayout(layout_);
  layout_->setContentsMargins(0, 0, 0, 0);
  layout_->setSpacing(theme::kSpacing);
  set_up_scrolling(scroll_);
  scroll_->setFocusPolicy(Qt::NoFocus);
  scroll_->setWidget(rows);
  scroll_->hide();
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->addWidget(idle_, 0, Qt::AlignTop);
  all->addWidget(scroll_);
  fitHeight();
  theme::mute(idle_);
}

void JobPanel::addJob(quint64 id, const QString& title) {
  removeJob(id);
  const QString name = QString("job.%1").arg(id);
  Row row;
  row.widget = new QWidget(scroll_->widget());
  row.widget->setObjectName(name);
  auto* title_label = named(name + ".title", new ElidedLabel(row.widget));
  title_label->setFullText(title);
  row.finish = make_tool_button(
      {name + ".finish", "success", tr("Finish now and keep the result so far")}, row.widget);
  row.finish->hide();
  row.cancel = make_tool_button({name + ".cancel", "close", tr("Cancel this job")}, row.widget);
  row.bar = new QProgressBar(row.widget);
  row.bar->setObjectName(name + ".bar");
  row.bar->setRange(0, kBarSteps);
  row.bar->setTextVisible(false);
  row.bar->setFixedHeight(kBarHeight);
  row.stage = new ElidedLabel(row.widget);
  row.stage->setObjectName(name + ".stage");
  row.stage->setFullText(tr("waiting"));

  auto* grid = make_grid(row.widget, theme::kSpacing, kRowSpacing);
  grid->addWidget(title_label, 0, 0);
  grid->addWidget(row.finish, 0, 1, 3, 1, Qt::AlignVCenter);
  grid->addWidget(row.cancel, 0, 2, 3, 1, Qt::AlignVCenter);
  grid->addWidget(row.bar, 1, 0);
  grid->addWidget(row.stage, 2, 0);
  layout_->addWidget(row.widget);
  connect(row.finish, &QToolButton::clicked, this, [this, id] { emit finishRequested(id); });
  connect(row.cancel, &QToolButton::clicked, this, [this, id] { emit cancelRequested(id); });
  theme::mute(row.stage);
  rows_.emplace(id, row);
  showRows();
}

void JobPanel::setProgress(quint64 id, double fraction, const QString& stage) {
  Row* row = find(id);
  if (!row) return;
  if (!row->clock.isValid()) {
    row->clock.start();
    row->finish->setVisible(row->is_iterative);
  }
  row->bar->setValue(static_cast<int>(std::lround(kBarSteps * std::clamp(fraction, 0.0, 0.99))));
  if (!row->finish->isEnabled()) return;  // It says how it is being ended.
  QStringList parts{stage, tr("%1 %").arg(percent_done(fraction)),
                    time_left_text(fraction, row->clock.elapsed() / 1000.0)};
  parts.removeAll({});
  row->stage->setFullText(parts.join(" · "));
}

void JobPanel::setIterative(quint64 id) {
  Row* row = find(id);
  if (!row) return;
  row->is_iterative = true;
  row->finish->setVisible(row->clock.isValid());  // what waits has nothing yet
}

// A job that finishes can still be cancelled.
void JobPanel::end(quint64 id, const QString& stage, bool cancelled) {
  Row* row = find(id);
  if (!row) return;
  row->finish->setEnabled(false);
  if (cancelled) row->cancel->setEnabled(false);
  row->stage->setFullText(stage);
}

JobPanel::Row* JobPanel::find(quint64 id) {
  const auto found = rows_.find(id);
  return found == rows_.end() ? nullptr : &found->second;
}

void JobPanel::removeJob(quint64 id) {
  const auto found = rows_.find(id);
  if (found == rows_.end()) return;
  found->second.widget->deleteLater();
  found->second.widget->hide();
  rows_.erase(found);
  showRows();
}

void JobPanel::showRows() {
  idle_->setVisible(rows_.empty());
  scroll_->setVisible(!rows_.empty());
}

void JobPanel::fitHeight() {
  const int row = 2 * fontMetrics().height() + kBarHeight + 2 * kRowSpacing;
  setFixedHeight(kRowsInSight * row + theme::kSpacing);
}

void JobPanel::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::FontChange) fitHeight();
}

}  // namespace episcope

#include "moc_message_bar.cpp"
