// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/picture/map_source.h"
#include "engine/core/array/image.h"
#include "engine/core/light_field/label_info.h"
#include "engine/render/shade.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace episcope {

/// The numbers, or labels, of a quantity in one view, with everything that they are borrowed from.
struct QuantityMap {
  ImageView<const float> map;  ///< `[y][x]`; empty: there are labels instead.
  ImageView<const std::int32_t> labels;
  /// What is told of a pixel where `map` holds places of colours; empty: what `map` holds.
  ImageView<const float> measured;
  std::vector<LabelInfo> label_infos;    ///< Their colours; others have the default ones.
  render::LabelStyle label_style{};      ///< How they are drawn.
  ImageView<const std::uint8_t> valid;   ///< 0 = no value; empty = all valid.
  ImageView<const std::uint8_t> inside;  ///< 0 = not judged; empty = all are.
  Image<float> computed;
  Image<float> computed_measured;
  Image<std::uint8_t> computed_valid;
  Image<std::int32_t> computed_labels;
  std::shared_ptr<const void> owner;

  /// The numbers of the map: `measured` where there are such.
  [[nodiscard]] const ImageView<const float>& numbers() const {
    return measured.empty() ? map : measured;
  }
  /// One of them. Nothing outside the map, where nothing is judged, and where there is no value.
  [[nodiscard]] std::optional<double> value_at(PixelIndex pixel) const;
};

using QuantityMapPtr = std::shared_ptr<const QuantityMap>;

/// Makes the map; for any thread. Null for Quantity::View, whose samples are in the light field.
/// Preconditions: `reason_against(source)` is empty; there is an evaluation if the quantity is an
/// error.
[[nodiscard]] QuantityMapPtr make_map(const MapSource& source);

}  // namespace episcope
