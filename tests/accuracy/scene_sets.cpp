// SPDX-License-Identifier: BSD-3-Clause
#include "tests/accuracy/scene_sets.h"

#include "engine/core/error.h"
#include "engine/io/open.h"
#include "engine/scenes/builtin.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace episcope::accuracy {
namespace {

constexpr std::string_view kBuiltin = "demo:";

bool contains_any(const std::string& name, const std::vector<std::string>& parts) {
  return parts.empty() || std::ranges::any_of(parts, [&](const std::string& part) {
           return name.find(part) != name.npos;
         });
}

Scene render(const std::string& id, int size, const Progress& progress) {
  scenes::BuiltinRequest request = scenes::read_request(id);
  const scenes::RenderOptions usual;
  if (request.options.width == usual.width && request.options.height == usual.height) {
    request.options.width = request.options.height = size;
  }
  return scenes::render_builtin(request.scene, request.options, progress);
}

}  // namespace

std::vector<SceneSet> read_scene_sets(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw IoError(file, "the sets of scenes cannot be read");
  std::vector<SceneSet> sets;
  try {
    const auto json = nlohmann::ordered_json::parse(stream);
    for (const auto& [name, groups] : json.items()) {
      SceneSet& set = sets.emplace_back();
      set.name = name;
      for (const auto& [group, scenes] : groups.items()) {
        set.groups.push_back({group, scenes.get<std::vector<std::string>>()});
      }
    }
  } catch (const nlohmann::json::exception& error) {
    throw IoError(file, error.what());
  }
  return sets;
}

SceneSet scenes_with(const SceneSet& set, const std::vector<std::string>& parts) {
  SceneSet kept;
  kept.name = set.name;
  for (const SceneGroup& group : set.groups) {
    SceneGroup some{group.name, {}};
    std::ranges::copy_if(group.scenes, std::back_inserter(some.scenes),
                         [&](const std::string& name) { return contains_any(name, parts); });
    if (!some.scenes.empty()) kept.groups.push_back(std::move(some));
  }
  return kept;
}

std::optional<Scene> open_scene_of_set(const std::string& name, int size,
                                       const std::filesystem::path& data,
                                       const Progress& progress) {
  if (name.starts_with(kBuiltin)) return render(name.substr(kBuiltin.size()), size, progress);
  if (data.empty() || !std::filesystem::exists(data / name)) return std::nullopt;
  Scene scene = io::open_scene(data / name, {}, progress);
  if (!scene.truth->field.contains(scene.light_field->center())) return std::nullopt;
  return scene;
}

}  // namespace episcope::accuracy
