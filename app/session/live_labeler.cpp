// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/live_labeler.h"

#include "annotation/exchange.h"
#include "app/session/run_estimator.h"
#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/labeling/labeler.h"

#include <algorithm>
#include <utility>

namespace episcope {
namespace {

// What must be painted before there is anything to learn; empty if nothing is missing.
std::string missing_scribbles(const LabelingInput& input) {
  try {
    static_cast<void>(painted_labels(scribbles_of(*input.scribbles), *input.light_field));
    return {};
  } catch (const InvalidInput& error) {
    return error.what();
  }
}

}  // namespace

LiveLabeler::LiveLabeler(JobRunner::Post post, std::function<void()> on_changed)
    : post_(std::move(post)),
      on_changed_(std::move(on_changed)),
      alive_(std::make_shared<LiveLabeler*>(this)),
      runner_(post_) {}

LiveLabeler::~LiveLabeler() {
  *alive_ = nullptr;
}

bool LiveLabeler::is_running() const {
  return state_ == LiveState::Training || state_ == LiveState::Labeling ||
         state_ == LiveState::Refining;
}

void LiveLabeler::set_input(LabelingInput input) {
  if (input_ && is_same(*input_, input)) return;
  cancel();
  if (!input_ || !is_same_scene(*input_, input)) {
    labeler_ = std::make_shared<Labeler>(new_labeler(input));
  }
  if (input_ && input_->light_field != input.light_field) {
    views_.clear();
    all_ = {};
  }
  input_ = std::make_shared<const LabelingInput>(std::move(input));
  state_ = has_labels() ? LiveState::OutOfDate : LiveState::Idle;
  sentence_.clear();
}

void LiveLabeler::clear() {
  cancel();
  input_ = nullptr;
  labeler_ = nullptr;
  views_.clear();
  all_ = {};
  state_ = LiveState::Idle;
  sentence_.clear();
}

void LiveLabeler::cancel() {
  ++request_;
  runner_.cancel_all();
  if (is_running()) state_ = LiveState::OutOfDate;
}

const LiveLabeler::Known* LiveLabeler::find(ViewIndex view) const {
  const auto found = std::find_if(views_.begin(), views_.end(), [view](const Known& each) {
    return each.labeling->labels.contains(view);
  });
  const Known* own = found == views_.end() ? nullptr : &*found;
  const Known* all = all_.labeling && all_.labeling->labels.contains(view) ? &all_ : nullptr;
  // What is of the present input goes before what is newer, but of a former one.
  return !own || (all && all->input == input_ && own->input != input_) ? all : own;
}

LabelingPtr LiveLabeler::labeling(ViewIndex view) const {
  const Known* known = find(view);
  return known ? known->labeling : nullptr;
}

bool LiveLabeler::is_up_to_date(ViewIndex view) const {
  const Known* known = find(view);
  return known && known->input == input_;
}

void LiveLabeler::label(ViewIndex view) {
  if (!input_) return;
  if (is_running() && view == view_) return;
  cancel();
  if (is_up_to_date(view) && !labeling(view)->is_draft) {
    state_ = LiveState::Idle;
    return;
  }
  start(view);
}

void LiveLabeler::start(ViewIndex view) {
  view_ = view;
  state_ = LiveState::Training;
  sentence_.clear();
  const auto is_current = [alive = alive_, request = request_] {
    return *alive && (*alive)->request_ == request;
  };
  const auto tell = [this, is_current, input = input_](const LabelingPtr& labeling) {
    post_([this, is_current, input, labeling] {
      if (!is_current()) return;
      keep({labeling, input});
      if (labeling->is_draft) change(LiveState::Refining);
    });
  };
  runner_.start<std::string>(
      [labeler = labeler_, input = input_, view, tell](const Progress& progress) {
        lower_thread_priority();
        std::string missing = missing_scribbles(*input);
        if (missing.empty()) tell(label_live(*labeler, *input, view, tell, progress));
        return missing;
      },
      [this, is_current](const Outcome<std::string>& outcome) {
        if (is_current()) finish(outcome);
      },
      [this, is_current](const ProgressState& progress) {
        if (!is_current() || progress.step != Labeler::kLabelingStep) return;
        if (state_ == LiveState::Training) change(LiveState::Labeling);
      });
}

void LiveLabeler::finish(const Outcome<std::string>& outcome) {
  if (outcome.failure) {
    change(LiveState::Failed, failure_text(outcome.failure));
  } else if (outcome.value) {
    change(outcome.value->empty() ? LiveState::Idle : LiveState::Hint, *outcome.value);
  }
}

void LiveLabeler::keep(Known known) {
  if (known.labeling->labels.grid().count() > 1) {
    views_.clear();
    all_ = std::move(known);
    return;
  }
  const ViewIndex view = known.labeling->labels.first();
  std::erase_if(views_,
                [view](const Known& each) { return each.labeling->labels.first() == view; });
  views_.push_front(std::move(known));
  if (views_.size() > kKeptViews) views_.pop_back();
}

void LiveLabeler::take(LabelingPtr labeling, const std::shared_ptr<const LabelingInput>& input) {
  if (!input_ || !input || input_->light_field != input->light_field) return;
  keep({std::move(labeling), input});
  if (input == input_) {
    cancel();
    state_ = LiveState::Idle;
  } else if (!is_running()) {
    state_ = LiveState::OutOfDate;
  }
}

void LiveLabeler::change(LiveState state, std::string sentence) {
  state_ = state;
  sentence_ = std::move(sentence);
  on_changed_();
}

}  // namespace episcope
