// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/document/pending_edit.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace episcope {

PendingEdit::PendingEdit(AnnotationDocument& document, EditKind kind)
    : document_(&document), kind_(kind) {
  document.require_idle();
  document.is_editing_ = true;
}

PendingEdit::~PendingEdit() {
  if (document_) revert();
}

PendingEdit::Touched& PendingEdit::touch(ViewIndex view) {
  const auto [place, is_new] = touched_.try_emplace({view.v, view.u});
  if (is_new) {
    // The whole view, once: copying a megabyte is cheaper than determining what will be painted.
    const ImageView<const std::uint8_t> now = document_->scribbles_.view(view);
    place->second.before =
        Image<std::uint8_t>(document_->scribbles_.height(), document_->scribbles_.width());
    if (!now.empty()) std::copy_n(now.data, now.size(), place->second.before.data());
  }
  return place->second;
}

PixelRect PendingEdit::paint(ViewIndex view, const PixelRegion& region, const Ink& ink) {
  if (ink.label != 0 && !document_->labels_.contains(ink.label)) {
    throw InvalidInput(fmt::format("there is no label {} to paint with", ink.label));
  }
  PixelRect dirty;
  if (region.empty() && document_->scribbles_.view(view).empty()) return dirty;
  const ImageView<std::uint8_t> image = document_->scribbles_.writable_view(view);
  Touched& touched = touch(view);
  for (const PixelSpan& span : region) {
    std::uint8_t* row = image.row(span.y);
    if (ink.kept.none()) {
      std::fill(row + span.x0, row + span.x1, ink.label);
    } else {
      const auto may_change = [&ink](std::uint8_t label) { return !ink.kept[label]; };
      std::replace_if(row + span.x0, row + span.x1, may_change, ink.label);
    }
    dirty.include(span.rect());
  }
  touched.rect.include(dirty);
  return dirty;
}

void PendingEdit::set_labels(LabelSet labels) {
  if (!labels_before_) labels_before_ = document_->labels_;
  document_->labels_ = std::move(labels);
}

bool PendingEdit::commit() {
  AnnotationDocument& document = *std::exchange(document_, nullptr);
  Edit edit{kind_, {}, {}};
  for (const auto& [place, touched] : touched_) {
    const ViewIndex view{place.first, place.second};
    ViewEdit part =
        difference(view, touched.before.view(), document.scribbles_.view(view), touched.rect);
    if (!part.runs.empty()) edit.views.push_back(std::move(part));
  }
  if (labels_before_ && !(*labels_before_ == document.labels_)) {
    edit.labels = LabelSetEdit{std::move(*labels_before_), document.labels_};
  }
  document.is_editing_ = false;
  const bool has_change = !edit.empty();
  if (has_change) document.keep(std::move(edit));
  return has_change;
}

void PendingEdit::revert() {
  for (const auto& [place, touched] : touched_) {
    const ImageView<std::uint8_t> image =
        document_->scribbles_.writable_view({place.first, place.second});
    std::copy_n(touched.before.data(), touched.before.size(), image.data);
  }
  if (labels_before_) document_->labels_ = std::move(*labels_before_);
  document_->is_editing_ = false;
}

}  // namespace episcope
