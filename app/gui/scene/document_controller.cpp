// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/scene/document_controller.h"

#include "annotation/exchange.h"
#include "app/session/user_folders.h"
#include "engine/core/error.h"

#include <algorithm>
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
  stroke_.reset();
  finish(now_);
  for (auto& [scene, open] : aside_) finish(open);
}

const AnnotationDocument* DocumentController::document() const {
  return isCurrent() ? &now_.annotation->document() : nullptr;
}

const LabelSet& DocumentController::labels() const {
  static const LabelSet kNone;
  return isCurrent() ? now_.annotation->document().labels() : kNone;
}

bool DocumentController::isCurrent() const {
  return now_.annotation && generation_ == session_.generation();
}

bool DocumentController::Open::has_unsaved_changes() const {
  return annotation && annotation->document().has_unsaved_changes() &&
         annotation->document().state() != discarded_state;
}

void DocumentController::Open::note_kept(const EditedDocument& kept) {
  const AnnotationDocument& document = annotation->document();
  stored = kept.stored;
  if (document.state() == kept.state && document.has_unsaved_changes()) project_state = kept.state;
}

bool DocumentController::isInProjectOnly() const {
  return isCurrent() && !hasUnsavedChanges() &&
         now_.project_state == now_.annotation->document().state();
}

void DocumentController::update(Parts parts) {
  if (parts.has(Part::Scenes)) leaveClosed();
  if (!parts.has(Part::Scene) || generation_ == session_.generation()) return;
  leaveDocument();
  generation_ = session_.generation();
  if (session_.scene() && !takeAside()) openDocument();
  if (session_.scene()) beginHash();
  emit replaced();
  tellUnsaved();
}

void DocumentController::leaveClosed() {
  for (auto each = aside_.begin(); each != aside_.end();) {
    const bool is_open = session_.find_scene(each->first) != nullptr;
    if (!is_open) finish(each->second);
    each = is_open ? std::next(each) : aside_.erase(each);
  }
}

bool DocumentController::takeAside() {
  const auto found = aside_.find(generation_);
  if (found == aside_.end()) return false;
  now_ = std::move(found->second);
  aside_.erase(found);
  const ScribbleLayer& layer = now_.annotation->document().scribbles();
  const LightField& light_field = *session_.light_field();
  if (layer.grid() == light_field.grid() && layer.height() == light_field.height() &&
      layer.width() == light_field.width()) {
    run([this] { now_.annotation->set_source(session_.input()); });
    return true;
  }
  const QString name = QString::fromStdString(light_field.info().name);
  const bool is_stored = !now_.stored.empty();
  session_.set_unread_strokes(generation_, now_.stored);
  finish(now_);
  now_ = {};
  emit finding((is_stored ? tr("The scribbles on “%1” belong to a light field of another size; "
                               "they are kept in the project.")
                          : tr("The scribbles on “%1” belong to a light field of another size; "
                               "they are offered again at the next start."))
                   .arg(name));
  return false;
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
    emit finding(tr("The scribbles of this light field cannot be edited: %1. They are left "
                    "unchanged; new scribbles are saved to another file.")
                     .arg(QString::fromUtf8(error.what())));
  }
}

void DocumentController::beginHash() {
  hash_job_.start<std::uint64_t>([light_field = session_.light_field()](
                                     const Progress&) { return light_field->sample_hash(); },
                                 [this](std::uint64_t hash) {
                                   sample_hash_ = hash;
                                   session_.set_sample_hash(generation_, hash);
                                   if (now_.annotation) now_.annotation->set_sample_hash(hash);
                                 });
}

void DocumentController::setDocument(AnnotationDocument document, bool is_whole,
                                     const std::string& file) {
  written_state_.reset();
  now_ = {};
  now_.is_whole = is_whole;
  now_.annotation = std::make_unique<Annotation>(
      std::move(document),
      JournalOwner{session_.light_field()->info().name, session_.input(), sample_hash_,
                   session_.scene()->convention.focus_px, file},
      journal_folder_);
}

void DocumentController::finish(Open& open) {
  if (open.annotation && !open.has_unsaved_changes()) open.annotation->finish();
  open.annotation.reset();
}

void DocumentController::leaveDocument() {
  const bool stays_open = session_.find_scene(generation_) != nullptr;
  if (stays_open && stroke_) run([this] { stroke_->commit(); });
  stroke_.reset();
  hash_job_.drop();
  sample_hash_ = 0;
  if (!now_.annotation) return;
  if (stays_open) {
    aside_[generation_] = std::move(now_);
  } else {
    finish(now_);
  }
  now_ = {};
}

