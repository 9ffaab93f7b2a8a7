// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/open/assemble_scene.h"

namespace episcope::io {

/// Whether options say which of the axes of views are rows and which columns.
[[nodiscard]] bool are_axes_stated(const OpenOptions& options);

/// Brings views, truth, valid pixels and positions into canonical order (`put_in_order`), after
/// rows and columns of views were swapped where the motion between them says so without doubt,
/// unless that was done already.
/// Adds to `report` what was done, and in which directions positions run. Throws Cancelled.
void bring_in_order(SceneParts& parts, const OpenOptions& options, ConventionReport& report,
                    const Progress& progress);

}  // namespace episcope::io
