// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/plenoptic/decode.h"
#include "engine/capture/plenoptic/synthetic_camera.h"
#include "engine/core/light_field.h"

#include <string>

namespace episcope::test {

/// What a decoder gets wrong, against a camera that is known.
struct ChainErrors {
  double center_px = 0;      ///< Lens centers, rms.
  double disparity_px = 0;   ///< Median difference of st_ch_s in the center view from ideal views.
  double slope_percent = 0;  ///< Slopes of horizontal EPIs against vertical ones.
  double row_shift_px = 0;   ///< Of odd rows against even rows.
  double brightness_percent = 0;  ///< Largest difference of the mean of a view from the ideal one.
  double level = 1;               ///< Mean of all views over ideal ones.
  capture::Decoded decoded;
  [[nodiscard]] std::string text() const;
};

/// Exposes a built-in scene with the camera, decodes it, and compares.
[[nodiscard]] ChainErrors chain_errors(const std::string& scene,
                                       const capture::SyntheticCamera& camera,
                                       bool has_white = true);

}  // namespace episcope::test
