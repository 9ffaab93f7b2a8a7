// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/open_scene.h"

#include <string>

namespace episcope {

/// Whether the user did something on a scene but to run methods, paint and look: lines kept, points
/// paired, pixels chosen that are judged, labels hidden or locked, brightness set.
[[nodiscard]] bool has_work(const ScenePlace& place);

/// The same as a text, another one whenever something of it changes. Poses count as what they are
/// computed from.
[[nodiscard]] std::string work_text(const ScenePlace& place);

}  // namespace episcope
