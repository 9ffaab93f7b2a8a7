// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/stratified_scene.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace episcope::scenes {
namespace {

constexpr int kWallLabel = 1;

/// The pixels for which `is_inside(y, x)` holds.
template <class IsInside>
Image<std::uint8_t> region_where(CenterLabels labels, IsInside is_inside) {
  Image<std::uint8_t> mask(labels.height, labels.width);
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) mask.at(y, x) = is_inside(y, x) ? 1 : 0;
  }
  return mask;
}

[[nodiscard]] inline Image<std::uint8_t> region_of(CenterLabels labels, int label) {
  return region_where(labels, [&](int y, int x) { return labels.at(y, x) == label; });
}

// A strong random texture where a pixel has size `pixel_units`, without patterns that repeat.
Texture strong_texture(Draw draw, double pixel_units) {
  std::array<float, 3> color{};
  const double brightness = draw.between(0.35, 0.65);
  for (float& channel : color) {
    channel = static_cast<float>(brightness + draw.between(-0.12, 0.12));
  }
  const double contrast = draw.between(0.35, 0.6);
  const unsigned seed = draw.bits();
  Texture texture = noise_texture(pixel_units, seed, color, static_cast<float>(contrast));
  texture.fades = true;
  return texture;
}

double disparity_at(const Stage& stage, const DisparityPlane& plane, double x, double y) {
  return plane.center + plane.per_x * (x - (stage.width - 1) / 2.0) +
         plane.per_y * (y - (stage.height - 1) / 2.0);
}

// The size of a pixel where a plane is farthest from the cameras: a texture that is resolved there
// is resolved everywhere.
double coarsest_pixel(const Stage& stage, const DisparityPlane& plane) {
  double coarsest = 0;
  for (const double y : {0.0, stage.height - 1.0}) {
    for (const double x : {0.0, stage.width - 1.0}) {
      const double depth = stage.depth(disparity_at(stage, plane, x, y));
      coarsest = std::max(coarsest, stage.pixel(depth));
    }
  }
  return coarsest;
}

// Moves a primitive to the point of a plane that is seen at a pixel of the center view.
void move_to(Primitive& primitive, const Stage& stage, const DisparityPlane& plane, double x,
             double y) {
  const Vector3 at = stage.point(x, y, stage.depth(disparity_at(stage, plane, x, y)));
  std::copy(at.begin(), at.end(), primitive.center);
}

// Noise that grows downwards, up to `least` … `most` units of 1/255.
Sensor growing_noise(Draw draw, double least, double most) {
  Sensor sensor;
  sensor.noise_bottom = static_cast<float>(draw.between(least, most));
  return sensor;
}

constexpr int kTeeth = 2;

// Columns of the center view where the strip ends and where the tips lie. The metrics look for the
// foreground in column 14 and for the wall in the eleventh column from the right.
int strip_end(const Stage& stage) {
  return std::max(28, stage.width / 8);
}
int tip_column(const Stage& stage) {
  return std::max(strip_end(stage) + 4, stage.width - strip_end(stage));
}

// Teeth that taper to the right from a strip at the left, before a wall; both slant so that the
// step between them grows downwards, up to 0.9 … 1.5 px. Half of the seeds have noise that grows
// downwards. Masks between the strip and the last tip: `foreground_fattening`, the gaps, and
// `foreground_thinning`, the teeth.
Model backgammon_model(const Stage& stage, Draw draw) {
  DisparityPlane wall;
  wall.center = draw.between(-0.8, -0.2);
  wall.per_y = draw.between(-0.3, 0.3) / stage.height;
  const double least_step = draw.between(0.15, 0.4);
  const double most_step = draw.between(0.9, 1.5);
  DisparityPlane teeth = wall;
  teeth.center += (least_step + most_step) / 2;
  teeth.per_y += (most_step - least_step) / stage.height;
  const int count = draw.integer(5, 8);

  Model model;
  const auto add = [&](Primitive primitive, int label) {
    primitive.label = label;
    primitive.texture = label - 1;
    model.primitives.push_back(primitive);
  };
  model.add(strong_texture(draw.part(0), coarsest_pixel(stage, wall)));
  model.add(strong_texture(draw.part(1), coarsest_pixel(stage, teeth)));
  add(make_plane(stage, wall), kWallLabel);

  const double base = strip_end(stage) - 0.5;
  const double half_width = (tip_column(stage) - strip_end(stage)) / 2.0;
  Primitive tooth = make_plane(stage, teeth);
  Primitive strip = tooth;
  move_to(strip, stage, teeth, base, (stage.height - 1) / 2.0);
  strip.extent[0] = 1e3 * stage.pixel(strip.center[2]);
  for (int k = 0; k < 3; ++k) strip.center[k] -= strip.extent[0] * strip.axes[0][k];
  add(strip, kTeeth);
  tooth.shape = Shape::Triangle;
  for (int i = 0; i < count; ++i) {
    move_to(tooth, stage, teeth, base + half_width, (i + 0.5) * stage.height / count - 0.5);
    tooth.extent[0] = half_width * stage.pixel(tooth.center[2]);
    tooth.extent[1] = 0.5 * stage.height / count * stage.pixel(tooth.center[2]);
    add(tooth, kTeeth);
  }
  if (draw.chance(0.5)) model.sensor = growing_noise(draw.part(2), 3, 8);
  return model;
}

