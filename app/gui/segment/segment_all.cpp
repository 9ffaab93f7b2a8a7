// SPDX-License-Identifier: BSD-3-Clause
// Labels of all views, which take long.
#include "app/gui/segment/segment_controller.h"

#include "app/gui/frame/job_title.h"

#include <utility>

namespace episcope {

void SegmentController::segmentAllViews() {
  if (!live_.has_input()) return;
  const auto input = live_.input();
  if (!input->disparity) source_.provide();
  tried_all_ = input;
  wants_to_show_ = true;
  const std::uint64_t scene = session_.generation();
  quint64& job = all_views_[scene];
  jobs_.cancel(job);
  job = jobs_.start<LabelingPtr>(
      Lane::Label, job_title(tr("Segment all views"), session_),
      [input](const Progress& progress) { return label_all_views(*input, progress); },
      [this, input, scene, infos = std::as_const(document_).document()->labels().labels()](
          const LabelingPtr& labeling) {
        if (input->light_field == session_.light_field()) {
          finishAll(labeling, input);
        } else {
          session_.set_labels(scene, {labeling, infos, hash_of(*input->scribbles), {}});
        }
      });
  jobs_.setScene(job, scene);
}

bool SegmentController::isSegmentingAll() const {
  const auto job = all_views_.find(session_.generation());
  return job != all_views_.end() && jobs_.find(job->second);
}

void SegmentController::finishAll(const LabelingPtr& labeling,
                                  const std::shared_ptr<const LabelingInput>& input) {
  keep(labeling, *input);
  live_.take(labeling, input);
  seconds_ = labeling->seconds;
  publish();
}

void SegmentController::endAllViewsOfClosed() {
  for (auto each = all_views_.begin(); each != all_views_.end();) {
    const bool is_open = session_.find_scene(each->first) != nullptr;
    if (!is_open) jobs_.cancel(each->second);
    each = is_open ? std::next(each) : all_views_.erase(each);
  }
}

}  // namespace episcope
