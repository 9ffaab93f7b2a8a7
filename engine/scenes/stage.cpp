// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/stage.h"

#include <algorithm>

namespace episcope::scenes {
namespace {

// Half sizes of the box around a primitive, and the middle of its y range.
struct Hull {
  Vector3 half{};
  double middle_y = 0;
};

Hull hull_of(const Primitive& primitive) {
  const double* e = primitive.extent;
  switch (primitive.shape) {
    case Shape::Rectangle:
    case Shape::Leaf:
    case Shape::Triangle:
    case Shape::Lattice:
      return {{e[0], e[1], 0}, 0};
    case Shape::Disc:
      return {{e[0], e[0], 0}, 0};
    case Shape::Box:
      return {{e[0], e[1], e[2]}, 0};
    case Shape::Revolution:
      break;
  }
  const double* p = primitive.profile;
  const auto squared = [p](double y) { return p[0] + p[1] * y + p[2] * y * y; };
  double widest = std::max(squared(e[0]), squared(e[1]));
  if (p[2] < 0) widest = std::max(widest, squared(std::clamp(-p[1] / (2 * p[2]), e[0], e[1])));
  const double radius = std::sqrt(std::max(widest, 0.0));
  return {{radius, (e[1] - e[0]) / 2, radius}, (e[0] + e[1]) / 2};
}

}  // namespace

Stage make_stage(int width, int height) {
  Stage stage;
  stage.width = width;
  stage.height = height;
  stage.focal_px = 1.5 * std::max(width, height);
  return stage;
}

int Model::add(const Texture& texture) {
  textures.push_back(texture);
  return static_cast<int>(textures.size()) - 1;
}

ModelView Model::view() const {
  return {primitives.data(), textures.data(), occluders.data(), static_cast<int>(occluders.size()),
          lighting};
}

Texture noise_texture(double pixel_units, unsigned seed, const std::array<float, 3>& color,
                      float contrast) {
  // Finest octave with the most contrast: it carries most of what an estimator can measure. The
  // channels differ, so that color helps too.
  constexpr float shares[3][3] = {
      {0.42F, 0.36F, 0.40F}, {0.26F, 0.36F, 0.30F}, {0.32F, 0.28F, 0.30F}};
  constexpr double finest_px = 4.5;
  Texture texture;
  texture.seed = seed;
  for (int o = 0; o < 3; ++o) {
    texture.spacing[o] = pixel_units * finest_px * (1 << o);
    for (int c = 0; c < 3; ++c) texture.gain[o][c] = contrast * shares[o][c];
  }
  for (auto& side : texture.color) std::copy(color.begin(), color.end(), side);
  return texture;
}

void set_axes(Primitive& primitive, const Vector3& x, const Vector3& y, const Vector3& z) {
  std::copy(x.begin(), x.end(), primitive.axes[0]);
  std::copy(y.begin(), y.end(), primitive.axes[1]);
  std::copy(z.begin(), z.end(), primitive.axes[2]);
}

void revolve(Primitive& piece, double height, const Radii& radii) {
  const double bottom = radii.bottom * radii.bottom;
  const double middle = radii.middle * radii.middle;
  const double top = radii.top * radii.top;
  piece.shape = Shape::Revolution;
  piece.extent[0] = 0;
  piece.extent[1] = height;
  piece.profile[0] = bottom;
  piece.profile[1] = (4 * middle - 3 * bottom - top) / height;
  piece.profile[2] = 2 * (bottom + top - 2 * middle) / (height * height);
}

void set_pattern(Texture& texture, Pattern pattern, double pixel_units, double period,
                 const std::array<Vector3, 2>& axes) {
  constexpr double step_px = 3;
  texture.pattern = pattern;
  texture.pattern_step = step_px * pixel_units;
  texture.pattern_sharpness = static_cast<float>(period / 2 / texture.pattern_step);
  for (int i = 0; i < 2; ++i) {
    for (int k = 0; k < 3; ++k) texture.pattern_axis[i][k] = axes[i][k] / period;
  }
}

Primitive make_card(const Stage& stage, const Card& card) {
  const double depth = stage.depth(card.disparity_px);
  const Vector3 center =
      stage.point((card.left + card.right) / 2, (card.top + card.bottom) / 2, depth);
  Primitive primitive;
  std::copy(center.begin(), center.end(), primitive.center);
  primitive.extent[0] = (card.right - card.left) / 2 * stage.pixel(depth);
  primitive.extent[1] = (card.bottom - card.top) / 2 * stage.pixel(depth);
  return primitive;
}

Primitive make_plane(const Stage& stage, const DisparityPlane& plane) {
  // d + shift = parallax / Z is affine in the pixel exactly where a·X + b·Y + c·Z = parallax.
  const Vector3 normal{plane.per_x * stage.focal_px, plane.per_y * stage.focal_px,
                       plane.center + stage.parallax / stage.zero_depth};
  const Vector3 z = normalized(normal);
  const Vector3 x = normalized(cross({0, 1, 0}, z));
  const Vector3 y = cross(z, x);
  Primitive primitive;
  primitive.center[2] = stage.parallax / normal[2];
  int row = 0;
  for (const Vector3& axis : {x, y, z}) std::copy(axis.begin(), axis.end(), primitive.axes[row++]);
  primitive.extent[0] = primitive.extent[1] = 1e6;
  return primitive;
}

Interval depths_of(const Primitive& primitive) {
  const Hull hull = hull_of(primitive);
  const double middle = primitive.center[2] + hull.middle_y * primitive.axes[1][2];
  double reach = 0;
  for (int i = 0; i < 3; ++i) reach += hull.half[i] * std::abs(primitive.axes[i][2]);
  return {middle - reach, middle + reach};
}

Bounds bounds_in_view(const Primitive& primitive, const ViewCamera& camera, int width, int height) {
  const Hull hull = hull_of(primitive);
  double low[2] = {1e9, 1e9};
  double high[2] = {-1e9, -1e9};
  for (int corner = 0; corner < 8; ++corner) {
    Vector3 at{primitive.center[0], primitive.center[1], primitive.center[2]};
    for (int i = 0; i < 3; ++i) {
      const double along = (corner >> i & 1 ? 1 : -1) * hull.half[i] + (i == 1 ? hull.middle_y : 0);
      for (int k = 0; k < 3; ++k) at[k] += along * primitive.axes[i][k];
    }
    if (at[2] < 1e-3) return {0, width, 0, height};
    for (int k = 0; k < 2; ++k) {
      const double pixel =
          camera.principal[k] + camera.focal_px * (at[k] - camera.origin[k]) / at[2];
      low[k] = std::min(low[k], pixel);
      high[k] = std::max(high[k], pixel);
    }
  }
  const auto begin = [](double pixel, int size) {
    return static_cast<int>(std::clamp(std::floor(pixel) - 1, 0.0, static_cast<double>(size)));
  };
  const auto end = [](double pixel, int size) {
    return static_cast<int>(std::clamp(std::ceil(pixel) + 2, 0.0, static_cast<double>(size)));
  };
  return {begin(low[0], width), end(high[0], width), begin(low[1], height), end(high[1], height)};
}

float Exposure::gain(ViewIndex steps) const {
  if (sensor_.gain_spread == 0 || steps == ViewIndex{0, 0}) return 1;
  // Numbers views so that a grid of another size gives the same gain.
  const auto v = static_cast<std::uint64_t>(steps.v + 1024);
  const auto u = static_cast<std::uint64_t>(steps.u + 1024);
  const std::uint64_t bits = mix(mix(format_.seed * kGolden + 2) + (v * 4096 + u) * kGolden);
  const float signed_unit = static_cast<float>(bits >> 40) / 8388608.0F - 1.0F;
  return 1 + sensor_.gain_spread * signed_unit;
}

float Exposure::noise_sigma(int y) const {
  const double share = (y + 0.5) / format_.height;
  const double own = sensor_.noise_top + share * (sensor_.noise_bottom - sensor_.noise_top);
  return static_cast<float>(std::sqrt(own * own + format_.noise_sigma * format_.noise_sigma));
}

void Exposure::write_row(ViewIndex steps, int y, const float* rgb, std::uint64_t counter,
                         std::uint8_t* out) const {
  const int channels = format_.channels;
  const float sigma = noise_sigma(y);
  const float full = 255.0F * (sensor_.exposure * gain(steps));
  const auto middle_x = static_cast<float>((format_.width - 1) / 2.0);
  const float from_middle_y =
      static_cast<float>(y) - static_cast<float>((format_.height - 1) / 2.0);
  const float corner =
      middle_x * middle_x + 0.25F * static_cast<float>((format_.height - 1) * (format_.height - 1));
  for (int x = 0; x < format_.width; ++x, rgb += 3) {
    const float grey = 0.299F * rgb[0] + 0.587F * rgb[1] + 0.114F * rgb[2];  // BT.601
    const float from_middle_x = static_cast<float>(x) - middle_x;
    const float squared = from_middle_x * from_middle_x + from_middle_y * from_middle_y;
    const float light = full * (1 - sensor_.vignetting * (squared / corner));
    for (int c = 0; c < channels; ++c, ++counter) {
      float value = light * (channels == 1 ? grey : rgb[c]);
      if (sigma > 0) value += sigma * sensor_noise(format_.seed, counter);
      *out++ = static_cast<std::uint8_t>(std::clamp(value, 0.0F, 255.0F) + 0.5F);
    }
  }
}

float sensor_noise(unsigned seed, std::uint64_t counter) {
  const std::uint64_t stream = mix(seed * kGolden + 1);
  std::uint32_t sum = 0;
  for (std::uint64_t i = 0; i < 3; ++i) {
    const std::uint64_t bits = mix(stream + (3 * counter + i) * kGolden);
    for (int k = 0; k < 4; ++k) sum += static_cast<std::uint32_t>(bits >> (16 * k) & 0xFFFF);
  }
  // The mean of a 16-bit number is 0x7FFF.8.
  return (static_cast<float>(sum) - 12 * 32767.5F) / 65536.0F;
}

}  // namespace episcope::scenes
