// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/live_labeler.h"

#include "annotation/exchange.h"
#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/labeling/correct_views.h"

#include <algorithm>
#include <utility>

namespace episcope {
namespace {

ProbabilityMap copy(VolumeView<const std::uint8_t> from) {
  ProbabilityMap to(from.height, from.layers, from.width);
  std::copy_n(from.data, from.size(), to.view().data);
  return to;
}

std::shared_ptr<Labeling> copy(const Labeling& from) {
  auto to = std::make_shared<Labeling>();
  to->probabilities.ids = from.probabilities.ids;
  to->probabilities.grid = from.probabilities.grid;
  to->probabilities.first = from.probabilities.first;
  for (const ProbabilityMap& map : from.probabilities.views) {
    to->probabilities.views.push_back(copy(map.view()));
  }
  to->labels = from.labels.clone();
  to->is_draft = from.is_draft;
  to->gap = from.gap;
  to->seconds = from.seconds;
  to->note = from.note;
  return to;
}

// The one who is told of a draft is not its owner.
LabelingPtr draft_of(const Labeling& from) {
  auto draft = copy(from);
  draft->is_draft = true;
  return draft;
}

// Replaces the labels of the view that `from` covers, and the probabilities if they are of the same
// labels; else there are none.
void put_view(const Labeling& from, Labeling& into) {
  const ViewIndex view = from.labels.first();
  std::copy_n(from.labels.view(view).data, from.labels.view_size(), into.labels.view(view).data);
  LabelProbabilities& probabilities = into.probabilities;
  if (!probabilities.contains(view)) return;
  if (from.probabilities.contains(view) && from.probabilities.ids == probabilities.ids) {
    probabilities.view(view) = copy(from.probabilities.view(view).view());
  } else {
    probabilities.views.clear();
  }
}

// Probabilities of labels that become one are added.
void relabel(LabelProbabilities& probabilities, std::int32_t from, std::int32_t to) {
  std::vector<std::int32_t> renamed = probabilities.ids;
  std::ranges::replace(renamed, from, to);
  std::vector<std::int32_t> ids = renamed;
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  for (ProbabilityMap& map : probabilities.views) {
    const VolumeView<const std::uint8_t> old = std::as_const(map).view();
    ProbabilityMap sum(old.height, static_cast<int>(ids.size()), old.width);
    std::fill_n(sum.view().data, sum.view().size(), std::uint8_t{0});
    for (int l = 0; l < old.layers; ++l) {
      const auto layer = std::ranges::find(ids, renamed[static_cast<std::size_t>(l)]) - ids.begin();
      for (int y = 0; y < old.height; ++y) {
        std::uint8_t* const row = sum.view().row(y, static_cast<int>(layer));
        std::transform(row, row + old.width, old.row(y, l), row, [](int a, int b) {
          return static_cast<std::uint8_t>(std::min(a + b, 255));
        });
      }
    }
    map = std::move(sum);
  }
  probabilities.ids = std::move(ids);
}

std::shared_ptr<const ScribbleLayer> relabeled(const ScribbleLayer& strokes, std::int32_t from,
                                               std::int32_t to) {
  auto changed = std::make_shared<ScribbleLayer>(strokes);
  for (const ViewIndex view : strokes.painted_views()) {
    const ImageView<std::uint8_t> own = changed->writable_view(view);
    std::replace(own.data, own.data + own.size(), static_cast<std::uint8_t>(from),
                 static_cast<std::uint8_t>(to));
  }
  return changed;
}

KnownLabeling relabeled(const KnownLabeling& known, std::int32_t from, std::int32_t to) {
  auto labeling = copy(*known.labeling);
  std::replace(labeling->labels.data(), labeling->labels.data() + labeling->labels.size(), from,
               to);
  relabel(labeling->probabilities, from, to);
  auto input = std::make_shared<LabelingInput>(*known.input);
  if (input->scribbles) input->scribbles = relabeled(*input->scribbles, from, to);
  return {std::move(labeling), std::move(input)};
}

// A view that was never painted is as good as one of which all was erased.
bool has_same_strokes(const ScribbleLayer* a, const ScribbleLayer& b, ViewIndex view) {
  const ImageView<const std::uint8_t> before = a ? a->view(view) : ImageView<const std::uint8_t>{};
  const ImageView<const std::uint8_t> now = b.view(view);
  const auto is_blank = [](ImageView<const std::uint8_t> image) {
    return std::all_of(image.data, image.data + image.size(), [](auto id) { return id == 0; });
  };
  if (before.empty() || now.empty()) return is_blank(before) && is_blank(now);
  return std::equal(now.data, now.data + now.size(), before.data);
}

LabelingPtr correct_all_views(Labeler& labeler, const LabelingInput& input,
                              const KnownLabeling& before, ViewIndex first,
                              const CorrectionNews& news, const Progress& progress) {
  const Scribbles former = scribbles_of(*before.input->scribbles);
  const auto on_view = [&](ViewIndex view, const Image<std::int32_t>& labels) {
    news.on_view(view);
    if (!(view == first)) return;
    auto draft = std::make_shared<Labeling>();
    draft->is_draft = true;
    draft->probabilities.ids = before.labeling->probabilities.ids;
    draft->labels = stack_of(labels, view);
    news.on_draft(std::move(draft));
  };
  auto corrected = labeler.correct(scribbles_of(*input.scribbles), possible_parameters(input),
                                   {*before.labeling, former, first, on_view}, progress);
  return corrected ? std::make_shared<const Labeling>(std::move(*corrected)) : nullptr;
}

// Segments one view while somebody paints: `on_draft` gets the most probable label of each pixel
// if smoothing is still to come. `labeler` keeps features between calls; it must have been made
// for the input's light field, disparity and edges. The labeling covers the view alone. Throws
// InvalidInput unless two labels are painted, Cancelled.
LabelingPtr label_live(Labeler& labeler, const LabelingInput& input, ViewIndex view,
                       const std::function<void(LabelingPtr)>& on_draft, const Progress& progress) {
  return std::make_shared<const Labeling>(
      labeler.label(scribbles_of(*input.scribbles), possible_parameters(input), {view, {1, 1}},
                    progress, [&](const Labeling& draft) { on_draft(draft_of(draft)); }));
}

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
    former_.clear();
  }
  const bool is_of_all = bring_back_all(input);
  input_ = is_of_all ? all_.input : std::make_shared<const LabelingInput>(std::move(input));
  state_ = has_labels() && !is_of_all ? LiveState::OutOfDate : LiveState::Idle;
  sentence_.clear();
}

