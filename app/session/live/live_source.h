// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/pixel_rect.h"
#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"
#include "engine/core/parameter/parameter.h"

#include <optional>
#include <utility>

namespace episcope {

/// A light field as live estimates read it; what one of them made is kept for the next. For one
/// thread at a time. All functions throw Cancelled.
class LiveSource {
 public:
  explicit LiveSource(LightFieldPtr light_field) : light_field_(std::move(light_field)) {}

  [[nodiscard]] const LightFieldPtr& light_field() const { return light_field_; }
  /// The range that a method would search if its parameter were `wanted` (`search_range`).
  [[nodiscard]] Interval range(const IntervalOrAuto& wanted, const Progress& progress);
  /// The pixels `part` of all views; the whole light field is not copied.
  [[nodiscard]] LightFieldPtr full(const PixelRect& part, const Progress& progress);
  /// The same at a quarter of the size (`kLiveFactor`): all facts but the range of disparities are
  /// those of the light field. Precondition: `part` begins at multiples of it.
  [[nodiscard]] LightFieldPtr coarse(const PixelRect& part, const Progress& progress);

 private:
  LightFieldPtr light_field_;
  LightFieldPtr smaller_;          // the whole
  LightFieldPtr part_;             // the one cut out last,
  PixelRect cut_;                  // which is this
  std::optional<Interval> found_;  // whatever files promise
};

}  // namespace episcope
