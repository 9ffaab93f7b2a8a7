// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/document/label_choice.h"

#include <algorithm>
#include <utility>

namespace episcope {

LabelChoice::LabelChoice(DocumentController& document, QObject* parent)
    : QObject(parent), document_(document) {
  connect(&document_, &DocumentController::replaced, this, [this] {
    current_ = former_ = 0;
    followDocument();
  });
  connect(&document_, &DocumentController::changed, this, [this](const DocumentChange& change) {
    if (change.has_new_labels) followDocument();
  });
}

bool LabelChoice::isKnown(int id) const {
  const AnnotationDocument* document = std::as_const(document_).document();
  return document && document->labels().contains(id);
}

void LabelChoice::followDocument() {
  if (!isKnown(current_)) current_ = isKnown(former_) ? former_ : 0;
  if (!isKnown(former_)) former_ = 0;
  const AnnotationDocument* document = std::as_const(document_).document();
  if (current_ == 0 && document && !document->labels().labels().empty()) {
    current_ = document->labels().labels().front().id;
  }
  emit changed();
}

const LabelInfo* LabelChoice::info() const {
  const AnnotationDocument* document = std::as_const(document_).document();
  return document ? document->labels().find(current_) : nullptr;
}

bool LabelChoice::choose(int id) {
  if (!isKnown(id)) return false;
  if (id == current_) return true;
  former_ = std::exchange(current_, id);
  emit changed();
  return true;
}

void LabelChoice::chooseNext() {
  const AnnotationDocument* document = std::as_const(document_).document();
  if (!document || document->labels().labels().empty()) return;
  const auto& labels = document->labels().labels();
  const auto next = std::ranges::upper_bound(labels, current_, {}, &LabelInfo::id);
  choose(next == labels.end() ? labels.front().id : next->id);
}

void LabelChoice::swap() {
  if (former_ != 0) choose(former_);
}

}  // namespace episcope

#include "moc_label_choice.cpp"
