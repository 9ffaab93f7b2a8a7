// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/open_scene.h"

#include "app/session/capture_work.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

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
  return fmt::format("judged {} {} {} {} {} {}\n", static_cast<int>(judged.pixels), r.y0, r.x0,
                     r.y1, r.x1, judged.mask);
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

}  // namespace episcope
