// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/segmentation.h"

#include "annotation/exchange.h"
#include "engine/labeling/label_review.h"

#include <algorithm>

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

// The one who is told of a draft is not its owner.
LabelingPtr copy(const Labeling& from) {
  auto to = std::make_shared<Labeling>();
  to->probabilities.ids = from.probabilities.ids;
  to->probabilities.grid = from.probabilities.grid;
  to->probabilities.first = from.probabilities.first;
  for (const ProbabilityMap& map : from.probabilities.views) {
    to->probabilities.views.push_back(copy(map.view()));
  }
  to->labels = from.labels.clone();
  to->is_draft = true;
  to->seconds = from.seconds;
  return to;
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
  const Schema<LabelerParameters> schema = labeler_schema();
  return is_same_scene(a, b) && schema.values(a.parameters) == schema.values(b.parameters) &&
         *a.scribbles == *b.scribbles;
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
                    progress, [&](const Labeling& draft) { on_draft(copy(draft)); }));
}

LabelingPtr label_all_views(const LabelingInput& input, const Progress& progress) {
  Labeler labeler = new_labeler(input);
  return std::make_shared<const Labeling>(
      labeler.label(scribbles_of(*input.scribbles), possible_parameters(input),
                    {{0, 0}, input.light_field->grid()}, progress));
}

}  // namespace episcope
