// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/open_scene.h"

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

namespace {

std::string capture_text(CaptureWork work) {
  for (CaptureObject& each : work.objects) each.pose.reset();
  return work.empty() ? std::string() : capture_to_json(work, "/") + '\n';
}

std::string measured_text(const Measurements& measured) {
  std::string text;
  for (const EpiMeasurement& each : measured.list) {
    text += fmt::format("line {} {} {} {} {} {} {}\n", each.name, static_cast<int>(each.direction),
                        each.view.v, each.view.u, each.pixel.y, each.pixel.x, each.disparity_px);
  }
  return text;
}

std::string judged_text(const JudgedPart& judged) {
  const PixelRect& r = judged.rectangle;
  return fmt::format("judged {} {} {} {} {} {} {}\n", static_cast<int>(judged.pixels), r.y0, r.x0,
                     r.y1, r.x1, judged.mask, judged.region);
}

// As RFC 4180: quotes around a text that needs them.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char each : text) {
    if (each == '"') quoted += '"';
    quoted += each;
  }
  return quoted + '"';
}

}  // namespace

bool has_work(const ScenePlace& place) {
  return !place.measured.list.empty() || !place.capture.empty() || place.judged != JudgedPart{} ||
         place.label_marks != LabelMarks{} || !place.tone.is_plain();
}

std::string work_text(const ScenePlace& place) {
  const auto& [hidden, locked] = place.label_marks;
  return capture_text(place.capture) + measured_text(place.measured) + judged_text(place.judged) +
         fmt::format("labels {} {}\ntone {} {} {}\n", fmt::join(hidden, ","),
                     fmt::join(locked, ","), place.tone.black, place.tone.exposure,
                     place.tone.gamma);
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
  std::string csv = "name,direction,v,u,y,x,slope_px_per_view,disparity_px,depth\n";
  for (const EpiMeasurement& each : list) {
    const auto depth = depth_of(each, camera);
    csv += fmt::format("{},{},{},{},{},{},{:.4f},{:.4f},{}\n", field(each.name),
                       each.direction == EpiDirection::Horizontal ? "row" : "column", each.view.v,
                       each.view.u, each.pixel.y, each.pixel.x, -each.disparity_px,
                       each.disparity_px, depth ? fmt::format("{:.6g}", *depth) : "");
  }
  return csv;
}

}  // namespace episcope
