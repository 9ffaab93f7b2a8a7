// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/light_field/label_info.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace episcope {
namespace {

/// Fully saturated colour wheel, dimmed: `hue` in [0, 1).
Rgb hue_color(double hue, double brightness) {
  Rgb color{};
  for (int c = 0; c < 3; ++c) {
    const double place = std::fmod(hue * 6 + 6 - 2 * c, 6.0);
    const double level = std::clamp(std::abs(place - 3) - 1, 0.0, 1.0);
    color[c] = static_cast<std::uint8_t>(std::lround(255 * brightness * (0.15 + 0.85 * level)));
  }
  return color;
}

}  // namespace

Rgb label_color(std::int32_t id) {
  constexpr Rgb palette[] = {{230, 25, 75},  {60, 180, 75},   {0, 130, 200},  {255, 225, 25},
                             {245, 130, 48}, {145, 30, 180},  {70, 240, 240}, {240, 50, 230},
                             {210, 245, 60}, {250, 190, 212}, {0, 128, 128},  {220, 190, 255},
                             {170, 110, 40}, {255, 250, 200}, {128, 0, 0},    {170, 255, 195},
                             {128, 128, 0},  {255, 215, 180}, {0, 0, 128},    {128, 128, 128}};
  constexpr std::int32_t fixed = std::size(palette);
  if (id <= 0) return {};
  if (id <= fixed) return palette[id - 1];
  constexpr double golden_share = 0.6180339887498949;  // spreads hues evenly, however many
  return hue_color(std::fmod(id * golden_share, 1.0), id % 2 == 0 ? 1.0 : 0.65);
}

}  // namespace episcope
