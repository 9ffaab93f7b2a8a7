// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/scene.h"
#include "engine/render/quantity.h"

#include <array>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace episcope::render {

/// How samples are brightened for display: what is darker than the black point is black, the rest
/// is stretched to [0, 1], multiplied by 2^`exposure` and raised to 1/`gamma`.
struct Tone {
  double black = 0;     ///< Sample in [0, 1) that is shown as black.
  double exposure = 0;  ///< Photographic stops: 1 doubles the brightness.
  double gamma = 1;     ///< Positive; larger ones lift the shadows.
  friend bool operator==(const Tone&, const Tone&) = default;
  /// Whether samples are shown as they are.
  [[nodiscard]] bool is_plain() const { return *this == Tone(); }
};

inline constexpr Interval kExposureRange{-4, 8};
inline constexpr Interval kGammaRange{0.25, 4};
inline constexpr Interval kBlackRange{0, 0.5};

/// The tone that shows a view well: black and white at its 0.5 % and 99.5 % quantiles, and the
/// middle of what is dark lifted. Samples that show nothing (LightField::valid) do not count. Plain
/// for a view of one brightness. Linear in the pixels of the view.
[[nodiscard]] Tone automatic_tone(const LightField& light_field, ViewIndex view);

/// Whether a view is so dark that little can be seen: most of its samples are below 12 % of white.
[[nodiscard]] bool is_dark(const LightField& light_field, ViewIndex view);

/// A tone as a table from samples to bytes.
class ToneTable {
 public:
  explicit ToneTable(const Tone& tone);

  [[nodiscard]] std::uint8_t operator()(std::uint8_t sample) const { return table_[sample * 257U]; }
  [[nodiscard]] std::uint8_t operator()(std::uint16_t sample) const { return table_[sample]; }
  /// NaN becomes black.
  [[nodiscard]] std::uint8_t operator()(float sample) const {
    const float bounded = sample > 0 ? (sample < 1 ? sample : 1.0F) : 0.0F;
    return table_[static_cast<std::size_t>(bounded * 65535 + 0.5F)];
  }

 private:
  std::array<std::uint8_t, 65536> table_;
};

/// The table of a tone; null if it is plain: samples as they are.
[[nodiscard]] std::shared_ptr<const ToneTable> table_of(const Tone& tone);

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

struct Shading {
  ColorMap map;
  Interval range;
};

/// Whether two shadings give the same colors; maps are told apart by name.
[[nodiscard]] inline bool is_same(const Shading& a, const Shading& b) {
  return a.map.name == b.map.name && a.range == b.range;
}

/// Color map and range of a quantity, which belong to the quantity and not to the image;
/// disparities span `disparity_range`.
[[nodiscard]] Shading default_shading(Quantity quantity, Interval disparity_range);

/// RGBA8 picture of a map; invalid pixels (mask 0 or NaN) get the map's own color. `valid` may be
/// empty.
[[nodiscard]] Image<std::uint8_t> shade(ImageView<const float> map,
                                        ImageView<const std::uint8_t> valid,
                                        const Shading& shading);

/// RGBA8 picture of a view; brightened if a tone is given.
[[nodiscard]] Image<std::uint8_t> shade_view(const LightField& light_field, ViewIndex view,
                                             const ToneTable* tone = nullptr);

/// How areas of labels are drawn. Contours: the pixels of an area that touch another at a side, in
/// dashes. Both: the areas are drawn fainter within them.
enum class LabelDrawing : std::uint8_t { Fill, Contours, Both };
/// Opacity of areas within contours, of 255.
inline constexpr int kFaintLabel = 90;

struct LabelStyle {
  LabelDrawing drawing = LabelDrawing::Fill;
  std::set<std::int32_t> hidden{};  ///< Labels that are not drawn.
  friend bool operator==(const LabelStyle&, const LabelStyle&) = default;
};

/// RGBA8 picture of label ids in the colors of `infos`, or in `label_color` if they are missing
/// there; 0, negative and hidden ids are transparent.
[[nodiscard]] Image<std::uint8_t> shade_labels(ImageView<const std::int32_t> labels,
                                               const std::vector<LabelInfo>& infos = {},
                                               const LabelStyle& style = {});

/// Whether a pixel with a label belongs to the contour of its area: a neighbor at a side has
/// another label. Beyond the border of the image lies none.
template <class Label>
[[nodiscard]] bool is_on_contour(ImageView<const Label> labels, int y, int x) {
  const Label own = labels.at(y, x);
  return (y > 0 && labels.at(y - 1, x) != own) || (x > 0 && labels.at(y, x - 1) != own) ||
         (y + 1 < labels.height && labels.at(y + 1, x) != own) ||
         (x + 1 < labels.width && labels.at(y, x + 1) != own);
}

/// RGBA8 picture of float samples in [0, 1], `[y][x][c]`, c = 1 or 3: an EPI, a refocused view;
/// brightened if a tone is given.
[[nodiscard]] Image<std::uint8_t> shade_samples(ImageView<const float> samples,
                                                const ToneTable* tone = nullptr);

/// Range of the valid values between two quantiles, for "automatic range". {0, 1} if none is valid.
[[nodiscard]] Interval robust_range(ImageView<const float> map, ImageView<const std::uint8_t> valid,
                                    double low = 0.01, double high = 0.99);

/// The mean of all views that show something (LightField::valid), sheared so that disparity
/// `focus_px` is in focus, seen from `view`: synthetic aperture refocusing [Ng06]. `[y][x][c]` in
/// [0, 1]. Samples between pixels are interpolated linearly, with 8-bit light fields to 1/256 px;
/// those outside repeat the border. Throws InvalidInput if the view lies outside the grid.
[[nodiscard]] Image<float> refocus(const LightField& light_field, ViewIndex view, double focus_px);

/// A picture of 8-bit samples `[y][x][c]`, scaled down by the means of areas until its longer side
/// is `longest_px` (at least 1); as it is if it is no larger.
[[nodiscard]] Image<std::uint8_t> fitted(const Image<std::uint8_t>& picture, int longest_px);

/// An RGBA8 picture, on white, with the scale of its colors to its right: a bar from the largest
/// value on top to the smallest, five values at equal distances, the unit below them, and the color
/// of pixels without a value, marked n/a. Text grows with the picture; small pictures get room for
/// the bar. `unit`: "px", or empty.
[[nodiscard]] Image<std::uint8_t> with_legend(const Image<std::uint8_t>& picture,
                                              const Shading& shading, const std::string& unit);

}  // namespace episcope::render
