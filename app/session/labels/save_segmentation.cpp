// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/labels/save_segmentation.h"

#include "app/session/run/result_source.h"
#include "engine/core/error.h"
#include "engine/io/archive/companions.h"
#include "engine/io/labels/segmentation_file.h"

#include <algorithm>
#include <cmath>

namespace episcope {
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

}  // namespace episcope
