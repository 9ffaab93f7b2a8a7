// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"
#include "app/cli/input.h"
#include "app/cli/job.h"
#include "app/cli/label_files.h"
#include "app/cli/output.h"
#include "app/cli/streams.h"
#include "app/cli/verbs/verbs.h"
#include "app/session/command_line.h"
#include "app/session/load_scene.h"
#include "app/session/result_files.h"
#include "app/session/result_fit.h"
#include "app/session/segmentation.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/base/hdf5_file.h"
#include "engine/io/base/hdf5_repack.h"
#include "engine/io/formats/quilt.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/models/labels/label_export.h"
#include "engine/io/models/labels/label_import.h"
#include "engine/io/models/scribble_file.h"
#include "engine/io/write.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>
#include <iterator>

namespace episcope::cli {
namespace {

struct ConvertRequest {
  std::string input;
  std::string output;
  std::string truth;
  std::string form;  ///< Id of a writer, or kMap; empty = told by the output.
  std::optional<ViewSelection> views;
  Overwrite overwrite = Overwrite::No;
  bool is_repacked = false;  ///< The HDF5 file is copied as it is, without chunks.
  bool is_json = false;
  bool is_piped = false;  ///< To standard output.
  io::MapValues values = io::MapValues::Disparity;
  bool has_disparity = false;  ///< Whether an archive gets disparity beside depth.
  ParameterOptions map;
  LabelFileOptions labels{.prefers_truth = true};  ///< To take the place of the true labels.
  JobOptions job;
  ReadOptions read;
};

/// Maps alone, where forms hold light fields as well.
constexpr const char* kMap = "map";

std::vector<std::string> form_names() {
  std::vector<std::string> ids{kMap};
  for (const io::Writer& writer : io::writers()) ids.emplace_back(writer.id);
  std::ranges::copy(all_names<io::LabelForm>(), std::back_inserter(ids));
  return ids;
}

/// The form of a folder of labels that is asked for; nothing for light fields and maps.
std::optional<io::LabelForm> label_form_of(const ConvertRequest& request) {
  for (const auto& form : io::names_of(io::LabelForm{})) {
    if (request.form == form.name) return form.value;
  }
  return std::nullopt;
}

bool parse(const VerbArguments& arguments, ConvertRequest& request) {
  Arguments parser(
      "convert",
      {"Converts a light field or a result to another form, chosen by the suffix of OUT or by\n"
       "--to. Light fields: .h5 (archive form), .npy, .npz, .mat (LFToolbox), .png (lenslets,\n"
       "ESLF), _qs8x6a0.75.png (quilt) or a folder (benchmark form). Disparity of the center view: "
       ".pfm, .tiff, .csv,\n"
       ".ply, .npy for a RESULT, and .npz and .mat with --to map; an INPUT gives its truth. All\n"
       "views of it with --views all: .npy, .npz, .mat. Views, truth, labels, masks and\n"
       "camera are kept where the form can hold them; notes name what it cannot hold. Labels\n"
       "of the archive form are in OUT_labels.h5, or in labels.h5 beside lf.h5.\n"
       "Labels alone, of a light field or of a file of label, become a folder for other tools:\n"
       "--to labels (PNG with a palette), voc, coco or labelme, with the views as pictures.\n"
       "A RESULT takes the place of the truth of its light field; .h5 says so. Light fields\n"
       "in a folder are converted one by one into the folder OUT and keep their names.",
       "episcope-cli convert demo demo_folder/\n"
       "  episcope-cli convert demo views/ --to grid\n"
       "  episcope-cli convert demo for_labelme/ --to labelme\n"
       "  episcope-cli convert demo.h5 demo.ply"});
  parser.positional("INPUT", request.input,
                    "A light field or a result; - is a map on standard input");
  parser.positional("OUT", request.output,
                    "File or folder to write; - is standard output as .npy, pfm:- as .pfm");
  parser.option("--to", request.form, one_of(form_names()),
                "Form of the light field, or map for its disparity alone; by default chosen by the "
                "suffix of OUT");
  parser.option("--views", request.views, choice_of<ViewSelection>(),
                "Views of a map: all that there are, or center (default center)");
  parser.option(
      "--truth", request.truth, text_value("INPUT"),
      "Light field of a RESULT; by default the one named in its file. Of labels: the light "
      "field whose views are written as pictures");
  parser.flag("--overwrite", request.overwrite, Overwrite::Yes,
              "Replace an existing light field, or a map with other values");
  parser.flag("--json", request.is_json, "Print one JSON object instead of a line for each file");
  parser.option("--values", request.values, choice_of<io::MapValues>(),
                "What a map holds: disparity, or depth by the camera of the RESULT or of its light "
                "field");
  parser.flag("--gt-disparity", request.has_disparity, true,
              "Write GT_DISPARITY beside GT_DEPTH of the archive form");
  parser.flag("--repack", request.is_repacked, true,
              "Copy the HDF5 file INPUT with each dataset as one array, without chunks and "
              "compression, and with what its virtual datasets have in other files");
  parser.option("--labels", request.labels.file, text_value("LABELS"),
                "Labels of another program to write as the true labels: a file as --scribbles of "
                "label reads, or a folder of them");
  declare_label_options(parser, request.labels);
  declare_map_options(parser, request.map);
  if (!parse_reading(parser, arguments, request.job, request.read)) return false;
  check_label_options(parser, request.labels, "--labels");
  return true;
}

/// What is written: a light field in one of its forms, or a map.
struct Target {
  const io::Writer* writer = nullptr;  ///< Null for a map.
  MapForm map = MapForm::Pfm;

