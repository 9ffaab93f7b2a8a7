// SPDX-License-Identifier: BSD-3-Clause
#include "engine/render/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace episcope::render {
namespace {

constexpr int kGlyphHeight = 7;
constexpr int kGlyphWidth = 5;
constexpr int kGlyphStep = kGlyphWidth + 1;
constexpr int kValues = 5;
constexpr int kLeastHeight = 100;  ///< Room for the values, the unit and n/a.

/// A letter of five columns, the left one in the highest bit, from top to bottom.
struct Glyph {
  char letter;
  std::array<std::uint8_t, kGlyphHeight> rows;
};

constexpr Glyph kGlyphs[] = {
    {'0', {0x0E, 0x11, 0x13, 0x15, 0x19, 0x11, 0x0E}},
    {'1', {0x04, 0x0C, 0x04, 0x04, 0x04, 0x04, 0x0E}},
    {'2', {0x0E, 0x11, 0x01, 0x02, 0x04, 0x08, 0x1F}},
    {'3', {0x1F, 0x02, 0x04, 0x02, 0x01, 0x11, 0x0E}},
    {'4', {0x02, 0x06, 0x0A, 0x12, 0x1F, 0x02, 0x02}},
    {'5', {0x1F, 0x10, 0x1E, 0x01, 0x01, 0x11, 0x0E}},
    {'6', {0x06, 0x08, 0x10, 0x1E, 0x11, 0x11, 0x0E}},
    {'7', {0x1F, 0x01, 0x02, 0x04, 0x08, 0x08, 0x08}},
    {'8', {0x0E, 0x11, 0x11, 0x0E, 0x11, 0x11, 0x0E}},
    {'9', {0x0E, 0x11, 0x11, 0x0F, 0x01, 0x02, 0x0C}},
    {'-', {0x00, 0x00, 0x00, 0x1F, 0x00, 0x00, 0x00}},
    {'+', {0x00, 0x04, 0x04, 0x1F, 0x04, 0x04, 0x00}},
    {'.', {0x00, 0x00, 0x00, 0x00, 0x00, 0x0C, 0x0C}},
    {'/', {0x00, 0x01, 0x02, 0x04, 0x08, 0x10, 0x00}},
    {'a', {0x00, 0x00, 0x0E, 0x01, 0x0F, 0x11, 0x0F}},
    {'e', {0x00, 0x00, 0x0E, 0x11, 0x1F, 0x10, 0x0E}},
    {'n', {0x00, 0x00, 0x16, 0x19, 0x11, 0x11, 0x11}},
    {'p', {0x00, 0x00, 0x1E, 0x11, 0x1E, 0x10, 0x10}},
    {'x', {0x00, 0x00, 0x11, 0x0A, 0x04, 0x0A, 0x11}},
};

/// A canvas whose coordinates are those of the picture.
class Canvas {
 public:
  Canvas(int height, int width, int scale) : image_(height, width, 4), scale_(scale) {
    std::fill_n(image_.data(), image_.size(), std::uint8_t{255});
  }

  void fill(PixelRect rect, Rgb color) {
    for (int y = rect.y0; y < std::min(rect.y1, image_.height()); ++y) {
      for (int x = rect.x0; x < std::min(rect.x1, image_.width()); ++x) {
        std::ranges::copy(color, &image_.at(y, x));
      }
    }
  }

  /// Black, with its upper left corner there; letters without a glyph are left blank.
  void write(std::string_view text, int y, int x) {
    for (const char letter : text) {
      const auto glyph = std::ranges::find(kGlyphs, letter, &Glyph::letter);
      if (glyph != std::end(kGlyphs)) draw(*glyph, y, x);
      x += kGlyphStep * scale_;
    }
  }

  /// On white where it is transparent.
  void place(const Image<std::uint8_t>& picture) {
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        const std::uint8_t* from = &picture.at(y, x);
        std::uint8_t* to = &image_.at(y, x);
        for (int c = 0; c < 3; ++c) {
          to[c] = static_cast<std::uint8_t>(255 - (255 - from[c]) * from[3] / 255);
        }
      }
    }
  }

  [[nodiscard]] Image<std::uint8_t> take() { return std::move(image_); }

 private:
  void draw(const Glyph& glyph, int y, int x) {
    for (int row = 0; row < kGlyphHeight; ++row) {
      for (int column = 0; column < kGlyphWidth; ++column) {
        if ((glyph.rows[row] >> (kGlyphWidth - 1 - column) & 1) == 0) continue;
        const int top = y + row * scale_, left = x + column * scale_;
        fill({top, left, top + scale_, left + scale_}, {0, 0, 0});
      }
    }
  }

  Image<std::uint8_t> image_;
  int scale_;
};

/// From the largest to the smallest.
std::vector<std::string> values_of(Interval range) {
  std::vector<std::string> values;
  for (int i = 0; i < kValues; ++i) {
    const double value = range.max - range.length() * i / (kValues - 1);
    values.push_back(fmt::format("{:.3g}", value));
  }
  return values;
}

}  // namespace

Image<std::uint8_t> with_legend(const Image<std::uint8_t>& picture, const Shading& shading,
                                const std::string& unit) {
  const int height = std::max(picture.height(), kLeastHeight);
  const int scale = std::max(1, height / 400);
  const int margin = 8 * scale, bar_width = 16 * scale, line = (kGlyphHeight + 3) * scale;
  const std::vector<std::string> values = values_of(shading.range);
  std::size_t longest = unit.size();
  for (const std::string& value : values) longest = std::max(longest, value.size());
  const int bar = picture.width() + margin;
  const int text = bar + bar_width + margin / 2;
  Canvas canvas(height, text + static_cast<int>(longest) * kGlyphStep * scale + margin / 2, scale);
  canvas.place(picture);

  const int top = line / 2, bottom = height - 3 * line;
  for (int y = top; y < bottom; ++y) {
    const double value =
        shading.range.max - shading.range.length() * (y - top) / (bottom - 1 - top);
    canvas.fill({y, bar, y + 1, bar + bar_width},
                shading.map.color(value, shading.range.min, shading.range.max));
  }
  for (int i = 0; i < kValues; ++i) {
    const int y = top + (bottom - 1 - top) * i / (kValues - 1);
    canvas.write(values[static_cast<std::size_t>(i)], y - kGlyphHeight * scale / 2, text);
  }
  canvas.write(unit, bottom + line / 2, text);
  const int swatch = height - line - scale;
  canvas.fill({swatch, bar, swatch + kGlyphHeight * scale, bar + bar_width}, shading.map.invalid);
  canvas.write("n/a", swatch, text);
  return canvas.take();
}

}  // namespace episcope::render
