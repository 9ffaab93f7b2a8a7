// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/ground_truth.h"
#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"
#include "engine/io/blender/render_manifest.h"
#include "engine/io/open/open_options.h"

namespace episcope::io {

/// Disparity, layers and labels of the views of `crop`, or with MapViews::Center the disparity of
/// the centre view alone. Pixels in which a transparent surface is seen before another have layers
/// and no one disparity. Throws IoError for maps that are missing or of another size; Cancelled.
[[nodiscard]] GroundTruth read_render_truth(const RenderManifest& manifest, const ViewCrop& crop,
                                            MapViews views, bool needs_labels,
                                            const Progress& progress);

}  // namespace episcope::io
