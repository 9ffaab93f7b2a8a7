// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/document.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope {
namespace {

bool fits(const LabelRun& run, const ScribbleLayer& layer) {
  return run.length > 0 && run.y < layer.height() && run.x + run.length <= layer.width();
}

PixelRegion pixels_of(ImageView<const std::uint8_t> image, std::uint8_t label) {
  return region_where(image.height, image.width,
                      [&](int y, int x) { return image.at(y, x) == label; });
}

}  // namespace

AnnotationDocument::AnnotationDocument(GridShape grid, int height, int width,
                                       std::size_t history_bytes)
    : AnnotationDocument(LabelSet(), ScribbleLayer(grid, height, width), history_bytes) {}

AnnotationDocument::AnnotationDocument(LabelSet labels, ScribbleLayer scribbles,
                                       std::size_t history_bytes, double smoothing_px)
    : labels_(std::move(labels)),
      scribbles_(std::move(scribbles)),
      boundary_smoothing_px_(smoothing_px),
      history_(history_bytes),
      saved_(content()) {}

template <class Change>
void AnnotationDocument::edit_labels(EditKind kind, const Change& change) {
  LabelSet changed = labels_;
  change(changed);
  PendingEdit edit(*this, kind);
  edit.set_labels(std::move(changed));
  edit.commit();
}

int AnnotationDocument::add_label(const std::string& name, std::optional<Rgb> color) {
  int id = 0;
  edit_labels(EditKind::AddLabel, [&](LabelSet& labels) { id = labels.add(name, color); });
  return id;
}

void AnnotationDocument::add_painted_label(const std::string& name) {
  edit_labels(EditKind::AddPaintedLabel, [&](LabelSet& labels) { labels.add(name); });
}

void AnnotationDocument::rename_label(int id, const std::string& name) {
  edit_labels(EditKind::RenameLabel, [&](LabelSet& labels) { labels.rename(id, name); });
}

void AnnotationDocument::recolor_label(int id, Rgb color) {
  edit_labels(EditKind::RecolorLabel, [&](LabelSet& labels) { labels.recolor(id, color); });
}

void AnnotationDocument::remove_label(int id) {
  LabelSet changed = labels_;
  changed.remove(id);
  take_over(EditKind::RemoveLabel, id, 0, std::move(changed));
}

void AnnotationDocument::merge_label(int id, int into) {
  if (!labels_.contains(into) || into == id) {
    throw InvalidInput(fmt::format("label {} cannot be merged into label {}", id, into));
  }
  LabelSet changed = labels_;
  changed.remove(id);
  take_over(EditKind::MergeLabel, id, static_cast<std::uint8_t>(into), std::move(changed));
}

void AnnotationDocument::renumber_label(int id, int to) {
  if (id == to) return;
  LabelSet changed = labels_;
  changed.renumber(id, to);
  take_over(EditKind::RenumberLabel, id, static_cast<std::uint8_t>(to), std::move(changed));
}

void AnnotationDocument::move_label(int id, int place) {
  edit_labels(EditKind::MoveLabel, [&](LabelSet& labels) { labels.move(id, place); });
}

void AnnotationDocument::take_over(EditKind kind, int id, std::uint8_t by, LabelSet labels) {
  PendingEdit edit(*this, kind);
  edit.set_labels(std::move(labels));
  for (const ViewIndex view : scribbles_.painted_views()) {
    edit.paint(view, pixels_of(scribbles_.view(view), static_cast<std::uint8_t>(id)), {by, {}});
  }
  edit.commit();
}

void AnnotationDocument::set_boundary_smoothing(double smoothing_px) {
  require_idle();
  const double rounded = std::round(std::clamp(smoothing_px, 0.0, kMaxSmoothing_px) * 100) / 100;
  if (rounded == boundary_smoothing_px_) return;
  Edit edit{EditKind::SmoothBoundaries, {}, {}, SmoothingEdit{boundary_smoothing_px_, rounded}};
  put(edit, EditSide::After);
  keep(std::move(edit));
}

DocumentChange AnnotationDocument::undo() {
  require_idle();
  const Edit* edit = history_.next_undo();
  if (!edit) return {};
  DocumentChange change = put(*edit, EditSide::Before);
  history_.undo();
  tell(DocumentStep::Undone, edit);
  return change;
}

