// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/camera/lens.h"
#include "engine/core/array/image.h"

#include <array>
#include <vector>

namespace episcope::capture {

/// Resampling by Lanczos' windowed sinc of 3 lobes, at places to 1/1024 px (OpenCV's own is to 1/32
/// px, which is coarser than views are aligned).
class Lanczos {
 public:
  static constexpr int kTaps = 6;

  Lanczos();

  /// The sample at a place, times `gain`, rounded to T and limited to its range; `channels` values
  /// to `out`. Beyond the border the picture is continued by its last pixels. T: uint8, uint16,
  /// float.
  template <class T>
  void sample(ImageView<const T> picture, const PlanePoint& at, double gain, T* out) const;

 private:
  static constexpr int kSteps = 1024;
  std::vector<std::array<float, kTaps>> weights_;  ///< By the fraction.
};

}  // namespace episcope::capture
