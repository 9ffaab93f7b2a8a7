// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/picture.h"

#include "engine/core/epi.h"
#include "engine/core/error.h"
#include "engine/core/image.h"

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

constexpr int kAlpha = 3;

void check_line(const char* name, int line, int count) {
  if (line >= 0 && line < count) return;
  throw InvalidInput(std::string("there is no image ") + name + " " + std::to_string(line) +
                     "; they count from 0 to " + std::to_string(count - 1));
}

RgbaImage stretched(const RgbaImage& picture) {
  RgbaImage tall(picture.height() * kEpiRowHeight, picture.width(), picture.channels());
  const std::size_t row_size = static_cast<std::size_t>(picture.width()) * picture.channels();
  for (int y = 0; y < tall.height(); ++y) {
    std::copy_n(picture.row(y / kEpiRowHeight), row_size, tall.row(y));
  }
  return tall;
}

// Calls `change` with every pixel that is not judged; labels are all shown.
template <class Change>
RgbaImage shaded(const QuantityMap& map, const render::Shading& shading, const Change& change) {
  if (!map.labels.empty()) {
    return render::shade_labels(map.labels, map.label_infos, map.label_style);
  }
  RgbaImage picture = render::shade(map.map, map.valid, shading);
  if (map.inside.empty()) return picture;
  for (int y = 0; y < picture.height(); ++y) {
    const std::uint8_t* inside = map.inside.row(y);
    for (int x = 0; x < picture.width(); ++x) {
      if (inside[x] == 0) change(&picture.at(y, x));
    }
  }
  return picture;
}

}  // namespace

RgbaImage overlay_picture(const QuantityMap& map, const render::Shading& shading) {
  return shaded(map, shading, [](std::uint8_t* pixel) { pixel[kAlpha] = 0; });
}

RgbaImage map_picture(const QuantityMap& map, const render::Shading& shading) {
  return shaded(map, shading, [&shading](std::uint8_t* pixel) {
    std::copy(shading.map.invalid.begin(), shading.map.invalid.end(), pixel);
  });
}

RgbaImage blended(const RgbaImage& under, const RgbaImage& over, double opacity) {
  RgbaImage picture = under;
  const int weight = static_cast<int>(std::lround(opacity * 256));
  for (int y = 0; y < picture.height(); ++y) {
    std::uint8_t* below = picture.row(y);
    const std::uint8_t* above = over.row(y);
    for (int x = 0; x < picture.width(); ++x, below += 4, above += 4) {
      const int part = above[kAlpha] * weight / 255;
      for (int c = 0; c < kAlpha; ++c) {
        below[c] = static_cast<std::uint8_t>(below[c] + (above[c] - below[c]) * part / 256);
      }
    }
  }
  return picture;
}

RgbaImage horizontal_epi_picture(const LightField& light_field, ViewIndex view, int y) {
  check_line("row", y, light_field.height());
  return stretched(render::shade_samples(horizontal_epi(light_field, view, y).view()));
}

RgbaImage vertical_epi_picture(const LightField& light_field, ViewIndex view, int x) {
  check_line("column", x, light_field.width());
  return transposed(stretched(render::shade_samples(vertical_epi(light_field, view, x).view())));
}

render::Shading shading_of(render::Quantity quantity, Interval disparity_range,
                           const ShadingChoice& choice) {
  render::Shading shading = render::default_shading(quantity, disparity_range);
  if (!choice.color_map.empty()) shading.map = render::color_map(choice.color_map);
  if (choice.range) shading.range = *choice.range;
  return shading;
}

}  // namespace episcope
