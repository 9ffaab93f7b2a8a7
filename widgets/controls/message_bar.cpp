// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/message_bar.h"

#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QAction>
#include <QClipboard>
#include <QEvent>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QToolButton>

#include <utility>

namespace episcope {
namespace {

constexpr int kStay = 6000;  // ms that good news stays.

}  // namespace

MessageBar::MessageBar(QWidget* parent)
    : QWidget(parent),
      icon_(new QLabel(this)),
      text_(new QLabel(this)),
      buttons_{Button{new QPushButton(this), {}}, Button{new QPushButton(this), {}}},
      close_(make_tool_button({"message.close", "close", tr("Close this message")}, this)) {
  setObjectName("messageBar");
  icon_->setObjectName("message.icon");
  text_->setObjectName("message.text");
  text_->setTextFormat(Qt::PlainText);
  text_->setWordWrap(true);
  text_->setMinimumWidth(1);
  // What is shown holds places to break: the sentence itself is copied by the menu.
  auto* copy = new QAction(tr("Copy message"), text_);
  copy->setObjectName("message.copy");
  connect(copy, &QAction::triggered, this,
          [this] { QGuiApplication::clipboard()->setText(sentence_); });
  text_->addAction(copy);
  text_->setContextMenuPolicy(Qt::ActionsContextMenu);
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(theme::kMargin + 4, 4, theme::kMargin, 4);
  layout->setSpacing(theme::kSpacing);
  layout->addWidget(icon_);
  layout->addWidget(text_, 1);
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
  timer_.setInterval(kStay);
  connect(close_, &QToolButton::clicked, this, &MessageBar::dismiss);
  connect(&timer_, &QTimer::timeout, this, &MessageBar::dismiss);
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
    timer_.start();
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

void MessageBar::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), theme::blend(palette().color(QPalette::Window), accent(), 0.14));
  painter.fillRect(QRect(0, 0, 4, height()), accent());
}

void MessageBar::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) updateIcon();
}

}  // namespace episcope

#include "moc_message_bar.cpp"
