// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/annotation_journal.h"

#include "app/session/user_folders.h"
#include "engine/core/error.h"
#include "engine/io/base/files.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <functional>
#include <random>
#include <utility>

namespace episcope {
namespace {

namespace fs = std::filesystem;

constexpr const char* kJournalSuffix = ".journal";

io::LogRecord step_record(const DocumentEvent& event) {
  ByteWriter out;
  out.byte(static_cast<std::uint8_t>(event.step));
  if (event.step == DocumentStep::Edited) write_edit(*event.edit, out);
  return out.bytes();
}

fs::path new_path(const fs::path& folder, const std::string& name) {
  std::random_device random;
  char suffix[24];
  std::snprintf(suffix, sizeof suffix, "-%08x", static_cast<unsigned>(random()));
  const std::string stem = file_name_of(name);
  return folder / ((stem.empty() ? "session" : stem) + suffix + kJournalSuffix);
}

}  // namespace

Annotation::Annotation(AnnotationDocument document, JournalOwner owner, fs::path folder)
    : document_(std::move(document)), owner_(std::move(owner)), folder_(std::move(folder)) {}

void Annotation::set(std::string JournalOwner::*member, const std::string& value) {
  owner_.*member = value;
  if (log_ && written_owner_ != owner_) rewrite();
}

void Annotation::keep_journal() {
  if (log_ || folder_.empty()) return;
  try {
    io::make_folder(folder_,
                    ", so nothing painted could be recovered after a crash; create it or make its "
                    "parent writable");
    path_ = new_path(folder_, owner_.name);
    rewrite();
  } catch (const IoError&) {
    folder_.clear();
    throw;
  }
  document_.set_observer([this](const DocumentEvent& event) { record(event); });
}

void Annotation::drop_journal() {
  document_.set_observer({});
  log_.reset();
  folder_.clear();
}

void Annotation::finish() {
  if (log_) discard_journal(path_);
  drop_journal();
}

void Annotation::record(const DocumentEvent& event) {
  log_->append(step_record(event));
  if (log_->byte_size() > 2 * first_bytes_ + kSlackBytes) rewrite();
}

void Annotation::rewrite() {
  log_.emplace(path_, io::LogFraming::Checked, io::LogFlush::InBackground,
               journal_records(owner_, document_));
  first_bytes_ = log_->byte_size();
  written_owner_ = owner_;
}

RecoveredAnnotation read_journal(const fs::path& path) {
  try {
    return replay(io::read_log(path, io::LogFraming::Checked));
  } catch (const InvalidInput& error) {
    throw IoError(path, std::string(error.what()) + "; nothing can be recovered");
  }
}

namespace {

// All of them if the saved state is no longer among those that the history keeps.
int unsaved_strokes(const AnnotationDocument& document) {
  const History<Edit>& history = document.history();
  int strokes = 0;
  for (std::size_t i = history.applied_count(); i-- > 0;) {
    if (history.state_after(i + 1) == document.saved_state()) break;
    if (!history.edit(i).views.empty()) ++strokes;
  }
  return strokes;
}

}  // namespace

std::vector<RecoverableJournal> recoverable_journals(const fs::path& folder) {
  std::vector<RecoverableJournal> left;
  for (const OrphanedJournal& each : orphaned_journals(folder)) {
    try {
      RecoveredAnnotation found = read_journal(each.path);
      if (found.document.has_unsaved_changes()) {
        left.push_back(
            {each.path, std::move(found.owner), each.last_change, unsaved_strokes(found.document)});
        continue;
      }
    } catch (const IoError&) {
      // Of a later program, or for the moment not to be read: another start may have more luck.
      if (std::error_code error; fs::file_size(each.path, error) != 0 || error) continue;
    }
    discard_journal(each.path);
  }
  return left;
}

void discard_journal(const fs::path& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
}

namespace {

constexpr std::uint64_t kJournalVersion = 1;
constexpr auto kMaxExtent = std::uint64_t{ScribbleLayer::kMaxExtent};
// What no light field exceeds; a damaged head must not ask for memory that none has.
constexpr int kMostViewsOfSide = 1000;
constexpr std::int64_t kMostPixelsOfView = std::int64_t{1} << 28;

PixelRect whole(const ScribbleLayer& layer) {
  return {0, 0, layer.height(), layer.width()};
}

/// The edit that makes a document from an empty one.
Edit base_edit(const LabelSet& labels, const ScribbleLayer& layer, double smoothing_px) {
  Edit edit{EditKind::Import, {}, LabelSetEdit{{}, labels}};
  if (smoothing_px > 0) edit.smoothing = SmoothingEdit{0, smoothing_px};
  for (const ViewIndex view : layer.painted_views()) {
    edit.views.push_back(difference(view, {}, layer.view(view), whole(layer)));
  }
  return edit;
}

/// The document before the oldest edit that its history keeps.
Edit base_of(const AnnotationDocument& document) {
  if (document.history().applied_count() == 0) {
    return base_edit(document.labels(), document.scribbles(), document.boundary_smoothing_px());
  }
  LabelSet labels = document.labels();
  ScribbleLayer layer = document.scribbles();
  double smoothing_px = document.boundary_smoothing_px();
  for (std::size_t i = document.history().applied_count(); i-- > 0;) {
    const Edit& edit = document.history().edit(i);
    for (const ViewEdit& part : edit.views) put_labels(part, EditSide::Before, layer);
    if (edit.labels) labels = edit.labels->before;
    if (edit.smoothing) smoothing_px = edit.smoothing->before;
  }
  return base_edit(labels, layer, smoothing_px);
}

io::LogRecord head_record(const JournalOwner& owner, const AnnotationDocument& document) {
  const ScribbleLayer& layer = document.scribbles();
  ByteWriter out;
  out.number(kJournalVersion);
  out.text(owner.name);
  out.text(owner.source);
  out.number(owner.sample_hash);
  for (const int extent : {layer.grid().v, layer.grid().u, layer.height(), layer.width()}) {
    out.number(static_cast<std::uint64_t>(extent));
  }
  out.number(document.history().max_bytes());
  out.number(std::bit_cast<std::uint64_t>(owner.focus_px));
  out.text(owner.file);
  return out.bytes();
}

io::LogRecord base_record(const AnnotationDocument& document) {
  ByteWriter out;
  const bool is_saved = document.saved_state() == document.history().state_after(0);
  out.byte(is_saved ? 1 : 0);
  write_edit(base_of(document), out);
  return out.bytes();
}

struct Head {
  JournalOwner owner;
  GridShape grid;
  int height = 0;
  int width = 0;
  std::size_t history_bytes = 0;
};

void require_possible(const Head& head) {
  if (std::max(head.grid.v, head.grid.u) > kMostViewsOfSide ||
      std::int64_t{head.height} * head.width > kMostPixelsOfView) {
    throw InvalidInput("the journal is of more views, or larger ones, than any light field has");
  }
}

Head read_head(const io::LogRecord& record) {
  ByteReader in(record);
  if (in.number() != kJournalVersion) throw InvalidInput("the journal is of another version");
  Head head;
  head.owner.name = in.text();
  head.owner.source = in.text();
  head.owner.sample_hash = in.number();
  for (int* extent : {&head.grid.v, &head.grid.u, &head.height, &head.width}) {
    *extent = static_cast<int>(in.number(kMaxExtent));
  }
  require_possible(head);
  head.history_bytes = static_cast<std::size_t>(in.number());
  // Journals of earlier programs end here, or after the next.
  if (!in.at_end()) head.owner.focus_px = std::bit_cast<double>(in.number());
  if (!in.at_end()) head.owner.file = in.text();
  return head;
}

AnnotationDocument read_base(const Head& head, const io::LogRecord& record) {
  ByteReader in(record);
  const bool is_saved = in.byte() != 0;
  // Applied to a document of its own first, which checks that it fits.
  AnnotationDocument base(head.grid, head.height, head.width, 0);
  base.apply(read_edit(in));
  AnnotationDocument document(base.labels(), base.scribbles(), head.history_bytes,
                              base.boundary_smoothing_px());
  if (!is_saved) document.forget_saved();
  return document;
}

void replay_step(const io::LogRecord& record, AnnotationDocument& document) {
  ByteReader in(record);
  const std::uint8_t step = in.byte();
  switch (static_cast<DocumentStep>(step)) {
    case DocumentStep::Edited:
      document.apply(read_edit(in));
      return;
    case DocumentStep::Undone:
      document.undo();
      return;
    case DocumentStep::Redone:
      document.redo();
      return;
    case DocumentStep::Saved:
      document.mark_saved();
      return;
  }
  throw InvalidInput("the journal holds an unknown step " + std::to_string(step));
}

}  // namespace

std::vector<io::LogRecord> journal_records(const JournalOwner& owner,
                                           const AnnotationDocument& document) {
  const History<Edit>& history = document.history();
  std::vector<io::LogRecord> records{head_record(owner, document), base_record(document)};
  for (std::size_t i = 0; i < history.count(); ++i) {
    records.push_back(step_record({DocumentStep::Edited, &history.edit(i)}));
    if (history.state_after(i + 1) == document.saved_state()) {
      records.push_back(step_record({DocumentStep::Saved, nullptr}));
    }
  }
  for (std::size_t i = history.count(); i > history.applied_count(); --i) {
    records.push_back(step_record({DocumentStep::Undone, nullptr}));
  }
  return records;
}

RecoveredAnnotation replay(const std::vector<io::LogRecord>& records) {
  if (records.size() < 2) throw InvalidInput("the journal ends before the document begins");
  const Head head = read_head(records[0]);
  RecoveredAnnotation found{head.owner, read_base(head, records[1])};
  for (std::size_t i = 2; i < records.size(); ++i) {
    try {
      replay_step(records[i], found.document);
    } catch (const InvalidInput&) {
      break;  // What follows would build on a step that is not known.
    }
  }
  return found;
}

std::vector<OrphanedJournal> orphaned_journals(const fs::path& folder) {
  std::vector<OrphanedJournal> journals;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const fs::path& path = entry.path();
    if (path.extension() != kJournalSuffix || io::is_held(path)) continue;
    journals.push_back({path, fs::last_write_time(path, error)});
  }
  std::ranges::sort(journals, std::greater{}, &OrphanedJournal::last_change);
  return journals;
}

}  // namespace episcope
