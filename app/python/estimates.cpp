// SPDX-License-Identifier: BSD-3-Clause
#include "app/python/estimates.h"

#include "app/python/job.h"
#include "app/session/command_line.h"
#include "app/session/judge.h"
#include "app/session/load_scene.h"
#include "app/session/replace_file.h"
#include "app/session/result_files.h"
#include "app/session/result_fit.h"
#include "app/session/run_estimator.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/disparity/registry.h"
#include "engine/io/base/files.h"
#include "engine/io/base/json.h"
#include "engine/io/models/external_result.h"
#include "engine/io/models/map_reading.h"
#include "engine/io/models/result_file.h"

#include <pybind11/stl.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

namespace episcope::python {

RunOptions run_options(const std::string& device, int threads) {
  return run_schema().parse({{"device", device}, {"threads", threads}});
}

namespace {

std::optional<ViewSelection> selection_from(const py::object& views) {
  if (views.is_none()) return std::nullopt;
  return value_named<ViewSelection>(py::cast<std::string>(py::str(views)));
}

FoundEstimate estimate_scene(const py::object& light_field, const std::string& method,
                             const py::object& views, const std::string& device, int threads,
                             const py::object& progress, const py::kwargs& parameters) {
  const OpenedScene& opened = scene_from(light_field);
  const Estimator& estimator = find_estimator(method);
  const ParameterSet values = parameters_from(parameters, estimator.parameters);
  RunOptions options = run_options(device, threads);
  options.views = views_to_estimate(estimator, selection_from(views));
  require_device(options.device, estimator.info);
  FinishedEstimate finished = result_of_job(progress, threads, [&](const Progress& job) {
    return run_estimator(*opened.scene, estimator, values, options, job);
  });
  return {std::move(finished.estimate), opened};
}

py::object disparity_of(FoundEstimate& found) {
  if (!found.disparity) found.disparity = disparity_array(found.estimate->field, found.estimate);
  return found.disparity;
}

py::object confidence_of(const FoundEstimate& found) {
  const EstimatePtr& estimate = found.estimate;
  if (estimate->confidence.empty()) return py::none();
  return array_of(estimate->confidence, estimate, Channels::No);
}

py::object single_view_of(const FoundEstimate& found) {
  const ViewStack<float>& maps = found.estimate->field.disparity;
  return maps.grid().count() == 1 ? py::object(view_tuple(maps.first())) : py::object(py::none());
}

/// Refuses to replace what is no result, such as the light field itself.
void require_replaceable(const std::filesystem::path& path, MapForm form) {
  if (!io::is_there(path) || form == MapForm::PointCloud) return;
  if (names_result(path.string())) return;
  throw IoError(path, "exists and is not a result; choose another name or remove it first");
}

void save_estimate(const FoundEstimate& found, const py::object& given_path, const py::object& view,
                   bool is_overwriting) {
  const std::filesystem::path path = path_from(given_path);
  const auto form = map_form_of(path);
  if (!form) {
    throw InvalidInput(path.string() +
                       ": the name tells no form of a result; let it end in .h5, .npy, .npz, "
                       ".mat, .pfm, .tif, .csv or .ply");
  }
  require_replaceable(path, *form);
  const Overwrite overwrite = is_overwriting ? Overwrite::Yes : Overwrite::No;
  const LightField& lf = found.of.light_field();
  const Estimate& estimate = *found.estimate;
  const ViewIndex first = estimate.field.disparity.first();
  const ViewIndex own = estimate.contains(lf.center()) ? lf.center() : first;
  const ViewIndex at = view_from(view, lf.grid()).value_or(own);
  if (*form != MapForm::Result && !estimate.contains(at)) {
    throw InvalidInput("view " + view_text(at) + " was not estimated, only " + view_text(first));
  }
  run_job(py::none(), 0, [&](const Progress& job) {
    if (*form == MapForm::Result) {
      check_made_output(path,
                        {.method = estimate.method,
                         .parameters = estimate.parameters,
                         .input = found.of.input,
                         .reading = estimate.reading.options,
                         .is_of_one_view = estimate.field.disparity.grid().count() == 1},
                        overwrite, kByArgument);
      return save_result(path, estimate, found.of.input, job);
    }
    const auto write = [&](const std::filesystem::path& file) {
      if (*form != MapForm::PointCloud) return save_map(file, estimate, at);
      save_point_cloud(file, lf, at, estimate.field.view(at));
    };
    write_output(path, overwrite, write, kByArgument);
  });
}

/// A result with its maps read otherwise.
EstimatePtr changed_estimate(const Estimate& found, const LightField& lf,
                             const io::MapReading& reading) {
  auto changed = std::make_shared<Estimate>();
  changed->set_provenance(found.provenance());
  changed->field = found.field.clone();
  changed->layered.foreground = found.layered.foreground.clone();
  io::apply_reading(reading, &lf, *changed);  // refuses one in two layers
  return changed;
}

/// Of the file of a result, or of an array of maps, read so.
std::shared_ptr<Estimate> foreign_estimate(const py::object& map, const LightField& lf,
                                           const io::MapReading& reading) {
  if (names_path(map)) {
    return std::make_shared<Estimate>(read_result_of(lf, path_from(map), reading));
  }
  DisparityField field;
  field.disparity = maps_from(numbers_from<float>(map, "the maps"), lf.grid(), "the maps");
  if (!reading.is_transposed && are_on_their_side(field.disparity, lf)) {
    throw InvalidInput(
        "rows and columns of the maps are exchanged for those of the views; transpose them, or "
        "give map_transpose=True");
  }
  return std::make_shared<Estimate>(result_from_maps(lf, std::move(field), "array", reading));
}

/// What is judged, and in which view.
std::pair<EstimatePtr, ViewIndex> judged_estimate(const py::object& map, const Scene& scene,
                                                  std::optional<ViewIndex> wanted,
                                                  const io::MapReading& reading) {
  const LightField& lf = *scene.light_field;
  if (py::isinstance<FoundEstimate>(map)) {
    EstimatePtr found = py::cast<const FoundEstimate&>(map).estimate;
    if (!(reading == io::MapReading{})) found = changed_estimate(*found, lf, reading);
    return {found, view_to_judge(*found, scene, wanted)};
  }
  const std::shared_ptr<Estimate> read = foreign_estimate(map, lf, reading);
  const ViewIndex view = view_to_judge(*read, scene, wanted);
  place_foreign_map(view, *read);
  return {read, view};
}

/// Keys of 'episcope-cli evaluate --json'.
py::dict score_scene(const py::object& map, const OpenedScene& opened, EvaluationOptions options,
                     const py::object& view, const io::MapReading& reading) {
  const Scene& scene = *opened.scene;
  const auto subject =
      judged_estimate(map, scene, view_from(view, scene.light_field->grid()), reading);
  const Estimate& estimate = *subject.first;
  const ViewIndex at = subject.second;
  const JudgedResult judged = result_of_job(py::none(), 0, [&](const Progress& job) {
    options.progress = job;
    return judge_result(estimate, scene, options, at);
  });
  py::dict scores = object_from(
      judged_json(estimate, scene, judged, options.protocol, judged.evaluation->metrics));
  if (scores.contains("notes")) {
    scores["notes"] = in_python(py::cast<std::vector<std::string>>(scores["notes"]));
  }
  scores["protocol"] = protocol_name(options.protocol);
  scores["truth"] = opened.input;
  scores["view"] = view_tuple(at);
  return scores;
}

/// The views that maps cover; 1×1 also for what are no maps.
GridShape grid_of_maps(const py::object& maps) {
  const auto shape = py::module_::import("numpy").attr("shape")(maps);
  const auto lengths = py::cast<std::vector<int>>(shape);
  const bool has_channel = lengths.size() == 5 && lengths.back() == 1;
  return lengths.size() == 4 || has_channel ? GridShape{lengths[0], lengths[1]} : GridShape{1, 1};
}

/// The view that is wanted, else the only one of a result, else the center.
ViewIndex view_to_score(const py::object& judged, const py::object& view, GridShape grid) {
  if (!view.is_none()) return *view_from(view, grid);
  const bool is_result = py::isinstance<FoundEstimate>(judged);
  const py::object own =
      is_result ? single_view_of(py::cast<const FoundEstimate&>(judged)) : py::object(py::none());
  return own.is_none() || grid.count() == 1 ? grid.center() : *view_from(own, grid);
}

/// Of an array, with nothing known of the light field: pixel by pixel.
OpenedScene scene_of_truth(const py::object& array, GridShape grid, ViewIndex judged) {
  const std::string what = "the truth";
  auto truth = std::make_shared<GroundTruth>();
  DisparityField& field = truth->field;
  field.disparity = maps_from(numbers_from<float>(array, what), grid, what);
  if (field.disparity.grid().count() == 1) {
    field.disparity.keep_in_place(field.disparity.first(), {1, 1}, judged);
  }
  io::mark_invalid(field);
  ViewStack<std::uint8_t> samples(grid, field.disparity.height(), field.disparity.width());
  std::fill_n(samples.data(), samples.size(), std::uint8_t{0});
  auto scene = std::make_shared<Scene>();
  LightFieldInfo info;
  info.name = what;
  scene->light_field = std::make_shared<const LightField>(std::move(samples), std::move(info));
  scene->truth = std::move(truth);
  return {std::move(scene)};
}

py::dict score_array(const py::object& judged, const py::object& truth,
                     const EvaluationOptions& options, const py::object& view,
                     const io::MapReading& reading) {
  const py::object map = py::isinstance<FoundEstimate>(judged) ? judged.attr("disparity") : judged;
  if (names_path(map)) (void)numbers_from<float>(map, "the maps");  // says that it is no array
  const GridShape of_truth = grid_of_maps(truth);
  const GridShape grid = of_truth.count() > 1 ? of_truth : grid_of_maps(map);
  const ViewIndex at = view_to_score(judged, view, grid);
  return score_scene(map, scene_of_truth(truth, grid, at), options, view_tuple(at), reading);
}

/// Throws InvalidInput that says what there is.
template <NamedEnum E>
E choice_named(const std::string& argument, const std::string& name) {
  const std::vector<std::string> names = all_names<E>();
  if (std::ranges::count(names, name) > 0) return value_named<E>(name);
  throw InvalidInput(argument + " is '" + name + "'; use " + joined(names, " or "));
}

/// The light field of a path, read as a result says that its own was, as by `evaluate --truth`.
OpenedScene scene_at(const std::string& input, const py::object& map) {
  Reading reading;
  std::string result = "the result";
  if (py::isinstance<FoundEstimate>(map)) {
    reading = py::cast<const FoundEstimate&>(map).estimate->reading;
  } else if (names_path(map)) {
    result = path_from(map);
    reading = io::read_reading(result);
  }
  const io::OpenOptions options = options_for_result(result, reading, input, {});
  return {std::make_shared<const Scene>(result_of_job(
              py::none(), 0,
              [&](const Progress& job) { return open_input(input, options, true, job); })),
          input};
}

py::dict score(const py::object& map, const py::object& truth, const std::string& protocol,
               const std::string& invalid, const py::object& view, const py::kwargs& given) {
  const EvaluationOptions options{choice_named<Protocol>("protocol", protocol),
                                  choice_named<InvalidEstimates>("invalid", invalid),
                                  {}};
  const auto schema = io::map_schema();
  const io::MapReading reading = schema.parse(parameters_from(given, schema.descriptions()));
  if (py::isinstance<OpenedScene>(truth)) {
    return score_scene(map, py::cast<const OpenedScene&>(truth), options, view, reading);
  }
  if (names_path(truth)) {
    return score_scene(map, scene_at(path_from(truth), map), options, view, reading);
  }
  return score_array(map, truth, options, view, reading);
}

using ResultClass = py::class_<FoundEstimate>;

void add_maps(ResultClass& result) {
  result
      .def_property_readonly(
          "disparity", disparity_of,
          R"(float32, px per view step, positive nearer than the plane of zero disparity; NaN
where it is not known. [v, u, y, x], or [y, x] if one view was estimated. Read-only.)")
      .def_property_readonly(
          "confidence", confidence_of,
          R"(float32 in [0, 1], of the shape of the disparity; None if there is none.)")
      .def_property_readonly(
          "foreground",
          [](const FoundEstimate& found) {
            return disparity_array(found.estimate->layered.foreground, found.estimate);
          },
          "Disparity of the surface, of methods for two layers; else None.")
      .def_property_readonly(
          "background",
          [](const FoundEstimate& found) {
            return disparity_array(found.estimate->layered.background, found.estimate);
          },
          "Disparity of what is seen through it; else None.")
      .def_property_readonly(
          "second",
          [](const FoundEstimate& found) {
            return disparity_array(found.estimate->second, found.estimate);
          },
          "Another disparity that a pixel may have, of net for one view; NaN where there is none.");
}

void add_record(ResultClass& result) {
  result
      .def_property_readonly("view", single_view_of, "(v, u) if one view was estimated; else None.")
      .def_property_readonly("method",
                             [](const FoundEstimate& found) { return found.estimate->method; })
      .def_property_readonly(
          "range", [](const FoundEstimate& found) { return interval_tuple(found.estimate->range); },
          "(min, max) of the disparity that was searched, px per view step.")
      .def_property_readonly(
          "parameters",
          [](const FoundEstimate& found) {
            return object_from(io::parameters_json(found.estimate->parameters));
          },
          "Every parameter with the value used.")
      .def_property_readonly(
          "seconds", [](const FoundEstimate& found) { return found.estimate->seconds; },
          "Wall-clock time.")
      .def_property_readonly(
          "notes", [](const FoundEstimate& found) { return in_python(found.estimate->notes); },
          "What one should know of this run, a sentence each.");
}

void add_result(py::module_& module) {
  ResultClass result(module, "Result", "A disparity estimate of a light field.");
  add_maps(result);
  add_record(result);
  result
      .def("save", save_estimate, py::arg("path"), py::kw_only(), py::arg("view") = py::none(),
           py::arg("overwrite") = false,
           R"(save(path, *, view=None, overwrite=False)
--

Writes the result as its name says: .h5 (all that is known), or one view as .npy, .npz, .mat, .pfm,
.tif, .csv or .ply (points). view: (v, u), by default the center. A file that is there is replaced
if it is a result of the same method, parameters and light field; another result, or another map,
only with overwrite=True; what is no result, never.)")
      .def("__repr__", [](const FoundEstimate& found) {
        return "<episcope.Result of " + found.estimate->method + " for " +
               found.of.light_field().info().name + ">";
      });
}

void add_estimate(py::module_& module) {
  module.def("estimate", estimate_scene, py::arg("light_field"), py::arg("method"), py::kw_only(),
             py::arg("views") = py::none(), py::arg("device") = "auto", py::arg("threads") = 0,
             py::arg("progress") = py::none(),
             R"(estimate(light_field, method, *, views=None, device='auto', threads=0,
         progress=None, **parameters)
--

Estimates disparity: the numbers of 'episcope-cli estimate', bit for bit.

method: an id of methods(). views: 'all' or 'center'; by default all, if the method can. device:
'auto', 'cpu' or 'cuda'. threads: at most so many; 0 = as many as there are. progress: called as
progress(fraction, step); what it raises ends the estimate, as Ctrl+C does. parameters: those of the
method, such as range=(-2, 2); lambda_ for lambda.
Raises InvalidInput for a bad parameter, Unavailable for an unknown method or a missing device.)");
}

void add_score(py::module_& module) {
  module.def("score", score, py::arg("map"), py::arg("truth"), py::kw_only(),
             py::arg("protocol") = "vmv2013", py::arg("invalid") = "bad",
             py::arg("view") = py::none(),
             R"(score(map, truth, *, protocol='vmv2013', invalid='bad', view=None, **reading)
--

Compares disparity with the truth; a dict with the keys of 'episcope-cli evaluate --json', such as
mse_100 and density.

map: a Result, the path of a result, or an array in px per view step, [y, x] of the judged view or
[v, u, y, x] of all, NaN or masked where there is no value. truth: a LightField, the path of one, or an array,
[y, x] or [v, u, y, x]. protocol: 'vmv2013' or 'benchmark2016'. invalid: how missing values count, 'bad' or
'compatible'. view: (v, u), by default that of a Result of one view, else the center. reading: how maps are to be read, as the options
--map-… of 'episcope-cli evaluate': map_transpose, map_flip, map_scale, map_values, map_border,
map_down, map_right, map_resize, map_crop, map_missing.
Raises InvalidInput where sizes differ or there is no truth.)");
}

}  // namespace

void add_estimates(py::module_& module) {
  add_result(module);
  add_estimate(module);
  add_score(module);
  module.def(
      "methods",
      [] {
        nlohmann::ordered_json list = nlohmann::ordered_json::array();
        for (const Estimator& method : registered_estimators()) list.push_back(method_json(method));
        return object_from(list);
      },
      R"(methods()
--

Every method with its parameters, a list of dicts: id, name, summary, reference, all_views,
parameters (key, help, unit, default, min, max, choices).)");
}

}  // namespace episcope::python
