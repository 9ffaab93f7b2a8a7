// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"

#include <string>

namespace episcope {

/// 16 hexadecimal digits that change with anything of a scene that a judged run depends on: the
/// samples, camera and promised range of the light field, truth and region masks of its centre
/// view. Linear in the samples.
[[nodiscard]] std::string scene_fingerprint(const Scene& scene);

/// 16 hexadecimal digits of a text (FNV-1a).
[[nodiscard]] std::string text_fingerprint(const std::string& text);

}  // namespace episcope