DocumentChange AnnotationDocument::redo() {
  require_idle();
  const Edit* edit = history_.next_redo();
  if (!edit) return {};
  DocumentChange change = put(*edit, EditSide::After);
  history_.redo();
  tell(DocumentStep::Redone, edit);
  return change;
}

DocumentChange AnnotationDocument::apply(const Edit& edit) {
  require_idle();
  require_fitting(edit);
  DocumentChange change = put(edit, EditSide::After);
  keep(edit);
  return change;
}

bool AnnotationDocument::has_unsaved_changes() const {
  return state() != saved_state_ && saved_ != content();
}

void AnnotationDocument::forget_saved() {
  saved_state_ = kNoState;
  saved_.reset();
}

void AnnotationDocument::mark_saved() {
  require_idle();
  saved_state_ = state();
  saved_ = content();
  tell(DocumentStep::Saved, nullptr);
}

void AnnotationDocument::require_idle() const {
  if (is_editing_) {
    throw InvalidInput("an edit is in progress; commit or revert it first");
  }
}

void AnnotationDocument::require_fitting(const Edit& edit) const {
  for (const ViewEdit& part : edit.views) {
    const bool is_sound =
        scribbles_.grid().contains(part.view) &&
        std::ranges::all_of(part.runs, [&](const LabelRun& run) { return fits(run, scribbles_); });
    if (!is_sound) {
      throw InvalidInput(fmt::format("an edit of view ({}) does not fit {}×{} views of {}×{} px",
                                     view_text(part.view), scribbles_.grid().v, scribbles_.grid().u,
                                     scribbles_.width(), scribbles_.height()));
    }
  }
}

DocumentChange AnnotationDocument::put(const Edit& edit, EditSide side) {
  DocumentChange change;
  for (const ViewEdit& part : edit.views) {
    put_labels(part, side, scribbles_);
    change.views.push_back({part.view, part.rect});
  }
  if (edit.labels) {
    labels_ = side == EditSide::After ? edit.labels->after : edit.labels->before;
    change.has_new_labels = true;
  }
  if (edit.smoothing) {
    boundary_smoothing_px_ =
        side == EditSide::After ? edit.smoothing->after : edit.smoothing->before;
    change.has_new_smoothing = true;
  }
  return change;
}

void AnnotationDocument::keep(Edit edit) {
  if (!observer_) {
    history_.push(std::move(edit));
    return;
  }
  const Edit kept = edit;  // The history may forget it at once.
  history_.push(std::move(edit));
  tell(DocumentStep::Edited, &kept);
}

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

namespace {

constexpr auto kMaxPlace = std::uint64_t{ScribbleLayer::kMaxExtent};
constexpr std::uint8_t kHasLabels = 1;
constexpr std::uint8_t kHasSmoothing = 2;
constexpr auto kMaxView = std::uint64_t{std::numeric_limits<int>::max()};

void write_labels(const LabelSet& labels, ByteWriter& out) {
  out.number(static_cast<std::uint64_t>(labels.last_id()));
  out.number(labels.labels().size());
  for (const LabelInfo& label : labels.labels()) {
    out.number(static_cast<std::uint64_t>(label.id));
    out.text(label.name);
    for (const std::uint8_t channel : label.color) out.byte(channel);
  }
}

LabelSet read_labels(ByteReader& in) {
  LabelSet labels;
  labels.reserve_ids(static_cast<int>(in.number(LabelSet::kMaxId)));
  for (auto left = in.number(LabelSet::kMaxId); left > 0; --left) {
    LabelInfo label;
    label.id = static_cast<int>(in.number(LabelSet::kMaxId));
    label.name = in.text();
    for (std::uint8_t& channel : label.color) channel = in.byte();
    labels.insert(std::move(label));
  }
  return labels;
}

void write_view(const ViewEdit& edit, ByteWriter& out) {
  out.number(static_cast<std::uint64_t>(edit.view.v));
  out.number(static_cast<std::uint64_t>(edit.view.u));
  out.number(edit.runs.size());
  int y = 0;
  for (const LabelRun& run : edit.runs) {
    out.number(static_cast<std::uint64_t>(run.y - y));
    out.number(run.x);
    out.number(run.length);
    out.byte(run.before);
    out.byte(run.after);
    y = run.y;
  }
}

ViewEdit read_view(ByteReader& in) {
  ViewEdit edit;
  edit.view.v = static_cast<int>(in.number(kMaxView));
  edit.view.u = static_cast<int>(in.number(kMaxView));
  std::uint64_t y = 0;
  for (auto left = in.number(in.rest()); left > 0; --left) {
    y += in.number(kMaxPlace - y);
    LabelRun run;
    run.y = static_cast<std::uint16_t>(y);
    run.x = static_cast<std::uint16_t>(in.number(kMaxPlace));
    run.length = static_cast<std::uint16_t>(in.number(kMaxPlace));
    run.before = in.byte();
    run.after = in.byte();
    edit.rect.include(PixelRect{run.y, run.x, run.y + 1, run.x + run.length});
    edit.runs.push_back(run);
  }
  return edit;
}

// In hundredths of a pixel.
void write_smoothing(double smoothing_px, ByteWriter& out) {
  out.number(static_cast<std::uint64_t>(std::lround(smoothing_px * 100)));
}

double read_smoothing(ByteReader& in) {
  constexpr auto kMost = static_cast<std::uint64_t>(AnnotationDocument::kMaxSmoothing_px * 100);
  return static_cast<double>(in.number(kMost)) / 100;
}

}  // namespace

