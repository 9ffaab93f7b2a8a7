// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/recipes/recipes.h"

#include <algorithm>

namespace episcope::scenes {
namespace {

constexpr std::array<float, 3> kGrey{0.5F, 0.5F, 0.5F};
constexpr float kContrast = 0.5F;

// Far beyond the image in px, so that every view is filled.
constexpr double kFar = 1e6;

Model single_plane(const Stage& stage, const DisparityPlane& plane, double nearest_disparity) {
  Model model;
  model.primitives.push_back(make_plane(stage, plane));
  const double pixel = stage.pixel(stage.depth(nearest_disparity));
  Texture texture = noise_texture(pixel * 1.15, 1, kGrey, kContrast);
  model.primitives.back().texture = model.add(texture);
  return model;
}

}  // namespace

Model fronto_scene(const Stage& stage) {
  constexpr double disparity = 0.37;
  return single_plane(stage, {disparity, 0, 0}, disparity);
}

Model slant_scene(const Stage& stage) {
  // The far side has the largest pixels: its texture must still be resolved.
  return single_plane(stage, {0, 2.0 / std::max(stage.width - 1, 1), 0}, -1);
}

Model edge_scene(const Stage& stage) {
  constexpr double far_disparity = -0.5;
  constexpr double near_disparity = 0.8;
  Model model;
  model.primitives.push_back(make_plane(stage, {far_disparity, 0, 0}));
  model.primitives.back().texture = model.add(
      noise_texture(stage.pixel(stage.depth(far_disparity)), 2, {0.42F, 0.50F, 0.58F}, kContrast));
  // Its left side lies between two pixels of the centre view.
  const double left = stage.width / 2 - 0.5;
  model.primitives.push_back(
      make_card(stage, {left, -kFar, left + 2 * kFar, kFar, near_disparity}));
  model.primitives.back().label = 2;
  model.primitives.back().texture = model.add(
      noise_texture(stage.pixel(stage.depth(near_disparity)), 3, {0.60F, 0.50F, 0.40F}, kContrast));
  return model;
}

Model bars_scene(const Stage& stage) {
  constexpr double far_disparity = -0.4;
  constexpr double near_disparity = 0.7;
  constexpr int widths[] = {1, 2, 3, 5};
  Model model;
  model.primitives.push_back(make_plane(stage, {far_disparity, 0, 0}));
  model.primitives.back().texture = model.add(
      noise_texture(stage.pixel(stage.depth(far_disparity)), 4, {0.38F, 0.46F, 0.52F}, kContrast));
  const int texture = model.add(
      noise_texture(stage.pixel(stage.depth(near_disparity)), 5, {0.72F, 0.60F, 0.34F}, 0.4F));
  const auto add_bar = [&](const Card& card) {
    model.primitives.push_back(make_card(stage, card));
    model.primitives.back().label = 2;
    model.primitives.back().texture = texture;
  };
  // Upright bars in the upper half, lying ones in the lower half, each on whole pixels.
  const double upper = stage.height * 9 / 20 - 0.5;
  const double lower = stage.height * 11 / 20 - 0.5;
  for (int i = 0; i < 8; ++i) {
    const double x = stage.width * (2 * i + 1) / 16 - 0.5;
    add_bar({x, stage.height / 20 - 0.5, x + widths[i % 4], upper, near_disparity});
  }
  for (int i = 0; i < 4; ++i) {
    const double y = lower + stage.height * (2 * i + 1) / 20;
    add_bar(
        {stage.width / 20 - 0.5, y, stage.width * 19 / 20 - 0.5, y + widths[i], near_disparity});
  }
  return model;
}

Model transparent_scene(const Stage& stage) {
  constexpr double far_disparity = -0.5;
  constexpr double near_disparity = 0.5;
  Model model;
  model.primitives.push_back(make_plane(stage, {far_disparity, 0, 0}));
  model.primitives.back().texture = model.add(
      noise_texture(stage.pixel(stage.depth(far_disparity)), 6, {0.45F, 0.55F, 0.45F}, 0.7F));
  const double w = stage.width;
  const double h = stage.height;
  model.primitives.push_back(make_card(
      stage, {w / 8 - 0.5, h / 8 - 0.5, w * 7 / 8 - 0.5, h * 7 / 8 - 0.5, near_disparity}));
  Primitive& pane = model.primitives.back();
  pane.label = 2;
  pane.is_pane = true;
  pane.texture = model.add(
      noise_texture(stage.pixel(stage.depth(near_disparity)), 7, {0.60F, 0.50F, 0.45F}, 0.7F));
  return model;
}

}  // namespace episcope::scenes
