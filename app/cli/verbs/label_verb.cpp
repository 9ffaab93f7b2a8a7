// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"
#include "app/cli/input.h"
#include "app/cli/label_files.h"
#include "app/cli/output.h"
#include "app/cli/parameter_options.h"
#include "app/cli/streams.h"
#include "app/cli/verbs/verbs.h"
#include "app/session/label_review.h"
#include "app/session/labeling_inputs.h"
#include "app/session/replace_file.h"
#include "app/session/segmentation.h"
#include "engine/core/error.h"
#include "engine/core/progress.h"
#include "engine/disparity/estimator.h"
#include "engine/io/base/json.h"
#include "engine/io/formats/archive_companions.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace episcope::cli {
namespace {

struct LabelRequest {
  std::string input;
  std::string output;
  LabelFileOptions scribbles;
  std::string disparity;
  std::string given;    // Probabilities to begin with.
  std::string archive;  // Folder to write,
  std::string masks;    // likewise.
  bool is_json = false;
  Overwrite overwrite = Overwrite::No;
  StoredProbabilities probabilities = StoredProbabilities::None;
  LabelerParameters parameters;
  JobOptions job;
  ReadOptions read;
};

bool parse(const VerbArguments& arguments, LabelRequest& request) {
  Arguments parser(
      "label", {"Segments all views of a light field from scribbles on some of them, and\n"
                "writes a file of labels.",
                "episcope-cli label demo -o labels.h5 --features image\n"
                "  episcope-cli label demo --scribbles strokes.png --colors colors.csv -o l.h5"});
  parser.positional("INPUT", request.input,
                    "The light field; - is one on standard input: HDF5, .npy, .npz, .mat or TIFF");
  parser.required_option("-o,--output", request.output, text_value("OUT.h5"),
                         "File of labels to write");
  parser.option(
      "--scribbles", request.scribbles.file, text_value("LABELS"),
      "Strokes, by default those next to INPUT: a file of labels, a picture (PNG, TIFF) or "
      "an array (.npy, .mat, HDF5) of one view or of all, or a folder of pictures that are "
      "named by row and column, as 04_04.png. In pictures a label is a gray level, an "
      "index of the palette (0 = unpainted), or a distinct color; transparent pixels, or "
      "else those of the most frequent color, are unpainted");
  declare_label_options(parser, request.scribbles);
  parser.option(
      "--disparity", request.disparity, text_value("RESULT.h5"),
      std::string("Disparity of all views; by default ") + kLabelingEstimator + " estimates it");
  parser.option("--probabilities", request.given, text_value("FILE.h5"),
                "Label probabilities of all views, in the form of the archive, to use instead of "
                "learning them");
  parser.option("--write-archive", request.archive, text_value("DIR"),
                "Also write edge_weights.h5 and the label probabilities of all sets of features "
                "into this folder, under the archive's names");
  parser.option("--write-masks", request.masks, text_value("DIR"),
                "Also write a black and white PNG of every label in every view into this folder");
  parser.flag(
      "--write-probabilities", request.probabilities, StoredProbabilities::All,
      "Also write the probabilities of all labels, which take four bytes per ray and label");
  parser.flag("--no-probabilities", request.probabilities, StoredProbabilities::None,
              "Write labels only, as is the default");
  parser.exclude_each_other({"--write-probabilities", "--no-probabilities"});
  parser.flag("--overwrite", request.overwrite, Overwrite::Yes,
              "Replace labels made with other parameters, from other strokes or of another light "
              "field, and files in the folders of --write-archive and --write-masks");
  request.job.run.declare(parser, {run_schema().description("device")});
  parser.flag("--json", request.is_json, "Print one JSON object instead of a table");
  const Schema<LabelerParameters> schema = labeler_schema();
  ParameterOptions options;
  parser.heading("Parameters");
  // --smoothness is a parameter of methods.
  options.declare(parser, schema.descriptions(), {{"smoothness", "--boundary-cost"}});
  if (!parse_reading(parser, arguments, request.job, request.read)) return false;
  request.parameters = schema.parse(options.values());
  check_label_options(parser, request.scribbles, "--scribbles");
  if (!request.disparity.empty() && request.parameters.features == FeatureSet::ImageTruth) {
    throw UsageError(
        "label: --features image+truth uses the ground truth, so --disparity would have no effect");
  }
  return true;
}

// What the GPU is for: the estimate, the votes of the forest, and labels along rays.
void check_device(Device device) {
  EstimatorInfo label;
  label.name = "label";
  label.devices = {Device::Cpu, Device::Cuda};
  require_device(device, label);
}

/// Refuses to replace files of the folders, which do not tell what they were made by.
void check_folders(const LabelRequest& request) {
  namespace fs = std::filesystem;
  using enum CompanionKind;
  std::vector<fs::path> files;
  if (!request.masks.empty()) files.push_back(fs::path(request.masks) / kListOfMasks);
  for (const CompanionKind kind :
       {EdgeProbabilities, ImageProbabilities, DepthProbabilities, TrueDepthProbabilities}) {
    if (request.archive.empty()) break;
    files.push_back(fs::path(request.archive) / io::companion_file(kind));
  }
  for (const fs::path& file : files) {
    if (request.overwrite == Overwrite::Yes || !holds_something(file)) continue;
    throw IoError(file, std::string("exists and does not tell what it was made by; choose another "
                                    "folder, or ") +
                            kByOption);
  }
}

/// Before strokes are read, which have no hash then, and after it.
void check_replaced(const LabelRequest& request, std::optional<std::uint64_t> sources_hash) {
  const ParameterSet reading =
      io::given_options(io::open_schema().parse(request.read.options.values()));
  check_made_output(
      request.output,
      {{}, labeler_schema().values(request.parameters), request.input, reading, sources_hash},
      request.overwrite);
}

void check_output(const LabelRequest& request, const InputStream& from) {
  check_hdf5_output("label", request.output);
  check_replaced(request, std::nullopt);
  protect_input(request.output, request.input);
  for (const std::string& file : {request.scribbles.file, request.disparity, request.given}) {
    if (!file.empty()) protect_input(request.output, file);
  }
  if (from.is(request.input)) require_no_other_source(request.output, request.overwrite);
  check_folders(request);
}

Scribbles load_scribbles(const LabelRequest& request, Scene& scene, Job& job) {
  if (!request.scribbles.file.empty()) {
    return load_labels(request.scribbles, scene, job, job.progress().part(0, 0));
  }
  if (scene.scribbles.empty() && !request.given.empty() && request.archive.empty()) return {};
  if (scene.scribbles.empty()) {
    throw InvalidInput(scene.light_field->info().name +
                       " has no scribbles next to it; name a file of scribbles with --scribbles");
  }
  return std::move(scene.scribbles);
}

/// What labels are made from, as the user gave it.
struct GivenSources {
  Scribbles scribbles;
  LabelingDisparity disparity;                      ///< Without a field: to be estimated.
  std::optional<LabelProbabilities> probabilities;  ///< None: to be learnt. Consumed by labeling.
  std::uint64_t hash = 0;                           ///< hash_of all of them.
};

GivenSources load_sources(const LabelRequest& request, Scene& scene, Job& job) {
  const Progress& progress = job.progress();
  GivenSources given;
  given.scribbles = load_scribbles(request, scene, job);
  if (!request.disparity.empty()) {
    given.disparity = find_labeling_disparity(scene, request.parameters, request.disparity,
                                              progress.part(0.1, 0.15));
    note_fit(request.disparity, *given.disparity.estimate, scene, job,
             " to convert, and give what that writes");
  }
  if (!request.given.empty()) {
    given.probabilities =
        read_all_probabilities(request.given, scene, given.scribbles, progress.part(0.15, 0.2));
    const std::string doubt = probabilities_note(*given.probabilities, given.scribbles);
    if (!doubt.empty()) job.note(request.given + ": " + doubt);
  }
  given.hash =
      hash_of(LabelSources{.strokes = given.scribbles,
                           .disparity = given.disparity.field.get(),
                           .probabilities = given.probabilities ? &*given.probabilities : nullptr});
  return given;
}

Labeling label_views(Labeler& labeler, GivenSources& given, const LabelRequest& request,
                     GridShape grid, const Progress& progress) {
  if (!given.probabilities) {
    return labeler.label(given.scribbles, request.parameters, {{0, 0}, grid}, progress);
  }
  return labeler.smooth(std::move(*given.probabilities), given.scribbles, request.parameters,
                        progress);
}

/// What the archive calls features with disparity has an estimate even where labels use the truth.
std::vector<std::string> write_archive(const Scene& scene, const Scribbles& scribbles,
                                       const LabelRequest& request, const LabelingDisparity& used,
                                       const Job& job) {
  if (request.archive.empty()) return {};
  LabelingDisparity estimate = used;
  if (request.parameters.features == FeatureSet::ImageTruth) {
    LabelerParameters parameters = request.parameters;
    parameters.features = FeatureSet::ImageEstimate;
    estimate = find_labeling_disparity(scene, parameters, {}, job.progress());
  }
  std::vector<std::string> files = write_label_archive(
      request.archive, scene, scribbles, request.parameters, estimate, job.progress().part(1, 1));
  for (std::string& file : files) file = (std::filesystem::path(request.archive) / file).string();
  return files;
}

std::vector<std::string> write_masks(const Segmentation& segmentation, const LabelRequest& request,
                                     Job& job) {
  if (request.masks.empty()) return {};
  const int count = write_label_masks(request.masks, segmentation, job.progress().part(1, 1));
  job.note("wrote " + std::to_string(count) + " masks to " + request.masks);
  return {request.masks};
}

/// Scores of labels, with what else there is to tell of them.
struct LabelAnswer {
  const Labeling& labeling;
  LabelingScores scores;
  double seconds = 0;
  std::vector<std::string> written;  ///< Files and folders.
};

void print_json_answer(const LabelRequest& request, const LabelAnswer& answer, const Job& job) {
  const auto& [labeling, scores, seconds, written] = answer;
  Json json;
  json["labels"] = labeling.probabilities.ids.size();
  json["seconds"] = seconds;
  for (const auto& [key, share] : labeling_metrics(scores)) json[key] = share;
  if (request.parameters.regularizer != Regularizer::None) json["gap"] = labeling.gap;
  json["peak_mib"] = peak_memory_mib();
  json["parameters"] = io::parameters_json(labeler_schema().values(request.parameters));
  json["output"] = request.output;
  json["written"] = written;
  print_answer(std::move(json), job.notes());
}

void print_text_answer(const LabelRequest& request, const LabelAnswer& answer) {
  const auto& [labeling, scores, seconds, written] = answer;
  std::cout << request.output << ": " << labeling.probabilities.ids.size() << " labels in "
            << labeling.labels.grid().count() << " views, " << std::fixed << std::setprecision(2)
            << seconds << " s, " << std::setprecision(0) << peak_memory_mib() << " MiB at most\n";
  std::cout << std::setprecision(2);
  if (scores.consistency) {
    std::cout << "consistency along rays    " << 100 * *scores.consistency << " %\n";
  }
  const auto print = [](const char* name, const std::optional<double>& share) {
    if (share) std::cout << name << 100 * *share << " %\n";
  };
  print("accuracy of all views     ", scores.all_views.all.share());
  print("  mean over labels        ", scores.all_views.all.mean_share());
  print("  mean IoU of labels      ", scores.all_views.all.mean_overlap());
  print("  near boundaries         ", scores.all_views.boundaries.share());
  print("  IoU of thin labels      ", scores.all_views.thin_overlap());
  print("accuracy of the center    ", scores.view.all.share());
  for (const std::int32_t id : labeling.probabilities.ids) {
    if (const auto of_label = scores.view.all.share(id)) {
      std::cout << "  of label " << std::setw(3) << id << "            " << 100 * *of_label
                << " %\n";
    }
  }
  for (const std::string& file : written) {
    if (file != request.output) std::cout << file << ": written\n";
  }
}

struct ComputedLabels {
  LabelingDisparity disparity;
  std::shared_ptr<const Labeling> labeling;
  double seconds = 0;
};

ComputedLabels compute_labels(const Scene& scene, GivenSources& given, const LabelRequest& request,
                              const Progress& progress) {
  const Device device = request.job.run_options().device;
  const Stopwatch watch;
  LabelingDisparity disparity =
      given.disparity.field
          ? given.disparity
          : find_labeling_disparity(scene, request.parameters, {}, progress.part(0, 0.1), device);
  Labeler labeler = labeler_of(scene, disparity, progress, device);
  auto labeling = std::make_shared<const Labeling>(
      label_views(labeler, given, request, scene.light_field->grid(), progress.part(0.1, 1)));
  return {std::move(disparity), std::move(labeling), watch.seconds()};
}

// Returns the files and folders written.
std::vector<std::string> write_all(const Scene& scene, const GivenSources& given,
                                   const ComputedLabels& computed, const InputStream& from,
                                   const LabelRequest& request, Job& job) {
  job.progress().step("writing " + request.output);
  const Segmentation segmentation{.labeling = computed.labeling,
                                  .labels = given.scribbles.labels,
                                  .parameters = labeler_schema().values(request.parameters),
                                  .reading = scene.light_field->info().reading,
                                  .sources_hash = given.hash};
  write_segmentation(request.output, segmentation,
                     from.is(request.input) ? std::string() : request.input, request.probabilities,
                     job.progress().part(0.95, 1));
  std::vector<std::string> written{request.output};
  std::ranges::move(write_archive(scene, given.scribbles, request, computed.disparity, job),
                    std::back_inserter(written));
  std::ranges::move(write_masks(segmentation, request, job), std::back_inserter(written));
  return written;
}

}  // namespace