void write_edit(const Edit& edit, ByteWriter& out) {
  out.byte(static_cast<std::uint8_t>(edit.kind));
  out.number(edit.views.size());
  for (const ViewEdit& view : edit.views) write_view(view, out);
  out.byte(static_cast<std::uint8_t>((edit.labels ? kHasLabels : 0) |
                                     (edit.smoothing ? kHasSmoothing : 0)));
  if (edit.labels) {
    write_labels(edit.labels->before, out);
    write_labels(edit.labels->after, out);
  }
  if (edit.smoothing) {
    write_smoothing(edit.smoothing->before, out);
    write_smoothing(edit.smoothing->after, out);
  }
}

Edit read_edit(ByteReader& in) {
  Edit edit;
  const std::uint8_t kind = in.byte();
  if (kind > static_cast<std::uint8_t>(kLastEditKind)) {
    throw InvalidInput(fmt::format("there is no edit of kind {}", kind));
  }
  edit.kind = static_cast<EditKind>(kind);
  for (auto left = in.number(in.rest()); left > 0; --left) edit.views.push_back(read_view(in));
  const std::uint8_t parts = in.byte();
  if ((parts & kHasLabels) != 0) {
    LabelSet before = read_labels(in);
    edit.labels = LabelSetEdit{std::move(before), read_labels(in)};
  }
  if ((parts & kHasSmoothing) != 0) {
    const double before = read_smoothing(in);
    edit.smoothing = SmoothingEdit{before, read_smoothing(in)};
  }
  return edit;
}

namespace {

constexpr std::uint8_t kMore = 0x80;
constexpr int kGroup = 7;

[[noreturn]] void refuse() {
  throw InvalidInput("the recorded edits are truncated or damaged");
}

}  // namespace

void ByteWriter::number(std::uint64_t value) {
  for (; value >= kMore; value >>= kGroup) byte(static_cast<std::uint8_t>(value | kMore));
  byte(static_cast<std::uint8_t>(value));
}

void ByteWriter::text(const std::string& value) {
  number(value.size());
  bytes_.insert(bytes_.end(), value.begin(), value.end());
}

std::uint8_t ByteReader::byte() {
  if (rest_.empty()) refuse();
  const std::uint8_t value = rest_.front();
  rest_ = rest_.subspan(1);
  return value;
}

std::uint64_t ByteReader::number(std::uint64_t max) {
  std::uint64_t value = 0;
  for (int shift = 0; shift < 64; shift += kGroup) {
    const std::uint8_t part = byte();
    value |= static_cast<std::uint64_t>(part & (kMore - 1)) << shift;
    if (part >= kMore) continue;
    if (value > max) refuse();
    return value;
  }
  refuse();
}

std::string ByteReader::text() {
  const auto size = static_cast<std::size_t>(number(rest_.size()));
  if (size > rest_.size()) refuse();
  std::string value(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(size));
  rest_ = rest_.subspan(size);
  return value;
}

}  // namespace episcope
