// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open/assemble_scene.h"

#include "engine/core/array/forget_view.h"
#include "engine/core/light_field/many_views.h"
#include "engine/io/maps/float_samples.h"
#include "engine/io/open/black_corners.h"
#include "engine/io/open/empty_pixels.h"
#include "engine/io/open/equalise.h"
#include "engine/io/open/filled_views.h"
#include "engine/io/open/order_parts.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace episcope::io {
namespace {

std::string place_text(const LightField::Samples& samples) {
  switch (std::visit([](const auto& stack) { return stack.kind(); }, samples)) {
    case LargeKind::File:
      return "; mapped: read from the file when they are looked at";
    case LargeKind::Scratch:
      return "; unpacked to a scratch file, too large for memory";
    default:
      return "";
  }
}

void crop_positions(std::vector<CameraPosition>& positions, const ViewCrop& crop) {
  if (positions.size() != static_cast<std::size_t>(crop.stored.count())) return;
  std::vector<CameraPosition> kept;
  kept.reserve(static_cast<std::size_t>(crop.kept.count()));
  for (int i = 0; i < crop.kept.count(); ++i) {
    const ViewIndex stored = crop.kept.view_at(i, crop.first);
    kept.push_back(positions[static_cast<std::size_t>(stored.v * crop.stored.u + stored.u)]);
  }
  positions = std::move(kept);
}

/// Parts in canonical order.
void crop_parts(SceneParts& parts, const ViewCrop& crop) {
  std::visit([&](auto& stack) { stack = cropped(std::move(stack), crop); }, parts.samples);
  crop_truth(parts.truth, crop);
  crop_positions(parts.info.positions, crop);
  parts.valid = cropped(std::move(parts.valid), crop);
}

/// What was looked at so far of views that are on disk need not be held.
void forget(const LightField::Samples& samples) {
  std::visit(
      [](const auto& stack) {
        for (int i = 0; i < stack.grid().count(); ++i) forget_view(stack, stack.view_at(i));
      },
      samples);
}

ViewCrop find_crop(const std::string& option, GridShape stored, const ViewBrightness& brightness) {
  if (option == "all") return central_crop(stored, stored);
  return option.empty() ? filled_crop(brightness) : parse_crop(option, stored);
}

bool are_on_disk(const LightField::Samples& samples) {
  return std::visit([](const auto& stack) { return stack.is_on_disk(); }, samples);
}

/// All of a light field that is on disk would take as long to look at as to read, and all of one of
/// many views is more than is needed: where a first look finds nothing dark, that is all.
ViewBrightness find_brightness(const SceneParts& parts, const Progress& progress) {
  if (are_on_disk(parts.samples) || has_many_views(grid_of(parts.samples))) {
    ViewBrightness brightness =
        measure_brightness(parts.samples, parts.valid, BrightnessRows::Few, progress);
    if (!brightness.has_dark_parts()) return brightness;
  }
  return measure_brightness(parts.samples, parts.valid, BrightnessRows::EverySecond, progress);
}

/// Leaves out views that are dark, or that the user does not want, and marks dark pixels of the
/// others.
void keep_what_was_seen(SceneParts& parts, const OpenOptions& options, ConventionReport& report,
                        const Progress& progress) {
  progress.step("looking for dark views");
  ViewBrightness brightness = find_brightness(parts, progress);
  forget(parts.samples);
  const ViewCrop crop = find_crop(options.crop, grid_of(parts.samples), brightness);
  if (crop.leaves_out()) {
    if (options.crop.empty()) report.warnings.push_back(crop_text(crop, brightness));
    crop_parts(parts, crop);
    brightness.cells = cropped(std::move(brightness.cells), crop);
    report.crop = crop;
  }
  const auto [height, width] = std::visit(
      [](const auto& stack) { return std::pair(stack.height(), stack.width()); }, parts.samples);
  for (std::string text : {mark_empty_pixels(brightness, height, width, parts.valid, progress),
                           mark_black_corners(parts.samples, parts.valid, progress)}) {
    if (!text.empty()) report.warnings.push_back(std::move(text));
  }
  if (parts.valid.empty()) return;
  const std::uint8_t* valid = parts.valid.data();
  const bool is_whole =
      std::all_of(valid, valid + parts.valid.size(), [](std::uint8_t pixel) { return pixel != 0; });
  if (is_whole) parts.valid = {};
}

}  // namespace

void assemble(SceneParts parts, const OpenOptions& options, Scene& scene,
              const Progress& progress) {
  bring_in_order(parts, options, scene.convention, progress);
  scene.convention.files = std::move(parts.files);
  zero_nonfinite_samples(parts.samples, scene.convention);
  keep_what_was_seen(parts, options, scene.convention, progress);
  equalise_views(parts, options, scene.convention, progress);
  std::string& samples_text = scene.convention.samples;
  if (samples_text.empty()) samples_text = stored_samples_text(parts.samples);
  samples_text += place_text(parts.samples);
  parts.info.reading.options = given_options(options);
  parts.info.reading.set_focus(0);  // baked in afterwards, if at all
  scene.light_field = std::make_shared<LightField>(std::move(parts.samples), std::move(parts.info),
                                                   std::move(parts.valid));
  if (!options.needs_truth) parts.truth = {};
  scene.truth = std::make_shared<GroundTruth>(std::move(parts.truth));
}

}  // namespace episcope::io
