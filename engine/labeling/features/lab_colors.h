// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

namespace episcope {

/// L*a*b* (CIE 1976, white D65) divided by 100 of samples in [0, 1] of one channel or three, 32-bit
/// floats; three channels of the same size.
[[nodiscard]] cv::Mat lab_colors(const cv::Mat& samples);

/// Samples of one channel as three that are equal; those of three as they are.
[[nodiscard]] cv::Mat rgb_colors(const cv::Mat& samples);

}  // namespace episcope