std::string DocumentController::file() const {
  return isCurrent() ? now_.annotation->file() : std::string();
}

bool DocumentController::replace(AnnotationDocument document, bool is_whole,
                                 const std::string& file) {
  if (!isCurrent()) return false;
  stroke_.reset();
  now_.annotation->finish();
  setDocument(std::move(document), is_whole, file);
  const bool is_kept = keepJournal();
  emit replaced();
  tellUnsaved();
  return is_kept;
}

DocumentController::Open* DocumentController::findAside(std::uint64_t scene) {
  const auto found = aside_.find(scene);
  return found == aside_.end() ? nullptr : &found->second;
}

void DocumentController::noteSaved(std::uint64_t scene, std::uint64_t state,
                                   const std::string& file) {
  const bool is_shown = scene == generation_ && isCurrent();
  Open* open = is_shown ? &now_ : findAside(scene);
  if (!open) return;
  run(*open, [&] { open->annotation->set_file(file); });
  open->project_state.reset();
  markSaved(*open, state);
}

void DocumentController::markSaved(Open& open, std::uint64_t state) {
  if (&open == &now_ && stroke_) {
    written_state_ = state;
  } else if (open.annotation->document().state() == state) {
    run(open, [&] { open.annotation->document().mark_saved(); });
  }
  tellUnsaved();
}

void DocumentController::discardChanges() {
  endStroke();
  if (isCurrent()) now_.discarded_state = now_.annotation->document().state();
  tellUnsaved();
}

void DocumentController::discardAll() {
  discardChanges();
  for (auto& [scene, open] : aside_) open.discarded_state = open.annotation->document().state();
}

std::vector<std::uint64_t> DocumentController::unsavedScenes() const {
  std::vector<std::uint64_t> scenes;
  for (const auto& [scene, open] : aside_) {
    if (open.has_unsaved_changes()) scenes.push_back(scene);
  }
  if (hasUnsavedChanges()) scenes.push_back(generation_);
  return scenes;
}

std::vector<EditedDocument> DocumentController::editedDocuments() const {
  std::vector<EditedDocument> documents;
  const auto add = [&](std::uint64_t scene, const Open& open) {
    if (!open.annotation || !open.annotation->has_journal()) return;
    documents.push_back(
        {scene, open.annotation->journal_path(), open.annotation->document().state()});
  };
  for (const auto& [scene, open] : aside_) add(scene, open);
  add(generation_, now_);
  return documents;
}

void DocumentController::noteKept(const std::vector<EditedDocument>& documents) {
  for (const EditedDocument& each : documents) {
    const bool is_shown = each.scene == generation_ && isCurrent();
    Open* open = is_shown ? &now_ : findAside(each.scene);
    if (!open) continue;
    open->note_kept(each);
    markSaved(*open, each.state);
  }
}

bool DocumentController::bring(std::uint64_t scene, RecoveredAnnotation found,
                               std::filesystem::path stored) {
  const bool is_saved = !stored.empty();
  if (!is_saved) found.document.forget_saved();
  Open& open = aside_[scene];
  open = {};
  open.annotation = std::make_unique<Annotation>(std::move(found.document), std::move(found.owner),
                                                 journal_folder_);
  open.stored = std::move(stored);
  const bool is_kept = keepJournal(open);
  if (is_saved) {
    const std::uint64_t state = open.annotation->document().state();
    open.note_kept({scene, {}, state, open.stored});
    markSaved(open, state);
  }
  return is_kept;
}

bool DocumentController::keepJournal() {
  return isCurrent() && keepJournal(now_);
}

bool DocumentController::keepJournal(Open& open) {
  try {
    open.annotation->keep_journal();
  } catch (const IoError& error) {
    session_.set_unread_strokes(sceneOf(open), open.stored);
    emit problem(QString::fromUtf8(error.what()));
  }
  return open.annotation->has_journal();
}

std::uint64_t DocumentController::sceneOf(const Open& open) const {
  const auto found =
      std::ranges::find_if(aside_, [&](const auto& each) { return &each.second == &open; });
  return found == aside_.end() ? generation_ : found->first;
}

