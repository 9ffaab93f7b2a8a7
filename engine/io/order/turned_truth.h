// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/disparity_field.h"
#include "engine/core/light_field/light_field.h"

#include <string>

namespace episcope::io {

/// Truth that was written with its rows from bottom to top (a PFM file by a program that forgets
/// that PFM does so), mirrored, or of square views with rows and columns exchanged (an array by
/// MATLAB), hardly explains the views. Where one of these explains the centre view, or the only
/// one, far better (error after warping below 0.6 of that as stored and of that without warping),
/// puts all maps right and returns what it undid, such as "rows from bottom to top"; empty if it
/// left them as they are.
[[nodiscard]] std::string put_truth_upright(const LightField::Samples& samples,
                                            DisparityField& field);

}  // namespace episcope::io
