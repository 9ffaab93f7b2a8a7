// SPDX-License-Identifier: BSD-3-Clause
#include "app/python/labels.h"

#include "app/python/estimates.h"
#include "app/python/job.h"
#include "app/python/light_fields.h"
#include "app/session/label_review.h"
#include "app/session/labeling_inputs.h"
#include "app/session/replace_file.h"
#include "app/session/result_files.h"
#include "app/session/result_fit.h"
#include "app/session/segmentation.h"
#include "engine/core/error.h"
#include "engine/io/models/scribble_file.h"
#include "engine/labeling/labeler.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

namespace episcope::python {
namespace {

struct ScoredLabels {
  Segmentation segmentation;
  LabelingScores scores;
  std::vector<std::string> notes{};
};

/// Labels of all views as Python sees them.
struct FoundLabels : ScoredLabels {
  OpenedScene of;
};

void add_view(const ImageView<const std::int32_t>& labels, ViewIndex view, Scribbles& scribbles) {
  scribbles.views.push_back({view, Image<std::int32_t>(labels.height, labels.width)});
  std::copy_n(labels.data, labels.size(), scribbles.views.back().labels.data());
}

/// 255 where other labels are all smaller, as in pictures of labels (LabelReading::ignored).
std::vector<std::int32_t> usually_ignored(const Scribbles& scribbles) {
  constexpr std::int32_t kVoid = 255;
  std::set<std::int32_t> ids;
  for (const ViewScribbles& one : scribbles.views) {
    ids.insert(one.labels.begin(), one.labels.end());
  }
  const bool is_void = !ids.empty() && *ids.rbegin() == kVoid && *ids.upper_bound(0) < kVoid;
  return is_void ? std::vector{kVoid} : std::vector<std::int32_t>{};
}

/// Takes negative and ignored ids for unpainted, and leaves out views where nothing is painted.
void leave_painted(const std::vector<std::int32_t>& ignored, Scribbles& scribbles) {
  std::erase_if(scribbles.views, [&](ViewScribbles& one) {
    bool is_painted = false;
    for (std::int32_t& id : one.labels) {
      if (id < 0 || std::ranges::find(ignored, id) != ignored.end()) id = 0;
      is_painted = is_painted || id != 0;
    }
    return !is_painted;
  });
}

/// A map for each view that was painted.
Scribbles scribbles_of_views(const py::dict& painted, GridShape grid) {
  const std::string what = "the scribbles";
  Scribbles scribbles;
  for (const auto& [key, map] : painted) {
    const auto view = view_from(py::reinterpret_borrow<py::object>(key), grid);
    if (!view) throw InvalidInput("scribbles are named by their views, (v, u), not by None");
    const auto labels = maps_from(
        numbers_from<std::int32_t>(py::reinterpret_borrow<py::object>(map), what), {1, 1}, what);
    add_view(labels.view(labels.first()), *view, scribbles);
  }
  std::ranges::sort(scribbles.views, {},
                    [](const ViewScribbles& one) { return std::pair(one.view.v, one.view.u); });
  return scribbles;
}

Scribbles scribbles_from(const py::object& painted, const Scene& scene) {
  if (painted.is_none()) {
    if (!scene.scribbles.empty()) return scene.scribbles;
    throw InvalidInput(scene.light_field->info().name +
                       " has no scribbles next to it; give an array of them");
  }
  const GridShape grid = scene.light_field->grid();
  if (py::isinstance<py::dict>(painted)) return scribbles_of_views(painted, grid);
  const auto labels =
      maps_from(numbers_from<std::int32_t>(painted, "the scribbles"), grid, "the scribbles");
  Scribbles scribbles;
  for (int i = 0; i < labels.grid().count(); ++i) {
    add_view(labels.view(labels.view_at(i)), labels.view_at(i), scribbles);
  }
  return scribbles;
}

LabelingDisparity disparity_for(const Scene& scene, const LabelerParameters& parameters,
                                const EstimatePtr& given, Device device, const Progress& progress) {
  if (!given) return find_labeling_disparity(scene, parameters, {}, progress, device);
  if (parameters.features == FeatureSet::ImageTruth) {
    throw InvalidInput(
        "features image+truth uses the ground truth, so disparity would have no effect");
  }
  check_fits(*given, *scene.light_field, "the disparity");
  return episcope::disparity_of(given, given->method);
}

/// Touches nothing of Python, since it runs without the lock of the interpreter.
ScoredLabels label_scene(const Scene& scene, const Scribbles& scribbles,
                         const LabelerParameters& parameters, const EstimatePtr& given,
                         Device device, const Progress& progress) {
  const LabelingDisparity disparity =
      disparity_for(scene, parameters, given, device, progress.part(0, 0.2));
  Labeler labeler = labeler_of(scene, disparity, progress, device);
  ScoredLabels found;
  found.segmentation.labeling = std::make_shared<const Labeling>(labeler.label(
      scribbles, parameters, {{0, 0}, scene.light_field->grid()}, progress.part(0.2, 0.95)));
  found.segmentation.labels = scribbles.labels;
  found.segmentation.parameters = labeler_schema().values(parameters);
  found.segmentation.reading = scene.light_field->info().reading;
  found.segmentation.sources_hash =
      hash_of(LabelSources{scribbles, given ? disparity.field.get() : nullptr});
  found.scores =
      judge_labeling(*found.segmentation.labeling, scene, disparity, progress.part(0.95, 1));
  found.notes = stroke_notes(scribbles, scene.truth->labels);
  if (given) {
    std::ranges::move(fit_of(*given, scene).sentences(), std::back_inserter(found.notes));
  }
  found.notes.push_back(other_numbers_text(found.scores));
  found.notes.push_back(found.segmentation.labeling->note);
  return found;
}

EstimatePtr estimate_from(const py::object& disparity) {
  if (disparity.is_none()) return nullptr;
  if (py::isinstance<FoundEstimate>(disparity)) {
    return py::cast<const FoundEstimate&>(disparity).estimate;
  }
  throw py::type_error("disparity must be a Result of episcope.estimate, not " +
                       py::cast<std::string>(py::type::of(disparity).attr("__name__")));
}

FoundLabels label(const py::object& light_field, const py::object& painted,
                  const std::optional<std::vector<std::int32_t>>& ignore,
                  const py::object& disparity, const std::string& device, int threads,
                  const py::object& progress, const py::kwargs& given) {
  const OpenedScene& opened = scene_from(light_field);
  const auto schema = labeler_schema();
  const LabelerParameters parameters = schema.parse(parameters_from(given, schema.descriptions()));
  Scribbles scribbles = scribbles_from(painted, *opened.scene);
  const bool is_given = !painted.is_none();  // else 255 is a label, as where the files state it
  const auto unasked = is_given ? usually_ignored(scribbles) : std::vector<std::int32_t>{};
  const auto& ignored = ignore ? *ignore : unasked;
  leave_painted(ignored, scribbles);
  const EstimatePtr estimate = estimate_from(disparity);
  const Device on = run_options(device, threads).device;
  ScoredLabels labels = result_of_job(progress, threads, [&](const Progress& job) {
    return label_scene(*opened.scene, scribbles, parameters, estimate, on, job);
  });
  const bool is_told = ignore || ignored.empty();
  if (!is_told) labels.notes.insert(labels.notes.begin(), "255 is taken for unlabeled");
  std::erase(labels.notes, std::string());
  return {std::move(labels), opened};
}

void save_labels(const FoundLabels& found, const py::object& given_path, bool probabilities,
                 bool is_overwriting) {
  const std::filesystem::path path = path_from(given_path);
  if (map_form_of(path) != MapForm::Result) {
    throw InvalidInput(path.string() + ": labels are saved as HDF5; let the name end in .h5");
  }
  const Segmentation& made = found.segmentation;
  check_made_output(path,
                    {{}, made.parameters, found.of.input, made.reading.options, made.sources_hash},
                    is_overwriting ? Overwrite::Yes : Overwrite::No, kByArgument);
  const auto stored = probabilities ? StoredProbabilities::All : StoredProbabilities::None;
  run_job(py::none(), 0, [&](const Progress& job) {
    write_segmentation(path, made, found.of.input, stored, job);
  });
}

py::dict label_scores(const FoundLabels& found) {
  py::dict scores;
  for (const auto& [key, share] : labeling_metrics(found.scores)) scores[py::str(key)] = share;
  return scores;
}

}  // namespace

void add_labels(py::module_& module) {
  py::class_<FoundLabels>(module, "Labeling", "Labels of all views of a light field.")
      .def_property_readonly(
          "labels",
          [](const FoundLabels& found) {
            const LabelingPtr& labeling = found.segmentation.labeling;
            return array_of(labeling->labels, labeling, Channels::No);
          },
          "int32 [v, u, y, x]: the label of each pixel, one of ids. Read-only.")
      .def_property_readonly(
          "ids",
          [](const FoundLabels& found) { return found.segmentation.labeling->probabilities.ids; },
          "The labels that were painted, ascending.")
      .def_property_readonly("scores", label_scores,
                             R"(Shares in [0, 1] by the keys of 'episcope-cli label --json', such as
accuracy_all_views; without true labels only consistency along the rays.)")
      .def_property_readonly(
          "notes", [](const FoundLabels& found) { return in_python(found.notes); },
          "A sentence each.")
      .def("save", save_labels, py::arg("path"), py::kw_only(), py::arg("probabilities") = false,
           py::arg("overwrite") = false,
           R"(save(path, *, probabilities=False, overwrite=False)
--

Writes an HDF5 file of labels; with probabilities, four bytes more for each ray and label. Labels of
that name are replaced if they were made with the same parameters and strokes from the same light
field, others only with overwrite=True; what is no file of labels, never.)");
  module.def("label", label, py::arg("light_field"), py::arg("scribbles") = py::none(),
             py::kw_only(), py::arg("ignore") = py::none(), py::arg("disparity") = py::none(),
             py::arg("device") = "auto", py::arg("threads") = 0, py::arg("progress") = py::none(),
             R"(label(light_field, scribbles=None, *, ignore=None, disparity=None, device='auto',
      threads=0, progress=None, **parameters)
--

Labels every pixel of all views from a few painted ones.

scribbles: whole numbers, 0, negative or NaN = unpainted, [y, x] of the center view, [v, u, y, x] of all, or a dict
of [y, x] by (v, u); None: those that lie beside the light field. At least two labels must be
painted.
ignore: other numbers that mean unpainted, such as (255,); None: 255 where other labels are smaller.
disparity: a Result of all views; by default it is estimated. parameters: those of 'episcope-cli
label --help', such as features='image'. progress: called as progress(fraction, step).
Raises InvalidInput for scribbles that do not fit.)");
}

}  // namespace episcope::python
