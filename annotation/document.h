// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/edit.h"
#include "annotation/scribble_layer.h"

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace episcope {

/// An undoable step on a document of any kind.
template <class E>
concept EditOfDocument = requires(const E& edit, std::size_t bytes) {
  bytes = edit.byte_size();  // memory that it takes
};

/// Edits of a document that can be undone and redone, oldest first, bounded in bytes: the oldest
/// are forgotten, so that an edit larger than the bound cannot be undone.
template <EditOfDocument E>
class History {
 public:
  explicit History(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  /// A number for the state of the document: every edit leads to a new one, undoing and redoing
  /// lead back to the same.
  [[nodiscard]] std::uint64_t state() const { return state_after(applied_); }
  /// Notes an edit just made; edits that were undone can no longer be redone.
  void push(E edit);

  /// Edits that are kept, of which the first `applied_count` are in effect.
  [[nodiscard]] std::size_t count() const { return steps_.size(); }
  [[nodiscard]] std::size_t applied_count() const { return applied_; }
  [[nodiscard]] const E& edit(std::size_t index) const { return steps_[index].edit; }
  /// The state after the first `index` edits.
  [[nodiscard]] std::uint64_t state_after(std::size_t index) const {
    return index == 0 ? first_state_ : steps_[index - 1].state;
  }

  /// The edit that `undo` would take back; null if there is none. Likewise `redo`.
  [[nodiscard]] const E* next_undo() const {
    return applied_ > 0 ? &steps_[applied_ - 1].edit : nullptr;
  }
  [[nodiscard]] const E* next_redo() const {
    return applied_ < steps_.size() ? &steps_[applied_].edit : nullptr;
  }
  /// Counts the last edit as not in effect. Precondition: `next_undo()`.
  void undo() { --applied_; }
  /// Counts the next edit as in effect again. Precondition: `next_redo()`.
  void redo() { ++applied_; }

  [[nodiscard]] std::size_t byte_size() const { return bytes_; }
  [[nodiscard]] std::size_t max_bytes() const { return max_bytes_; }

 private:
  struct Step {
    E edit;
    std::size_t bytes = 0;
    std::uint64_t state = 0;
  };
  void forget_redo();

  std::size_t max_bytes_;
  std::deque<Step> steps_;
  std::size_t applied_ = 0;
  std::size_t bytes_ = 0;
  std::uint64_t first_state_ = 0;
  std::uint64_t last_state_ = 0;  ///< The highest ever given.
};

template <EditOfDocument E>
void History<E>::forget_redo() {
  while (steps_.size() > applied_) {
    bytes_ -= steps_.back().bytes;
    steps_.pop_back();
  }
}

template <EditOfDocument E>
void History<E>::push(E edit) {
  forget_redo();
  const std::size_t bytes = edit.byte_size();
  steps_.push_back({std::move(edit), bytes, ++last_state_});
  bytes_ += bytes;
  ++applied_;
  while (bytes_ > max_bytes_) {
    first_state_ = steps_.front().state;
    bytes_ -= steps_.front().bytes;
    steps_.pop_front();
    --applied_;
  }
}

/// Changes of one step of the history, for redrawing.
struct DocumentChange {
  struct Part {
    ViewIndex view;
    PixelRect rect;
  };
  std::vector<Part> views;  ///< In the order of the grid.
  bool has_new_labels = false;
  bool has_new_smoothing = false;
  [[nodiscard]] bool empty() const {
    return views.empty() && !has_new_labels && !has_new_smoothing;
  }
};

/// Kind of a change of the document. `edit` is the one made, undone or redone.
enum class DocumentStep : std::uint8_t { Edited, Undone, Redone, Saved };
struct DocumentEvent {
  DocumentStep step = DocumentStep::Edited;
  const Edit* edit = nullptr;  ///< Null for Saved.
};

/// Labels, scribbles on every view, and their history. Pixels
/// change only through PendingEdit and Stroke, one edit at a time; while one is in progress, every
/// other change throws InvalidInput.
class AnnotationDocument {
 public:
  static constexpr std::size_t kHistoryBytes = std::size_t{64} << 20;

  static constexpr double kMaxSmoothing_px = 10;

  /// Throws InvalidInput as ScribbleLayer does.
  AnnotationDocument(GridShape grid, int height, int width,
                     std::size_t history_bytes = kHistoryBytes);
  /// A document with initial content, as read from a file; that cannot be undone.
  AnnotationDocument(LabelSet labels, ScribbleLayer scribbles,
                     std::size_t history_bytes = kHistoryBytes, double smoothing_px = 0);

  /// Smoothing of the boundaries of learned segments (smooth_boundaries), in px.
  [[nodiscard]] double boundary_smoothing_px() const { return boundary_smoothing_px_; }
  /// One edit, as those below; rounded to 0.01 px and clamped to [0, kMaxSmoothing_px].
  void set_boundary_smoothing(double smoothing_px);

  [[nodiscard]] const LabelSet& labels() const { return labels_; }
  [[nodiscard]] const ScribbleLayer& scribbles() const { return scribbles_; }
  [[nodiscard]] const History<Edit>& history() const { return history_; }

  /// Each is one edit; a change to the same value is dropped. Throw InvalidInput as LabelSet does.
  int add_label(const std::string& name = {}, std::optional<Rgb> color = std::nullopt);
  /// Adds a label that an edit needs (EditKind::AddPaintedLabel).
  void add_painted_label(const std::string& name = {});
  void rename_label(int id, const std::string& name);
  void recolor_label(int id, Rgb color);
  /// Also erases everything painted with it, on all views.
  void remove_label(int id);
  /// Gives everything painted with a label to another one, and removes it.
  void merge_label(int id, int into);
  /// Gives a label another id, everywhere.
  void renumber_label(int id, int to);
  /// Moves a label to a place of the list, from 0.
  void move_label(int id, int place);

  /// Undoes the last edit, or redoes it; an empty change if there is none.
  DocumentChange undo();
  DocumentChange redo();
  /// Applies an edit that was recorded on a document in the same state. Throws InvalidInput,
  /// changing nothing, if it does not fit.
  DocumentChange apply(const Edit& edit);

  /// The state of the document, see History.
  [[nodiscard]] std::uint64_t state() const { return history_.state(); }
  [[nodiscard]] std::uint64_t saved_state() const { return saved_state_; }
  /// Whether the content differs from what was saved, or from the initial content.
  [[nodiscard]] bool has_unsaved_changes() const;
  void mark_saved();
  /// Marks every state of this document as unsaved.
  void forget_saved();

  /// Called after each step, before the call that made it returns; an exception of the observer
  /// reaches that caller, while the step remains. One observer; an empty function for none.
  using Observer = std::function<void(const DocumentEvent&)>;
  void set_observer(Observer observer) { observer_ = std::move(observer); }

 private:
  friend class PendingEdit;
  static constexpr std::uint64_t kNoState = UINT64_MAX;
  struct Content {
    std::vector<LabelInfo> labels;
    ScribbleLayer scribbles;
    double boundary_smoothing_px = 0;
    friend bool operator==(const Content&, const Content&) = default;
  };

  [[nodiscard]] Content content() const {
    return {labels_.labels(), scribbles_, boundary_smoothing_px_};
  }
  void require_idle() const;
  void require_fitting(const Edit& edit) const;
  DocumentChange put(const Edit& edit, EditSide side);
  void keep(Edit edit);
  /// Gives the pixels of a label another one, or none (0), and replaces the labels.
  void take_over(EditKind kind, int id, std::uint8_t by, LabelSet labels);
  void tell(DocumentStep step, const Edit* edit) const {
    if (observer_) observer_({step, edit});
  }
  template <class Change>
  void edit_labels(EditKind kind, const Change& change);

  LabelSet labels_;
  ScribbleLayer scribbles_;
  double boundary_smoothing_px_ = 0;
  History<Edit> history_;
  std::uint64_t saved_state_ = 0;
  std::optional<Content> saved_;
  bool is_editing_ = false;
  Observer observer_;
};

/// A set of ids of labels; 0 stands for unpainted pixels.
using LabelIds = std::bitset<LabelSet::kMaxId + 1>;

[[nodiscard]] inline LabelIds all_labels_but(std::uint8_t id) {
  return LabelIds().set().reset(id);
}

/// The label to paint, and which pixels it may change.
struct Ink {
  std::uint8_t label = 0;  ///< 0 erases.
  LabelIds kept{};         ///< Pixels that have one of these stay as they are.
};

/// An edit in progress. Painted pixels appear in the document at once, and are reverted if the edit
/// is destroyed before `commit`. At most one per document, which must outlive it.
class PendingEdit {
 public:
  /// Throws InvalidInput if another edit is in progress.
  PendingEdit(AnnotationDocument& document, EditKind kind);
  ~PendingEdit();
  PendingEdit(const PendingEdit&) = delete;
  PendingEdit& operator=(const PendingEdit&) = delete;

  /// Paints a region that lies within the view, with a label of the set. Returns the rectangle that
  /// may have changed. Throws InvalidInput for a view outside the grid or an unknown label.
  PixelRect paint(ViewIndex view, const PixelRegion& region, const Ink& ink);
  void set_labels(LabelSet labels);

  /// Ends the edit and adds it to the history as one step, unless it changed nothing. Returns
  /// whether there was a change.
  bool commit();

 private:
  struct Touched {
    Image<std::uint8_t> before;
    PixelRect rect;
  };
  [[nodiscard]] Touched& touch(ViewIndex view);
  void revert();

  AnnotationDocument* document_;  ///< Null once ended.
  EditKind kind_;
  std::map<std::pair<int, int>, Touched> touched_;  ///< By (v, u).
  std::optional<LabelSet> labels_before_;
};

/// Appends numbers and text to bytes, in a form that is the same on every machine: whole numbers in
/// groups of 7 bits, the lowest first, all but the last with the high bit set.
class ByteWriter {
 public:
  void byte(std::uint8_t value) { bytes_.push_back(value); }
  void number(std::uint64_t value);
  void text(const std::string& value);

  [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// Reads what ByteWriter wrote. All members throw InvalidInput if the bytes end too early.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  [[nodiscard]] std::uint8_t byte();
  /// Also throws InvalidInput above `max`.
  [[nodiscard]] std::uint64_t number(std::uint64_t max = UINT64_MAX);
  [[nodiscard]] std::string text();
  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  /// Bytes not read yet: no list can have more entries.
  [[nodiscard]] std::size_t rest() const { return rest_.size(); }

 private:
  std::span<const std::uint8_t> rest_;
};

/// Encodes an edit for the journal, about six bytes per run. The rectangles are omitted, since they
/// follow from the runs.
void write_edit(const Edit& edit, ByteWriter& out);

/// Throws InvalidInput for bytes that `write_edit` cannot have written.
[[nodiscard]] Edit read_edit(ByteReader& in);

}  // namespace episcope
