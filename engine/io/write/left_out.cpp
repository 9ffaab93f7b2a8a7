// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/write/writer.h"

#include <fmt/format.h>

#include <algorithm>

namespace episcope::io {
namespace {

/// Gathers a sentence for each kind that a form cannot hold.
class Losses {
 public:
  Losses(const Writer& writer, const Scene& scene) : writer_(writer), scene_(scene) {}

  /// A kind that is held whole or not at all; `kind` is a plural.
  void compare(bool has_it, bool holds_it, const char* kind) {
    if (has_it && !holds_it) {
      sentences_.push_back(fmt::format("{} holds no {}; they are left out.", form(), kind));
    }
  }

  /// Maps that a form holds of all views, of the centre view or not at all.
  template <class T>
  void compare_maps(const ViewStack<T>& stack, MapsHeld held, const char* kind) {
    if (stack.empty()) return;
    if (held == MapsHeld::None) return compare(true, false, kind);
    const bool has_center = stack.contains(scene_.light_field->center());
    if (held == MapsHeld::All || (has_center && stack.grid().count() == 1)) return;
    sentences_.push_back(fmt::format("{} holds {} of the centre view only; {} left out.", form(),
                                     kind, has_center ? "those of the others are" : "all are"));
  }

  void add(const std::string& sentence) { sentences_.push_back(form() + sentence); }
  [[nodiscard]] std::vector<std::string> take() { return std::move(sentences_); }

 private:
  /// The name of the form at the beginning of a sentence.
  [[nodiscard]] std::string form() const {
    std::string name = writer_.name;
    name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
    return name;
  }

  const Writer& writer_;
  const Scene& scene_;
  std::vector<std::string> sentences_;
};

/// Valid pixels whose disparity belongs to no positive depth.
std::size_t beyond_infinity(const DisparityField& field, const CameraGrid& camera) {
  if (field.empty() || !camera.is_known()) return 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < field.disparity.size(); ++i) {
    const bool is_valid = field.valid.empty() || field.valid.data()[i] != 0;
    const float d = field.disparity.data()[i];
    if (is_valid && std::isfinite(d) && !(camera.depth_from_disparity(d) > 0)) ++count;
  }
  return count;
}

void compare_camera(const LightFieldInfo& info, const FormContents& holds, Losses& losses) {
  const bool is_known = info.camera.is_known();
  if (is_known && holds.camera == CamerasHeld::Converging && !(info.camera.shift > 0)) {
    losses.add(" holds no parallel cameras whose shift is 0 or negative; the camera is left out.");
  } else if (is_known && holds.camera == CamerasHeld::None) {
    losses.add(" holds no camera; it is left out.");
  }
  if (info.disparity_range && !holds.has_range) {
    losses.add(" holds no range of disparities; it is left out.");
  }
  losses.compare(!info.positions.empty(), holds.has_positions, "positions of cameras");
}

}  // namespace

std::vector<std::string> left_out(const Writer& writer, const Scene& scene) {
  const LightField& field = *scene.light_field;
  const GroundTruth& truth = *scene.truth;
  const FormContents& holds = writer.holds;
  Losses losses(writer, scene);
  if (field.sample_type() == SampleType::Float32 && holds.floats == FloatsHeld::Rounded) {
    losses.add(" holds no float samples; they are rounded to 16 bit, and clamped to 0 … 1.");
  }
  compare_camera(field.info(), holds, losses);
  losses.compare_maps(truth.field.disparity, holds.disparity, "disparities");
  if (holds.is_depth) {
    const std::size_t lost = beyond_infinity(truth.field, field.info().camera);
    if (lost > 0) {
      losses.add(
          fmt::format(" holds depth, and {} pixels have disparities that belong to none; "
                      "they are left out.",
                      lost));
    }
  }
  losses.compare(truth.has_layers(), holds.has_layers, "layers");
  losses.compare_maps(truth.labels, holds.labels, "labels");
  losses.compare(!truth.regions.empty(), holds.has_regions, "region masks");
  losses.compare(truth.high_res != nullptr, false, "ground truth in high resolution");
  losses.compare(!scene.scribbles.empty(), holds.has_scribbles, "scribbles");
  losses.compare(!field.valid().empty(), holds.has_valid, "masks of valid pixels");
  return losses.take();
}

}  // namespace episcope::io
