// SPDX-License-Identifier: BSD-3-Clause
#include "engine/render/shade.h"

#include "engine/core/error.h"
#include "engine/core/numbers.h"
#include "engine/core/parameter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <string_view>
#include <type_traits>
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

constexpr int kRgba = 4;
constexpr std::uint8_t kOpaque = 255;

void put(std::uint8_t* pixel, const Rgb& color, std::uint8_t alpha = kOpaque) {
  std::copy(color.begin(), color.end(), pixel);
  pixel[3] = alpha;
}

/// Samples as they are, each as the nearest byte.
struct PlainTone {
  std::uint8_t operator()(std::uint8_t sample) const { return sample; }
  std::uint8_t operator()(std::uint16_t sample) const {
    return static_cast<std::uint8_t>((sample + 128U) / 257U);  // nearest: 65535 = 255 · 257
  }
  std::uint8_t operator()(float sample) const {
    const float bounded = sample > 0 ? std::min(sample, 1.0F) : 0.0F;  // NaN becomes 0
    return static_cast<std::uint8_t>(std::lround(bounded * 255));
  }
};

template <class T, class ByteOf>
Image<std::uint8_t> opaque_picture(ImageView<const T> samples, const ByteOf& byte_of) {
  Image<std::uint8_t> picture(samples.height, samples.width, kRgba);
  for (int y = 0; y < samples.height; ++y) {
    const T* source = samples.row(y);
    std::uint8_t* target = picture.row(y);
    for (int x = 0; x < samples.width; ++x, source += samples.channels, target += kRgba) {
      const bool is_color = samples.channels >= 3;
      put(target, {byte_of(source[0]), byte_of(source[is_color ? 1 : 0]),
                   byte_of(source[is_color ? 2 : 0])});
    }
  }
  return picture;
}

std::vector<float> valid_values(ImageView<const float> map, ImageView<const std::uint8_t> valid) {
  std::vector<float> values;
  values.reserve(map.size());
  const DisparityView pixels{map, valid};
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (pixels.is_valid(y, x)) values.push_back(map.at(y, x));
    }
  }
  return values;
}

constexpr int kDash = 4;  // px of a contour

/// How one view is sampled: at (x + dx + fraction_x, y + dy + fraction_y).
struct Shift {
  ViewIndex view;
  int dx = 0;
  int dy = 0;
  float fraction_x = 0;
  float fraction_y = 0;
};

bool shows_something(const LightField& light_field, ViewIndex view) {
  if (light_field.valid().empty()) return true;
  const auto* const valid = light_field.valid_of(view).data;
  return std::any_of(valid, valid + light_field.valid().view_size(),
                     [](std::uint8_t pixel) { return pixel != 0; });
}

// Of the views that show something, or of `view` alone.
std::vector<Shift> shifts_of(const LightField& light_field, ViewIndex view, double focus_px) {
  const GridShape grid = light_field.grid();
  std::vector<Shift> shifts;
  for (int v = 0; v < grid.v; ++v) {
    for (int u = 0; u < grid.u; ++u) {
      if (!shows_something(light_field, {v, u}) && !(ViewIndex{v, u} == view)) continue;
      const double x = -focus_px * (u - view.u);
      const double y = -focus_px * (v - view.v);
      shifts.push_back({{v, u},
                        static_cast<int>(std::floor(x)),
                        static_cast<int>(std::floor(y)),
                        static_cast<float>(x - std::floor(x)),
                        static_cast<float>(y - std::floor(y))});
    }
  }
  return shifts;
}

/// Arithmetic of a sample type: 8-bit samples are summed as integers, with weights that add up to
/// 256, which fits sixteen lanes where float fits four.
template <class T>
struct Arithmetic {
  using Weight = float;
  using Sum = float;
  static constexpr float kOne = 1;
};
template <>
struct Arithmetic<std::uint8_t> {
  using Weight = std::uint16_t;
  using Sum = std::uint32_t;
  static constexpr float kOne = 256;
};

/// Weights of the four neighbors: upper left, upper right, lower left, lower right.
template <class T>
struct Weights {
  typename Arithmetic<T>::Weight w[4];

