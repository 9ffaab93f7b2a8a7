// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/disparity_field.h"

#include <string>

namespace episcope::io {

/// Cuts maps that are larger than the views, as networks pad them, to the size of the views where
/// it is evident which part belongs to them: the rest is on all sides alike, or right and below,
/// and in every map of one value, or invalid. Returns a sentence that says what was cut off, empty
/// if nothing was: then the maps have the size of the views, or where they belong is not evident.
[[nodiscard]] std::string remove_padding(DisparityField& field, int height, int width);

}  // namespace episcope::io
