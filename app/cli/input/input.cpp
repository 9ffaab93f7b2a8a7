// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/input/input.h"

#include "app/cli/arguments/arguments.h"
#include "app/cli/arguments/usage_error.h"
#include "app/session/scene/builtin_inputs.h"
#include "app/session/scene/load_scene.h"
#include "engine/io/open/reader.h"

#include <fmt/format.h>

#include <algorithm>

namespace episcope::cli {
namespace {

/// Options that nothing came of.
void warn_of_ignored(const ParameterSet& given, Scene& scene) {
  const std::string& id = scene.light_field->info().reading.reader;
  const io::Reader* reader = io::reader_named(id);
  const std::string name = reader ? reader->name : "a built-in scene";
  for (const auto& [key, value] : given) {
    if (key == Reading::kFocus || (reader && reader->has_option(key))) continue;
    scene.convention.warnings.push_back(
        fmt::format("--{} is ignored, because this is {}.", key, name));
  }
}

}  // namespace

void declare_read_options(Arguments& arguments, ReadOptions& options) {
  arguments.heading("Reading");
  options.options.declare(arguments, io::open_schema().descriptions());
}

bool parse_reading(Arguments& parser, const std::vector<std::string>& arguments, JobOptions& job,
                   ReadOptions& read) {
  declare_job_options(parser, job);
  declare_read_options(parser, read);
  return parser.parse(arguments);
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
  std::error_code ignored;
  if (!builtin.empty()) return check_builtin_scene(builtin);
  if (std::filesystem::exists(input, ignored)) return;
  throw IoError(input, "there is no such file or folder; check the path");
}

Scene load_input(const std::string& input, const ReadOptions& options, const Progress& progress) {
  return load_input(input, io::open_schema().parse(options.options.values()), options.needs_truth,
                    progress);
}

Scene load_input(const std::string& input, io::OpenOptions open, bool needs_truth,
                 const Progress& progress) {
  const std::string builtin = builtin_scene_id(input);
  if (!builtin.empty()) check_builtin_scene(builtin);
  const ParameterSet given = io::given_options(open);
  const LoadOptions load{
      .open = std::move(open), .cache_folder = default_cache_folder(), .needs_truth = needs_truth};
  progress.step("reading " + std::filesystem::path(input).filename().string());
  Scene scene = load_scene(input, load, progress.part(0, builtin.empty() ? 1 : 0.9));
  warn_of_ignored(given, scene);
  if (!builtin.empty()) store_in_cache(input, scene, load.cache_folder, progress.part(0.9, 1));
  return scene;
}

}  // namespace episcope::cli
