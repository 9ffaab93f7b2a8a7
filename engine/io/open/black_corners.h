// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"

#include <string>

namespace episcope::io {

/// Marks as invalid (0) the black corners of views that a lens cut off: where at least three
/// corners of the centre view are black wedges, each shorter than 0.3 of both sides, and four
/// fifths of their pixels are black in the views as well: what a scene shows would move. `valid` is
/// made where there are such pixels. Returns a sentence for the report; empty if nothing was
/// marked. Throws Cancelled.
std::string mark_black_corners(const LightField::Samples& samples, ViewStack<std::uint8_t>& valid,
                               const Progress& progress);

}  // namespace episcope::io
