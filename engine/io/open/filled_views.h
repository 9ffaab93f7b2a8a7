// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/open/view_brightness.h"
#include "engine/io/open/view_crop.h"

#include <string>

namespace episcope::io {

/// The largest grid around the centre without the dark views at the corners of the stored one, as a
/// round pupil leaves them. All views where fewer than two corners are dark, and where no grid is
/// left: dark views among others (a camera that failed) make no crop.
[[nodiscard]] ViewCrop filled_crop(const ViewBrightness& brightness);

/// "12×12 of 14×14 views kept: outer views are dark (mean 2 % of the centre's); --crop all keeps
/// them", for the report.
[[nodiscard]] std::string crop_text(const ViewCrop& crop, const ViewBrightness& brightness);

}  // namespace episcope::io
