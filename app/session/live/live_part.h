// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/pixel_rect.h"
#include "engine/core/light_field/estimate.h"
#include "engine/core/light_field/light_field.h"

#include <optional>

namespace episcope {

/// Pixels of which an estimate is made: those that are wanted, and those that a method reads for
/// them. Both are the whole view where the second would be most of it.
struct LivePart {
  PixelRect wanted;
  PixelRect read;  ///< Begins at multiples of `kLiveFactor`.
  friend bool operator==(const LivePart&, const LivePart&) = default;
};

/// How much smaller views are made for the first, coarse map.
inline constexpr int kLiveFactor = 4;

/// The part for `wanted`, seen from `view`, or from all views if there is none: lines of
/// disparities in `range` stay within what is read, and so do the surroundings that filters look
/// at. Of a global method, what lies outside would have had its influence. An empty `wanted` is the
/// whole view.
[[nodiscard]] LivePart live_part(const LightField& light_field, const PixelRect& wanted,
                                 Interval range, std::optional<ViewIndex> view);

/// An estimate of `part.read`, made smaller by `factor`, as one of the whole views of
/// `light_field`: of `view` alone, or of all that it has if there is none. Pixels outside
/// `part.wanted` are invalid; a sample of smaller views stands for the block that it is the mean
/// of.
[[nodiscard]] Estimate in_whole_views(const Estimate& estimate, const LivePart& part, int factor,
                                      const LightField& light_field, std::optional<ViewIndex> view);

}  // namespace episcope
