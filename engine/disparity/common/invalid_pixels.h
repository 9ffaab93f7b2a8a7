// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/estimate.h"
#include "engine/core/light_field/light_field.h"
#include "engine/core/light_field/map_block.h"

#include <cstdint>

namespace episcope {

/// What pixels that hold nothing (LightField::valid) mean for estimates. A light field without a
/// mask leaves everything as it is.

/// Sets maps of some views of the light field, whole or rows from `first_row` on, to 0 where its
/// pixels are invalid.
void clear_invalid(const LightField& light_field, ViewStack<float>& maps, int first_row = 0);
void clear_invalid(const LightField& light_field, ViewStack<std::uint8_t>& maps, int first_row = 0);

/// Marks the results of invalid pixels as not valid; sets their confidence and number of layers to
/// 0.
void mark_invalid(const LightField& light_field, Estimate& estimate);
/// The same of a block that begins with row `first_row`.
void mark_invalid(const LightField& light_field, int first_row, BlockMaps& block);

/// Number of valid pixels of a view.
[[nodiscard]] std::size_t count_valid(const LightField& light_field, ViewIndex view);

}  // namespace episcope
