// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/cli/output/json.h"
#include "engine/core/light_field/scene.h"

#include <string>

namespace episcope::cli {

/// What `info` tells of a scene that was read from `input`. Keys of what is missing are absent.
[[nodiscard]] Json scene_json(const Scene& scene, const std::string& input);

}  // namespace episcope::cli
