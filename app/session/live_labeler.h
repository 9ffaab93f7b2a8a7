// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/segmentation.h"
#include "engine/core/jobs.h"

#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <string>

namespace episcope {

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
  /// Replaces all labels by labels of all views, made from `input`. Ignored for an input of another
  /// light field.
  void take(LabelingPtr labeling, const std::shared_ptr<const LabelingInput>& input);
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

 private:
  struct Known {
    LabelingPtr labeling;
    std::shared_ptr<const LabelingInput> input;
  };
  [[nodiscard]] const Known* find(ViewIndex view) const;
  void start(ViewIndex view);
  void keep(Known known);
  void finish(const Outcome<std::string>& outcome);
  void change(LiveState state, std::string sentence = {});

  JobRunner::Post post_;
  std::function<void()> on_changed_;
  std::shared_ptr<const LabelingInput> input_;
  std::shared_ptr<Labeler> labeler_;  // used by one job at a time
  std::list<Known> views_;            // of one view each, the newest comes first
  Known all_;                         // older than those
  LiveState state_ = LiveState::Idle;
  std::string sentence_;
  ViewIndex view_;
  std::uint64_t request_ = 0;
  std::shared_ptr<LiveLabeler*> alive_;  // posted closures outlive this harmlessly
  JobRunner runner_;
};

}  // namespace episcope