  explicit Weights(const Shift& shift) {
    constexpr float one = Arithmetic<T>::kOne;
    float exact[4] = {
        (1 - shift.fraction_x) * (1 - shift.fraction_y), shift.fraction_x * (1 - shift.fraction_y),
        (1 - shift.fraction_x) * shift.fraction_y, shift.fraction_x * shift.fraction_y};
    if constexpr (std::is_integral_v<typename Arithmetic<T>::Weight>) {
      int rest = static_cast<int>(one);
      for (int i = 3; i > 0; --i) {
        w[i] = static_cast<std::uint16_t>(std::lround(exact[i] * one));
        rest -= w[i];
      }
      w[0] = static_cast<std::uint16_t>(std::max(rest, 0));
    } else {
      std::copy(std::begin(exact), std::end(exact), w);
    }
  }
};

/// Adds `count` interpolated samples. `upper` and `lower` are two rows at the left neighbor.
template <class T>
void add_samples(const T* upper, const T* lower, int count, int channels, const Weights<T>& weights,
                 typename Arithmetic<T>::Sum* sum) {
  using Weight = typename Arithmetic<T>::Weight;
  const auto [w0, w1, w2, w3] = weights.w;
  for (int i = 0; i < count; ++i) {
    // At most 255 · 256: the conversion keeps the products 16 bits wide.
    sum[i] += static_cast<Weight>(w0 * upper[i] + w1 * upper[i + channels] + w2 * lower[i] +
                                  w3 * lower[i + channels]);
  }
}

template <class T>
void add_row(ImageView<const T> view, int y, const Shift& shift, const Weights<T>& weights,
             typename Arithmetic<T>::Sum* sum) {
  const int c = view.channels;
  const T* upper = view.row(std::clamp(y + shift.dy, 0, view.height - 1));
  const T* lower = view.row(std::clamp(y + shift.dy + 1, 0, view.height - 1));
  const int begin = std::clamp(-shift.dx, 0, view.width);
  const int end = std::clamp(view.width - 1 - shift.dx, begin, view.width);
  const std::ptrdiff_t offset = static_cast<std::ptrdiff_t>(begin + shift.dx) * c;
  if (end > begin) {
    add_samples(upper + offset, lower + offset, (end - begin) * c, c, weights, sum + begin * c);
  }
  const auto add_border = [&](int x) {
    const int left = std::clamp(x + shift.dx, 0, view.width - 1) * c;
    const int right = std::clamp(x + shift.dx + 1, 0, view.width - 1) * c;
    for (int k = 0; k < c; ++k) {
      sum[x * c + k] += static_cast<typename Arithmetic<T>::Weight>(
          weights.w[0] * upper[left + k] + weights.w[1] * upper[right + k] +
          weights.w[2] * lower[left + k] + weights.w[3] * lower[right + k]);
    }
  };
  for (int x = 0; x < begin; ++x) add_border(x);
  for (int x = end; x < view.width; ++x) add_border(x);
}

template <class T>
float largest_sample() {
  if constexpr (std::is_integral_v<T>) return std::numeric_limits<T>::max();
  return 1;
}

template <class T>
Image<float> mean_of_views(const ViewStack<T>& stack, const std::vector<Shift>& shifts) {
  Image<float> mean(stack.height(), stack.width(), stack.channels());
  std::vector<Weights<T>> weights;
  for (const auto& shift : shifts) weights.emplace_back(shift);
  std::vector<typename Arithmetic<T>::Sum> sum(static_cast<std::size_t>(stack.width()) *
                                               stack.channels());
  const float scale = 1 / (Arithmetic<T>::kOne * largest_sample<T>() * shifts.size());
  for (int y = 0; y < stack.height(); ++y) {
    std::fill(sum.begin(), sum.end(), 0);
    for (std::size_t i = 0; i < shifts.size(); ++i) {
      add_row(stack.view(shifts[i].view), y, shifts[i], weights[i], sum.data());
    }
    std::transform(sum.begin(), sum.end(), mean.row(y),
                   [scale](auto total) { return static_cast<float>(total) * scale; });
  }
  return mean;
}

