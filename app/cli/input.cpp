// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/input.h"

#include "app/cli/arguments.h"
#include "app/session/collections.h"
#include "app/session/command_line.h"
#include "app/session/load_scene.h"
#include "app/session/result_files.h"
#include "app/session/result_fit.h"
#include "engine/core/error.h"
#include "engine/io/base/array_layout.h"
#include "engine/io/base/files.h"
#include "engine/io/base/sample_range.h"
#include "engine/io/formats/sequence_reader.h"
#include "engine/io/models/names/name_pattern.h"
#include "engine/io/models/reader.h"
#include "engine/io/models/result_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace episcope::cli {

void declare_read_options(Arguments& arguments, ReadOptions& options) {
  arguments.heading(Arguments::kReading);
  options.options.declare(arguments, io::open_schema().descriptions());
}

void check_read_options(const ReadOptions& options) {
  const io::OpenOptions open = io::open_schema().parse(options.options.values());
  const auto check = [](const char* name, const std::string& value, const auto& parse) {
    try {
      if (!value.empty()) (void)parse(value);
    } catch (const InvalidInput& error) {
      throw UsageError(std::string(name) + ": " + error.what());
    }
  };
  check("--grid", open.grid, io::parse_grid);
  check("--crop", open.crop == "all" ? std::string() : open.crop, io::parse_grid);
  check("--levels", open.levels, io::parse_levels);
  check("--axes", open.axes, io::axis_letters);
  check("--pattern", open.pattern, [](const std::string& text) { return io::NamePattern(text); });
}

void require_no_read_options(const ReadOptions& options, const std::string& input) {
  const ParameterSet given = options.options.values();
  if (given.empty()) return;
  throw UsageError("--" + option_name(given.front().first) + " is for light fields, but " + input +
                   " is none; leave it out");
}

void print_reading_help() {
  Arguments parser(
      "VERB", {"Options of every verb with an INPUT: how a light field is read, where its files "
               "do not tell or are to be read otherwise.",
               "episcope-cli info pictures/ --pattern 'view_{row}_{col}.png'\n"
               "  episcope-cli estimate epi_l lf.mat -o r.h5 --axes vuyxc --flip u"});
  ReadOptions options;
  options.options.declare(parser, io::open_schema().descriptions());
  (void)parser.parse({"--help"});
}

bool parse_reading(Arguments& parser, const std::vector<std::string>& arguments, JobOptions& job,
                   ReadOptions& read) {
  declare_job_options(parser, job);
  declare_read_options(parser, read);
  if (!parser.parse(arguments)) return false;
  check_read_options(read);
  return true;
}

void declare_map_options(Arguments& arguments, ParameterOptions& options) {
  arguments.heading("Maps of other programs");
  options.declare(arguments, io::map_schema().descriptions());
  arguments.heading("Options");
}

io::MapReading map_reading(const ParameterOptions& options) {
  const io::MapReading reading = io::map_schema().parse(options.values());
  if (reading.scale == 0) {
    throw UsageError(
        "--map-scale is 0, which makes every value 0; give what one stored unit is in px");
  }
  try {
    static_cast<void>(io::missing_values(reading));
  } catch (const InvalidInput& error) {
    throw UsageError(error.what());
  }
  return reading;
}

void require_no_map_options(const ParameterOptions& options, const std::string& input) {
  const ParameterSet given = options.values();
  if (given.empty()) return;
  throw UsageError("--" + given.front().first + " is for the maps of a RESULT, but " + input +
                   " is none; leave it out");
}

void require_result_for(const std::string& truth, const std::string& input) {
  if (truth.empty() || !names_light_field_only(input)) return;
  throw UsageError("--truth names the light field of a RESULT, but " + input +
                   " is a light field itself; leave it out");
}

void check_builtin_scene(const std::string& id) {
  std::vector<std::string> ids;
  for (const auto& scene : builtin_inputs()) ids.push_back(scene.id);
  const std::string scene = id.substr(0, id.find('?'));
  if (std::ranges::find(ids, scene) == ids.end()) throw unknown_name("built-in scene", scene, ids);
  try {
    require_builtin_input(id);
  } catch (const InvalidInput& error) {
    throw UsageError(error.what());
  }
}

void check_input(const std::string& input) {
  const std::string builtin = builtin_scene_id(input);
  if (!builtin.empty()) return check_builtin_scene(builtin);
  if (io::is_there(input)) return;
  if (input == "-") throw UsageError("standard input (-) is not read here; name a file or folder");
  throw IoError(input, "there is no such file or folder; check the path");
}

Scene load_input(const std::string& input, const ReadOptions& options, const Progress& progress) {
  return load_input(input, io::open_schema().parse(options.options.values()), options.needs_truth,
                    progress);
}

Scene load_input(const std::string& input, const ReadOptions& options, Job& job,
                 const Progress& progress) {
  Scene scene = load_input(input, options, progress);
  for (const std::string& warning : scene.convention.warnings) job.note(warning);
  return scene;
}

Scene load_input(const std::string& input, io::OpenOptions open, bool needs_truth,
                 const Progress& progress) {
  const std::string builtin = builtin_scene_id(input);
  if (!builtin.empty()) check_builtin_scene(builtin);
  return open_input(input, std::move(open), needs_truth, progress);
}

NamedReading reading_of(const std::string& result) {
  return {result, io::read_reading(result)};
}

Scene load_input_of(const NamedReading& result, const std::string& input,
                    const ReadOptions& options, const Progress& progress) {
  return load_input(
      input, options_for_result(result.file, result.reading, input, options.options.values()),
      options.needs_truth, progress);
}

void fail_without_source(const std::string& file, const std::string& named) {
  constexpr const char* kRemedy = "; name it with --truth INPUT";
  if (named.empty()) throw UsageError(file + " does not tell its light field" + kRemedy);
  throw IoError(file, "its light field, " + named + ", is not there" + kRemedy);
}

