// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/scene/builtin_inputs.h"

#include "app/session/scene/gantry_scene.h"
#include "engine/core/error.h"
#include "engine/core/parameter/parameter.h"
#include "engine/core/text/join.h"
#include "engine/scenes/request.h"

#include <algorithm>
#include <tuple>

namespace episcope {

std::vector<scenes::BuiltinSceneInfo> builtin_inputs() {
  std::vector<scenes::BuiltinSceneInfo> all = scenes::builtin_scenes();
  const auto random = std::ranges::find(all, scenes::kRandomScene, &scenes::BuiltinSceneInfo::id);
  all.insert(random,
             {kGantryScene,
              "photographs of a gantry, to calibrate, rectify and give a depth from a scan"});
  return all;
}

void require_builtin_input(const std::string& id) {
  const std::string scene = id.substr(0, id.find('?'));
  std::vector<std::string> ids;
  for (const scenes::BuiltinSceneInfo& each : builtin_inputs()) ids.push_back(each.id);
  if (std::ranges::find(ids, scene) == ids.end()) {
    throw Unavailable(no_such_name("built-in scene", scene, ids) + " (there are " +
                      joined(ids, ", ") + ")");
  }
  if (is_gantry(id)) {
    std::ignore = gantry_options(id);
  } else {
    std::ignore = scenes::read_request(id);
  }
}

std::string builtin_input_name(const std::string& id) {
  return is_gantry(id) ? kGantryScene : scenes::read_request(id).name();
}

}  // namespace episcope
