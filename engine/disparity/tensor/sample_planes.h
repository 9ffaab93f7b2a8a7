// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"

#include <vector>

namespace episcope {

/// How samples of invalid pixels (LightField::valid) are read. NaN goes through every filter, so
/// that whatever an invalid sample entered can be told, and left out, at the end.
enum class InvalidSamples { AsStored, AsNan };

/// Reads samples of a light field as float planes in [0, 1], one plane for each channel, whatever
/// type they are stored in. Use one object per thread; valid as long as the light field.
class SamplePlanes {
 public:
  explicit SamplePlanes(const LightField& light_field,
                        InvalidSamples invalid = InvalidSamples::AsStored);

  /// Row `y` of a view, columns [x0, x1) within the image: out[c][i] is channel c of column x0 + i.
  void read(ViewIndex view, int y, int x0, int x1, float* const* out);

  /// As `read`, but row and columns may lie outside the image, which repeats its border there.
  void read_clamped(ViewIndex view, int y, int x0, int x1, float* const* out);

 private:
  void invalidate(ViewIndex view, int y, int x0, int x1, float* const* out) const;

  const LightField& light_field_;
  bool invalid_as_nan_ = false;
  std::vector<float> interleaved_;
};

}  // namespace episcope
