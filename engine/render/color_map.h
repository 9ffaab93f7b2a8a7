// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/label_info.h"

#include <array>
#include <string>
#include <vector>

namespace episcope::render {

using episcope::Rgb;

/// 256 colors from low to high, with a color for invalid pixels.
struct ColorMap {
  std::string name;
  std::array<Rgb, 256> colors{};
  Rgb invalid{};

  /// `value` mapped from [min, max], clamped; NaN gives `invalid`.
  [[nodiscard]] Rgb color(double value, double min, double max) const;
};

/// "viridis", "seismic", "blue-orange", "ylorrd", "rdylgn_r", "grey", "magma", "turbo".
[[nodiscard]] std::vector<std::string> color_map_names();

/// Throws InvalidInput for an unknown name, naming the nearest.
[[nodiscard]] ColorMap color_map(const std::string& name);

}  // namespace episcope::render
