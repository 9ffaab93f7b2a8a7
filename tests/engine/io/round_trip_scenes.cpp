// SPDX-License-Identifier: BSD-3-Clause
#include "tests/engine/io/round_trip_scenes.h"

#include "tests/engine/io/synthetic_scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace episcope::test {
namespace {

/// Samples of another type with the same picture, and all their bits in use.
template <class T>
LightField::Samples samples_as(const ViewStack<std::uint8_t>& bytes) {
  ViewStack<T> stack(bytes.grid(), bytes.height(), bytes.width(), bytes.channels());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const unsigned byte = bytes.data()[i];
    if constexpr (std::is_same_v<T, float>) {
      stack.data()[i] = static_cast<float>(byte) / 251.0F + 1e-6F * static_cast<float>(i % 7);
    } else if constexpr (std::is_same_v<T, std::uint16_t>) {
      stack.data()[i] = static_cast<std::uint16_t>(byte * 256 + i % 251);
    } else {
      stack.data()[i] = bytes.data()[i];
    }
  }
  return stack;
}

struct SceneOptions {
  GridShape grid{3, 3};
  int channels = 3;
  bool has_camera = true;
  bool has_mask = false;
  bool has_positions = false;
};

template <class T>
Scene scene_of(const SceneOptions& options) {
  // Flat enough that no surface hides another, steep enough to tell the order of views.
  Scene scene = plane_scene({.grid = options.grid,
                             .height = 30,
                             .width = 41,
                             .d0 = 0.4,
                             .slope_x = 0.01,
                             .slope_y = -0.012,
                             .channels = options.channels});
  LightFieldInfo info = scene.light_field->info();
  if (!options.has_camera) info.camera = {};
  for (int i = 0; options.has_positions && i < options.grid.count(); ++i) {
    info.positions.push_back({0.1 * (i % options.grid.u), -3.25 * (i / options.grid.u)});
    info.position_unit = "mm";
  }
  ViewStack<std::uint8_t> valid;
  if (options.has_mask) {
    valid = ViewStack<std::uint8_t>(options.grid, 30, 41);
    for (std::size_t i = 0; i < valid.size(); ++i) valid.data()[i] = i % 41 > 2 ? 1 : 0;
  }
  scene.light_field = std::make_shared<LightField>(samples_as<T>(bytes_of(scene)), std::move(info),
                                                   std::move(valid));
  return scene;
}

template <class T>
ViewStack<T> center_of(const ViewStack<T>& stack) {
  const ViewIndex center = stack.grid().center();
  ViewStack<T> one({1, 1}, stack.height(), stack.width(), 1, center);
  std::copy_n(stack.view(center).data, stack.view_size(), one.data());
  return one;
}

Scene with_truth(Scene scene, const std::function<void(GroundTruth&)>& change) {
  GroundTruth truth;
  truth.field.disparity = scene.truth->field.disparity.clone();
  truth.labels = scene.truth->labels.clone();
  change(truth);
  scene.truth = std::make_shared<GroundTruth>(std::move(truth));
  return scene;
}

void keep_center(GroundTruth& truth) {
  truth.field.disparity = center_of(truth.field.disparity);
  truth.labels = center_of(truth.labels);
}

/// Pixels at the left border and one inside hold no disparity.
void punch_holes(GroundTruth& truth) {
  ViewStack<float>& disparity = truth.field.disparity;
  truth.field.valid = ViewStack<std::uint8_t>(disparity.grid(), disparity.height(),
                                              disparity.width(), 1, disparity.first());
  for (std::size_t i = 0; i < disparity.size(); ++i) {
    const bool is_valid = i % 41 != 0 && i % 1230 != 600;
    truth.field.valid.data()[i] = is_valid ? 1 : 0;
    if (!is_valid) disparity.data()[i] = 0;
  }
}

void add_layers(GroundTruth& truth) {
  truth.foreground.disparity = truth.field.disparity.clone();
  truth.background.disparity = truth.field.disparity.clone();
  for (std::size_t i = 0; i < truth.background.disparity.size(); ++i) {
    truth.background.disparity.data()[i] -= 0.5F;
  }
  truth.field = {};
}

void add_regions(GroundTruth& truth) {
  for (const char* name : {"planes", "fine_surrounding"}) {
    Image<std::uint8_t> region(30, 41);
    for (int x = 0; x < 20; ++x) region.at(7, x) = 1;
    truth.regions.emplace(name, std::move(region));
  }
}

