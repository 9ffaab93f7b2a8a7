// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/open/assemble_scene.h"

namespace episcope::io {

/// Gains that differ by less from 1 are within the accuracy of their measurement.
inline constexpr double kMeasurableGain = 0.01;

/// Tells `report` how much the brightness of the views differs from that of the centre view
/// (measure_view_gains). With `options.equalise` takes it out, unless all gains are within
/// kMeasurableGain; else says that methods even out what is notable, unless
/// `options.keep_brightness`. Of a single view there is nothing to tell. Throws Cancelled.
void equalise_views(SceneParts& parts, const OpenOptions& options, ConventionReport& report,
                    const Progress& progress);

}  // namespace episcope::io
