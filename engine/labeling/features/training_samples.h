// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/light_field/scene.h"
#include "engine/labeling/features/pixel_features.h"
#include "engine/labeling/forest/forest.h"

#include <cstdint>
#include <vector>

namespace episcope {

/// Ids that are painted on any view, ascending. Throws InvalidInput if nothing or only one label is
/// painted, or if scribbles do not fit the light field.
[[nodiscard]] std::vector<std::int32_t> painted_labels(const Scribbles& scribbles,
                                                       const LightField& light_field);

/// Appends the painted pixels of a view; `ids` (ascending) gives the index of each label.
/// Occasional features are the place, because short strokes say little about where the rest of a
/// label is, and the slope of disparity, because strokes lie in the middle of things: what is thin
/// lies beside a jump everywhere (tests/accuracy/tuning.md).
void append_samples(const ViewScribbles& painted, VolumeView<const float> features,
                    const std::vector<std::int32_t>& ids, ForestSamples& samples);

}  // namespace episcope
