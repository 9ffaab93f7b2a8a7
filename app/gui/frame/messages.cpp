// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/messages.h"

#include "app/gui/frame/frame.h"
#include "widgets/controls/message_bar.h"

namespace episcope {

Messages::Messages(Frame& frame) : bar_(new MessageBar(&frame)) {
  frame.addFloating(bar_);
}

void Messages::hint(const QString& sentence) {
  bar_->showMessage(Severity::Info, sentence);
}

void Messages::success(const QString& sentence) {
  bar_->showMessage(Severity::Success, sentence);
}

void Messages::warn(const QString& sentence) {
  bar_->showMessage(Severity::Warning, sentence);
}

void Messages::fail(const QString& sentence) {
  bar_->showMessage(Severity::Error, sentence);
}

void Messages::written(const QString& path) {
  success(tr("Written: %1").arg(path));
}

void Messages::offer(const QString& sentence, const QString& button, std::function<void()> run) {
  bar_->showMessage(Severity::Info, sentence, {button, std::move(run)});
}

void Messages::dismiss() {
  bar_->dismiss();
}

bool Messages::isShown(const QString& sentence) const {
  return !bar_->isHidden() && bar_->text() == sentence;
}

void Messages::retract(const QString& sentence) {
  if (isShown(sentence)) bar_->dismiss();
}

}  // namespace episcope

#include "moc_messages.cpp"
