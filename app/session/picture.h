// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/quantity_map.h"
#include "engine/render/shade.h"

#include <optional>
#include <string>

namespace episcope {

/// RGBA8, `[y][x][4]`.
using RgbaImage = Image<std::uint8_t>;

/// A map in its colors; transparent where nothing is judged and where there is no label, so that
/// it can lie over the view.
[[nodiscard]] RgbaImage overlay_picture(const QuantityMap& map, const render::Shading& shading);

/// A map as a picture of its own: what is not judged has the color of invalid pixels; pixels
/// without a label are transparent.
[[nodiscard]] RgbaImage map_picture(const QuantityMap& map, const render::Shading& shading);

/// `over` on `under`, both of one size; its opaque pixels count `opacity`, in [0, 1], others less.
[[nodiscard]] RgbaImage blended(const RgbaImage& under, const RgbaImage& over, double opacity);

/// An EPI through a pixel of a view, every row of it `kEpiRowHeight` pixels high. A horizontal one
/// has x to the right and u downwards; a vertical one stands upright, y downwards and v to the
/// right. Throws InvalidInput if the line lies outside the image.
inline constexpr int kEpiRowHeight = 8;
[[nodiscard]] RgbaImage horizontal_epi_picture(const LightField& light_field, ViewIndex view,
                                               int y);
[[nodiscard]] RgbaImage vertical_epi_picture(const LightField& light_field, ViewIndex view, int x);

/// What a user may override in the colors of a quantity.
struct ShadingChoice {
  std::optional<Interval> range;
  std::string color_map{};  ///< Empty = the quantity's own.
};

/// Colors of a quantity; disparities span `disparity_range`. Throws InvalidInput for an unknown
/// color map.
[[nodiscard]] render::Shading shading_of(render::Quantity quantity, Interval disparity_range,
                                         const ShadingChoice& choice = {});

}  // namespace episcope
