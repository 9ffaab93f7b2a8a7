// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/camera/lens.h"
#include "engine/core/array/image.h"

#include <array>
#include <optional>

namespace episcope::capture {

/// Where a patch was found again.
struct PatchMatch {
  PlanePoint place;  ///< In px.
  double gain = 1;   ///< Brightness there by that of the patch.
};

/// A square of a picture that is looked for in others, to sub-pixel precision, whatever their gain
/// and offset: Gauss and Newton on shift, gain and offset (Baker, Matthews: Lucas-Kanade 20 years
/// on, IJCV 2004, with the constant Jacobian of the template).
class Patch {
 public:
  static constexpr int kReach = 8;
  static constexpr int kSide = 2 * kReach + 1;

  /// Around a whole pixel. Precondition: at least kReach + 1 px from the border.
  Patch(ImageView<const float> picture, int y, int x);

  /// Nothing if it is not found within 2 px of `guess`, does not look alike, or has no texture.
  [[nodiscard]] std::optional<PatchMatch> find(ImageView<const float> picture,
                                               const PlanePoint& guess) const;

 private:
  static constexpr int kCount = kSide * kSide;
  std::array<float, kCount> template_{};
  std::array<std::array<float, kCount>, 4> update_{};  ///< (JᵀJ)⁻¹Jᵀ by x, y, gain, offset.
  double contrast_ = 0;                                ///< Standard deviation.
};

}  // namespace episcope::capture