  [[nodiscard]] bool needs_scene() const { return writer || map == MapForm::PointCloud; }
};

Target map_target(const ConvertRequest& request) {
  const auto form = map_form_of(request.output);
  if (form && form != MapForm::Result) return {nullptr, *form};
  throw UsageError(
      "--to map writes .pfm, .tiff, .csv, .npy, .npz, .mat or .ply, but the output is " +
      request.output + "; name it so");
}

Target named_target(const ConvertRequest& request) {
  const io::Writer& writer = *io::writer_named(request.form);
  if (writer.writes_folder() || writer.has_suffix_of(request.output)) return {&writer};
  throw UsageError("--to " + request.form + " writes a file *" + writer.suffixes.front() +
                   ", but the output is " + request.output + "; name it so");
}

Target target_of(const ConvertRequest& request) {
  if (request.form == kMap) return map_target(request);
  if (!request.form.empty()) return named_target(request);
  const std::string& output = request.output;
  const std::string suffix = suffix_of(output);
  if (suffix.empty() || output.ends_with('/') || io::is_folder(output)) {
    return {io::writer_named("benchmark")};
  }
  const auto map = map_form_of(output);
  const bool is_result = !request.truth.empty() || names_result(request.input);
  if (map == MapForm::Npy && is_result) return {nullptr, *map};
  if (const io::Writer* writer = io::writer_of(output)) return {writer};
  if (map) return {nullptr, *map};
  std::vector<std::string> known{".pfm", ".ply", ".tiff", ".csv", "a folder"};
  for (const io::Writer& writer : io::writers()) {
    if (!writer.writes_folder()) known.emplace_back(writer.suffixes.front());
  }
  throw unknown_name("format", suffix, known);
}

/// What is converted: disparity, and the light field it belongs to if that is known.
struct ConvertSubject {
  std::optional<Scene> scene;
  std::optional<Estimate> estimate;
  std::string source;  ///< The INPUT that the estimate was made from; empty = not known.