void run_label(const VerbArguments& arguments, std::stop_token stop) {
  LabelRequest request;
  if (!parse(arguments, request)) return;
  check_device(request.job.run_options().device);
  const InputStream from(request.input, stop);
  from.require_light_field();
  check_input(request.input);
  check_output(request, from);

  Job job(std::move(stop), request.job);
  const Progress& progress = job.progress();
  Scene scene = load_input(request.input, request.read, job, progress.part(0, 0.1));
  GivenSources given = load_sources(request, scene, job);
  check_replaced(request, given.hash);
  for (const std::string& note : stroke_notes(given.scribbles, scene.truth->labels)) job.note(note);
  const ComputedLabels computed = compute_labels(scene, given, request, progress.part(0.1, 0.95));
  const Labeling& labeling = *computed.labeling;
  if (!labeling.note.empty()) job.note(labeling.note);
  std::vector<std::string> written = write_all(scene, given, computed, from, request, job);
  const LabelAnswer answer{labeling,
                           judge_labeling(labeling, scene, computed.disparity, progress.part(1, 1)),
                           computed.seconds, std::move(written)};
  const std::string other_numbers = other_numbers_text(answer.scores);
  if (!other_numbers.empty()) job.note(other_numbers);
  job.finish();
  request.is_json ? print_json_answer(request, answer, job) : print_text_answer(request, answer);
}

}  // namespace episcope::cli
