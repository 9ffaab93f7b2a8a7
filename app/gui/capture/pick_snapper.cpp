// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/capture/pick_snapper.h"

#include "engine/capture/rectify/grey_view.h"

namespace episcope {

std::optional<capture::SnappedPick> PickSnapper::snap(const LightFieldPtr& light_field,
                                                      PixelIndex pixel) {
  if (light_field_.lock() != light_field) {
    grey_ = capture::grey_view(*light_field, light_field->center());
    light_field_ = light_field;
  }
  return capture::snap_pick(
      grey_.view(), {static_cast<double>(pixel.x), static_cast<double>(pixel.y)}, kReach_px);
}

}  // namespace episcope