Regions backgammon_regions(const Stage& stage, CenterLabels labels) {
  // The strip slants with its plane: at the top its side stands further right.
  const int begin = strip_end(stage) + stage.width / 16;
  const int end = tip_column(stage);
  const auto region = [&](int label) {
    return region_where(
        labels, [&](int y, int x) { return x >= begin && x < end && labels.at(y, x) == label; });
  };
  Regions regions;
  regions.emplace("foreground_fattening", region(kWallLabel));
  regions.emplace("foreground_thinning", region(kTeeth));
  return regions;
}

constexpr int kSizes = 8;
constexpr int kBoxes = 4;     // Along each side of a view.
constexpr int kBoxCells = 3;  // Along each side of a box; one of the nine stays empty.

// Diameters as shares of the side of a box.
constexpr double kDiameters[kSizes] = {0.25, 0.2, 0.165, 0.135, 0.11, 0.085, 0.065, 0.05};

// Dots of size s, from 1, have the label s + 1.
constexpr int label_of(int size) {
  return size + 1;
}

// 4×4 boxes, each with a dot of every size from 1 (a quarter of the box) to 8 (a twentieth),
// 0.6 … 1.5 px before a wall, under noise that grows from nothing at the top to 4 … 12/255 at the
// bottom. Masks: `dots_by_size` and `boxes`, both numbered, and `background`.
Model dots_model(const Stage& stage, Draw draw) {
  const double wall = draw.between(-0.8, 0);
  const double dots = wall + draw.between(0.6, 1.5);
  const double pixel = stage.pixel(stage.depth(dots));
  Model model;
  model.primitives.push_back(make_plane(stage, {wall, 0, 0}));
  model.primitives.back().label = kWallLabel;
  model.add(strong_texture(draw.part(0), stage.pixel(stage.depth(wall))));
  model.add(strong_texture(draw.part(1), pixel));

  const double width = static_cast<double>(stage.width) / kBoxes;
  const double height = static_cast<double>(stage.height) / kBoxes;
  for (int i = 0; i < kBoxes * kBoxes * kSizes; ++i) {
    const int size = i % kSizes + 1;
    const int box = i / kSizes;
    const int cell = (size + 2 * box) % (kBoxCells * kBoxCells);
    // At the center of a pixel, so that the smallest dot has at least this one.
    const double x = std::floor((box % kBoxes + (cell % kBoxCells + 0.5) / kBoxCells) * width);
    const double y = std::floor((box / kBoxes + (cell / kBoxCells + 0.5) / kBoxCells) * height);
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
  regions.emplace("background", region_of(labels, kWallLabel));
  return regions;
}

constexpr int kPyramids = 2;
constexpr int kBall = 3;
constexpr int kBowl = 4;
constexpr int kViewCells = 3;  // Along each side of a view.

class Builder {
 public:
  Builder(const Stage& stage, double wall, Draw draw)
      : stage_(stage), wall_depth_(stage.depth(wall)), draw_(draw) {
    Primitive plane = make_plane(stage, {wall, 0, 0});
    add(plane, kWallLabel);
  }

  // Its base stands on the wall around a pixel, its tip before the middle of the base.
  void add_pyramid(double x, double y, double half_px, double tip) {
    const Vector3 base = stage_.point(x, y, wall_depth_);
    const double half = half_px * stage_.pixel(wall_depth_);
    const double height = wall_depth_ - stage_.depth(tip);
    const double slope = std::sqrt(half * half + height * height);
    for (const auto& [out_x, out_y] : {std::pair{1, 0}, {0, 1}, {-1, 0}, {0, -1}}) {
      // From the middle of a side of the base to the tip, and along that side.
      const Vector3 up{-out_x * half / slope, -out_y * half / slope, -height / slope};
      const Vector3 along{-1.0 * out_y, 1.0 * out_x, 0};
      Primitive face;
      face.shape = Shape::Triangle;
      set_axes(face, up, along, cross(up, along));
      face.center[0] = base[0] + out_x * half / 2;
      face.center[1] = base[1] + out_y * half / 2;
      face.center[2] = base[2] - height / 2;
      face.extent[0] = slope / 2;
      face.extent[1] = half;
      add(face, kPyramids);
    }
  }

  // Half a ball on the wall, or the other half, open to the cameras, that touches it.
  void add_half_ball(double x, double y, double radius_px, int label) {
    const double radius = radius_px * stage_.pixel(wall_depth_);
    const Vector3 base = stage_.point(x, y, wall_depth_);
    Primitive ball;
    ball.shape = Shape::Revolution;
    std::copy(base.begin(), base.end(), ball.center);
    set_axes(ball, {1, 0, 0}, {0, 0, -1}, {0, 1, 0});  // Its axis points at the cameras.
    ball.profile[0] = radius * radius;
    ball.profile[2] = -1;
    ball.extent[0] = 0;
    ball.extent[1] = radius;
    if (label == kBowl) {
      ball.center[2] -= radius;
      ball.extent[0] = -radius;
      ball.extent[1] = 0;
    }
    add(ball, label);
  }

  Model take() { return std::move(model_); }

 private:
  void add(Primitive primitive, int label) {
    Texture texture =
        strong_texture(draw_.part(model_.primitives.size()), stage_.pixel(wall_depth_));
    texture.is_solid = primitive.shape == Shape::Revolution;
    primitive.texture = model_.add(texture);
    primitive.label = label;
    model_.primitives.push_back(primitive);
  }

  const Stage& stage_;
  double wall_depth_;
  Draw draw_;
  Model model_;
};

// Seven pyramids, a ball and a bowl before a wall that faces the cameras. Masks: `pyramids`,
// `sphere_out` (the ball), `sphere_in` (the bowl) and `plane` (the wall).
Model pyramids_model(const Stage& stage, Draw draw) {
  const double wall = draw.between(-0.8, -0.3);
  Builder builder(stage, wall, draw.part(0));
  const int ball = draw.integer(0, 3);
  const int bowl = draw.integer(5, 8);
  const double cell = static_cast<double>(std::min(stage.width, stage.height)) / kViewCells;
  for (int i = 0; i < kViewCells * kViewCells; ++i) {
    const double x = (i % kViewCells + 0.5) * stage.width / kViewCells - 0.5;
    const double y = (i / kViewCells + 0.5) * stage.height / kViewCells - 0.5;
    const double half = cell * draw.between(0.28, 0.36);
    const double tip = wall + draw.between(0.4, 1.4);
    if (i == ball || i == bowl) {
      // Seen from before, a deep one would hide its neighbors.
      builder.add_half_ball(x, y, 0.9 * half, i == ball ? kBall : kBowl);
    } else {
      builder.add_pyramid(x, y, half, tip);
    }
  }
  return builder.take();
}

Regions pyramids_regions(const Stage& /*stage*/, CenterLabels labels) {
  Regions regions;
  regions.emplace("plane", region_of(labels, kWallLabel));
  regions.emplace("pyramids", region_of(labels, kPyramids));
  regions.emplace("sphere_out", region_of(labels, kBall));
  regions.emplace("sphere_in", region_of(labels, kBowl));
  return regions;
}

constexpr int kDark = 2;
constexpr int kBright = 3;
constexpr int kBands = 4;
constexpr int kBars = 12;
constexpr float kContrasts[kBands] = {0.4F, 0.2F, 0.1F, 0.05F};

// Far beyond the image in px, so that every view is filled.
constexpr double kBeyondImage = 1e4;

// The row of the center view, between pixels, where a band begins.
double band_top(const Stage& stage, int band) {
  if (band == 0) return -kBeyondImage;
  if (band == kBands) return kBeyondImage;
  return stage.height * band / kBands - 0.5;
}

class Weaver {
 public:
  Weaver(const Stage& stage, Draw draw) : stage_(stage), draw_(draw) {}

  // Adds one card in each band.
  void add(double left, double right, double disparity, int label, float brightness) {
    const double pixel = stage_.pixel(stage_.depth(disparity));
    for (int band = 0; band < kBands; ++band) {
      Primitive card = make_card(
          stage_, {left, band_top(stage_, band), right, band_top(stage_, band + 1), disparity});
      const std::array<float, 3> color{brightness, brightness * 0.97F, brightness * 0.92F};
      card.texture =
          model_.add(noise_texture(pixel, draw_.bits(), color, kContrasts[band] * contrast_));
      card.label = label;
      model_.primitives.push_back(card);
    }
  }

  Model take() { return std::move(model_); }

 private:
  const Stage& stage_;
  Draw draw_;
  float contrast_ = 0.8F;
  Model model_;
};

// Upright bars, dark and bright in turn, that widen to the right, 0.3 … 1.5 px before a bright
// wall; in four bands from the top the texture loses its contrast. Half of the seeds have noise
// that grows downwards. Masks: `low_texture`, the wall in the lower two bands, `high_contrast`,
// the dark bars, and `low_contrast`, the bright ones.
Model stripes_model(const Stage& stage, Draw draw) {
  const double wall = draw.between(-0.8, -0.1);
  Weaver weaver(stage, draw.part(0));
  weaver.add(-kBeyondImage, kBeyondImage, wall, kWallLabel, 0.66F);
  const double pitch = static_cast<double>(stage.width) / kBars;
  for (int i = 0; i < kBars; ++i) {
    const double share = (i + 1.0) / (kBars + 1);
    const double half = pitch * (0.05 + 0.25 * share);
    const double middle = (i + 0.5) * pitch;
    const double step = draw.between(0.3, 1.5);
    const bool is_dark = i % 2 == 0;
    weaver.add(middle - half, middle + half, wall + step, is_dark ? kDark : kBright,
               is_dark ? 0.25F : 0.72F);
  }
  Model model = weaver.take();
  if (draw.chance(0.5)) model.sensor = growing_noise(draw.part(1), 2, 6);
  return model;
}

Regions stripes_regions(const Stage& stage, CenterLabels labels) {
  const double lower = band_top(stage, kBands / 2);
  Regions regions;
  regions.emplace("low_texture", region_where(labels, [&](int y, int x) {
                    return y > lower && labels.at(y, x) == kWallLabel;
                  }));
  regions.emplace("high_contrast", region_of(labels, kDark));
  regions.emplace("low_contrast", region_of(labels, kBright));
  return regions;
}

}  // namespace