/// 0 = no label, and a label that does not fit into a byte.
void add_odd_labels(GroundTruth& truth) {
  for (std::size_t i = 0; i < truth.labels.size(); ++i) {
    if (i % 41 < 3) truth.labels.data()[i] = i % 41 == 2 ? 300 : 0;
  }
}

bool equal(const LightField& a, const LightField& b) {
  return a.sample_type() == b.sample_type() && a.sample_hash() == b.sample_hash();
}

/// The light field that a form of 16 bit keeps of float samples.
LightField rounded(const LightField& field) {
  const auto& floats = std::get<ViewStack<float>>(field.samples());
  ViewStack<std::uint16_t> stack(floats.grid(), floats.height(), floats.width(), floats.channels());
  std::transform(floats.data(), floats.data() + floats.size(), stack.data(), [](float sample) {
    return static_cast<std::uint16_t>(std::lround(65535 * std::clamp(sample, 0.0F, 1.0F)));
  });
  return {std::move(stack), field.info()};
}

/// The middle row of views.
LightField row_of(const LightField& field) {
  return std::visit(
      [&]<class T>(const ViewStack<T>& all) {
        ViewStack<T> row({1, all.grid().u}, all.height(), all.width(), all.channels());
        std::copy_n(all.view({all.grid().center().v, 0}).data, row.size(), row.data());
        return LightField(std::move(row), field.info());
      },
      field.samples());
}

template <class T>
bool equal(const ViewStack<T>& a, const ViewStack<T>& b) {
  if (a.empty() || b.empty()) return a.empty() && b.empty();
  return a.grid() == b.grid() && a.first() == b.first() && a.height() == b.height() &&
         a.width() == b.width() && std::equal(a.data(), a.data() + a.size(), b.data());
}

/// What of a stack of maps a form holds.
template <class T>
ViewStack<T> held(const ViewStack<T>& stack, io::MapsHeld how, ViewIndex center) {
  if (stack.empty() || how == io::MapsHeld::None) return {};
  if (how == io::MapsHeld::All) return stack.clone();
  return stack.contains(center) ? (stack.grid().count() == 1 ? stack.clone() : center_of(stack))
                                : ViewStack<T>{};
}

DisparityField held(const DisparityField& field, io::MapsHeld how, ViewIndex center) {
  return {held(field.disparity, how, center), held(field.valid, how, center)};
}

bool equal(const DisparityField& a, const DisparityField& b, double tolerance) {
  if (a.empty() || b.empty()) return a.empty() && b.empty();
  return largest_difference(a, b) <= tolerance;
}

bool equal(const Scribbles& a, const Scribbles& b) {
  const auto is_same = [](const ViewScribbles& x, const ViewScribbles& y) {
    return x.view == y.view &&
           std::equal(x.labels.begin(), x.labels.end(), y.labels.begin(), y.labels.end());
  };
  return std::equal(a.views.begin(), a.views.end(), b.views.begin(), b.views.end(), is_same);
}

bool equal(const std::map<std::string, Image<std::uint8_t>>& a,
           const std::map<std::string, Image<std::uint8_t>>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.first == y.first &&
           std::equal(x.second.begin(), x.second.end(), y.second.begin(), y.second.end());
  });
}

bool near(double a, double b) {
  return std::abs(a - b) <= 1e-12 * std::max({1.0, std::abs(a), std::abs(b)});
}

/// Forms may hold B·f and not its factors.
bool equal(const CameraGrid& a, const CameraGrid& b) {
  return a.is_known() == b.is_known() &&
         (!a.is_known() || (near(a.baseline * a.focal_length, b.baseline * b.focal_length) &&
                            near(a.shift, b.shift)));
}

bool has_same_positions(const LightFieldInfo& a, const LightFieldInfo& b) {
  return a.position_unit == b.position_unit &&
         std::equal(a.positions.begin(), a.positions.end(), b.positions.begin(), b.positions.end(),
                    [](CameraPosition x, CameraPosition y) { return x.x == y.x && x.y == y.y; });
}

}  // namespace

