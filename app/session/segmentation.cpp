// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/segmentation.h"

#include "annotation/exchange.h"
#include "app/session/result_files.h"
#include "app/session/run_estimator.h"
#include "app/session/user_folders.h"
#include "engine/core/error.h"
#include "engine/core/hash.h"
#include "engine/core/parallel.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"
#include "engine/io/base/image_file.h"
#include "engine/io/formats/archive_reader.h"
#include "engine/io/models/scribble_file.h"
#include "engine/labeling/label_review.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace episcope {

TrueLabelsPtr true_labels_of(const GroundTruthPtr& truth) {
  return truth->labels.empty() ? nullptr : TrueLabelsPtr(truth, &truth->labels);
}

Image<std::int32_t> finished_labels(const Labeling& labeling, const LabelFinish& finish,
                                    ViewIndex view) {
  const ImageView<const std::uint8_t> painted =
      finish.painted ? finish.painted->view(view) : ImageView<const std::uint8_t>{};
  return smooth_boundaries(labeling.labels.view(view), painted, finish.smoothing_px);
}

ViewStack<std::int32_t> finished_labels(const Labeling& labeling, const LabelFinish& finish,
                                        const Progress& progress) {
  ViewStack<std::int32_t> finished = labeling.labels.clone();
  if (finish.smoothing_px == 0) return finished;
  const int count = finished.grid().count();
  for (int i = 0; i < count; ++i) {
    progress.report(static_cast<double>(i) / count);
    const ViewIndex view = finished.grid().view_at(i, finished.first());
    const Image<std::int32_t> labels = finished_labels(labeling, finish, view);
    std::copy(labels.begin(), labels.end(), finished.view(view).data);
  }
  return finished;
}

std::vector<LabelInfo> infos_of(const std::vector<std::int32_t>& ids,
                                const std::vector<LabelInfo>& known) {
  std::vector<LabelInfo> infos;
  for (const std::int32_t id : ids) {
    const auto found = std::ranges::find(known, id, &LabelInfo::id);
    infos.push_back(found != known.end()
                        ? *found
                        : LabelInfo{id, "label " + std::to_string(id), label_color(id)});
  }
  return infos;
}

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

}  // namespace

Labeler new_labeler(const LabelingInput& input) {
  return {input.light_field, input.disparity, input.edges, input.confidence};
}

bool is_same_scene(const LabelingInput& a, const LabelingInput& b) {
  return a.light_field == b.light_field && a.disparity == b.disparity && a.edges == b.edges &&
         a.confidence == b.confidence;
}

bool is_same(const LabelingInput& a, const LabelingInput& b) {
  return is_same_but_strokes(a, b) && a.scribbles && b.scribbles && *a.scribbles == *b.scribbles;
}

bool is_same_but_strokes(const LabelingInput& a, const LabelingInput& b) {
  const Schema<LabelerParameters> schema = labeler_schema();
  return is_same_scene(a, b) && schema.values(a.parameters) == schema.values(b.parameters);
}

LabelerParameters possible_parameters(const LabelingInput& input) {
  LabelerParameters parameters = input.parameters;
  if (input.disparity) return parameters;
  parameters.features = FeatureSet::Image;
  if (info_of(parameters.regularizer).joins_views) parameters.regularizer = Regularizer::View;
  return parameters;
}

LabelingPtr label_live(Labeler& labeler, const LabelingInput& input, ViewIndex view,
                       const std::function<void(LabelingPtr)>& on_draft, const Progress& progress) {
  return std::make_shared<const Labeling>(
      labeler.label(scribbles_of(*input.scribbles), possible_parameters(input), {view, {1, 1}},
                    progress, [&](const Labeling& draft) { on_draft(draft_of(draft)); }));
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
    draft->labels = ViewStack<std::int32_t>({1, 1}, labels.height(), labels.width(), 1, view);
    std::copy(labels.begin(), labels.end(), draft->labels.data());
    news.on_draft(std::move(draft));
  };
  auto corrected = labeler.correct(scribbles_of(*input.scribbles), possible_parameters(input),
                                   {*before.labeling, former, first, on_view}, progress);
  return corrected ? std::make_shared<const Labeling>(std::move(*corrected)) : nullptr;
}

LabelingPtr label_all_views(const LabelingInput& input, const Progress& progress) {
  Labeler labeler = new_labeler(input);
  return std::make_shared<const Labeling>(
      labeler.label(scribbles_of(*input.scribbles), possible_parameters(input),
                    {{0, 0}, input.light_field->grid()}, progress));
}

namespace {

ViewIndex checked_view(const io::SegmentationFile& file, const std::string& name,
                       std::optional<ViewIndex> asked) {
  const ViewIndex middle = file.grid().center();
  const ViewIndex view =
      asked.value_or(ViewIndex{file.first().v + middle.v, file.first().u + middle.u});
  if (file.contains(view)) return view;
  throw InvalidInput(name + " has labels of " + std::to_string(file.grid().v) + "×" +
                     std::to_string(file.grid().u) + " views from view " + view_text(file.first()) +
                     " on, but view " + view_text(view) + " was asked for");
}

}  // namespace

void write_segmentation(const std::filesystem::path& path, const Segmentation& segmentation,
                        const std::string& input, StoredProbabilities probabilities,
                        const Progress& progress) {
  const Labeling& labeling = *segmentation.labeling;
  io::StoredSegmentation stored;
  stored.labels = finished_labels(labeling, segmentation.finish, progress.part(0, 0.1));
  stored.infos = infos_of(labeling.probabilities.ids, segmentation.labels);
  stored.parameters = segmentation.parameters;
  stored.source = source_text(input, path);
  stored.reading = segmentation.reading;
  stored.seconds = labeling.seconds;
  io::ViewProbabilities of_view;
  if (probabilities == StoredProbabilities::All && !labeling.probabilities.empty()) {
    of_view = [&labeling](ViewIndex view) { return labeling.probabilities.view(view).view(); };
  }
  io::write_segmentation(path, stored, of_view, progress.part(0.1, 1));
}

