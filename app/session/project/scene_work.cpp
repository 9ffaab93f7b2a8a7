// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/project/scene_work.h"

#include "app/session/project/capture_json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace episcope {
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