std::vector<RoundTripScene> round_trip_scenes() {
  const auto rgb8 = [] { return scene_of<std::uint8_t>({}); };
  return {
      {"8-bit RGB, 3x3, truth and labels of all views", rgb8},
      {"16-bit RGB, 2x4, truth and labels of the center",
       [] {
         return with_truth(scene_of<std::uint16_t>({.grid = {2, 4}}), keep_center);
       }},
      {"8-bit grey, 4x3, positions",
       [] {
         return scene_of<std::uint8_t>({.grid = {4, 3}, .channels = 1, .has_positions = true});
       }},
      {"16-bit grey, 3x3, no camera",
       [] { return scene_of<std::uint16_t>({.channels = 1, .has_camera = false}); }},
      {"float RGB, 3x3, mask of pixels", [] { return scene_of<float>({.has_mask = true}); }},
      {"float grey, 3x2",
       [] {
         return scene_of<float>({.grid = {3, 2}, .channels = 1});
       }},
      {"one row of 7",
       [] {
         return scene_of<std::uint8_t>({.grid = {1, 7}});
       }},
      {"one column of 5",
       [] {
         return scene_of<std::uint16_t>({.grid = {5, 1}});
       }},
      {"holes in the truth", [=] { return with_truth(rgb8(), punch_holes); }},
      {"holes in the truth of the center",
       [=] {
         return with_truth(rgb8(), [](GroundTruth& truth) {
           keep_center(truth);
           punch_holes(truth);
         });
       }},
      {"labels from 0 to 300", [=] { return with_truth(rgb8(), add_odd_labels); }},
      {"layers", [=] { return with_truth(rgb8(), add_layers); }},
      {"regions", [=] { return with_truth(rgb8(), add_regions); }},
      {"no truth, no labels",
       [=] {
         Scene scene = with_truth(rgb8(), [](GroundTruth& truth) { truth = {}; });
         scene.scribbles = {};
         return scene;
       }},
  };
}

io::FormContents common_contents(const io::FormContents& a, const io::FormContents& b) {
  return {.floats = std::min(a.floats, b.floats),
          .disparity = std::min(a.disparity, b.disparity),
          .is_depth = a.is_depth || b.is_depth,
          .has_origin = a.has_origin && b.has_origin,
          .has_layers = a.has_layers && b.has_layers,
          .labels = std::min(a.labels, b.labels),
          .has_scribbles = a.has_scribbles && b.has_scribbles,
          .has_regions = a.has_regions && b.has_regions,
          .has_valid = a.has_valid && b.has_valid,
          .camera = std::min(a.camera, b.camera),
          .has_range = a.has_range && b.has_range,
          .has_positions = a.has_positions && b.has_positions,
          .has_rows = a.has_rows && b.has_rows};
}

std::string difference(const Scene& scene, const io::FormContents& holds, const Scene& read) {
  const LightField& field = *scene.light_field;
  const LightFieldInfo& info = field.info();
  const GroundTruth& truth = *scene.truth;
  const LightFieldInfo& read_info = read.light_field->info();
  const GroundTruth& read_truth = *read.truth;
  // Depth is held in float: within (d + Δx)·2⁻²³, and d + Δx is below 8 here.
  const double tolerance = holds.is_depth ? 1e-6 : 0;
  std::string text;
  const auto require = [&](bool is_equal, const char* what) {
    if (!is_equal) text += std::string(text.empty() ? "" : ", ") + what;
  };
  const bool is_rounded =
      field.sample_type() == SampleType::Float32 && holds.floats == io::FloatsHeld::Rounded;
  const bool is_row = !holds.has_rows;
  require(read.light_field->grid() == (is_row ? GridShape{1, field.grid().u} : field.grid()),
          "grid");
  require(is_row       ? equal(row_of(field), *read.light_field)
          : is_rounded ? equal(rounded(field), *read.light_field)
                       : equal(field, *read.light_field),
          "samples");
  require(equal(held(truth.field, holds.disparity, field.center()), read_truth.field, tolerance),
          "disparity");
  const bool has_layers = holds.has_layers && truth.has_layers();
  require(has_layers ? equal(truth.foreground, read_truth.foreground, tolerance) &&
                           equal(truth.background, read_truth.background, tolerance)
                     : !read_truth.has_layers(),
          "layers");
  require(equal(held(truth.labels, holds.labels, field.center()), read_truth.labels), "labels");
  require(equal(holds.has_regions ? truth.regions : decltype(truth.regions){}, read_truth.regions),
          "regions");
  require(holds.has_scribbles ? equal(scene.scribbles, read.scribbles) : read.scribbles.empty(),
          "scribbles");
  require(holds.has_valid ? equal(field.valid(), read.light_field->valid())
                          : read.light_field->valid().empty(),
          "mask of valid pixels");
  require(
      equal(holds.camera == io::CamerasHeld::None ? CameraGrid{} : info.camera, read_info.camera),
      "camera");
  require((holds.has_range ? info.disparity_range : std::nullopt) == read_info.disparity_range,
          "range");
  require(holds.has_positions ? has_same_positions(info, read_info) : read_info.positions.empty(),
          "positions");
  return text;
}

}  // namespace episcope::test
