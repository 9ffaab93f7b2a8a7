// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/segmentation.h"
#include "engine/core/indices.h"
#include "engine/core/jobs.h"
#include "engine/core/progress.h"
#include "engine/labeling/labeler.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <string>
#include <vector>

namespace episcope {

/// Labels of all views and what they were made from.
struct KnownLabeling {
  LabelingPtr labeling;
  std::shared_ptr<const LabelingInput> input;
};

/// Corrects labels of all views after strokes (Labeler::correct): `input` differs from theirs in
/// strokes alone. `on_draft` gets the labels of `first` as soon as they are solved, `on_view` hears
/// of each view that is, from any thread. Null if that cannot be. Throws as `label_live`.
struct CorrectionNews {
  std::function<void(LabelingPtr)> on_draft;
  std::function<void(ViewIndex)> on_view;
};

/// State of a live segmentation.
enum class LiveState : std::uint8_t {
  Idle,       ///< Everything that was asked for is there.
  Training,   ///< The forest learns.
  Labeling,   ///< A first result is on its way,
  Refining,   ///< and a better one.
  OutOfDate,  ///< What is there is of a former input.
  Hint,       ///< Something is missing, e.g. a second label: `sentence` says what to do.
  Failed      ///< `sentence` says why.
};

/// Segments the current view in the background. Only the newest request matters: it cancels the one
/// before within 200 ms. Works on a thread of its own, of lower priority than the owner's. All
/// members are for the owner's thread.
class LiveLabeler {
 public:
  /// Number of views whose labels are kept, so that returning to one need not wait.
  static constexpr std::size_t kKeptViews = 12;
  /// Bytes of former labels of all views, which come back when strokes are undone.
  static constexpr std::size_t kFormerBytes = std::size_t{768} << 20;

  /// `post` brings closures to the owner's thread; `on_changed` is called there after each change
  /// of state or labels that no call of the owner made.
  LiveLabeler(JobRunner::Post post, std::function<void()> on_changed);
  ~LiveLabeler();
  LiveLabeler(const LiveLabeler&) = delete;
  LiveLabeler& operator=(const LiveLabeler&) = delete;

  /// Marks all labels as out of date and cancels the running job, unless the input is the same.
  void set_input(LabelingInput input);
  [[nodiscard]] bool has_input() const { return input_ != nullptr; }
  /// No input, and nothing known: the light field is another one.
  void clear();
  /// Starts to segment a view and cancels the running job, unless the view has refined labels.
  /// Ignored without an input.
  void label(ViewIndex view);
  /// Whether strokes can correct the labels of all views: there are some that lack strokes alone.
  [[nodiscard]] bool can_correct() const;
  /// Starts to correct the labels of all views, `view` first, and cancels the running job, unless
  /// that is a correction for the same input. Precondition: `can_correct()`.
  void correct(ViewIndex view);
  /// Computes ahead what a correction after the next stroke in this view needs, if labels of all
  /// views are up to date and nothing is running.
  void prepare(ViewIndex view);
  /// Views that the running correction has done.
  [[nodiscard]] const std::vector<ViewIndex>& corrected_views() const { return corrected_; }
  /// Replaces all labels by labels of all views, made from `input`. Ignored for an input of another
  /// light field.
  void take(LabelingPtr labeling, const std::shared_ptr<const LabelingInput>& input);
  /// Gives what has label `from` label `to` in all labels, and in the strokes that they were learnt
  /// from: what was up to date before the present input was numbered so stays up to date. Ends
  /// what is running. Undoing it in the strokes brings back the labels of all views.
  void relabel(std::int32_t from, std::int32_t to);
  void cancel();

  [[nodiscard]] const std::shared_ptr<const LabelingInput>& input() const { return input_; }
  [[nodiscard]] LiveState state() const { return state_; }
  [[nodiscard]] bool is_running() const;
  /// Of Hint and Failed.
  [[nodiscard]] const std::string& sentence() const { return sentence_; }
  /// Whether there are labels of any view, maybe out of date.
  [[nodiscard]] bool has_labels() const { return !views_.empty() || all_.labeling; }
  /// The newest labels that cover a view, maybe out of date; null if there are none.
  [[nodiscard]] LabelingPtr labeling(ViewIndex view) const;
  /// Whether those are of the present input.
  [[nodiscard]] bool is_up_to_date(ViewIndex view) const;
  /// Whether those were made with all views, and lack only strokes in other views. The view by
  /// itself would get worse ones.
  [[nodiscard]] bool is_before_strokes(ViewIndex view) const;
  /// The newest labels of all views, if they were segmented, each view with its newest ones; else
  /// `labeling(view)`. Copies labels if some views have newer ones than the others.
  [[nodiscard]] LabelingPtr widest(ViewIndex view) const;
  /// Whether `widest` covers more than one view.
  [[nodiscard]] bool covers_all(ViewIndex view) const;
  /// Whether `widest` is of the present input in all its views.
  [[nodiscard]] bool is_widest_up_to_date(ViewIndex view) const;

 private:
  using Known = KnownLabeling;
  [[nodiscard]] const Known* find(ViewIndex view) const;
  /// `all` is corrected, unless it is empty.
  void start(ViewIndex view, const Known& all);
  void keep(Known known);
  void keep_all(Known known);
  [[nodiscard]] bool bring_back_all(const LabelingInput& input);
  void finish(const Outcome<std::string>& outcome);
  void change(LiveState state, std::string sentence = {});

  JobRunner::Post post_;
  std::function<void()> on_changed_;
  std::shared_ptr<const LabelingInput> input_;
  std::shared_ptr<Labeler> labeler_;  // used by one job at a time
  std::list<Known> views_;            // of one view each, the newest comes first
  Known all_;                         // older than those
  std::list<Known> former_;           // of all views, the newest comes first
  std::vector<ViewIndex> corrected_;
  bool is_correcting_ = false;
  LiveState state_ = LiveState::Idle;
  std::string sentence_;
  ViewIndex view_;
  std::uint64_t request_ = 0;
  std::shared_ptr<LiveLabeler*> alive_;  // posted closures outlive this harmlessly
  JobRunner runner_;
};

}  // namespace episcope