void LiveLabeler::clear() {
  cancel();
  input_ = nullptr;
  labeler_ = nullptr;
  views_.clear();
  all_ = {};
  former_.clear();
  state_ = LiveState::Idle;
  sentence_.clear();
}

// Strokes that are undone bring back the labels of all views; likewise if they are redone.
bool LiveLabeler::bring_back_all(const LabelingInput& input) {
  if (all_.input && is_same(*all_.input, input)) return true;
  const auto found =
      std::ranges::find_if(former_, [&](const Known& each) { return is_same(*each.input, input); });
  if (found == former_.end()) return false;
  std::swap(*found, all_);
  former_.splice(former_.begin(), former_, found);
  return true;
}

void LiveLabeler::cancel() {
  ++request_;
  runner_.cancel_all();
  corrected_.clear();
  is_correcting_ = false;
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

bool LiveLabeler::is_before_strokes(ViewIndex view) const {
  const Known* known = find(view);
  return known && known == &all_ && known->input != input_ && input_ &&
         is_same_but_strokes(*known->input, *input_) &&
         has_same_strokes(known->input->scribbles.get(), *input_->scribbles, view);
}

bool LiveLabeler::covers_all(ViewIndex view) const {
  const LabelingPtr widest = all_.labeling ? all_.labeling : labeling(view);
  return widest && widest->labels.grid().count() > 1;
}

LabelingPtr LiveLabeler::widest(ViewIndex view) const {
  if (!all_.labeling) return labeling(view);
  std::shared_ptr<Labeling> merged;
  for (const Known& each : views_) {
    const ViewIndex own = each.labeling->labels.first();
    if (find(own) != &each || !all_.labeling->labels.contains(own)) continue;
    if (!merged) merged = copy(*all_.labeling);
    put_view(*each.labeling, *merged);
  }
  return merged ? merged : all_.labeling;
}

bool LiveLabeler::is_widest_up_to_date(ViewIndex view) const {
  return all_.labeling ? all_.input == input_ : is_up_to_date(view);
}

void LiveLabeler::label(ViewIndex view) {
  if (!input_) return;
  if (is_running() && view == view_) return;
  cancel();
  if (is_up_to_date(view) && !labeling(view)->is_draft) {
    state_ = LiveState::Idle;
    return;
  }
  start(view, {});
}

bool LiveLabeler::can_correct() const {
  return all_.labeling && input_ && input_ != all_.input && input_->disparity &&
         all_.input->scribbles && !all_.labeling->probabilities.views.empty() &&
         is_same_but_strokes(*all_.input, *input_);
}

void LiveLabeler::correct(ViewIndex view) {
  if (is_running() && is_correcting_) return;
  cancel();
  start(view, all_);
  is_correcting_ = true;
}

void LiveLabeler::prepare(ViewIndex view) {
  if (!input_ || is_running() || !all_.labeling || all_.input != input_ || !input_->disparity ||
      all_.labeling->probabilities.views.empty()) {
    return;
  }
  cancel();
  runner_.start<bool>(
      [labeler = labeler_, input = input_, view](const Progress& progress) {
        lower_thread_priority();
        labeler->prepare_correction(scribbles_of(*input->scribbles), possible_parameters(*input),
                                    view, progress);
        return true;
      },
      [](const Outcome<bool>&) {});
}

void LiveLabeler::start(ViewIndex view, const Known& all) {
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
  const auto tell_view = [this, is_current](ViewIndex done) {
    post_([this, is_current, done] {
      if (!is_current()) return;
      corrected_.push_back(done);
      on_changed_();
    });
  };
  runner_.start<std::string>(
      [labeler = labeler_, input = input_, view, all, tell, tell_view](const Progress& progress) {
        lower_thread_priority();
        std::string missing = missing_scribbles(*input);
        if (!missing.empty()) return missing;
        LabelingPtr made;
        if (all.labeling) {
          made = correct_all_views(*labeler, *input, all, view, {tell, tell_view}, progress);
        }
        tell(made ? made : label_live(*labeler, *input, view, tell, progress));
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
  corrected_.clear();
  is_correcting_ = false;
  if (outcome.failure) {
    change(LiveState::Failed, failure_text(outcome.failure));
  } else if (outcome.value) {
    change(outcome.value->empty() ? LiveState::Idle : LiveState::Hint, *outcome.value);
  }
}

void LiveLabeler::keep(Known known) {
  if (known.labeling->labels.grid().count() > 1) {
    keep_all(std::move(known));
    return;
  }
  const ViewIndex view = known.labeling->labels.first();
  std::erase_if(views_,
                [view](const Known& each) { return each.labeling->labels.first() == view; });
  views_.push_front(std::move(known));
  if (views_.size() > kKeptViews) views_.pop_back();
}

namespace {

std::size_t bytes_of(const Labeling& labeling) {
  std::size_t bytes = labeling.labels.size() * sizeof(std::int32_t);
  for (const ProbabilityMap& map : labeling.probabilities.views) bytes += map.view().size();
  return bytes;
}

}  // namespace

void LiveLabeler::keep_all(Known known) {
  views_.clear();
  if (all_.labeling && is_same_but_strokes(*all_.input, *known.input)) {
    former_.push_front(std::move(all_));
  } else {
    former_.clear();
  }
  all_ = std::move(known);
  std::size_t bytes = 0;
  std::erase_if(former_, [&](const Known& each) {
    bytes += bytes_of(*each.labeling);
    return !each.input->scribbles || bytes > kFormerBytes || is_same(*each.input, *all_.input);
  });
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

void LiveLabeler::relabel(std::int32_t from, std::int32_t to) {
  if (!input_) return;
  cancel();
  const auto renewed = [&](const Known& known) -> Known {
    const ViewStack<std::int32_t>& labels = known.labeling->labels;
    if (std::find(labels.data(), labels.data() + labels.size(), from) ==
        labels.data() + labels.size()) {
      return known;
    }
    Known changed = relabeled(known, from, to);
    if (is_same(*changed.input, *input_)) changed.input = input_;
    return changed;
  };
  std::list<Known> views;
  for (const Known& each : views_) views.push_back(renewed(each));
  if (all_.labeling) {
    Known all = renewed(all_);
    if (all.labeling != all_.labeling) keep_all(std::move(all));
  }
  views_ = std::move(views);
  const auto is_current = [this](const Known& each) { return each.input == input_; };
  if (is_current(all_) || std::ranges::any_of(views_, is_current)) state_ = LiveState::Idle;
}

void LiveLabeler::change(LiveState state, std::string sentence) {
  state_ = state;
  sentence_ = std::move(sentence);
  on_changed_();
}

}  // namespace episcope