ViewIndex view_of(const LightField& light_field, ViewIndex view) {
  if (light_field.grid().contains(view)) return view;
  throw InvalidInput(fmt::format(
      "{} has {}×{} views, but view {} was asked for; views are counted from 0",
      light_field.info().name, light_field.grid().v, light_field.grid().u, view_text(view)));
}

void note_fit(const std::string& result, const Estimate& estimate, const Scene& scene, Job& job,
              const std::string& remedy) {
  const ResultFit fit = fit_of(estimate, scene);
  for (const std::string& sentence : fit.notes) job.note(result + ": " + sentence);
  if (fit.better) job.note(result + ": " + better_reading_text(*fit.better) + remedy);
}

void note_other_options(const NamedReading& first, const NamedReading& second, Job& job) {
  const auto tell = [&job](const NamedReading& one, const NamedReading& other) {
    const std::string options = options_missing_in(other.reading, one.reading);
    if (options.empty()) return;
    job.note("the light field of " + one.file + " was read with" + options + ", that of " +
             other.file + " was not");
  };
  if (first.reading.reader.empty() || second.reading.reader.empty()) return;
  tell(first, second);
  tell(second, first);
}

namespace {

std::vector<io::CollectionEntry> entries_at(const std::string& input, const ReadOptions& options,
                                            const Progress& progress) {
  const io::OpenOptions open = io::open_schema().parse(options.options.values());
  return collection_at(input, open, progress);
}

/// How many frames an INPUT has; 0 if it is no sequence.
int frames_of(const std::string& input, const io::OpenOptions& options) {
  if (!builtin_scene_id(input).empty()) return 0;
  const io::FoundReader found = io::find_reader(input, options);
  const bool is_sequence = found.reader && std::string(found.reader->id) == io::kSequenceReader;
  return is_sequence ? found.reader->probe(found.path, options).frames : 0;
}

/// An INPUT that stands for itself.
io::CollectionEntry single(const std::string& input, const io::OpenOptions& options) {
  const std::string builtin = builtin_scene_id(input);
  return {.path = input,
          .name = builtin.empty() ? io::scene_name(input) : builtin_input_name(builtin),
          .reader = {},
          .probe = {.frames = frames_of(input, options)}};
}

void add_frames(const io::CollectionEntry& entry, const std::string& name,
                std::vector<SceneInput>& scenes) {
  const auto digits = std::to_string(entry.probe.frames - 1).size();
  for (int frame = 0; frame < entry.probe.frames; ++frame) {
    scenes.push_back(
        {entry.path.string(), fmt::format("{}_frame_{:0{}}", name, frame, digits), frame});
  }
}

/// What an INPUT stands for.
std::vector<io::CollectionEntry> entries_of(const std::string& input, const ReadOptions& options,
                                            const Progress& progress) {
  check_input(input);
  std::vector<io::CollectionEntry> entries = entries_at(input, options, progress);
  if (entries.empty()) {
    entries.push_back(single(input, io::open_schema().parse(options.options.values())));
  }
  return entries;
}

std::vector<SceneInput> named(const std::vector<io::CollectionEntry>& all, Frames frames) {
  const std::vector<std::string> names = unique_names(all);
  std::vector<SceneInput> scenes;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (frames == Frames::All && all[i].probe.frames > 0) {
      add_frames(all[i], names[i], scenes);
    } else {
      scenes.push_back({all[i].path.string(), names[i]});
    }
  }
  return scenes;
}

}  // namespace

std::vector<SceneInput> scene_inputs(const std::vector<std::string>& inputs,
                                     const ReadOptions& options, Frames frames,
                                     const Progress& progress) {
  std::vector<io::CollectionEntry> all;
  for (const std::string& input : inputs) {
    std::ranges::move(entries_of(input, options, progress), std::back_inserter(all));
  }
  return named(all, frames);
}

std::vector<SceneInput> scene_inputs_and_failed(const std::vector<std::string>& inputs,
                                                const ReadOptions& options, Frames frames,
                                                const Progress& progress) {
  std::vector<io::CollectionEntry> all;
  for (const std::string& input : inputs) {
    try {
      std::ranges::move(entries_of(input, options, progress), std::back_inserter(all));
    } catch (const IoError&) {
      all.push_back({.path = input, .name = io::scene_name(input), .reader = {}, .probe = {}});
    }
  }
  return named(all, frames);
}

bool is_collection(const std::string& input, const ReadOptions& options, const Progress& progress) {
  return !entries_at(input, options, progress).empty();
}

ManyAnswers answers_of_many(const std::vector<SceneInput>& scenes, Job& job,
                            const std::function<Json(const SceneInput&, const Progress&)>& work) {
  ManyAnswers answers;
  const auto count = static_cast<double>(scenes.size());
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto done = static_cast<double>(i);
    const Progress part =
        job.progress().part(done / count, (done + 1) / count).titled(scenes[i].name);
    try {
      answers.results.push_back(work(scenes[i], part));
    } catch (const Error& error) {
      answers.failures.add(error.what());
      answers.results.push_back({{"input", scenes[i].input}, {"error", error.what()}});
      job.note(error.what());
    }
  }
  job.finish();
  return answers;
}

void ManyAnswers::finish(Job& job, bool is_json) {
  const std::size_t count = results.size();
  std::vector<std::string> written;
  for (const Json& result : results) {
    if (!result.contains("written")) continue;
    std::ranges::copy(result["written"], std::back_inserter(written));
  }
  if (is_json) {
    print_answer(Json::object({{"results", std::move(results)}}), job.notes(), written);
  }
  failures.require_none(count);
}

}  // namespace episcope::cli
