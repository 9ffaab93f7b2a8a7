// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/light_field.h"
#include "engine/core/scene.h"

#include <cstdint>
#include <vector>

namespace episcope {

/// Ids that are painted on any view, ascending. Throws InvalidInput if nothing or only one label is
/// painted, or if scribbles do not fit the light field.
[[nodiscard]] std::vector<std::int32_t> painted_labels(const Scribbles& scribbles,
                                                       const LightField& light_field);

/// Which painted views a labeler reads. A fill of all views says the same in each of them, so that
/// a few suffice; rays carry to the others what these say.

[[nodiscard]] bool have_same_strokes(const std::vector<ViewScribbles>& a,
                                     const std::vector<ViewScribbles>& b);

/// Most views whose strokes teach, unless more are needed to have every label.
inline constexpr std::size_t kTeachingViews = 8;
/// The views from which a forest learns: all, or of more than kTeachingViews those with most
/// painted pixels, the most first, and any that alone has a label.
[[nodiscard]] std::vector<const ViewScribbles*> teaching_views(
    const std::vector<ViewScribbles>& views);

/// Pixels of a view that have other strokes than before, `[y][x]`, 1 = changed.
struct NewStrokes {
  ViewIndex view;
  Image<std::uint8_t> pixels;
};
/// Most views whose new strokes are read.
inline constexpr std::size_t kNewViews = 4;
/// New strokes of each view that has some. Of more than kNewViews views one remains: `first` if it
/// has new strokes, else the one that has most.
[[nodiscard]] std::vector<NewStrokes> new_strokes(const Scribbles& former, const Scribbles& now,
                                                  ViewIndex first);

}  // namespace episcope
