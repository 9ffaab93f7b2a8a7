// SPDX-License-Identifier: BSD-3-Clause
// Labels that stay with their scene and its project.
#include "app/gui/segment/segment_controller.h"

#include <utility>

namespace episcope {

// The newest final labels stay with the scene; those of a view never in the place of those of all.
void SegmentController::keep(const LabelingPtr& labeling, const LabelingInput& input) {
  const KeptLabels& kept = session_.labels();
  const bool keeps_all = kept.covers_many() || (!kept.labeling && !kept.file.empty());
  if (labeling->is_draft || labeling == kept.labeling) return;
  if (labeling->labels.grid().count() == 1 && keeps_all) return;
  session_.set_labels(session_.generation(),
                      {labeling,
                       std::as_const(document_).document()->labels().labels(),
                       hash_of(*input.scribbles),
                       {}});
}

// Once for each time a scene is shown.
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
          session_.set_labels(scene, read);
          adopt(read);
        });
  }
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
  live_.take(kept.labeling,
             is_of_now ? live_.input() : std::make_shared<const LabelingInput>(*live_.input()));
  publish();
}

}  // namespace episcope
