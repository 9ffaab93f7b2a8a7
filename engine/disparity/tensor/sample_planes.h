// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"

#include <vector>

namespace episcope {

/// Reads samples of a light field as float planes in [0, 1], one plane for each channel, whatever
/// type they are stored in. Use one object per thread; valid as long as the light field.
class SamplePlanes {
 public:
  explicit SamplePlanes(const LightField& light_field);

  /// Row `y` of a view, columns [x0, x1) within the image: out[c][i] is channel c of column x0 + i.
  void read(ViewIndex view, int y, int x0, int x1, float* const* out);

  /// As `read`, but row and columns may lie outside the image, which repeats its border there.
  void read_clamped(ViewIndex view, int y, int x0, int x1, float* const* out);

 private:
  const LightField& light_field_;
  std::vector<float> interleaved_;
};

}  // namespace episcope
