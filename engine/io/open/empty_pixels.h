// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/open/view_brightness.h"

#include <string>

namespace episcope::io {

/// Marks as invalid (0) the pixels of views that are dark where the centre views are not, within
/// the accuracy of a cell of `brightness`: vignetting, failed cameras. Darkness that the centre
/// views share counts as the scene's own. `valid` is made where there are such pixels; where there
/// are none it stays as it is.
/// Returns a sentence for the report; empty if nothing was marked. Throws Cancelled.
std::string mark_empty_pixels(const ViewBrightness& brightness, int height, int width,
                              ViewStack<std::uint8_t>& valid, const Progress& progress);

}  // namespace episcope::io
