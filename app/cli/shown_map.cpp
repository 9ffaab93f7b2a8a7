// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/shown_map.h"

#include "app/cli/arguments.h"
#include "app/session/labeling_inputs.h"
#include "app/session/project_file.h"
#include "app/session/result_files.h"
#include "app/session/scene_summary.h"
#include "app/session/segmentation.h"
#include "engine/core/error.h"
#include "engine/io/models/result_file.h"
#include "engine/io/models/scribble_file.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

namespace episcope::cli {
namespace {

using render::Quantity;
using render::Subject;

Subject subject_of(const ShownMap& shown) {
  return render::info_of(shown.quantity).subject;
}

UsageError refused(const ShownMap& shown, const std::string& needed, const std::string& is) {
  return UsageError("--what " + std::string(render::info_of(shown.quantity).id) + " needs " +
                    needed + ", but " + shown.subject + " is " + is);
}

void check_kind(const ShownMap& shown) {
  const Subject subject = subject_of(shown);
  const bool is_of_labels = subject == Subject::Segmentation && shown.quantity != Quantity::Edges;
  if (shown.kind == ShownKind::Labels) {
    if (!is_of_labels) throw refused(shown, "a light field or a RESULT", "a file of labels");
    return;
  }
  if (is_of_labels && shown.quantity != Quantity::Probability) {
    throw refused(shown, "a file of labels that 'label' wrote", "none");
  }
  const bool is_of_result =
      subject == Subject::Result || subject == Subject::Error || subject == Subject::ResultPair;
  if (is_of_result && shown.kind == ShownKind::LightField) {
    throw refused(shown, "a RESULT", "a light field");
  }
  if (subject == Subject::ResultPair && shown.minus.empty()) {
    throw UsageError("--what difference needs a second result; name it with --minus RESULT");
  }
}

/// Whether two results are of light fields with different focus planes.
bool differs_in_focus(const ShownMap& shown) {
  const Reading first = io::read_reading(shown.subject);
  const Reading second = io::read_reading(shown.minus);
  return !first.reader.empty() && !second.reader.empty() && first.focus_px() != second.focus_px();
}

/// Whether colors or numbers come from the scene as well.
bool needs_scene(const ShownMap& shown) {
  const bool is_alone = shown.quantity == Quantity::Confidence ||
                        shown.quantity == Quantity::Layers ||
                        (shown.quantity == Quantity::Difference && !differs_in_focus(shown));
  return shown.needs_light_field || !is_alone;
}

/// Whether there is a picture without a scene, in a range of its own.
bool can_do_without_scene(const ShownMap& shown) {
  return subject_of(shown) == Subject::Result && !shown.needs_light_field;
}

std::string named_source(const ShownMap& shown, const std::string& of_file) {
  return shown.truth.empty() ? of_file : shown.truth;
}

/// A file that names no light field needs the option; one whose light field is gone is at fault.
[[noreturn]] void fail_without_source(const ShownMap& shown, const std::string& named) {
  constexpr const char* kRemedy = "; name it with --truth INPUT";
  if (named.empty()) {
    throw UsageError(shown.subject + ": the light field it was made from is not named in it" +
                     kRemedy);
  }
  throw IoError(shown.subject,
                "the light field it was made from, " + named + ", is not there" + kRemedy);
}

void take_scene(const ShownMap& shown, Scene scene, LoadedMap& loaded) {
  loaded.source.light_field = scene.light_field;
  loaded.source.truth = scene.truth;
  loaded.source.true_labels = true_labels_of(scene.truth);
  loaded.source.label_infos = scene.scribbles.labels;
  if (shown.quantity == Quantity::Probability && shown.kind != ShownKind::Labels) {
    loaded.source.labeling = read_archive_probabilities(scene, loaded.source.view);
  }
  loaded.scene = std::move(scene);
}

/// The light field of a project that was in front when it was saved, read as it was then, unless
/// options say otherwise.
Scene load_current(const std::string& file, const ReadOptions& read, const Progress& progress) {
  const Project project = read_project(file);
  if (project.scenes.empty()) throw IoError(file, "this project has no light field");
  const ProjectScene& current =
      project.scenes[std::min(project.current, project.scenes.size() - 1)];
  ParameterSet options = current.reading;
  std::erase_if(options, [&](const auto& option) { return read.options.is_given(option.first); });
  std::ranges::move(read.options.values(), std::back_inserter(options));
  return load_input(current.input, io::open_schema().parse(options), read.needs_truth, progress);
}

void load_light_field(const ShownMap& shown, const ReadOptions& read, LoadedMap& loaded, Job& job) {
  const Progress progress = job.progress().part(0, 0.9);
  Scene scene = names_project(shown.subject) ? load_current(shown.subject, read, progress)
                                             : load_input(shown.subject, read, progress);
  const LightField& light_field = *scene.light_field;
  loaded.source.view = view_of(light_field, shown.view.value_or(light_field.center()));
  take_scene(shown, std::move(scene), loaded);
}

/// The result that is subtracted, at the focus plane of the first.
void load_other(const ShownMap& shown, const Estimate& first, LoadedMap& loaded, Job& job) {
  Estimate other = read_result_alone(shown.minus);
  note_other_options({shown.subject, first.reading}, {shown.minus, other.reading}, job);
  if (loaded.source.light_field) {
    bring_to_focus(other, *loaded.source.light_field, job.progress());
  }
  loaded.source.other = std::make_shared<const Estimate>(std::move(other));
}

void load_result(const ShownMap& shown, const ReadOptions& read, LoadedMap& loaded, Job& job) {
  const NamedReading reading = reading_of(shown.subject);
  std::optional<Scene> scene;
  if (!shown.truth.empty()) {
    scene = load_input_of(reading, shown.truth, read, job.progress().part(0, 0.9));
  }
  auto estimate = std::make_shared<const Estimate>(
      scene ? read_result_of(*scene->light_field, shown.subject, shown.reading)
            : read_result_alone(shown.subject, shown.reading));
  if (!scene && needs_scene(shown)) {
    const std::string source = existing_source(estimate->source, shown.subject);
    if (!source.empty()) {
      scene = load_input_of(reading, source, read, job.progress().part(0, 0.9));
    } else if (!can_do_without_scene(shown)) {
      fail_without_source(shown, estimate->source);
    }
  }
  loaded.source.view = shown.view.value_or(subject_of(shown) == Subject::Error && scene
                                               ? judged_view(*scene)
                                               : middle_of(estimate->field.disparity));
  if (scene) {
    note_other_source(*estimate, *scene->light_field, job);
    const std::string doubt = doubt_text(find_better_reading(*estimate, *scene), *estimate, *scene);
    if (!doubt.empty()) job.note(shown.subject + ": " + doubt);
    take_scene(shown, std::move(*scene), loaded);
  }
  if (shown.quantity == Quantity::Difference) load_other(shown, *estimate, loaded, job);
  loaded.disparity_range = display_range(*estimate);
  loaded.source.estimate = std::move(estimate);
}

void load_labels(const ShownMap& shown, const ReadOptions& read, LoadedMap& loaded, Job& job) {
  const Segmentation segmentation = read_segmentation(shown.subject, shown.view);
  loaded.source.view = segmentation.labeling->labels.first();
  loaded.source.labeling = segmentation.labeling;
  loaded.source.label_infos = segmentation.labels;
  const bool needs_probabilities =
      shown.quantity == Quantity::Probability || shown.quantity == Quantity::Uncertainty;
  if (needs_probabilities && segmentation.labeling->probabilities.empty()) {
    throw InvalidInput(shown.subject +
                       " has no probabilities; label again with --write-probabilities");
  }
  if (shown.quantity != Quantity::WrongLabels && !shown.needs_light_field) return;
  const std::string named = io::SegmentationFile(shown.subject).source();
  const std::string input = named_source(shown, existing_source(named, shown.subject));
  if (input.empty()) fail_without_source(shown, named);
  take_scene(shown,
             load_input_of({shown.subject, segmentation.reading}, input, read,
                           job.progress().part(0, 0.9)),
             loaded);
}

/// Edges are those of the file beside the light field, else of image and result.
void add_edges(LoadedMap& loaded, const Progress& progress) {
  loaded.source.edges = find_edge_probabilities(*loaded.scene, progress);
  if (const EstimatePtr& estimate = loaded.source.estimate) {
    loaded.source.edge_disparity = {estimate, &estimate->field};
  }
}

}  // namespace

LoadedMap load_map(const ShownMap& shown, const ReadOptions& read, Job& job) {
  check_kind(shown);
  LoadedMap loaded;
  loaded.source.quantity = shown.quantity;
  loaded.source.label = shown.label;
  loaded.source.bad_threshold_px = shown.bad_threshold_px;
  if (shown.kind == ShownKind::LightField) load_light_field(shown, read, loaded, job);
  if (shown.kind == ShownKind::Result) load_result(shown, read, loaded, job);
  if (shown.kind == ShownKind::Labels) load_labels(shown, read, loaded, job);
  if (shown.quantity == Quantity::Edges) add_edges(loaded, job.progress());
  const std::string reason = reason_against(loaded.source);
  if (!reason.empty()) throw InvalidInput(reason);
  if (subject_of(shown) == Subject::Error) {
    loaded.source.evaluation = std::make_shared<const Evaluation>(
        judge(*loaded.source.estimate, *loaded.scene, {}, loaded.source.view));
  }
  const Interval known = loaded.scene ? known_disparity_range(*loaded.scene) : Interval{};
  loaded.disparity_range = shown_range(known, loaded.disparity_range);
  return loaded;
}

}  // namespace episcope::cli
