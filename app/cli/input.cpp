// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/input.h"

#include "app/cli/arguments.h"
#include "app/cli/usage_error.h"
#include "app/session/load_scene.h"
#include "engine/io/result_file.h"
#include "engine/scenes/builtin.h"

#include <unistd.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace episcope::cli {
namespace {

using Flip = io::OpenOptions::Flip;
using Units = io::OpenOptions::Units;

constexpr std::array<std::pair<const char*, Flip>, 5> kFlips{{{"auto", Flip::Auto},
                                                              {"none", Flip::None},
                                                              {"u", Flip::U},
                                                              {"v", Flip::V},
                                                              {"both", Flip::Both}}};
constexpr std::array<std::pair<const char*, Units>, 3> kUnits{
    {{"auto", Units::Auto},
     {"with-width", Units::WithWidth},
     {"without-width", Units::WithoutWidth}}};

template <class Choices>
std::vector<std::string> names_of(const Choices& choices) {
  std::vector<std::string> names;
  for (const auto& [name, value] : choices) names.emplace_back(name);
  return names;
}

template <class Choices>
auto value_of(const Choices& choices, const std::string& name) {
  const auto found = std::find_if(choices.begin(), choices.end(),
                                  [&](const auto& choice) { return name == choice.first; });
  return found->second;  // the parser let nothing else through
}

void check_builtin_scene(const std::string& id) {
  std::vector<std::string> ids;
  for (const auto& scene : scenes::builtin_scenes()) ids.push_back(scene.id);
  if (std::find(ids.begin(), ids.end(), id) == ids.end()) {
    throw unknown_name("built-in scene", id, ids);
  }
}

}  // namespace

void declare_read_options(Arguments& arguments, ReadOptions& options) {
  arguments.heading("Reading");
  arguments.choice("--flip", options.flip, names_of(kFlips),
                   "View axes to reverse against the file; auto = found out and checked");
  arguments.choice("--units", options.units, names_of(kUnits),
                   "Whether dH of an archive file holds the factor xRes");
  arguments.option("--pattern", options.pattern, "NAME",
                   "Names of an image grid with {row} and {col}, or {index}");
  arguments.flag("--snake", options.is_snake,
                 "Every second row of an image grid runs from right to left");
}

Scene load_input(const std::string& input, const ReadOptions& options, const Progress& progress) {
  const std::string builtin = builtin_scene_id(input);
  if (!builtin.empty()) check_builtin_scene(builtin);
  LoadOptions load;
  load.open.flip = value_of(kFlips, options.flip);
  load.open.units = value_of(kUnits, options.units);
  load.open.pattern = options.pattern;
  load.open.snake = options.is_snake;
  load.cache_folder = default_cache_folder();
  progress.step("reading " + std::filesystem::path(input).filename().string());
  Scene scene = load_scene(input, load, progress.part(0, builtin.empty() ? 1 : 0.9));
  if (!builtin.empty()) store_in_cache(input, scene, load.cache_folder, progress.part(0.9, 1));
  return scene;
}

bool names_result(const std::string& argument) {
  std::error_code ignored;
  if (!builtin_scene_id(argument).empty()) return false;
  if (!std::filesystem::is_regular_file(argument, ignored)) return false;
  const std::string suffix = suffix_of(argument);
  return suffix == ".pfm" || suffix == ".tif" || suffix == ".tiff" || io::is_result_file(argument);
}

Estimate read_result_alone(const std::filesystem::path& path) {
  // Larger than any: a result file says itself where in the grid its views are.
  constexpr GridShape any_grid{1 << 14, 1 << 14};
  return io::read_result(path, io::is_result_file(path) ? any_grid : GridShape{1, 1});
}

std::string source_of(const Estimate& estimate) {
  std::error_code ignored;
  const bool is_there = !builtin_scene_id(estimate.source).empty() ||
                        std::filesystem::exists(estimate.source, ignored);
  return is_there ? estimate.source : std::string();
}

void note_other_source(const Estimate& estimate, const LightField& light_field, Job& job) {
  if (estimate.source_hash == 0 || estimate.source_hash == light_field.sample_hash()) return;
  job.note("the result was estimated from other samples than those of " + light_field.info().name);
}

void check_output_file(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (std::filesystem::is_directory(path, ignored)) {
    throw IoError(path, "is a folder; name a file to write");
  }
  if (!std::filesystem::is_directory(folder, ignored)) {
    throw IoError(path, "cannot be written, for the folder " + folder.string() +
                            " does not exist; make it first");
  }
  if (access(folder.c_str(), W_OK) != 0) {
    throw IoError(path, "cannot be written, for the folder " + folder.string() +
                            " is read-only; choose another one");
  }
}

std::string suffix_of(const std::filesystem::path& path) {
  std::string suffix = path.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return suffix;
}

std::string view_text(ViewIndex view) {
  return std::to_string(view.v) + "," + std::to_string(view.u);
}

}  // namespace episcope::cli
