// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/label_info.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace episcope {
namespace {

/// Fully saturated color wheel, dimmed: `hue` in [0, 1).
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
  // Greedily, from a grid of colors: the next one is farthest from all before under normal,
  // protan, deutan and tritan vision.
  constexpr Rgb palette[] = {{230, 25, 75},  {0, 0, 255},    {255, 150, 255}, {100, 255, 0},
                             {150, 0, 100},  {150, 50, 200}, {200, 200, 100}, {255, 100, 150},
                             {150, 0, 0},    {200, 150, 0},  {100, 200, 200}, {200, 0, 255},
                             {50, 100, 150}, {200, 50, 100}, {150, 100, 0},   {100, 150, 200},
                             {50, 255, 255}, {100, 0, 200},  {255, 50, 255},  {255, 200, 150}};
  constexpr std::int32_t fixed = std::size(palette);
  if (id <= 0) return {};
  if (id <= fixed) return palette[id - 1];
  constexpr double golden_share = 0.6180339887498949;  // spreads hues evenly, however many
  return hue_color(std::fmod(id * golden_share, 1.0), id % 2 == 0 ? 1.0 : 0.65);
}

}  // namespace episcope
