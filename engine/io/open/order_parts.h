// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/open/assemble_scene.h"

namespace episcope::io {

/// Brings views, truth, valid pixels and positions into canonical order (`put_in_order`), after
/// rows and columns of views were swapped where the motion between them says so without doubt.
/// Adds to `report` what was done, and in which directions positions run. Throws Cancelled.
void bring_in_order(SceneParts& parts, const OpenOptions& options, ConventionReport& report,
                    const Progress& progress);

}  // namespace episcope::io
