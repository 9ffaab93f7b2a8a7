// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/document/document_controller.h"

#include "annotation/document/exchange.h"
#include "app/session/scene/user_folders.h"
#include "engine/core/error.h"

#include <utility>

namespace episcope {

DocumentController::DocumentController(Session& session, QObject* parent)
    : QObject(parent),
      session_(session),
      journal_folder_(default_journal_folder()),
      hash_job_(this) {
  session_.on_changed([this](Parts parts) { update(parts); });
}

DocumentController::~DocumentController() {
  leaveDocument();
}

void DocumentController::setJournalFolder(std::filesystem::path folder) {
  journal_folder_ = std::move(folder);
}

AnnotationDocument* DocumentController::document() {
  return isCurrent() ? &annotation_->document() : nullptr;
}

const AnnotationDocument* DocumentController::document() const {
  return isCurrent() ? &annotation_->document() : nullptr;
}

bool DocumentController::isCurrent() const {
  return annotation_ && generation_ == session_.generation();
}

bool DocumentController::hasUnsavedChanges() const {
  return isCurrent() && annotation_->document().has_unsaved_changes() &&
         annotation_->document().state() != discarded_state_;
}

void DocumentController::update(Parts parts) {
  if (!parts.has(Part::Scene)) return;
  leaveDocument();
  hash_job_.drop();
  generation_ = session_.generation();
  if (session_.scene()) openDocument();
  emit replaced();
  tellUnsaved();
}

void DocumentController::openDocument() {
  const LightFieldPtr light_field = session_.light_field();
  const auto make = [&](const Scribbles& scribbles) {
    return document_from(scribbles, light_field->grid(), light_field->height(),
                         light_field->width());
  };
  try {
    setDocument(make(session_.scene()->scribbles), true, {});
  } catch (const InvalidInput& error) {
    setDocument(make({}), false, {});
    emit problem(tr("The scribbles of this light field cannot be edited: %1. They are left "
                    "unchanged, and what you paint is saved to another file.")
                     .arg(QString::fromUtf8(error.what())));
  }
  hash_job_.start<std::uint64_t>(
      [light_field](const Progress&) { return light_field->sample_hash(); },
      [this](std::uint64_t hash) {
        sample_hash_ = hash;
        if (annotation_) annotation_->set_sample_hash(hash);
      });
}

void DocumentController::setDocument(AnnotationDocument document, bool is_whole,
                                     const std::string& file) {
  is_whole_ = is_whole;
  written_state_.reset();
  discarded_state_.reset();
  annotation_ = std::make_unique<Annotation>(
      std::move(document),
      JournalOwner{session_.light_field()->info().name, session_.input(), sample_hash_,
                   session_.scene()->convention.focus_px, file},
      journal_folder_);
}

// A journal with unsaved changes stays, to be offered at the next start.
void DocumentController::leaveDocument() {
  stroke_.reset();
  sample_hash_ = 0;
  if (!annotation_) return;
  const AnnotationDocument& document = annotation_->document();
  if (!document.has_unsaved_changes() || document.state() == discarded_state_) {
    annotation_->finish();
  }
  annotation_.reset();
}

std::string DocumentController::file() const {
  return isCurrent() ? annotation_->file() : std::string();
}

void DocumentController::replace(AnnotationDocument document, bool is_whole,
                                 const std::string& file) {
  if (!isCurrent()) return;
  stroke_.reset();
  annotation_->finish();
  setDocument(std::move(document), is_whole, file);
  keepJournal();
  emit replaced();
  tellUnsaved();
}

void DocumentController::noteSaved(std::uint64_t state, const std::string& file) {
  if (!isCurrent()) return;
  run([&] { annotation_->set_file(file); });
  markSaved(state);
}

void DocumentController::markSaved(std::uint64_t state) {
  if (stroke_) {
    written_state_ = state;
  } else if (annotation_->document().state() == state) {
    run([this] { annotation_->document().mark_saved(); });
  }
  tellUnsaved();
}

void DocumentController::discardChanges() {
  endStroke();
  if (isCurrent()) discarded_state_ = annotation_->document().state();
  tellUnsaved();
}

void DocumentController::keepJournal() {
  if (!isCurrent()) return;
  try {
    annotation_->keep_journal();
  } catch (const IoError& error) {
    emit problem(QString::fromUtf8(error.what()));
  }
}

void DocumentController::run(const std::function<void()>& change) {
  try {
    change();
  } catch (const IoError& error) {
    annotation_->drop_journal();
    emit problem(tr("What you paint can no longer be recovered after a crash, so save it soon: %1")
                     .arg(QString::fromUtf8(error.what())));
  } catch (const Error& error) {
    emit problem(QString::fromUtf8(error.what()));
  }
}

bool DocumentController::edit(const std::function<void(AnnotationDocument&)>& change) {
  endStroke();
  if (!isCurrent()) return false;
  keepJournal();
  AnnotationDocument& document = annotation_->document();
  const std::uint64_t before = document.state();
  const DocumentChange what = everything();
  run([&] { change(document); });
  if (document.state() == before) return false;
  DocumentChange all = everything();
  all.views.insert(all.views.end(), what.views.begin(), what.views.end());
  tell(all);
  return true;
}

void DocumentController::undo() {
  go(&AnnotationDocument::undo);
}

void DocumentController::redo() {
  go(&AnnotationDocument::redo);
}

void DocumentController::go(DocumentChange (AnnotationDocument::*step)()) {
  endStroke();
  if (!isCurrent()) return;
  keepJournal();
  AnnotationDocument& document = annotation_->document();
  const std::uint64_t before = document.state();
  DocumentChange change;
  run([&] { change = (document.*step)(); });
  if (document.state() == before) return;
  if (change.empty()) change = everything();  // made, but the journal failed
  tell(change);
  emit steppedBack(change);
}

bool DocumentController::beginStroke(ViewIndex view, const PaintStyle& style, StrokePoint at) {
  endStroke();
  if (!isCurrent()) return false;
  keepJournal();
  run([&] {
    stroke_ = std::make_unique<Stroke>(annotation_->document(), view, style);
    stroke_view_ = view;
    stroke_rect_ = {};
  });
  extendStroke(at);
  return isStroking();
}

void DocumentController::extendStroke(StrokePoint at) {
  if (!stroke_) return;
  PixelRect rect;
  run([&] { rect = stroke_->extend(at); });
  if (rect.empty()) return;
  stroke_rect_.include(rect);
  emit painted(stroke_view_, rect);
}

void DocumentController::endStroke() {
  if (!stroke_) return;
  AnnotationDocument& document = annotation_->document();
  const std::uint64_t before = document.state();
  run([this] { stroke_->commit(); });
  stroke_.reset();
  if (document.state() != before) tell({{{stroke_view_, stroke_rect_}}, false});
  if (const auto written = std::exchange(written_state_, {})) markSaved(*written);
}

void DocumentController::cancelStroke() {
  if (!stroke_) return;
  stroke_.reset();
  if (!stroke_rect_.empty()) emit painted(stroke_view_, stroke_rect_);
  if (const auto written = std::exchange(written_state_, {})) markSaved(*written);
}

DocumentChange DocumentController::everything() const {
  DocumentChange change;
  change.has_new_labels = true;
  const ScribbleLayer& layer = annotation_->document().scribbles();
  for (const ViewIndex view : layer.painted_views()) {
    change.views.push_back({view, {0, 0, layer.height(), layer.width()}});
  }
  return change;
}

void DocumentController::tell(const DocumentChange& change) {
  emit changed(change);
  tellUnsaved();
}

void DocumentController::tellUnsaved() {
  const bool is_unsaved = hasUnsavedChanges();
  if (std::exchange(was_unsaved_, is_unsaved) != is_unsaved) emit unsavedChanged(is_unsaved);
}

}  // namespace episcope

#include "moc_document_controller.cpp"
