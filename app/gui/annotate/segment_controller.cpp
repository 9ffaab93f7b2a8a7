// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/segment_controller.h"

#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/frame.h"
#include "widgets/controls/text.h"
#include "widgets/panels/segment_panel.h"
#include "widgets/panels/view_grid.h"

#include <QAction>

#include <utility>

namespace episcope {
namespace {

// Labels that a project kept have no probabilities.
bool has_map_in(const Labeling& labeling, render::Quantity quantity, ViewIndex view) {
  const bool is_of_probabilities =
      quantity == render::Quantity::Probability || quantity == render::Quantity::Uncertainty;
  return is_of_probabilities ? labeling.probabilities.contains(view)
                             : labeling.labels.contains(view);
}

KeptLabels kept_labels(const LabelingPtr& labeling, const std::vector<LabelInfo>& infos,
                       const LabelingInput& input) {
  return {labeling, infos, hash_of(*input.scribbles), {}};
}

// The label that one set has and another lacks; 0 if there is none.
int only_in(const LabelSet& set, const LabelSet& other) {
  for (const LabelInfo& label : set.labels()) {
    if (!other.contains(label.id)) return label.id;
  }
  return 0;
}

}  // namespace

SegmentController::SegmentController(const Workbench& bench, SegmentPanel* panel)
    : QObject(&bench.owner),
      bench_(bench),
      session_(bench.session),
      document_(bench.document),
      jobs_(bench.jobs),
      panel_(panel),
      grid_(bench.window.findChild<ViewGrid*>()),
      source_(bench.session, bench.jobs, this),
      edges_(bench.session, this),
      scores_(bench.session, this),
      live_(queued_post(this), [this] { followLabeler(); }) {
  connectDocument();
  connectPanel();
  connect(&scores_, &LabelScores::changed, this, &SegmentController::showState);
  bench.overlay.setProvider(render::Subject::Segmentation, this);
  bench.cancels.add(CancelRank::LiveSegmentation, [this] { return cancel(); });
  connect(&jobs_, &Jobs::removed, this, [this] {
    if (is_live_ || is_wanted_) source_.provide();
    goOnWithAllViews();
  });
  connect(&jobs_, &Jobs::cancelling, this, [this](quint64 id) {
    if (source_.isProvidedBy(id) && awaiting_.erase(session_.generation()) > 0) showState();
  });
  session_.on_changed([this](Parts parts) { update(parts); });
  showState();
}

SegmentController::~SegmentController() {
  bench_.overlay.setProvider(render::Subject::Segmentation, nullptr);
}

void SegmentController::connectDocument() {
  connect(&document_, &DocumentController::replaced, this, &SegmentController::noteInput);
  connect(&document_, &DocumentController::changed, this,
          [this](const DocumentChange& change) { change.views.empty() ? publish() : noteInput(); });
  connect(&bench_.labels, &LabelChoice::changed, this, &SegmentController::publish);
  connect(&bench_.labels, &LabelChoice::relabeled, this, &SegmentController::relabel);
  connect(&document_, &DocumentController::steppedBack, this,
          [this](const DocumentChange&, const Edit& edit, bool is_undo) {
            if (edit.kind == EditKind::ImportSegmentation) stepOverImport(is_undo);
            if (edit.kind != EditKind::RenumberLabel || !edit.labels) return;
            const int before = only_in(edit.labels->before, edit.labels->after);
            const int after = only_in(edit.labels->after, edit.labels->before);
            is_undo ? relabel(after, before) : relabel(before, after);
          });
  connect(&source_, &LabelingSource::changed, this, [this] {
    panel_->setSources(source_.sources(), source_.choice());
    const bool is_same =
        live_.has_input() &&
        live_.input()->disparity == source_.find(live_.input()->parameters.features).field;
    is_same ? showState() : noteInput();
    goOnWithAllViews();
  });
  connect(&edges_, &EdgeSource::changed, this, &SegmentController::noteInput);
  connect(&edges_, &EdgeSource::failed, &bench_.messages, &Messages::hint);
}

void SegmentController::connectPanel() {
  panel_->setParameters(labeler_schema().descriptions());
  panel_->setSources(source_.sources(), source_.choice());
  connect(panel_, &SegmentPanel::sourceEdited, this, [this] { source_.choose(panel_->source()); });
  connect(panel_, &SegmentPanel::parametersEdited, this, &SegmentController::noteInput);
  connect(panel_, &SegmentPanel::smoothingEdited, this, &SegmentController::smoothBoundaries);
  connect(panel_, &SegmentPanel::keepsAllViewsEdited, this, [this] {
    begin();
    followLabeler();
  });
}

bool SegmentController::hasSegmentation() const {
  return live_.labeling(session_.view()) && document_.document() && live_.has_input();
}

bool SegmentController::hasAllViews() const {
  return hasSegmentation() && live_.covers_all(session_.view());
}

bool SegmentController::isSegmentationUpToDate() const {
  return live_.is_widest_up_to_date(session_.view());
}

std::optional<Segmentation> SegmentController::segmentation() const {
  if (!hasSegmentation()) return std::nullopt;
  return Segmentation{live_.widest(session_.view()), document_.labels().labels(),
                      labeler_schema().values(possible_parameters(*live_.input())),
                      live_.input()->light_field->info().reading, finish()};
}

bool SegmentController::has_map(render::Quantity quantity) const {
  if (!live_.has_input()) return false;
  if (quantity == render::Quantity::Edges) return true;
  if (quantity == render::Quantity::WrongLabels && !session_.true_labels()) return false;
  const LabelingPtr labeling = live_.labeling(session_.view());
  return labeling && has_map_in(*labeling, quantity, session_.view());
}

bool SegmentController::awaits_map(render::Quantity quantity) const {
  if (quantity == render::Quantity::WrongLabels && !session_.true_labels()) return false;
  if (isComing()) return true;
  // Kept labels come once there is a document; in another view there may be labels already.
  const bool is_restored = restored_ == session_.generation();
  const LabelingPtr here =
      is_restored ? live_.labeling(session_.view()) : session_.labels().labeling;
  return here ? has_map_in(*here, quantity, session_.view()) : is_restored && live_.has_labels();
}

// Whether labels are on their way, from strokes or a file.
bool SegmentController::isComing() const {
  const bool lacks_strokes = live_.state() == LiveState::Hint || live_.state() == LiveState::Failed;
  const KeptLabels& kept = session_.labels();
  return live_.is_running() || is_wanted_ || (is_live_ && !lacks_strokes) || isSegmentingAll() ||
         awaiting_.contains(session_.generation()) || kept.is_on_disk_alone();
}

QString SegmentController::title(render::Quantity quantity) const {
  const LabelInfo* label = bench_.labels.info();
  const bool is_of_label = quantity == render::Quantity::Probability && label;
  const QString name =
      is_of_label ? tr("probability of “%1”").arg(label_name(*label)) : quantity_label(quantity);
  const bool is_outdated = quantity != render::Quantity::Edges && !live_.is_running() &&
                           live_.labeling(session_.view()) &&
                           !live_.is_up_to_date(session_.view()) &&
                           !live_.is_before_strokes(session_.view());
  return is_outdated ? tr("%1, out of date").arg(name) : name;
}

std::optional<MapSource> SegmentController::map_source(render::Quantity quantity,
                                                       ViewIndex view) const {
  if (!document_.document() || !live_.has_input()) return std::nullopt;
  MapSource source;
  source.quantity = quantity;
  source.view = view;
  source.light_field = session_.light_field();
  // What a map does not need would have it made again whenever that changes.
  if (quantity == render::Quantity::Edges) {
    source.edges = live_.input()->edges;
    source.edge_disparity = live_.input()->disparity;
    return source;
  }
  source.labeling = live_.labeling(view);
  if (quantity == render::Quantity::Segmentation || quantity == render::Quantity::WrongLabels) {
    source.label_infos = document_.labels().labels();
  }
  if (quantity == render::Quantity::Segmentation) {
    source.label_style = session_.label_style();
  }
  if (quantity == render::Quantity::Segmentation || quantity == render::Quantity::WrongLabels) {
    source.finish = finish();
  }
  if (quantity == render::Quantity::Probability) source.label = bench_.labels.current();
  if (quantity == render::Quantity::WrongLabels) {
    source.true_labels = session_.true_labels();
    source.true_label_infos = session_.true_label_infos();
  }
  if (!reason_against(source).empty()) return std::nullopt;
  return source;
}

double SegmentController::smoothing() const {
  const AnnotationDocument* document = document_.document();
  return document ? document->boundary_smoothing_px() : 0;
}

LabelFinish SegmentController::finish() const {
  // Without smoothing nothing else matters: nothing is made again after a stroke.
  if (smoothing() == 0 || !live_.has_input()) return {};
  return {smoothing(), live_.input()->scribbles};
}

void SegmentController::smoothBoundaries(double smoothing_px) {
  document_.edit([smoothing_px](AnnotationDocument& document) {
    document.set_boundary_smoothing(smoothing_px);
  });
}

LabelerParameters SegmentController::parameters() const {
  return labeler_schema().parse(panel_->parameters());
}

void SegmentController::update(Parts parts) {
  if (parts.has(Part::Scenes)) endAllViewsOfClosed();
  if (parts.has(Part::Scene)) return;  // the document tells of it
  if (parts.has(Part::View)) {
    begin();
    publish();
  } else if (parts.has(Part::TrueLabels)) {
    score();
  }
}

// An input of the labels changed.
void SegmentController::noteInput() {
  const AnnotationDocument* document = document_.document();
  if (!document || !session_.scene()) {
    live_.clear();
    is_wanted_ = false;
  } else {
    LabelingInput input;
    input.light_field = session_.light_field();
    input.parameters = parameters();
    const LabelingDisparity disparity = source_.find(input.parameters.features);
    input.disparity = disparity.field;
    input.confidence = disparity.confidence();
    input.edges = edges_.edges();
    input.scribbles = std::make_shared<const ScribbleLayer>(document->scribbles());
    const bool stays_imported = staysImported(input);
    live_.set_input(std::move(input));
    restore();
    if (stays_imported) adopt(session_.labels());
    const LabelingPtr all = live_.labeling(session_.view());
    const bool is_back = all && all->labels.grid().count() > 1 && isSegmentationUpToDate();
    if (is_back) keep(all, *live_.input());
    begin();
  }
  publish();
  goOnWithAllViews();
}

// A disparity that becomes known leaves labels from elsewhere as they are.
bool SegmentController::staysImported(LabelingInput now) const {
  const KeptLabels& kept = session_.labels();
  const auto before = live_.input();
  if (!before || !kept.is_imported || live_.labeling(session_.view()) != kept.labeling)
    return false;
  now.disparity = before->disparity;
  now.confidence = before->confidence;
  now.edges = before->edges;
  return kept.labeling && isSegmentationUpToDate() && is_same(*before, now);
}

// What was merged or has another number is so in the labels shown, too.
void SegmentController::relabel(int from, int to) {
  live_.relabel(from, to);
  const ViewIndex view = session_.view();
  if (live_.labeling(view) && live_.is_up_to_date(view)) {
    keep(live_.labeling(view), *live_.input());
  }
  begin();
  publish();
}

// Labels of all views are corrected by each stroke; what else is begun was asked for.
void SegmentController::begin() {
  if (!live_.has_input()) return;
  if ((is_live_ || is_wanted_) && !live_.input()->disparity) source_.provide();
  const ViewIndex view = session_.view();
  const bool was_running = live_.is_running();
  if (panel_->keepsAllViews() && live_.can_correct()) {
    live_.correct(view);
  } else if (is_wanted_ || (is_live_ && !live_.is_before_strokes(view))) {
    live_.label(view);
  }
  if (live_.is_running() && !was_running) clock_.start();
  // Nobody paints while the panel is hidden: browsing costs nothing then.
  if (panel_->keepsAllViews() && (is_live_ || panel_->isVisible())) live_.prepare(view);
  endWish();
}

// Labels made of images alone are not yet those that were asked for.
void SegmentController::endWish() {
  if (!live_.is_running() && (live_.input()->disparity || !source_.isComing())) is_wanted_ = false;
}

void SegmentController::setLive(bool is_live) {
  is_live_ = is_live;
  if (is_live) {
    wants_to_show_ = true;
    begin();
  } else {
    live_.cancel();
  }
  publish();
}

void SegmentController::updateNow() {
  if (!live_.has_input()) {
    bench_.messages.hint(open_a_light_field());
    return;
  }
  is_wanted_ = wants_to_show_ = true;
  begin();
  publish();
}

bool SegmentController::cancel() {
  if (!live_.is_running()) return false;
  is_wanted_ = false;
  live_.cancel();
  showState();
  return true;
}

void SegmentController::followLabeler() {
  const LabelingPtr labeling = live_.labeling(session_.view());
  // Views that a correction has done change nothing else.
  if (labeling == shown_labeling_ && !live_.corrected_views().empty()) return showProgress();
  if (labeling && labeling != shown_labeling_)
    seconds_ = static_cast<double>(clock_.elapsed()) / 1000;
  endWish();
  publish();
  const bool is_done = live_.state() == LiveState::Idle && live_.is_up_to_date(session_.view());
  if (is_done) keep(labeling, *live_.input());
  if (is_live_ && is_done && panel_->keepsAllViews() && tried_all_ != live_.input() &&
      labeling->labels.grid().count() == 1) {
    segmentAllViews();
  }
}

// Updates the overlay.
void SegmentController::publish() {
  shown_labeling_ = live_.labeling(session_.view());
  const bool showed_labels = showsLabels();
  bench_.overlay.updateProvided();
  // Where nothing is painted yet, live labels are shown once there are some.
  if (is_live_ && showed_labels && !showsLabels()) wants_to_show_ = true;
  if (shown_labeling_ && std::exchange(wants_to_show_, false)) showLabels();
  score();
  showState();
}

// Requested labels are shown.
void SegmentController::showLabels() {
  if (!showsLabels()) bench_.overlay.setQuantity(render::Quantity::Segmentation);
}

bool SegmentController::showsLabels() const {
  return render::info_of(bench_.overlay.quantity()).subject == render::Subject::Segmentation;
}

QString SegmentController::missing() const {
  if (live_.state() == LiveState::Hint || live_.state() == LiveState::Failed) {
    return QString::fromStdString(live_.sentence());
  }
  if (!live_.has_input() || live_.input()->disparity) return {};
  if (awaiting_.contains(session_.generation())) {
    return tr("All views are segmented once the disparity is estimated.");
  }
  if (live_.input()->parameters.features == FeatureSet::ImageTruth) {
    return tr(
        "There is no ground-truth disparity for all views: labels are based on the images alone.");
  }
  if (source_.isComing() && (is_live_ || live_.labeling(session_.view()))) {
    return tr("Labels are based on the images alone until the disparity is estimated.");
  }
  return {};
}

// How far the correction of all views is.
QString SegmentController::correcting() const {
  return tr("correcting views: %1 of %2 …")
      .arg(live_.corrected_views().size())
      .arg(session_.light_field()->grid().count());
}

SegmentController::State SegmentController::state() const {
  const QString seconds = tr("%1 s").arg(seconds_, 0, 'f', 1);
  switch (live_.state()) {
    case LiveState::Training:
      return {tr("training …"), ChipMood::Busy};
    case LiveState::Labeling:
      return {tr("labeling …"), ChipMood::Busy};
    case LiveState::Refining:
      if (!live_.corrected_views().empty()) return {correcting(), ChipMood::Busy};
      return {tr("refining … %1").arg(seconds), ChipMood::Busy};
    case LiveState::Failed:
      return {tr("failed"), ChipMood::Failed};
    case LiveState::Hint:
      if (live_.labeling(session_.view())) break;  // out of date: of strokes that are gone
      return {tr("waiting"), ChipMood::Hint};
    case LiveState::Idle:
    case LiveState::OutOfDate:
      break;
  }
  if (!session_.scene()) return {{}, ChipMood::Quiet};
  if (awaiting_.contains(session_.generation())) {
    return {tr("waiting for the disparity …"), ChipMood::Busy};
  }
  if (isSegmentingAll()) return {tr("labeling …"), ChipMood::Busy};
  if (!live_.labeling(session_.view())) return {tr("idle"), ChipMood::Quiet};
  if (live_.is_before_strokes(session_.view())) {
    return {tr("before the last stroke"), ChipMood::Stale};
  }
  if (!live_.is_up_to_date(session_.view())) return {tr("out of date"), ChipMood::Stale};
  return {tr("idle · %1").arg(seconds), ChipMood::Quiet};
}

void SegmentController::showProgress() {
  const State shown = state();
  panel_->setState(
      shown.text, shown.mood,
      tr("State of the segmentation of this view, and how long it took.") + '\n' + edges_.origin());
  if (grid_) grid_->setDone(live_.corrected_views());
}

void SegmentController::showState() {
  showProgress();
  panel_->setSmoothing(smoothing());
  QStringList notes{missing().isEmpty() ? scores_.text() : missing()};
  if (live_.is_up_to_date(session_.view()) && !isSegmentationUpToDate()) {
    notes << tr("Other views: before the last stroke.");
  }
  notes.removeAll({});
  panel_->setNote(notes.join('\n'));
  bench_.commands.refresh();
}

void SegmentController::score() {
  // While another light field is opened, the labels of the last one are still there.
  scores_.judge({session_.scene() ? live_.labeling(session_.view()) : nullptr, finish(),
                 document_.labels().labels()},
                live_.has_input() ? live_.input()->disparity : nullptr);
}

void SegmentController::segmentAllViews() {
  if (!live_.has_input()) return;
  wants_to_show_ = true;
  if (!live_.input()->disparity) source_.provide();
  if (awaitsDisparity()) {
    awaiting_.insert(session_.generation());
    showState();
  } else {
    startAllViews();
  }
}

// Whether a disparity is being estimated, or has not yet become part of the input.
bool SegmentController::awaitsDisparity() const {
  return !live_.input()->disparity &&
         (source_.isComing() || source_.find(live_.input()->parameters.features).field);
}

void SegmentController::goOnWithAllViews() {
  if (!awaiting_.contains(session_.generation()) || !live_.has_input()) return;
  if (!live_.input()->disparity) source_.provide();
  if (awaitsDisparity()) return;
  if (!live_.input()->disparity) {
    bench_.messages.hint(
        tr("There is no disparity of all views: all views are segmented by the images alone."));
  }
  startAllViews();
}

void SegmentController::startAllViews() {
  const auto input = live_.input();
  tried_all_ = input;
  const std::uint64_t scene = session_.generation();
  awaiting_.erase(scene);
  quint64& job = all_views_[scene];
  jobs_.cancel(job);
  job = jobs_.start<LabelingPtr>(
      Lane::Label, job_title(tr("Segment all views"), session_),
      [input](const Progress& progress) { return label_all_views(*input, progress); },
      [this, input, scene, infos = document_.labels().labels()](const LabelingPtr& labeling) {
        if (input->light_field == session_.light_field()) {
          finishAll(labeling, input);
        } else {
          session_.set_labels(scene, kept_labels(labeling, infos, *input));
        }
      },
      [this] { showState(); });
  jobs_.setScene(job, scene);
  showState();
}

bool SegmentController::isSegmentingAll() const {
  const auto job = all_views_.find(session_.generation());
  return job != all_views_.end() && jobs_.find(job->second);
}

void SegmentController::finishAll(const LabelingPtr& labeling,
                                  const std::shared_ptr<const LabelingInput>& input) {
  keep(labeling, *input);
  live_.take(labeling, input);
  panel_->setKeepsAllViews(true);
  begin();
  seconds_ = labeling->seconds;
  publish();
}

void SegmentController::endAllViewsOfClosed() {
  std::erase_if(imports_,
                [this](const auto& each) { return !session_.find_scene(each.first.first); });
  std::erase_if(awaiting_, [this](std::uint64_t each) { return !session_.find_scene(each); });
  for (auto each = all_views_.begin(); each != all_views_.end();) {
    const bool is_open = session_.find_scene(each->first) != nullptr;
    if (!is_open) jobs_.cancel(each->second);
    each = is_open ? std::next(each) : all_views_.erase(each);
  }
}

// Keeps the newest final labels with the scene. Labels of one view never replace labels of all.
void SegmentController::keep(const LabelingPtr& labeling, const LabelingInput& input) {
  const KeptLabels& kept = session_.labels();
  const bool keeps_all = kept.covers_many() || kept.is_on_disk_alone();
  if (labeling->is_draft || labeling == kept.labeling) return;
  if (labeling->labels.grid().count() == 1 && keeps_all) return;
  session_.set_labels(session_.generation(),
                      kept_labels(labeling, document_.labels().labels(), input));
}

// Runs once each time a scene is shown.
void SegmentController::restore() {
  const std::uint64_t scene = session_.generation();
  if (std::exchange(restored_, scene) == scene) return;
  const KeptLabels& kept = session_.labels();
  if (kept.labeling) {
    adopt(kept);
  } else if (!kept.file.empty()) {
    jobs_.start<LabelingPtr>(
        Lane::Load, tr("Reading labels"),
        [file = kept.file](const Progress& progress) { return read_kept_labels(file, progress); },
        [this, scene](const LabelingPtr& labeling) {
          if (scene != session_.generation() || session_.labels().labeling) return;
          KeptLabels read = session_.labels();
          read.labeling = labeling;
          read.is_imported = true;
          session_.set_labels(scene, read);
          adopt(read);
        });
  }
}

void SegmentController::takeLabels(const LabelingPtr& labeling) {
  if (!live_.has_input()) return;
  KeptLabels former = session_.labels();
  former.file.clear();  // which those in its place are stored over
  noteInput();
  KeptLabels kept = kept_labels(labeling, document_.labels().labels(), *live_.input());
  kept.is_imported = true;
  imports_[{session_.generation(), document_.document()->state()}] = {former, kept};
  session_.set_labels(session_.generation(), kept);
  wants_to_show_ = true;
  adopt(kept);
}

// An import is a step of the history, which knows nothing of labels that are no strokes.
void SegmentController::stepOverImport(bool is_undo) {
  const History<Edit>& history = document_.document()->history();
  const std::size_t step = history.applied_count() + (is_undo ? 1 : 0);
  const auto import = imports_.find({session_.generation(), history.state_after(step)});
  if (import == imports_.end()) return;
  const auto& [before, after] = import->second;
  // Labels that were computed since stay.
  if (session_.labels().labeling != (is_undo ? after : before).labeling) return;
  putBack(is_undo ? before : after);
}

void SegmentController::putBack(const KeptLabels& kept) {
  session_.set_labels(session_.generation(), kept);
  live_.clear();
  restored_ = 0;
  noteInput();
}

void SegmentController::adopt(const KeptLabels& kept) {
  const auto& labels = kept.labeling->labels;
  const LightField& light_field = *session_.light_field();
  if (!live_.has_input() || labels.height() != light_field.height() ||
      labels.width() != light_field.width() || !labels.contains(session_.view())) {
    return;
  }
  // What was painted since makes them out of date.
  const bool is_of_now = hash_of(*live_.input()->scribbles) == kept.strokes;
  auto input = live_.input();
  if (!is_of_now) {
    LabelingInput former = *input;
    former.scribbles = nullptr;
    input = std::make_shared<const LabelingInput>(std::move(former));
  }
  live_.take(kept.labeling, input);
  publish();
}

}  // namespace episcope

#include "moc_segment_controller.cpp"
