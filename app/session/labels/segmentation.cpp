// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/labels/segmentation.h"

#include "engine/labeling/review/smooth_boundaries.h"

#include <algorithm>

namespace episcope {

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

}  // namespace episcope
