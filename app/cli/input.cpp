// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/input.h"

#include "app/cli/arguments.h"
#include "app/cli/usage_error.h"
#include "app/session/load_scene.h"
#include "engine/scenes/builtin.h"

#include <algorithm>
#include <array>
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

constexpr double kMostFocus = 1000;  // px

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

/// Options that nothing came of.
void warn_of_ignored(const ReadOptions& options, bool is_builtin, ConventionReport& report) {
  const bool is_overridden = options.flip != "auto" || options.units != "auto";
  const bool names_images = !options.pattern.empty() || options.is_snake;
  if (is_builtin && (is_overridden || names_images)) {
    report.warnings.emplace_back("options of reading are ignored, for a built-in scene has none.");
  } else if (names_images && report.format.starts_with("archive (")) {
    report.warnings.emplace_back("--pattern and --snake are ignored, for this is " + report.format +
                                 " and no grid of images.");
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
  arguments.option("--focus", options.focus, "PX",
                   "Focus plane to bake in: what has this disparity gets 0");
}

bool parse_reading(Arguments& parser, const std::vector<std::string>& arguments, JobOptions& job,
                   ReadOptions& read) {
  declare_job_options(parser, job);
  declare_read_options(parser, read);
  return parser.parse(arguments);
}

void check_input(const std::string& input) {
  const std::string builtin = builtin_scene_id(input);
  std::error_code ignored;
  if (!builtin.empty()) return check_builtin_scene(builtin);
  if (std::filesystem::exists(input, ignored)) return;
  throw IoError(input, "there is no such file or folder; check the path");
}

Scene load_input(const std::string& input, const ReadOptions& options, const Progress& progress) {
  const std::string builtin = builtin_scene_id(input);
  if (!builtin.empty()) check_builtin_scene(builtin);
  LoadOptions load;
  load.open.flip = value_of(kFlips, options.flip);
  load.open.units = value_of(kUnits, options.units);
  load.open.pattern = options.pattern;
  load.open.snake = options.is_snake;
  load.open.focus_px = parse_real("--focus", options.focus, -kMostFocus, kMostFocus);
  load.needs_truth = options.needs_truth;
  load.cache_folder = default_cache_folder();
  progress.step("reading " + std::filesystem::path(input).filename().string());
  Scene scene = load_scene(input, load, progress.part(0, builtin.empty() ? 1 : 0.9));
  warn_of_ignored(options, !builtin.empty(), scene.convention);
  if (!builtin.empty()) store_in_cache(input, scene, load.cache_folder, progress.part(0.9, 1));
  return scene;
}

}  // namespace episcope::cli
