// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"
#include "app/cli/input.h"
#include "app/cli/output.h"
#include "app/cli/streams.h"
#include "app/cli/verbs/verbs.h"
#include "app/session/labeling_inputs.h"
#include "app/session/picture.h"
#include "app/session/project_file.h"
#include "app/session/quantity_map.h"
#include "app/session/result_files.h"
#include "app/session/result_fit.h"
#include "app/session/scene_summary.h"
#include "app/session/segmentation.h"
#include "engine/core/error.h"
#include "engine/core/scene.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/base/image_file.h"
#include "engine/io/formats/movie.h"
#include "engine/io/models/map_reading.h"
#include "engine/io/models/result_file.h"
#include "engine/io/models/scribble_file.h"
#include "engine/render/shade.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <iostream>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace episcope::cli {
namespace {

using render::CameraPath;
using render::MovieChoice;
using render::MovieKind;
using render::Quantity;
using render::Subject;

enum class ShownKind { LightField, Result, Labels };

/// The map that `show` is asked for.
struct ShownMap {
  std::string subject;
  ShownKind kind = ShownKind::LightField;
  render::Quantity quantity = render::Quantity::View;
  std::string truth;  ///< Light field of a result or of labels; empty = the one its file names.
  io::MapReading reading{};       ///< Of a result, beyond what its file states.
  std::string minus;              ///< For a difference: the result that is subtracted.
  std::optional<ViewIndex> view;  ///< The center, or the middle of those there are.
  int label = 1;                  ///< Whose probability.
  double bad_threshold_px = kBadPixelThreshold_px;  ///< Of bad pixels.
  bool needs_light_field = false;
};

/// The map, with its scene if one was needed and is known.
struct LoadedMap {
  std::optional<Scene> scene;
  MapSource source;
  Interval disparity_range{};  ///< Of the colors of a disparity.
};

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
  const bool tells_samples = first.source_hash != 0 && other.source_hash != 0;
  if (tells_samples && first.source_hash != other.source_hash &&
      first.reading.focus_px() == other.reading.focus_px()) {
    job.note(shown.minus + ": it was estimated from other samples than " + shown.subject);
  }
  if (loaded.source.light_field) {
    bring_to_focus(other, *loaded.source.light_field, job.progress());
  }
  loaded.source.other = std::make_shared<const Estimate>(std::move(other));
}

