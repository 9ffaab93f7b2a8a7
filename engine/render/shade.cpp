// SPDX-License-Identifier: BSD-3-Clause
#include "engine/render/shade.h"

#include "engine/core/array/quantile.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace episcope::render {
namespace {

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

}  // namespace

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
      if (!has_contours || is_on_contour(labels, y, x)) {
        put(&picture.at(y, x), color);
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

}  // namespace episcope::render
