// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/segment/segment_controller.h"

#include "app/gui/frame/queued_post.h"
#include "widgets/annotate/brush_panel.h"

#include <utility>

namespace episcope {
namespace {

QString percent(double share) {
  return QString::number(100 * share, 'f', 1) + " %";
}

}  // namespace

SegmentController::SegmentController(Session& session, DocumentController& document,
                                     AnnotateController& annotate, Jobs& jobs, const Panels& panels,
                                     QObject* parent)
    : QObject(parent),
      session_(session),
      document_(document),
      annotate_(annotate),
      jobs_(jobs),
      panels_(panels),
      source_(session, jobs, this),
      edges_(session, this),
      score_job_(this),
      live_(queued_post(this), [this] { followLabeler(); }) {
  panels_.segment->setParameters(labeler_schema().descriptions());
  panels_.segment->setSources(source_.sources(), source_.choice());
  connect(&document_, &DocumentController::replaced, this, &SegmentController::noteInput);
  connect(&document_, &DocumentController::changed, this,
          [this](const DocumentChange& change) { change.views.empty() ? publish() : noteInput(); });
  connect(&source_, &LabelingSource::changed, this, [this] {
    panels_.segment->setSources(source_.sources(), source_.choice());
    const bool is_same = live_.has_input() && live_.input()->disparity ==
                                                  source_.find(live_.input()->parameters.features);
    is_same ? showState() : noteInput();
  });
  connect(&edges_, &EdgeSource::changed, this, &SegmentController::noteInput);
  connect(&edges_, &EdgeSource::failed, this, &SegmentController::hint);
  connect(panels_.segment, &SegmentPanel::sourceEdited, this,
          [this] { source_.choose(panels_.segment->source()); });
  connect(panels_.segment, &SegmentPanel::parametersEdited, this, &SegmentController::noteInput);
  connect(panels_.segment, &SegmentPanel::keepsAllViewsEdited, this,
          &SegmentController::followLabeler);
  connect(&annotate_, &AnnotateController::labelChanged, this, &SegmentController::publish);
  connect(&jobs_, &Jobs::removed, this, [this] {
    if (is_live_ || is_wanted_) source_.provide();
    emit changed();
  });
  annotate_.setSegmentation([this](ViewIndex view) {
    const LabelingPtr labeling = live_.labeling(view);
    return labeling ? labeling->labels.view(view) : ImageView<const std::int32_t>();
  });
  session_.on_changed([this](Parts parts) { update(parts); });
  showState();
}

LabelerParameters SegmentController::parameters() const {
  return labeler_schema().parse(panels_.segment->parameters());
}

void SegmentController::update(Parts parts) {
  if (parts.has(Part::Scene)) {
    jobs_.cancelLane(Lane::Label);  // the document tells of the rest
  } else if (parts.has(Part::View)) {
    if (is_live_) begin();
    publish();
  } else if (parts.has(Part::TrueLabels) && session_.segmentation()) {
    score();
  }
}

// Whatever the labels go by is another now.
void SegmentController::noteInput() {
  const AnnotationDocument* document = std::as_const(document_).document();
  if (!document || !session_.scene()) {
    live_.clear();
    is_wanted_ = false;
  } else {
    LabelingInput input;
    input.light_field = session_.light_field();
    input.parameters = parameters();
    input.disparity = source_.find(input.parameters.features);
    input.edges = edges_.edges();
    input.scribbles = std::make_shared<const ScribbleLayer>(document->scribbles());
    live_.set_input(std::move(input));
    if (is_live_ || is_wanted_) begin();
  }
  publish();
}

void SegmentController::begin() {
  if (!live_.has_input()) return;
  if (!live_.input()->disparity) source_.provide();
  live_.label(session_.view());
  if (live_.is_running()) clock_.start();
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
  emit changed();
}

void SegmentController::updateNow() {
  if (!live_.has_input()) {
    emit hint(tr("Open a light field first."));
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

void SegmentController::segmentAllViews() {
  if (!live_.has_input()) return;
  const auto input = live_.input();
  if (!input->disparity) source_.provide();
  tried_all_ = input;
  wants_to_show_ = true;
  jobs_.cancelLane(Lane::Label);
  jobs_.start<LabelingPtr>(
      Lane::Label, tr("Segment all views"),
      [input](const Progress& progress) { return label_all_views(*input, progress); },
      [this, input](const LabelingPtr& labeling) { finishAll(labeling, input); });
  emit changed();
}

void SegmentController::finishAll(const LabelingPtr& labeling,
                                  const std::shared_ptr<const LabelingInput>& input) {
  live_.take(labeling, input);
  seconds_ = labeling->seconds;
  publish();
}

void SegmentController::followLabeler() {
  const LabelingPtr labeling = live_.labeling(session_.view());
  const bool is_new = !session_.segmentation() || session_.segmentation()->labeling != labeling;
  if (is_new && labeling) seconds_ = static_cast<double>(clock_.elapsed()) / 1000;
  endWish();
  publish();
  const bool is_done = live_.state() == LiveState::Idle && live_.is_up_to_date(session_.view());
  if (is_live_ && is_done && panels_.segment->keepsAllViews() && tried_all_ != live_.input() &&
      labeling->labels.grid().count() == 1) {
    segmentAllViews();
  }
}

void SegmentController::publish() {
  const AnnotationDocument* document = std::as_const(document_).document();
  if (!document || !live_.has_input()) {
    session_.set_segmentation(nullptr);
    panels_.brush->setSegmentationAvailable(false);
    showState();
    return;
  }
  auto segmentation = std::make_shared<Segmentation>();
  segmentation->labeling = live_.labeling(session_.view());
  segmentation->is_up_to_date = live_.is_up_to_date(session_.view());
  segmentation->labels = document->labels().labels();
  segmentation->label = annotate_.label();
  segmentation->disparity = live_.input()->disparity;
  segmentation->edges = live_.input()->edges;
  segmentation->parameters = labeler_schema().values(possible_parameters(*live_.input()));
  panels_.brush->setSegmentationAvailable(segmentation->labeling != nullptr);
  const bool is_labeled = segmentation->labeling != nullptr;
  session_.set_segmentation(std::move(segmentation));
  if (is_labeled && std::exchange(wants_to_show_, false)) emit labelsArrived();
  score();
  showState();
}

QString SegmentController::missing() const {
  if (live_.state() == LiveState::Hint || live_.state() == LiveState::Failed) {
    return QString::fromStdString(live_.sentence());
  }
  if (!live_.has_input() || live_.input()->disparity) return {};
  if (live_.input()->parameters.features == FeatureSet::ImageTruth) {
    return tr("There is no true disparity of all views: labels go by images alone.");
  }
  if (source_.isComing() && (is_live_ || live_.labeling(session_.view()))) {
    return tr("Labels go by images alone until the disparity is estimated.");
  }
  return {};
}

void SegmentController::showState() {
  const auto seconds = [this] { return tr("%1 s").arg(seconds_, 0, 'f', 1); };
  const bool is_labeled = live_.labeling(session_.view()) != nullptr;
  QString text = !session_.scene()                      ? QString()
                 : !is_labeled                          ? tr("idle")
                 : live_.is_up_to_date(session_.view()) ? tr("idle · %1").arg(seconds())
                                                        : tr("out of date");
  ChipMood mood =
      is_labeled && !live_.is_up_to_date(session_.view()) ? ChipMood::Stale : ChipMood::Quiet;
  switch (live_.state()) {
    case LiveState::Training:
      text = tr("training …");
      mood = ChipMood::Busy;
      break;
    case LiveState::Labeling:
      text = tr("labelling …");
      mood = ChipMood::Busy;
      break;
    case LiveState::Refining:
      text = tr("refining … %1").arg(seconds());
      mood = ChipMood::Busy;
      break;
    case LiveState::Hint:
      text = tr("waiting");
      mood = ChipMood::Hint;
      break;
    case LiveState::Failed:
      text = tr("failed");
      mood = ChipMood::Failed;
      break;
    case LiveState::Idle:
    case LiveState::OutOfDate:
      break;
  }
  panels_.segment->setState(text, mood,
                            tr("What the segmentation of this view does, and how long it took.") +
                                '\n' + edges_.origin());
  const QString sentence = missing();
  panels_.segment->setNote(sentence.isEmpty() ? scores_ : sentence);
  emit changed();
}

void SegmentController::score() {
  const SegmentationPtr segmentation = session_.segmentation();
  const TrueLabelsPtr& truth = session_.true_labels();
  if (segmentation->labeling == scored_ && session_.view() == scored_view_ &&
      truth == scored_truth_) {
    return;
  }
  scored_ = segmentation->labeling;
  scored_truth_ = truth;
  scored_view_ = session_.view();
  scores_.clear();
  score_job_.drop();
  if (!scored_) return;
  score_job_.start<LabelingScores>(
      [truth, segmentation, view = scored_view_,
       scene = session_.scene()](const Progress& progress) {
        static const ViewStack<std::int32_t> kNone;
        return judge_labeling(segmentation->labeling->labels, view, truth ? *truth : kNone,
                              *scene->truth, segmentation->disparity.get(), progress);
      },
      [this](const LabelingScores& scores) { showScores(scores); });
}

void SegmentController::showScores(const LabelingScores& scores) {
  QStringList parts;
  const auto of_view = scores.view.share();
  const auto of_all = scores.all_views.share();
  if (of_view) parts << tr("right: %1 of this view").arg(percent(*of_view));
  if (of_all) parts << tr("%1 of all").arg(percent(*of_all));
  if (scores.consistency) parts << tr("consistent: %1").arg(percent(*scores.consistency));
  scores_ = parts.join(", ");
  showState();
}

}  // namespace episcope