Segmentation read_segmentation(const std::filesystem::path& path, std::optional<ViewIndex> asked) {
  const io::SegmentationFile file(path);
  const ViewIndex view = checked_view(file, path.string(), asked);
  auto labeling = std::make_shared<Labeling>();
  const Image<std::int32_t> labels = file.labels(view);
  labeling->labels = ViewStack<std::int32_t>({1, 1}, labels.height(), labels.width(), 1, view);
  std::copy(labels.begin(), labels.end(), labeling->labels.data());
  if (file.has_probabilities()) {
    LabelProbabilities& probabilities = labeling->probabilities;
    for (const LabelInfo& info : file.infos()) probabilities.ids.push_back(info.id);
    probabilities.grid = {1, 1};
    probabilities.first = view;
    probabilities.views.push_back(io::bytes_of(file.probabilities(view)));
  }
  return {std::move(labeling), file.infos(), {}, file.reading()};
}

LabelingPtr read_archive_probabilities(const Scene& scene, ViewIndex view) {
  const auto found = std::ranges::find_if(scene.companions, [](const Companion& companion) {
    return companion.kind != CompanionKind::EdgeProbabilities;
  });
  const std::string& name = scene.light_field->info().name;
  if (found == scene.companions.end()) {
    throw InvalidInput(name + " has no file of label probabilities beside it");
  }
  const io::ProbabilityFile file(found->path, scene);
  if (!file.contains(view)) {
    throw InvalidInput(name + " has no probabilities in view " + view_text(view));
  }
  auto labeling = std::make_shared<Labeling>();
  LabelProbabilities& probabilities = labeling->probabilities;
  for (int id = 1; id <= file.label_count(); ++id) probabilities.ids.push_back(id);
  probabilities.grid = {1, 1};
  probabilities.first = view;
  probabilities.views.push_back(io::bytes_of(file.view(view)));
  const Image<std::int32_t> labels =
      most_probable_labels(probabilities.views.front().view(), probabilities.ids);
  labeling->labels = ViewStack<std::int32_t>({1, 1}, labels.height(), labels.width(), 1, view);
  std::copy(labels.begin(), labels.end(), labeling->labels.data());
  return labeling;
}

namespace {

namespace fs = std::filesystem;

fs::path folder_of(const LabelInfo& label, const fs::path& folder) {
  return folder / file_name_of(fmt::format("{:02}_{}", label.id, label.name));
}

void write_list(const fs::path& folder, const std::vector<LabelInfo>& labels) {
  std::string text;
  for (const LabelInfo& label : labels) text += fmt::format("{}\t{}\n", label.id, label.name);
  io::write_atomically(folder / kListOfMasks, text);
}

}  // namespace

int write_label_masks(const fs::path& folder, const Segmentation& segmentation,
                      const Progress& progress) {
  const Labeling& labeling = *segmentation.labeling;
  const std::vector<LabelInfo> infos = infos_of(labeling.probabilities.ids, segmentation.labels);
  io::make_folder(folder);
  for (const LabelInfo& label : infos) io::make_folder(folder_of(label, folder));
  write_list(folder, infos);
  const GridShape grid = labeling.labels.grid();
  int written = 0;
  for (int i = 0; i < grid.count(); ++i) {
    progress.report(static_cast<double>(i) / grid.count());
    const ViewIndex view = grid.view_at(i, labeling.labels.first());
    const Image<std::int32_t> labels = finished_labels(labeling, segmentation.finish, view);
    for (const LabelInfo& label : infos) {
      progress.check();
      io::write_picture(
          folder_of(label, folder) / fmt::format("mask_{:02}_{:02}.png", view.v, view.u),
          label_mask(labels, label.id).view());
      ++written;
    }
  }
  return written;
}

std::uint64_t hash_of(const ScribbleLayer& strokes) {
  Fnv1a hash;
  for (const ViewIndex view : strokes.painted_views()) {
    hash.add_word(static_cast<std::uint64_t>(view.v));
    hash.add_word(static_cast<std::uint64_t>(view.u));
    const ImageView<const std::uint8_t> image = strokes.view(view);
    hash.add({reinterpret_cast<const char*>(image.data), image.size()});
  }
  return hash.value();
}

void write_kept_labels(const std::filesystem::path& path, const KeptLabels& labels,
                       const std::string& input, const Progress& progress) {
  write_segmentation(path, {labels.labeling, labels.infos, {}, {}, {}}, input,
                     StoredProbabilities::None, progress);
}

LabelingPtr read_kept_labels(const std::filesystem::path& path, const Progress& progress) {
  const io::SegmentationFile file(path);
  auto labeling = std::make_shared<Labeling>();
  for (const LabelInfo& info : file.infos()) labeling->probabilities.ids.push_back(info.id);
  const int count = file.grid().count();
  for (int i = 0; i < count; ++i) {
    progress.report(static_cast<double>(i) / count);
    const ViewIndex view = file.grid().view_at(i, file.first());
    const Image<std::int32_t> labels = file.labels(view);
    if (i == 0) {
      labeling->labels =
          ViewStack<std::int32_t>(file.grid(), labels.height(), labels.width(), 1, file.first());
    }
    std::copy(labels.begin(), labels.end(), labeling->labels.view(view).data);
  }
  return labeling;
}

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

void LiveLabeler::change(LiveState state, std::string sentence) {
  state_ = state;
  sentence_ = std::move(sentence);
  on_changed_();
}

}  // namespace episcope
