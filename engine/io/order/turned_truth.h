// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/disparity_field.h"
#include "engine/core/light_field/light_field.h"

#include <string>

namespace episcope::io {

/// Truth of a single view that was written with its rows from bottom to top (a PFM file by a
/// program that forgets that PFM does so), or of a square view with rows and columns exchanged (an
/// array by MATLAB), hardly explains the views. Where one of these, or both, explains them far
/// better (error after warping below 0.6 of that as stored and of that without warping), puts the
/// map right and returns what it undid, such as "rows from bottom to top"; empty if it left the map
/// as it is. Truth of several views is left alone.
[[nodiscard]] std::string put_truth_upright(const LightField::Samples& samples,
                                            DisparityField& field);

}  // namespace episcope::io