void note_doubts_of_truth(const std::string& truth, const Scene& scene, Job& job) {
  for (const std::string& warning : truth_warnings(scene.convention)) {
    job.note(truth + ": " + warning);
  }
  if (const std::string note = estimated_truth_note(scene); !note.empty()) job.note(note);
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
      fail_without_source(shown.subject, estimate->source);
    }
  }
  loaded.source.view = shown.view.value_or(subject_of(shown) == Subject::Error && scene
                                               ? judged_view(*scene)
                                               : middle_of(estimate->field.disparity));
  if (scene) {
    check_fits(*estimate, *scene->light_field, shown.subject);
    note_fit(shown.subject, *estimate, *scene, job);
    if (!shown.truth.empty()) note_doubts_of_truth(shown.truth, *scene, job);
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
  if (input.empty()) fail_without_source(shown.subject, named);
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

/// Reads what the map is made from; judges where it is an error. Throws UsageError if the subject
/// has no such quantity, InvalidInput if it lacks it in that view, IoError, Cancelled.
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

/// The options of a movie.
struct MovieRequest {
  /// Empty: a parallax if the output is named like a movie.
  std::optional<MovieKind> kind;
  std::optional<Interval> focus;  ///< Empty = the disparities known of the light field.
  MovieChoice choice;             ///< The rest.
};

/// The other result of a flip.
std::optional<MapSource> other_map(const LoadedMap& loaded) {
  if (!loaded.source.other) return std::nullopt;
  MapSource other = loaded.source;
  other.quantity = Quantity::Disparity;
  other.estimate = other.other;
  const std::string reason = reason_against(other);
  if (!reason.empty()) throw InvalidInput(reason);
  return other;
}

Interval focus_range(const MovieRequest& request, const LoadedMap& loaded) {
  if (request.focus) return *request.focus;
  const Interval known = loaded.scene ? known_disparity_range(*loaded.scene) : Interval{};
  if (known.length() > 0) return known;
  throw InvalidInput(
      "the disparities of this light field are not known; give the range of the focus with "
      "--focus-range A,B");
}

void declare_movie_options(Arguments& parser, MovieRequest& request) {
  parser.heading("Movies");
  parser.option("--movie", request.kind,
                choice_of<MovieKind>({{MovieKind::Parallax, "parallax"},
                                      {MovieKind::Refocus, "refocus"},
                                      {MovieKind::Flip, "flip"}}),
                "What changes: the view, the focus plane, or RESULT and the result of --minus in "
                "turns; by default the view if OUT is a movie");
  parser.option("--path", request.choice.path,
                choice_of<CameraPath>({{CameraPath::Circle, "circle"},
                                       {CameraPath::Swing, "swing"},
                                       {CameraPath::Snake, "snake"}}),
                "How a parallax moves: around the center, along the row of the center, or through "
                "all views (default circle)");
  parser.option("--seconds", request.choice.seconds,
                real_value("S", render::kMovieSeconds.min, render::kMovieSeconds.max),
                "How long the movie lasts (default 3)");
  parser.option("--width", request.choice.width_px,
                integer_value("PIXELS", 0, render::kWidestMovie_px),
                "Width of the movie; its height follows (default 0: as the picture)");
  parser.option("--focus-range", request.focus, interval_value(),
                "Disparities that the focus passes through; by default all that are known");
}

/// The movie of a map that was loaded, which outlives it. Throws InvalidInput if the views or
/// disparities that it needs are not known.
Movie movie_of(const MovieRequest& request, const LoadedMap& loaded,
               std::function<RgbaImage(const MapSource&)> draw) {
  MovieChoice choice = request.choice;
  choice.kind = request.kind.value_or(MovieKind::Parallax);
  MovieSubject subject{loaded.source, std::nullopt, loaded.scene ? &*loaded.scene : nullptr,
                       std::move(draw)};
  if (choice.kind == MovieKind::Flip) {
    subject.other = other_map(loaded);
    subject.source.quantity = Quantity::Disparity;
  }
  if (choice.kind == MovieKind::Refocus && loaded.source.quantity == Quantity::View) {
    choice.focus_px = focus_range(request, loaded);
  }
  return make_movie(choice, subject);
}

constexpr int kAnyNumber = std::numeric_limits<int>::max();

/// What is asked for; without an id, what there is most to say of.
struct What {
  std::string id;  ///< As typed.
  bool is_epi = false;
  Quantity quantity = Quantity::View;
  std::optional<MovieKind> movie{};  ///< Of the view.
};

What epi() {
  return {"epi", true, Quantity::View};
}

enum class Layer { Foreground, Background };

struct ShowRequest {
  std::string output;
  std::unique_ptr<InputStream> from;  ///< Standard input, if the subject is that.
  std::unique_ptr<OutputStream> to;   ///< Standard output likewise.
  What what;
  Layer layer = Layer::Foreground;
  ShownMap map;
  std::optional<int> row;
  std::optional<int> column;
  ShadingChoice shading;
  MovieRequest movie;
  ParameterOptions maps;          ///< Of a result.
  int longest_px = 0;             ///< Of a picture; 0 = as large as what it shows.
  std::optional<double> opacity;  ///< Over the view; empty = the map by itself.
  bool is_view_colored = false;   ///< Under the map.
  bool has_legend = false;        ///< Beside a picture.
  Overwrite overwrite = Overwrite::No;
  bool is_json = false;
  JobOptions job;
  ReadOptions read;
};

ShownKind kind_of(const ShowRequest& request) {
  if (io::is_segmentation_file(request.map.subject)) return ShownKind::Labels;
  const bool is_result = !request.map.truth.empty() || names_result(request.map.subject);
  return is_result ? ShownKind::Result : ShownKind::LightField;
}

/// "disparity" and "labels" are those of what is shown: true ones of a light field.
Quantity quantity_of(const ShowRequest& request) {
  const ShownKind kind = request.map.kind;
  const bool is_behind = request.layer == Layer::Background;
  if (request.what.id.empty()) {
    if (kind == ShownKind::Labels) return Quantity::Segmentation;
    if (kind == ShownKind::LightField) return Quantity::View;
    return is_behind ? Quantity::Background : Quantity::Disparity;
  }
  const Quantity named = request.what.quantity;
  if (named == Quantity::TrueLabels && kind == ShownKind::Labels) return Quantity::Segmentation;
  const bool is_true =
      named == Quantity::Truth || (named == Quantity::Disparity && kind == ShownKind::LightField);
  if (is_true) return is_behind ? Quantity::TruthBackground : Quantity::Truth;
  return named == Quantity::Disparity && is_behind ? Quantity::Background : named;
}

OptionValue<int> index_value(const std::string& name) {
  return integer_value(name, 0, kAnyNumber);
}

OptionValue<What> what_value() {
  std::vector<Named<What>> choices{
      {epi(), "epi"},
      {{"parallax", false, Quantity::View, MovieKind::Parallax}, "parallax"},
      {{"refocus", false, Quantity::View, MovieKind::Refocus}, "refocus"}};
  for (const auto& info : render::quantities()) {
    choices.push_back({{info.id, false, info.quantity}, info.id});
  }
  return choice_of(choices);
}

/// Whether the output is a movie; throws UsageError if what is asked for does not fit its name.
bool is_movie(const ShowRequest& request) {
  const bool is_asked = request.movie.kind.has_value();
  if (suffix_of(request.output) == ".png") {
    if (!is_asked) return false;
    throw UsageError(
        "a movie cannot be written as PNG; name the output OUT.mp4, OUT.webm or "
        "OUT.gif, or a folder for many PNG images");
  }
  const bool is_folder = suffix_of(request.output).empty();
  if (io::is_movie_path(request.output) && (is_asked || !is_folder)) {
    if (!request.what.is_epi) return true;
    throw UsageError("an EPI holds all views of its line, so there is no movie of it");
  }
  throw UsageError("show writes PNG and movies (.mp4, .webm, .gif), but the output is " +
                   request.output + "; name it OUT.png");
}

/// What follows from the options.
void complete(ShowRequest& request, const std::stop_token& stop) {
  request.from = std::make_unique<InputStream>(request.map.subject, stop);
  request.to = std::make_unique<OutputStream>(request.output, ".png");
  request.to->require_alone(request.is_json);
  while (request.output.size() > 1 && request.output.ends_with('/')) request.output.pop_back();
  if (request.what.id.empty() && (request.row || request.column)) request.what = epi();
  if (request.what.movie) request.movie.kind = request.what.movie;
  if (is_movie(request) && !request.movie.kind) request.movie.kind = MovieKind::Parallax;
  require_result_for(request.map.truth, request.map.subject);
  request.map.needs_light_field = request.opacity.has_value();
  request.map.kind = kind_of(request);
  request.map.quantity = quantity_of(request);
  if (request.map.kind != ShownKind::Result) {
    require_no_map_options(request.maps, request.map.subject);
  }
  request.map.reading = map_reading(request.maps);
  if (request.movie.kind == MovieKind::Flip) request.map.quantity = Quantity::Difference;
  if (request.what.id.empty()) {
    const bool is_of_labels = request.map.kind == ShownKind::Labels;
    request.what.id =
        render::info_of(is_of_labels ? Quantity::TrueLabels : request.map.quantity).id;
  }
}

/// Whether colors stand for numbers that a scale can name.
bool has_numbers(Quantity quantity) {
  return render::info_of(quantity).has_scale() && quantity != Quantity::BadPixels;
}

/// Options that fit other pictures than the one that is asked for.
std::vector<Arguments::Use> uses_of(const ShowRequest& request) {
  const bool is_epi = request.what.is_epi;
  const Quantity quantity = request.map.quantity;
  const std::optional<MovieKind>& movie = request.movie.kind;
  const bool has_layers = quantity == Quantity::Truth || quantity == Quantity::TruthBackground ||
                          quantity == Quantity::Disparity || quantity == Quantity::Background;
  const bool is_map = !is_epi && quantity != Quantity::View;
  const std::string what = "on --what " + request.what.id;
  return {{{"--row", "--column"}, is_epi, what + "; a line is shown by --what epi"},
          {{"--label"}, quantity == Quantity::Probability, what},
          {{"--minus"}, quantity == Quantity::Difference, what + "; say --what difference"},
          {{"--layer"}, has_layers, what},
          {{"--range", "--colormap"}, is_map && render::info_of(quantity).has_scale(), what},
          {{"--over-view"}, is_map, what},
          {{"--color-view"}, request.opacity.has_value(), "without --over-view"},
          {{"--legend"}, is_map && !movie && has_numbers(quantity), movie ? "on a movie" : what},
          {{"--threshold"}, quantity == Quantity::BadPixels, what + "; say --what bad_pixels"},
          {{"--fit"}, !movie, "on a movie, whose size is --width"},
          {{"--seconds", "--width"}, movie.has_value(), "on a picture"},
          {{"--path"}, movie == MovieKind::Parallax, "unless the movie is a parallax"},
          {{"--focus-range"}, movie == MovieKind::Refocus, "unless the movie is a refocus"}};
}

bool parse(const VerbArguments& arguments, const std::stop_token& stop, ShowRequest& request) {
  Arguments parser("show", {"Writes a picture of a light field, a result or labels, as the window "
                            "shows it.",
                            "episcope-cli show demo.h5 -o error.png --what error"});
  parser.positional(
      "INPUT|RESULT", request.map.subject,
      "A light field, a result, labels, or a project, whose current light field is shown; - is a "
      "map on standard input");
  parser.required_option("-o,--output", request.output, text_value("OUT.png"),
                         "Picture to write; a movie as .mp4, .webm or .gif; - is standard output");
  parser.option("--what", request.what, what_value(),
                "What to show; by default the view of an INPUT, the disparity of a RESULT, the "
                "labels of a file of labels");
  parser.option("--view", request.map.view, view_value(),
                "Camera row and column; by default the center view");
  parser.option("--row", request.row, index_value("Y"),
                "Image row of a horizontal EPI (then --what is epi)");
  parser.option("--column", request.column, index_value("X"),
                "Image column of a vertical EPI (then --what is epi)");
  parser.exclude_each_other({"--row", "--column"});
  parser.option("--range", request.shading.range, interval_value(),
                "Values at the ends of the color map; by default those of what is shown");
  parser.option("--colormap", request.shading.color_map, one_of(render::color_map_names()),
                "Color map; by default that of what is shown");
  parser.flag("--legend", request.has_legend, "Draw the scale of the colors beside the picture");
  parser.option("--threshold", request.map.bad_threshold_px, real_value("PX", 0, 1e3),
                "Error above which --what bad_pixels calls a pixel bad, in px (default 0.07)");
  parser.option("--fit", request.longest_px, index_value("PIXELS"),
                "Scale a larger picture down to this many pixels on its longer side, without its "
                "legend (default 0: as it is)");
  parser.option("--truth", request.map.truth, text_value("INPUT"),
                "Light field of a RESULT; by default the one named in its file");
  parser.option(
      "--layer", request.layer,
      choice_of<Layer>({{Layer::Foreground, "foreground"}, {Layer::Background, "background"}}),
      "Layer to show where there are two (default foreground)");
  parser.option("--label", request.map.label, integer_value("N", 1, kAnyNumber),
                "Label whose probability is shown (default 1)");
  parser.option("--minus", request.map.minus, text_value("RESULT"),
                "For a difference: the result to subtract; for a flip: the other result");
  parser.option("--over-view", request.opacity, real_value("OPACITY", 0, 1),
                "Overlay the map on the view, with an opacity from 0 to 1");
  parser.flag("--color-view", request.is_view_colored,
              "Keep the colors of the view under a map; without, it is grey");
  parser.flag("--overwrite", request.overwrite, Overwrite::Yes, "Replace another picture");
  parser.flag("--json", request.is_json, "Print one JSON object instead of a line");
  declare_movie_options(parser, request.movie);
  declare_map_options(parser, request.maps);
  if (!parse_reading(parser, arguments, request.job, request.read)) return false;
  complete(request, stop);
  parser.check_uses(uses_of(request));
  return true;
}

RgbaImage epi_picture(const ShowRequest& request, const LightField& light_field, ViewIndex view) {
  if (request.column) return vertical_epi_picture(light_field, view, *request.column);
  return horizontal_epi_picture(light_field, view, request.row.value_or(light_field.height() / 2));
}

/// The source in the colors that were asked for.
RgbaImage picture_of(const ShowRequest& request, const LoadedMap& loaded, const MapSource& source) {
  if (source.quantity == Quantity::View) {
    return render::shade_view(*source.light_field, source.view);
  }
  const auto shading = shading_of(source.quantity, loaded.disparity_range, request.shading);
  const QuantityMapPtr map = make_map(source);
  if (!request.opacity) return map_picture(*map, shading);
  return over_view(render::shade_view(*source.light_field, source.view), *map, shading,
                   {*request.opacity, request.is_view_colored});
}

/// What was drawn: for people, and as keys of JSON.
struct Drawn {
  std::string text;
  Json json;
};

void tell_colors(const ShowRequest& request, const LoadedMap& loaded, Drawn& drawn) {
  const Quantity quantity = loaded.source.quantity;
  if (request.what.is_epi || !render::info_of(quantity).has_scale()) return;
  if (quantity == Quantity::BadPixels) {
    drawn.text += fmt::format(", bad above {:g} px", request.map.bad_threshold_px);
    drawn.json["threshold_px"] = request.map.bad_threshold_px;
    return;
  }
  const Interval range = shading_of(quantity, loaded.disparity_range, request.shading).range;
  const std::string unit = render::info_of(quantity).unit;
  drawn.text += fmt::format(", colors from {:.4g} to {:.4g}{}", range.min, range.max,
                            unit.empty() ? "" : " " + unit);
  drawn.json["range"] = interval_json(range);
  if (!unit.empty()) drawn.json["unit"] = unit;
}

Drawn write_picture(const ShowRequest& request, const LoadedMap& loaded, Job& job) {
  const MapSource& source = loaded.source;
  RgbaImage picture = request.what.is_epi ? epi_picture(request, *source.light_field, source.view)
                                          : picture_of(request, loaded, source);
  if (request.longest_px > 0) picture = render::fitted(picture, request.longest_px);
  if (request.has_legend) {
    picture = render::with_legend(
        picture, shading_of(source.quantity, loaded.disparity_range, request.shading),
        render::info_of(source.quantity).unit);
  }
  job.progress().check();
  write_output(request.output, request.overwrite,
               [&](const std::filesystem::path& path) { io::write_picture(path, picture.view()); });
  return {fmt::format("{}, {}×{} px", request.what.id, picture.width(), picture.height()),
          Json::object({{"width", picture.width()}, {"height", picture.height()}})};
}

Drawn write_movie_of(const ShowRequest& request, const LoadedMap& loaded, Job& job) {
  const Movie movie = movie_of(request.movie, loaded, [&](const MapSource& source) {
    return picture_of(request, loaded, source);
  });
  write_output(request.output, request.overwrite, [&](const std::filesystem::path& path) {
    write_movie(path, movie, request.movie.choice.width_px, job.progress());
  });
  const std::string what = request.movie.kind == MovieKind::Flip ? "flip" : request.what.id;
  const double seconds = movie.count / movie.rate;
  return {fmt::format("{}, {} pictures in {:.1f} s", what, movie.count, seconds),
          Json::object({{"pictures", movie.count}, {"seconds", seconds}})};
}

/// Pictures of a movie go into a folder, which may be there, empty.
void check_output(const ShowRequest& request) {
  const bool is_folder = io::is_folder(request.output);
  if (!request.movie.kind || !is_folder) check_output_file(request.output);
}

}  // namespace

void run_show(const VerbArguments& arguments, std::stop_token stop) {
  ShowRequest request;
  if (!parse(arguments, stop, request)) return;
  check_output(request);
  for (const std::string& input : {request.map.subject, request.map.truth, request.map.minus}) {
    if (!input.empty()) protect_input(request.output, input);
  }

  Job job(std::move(stop), request.job);
  const LoadedMap loaded = load_map(request.map, request.read, job);
  job.progress().check();
  Drawn drawn = request.movie.kind ? write_movie_of(request, loaded, job)
                                   : write_picture(request, loaded, job);
  tell_colors(request, loaded, drawn);
  job.finish();
  if (request.to->is_meant()) return request.to->send();
  if (!request.is_json) {
    std::cout << request.output << ": " << drawn.text << "\n";
    return;
  }
  Json json{{"input", request.map.subject},
            {"what", request.what.id},
            {"view", view_json(loaded.source.view)}};
  json.update(drawn.json);
  json["output"] = request.output;
  print_answer(std::move(json), job.notes(), {request.output});
}

}  // namespace episcope::cli