void DocumentController::run(Open& open, const std::function<void()>& change) {
  try {
    change();
  } catch (const IoError& error) {
    open.annotation->drop_journal();
    session_.set_unread_strokes(sceneOf(open), open.stored);
    emit problem(tr("Scribbles can no longer be recovered after a crash, so save them soon: %1")
                     .arg(QString::fromUtf8(error.what())));
  } catch (const Error& error) {
    emit problem(QString::fromUtf8(error.what()));
  }
}

bool DocumentController::edit(const std::function<void(AnnotationDocument&)>& change) {
  endStroke();
  if (!isCurrent()) return false;
  keepJournal();
  AnnotationDocument& document = now_.annotation->document();
  const std::uint64_t before = document.state();
  const DocumentChange what = everything();
  run([&] { change(document); });
  if (document.state() == before) return false;
  DocumentChange all = everything();
  all.views.insert(all.views.end(), what.views.begin(), what.views.end());
  tell(all);
  return true;
}

void DocumentController::go(DocumentChange (AnnotationDocument::*step)()) {
  endStroke();
  if (!isCurrent()) return;
  keepJournal();
  AnnotationDocument& document = now_.annotation->document();
  const std::uint64_t before = document.state();
  const bool is_undo = step == &AnnotationDocument::undo;
  const History<Edit>& history = document.history();
  const Edit* edit = is_undo ? history.next_undo() : history.next_redo();
  DocumentChange change;
  run([&] {
    change = (document.*step)();
    const Edit* label = history.next_undo();
    if (!label || label->kind != EditKind::AddPaintedLabel) return;
    const DocumentChange other = (document.*step)();
    change.views.insert(change.views.end(), other.views.begin(), other.views.end());
    change.has_new_labels = true;
  });
  if (document.state() == before) return;
  if (change.empty()) change = everything();  // made, but the journal failed
  tell(change);
  if (edit) emit steppedBack(change, *edit, is_undo);
}

bool DocumentController::beginStroke(ViewIndex view, const PaintStyle& style, StrokePoint at) {
  endStroke();
  if (!isCurrent()) return false;
  keepJournal();
  run([&] {
    stroke_ = std::make_unique<Stroke>(now_.annotation->document(), view, style);
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
  AnnotationDocument& document = now_.annotation->document();
  const std::uint64_t before = document.state();
  run([this] { stroke_->commit(); });
  stroke_.reset();
  if (document.state() != before) tell({{{stroke_view_, stroke_rect_}}, false});
  if (const auto written = std::exchange(written_state_, {})) markSaved(now_, *written);
}

void DocumentController::cancelStroke() {
  if (!stroke_) return;
  stroke_.reset();
  if (!stroke_rect_.empty()) emit painted(stroke_view_, stroke_rect_);
  if (const auto written = std::exchange(written_state_, {})) markSaved(now_, *written);
}

DocumentChange DocumentController::everything() const {
  DocumentChange change;
  change.has_new_labels = change.has_new_smoothing = true;
  const ScribbleLayer& layer = now_.annotation->document().scribbles();
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

void LabelChoice::followDocument() {
  const LabelSet& labels = document_.labels();
  if (!labels.contains(current_)) current_ = labels.contains(former_) ? former_ : 0;
  if (!labels.contains(former_)) former_ = 0;
  if (current_ == 0 && !labels.labels().empty()) current_ = labels.labels().front().id;
  emit changed();
}

const LabelInfo* LabelChoice::info() const {
  return document_.labels().find(current_);
}

std::string LabelChoice::newName() const {
  return tr("label %1").arg(document_.labels().next_id()).toStdString();
}

bool LabelChoice::choose(int id) {
  if (!document_.labels().contains(id)) return false;
  if (id == current_) return true;
  former_ = std::exchange(current_, id);
  emit changed();
  return true;
}

void LabelChoice::chooseNext() {
  const auto& labels = document_.labels().labels();
  if (labels.empty()) return;
  const auto next = std::ranges::upper_bound(labels, current_, {}, &LabelInfo::id);
  choose(next == labels.end() ? labels.front().id : next->id);
}

void LabelChoice::offerRegion(int label, std::function<void(int)> give) {
  const bool had = hasRegion();
  region_label_ = label;
  give_ = std::move(give);
  if (had || hasRegion()) emit regionChanged();
}

void LabelChoice::giveRegion(int id) {
  const auto give = give_;
  offerRegion(0, nullptr);
  if (give) give(id);
}

}  // namespace episcope

#include "moc_document_controller.cpp"
