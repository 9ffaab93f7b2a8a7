// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments/arguments.h"
#include "app/cli/arguments/usage_error.h"
#include "app/cli/input/input.h"
#include "app/cli/input/result_input.h"
#include "app/cli/output/output_file.h"
#include "app/cli/verbs/verbs.h"
#include "app/session/run/command_line.h"
#include "app/session/run/read_result.h"
#include "app/session/run/result_source.h"
#include "app/session/save/save_result.h"
#include "engine/core/text/suffix.h"
#include "engine/io/archive/write_scene.h"

#include <iostream>

namespace episcope::cli {
namespace {

struct Request {
  std::string input;
  std::string output;
  std::string truth;
  Overwrite overwrite = Overwrite::No;
  JobOptions job;
  ReadOptions read;
};

bool parse(const VerbArguments& arguments, Request& request) {
  Arguments parser("convert",
                   {"Writes a light field or a result in another format, by the suffix of OUT:\n"
                    ".h5 (archive form), .pfm, .tiff, .ply (disparity of the centre view: of a\n"
                    "RESULT, or the truth of an INPUT), or a folder (benchmark form). A RESULT\n"
                    "becomes the depth of its light field in the archive and benchmark forms.",
                    "episcope-cli convert demo demo_folder/\n"
                    "  episcope-cli convert demo.h5 demo.ply"});
  parser.positional("INPUT", request.input, "A light field or a result");
  parser.positional("OUT", request.output, "File or folder to write");
  parser.option("--truth", request.truth, text_value("INPUT"),
                "Light field of a RESULT; by default the one named in its file");
  parser.flag("--overwrite", request.overwrite, Overwrite::Yes, "Replace an existing light field");
  return parse_reading(parser, arguments, request.job, request.read);
}

enum class Format { Archive, Pfm, Tiff, Ply, Folder };

Format format_of(const std::string& output) {
  const std::string suffix = suffix_of(output);
  std::error_code ignored;
  if (suffix.empty() || output.ends_with('/') || std::filesystem::is_directory(output, ignored)) {
    return Format::Folder;
  }
  if (suffix == ".h5" || suffix == ".hdf5") return Format::Archive;
  if (suffix == ".pfm") return Format::Pfm;
  if (suffix == ".tif" || suffix == ".tiff") return Format::Tiff;
  if (suffix == ".ply") return Format::Ply;
  throw unknown_name("format", suffix, {".h5", ".pfm", ".ply", ".tiff", "a folder"});
}

/// What is converted: disparity, and the light field it belongs to if that is known.
struct Subject {
  std::optional<Scene> scene;
  std::optional<Estimate> estimate;

  [[nodiscard]] const DisparityField& field() const {
    return estimate ? estimate->field : scene->truth->field;
  }
};

Subject load_subject(const Request& request, Format format, const Progress& progress) {
  Subject subject;
  if (request.truth.empty() && !names_result(request.input)) {
    subject.scene = load_input(request.input, request.read, progress);
    return subject;
  }
  const bool needs_scene =
      format == Format::Archive || format == Format::Folder || format == Format::Ply;
  if (request.truth.empty()) {
    subject.estimate = read_result_alone(request.input);
    const std::string source = existing_source(subject.estimate->source, request.input);
    protect_input(request.output, source);
    if (needs_scene && !source.empty()) {
      subject.scene = load_input_of(reading_of(request.input), source, request.read, progress);
    }
  } else {
    subject.scene = load_input_of(reading_of(request.input), request.truth, request.read, progress);
    subject.estimate = read_result_of(*subject.scene->light_field, request.input);
  }
  if (needs_scene && !subject.scene) {
    throw IoError(request.input,
                  "its light field is unknown or no longer where it was; name it with "
                  "--truth INPUT");
  }
  return subject;
}

/// The centre view of the map, or the only one there is.
DisparityView map_of(const Subject& subject, const std::string& name) {
  const DisparityField& field = subject.field();
  if (field.empty()) throw InvalidInput(name + " has no disparity to convert");
  const auto& stack = field.disparity;
  const ViewIndex middle = stack.grid().center();
  return field.view({stack.first().v + middle.v, stack.first().u + middle.u});
}

/// The scene to write; the disparity of a result takes the place of the truth.
Scene scene_to_write(Subject& subject) {
  Scene scene = std::move(*subject.scene);
  if (!subject.estimate) return scene;
  auto truth = std::make_shared<GroundTruth>();
  truth->field = std::move(subject.estimate->field);
  if (!scene.truth->labels.empty()) truth->labels = scene.truth->labels.clone();
  scene.truth = truth;
  return scene;
}

void write(Subject& subject, const Request& request, Format format, const Progress& progress) {
  progress.step("writing " + request.output);
  switch (format) {
    case Format::Archive:
      return io::write_archive(request.output, scene_to_write(subject), progress);
    case Format::Folder:
      return io::write_benchmark_folder(request.output, scene_to_write(subject), progress);
    case Format::Pfm:
    case Format::Tiff:
      return save_map(request.output, map_of(subject, request.input));
    case Format::Ply: {
      const LightField& light_field = *subject.scene->light_field;
      return save_point_cloud(request.output, light_field, light_field.center(),
                              map_of(subject, request.input));
    }
  }
}

/// Maps in image formats forget what a result file remembers.
void note_forgotten_options(const Subject& subject, const Request& request, Format format,
                            Job& job) {
  const bool forgets = format == Format::Pfm || format == Format::Tiff;
  if (!forgets || !subject.estimate || subject.estimate->reading.options.empty()) return;
  job.note(request.output + " does not store how its light field was read; evaluate it with" +
           reading_options_text(subject.estimate->reading.options));
}

}  // namespace

void run_convert(const VerbArguments& arguments, std::stop_token stop) {
  Request request;
  if (!parse(arguments, request)) return;
  const Format format = format_of(request.output);
  if (format != Format::Folder) check_output_file(request.output);
  protect_input(request.output, request.input);
  if (!request.truth.empty()) protect_input(request.output, request.truth);
  if (format == Format::Archive) {
    check_light_field_output(request.output, request.overwrite);
  }

  Job job(std::move(stop), request.job);
  Subject subject = load_subject(request, format, job.progress().part(0, 0.5));
  if (subject.scene) {
    for (const auto& warning : subject.scene->convention.warnings) job.note(warning);
  }
  note_forgotten_options(subject, request, format, job);
  job.progress().check();
  write(subject, request, format, job.progress().part(0.5, 1));
  job.finish();
  std::cout << request.output << ": written\n";
}

}  // namespace episcope::cli
