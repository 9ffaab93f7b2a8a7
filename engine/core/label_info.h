// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace episcope {

using Rgb = std::array<std::uint8_t, 3>;

/// Name and color of a label.
struct LabelInfo {
  int id = 0;        ///< From 1; 0 is "none".
  std::string name;  ///< UTF-8, one line.
  Rgb color{};
  friend bool operator==(const LabelInfo&, const LabelInfo&) = default;
};

/// Default color of a label id: a fixed palette for 1 … 20, well separated also for those who
/// cannot tell all colors apart, further ones by hue. Black for 0 and negative ids.
[[nodiscard]] Rgb label_color(std::int32_t id);

}  // namespace episcope
