// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/segmentation.h"

#include "annotation/exchange.h"
#include "app/session/judge.h"
#include "app/session/result_files.h"
#include "app/session/user_folders.h"
#include "engine/core/error.h"
#include "engine/core/hash.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"
#include "engine/io/base/hdf5_file.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/json.h"
#include "engine/io/formats/archive_companions.h"
#include "engine/io/models/scribble_file.h"
#include "engine/labeling/label_review.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace episcope {

TrueLabelsPtr true_labels_of(const GroundTruthPtr& truth) {
  return truth->labels.empty() ? nullptr : TrueLabelsPtr(truth, &truth->labels);
}

ViewStack<std::int32_t> stack_of(const Image<std::int32_t>& labels, ViewIndex view) {
  ViewStack<std::int32_t> stack({1, 1}, labels.height(), labels.width(), 1, view);
  std::copy(labels.begin(), labels.end(), stack.data());
  return stack;
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
    infos.push_back(found != known.end() ? *found : default_label(id));
  }
  return infos;
}

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
  if (joins_views(parameters.regularizer)) parameters.regularizer = Regularizer::View;
  return parameters;
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
  const std::string reason = reason_against_view({file.first(), file.grid()}, view, name, "labels");
  if (reason.empty()) return view;
  throw InvalidInput(reason);
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
  stored.sources_hash = segmentation.sources_hash;
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
  labeling->labels = stack_of(file.labels(view), view);
  if (file.has_probabilities()) {
    LabelProbabilities& probabilities = labeling->probabilities;
    for (const LabelInfo& info : file.infos()) probabilities.ids.push_back(info.id);
    probabilities.grid = {1, 1};
    probabilities.first = view;
    probabilities.views.push_back(io::bytes_of(file.probabilities(view)));
  }
  return {std::move(labeling), file.infos(), {}, file.reading()};
}

Provenance labels_provenance(const std::filesystem::path& path) {
  const io::SegmentationFile labels(path);
  const io::Hdf5Input attributes(path);
  Provenance made;
  made.method = "label";
  made.parameters = io::parameters_from_json(attributes.text("/", "parameters").value_or(""));
  made.seconds = attributes.number("/", "seconds").value_or(0);
  made.version = attributes.text("/", "version").value_or("");
  made.source = labels.source();
  made.reading = labels.reading();
  return made;
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
  labeling->labels =
      stack_of(most_probable_labels(probabilities.views.front().view(), probabilities.ids), view);
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

std::uint64_t hash_of(const LabelSources& sources) {
  Fnv1a hash;
  const auto add = [&hash](const auto* values, std::size_t count) {
    hash.add({reinterpret_cast<const char*>(values), count * sizeof(*values)});
  };
  for (const ViewScribbles& painted : sources.strokes.views) {
    hash.add(view_text(painted.view));
    add(painted.labels.data(), painted.labels.size());
  }
  for (const LabelInfo& label : sources.strokes.labels) {
    hash.add(fmt::format("{} {} {}", label.id, label.name, fmt::join(label.color, " ")));
  }
  if (sources.disparity) {
    add(sources.disparity->disparity.data(), sources.disparity->disparity.size());
    add(sources.disparity->valid.data(), sources.disparity->valid.size());
  }
  if (sources.probabilities) {
    for (const Volume<std::uint8_t>& view : sources.probabilities->views) {
      add(view.view().data, view.view().size());
    }
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

}  // namespace episcope