using Picture = Image<std::uint8_t>;

/// Mean of the samples of `source` in rows [y0, y1) and columns [x0, x1).
std::uint8_t mean(const Picture& source, int y0, int y1, int x0, int x1, int c) {
  long sum = 0;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) sum += source.at(y, x, c);
  }
  const long count = static_cast<long>(y1 - y0) * (x1 - x0);
  return static_cast<std::uint8_t>((sum + count / 2) / count);
}

/// Where the i-th of `to` equal parts of `from` begins.
int begin_of(int i, int from, int to) {
  return static_cast<int>(static_cast<long>(i) * from / to);
}

constexpr double kDarkest = 0.005;  // quantiles
constexpr double kBrightest = 0.995;
constexpr double kDark = 0.12;    // a median below it
constexpr double kMiddle = 0.35;  // where the median of a dark view is lifted to

// Samples of all channels that show something, in [0, 1].
std::vector<float> shown_samples(const LightField& light_field, ViewIndex view) {
  const int channels = light_field.channels();
  const int width = light_field.width();
  std::vector<float> row(static_cast<std::size_t>(width) * channels);
  std::vector<float> samples;
  samples.reserve(row.size() * light_field.height());
  const auto valid = light_field.valid_of(view);
  for (int y = 0; y < light_field.height(); ++y) {
    light_field.read_row(view, y, 0, width, row.data());
    for (int x = 0; x < width; ++x) {
      if (!valid.empty() && valid.at(y, x) == 0) continue;
      for (int c = 0; c < channels; ++c) {
        const float sample = row[static_cast<std::size_t>(x) * channels + c];
        if (std::isfinite(sample)) samples.push_back(std::clamp(sample, 0.0F, 1.0F));
      }
    }
  }
  return samples;
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

Shading default_shading(Quantity quantity, Interval disparity_range) {
  const QuantityInfo& info = info_of(quantity);
  const bool is_disparity = info.rule == RangeRule::Disparity;
  return {color_map(info.color_map), is_disparity       ? disparity_range
                                     : info.has_scale() ? info.range
                                                        : Interval{0, 1}};
}

Image<std::uint8_t> shade(ImageView<const float> map, ImageView<const std::uint8_t> valid,
                          const Shading& shading) {
  Image<std::uint8_t> picture(map.height, map.width, kRgba);
  const DisparityView pixels{map, valid};
  for (int y = 0; y < map.height; ++y) {
    std::uint8_t* target = picture.row(y);
    for (int x = 0; x < map.width; ++x, target += kRgba) {
      put(target, pixels.is_valid(y, x)
                      ? shading.map.color(map.at(y, x), shading.range.min, shading.range.max)
                      : shading.map.invalid);
    }
  }
  return picture;
}

Image<std::uint8_t> shade_view(const LightField& light_field, ViewIndex view,
                               const ToneTable* tone) {
  return std::visit(
      [&](const auto& stack) {
        return tone ? opaque_picture(stack.view(view), *tone)
                    : opaque_picture(stack.view(view), PlainTone());
      },
      light_field.samples());
}

Image<std::uint8_t> shade_labels(ImageView<const std::int32_t> labels,
                                 const std::vector<LabelInfo>& infos, const LabelStyle& style) {
  Image<std::uint8_t> picture(labels.height, labels.width, kRgba);
  std::map<std::int32_t, Rgb> colors;
  for (const LabelInfo& info : infos) colors[info.id] = info.color;
  std::int32_t last = 0;
  bool is_hidden = false;
  Rgb color{};
  const bool has_contours = style.drawing != LabelDrawing::Fill;
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      const std::int32_t id = labels.at(y, x);
      if (id <= 0) continue;
      if (id != last) {
        color = colors.try_emplace(id, label_color(id)).first->second;
        is_hidden = style.hidden.contains(id);
        last = id;
      }
      if (is_hidden) continue;
      if (!has_contours) {
        put(&picture.at(y, x), color);
      } else if (is_on_contour(labels, y, x)) {
        const bool is_gap = (x / kDash + y / kDash) % 2 != 0;
        put(&picture.at(y, x), is_gap ? Rgb{} : color);
      } else if (style.drawing == LabelDrawing::Both) {
        put(&picture.at(y, x), color, kFaintLabel);
      }
    }
  }
  return picture;
}

