// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/scenes/builtin.h"

#include <string>
#include <vector>

namespace episcope {

/// All that can follow `demo:`: the built-in scenes, which have ground truth, and the gantry
/// (gantry_scene.h), before the random one.
[[nodiscard]] std::vector<scenes::BuiltinSceneInfo> builtin_inputs();

/// Throws Unavailable for an unknown scene, naming the nearest and all, and InvalidInput for
/// options that cannot be read. `id`: what follows `demo:`.
void require_builtin_input(const std::string& id);

/// For lists and files (scenes::builtin_name). Throws likewise.
[[nodiscard]] std::string builtin_input_name(const std::string& id);

}  // namespace episcope
