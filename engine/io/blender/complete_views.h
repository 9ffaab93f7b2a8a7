// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/io/blender/render_manifest.h"

#include <string>

namespace episcope::io {

/// The largest grid around the centre whose views are all complete: the add-on renders rings around
/// the centre one after another. Throws IoError if not even the centre is complete.
[[nodiscard]] ViewCrop complete_crop(const RenderManifest& manifest);

/// "31 of 81 views are rendered so far; …", for the report; empty if all are.
[[nodiscard]] std::string progress_text(const RenderManifest& manifest, const ViewCrop& crop);

}  // namespace episcope::io
