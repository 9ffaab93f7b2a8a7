// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/open_scene.h"

#include "engine/core/text_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

template <class T>
std::size_t bytes_of(const ViewStack<T>& stack) {
  return stack.size() * sizeof(T);
}

std::size_t bytes_of(const DisparityField& field) {
  return bytes_of(field.disparity) + bytes_of(field.valid);
}

}  // namespace

std::size_t byte_size(const Estimate& estimate) {
  const LayeredDisparity& layered = estimate.layered;
  return bytes_of(estimate.field) + bytes_of(estimate.confidence) + bytes_of(layered.foreground) +
         bytes_of(layered.background) + bytes_of(layered.layers) + bytes_of(estimate.second);
}

std::size_t byte_size(const OpenScene& scene) {
  std::size_t bytes = 0;
  if (scene.scene) {
    const GroundTruth& truth = *scene.scene->truth;
    const LightField& light_field = *scene.scene->light_field;
    if (!light_field.is_on_disk()) bytes += light_field.byte_size();
    bytes += scene.scene->even->bytes();
    bytes += bytes_of(truth.field) + bytes_of(truth.foreground) + bytes_of(truth.background) +
             bytes_of(truth.labels);
  }
  for (const EstimateEntry& each : scene.estimates) {
    if (each.estimate) bytes += byte_size(*each.estimate);
  }
  if (scene.labels.labeling) {
    bytes += bytes_of(scene.labels.labeling->labels);
    for (const ProbabilityMap& map : scene.labels.labeling->probabilities.views) {
      bytes += map.view().size();
    }
  }
  return bytes;
}

ScenePlace within(const LightField& light_field, ScenePlace place) {
  const int height = light_field.height(), width = light_field.width();
  if (!light_field.grid().contains(place.view)) place.view = light_field.center();
  place.cross_hair = {std::clamp(place.cross_hair.y, 0, height - 1),
                      std::clamp(place.cross_hair.x, 0, width - 1)};
  JudgedPart& judged = place.judged;
  judged.rectangle = clipped(judged.rectangle, height, width);
  if (judged.rectangle.empty() && judged.pixels == JudgedPixels::Rectangle) {
    judged.pixels = JudgedPixels::Whole;
  }
  return place;
}

bool has_work(const ScenePlace& place) {
  return !place.measured.list.empty() || !place.capture.empty() || place.judged != JudgedPart{} ||
         place.label_marks != LabelMarks{} || !place.tone.is_plain();
}

const EpiMeasurement* current_of(const Measurements& measurements) {
  const auto count = static_cast<int>(measurements.list.size());
  const bool is_chosen = measurements.current >= 0 && measurements.current < count;
  return is_chosen ? &measurements.list[static_cast<std::size_t>(measurements.current)] : nullptr;
}

std::optional<double> depth_of(const EpiMeasurement& measurement, const CameraGrid& camera) {
  if (!camera.is_known()) return std::nullopt;
  const double depth = camera.depth_from_disparity(measurement.disparity_px);
  return std::isfinite(depth) ? std::optional(depth) : std::nullopt;
}

std::string measurements_csv(const std::vector<EpiMeasurement>& list, const CameraGrid& camera) {
  TextTable table{
      {"name", "direction", "v", "u", "y", "x", "slope_px_per_view", "disparity_px", "depth"}, {}};
  for (const EpiMeasurement& each : list) {
    const auto depth = depth_of(each, camera);
    table.rows.push_back({each.name, each.direction == EpiDirection::Horizontal ? "row" : "column",
                          std::to_string(each.view.v), std::to_string(each.view.u),
                          std::to_string(each.pixel.y), std::to_string(each.pixel.x),
                          fixed_text(-each.disparity_px, 4), fixed_text(each.disparity_px, 4),
                          depth ? fmt::format("{:.6g}", *depth) : ""});
  }
  return table_to_csv(table);
}

}  // namespace episcope