  [[nodiscard]] const DisparityField& field() const {
    return estimate ? estimate->field : scene->truth->field;
  }
};

/// The INPUT that a result was estimated from, which need not be the one whose truth it becomes.
std::string source_of(const Estimate& estimate, const ConvertRequest& request) {
  const std::string& stated = estimate.source;
  if (stated.empty()) return request.truth;
  return builtin_scene_id(stated).empty() ? absolute_path(stated, request.input) : stated;
}

ConvertSubject load_subject(const ConvertRequest& request, const Target& target,
                            const Progress& progress) {
  ConvertSubject subject;
  const io::MapReading reading = map_reading(request.map);
  if (request.truth.empty() && !names_result(request.input)) {
    require_no_map_options(request.map, request.input);
    subject.scene = load_input(request.input, request.read, progress);
    return subject;
  }
  if (request.truth.empty()) {
    subject.estimate = read_result_alone(request.input, reading);
    const std::string source = existing_source(subject.estimate->source, request.input);
    protect_input(request.output, source);
    subject.source = source;
    const bool needs_camera =
        request.values == io::MapValues::Depth && !subject.estimate->camera.is_known();
    if ((target.needs_scene() || needs_camera) && !source.empty()) {
      subject.scene = load_input_of(reading_of(request.input), source, request.read, progress);
    }
  } else {
    subject.scene = load_input_of(reading_of(request.input), request.truth, request.read, progress);
    subject.estimate = read_result_of(*subject.scene->light_field, request.input, reading);
    subject.source = source_of(*subject.estimate, request);
  }
  if (subject.scene) check_fits(*subject.estimate, *subject.scene->light_field, request.input);
  if (target.needs_scene() && !subject.scene) {
    fail_without_source(request.input, subject.estimate->source);
  }
  return subject;
}

/// Makes true disparity an estimate, unless that is what is converted.
void take_truth(ConvertSubject& subject) {
  if (subject.estimate) return;
  const DisparityField& truth = subject.field();
  subject.estimate.emplace().field = truth.clone();
}

/// The scene to write; the disparity of a result takes the place of the truth.
Scene scene_to_write(ConvertSubject& subject, const std::filesystem::path& file) {
  Scene scene = std::move(*subject.scene);
  if (!subject.estimate) return scene;
  auto truth = std::make_shared<GroundTruth>();
  truth->field = std::move(subject.estimate->field);
  truth->foreground = std::move(subject.estimate->layered.foreground);
  truth->background = std::move(subject.estimate->layered.background);
  if (!scene.truth->labels.empty()) truth->labels = scene.truth->labels.clone();
  truth->regions = scene.truth->regions;
  truth->estimated = subject.estimate->provenance();
  truth->estimated->source = source_text(subject.source, file);
  scene.truth = truth;
  return scene;
}

/// How a file of labels was computed; nothing of one that another program wrote.
std::optional<Provenance> origin_of(const std::string& labels, const std::filesystem::path& file) {
  if (labels.empty() || !io::is_segmentation_file(labels)) return std::nullopt;
  Provenance origin = labels_provenance(labels);
  origin.source = source_text(existing_source(origin.source, labels), file);
  return origin;
}

GroundTruthPtr with_labels(const GroundTruth& truth, ViewStack<std::int32_t> labels,
                           std::optional<Provenance> origin) {
  auto changed = std::make_shared<GroundTruth>();
  changed->field = truth.field.clone();
  changed->foreground = truth.foreground.clone();
  changed->background = truth.background.clone();
  changed->labels = std::move(labels);
  changed->regions = truth.regions;
  changed->high_res = truth.high_res;
  changed->stratified = truth.stratified;
  changed->estimated = truth.estimated;
  changed->labels_estimated = std::move(origin);
  return changed;
}

/// The labels of --labels, whose names the scene takes; empty without that option.
ViewStack<std::int32_t> given_labels(Scene& scene, const ConvertRequest& request, Job& job,
                                     const Progress& progress) {
  if (request.labels.file.empty()) return {};
  const LightField& field = *scene.light_field;
  Scribbles labels = load_labels(request.labels, scene, job, progress);
  auto maps = io::stack_of(labels, {field.grid(), field.height(), field.width()});
  if (!labels.labels.empty()) scene.scribbles.labels = std::move(labels.labels);
  return maps;
}

void write_map(ConvertSubject& subject, const ConvertRequest& request, MapForm form) {
  if (subject.field().empty()) throw InvalidInput(request.input + " has no disparity to convert");
  take_truth(subject);
  const Estimate& estimate = *subject.estimate;
  const ViewIndex view = middle_of(estimate.field.disparity);
  const bool has_all = request.views == ViewSelection::All;
  write_output(request.output, request.overwrite, [&](const std::filesystem::path& path) {
    if (has_all) return save_maps(path, estimate);
    if (form != MapForm::PointCloud) return save_map(path, estimate, view);
    const LightField& light_field = *subject.scene->light_field;
    save_point_cloud(path, light_field, light_field.center(), estimate.field.view(view));
  });
}

/// Displays read the tiles of a quilt from its name, and so does Episcope.
void note_missing_tiles(const io::Writer& writer, const std::string& output,
                        const LightField& field, Job& job) {
  const std::filesystem::path named = io::quilt_path(output, field);
  if (std::string(writer.id) != "quilt" || named == output) return;
  job.note(output + " does not state its tiles, which displays read from its name; name it " +
           named.filename().string());
}

/// Returns the file of labels that was written; empty if there is none.
std::filesystem::path write(ConvertSubject& subject, const ConvertRequest& request,
                            const Target& target, Job& job, const Progress& progress) {
  progress.step("writing " + request.output);
  if (target.writer == nullptr) {
    write_map(subject, request, target.map);
    return {};
  }
  // What is named in a file of the folder is relative to that.
  const std::filesystem::path file = target.writer->writes_folder()
                                         ? std::filesystem::path(request.output) / "parameters.cfg"
                                         : std::filesystem::path(request.output);
  Scene scene = scene_to_write(subject, file);
  auto given = given_labels(scene, request, job, progress.part(0, 0.2));
  if (!given.empty()) {
    scene.truth = with_labels(*scene.truth, std::move(given), origin_of(request.labels.file, file));
  }
  for (const std::string& sentence : io::unsupported_parts(*target.writer, scene))
    job.note(sentence);
  note_missing_tiles(*target.writer, request.output, *scene.light_field, job);
  const bool is_archive = std::string(target.writer->id) == "archive";
  const std::filesystem::path labels =
      is_archive ? io::labels_place(request.output, scene, io::LabelFile::NamedAfter)
                 : std::filesystem::path();
  if (request.has_disparity) {
    io::write_archive(request.output, scene, progress, {io::LabelFile::NamedAfter, true});
  } else {
    target.writer->write(request.output, scene, progress);
  }
  return labels;
}

/// Puts depth in the place of disparity, NaN where it is not known. That of a result follows from
/// the camera that its file has.
void turn_into_depth(ConvertSubject& subject, const std::string& name) {
  if (subject.field().empty()) return;
  CameraGrid camera = subject.scene ? subject.scene->light_field->info().camera : CameraGrid{};
  if (!camera.is_known() && subject.estimate) camera = subject.estimate->camera;
  if (!camera.is_known()) {
    throw InvalidInput(name +
                       ": depth does not follow from disparity, since the camera is not known; "
                       "name a light field that has one with --truth INPUT");
  }
  take_truth(subject);
  subject.estimate->second = {};
  ViewStack<float>& values = subject.estimate->field.disparity;
  for (std::size_t i = 0; i < values.size(); ++i) {
    values.data()[i] = static_cast<float>(camera.depth_from_disparity(values.data()[i]));
  }
}

/// Maps in image formats forget what a result file remembers.
void note_forgotten_options(const ConvertSubject& subject, const ConvertRequest& request,
                            const Target& target, Job& job) {
  const bool forgets = !target.needs_scene();
  if (!forgets || !subject.estimate || subject.estimate->reading.options.empty()) return;
  job.note(request.output + " does not store how its light field was read; evaluate it with" +
           reading_options_text(subject.estimate->reading.options));
}

void check_output(const ConvertRequest& request, const Target& target) {
  const auto refuse = [&](bool is_wrong, const std::string& why, const char* remedy) {
    if (is_wrong) {
      throw UsageError(why + ", but the output is " + request.output + "; leave it out, or " +
                       remedy);
    }
  };
  const bool is_map = !target.writer && target.map != MapForm::PointCloud;
  const bool is_archive = target.writer && std::string(target.writer->id) == "archive";
  refuse(request.views && target.writer, "--views has no effect on a light field", "add --to map");
  refuse(request.views == ViewSelection::All && !holds_all_views(target.map),
         "--views all does not fit a form of one view", "name it OUT.npy");
  refuse(request.values == io::MapValues::Depth && !is_map,
         "--values depth is for a map (.pfm, .tiff, .npy)", "name a map");
  refuse(!request.labels.file.empty() && !target.writer, "--labels is for a light field",
         "name a light field");
  refuse(request.has_disparity && !is_archive, "--gt-disparity is for the archive form",
         "name it OUT.h5");
  const bool is_folder = target.writer && target.writer->writes_folder();
  if (!is_folder) check_output_file(request.output);
  protect_input(request.output, request.input);
  if (!request.truth.empty()) protect_input(request.output, request.truth);
  if (target.writer && !is_folder) check_light_field_output(request.output, request.overwrite);
}

void check_label_folder(const ConvertRequest& request) {
  if (request.views || request.has_disparity || request.values == io::MapValues::Depth) {
    throw UsageError(
        "convert: --views, --values and --gt-disparity have no effect on labels; leave "
        "them out");
  }
  protect_input(request.output, request.input);
  if (!request.truth.empty()) protect_input(request.output, request.truth);
}

/// Writes the labels of a segmentation file.
std::string write_segmented(const ConvertRequest& request, io::LabelForm form,
                            const Progress& progress) {
  const io::SegmentationFile file(request.input);
  const LabelingPtr kept = read_kept_labels(request.input, progress.part(0, 0.2));
  io::LabelSource source{kept->labels, file.infos()};
  if (!request.truth.empty()) {
    const Scene scene = load_input_of({request.input, file.reading()}, request.truth, request.read,
                                      progress.part(0.2, 0.4));
    check_fits(source.maps, *scene.light_field, request.input);
    source.pictures = scene.light_field;
    source.places = io::label_places(scene);
  }
  return io::write_label_folder(request.output, form, source, progress.part(0.4, 1));
}

/// Writes the labels of a light field, with its views.
std::string write_labels_of_scene(const ConvertRequest& request, io::LabelForm form, Job& job,
                                  const Progress& progress) {
  Scene scene = load_input(request.input, request.read, job, progress.part(0, 0.3));
  const auto given = given_labels(scene, request, job, progress.part(0.3, 0.5));
  const auto& labels = given.empty() ? scene.truth->labels : given;
  if (labels.empty()) {
    throw InvalidInput(request.input + " has no labels; name some with --labels");
  }
  return io::write_label_folder(
      request.output, form,
      {labels, scene.scribbles.labels, scene.light_field, io::label_places(scene)},
      progress.part(0.5, 1));
}

/// Says that it is written, unless JSON does; returns that.
[[nodiscard]] Json written(const ConvertRequest& request, const std::string& form,
                           const std::filesystem::path& labels = {}) {
  if (!request.is_json && !request.is_piped) {
    std::cout << request.output << ": written\n";
    print_labels_written(labels, request.output);
  }
  return Json::object({{"input", request.input},
                       {"output", request.output},
                       {"form", form},
                       {"written", files_written(request.output, labels)}});
}

[[nodiscard]] Json convert_labels(const ConvertRequest& request, io::LabelForm form, Job& job,
                                  const Progress& progress) {
  check_label_folder(request);
  const bool is_segmented = request.labels.file.empty() && io::is_segmentation_file(request.input);
  const std::string told = is_segmented ? write_segmented(request, form, progress)
                                        : write_labels_of_scene(request, form, job, progress);
  if (!told.empty()) job.note(told);
  job.finish();
  return written(request, request.form);
}

/// Returns what was converted, for JSON.
[[nodiscard]] Json convert_one(const ConvertRequest& request, Job& job, const Progress& progress) {
  if (const auto form = label_form_of(request))
    return convert_labels(request, *form, job, progress);
  const Target target = target_of(request);
  check_output(request, target);
  ConvertSubject subject = load_subject(request, target, progress.part(0, 0.5));
  if (subject.scene) {
    for (const auto& warning : subject.scene->convention.warnings) job.note(warning);
    if (subject.estimate) note_fit(request.input, *subject.estimate, *subject.scene, job);
  }
  note_forgotten_options(subject, request, target, job);
  if (request.values == io::MapValues::Depth) turn_into_depth(subject, request.input);
  progress.check();
  const std::filesystem::path labels = write(subject, request, target, job, progress.part(0.5, 1));
  job.finish();
  return written(request, target.writer ? target.writer->id : kMap, labels);
}

/// Where a light field of a collection goes: a folder, or a file; files of the archive have a
/// folder each, since labels lie beside them.
std::string place_in(const ConvertRequest& request, const std::string& name) {
  const std::filesystem::path place = std::filesystem::path(request.output) / name;
  const io::Writer& writer = *io::writer_named(request.form);
  if (writer.writes_folder()) {
    io::make_folder(place.parent_path());
    return place.string();
  }
  const bool is_archive = request.form == "archive";
  const std::filesystem::path file =
      is_archive ? place / "lf.h5"
                 : std::filesystem::path(place.string() + writer.suffixes.front());
  io::make_folder(file.parent_path());
  return file.string();
}

void convert_collection(ConvertRequest request, Job& job) {
  if (request.form.empty()) request.form = "benchmark";
  const std::vector<SceneInput> scenes =
      scene_inputs({request.input}, request.read, Frames::One, job.progress().part(0, 0));
  const auto convert = [&](const SceneInput& scene, const Progress& progress) {
    ConvertRequest one = request;
    one.input = scene.input;
    one.output = place_in(request, scene.name);
    return convert_one(one, job, progress);
  };
  answers_of_many(scenes, job, convert).finish(job, request.is_json);
}

std::filesystem::path repacked_file(const std::string& input) {
  const std::filesystem::path path(input);
  return io::is_folder(path) ? path / "lf.h5" : path;
}

[[nodiscard]] Json repack(const ConvertRequest& request, Job& job) {
  if (!io::has_hdf5_name(request.output) || request.is_piped) {
    throw UsageError("--repack writes a file *.h5, but the output is " + request.output +
                     "; name it so");
  }
  protect_input(request.output, request.input);
  check_light_field_output(request.output, request.overwrite);
  io::repack_hdf5(repacked_file(request.input), request.output, job.progress());
  job.finish();
  return written(request, "repacked");
}

/// Whether OUT is to be a folder for the light fields of a folder.
bool is_many(const ConvertRequest& request, const Progress& progress) {
  const bool may_be_folder = suffix_of(request.output).empty() || request.output.ends_with('/') ||
                             std::filesystem::is_directory(request.output);
  return may_be_folder && request.form != kMap && !label_form_of(request) &&
         request.truth.empty() && !names_result(request.input) &&
         is_collection(request.input, request.read, progress);
}

}  // namespace

void run_convert(const VerbArguments& arguments, std::stop_token stop) {
  ConvertRequest request;
  if (!parse(arguments, request)) return;
  const InputStream from(request.input, stop);
  if (!label_form_of(request)) require_result_for(request.truth, request.input);
  const OutputStream to(request.output, ".npy");
  to.require_alone(request.is_json);
  request.is_piped = to.is_meant();
  Job job(std::move(stop), request.job);
  if (!request.is_repacked && is_many(request, job.progress())) {
    return convert_collection(request, job);
  }
  Json answer =
      request.is_repacked ? repack(request, job) : convert_one(request, job, job.progress());
  if (to.is_meant()) return to.send();
  if (request.is_json) print_answer(std::move(answer), job.notes());
}

}  // namespace episcope::cli
