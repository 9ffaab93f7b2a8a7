// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/overlay_map.h"

namespace episcope {

/// Completes the source of a map of the segmentation. Nothing if there is no such map for the view.
[[nodiscard]] std::optional<OverlaySource> segment_source(const Session& session,
                                                          OverlaySource source);

/// Makes it on any thread.
[[nodiscard]] std::shared_ptr<const OverlayMap> make_segment_map(const OverlaySource& source);

}  // namespace episcope
