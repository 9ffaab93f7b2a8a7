// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/pose/snap_pick.h"
#include "engine/core/array/indices.h"
#include "engine/core/light_field/light_field.h"

#include <memory>
#include <optional>

namespace episcope {

/// Moves picks in the centre view to the corner or blob beside them. Keeps the grey centre view of
/// the last light field.
class PickSnapper {
 public:
  static constexpr double kReach_px = 5;

  [[nodiscard]] std::optional<capture::SnappedPick> snap(const LightFieldPtr& light_field,
                                                         PixelIndex pixel);

 private:
  std::weak_ptr<const LightField> light_field_;
  Image<float> grey_;
};

}  // namespace episcope