std::span<const StratifiedRecipe> stratified_recipes() {
  static constexpr StratifiedRecipe all[] = {
      {"backgammon", "teeth before a wall, from a small step at the top to a large one",
       StratifiedScene::Backgammon, backgammon_model, backgammon_regions},
      {"dots", "dots of eight sizes before a wall, under noise that grows downwards",
       StratifiedScene::Dots, dots_model, dots_regions},
      {"stripes", "dark and bright bars before a wall, with less and less texture downwards",
       StratifiedScene::Stripes, stripes_model, stripes_regions},
      {"pyramids", "pyramids, a ball and a bowl on a wall", StratifiedScene::Pyramids,
       pyramids_model, pyramids_regions},
  };
  return all;
}

const StratifiedRecipe* find_stratified(const std::string& id) {
  const auto all = stratified_recipes();
  const auto found = std::ranges::find(all, std::string_view(id), &StratifiedRecipe::id);
  return found == all.end() ? nullptr : &*found;
}

Model stratified_model(const StratifiedRecipe& recipe, const Stage& stage, unsigned seed) {
  const Draw draw(seed);
  return recipe.lay_out(stage, draw.part(static_cast<std::uint64_t>(recipe.kind)));
}

void add_regions(const StratifiedRecipe& recipe, const Stage& stage, ViewIndex center,
                 GroundTruth& truth) {
  truth.stratified = recipe.kind;
  truth.regions.merge(recipe.regions(stage, truth.labels.view(center)));
}

}  // namespace episcope::scenes
