// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/tensor/sample_planes.h"

#include "engine/core/parallel/isa.h"
#include "engine/disparity/tensor/structure_tensor_kernel.h"

#include <algorithm>
#include <array>
#include <limits>

namespace episcope {

SamplePlanes::SamplePlanes(const LightField& light_field, InvalidSamples invalid)
    : light_field_(light_field),
      invalid_as_nan_(invalid == InvalidSamples::AsNan && !light_field.valid().empty()) {}

void SamplePlanes::invalidate(ViewIndex view, int y, int x0, int x1, float* const* out) const {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const std::uint8_t* const valid = light_field_.valid().view(view).row(y);
  for (int x = x0; x < x1; ++x) {
    if (valid[x] != 0) continue;
    for (int c = 0; c < light_field_.channels(); ++c) out[c][x - x0] = kNan;
  }
}

void SamplePlanes::read(ViewIndex view, int y, int x0, int x1, float* const* out) {
  const int channels = light_field_.channels();
  if (light_field_.sample_type() == SampleType::UInt8) {
    const std::uint8_t* row = light_field_.view<std::uint8_t>(view).row(y);
    EPISCOPE_CHOOSE_KERNEL(best_isa(), kSampleKernel)
        .deinterleave(row + static_cast<std::size_t>(x0) * channels, x1 - x0, channels, out);
    if (invalid_as_nan_) invalidate(view, y, x0, x1, out);
    return;
  }
  interleaved_.resize(static_cast<std::size_t>(x1 - x0) * channels);
  light_field_.read_row(view, y, x0, x1, interleaved_.data());
  for (int i = 0; i < x1 - x0; ++i) {
    for (int c = 0; c < channels; ++c) out[c][i] = interleaved_[i * channels + c];
  }
  if (invalid_as_nan_) invalidate(view, y, x0, x1, out);
}

void SamplePlanes::read_clamped(ViewIndex view, int y, int x0, int x1, float* const* out) {
  const int width = light_field_.width();
  const int row = std::clamp(y, 0, light_field_.height() - 1);
  const int first = std::clamp(x0, 0, width - 1);
  const int last = std::clamp(x1, first + 1, width);
  // Where the columns that exist belong; all may lie to one side of what is wanted.
  const int begin = std::clamp(first - x0, 0, x1 - x0 - 1);
  std::array<float*, 3> inside{};
  for (int c = 0; c < light_field_.channels(); ++c) inside[c] = out[c] + begin;
  const int count = std::min(last - first, x1 - x0 - begin);
  read(view, row, first, first + count, inside.data());
  for (int c = 0; c < light_field_.channels(); ++c) {
    std::fill(out[c], inside[c], inside[c][0]);
    std::fill(inside[c] + count, out[c] + (x1 - x0), inside[c][count - 1]);
  }
}

}  // namespace episcope
