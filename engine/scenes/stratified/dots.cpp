// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/stratified/pieces.h"

#include <algorithm>
#include <cmath>

namespace episcope::scenes {
namespace {

constexpr int kWall = 1;
constexpr int kSizes = 8;
constexpr int kBoxes = 4;  // Along each side of a view.
constexpr int kCells = 3;  // Along each side of a box; one of the nine stays empty.

// Diameters as shares of the side of a box.
constexpr double kDiameters[kSizes] = {0.25, 0.2, 0.165, 0.135, 0.11, 0.085, 0.065, 0.05};

// Dots of size s, from 1, have the label s + 1.
constexpr int label_of(int size) {
  return size + 1;
}

}  // namespace

Model dots_model(const Stage& stage, Draw draw) {
  const double wall = draw.between(-0.8, 0);
  const double dots = wall + draw.between(0.6, 1.5);
  const double pixel = stage.pixel(stage.depth(dots));
  Model model;
  model.primitives.push_back(make_plane(stage, {wall, 0, 0}));
  model.primitives.back().label = kWall;
  model.add(strong_texture(draw.part(0), stage.pixel(stage.depth(wall))));
  model.add(strong_texture(draw.part(1), pixel));

  const double width = static_cast<double>(stage.width) / kBoxes;
  const double height = static_cast<double>(stage.height) / kBoxes;
  for (int i = 0; i < kBoxes * kBoxes * kSizes; ++i) {
    const int size = i % kSizes + 1;
    const int box = i / kSizes;
    const int cell = (size + 2 * box) % (kCells * kCells);
    // At the centre of a pixel, so that the smallest dot has at least this one.
    const double x = std::floor((box % kBoxes + (cell % kCells + 0.5) / kCells) * width);
    const double y = std::floor((box / kBoxes + (cell / kCells + 0.5) / kCells) * height);
    const double radius = 0.5 * kDiameters[size - 1] * std::min(width, height);
    Primitive dot = make_card(stage, {x - radius, y - radius, x + radius, y + radius, dots});
    dot.shape = Shape::Disc;
    dot.label = label_of(size);
    dot.texture = 1;
    model.primitives.push_back(dot);
  }
  model.sensor = growing_noise(draw.part(2), 4, 12);
  return model;
}

Regions dots_regions(const Stage& stage, CenterLabels labels) {
  Image<std::uint8_t> sizes(stage.height, stage.width);
  Image<std::uint8_t> boxes(stage.height, stage.width);
  for (int y = 0; y < stage.height; ++y) {
    for (int x = 0; x < stage.width; ++x) {
      const int label = labels.at(y, x);
      if (label >= label_of(1)) sizes.at(y, x) = static_cast<std::uint8_t>(label - label_of(0));
      const int box = y * kBoxes / stage.height * kBoxes + x * kBoxes / stage.width;
      boxes.at(y, x) = static_cast<std::uint8_t>(box + 1);
    }
  }
  Regions regions;
  regions.emplace("dots_by_size", std::move(sizes));
  regions.emplace("boxes", std::move(boxes));
  regions.emplace("background", region_of(labels, kWall));
  return regions;
}

}  // namespace episcope::scenes
