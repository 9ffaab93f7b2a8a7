// SPDX-License-Identifier: BSD-3-Clause
#include "engine/render/color_map.h"

#include "engine/core/error.h"
#include "engine/core/parameter.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace episcope::render {
namespace {

// Colors 0xRRGGBB at equal steps from low to high; between them is interpolated linearly.
// viridis and magma: S. van der Walt, N. Smith 2015 (CC0). turbo: A. Mikhailov 2019 (Apache 2.0),
// every fifth entry. YlOrRd and RdYlGn: C. Brewer, colorbrewer2.org.
constexpr std::uint32_t kViridis[] = {
    0x440154, 0x46085c, 0x471063, 0x481769, 0x481d6f, 0x482475, 0x472a7a, 0x46307e, 0x453781,
    0x433d84, 0x414287, 0x3f4889, 0x3d4e8a, 0x3a538b, 0x38598c, 0x355e8d, 0x33638d, 0x31688e,
    0x2e6d8e, 0x2c718e, 0x2a768e, 0x297b8e, 0x27808e, 0x25848e, 0x23898e, 0x218e8d, 0x20928c,
    0x1f978b, 0x1e9c89, 0x1fa188, 0x21a585, 0x24aa83, 0x28ae80, 0x2eb37c, 0x35b779, 0x3dbc74,
    0x46c06f, 0x50c46a, 0x5ac864, 0x65cb5e, 0x70cf57, 0x7cd250, 0x89d548, 0x95d840, 0xa2da37,
    0xb0dd2f, 0xbddf26, 0xcae11f, 0xd8e219, 0xe5e419, 0xf1e51d, 0xfde725};
constexpr std::uint32_t kMagma[] = {
    0x000004, 0x02020b, 0x050416, 0x090720, 0x0e0b2b, 0x140e36, 0x1a1042, 0x21114e, 0x29115a,
    0x311165, 0x390f6e, 0x420f75, 0x4a1079, 0x52137c, 0x5a167e, 0x621980, 0x6a1c81, 0x721f81,
    0x792282, 0x812581, 0x892881, 0x912b81, 0x992d80, 0xa1307e, 0xaa337d, 0xb2357b, 0xba3878,
    0xc23b75, 0xca3e72, 0xd2426f, 0xd9466b, 0xe04c67, 0xe75263, 0xec5860, 0xf1605d, 0xf4695c,
    0xf7725c, 0xf97b5d, 0xfb8560, 0xfc8e64, 0xfd9869, 0xfea16e, 0xfeaa74, 0xfeb47b, 0xfebd82,
    0xfec68a, 0xfecf92, 0xfed89a, 0xfde2a3, 0xfdebac, 0xfcf4b6, 0xfcfdbf};
constexpr std::uint32_t kTurbo[] = {
    0x30123b, 0x36215f, 0x3b2f80, 0x3f3e9c, 0x424bb5, 0x4559cb, 0x4666dd, 0x4773eb, 0x4680f6,
    0x458cfd, 0x4099ff, 0x38a5fb, 0x2fb2f4, 0x27bee9, 0x1fc9dd, 0x1ad4d0, 0x18ddc2, 0x1ae4b6,
    0x22ebaa, 0x2ff19b, 0x3ff68a, 0x52fa7a, 0x65fd69, 0x79fe59, 0x8bff4b, 0x9cfe40, 0xa9fb39,
    0xb7f735, 0xc3f134, 0xd0ea34, 0xdbe236, 0xe5d938, 0xeecf3a, 0xf5c53a, 0xfaba39, 0xfdae35,
    0xfea130, 0xfe932a, 0xfc8423, 0xf9751d, 0xf46617, 0xef5811, 0xe84b0c, 0xe14109, 0xd83706,
    0xce2d04, 0xc32503, 0xb71d02, 0xa91601, 0x9b0f01, 0x8b0902, 0x7a0403};
constexpr std::uint32_t kSeismic[] = {0x00004c, 0x0000ff, 0xffffff, 0xff0000, 0x7f0000};
constexpr std::uint32_t kBlueOrange[] = {0x08306b, 0x2171b5, 0x6baed6, 0xdeebf7, 0xffffff,
                                         0xfee6ce, 0xfd8d3c, 0xd94801, 0x7f2704};
constexpr std::uint32_t kYlOrRd[] = {0xffffcc, 0xffeda0, 0xfed976, 0xfeb24c, 0xfd8d3c,
                                     0xfc4e2a, 0xe31a1c, 0xbd0026, 0x800026};
constexpr std::uint32_t kRdYlGnReversed[] = {0x006837, 0x1a9850, 0x66bd63, 0xa6d96a,
                                             0xd9ef8b, 0xffffbf, 0xfee08b, 0xfdae61,
                                             0xf46d43, 0xd73027, 0xa50026};
constexpr std::uint32_t kGrey[] = {0x000000, 0xffffff};

// Invalid pixels: a color that the map itself does not hold.
constexpr std::uint32_t kInvalidGrey = 0x6e6e6e;
constexpr std::uint32_t kInvalidMagenta = 0xb000b0;
constexpr std::uint32_t kInvalidBlue = 0x24478f;

struct MapSource {
  const char* name;
  std::span<const std::uint32_t> colors;
  std::uint32_t invalid;
};

constexpr MapSource kSources[] = {
    {"viridis", kViridis, kInvalidGrey},
    {"seismic", kSeismic, kInvalidGrey},
    {"blue-orange", kBlueOrange, kInvalidGrey},
    {"ylorrd", kYlOrRd, kInvalidGrey},
    {"rdylgn_r", kRdYlGnReversed, kInvalidGrey},
    {"grey", kGrey, kInvalidBlue},
    {"magma", kMagma, kInvalidGrey},
    {"turbo", kTurbo, kInvalidMagenta},
};

Rgb unpacked(std::uint32_t color) {
  return {static_cast<std::uint8_t>(color >> 16), static_cast<std::uint8_t>(color >> 8),
          static_cast<std::uint8_t>(color)};
}

/// Color at `position` in [0, 1].
Rgb interpolated(std::span<const std::uint32_t> colors, double position) {
  const double place = position * static_cast<double>(colors.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), colors.size() - 2);
  const double share = place - static_cast<double>(below);
  const Rgb low = unpacked(colors[below]);
  const Rgb high = unpacked(colors[below + 1]);
  Rgb color{};
  for (std::size_t c = 0; c < color.size(); ++c) {
    color[c] = static_cast<std::uint8_t>(std::lround(low[c] + share * (high[c] - low[c])));
  }
  return color;
}

}  // namespace

Rgb ColorMap::color(double value, double min, double max) const {
  if (std::isnan(value)) return invalid;
  const double position = max > min ? (value - min) / (max - min) : (value >= max ? 1 : 0);
  const double last = static_cast<double>(colors.size() - 1);
  return colors[static_cast<std::size_t>(std::lround(std::clamp(position, 0.0, 1.0) * last))];
}

std::vector<std::string> color_map_names() {
  std::vector<std::string> names;
  for (const auto& source : kSources) names.emplace_back(source.name);
  return names;
}

ColorMap color_map(const std::string& name) {
  for (const auto& source : kSources) {
    if (name != source.name) continue;
    ColorMap map{name, {}, unpacked(source.invalid)};
    for (std::size_t i = 0; i < map.colors.size(); ++i) {
      const double last = static_cast<double>(map.colors.size() - 1);
      map.colors[i] = interpolated(source.colors, static_cast<double>(i) / last);
    }
    return map;
  }
  throw InvalidInput(no_such_name("color map", name, color_map_names()));
}

}  // namespace episcope::render