Image<std::uint8_t> shade_samples(ImageView<const float> samples, const ToneTable* tone) {
  return tone ? opaque_picture(samples, *tone) : opaque_picture(samples, PlainTone());
}

Interval robust_range(ImageView<const float> map, ImageView<const std::uint8_t> valid, double low,
                      double high) {
  std::vector<float> values = valid_values(map, valid);
  if (values.empty()) return {0, 1};
  const float min = quantile(values, low);
  return {min, quantile(values, high)};
}

Image<float> refocus(const LightField& light_field, ViewIndex view, double focus_px) {
  if (!light_field.grid().contains(view)) {
    throw InvalidInput(fmt::format("view {},{} lies outside the grid of {}×{} views", view.v,
                                   view.u, light_field.grid().v, light_field.grid().u));
  }
  const auto shifts = shifts_of(light_field, view, focus_px);
  return std::visit([&](const auto& stack) { return mean_of_views(stack, shifts); },
                    light_field.samples());
}

Picture fitted(const Picture& picture, int longest_px) {
  const int longer = std::max(picture.height(), picture.width());
  if (longer <= longest_px) return picture;
  const auto scaled = [&](int length) {
    return std::max(1, static_cast<int>(static_cast<long>(length) * longest_px / longer));
  };
  Picture small(scaled(picture.height()), scaled(picture.width()), picture.channels());
  for (int y = 0; y < small.height(); ++y) {
    const int y0 = begin_of(y, picture.height(), small.height());
    const int y1 = std::max(y0 + 1, begin_of(y + 1, picture.height(), small.height()));
    for (int x = 0; x < small.width(); ++x) {
      const int x0 = begin_of(x, picture.width(), small.width());
      const int x1 = std::max(x0 + 1, begin_of(x + 1, picture.width(), small.width()));
      for (int c = 0; c < small.channels(); ++c) {
        small.at(y, x, c) = mean(picture, y0, y1, x0, x1, c);
      }
    }
  }
  return small;
}

Tone automatic_tone(const LightField& light_field, ViewIndex view) {
  std::vector<float> samples = shown_samples(light_field, view);
  if (samples.empty()) return {};
  Tone tone;
  tone.black = std::min<double>(quantile(samples, kDarkest), kBlackRange.max);
  const auto stretched = [&tone](double sample) {
    return (sample - tone.black) / (1 - tone.black);
  };
  const double white = stretched(quantile(samples, kBrightest));
  if (white <= 0) return {};
  tone.exposure = std::clamp(-std::log2(white), 0.0, kExposureRange.max);
  const double middle = stretched(quantile(samples, 0.5)) * std::exp2(tone.exposure);
  if (middle > 0 && middle < kMiddle) {
    tone.gamma = std::min(std::log(middle) / std::log(kMiddle), kGammaRange.max);
  }
  return tone;
}

bool is_dark(const LightField& light_field, ViewIndex view) {
  std::vector<float> samples = shown_samples(light_field, view);
  return !samples.empty() && quantile(samples, 0.5) < kDark;
}

ToneTable::ToneTable(const Tone& tone) {
  const double gain = std::exp2(tone.exposure) / (1 - tone.black);
  for (std::size_t i = 0; i < table_.size(); ++i) {
    const double sample = static_cast<double>(i) / static_cast<double>(table_.size() - 1);
    const double linear = std::clamp((sample - tone.black) * gain, 0.0, 1.0);
    table_[i] = static_cast<std::uint8_t>(std::lround(255 * std::pow(linear, 1 / tone.gamma)));
  }
}

std::shared_ptr<const ToneTable> table_of(const Tone& tone) {
  return tone.is_plain() ? nullptr : std::make_shared<const ToneTable>(tone);
}

}  // namespace episcope::render
